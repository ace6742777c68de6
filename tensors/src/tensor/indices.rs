//! The indices of a component, and the iteration over all nonzero components.

use super::Tensor;
use crate::Ring;
use std::ops::{Deref, Range};

/// The indices of one component, from 0; a slice of `usize`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indices([usize; Indices::MAX], usize);

impl Indices {
    /// The highest rank of a tensor.
    pub const MAX: usize = 8;

    /// The same indices with two of them exchanged.
    pub(super) fn exchanged(mut self, a: usize, b: usize) -> Self {
        self.0.swap(a, b);
        self
    }
}

impl Deref for Indices {
    type Target = [usize];
    fn deref(&self) -> &[usize] {
        &self.0[..self.1]
    }
}

impl AsRef<[usize]> for Indices {
    fn as_ref(&self) -> &[usize] {
        self
    }
}

/// The nonzero components of a tensor in the order of their indices: [`Tensor::components`].
#[derive(Clone)]
pub struct Components<'t, S> {
    tensor: &'t Tensor<S>,
    rest: Range<usize>,
}

impl<'t, S: Ring> Iterator for Components<'t, S> {
    type Item = (Indices, &'t S);

    fn next(&mut self) -> Option<Self::Item> {
        let Tensor { keys, values, .. } = self.tensor;
        let at = self.rest.find(|at| !values[*at].is_small())?;
        Some((self.tensor.indices(keys[at]), &values[at]))
    }
    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.rest.len()))
    }
}

impl<'t, S: Ring> IntoIterator for &'t Tensor<S> {
    type Item = (Indices, &'t S);
    type IntoIter = Components<'t, S>;

    fn into_iter(self) -> Components<'t, S> {
        Components { tensor: self, rest: 0..self.keys.len() }
    }
}

impl<S> Tensor<S> {
    /// The indices of the component with this key.
    pub(super) fn indices(&self, mut key: u64) -> Indices {
        let (n, rank) = (self.dimension as u64, self.slots.len());
        let mut indices = Indices([0; Indices::MAX], rank);
        for index in indices.0[..rank].iter_mut().rev() {
            *index = (key % n) as usize;
            key /= n;
        }
        indices
    }
}
