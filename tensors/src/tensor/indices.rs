//! The indices of a component, and the iteration over all nonzero components.

use super::Tensor;
use crate::{Summable, threads};
use std::ops::{Deref, Range};

/// If there are at most this many components, one thread writes all indices.
const TOGETHER: usize = 1 << 16;

/// The indices of one component, from 0. The type can be used as a slice of `usize`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indices([usize; Indices::MAX], usize);

impl Indices {
    /// The highest rank of a tensor.
    pub const MAX: usize = 8;

    /// The same indices, with two of them exchanged.
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

/// A decoder that converts ascending keys to indices. Neighbouring keys usually differ only in the
/// last two indices, so only these are recomputed.
#[derive(Clone, Debug)]
pub(super) struct Reader {
    dimension: u64,
    /// The smallest key whose indices agree, except for the last two.
    first: u64,
    indices: Indices,
}

impl Reader {
    pub fn new<S>(tensor: &Tensor<S>) -> Self {
        let indices = Indices([0; Indices::MAX], tensor.slots.len());
        Reader { dimension: tensor.dimension as u64, first: u64::MAX, indices }
    }

    #[inline]
    pub fn read(&mut self, key: u64) -> Indices {
        let (n, indices) = (self.dimension, &mut self.indices.0[..self.indices.1]);
        match indices {
            [front @ .., last_but_one, last] => {
                let ahead = key.wrapping_sub(self.first);
                let ahead = if key >= self.first && ahead < n * n {
                    ahead
                } else {
                    let (mut rest, ahead) = (key / (n * n), key % (n * n));
                    self.first = key - ahead;
                    for index in front.iter_mut().rev() {
                        (*index, rest) = ((rest % n) as usize, rest / n);
                    }
                    ahead
                };
                (*last_but_one, *last) = ((ahead / n) as usize, (ahead % n) as usize);
            }
            [only] => *only = key as usize,
            [] => {}
        }
        self.indices
    }
}

/// An iterator over the nonzero components of a tensor in the order of their indices; see
/// [`Tensor::components`].
#[derive(Clone)]
pub struct Components<'t, S> {
    tensor: &'t Tensor<S>,
    rest: Range<usize>,
    reader: Reader,
}

impl<'t, S: Summable> Components<'t, S> {
    fn new(tensor: &'t Tensor<S>, rest: Range<usize>) -> Self {
        Components { tensor, rest, reader: Reader::new(tensor) }
    }
}

impl<'t, S: Summable> Iterator for Components<'t, S> {
    type Item = (Indices, &'t S);

    fn next(&mut self) -> Option<Self::Item> {
        let Tensor { keys, values, .. } = self.tensor;
        let at = self.rest.find(|at| !values[*at].is_small())?;
        Some((self.reader.read(keys[at]), &values[at]))
    }
    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.rest.len()))
    }
}

/// The number of stored components in one piece of work of a thread.
const PIECE: usize = 1 << 14;

/// The number of pieces that each thread computes before their results are passed on.
const ROUND: usize = 8;

impl<'t, S: Summable> IntoIterator for &'t Tensor<S> {
    type Item = (Indices, &'t S);
    type IntoIter = Components<'t, S>;

    fn into_iter(self) -> Components<'t, S> {
        Components::new(self, 0..self.keys.len())
    }
}

