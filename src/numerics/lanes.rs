//! Several floats that are processed together. The compiler turns loops over them into vector
//! instructions.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A float, or several floats that are processed together. Formulas without branches accept both.
///
/// A float is rounded in the same way whether it is processed alone or in a group, so a result
/// depends only on its arguments.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same value in each lane.
    fn splat(value: f64) -> Self;
    /// Applies a function to each value.
    fn map(self, f: impl Fn(f64) -> f64) -> Self;
    /// Applies a function to each pair of values.
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
    /// Selects `x` where `self > other`, otherwise `y`.
    fn if_above(self, other: Self, x: Self, y: Self) -> Self;

    /// The absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The square root.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The absolute value of `self`, with the sign of `sign`.
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.zip(sign, f64::copysign)
    }

    /// Selects `self` where it is not zero, otherwise `other`.
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self.zip(other, |a, b| if a != 0.0 { a } else { b })
    }

    /// The larger of the two values. The result is NaN if one of them is NaN.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b || a.is_nan() { a } else { b })
    }
}

impl Lane for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        if self > other { x } else { y }
    }
}

/// The number of lanes.
pub const LANES: usize = 8;

/// A group of floats, with one float in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes(pub [f64; LANES]);

impl Lane for Lanes {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Lanes([value; LANES])
    }
    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for value in &mut self.0 {
            *value = f(*value);
        }
        self
    }
    #[inline(always)]
    fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for t in 0..LANES {
            self.0[t] = f(self.0[t], other.0[t]);
        }
        self
    }
    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        let mut chosen = y;
        for t in 0..LANES {
            chosen.0[t] = if self.0[t] > other.0[t] { x.0[t] } else { y.0[t] };
        }
        chosen
    }
}

/// Defines operators that act on each lane.
macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt;)*) => {
        $(impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for t in 0..LANES {
                    self.0[t] $operator other.0[t];
                }
                self
            }
        })*
    };
}

operators! {
    Add add +=;
    Sub sub -=;
    Mul mul *=;
    Div div /=;
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|value| -value)
    }
}
