//! Tensors: sparse, sorted, with upper and lower slots.

use crate::linear::Row;
use crate::{Ring, Sum, TensorError, Tolerance};
use std::fmt;
use std::ops::Deref;

/// Whether a slot takes an upper or a lower index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variance {
    /// An upper (contravariant) index.
    Up,
    /// A lower (covariant) index.
    Down,
}
pub use Variance::{Down, Up};

/// A tensor of any rank in one dimension `n`: its nonzero components in the order of their indices.
///
/// Slots are ordered; `c^i_jk` is stored with the slots `[Up, Down, Down]`, and the component
/// indices are `[i, j, k]`, from 0. No zero is ever stored ([`Ring::vanishes`]).
///
/// ```
/// use affinor_tensors::{Down, Rational, Tensor, Up};
/// let delta = Tensor::<Rational>::identity(3);
/// assert_eq!(delta.slots(), [Up, Down]);
/// assert_eq!(delta.len(), 3);
/// ```
#[derive(Clone, PartialEq)]
pub struct Tensor<S> {
    dimension: usize,
    slots: Box<[Variance]>,
    keys: Vec<u64>,
    values: Vec<S>,
    tolerance: Tolerance,
}

impl<S: Ring> Tensor<S> {
    /// The zero tensor.
    ///
    /// # Errors
    /// [`TensorError::TooLarge`] when `dimension^rank` exceeds 64 bits.
    pub fn zero(dimension: usize, slots: &[Variance]) -> Result<Self, TensorError> {
        let rank = slots.len();
        let fits = rank <= Indices::MAX
            && (dimension as u64).checked_pow(rank as u32).is_some_and(|n| n < u64::MAX);
        let slots = slots.into();
        let (keys, values, tolerance) = (vec![], vec![], Tolerance::default());
        fits.then_some(Tensor { dimension, slots, keys, values, tolerance })
            .ok_or(TensorError::TooLarge { dimension, rank })
    }

    /// The tensor with the given components; those of equal indices are added up.
    ///
    /// # Errors
    /// An index out of range, a wrong number of indices, or a tensor that is too large.
    pub fn from_components<I: AsRef<[usize]>>(
        dimension: usize,
        slots: &[Variance],
        components: impl IntoIterator<Item = (I, S)>,
    ) -> Result<Self, TensorError> {
        let zero = Self::zero(dimension, slots)?;
        let keyed = components.into_iter();
        let keyed = keyed.map(|(indices, value)| Ok((zero.key(indices.as_ref())?, value)));
        let keyed = keyed.collect::<Result<_, _>>()?;
        Ok(zero.gather(keyed))
    }

    /// The tensor whose components stand in one sparse row, each at its place in the order of
    /// indices: `i` for a vector, `i n + j` for a matrix, `(i n + j) n + k` for rank 3. Those of
    /// equal places are added up. The inverse of [`to_row`](Self::to_row).
    ///
    /// ```
    /// use affinor_tensors::{Down, Tensor};
    /// let form = Tensor::from_row(3, &[Down, Down], [(1 * 3 + 2, 5.0)])?;
    /// assert_eq!(form.get(&[1, 2]), 5.0);
    /// assert_eq!(form.to_row(), [(5, 5.0)]);
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// A place that is not below `n^rank`, or a tensor that is too large.
    pub fn from_row(
        dimension: usize,
        slots: &[Variance],
        row: impl IntoIterator<Item = (usize, S)>,
    ) -> Result<Self, TensorError> {
        let zero = Self::zero(dimension, slots)?;
        let places = (dimension as u64).pow(slots.len() as u32);
        let keyed = row.into_iter().map(|(place, value)| match place as u64 {
            key if key < places => Ok((key, value)),
            _ => Err(TensorError::IndexRange { index: place, dimension: places as usize }),
        });
        let keyed = keyed.collect::<Result<_, _>>()?;
        Ok(zero.gather(keyed))
    }

