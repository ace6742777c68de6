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

impl<S: Ring> Tensor<S> {
    /// The nonzero components without their indices, in the order of these.
    pub fn nonzero(&self) -> impl Iterator<Item = &S> {
        self.values.iter().filter(|value| !value.is_small())
    }

    /// The indices of the nonzero components, from 0, in one list: those of the first slot in the order of the components, then
    /// those of the second slot, and so on. This is the coordinate format of sparse arrays.
    ///
    /// ```
    /// use affinor_tensors::{Down, Tensor};
    /// let form = Tensor::from_components(3, &[Down, Down], [([0, 1], 5.0), ([2, 0], 7.0)])?;
    /// assert_eq!(form.coordinates(), [0, 2, 1, 0]);
    /// assert!(form.nonzero().eq(&[5.0, 7.0]));
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    pub fn coordinates(&self) -> Vec<i64> {
        let mut list = vec![0; self.rank() * self.len()];
        self.write_coordinates(&mut list);
        list
    }

    /// [`Tensor::coordinates`] into a list that exists.
    ///
    /// # Panics
    /// If the length of the list is not the rank times the number of nonzero components.
    pub fn write_coordinates(&self, list: &mut [i64]) {
        let (rank, count) = (self.rank(), self.len());
        assert_eq!(list.len(), rank * count, "an index for each slot of each component");
        let Some(last) = rank.checked_sub(1) else { return };
        let (fronts, ends) = list.split_at_mut(last * count);
        let shown = self.keys.iter().zip(&self.values).filter(|(_, value)| !value.is_small());
        // neighbours mostly share all indices but the last: these are divided out once
        let (mut base, mut before) = (u64::MAX, Indices([0; Indices::MAX], rank));
        for ((at, (&key, _)), end) in shown.enumerate().zip(ends) {
            let ahead = key.wrapping_sub(base);
            if key < base || ahead >= self.dimension as u64 {
                before = self.indices(key);
                base = key - before[last] as u64;
            }
            for slot in 0..last {
                fronts[slot * count + at] = before.0[slot] as i64;
            }
            *end = (key - base) as i64;
        }
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