impl<S: Summable> Tensor<S> {
    /// Divides the nonzero components, in order, into pieces. Calls `take` with the result of
    /// `work` for each piece, in the same order. The function `work` runs on all threads at once.
    ///
    /// # Errors
    /// The first error of `take`. After an error, `take` is not called again.
    pub fn in_pieces<T: Send, E>(
        &self,
        work: impl Fn(Components<'_, S>) -> T + Send + Sync,
        take: impl FnMut(T) -> Result<(), E>,
    ) -> Result<(), E> {
        self.in_pieces_of(PIECE, work, take)
    }

    fn in_pieces_of<T: Send, E>(
        &self,
        length: usize,
        work: impl Fn(Components<'_, S>) -> T + Send + Sync,
        mut take: impl FnMut(T) -> Result<(), E>,
    ) -> Result<(), E> {
        let piece = |at: usize| {
            let end = self.keys.len().min((at + 1) * length);
            work(Components::new(self, at * length..end))
        };
        let pieces = self.keys.len().div_ceil(length);
        let round = ROUND * threads::count();
        for first in (0..pieces).step_by(round) {
            let count = round.min(pieces - first);
            match count {
                1 => take(piece(first))?,
                _ => threads::map(count as u64, &threads::States::new(|| ()), |(), at| {
                    piece(first + at as usize)
                })
                .into_iter()
                .try_for_each(&mut take)?,
            }
        }
        Ok(())
    }

    /// The values of the nonzero components, in the order of their indices.
    pub fn nonzero(&self) -> impl Iterator<Item = &S> {
        self.values.iter().filter(|value| !value.is_small())
    }

    /// The indices of the nonzero components, from 0, in one list. The list begins with the indices
    /// of the first slot, in the order of the components. The indices of the second slot follow,
    /// and so on. This form is the coordinate format of sparse arrays.
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

    /// Writes [`Tensor::coordinates`] into an existing list.
    ///
    /// # Panics
    /// If the length of the list is not the rank times the number of nonzero components.
    pub fn write_coordinates(&self, list: &mut [i64]) {
        let count = self.len();
        assert_eq!(list.len(), self.rank() * count, "an index for each slot of each component");
        if count > 0 {
            self.write_rows(0..self.keys.len(), list.chunks_exact_mut(count).collect(), TOGETHER);
        }
    }

    /// Writes the indices of a range of stored components, with one row for each slot. If there are
    /// more than `together` components, two threads write them.
    fn write_rows(&self, stored: Range<usize>, mut rows: Vec<&mut [i64]>, together: usize) {
        if stored.len() > together {
            let middle = stored.start + stored.len() / 2;
            let first =
                self.values[stored.start..middle].iter().filter(|value| !value.is_small()).count();
            let (before, after) = rows.into_iter().map(|row| row.split_at_mut(first)).unzip();
            threads::join(
                || self.write_rows(stored.start..middle, before, together),
                || self.write_rows(middle..stored.end, after, together),
            );
            return;
        }
        let stored = self.keys[stored.clone()].iter().zip(&self.values[stored]);
        let shown = stored.filter(|(_, value)| !value.is_small());
        let mut reader = Reader::new(self);
        for (at, (&key, _)) in shown.enumerate() {
            for (row, &index) in rows.iter_mut().zip(&*reader.read(key)) {
                row[at] = index as i64;
            }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Down, TrackedFloat, Up, contract};

    #[test]
    fn coordinates_do_not_depend_on_the_number_of_threads() {
        // the sums of rows 1 and 3 are rounding errors, which are stored but not shown
        let row = |i: usize| {
            if i % 2 == 1 { [0.1, 0.2, -0.3, 0.0, 0.0] } else { [1.0, 0.0, 2.0, 0.5, i as f64] }
        };
        let a = (0..5).flat_map(|i| {
            row(i).into_iter().enumerate().map(move |(j, x)| ([i, j], TrackedFloat::from(x)))
        });
        let b =
            (0..25).map(|k| ([k / 5, k % 5], TrackedFloat::from([1.0, 3.0, 0.0, 7.0, 5.0][k % 5])));
        let a = Tensor::from_components(5, &[Down, Down], a).expect("a tensor");
        let b = Tensor::from_components(5, &[Up, Down], b).expect("a tensor");
        let tensor = contract("a_ij b^j_k -> _ik", &[("a", &a), ("b", &b)]).expect("a tensor");
        assert!(tensor.keys.len() > tensor.len());
        let expected = [0, 1].map(|slot| tensor.components().map(move |(at, _)| at[slot] as i64));
        let expected: Vec<_> = expected.into_iter().flatten().collect();
        for together in [1, 2, 3, 7, 100] {
            let mut list = vec![-1; expected.len()];
            let rows = list.chunks_exact_mut(tensor.len()).collect();
            tensor.write_rows(0..tensor.keys.len(), rows, together);
            assert_eq!(list, expected, "{together} together");
        }
    }

    /// A reader decodes every ascending sequence of keys correctly.
    #[test]
    fn a_reader_divides_every_key() {
        for (dimension, rank) in
            [(1, 8), (2, 8), (3, 2), (5, 4), (7, 1), (9, 0), (248, 4), (1 << 20, 3)]
        {
            let tensor = Tensor::<f64>::zero(dimension, &vec![Up; rank]).expect("a tensor");
            let mut reader = Reader::new(&tensor);
            let all = (dimension as u64).pow(rank as u32);
            for step in [1, 2, 61, 62_000, 1 << 33] {
                for key in (0..all).step_by(step).take(100).chain([all - 1, 0]) {
                    assert_eq!(
                        reader.read(key),
                        tensor.indices(key),
                        "{key} of {dimension}^{rank}"
                    );
                }
            }
        }
    }

    #[test]
    fn pieces_are_all_components_in_order() {
        let value = |k: usize| [TrackedFloat::from(1.0), TrackedFloat::from(k as f64)][k % 2];
        let components = (0..25).filter(|k| k % 4 > 0).map(|k| ([k / 5, k % 5], value(k)));
        let tensor = Tensor::from_components(5, &[Down, Down], components).expect("a tensor");
        for length in [1, 2, 3, 7, 25, 100] {
            let mut found = Vec::new();
            let done: Result<(), ()> = tensor.in_pieces_of(
                length,
                |piece| piece.map(|(at, value)| (at, *value)).collect::<Vec<_>>(),
                |piece| {
                    found.extend(piece);
                    Ok(())
                },
            );
            assert_eq!(done, Ok(()));
            let all = tensor.components().map(|(at, value)| (at, *value));
            assert_eq!(found, all.collect::<Vec<_>>(), "{length}");
        }
        let mut taken = 0;
        let stopped = tensor.in_pieces_of(
            1,
            |piece| piece.count(),
            |_| {
                taken += 1;
                if taken == 3 { Err(()) } else { Ok(()) }
            },
        );
        assert_eq!((stopped, taken), (Err(()), 3));
    }
}