    /// The tensor with the components `f([i, j, ...])`, indices from 0.
    ///
    /// # Errors
    /// [`TensorError::TooLarge`].
    pub fn from_fn<const RANK: usize>(
        dimension: usize,
        slots: [Variance; RANK],
        mut f: impl FnMut([usize; RANK]) -> S,
    ) -> Result<Self, TensorError> {
        let mut tensor = Self::zero(dimension, &slots)?;
        for key in 0..(dimension as u64).pow(RANK as u32) {
            let mut indices = [0; RANK];
            indices.copy_from_slice(&tensor.indices(key));
            tensor.push(key, f(indices));
        }
        Ok(tensor)
    }

    /// The Kronecker delta, `delta^i_j`.
    pub fn identity(dimension: usize) -> Self {
        let n = dimension as u64;
        Tensor {
            dimension,
            slots: [Up, Down].into(),
            keys: (0..n).map(|i| i * (n + 1)).collect(),
            values: vec![S::one(); dimension],
            tolerance: Tolerance::default(),
        }
    }

    /// The vector `v^i` (or covector, by `variance`) with these components.
    pub fn vector(components: &[S], variance: Variance) -> Self {
        let mut vector = Tensor {
            dimension: components.len(),
            slots: [variance].into(),
            keys: vec![],
            values: vec![],
            tolerance: Tolerance::default(),
        };
        for (key, value) in components.iter().enumerate() {
            vector.push(key as u64, value.clone());
        }
        vector
    }

    /// The same tensor with another tolerance for what is computed from it (floats only).
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The dimension: indices run from 0 to one less.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The number of indices.
    pub fn rank(&self) -> usize {
        self.slots.len()
    }

    /// Upper or lower, slot by slot.
    pub fn slots(&self) -> &[Variance] {
        &self.slots
    }

    /// The tolerance that sums over this tensor use.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// The number of nonzero components.
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether every component is zero.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// One component; zero when it is not stored.
    ///
    /// # Panics
    /// As slice indexing does: on an index out of range or a wrong number of indices.
    pub fn get(&self, indices: &[usize]) -> S {
        let key = self.key(indices).expect("indices of this tensor");
        self.keys.binary_search(&key).map_or_else(|_| S::zero(), |at| self.values[at].clone())
    }

    /// The nonzero components in the order of their indices.
    pub fn components(&self) -> impl ExactSizeIterator<Item = (Indices, &S)> {
        self.keys.iter().map(|&key| self.indices(key)).zip(&self.values)
    }

    /// The value of a tensor of rank 0.
    pub fn to_scalar(&self) -> Option<S> {
        self.slots.is_empty().then(|| self.get(&[]))
    }

    /// All `n` components of a tensor of rank 1, zeros included.
    pub fn to_vector(&self) -> Option<Vec<S>> {
        (self.rank() == 1).then(|| (0..self.dimension).map(|i| self.get(&[i])).collect())
    }

    /// The nonzero components as one sparse row, each at its place in the order of indices:
    /// [`from_row`](Self::from_row) says which.
    pub fn to_row(&self) -> Row<S> {
        let places = self.keys.iter().map(|&key| key as usize);
        places.zip(self.values.iter().cloned()).collect()
    }

    /// The components mapped into another ring, the tolerance kept.
    pub fn map<T: Ring>(&self, f: impl Fn(&S) -> T) -> Tensor<T> {
        self.filter_map(|_, value| Some(f(value)))
    }

    /// The components mapped by `f`, which also sees the indices; `None` is zero.
    pub fn filter_map<T: Ring>(&self, f: impl Fn(&[usize], &S) -> Option<T>) -> Tensor<T> {
        let mut tensor = Tensor {
            dimension: self.dimension,
            slots: self.slots.clone(),
            keys: Vec::with_capacity(self.len()),
            values: Vec::with_capacity(self.len()),
            tolerance: self.tolerance,
        };
        for (&key, value) in self.keys.iter().zip(&self.values) {
            if let Some(value) = f(&self.indices(key), value) {
                tensor.push(key, value);
            }
        }
        tensor
    }

    /// Every component multiplied by `factor`.
    #[must_use]
    pub fn scale(&self, factor: &S) -> Self {
        self.map(|value| value.clone() * factor)
    }

