//! Equality, indexing, text and arithmetic of tensors.

use super::{Tensor, Up};
use crate::{Scalar, Summable};
use std::fmt;
use std::ops::{Add, Index, Mul, Neg, Sub};

/// Two tensors are equal if their shapes and components are equal. The tolerance is ignored.
impl<S: PartialEq> PartialEq for Tensor<S> {
    fn eq(&self, other: &Self) -> bool {
        self.dimension == other.dimension
            && self.slots == other.slots
            && self.keys == other.keys
            && self.values == other.values
    }
}

/// The component `tensor[&[i, j, k][..]]`, with indices from 0. It is zero if it is not stored.
///
/// Panics if an index is out of range, or if the number of indices is wrong.
impl<S: Summable> Index<&[usize]> for Tensor<S> {
    type Output = S;
    fn index(&self, indices: &[usize]) -> &S {
        self.try_get(indices).expect("indices of this tensor")
    }
}

/// The component `tensor[[i, j, k]]`, with indices from 0. It is zero if it is not stored.
///
/// Panics if an index is out of range, or if the number of indices is wrong.
impl<S: Summable, const RANK: usize> Index<[usize; RANK]> for Tensor<S> {
    type Output = S;
    fn index(&self, indices: [usize; RANK]) -> &S {
        &self[&indices[..]]
    }
}

/// Writes one nonzero component per line, with indices from 1: `^1_23 = -1/2`. If the dimension is
/// 10 or more, commas separate the indices: `^1_2,13 = 1`. The zero tensor is written `0`.
impl<S: Summable> fmt::Display for Tensor<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("0");
        }
        for (line, (indices, value)) in self.into_iter().enumerate() {
            f.write_str(if line > 0 { "\n" } else { "" })?;
            for (at, (slot, index)) in self.slots.iter().zip(indices.iter()).enumerate() {
                let mark = if *slot == Up { "^" } else { "_" };
                let mark = match at.checked_sub(1).map(|before| self.slots[before] == *slot) {
                    Some(true) if self.dimension > 9 => ",",
                    Some(true) => "",
                    _ => mark,
                };
                write!(f, "{mark}{}", index + 1)?;
            }
            let space = if self.slots.is_empty() { "" } else { " = " };
            write!(f, "{space}{value}")?;
        }
        Ok(())
    }
}

impl<S: fmt::Debug> fmt::Debug for Tensor<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let indices = self.keys.iter().map(|&key| self.indices(key).to_vec());
        let components = indices.zip(self.values.iter());
        f.debug_map().entries(components).finish()
    }
}

macro_rules! sum {
    ($operator:ident $method:ident $sign:literal) => {
        /// # Panics
        /// If the tensors have different dimensions or slots.
        impl<S: Scalar> $operator for &Tensor<S> {
            type Output = Tensor<S>;
            fn $method(self, other: &Tensor<S>) -> Tensor<S> {
                self.combined($sign, other).expect("two tensors of one shape")
            }
        }
        impl<S: Scalar> $operator<&Tensor<S>> for Tensor<S> {
            type Output = Tensor<S>;
            fn $method(self, other: &Tensor<S>) -> Tensor<S> {
                $operator::$method(&self, other)
            }
        }
        impl<S: Scalar> $operator for Tensor<S> {
            type Output = Tensor<S>;
            fn $method(self, other: Tensor<S>) -> Tensor<S> {
                $operator::$method(&self, &other)
            }
        }
    };
}
sum!(Add add '+');
sum!(Sub sub '-');

impl<S: Scalar> Mul<&S> for &Tensor<S> {
    type Output = Tensor<S>;
    fn mul(self, factor: &S) -> Tensor<S> {
        self.scale(factor)
    }
}

impl<S: Scalar> Mul<&S> for Tensor<S> {
    type Output = Tensor<S>;
    fn mul(self, factor: &S) -> Tensor<S> {
        self.scale(factor)
    }
}

impl<S: Scalar> Neg for &Tensor<S> {
    type Output = Tensor<S>;
    fn neg(self) -> Tensor<S> {
        self.map(|value| -value.clone())
    }
}

impl<S: Scalar> Neg for Tensor<S> {
    type Output = Tensor<S>;
    fn neg(self) -> Tensor<S> {
        -&self
    }
}