    /// The slots in another order: slot `a` of the result is slot `order[a]` of this tensor.
    ///
    /// # Errors
    /// [`TensorError::Rank`] unless `order` is a permutation of the slots.
    pub fn permute(&self, order: &[usize]) -> Result<Self, TensorError> {
        let mut seen = order.to_vec();
        seen.sort_unstable();
        if !seen.iter().copied().eq(0..self.rank()) {
            return Err(TensorError::Rank { rank: self.rank(), given: order.len() });
        }
        let slots: Vec<_> = order.iter().map(|&a| self.slots[a]).collect();
        let moved = self.components().map(|(indices, value)| {
            (order.iter().map(|&a| indices[a]).collect::<Vec<_>>(), value.clone())
        });
        let tensor = Self::from_components(self.dimension, &slots, moved)?;
        Ok(tensor.with_tolerance(self.tolerance))
    }

    /// Whether two slots of equal variance are symmetric (`Some(1)`), antisymmetric (`Some(-1)`),
    /// or neither, in the components as they stand.
    pub fn pair_symmetry(&self, a: usize, b: usize) -> Option<i64> {
        if self.slots[a] != self.slots[b] || self.is_empty() {
            return None;
        }
        [-1, 1].into_iter().find(|&sign| {
            self.components().all(|(mut indices, value)| {
                indices.0.swap(a, b);
                let other = self.get(&indices) * &S::from_i64(-sign);
                let mut sum = S::Sum::term(value);
                sum.add_term(&other);
                sum.finish(self.tolerance).is_none()
            })
        })
    }

    /// Takes over components in any order, those of equal keys added up.
    fn gather(mut self, mut keyed: Vec<(u64, S)>) -> Self {
        keyed.sort_by_key(|(key, _)| *key);
        for run in keyed.chunk_by(|a, b| a.0 == b.0) {
            let mut sum = S::Sum::term(&run[0].1);
            run[1..].iter().for_each(|(_, value)| sum.add_term(value));
            if let Some(value) = sum.finish(self.tolerance) {
                self.push(run[0].0, value);
            }
        }
        self
    }

    /// Appends a component behind all stored ones; zeros are dropped.
    pub(crate) fn push(&mut self, key: u64, value: S) {
        debug_assert!(self.keys.last().is_none_or(|&last| last < key));
        if !value.vanishes() {
            self.keys.push(key);
            self.values.push(value);
        }
    }

    /// Takes over sorted, nonzero components.
    pub(crate) fn fill(mut self, keys: Vec<u64>, values: Vec<S>) -> Self {
        debug_assert!(keys.is_sorted_by(|a, b| a < b) && keys.len() == values.len());
        (self.keys, self.values) = (keys, values);
        self
    }

    pub(crate) fn keys(&self) -> &[u64] {
        &self.keys
    }

    pub(crate) fn values(&self) -> &[S] {
        &self.values
    }

    /// The position of a component in the order of indices.
    fn key(&self, indices: &[usize]) -> Result<u64, TensorError> {
        let dimension = self.dimension;
        if indices.len() != self.rank() {
            return Err(TensorError::Rank { rank: self.rank(), given: indices.len() });
        }
        indices.iter().try_fold(0, |key, &index| {
            let valid = index < dimension;
            let key = valid.then(|| key * dimension as u64 + index as u64);
            key.ok_or(TensorError::IndexRange { index, dimension })
        })
    }
}

impl<S> Tensor<S> {
    fn indices(&self, mut key: u64) -> Indices {
        let n = self.dimension as u64;
        let mut indices = Indices([0; Indices::MAX], self.slots.len());
        for index in indices.0[..self.slots.len()].iter_mut().rev() {
            *index = (key % n) as usize;
            key /= n;
        }
        indices
    }
}

impl<S: fmt::Debug> fmt::Debug for Tensor<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let indices = self.keys.iter().map(|&key| self.indices(key).to_vec());
        let components = indices.zip(&self.values);
        f.debug_map().entries(components).finish()
    }
}

/// The indices of one component, from 0; a slice of `usize`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indices([usize; Indices::MAX], usize);

impl Indices {
    /// The highest rank of a tensor.
    pub const MAX: usize = 8;
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
