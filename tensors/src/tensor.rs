//! Tensors with upper and lower slots. Their components are sparse, and stored in the order of
//! their indices.

mod indices;
mod operators;

use crate::linear::Row;
use crate::{Sum, Summable, TensorError, Tolerance};
use indices::Reader;
pub use indices::{Components, Indices};
use std::sync::Arc;

/// The variance of a slot: upper or lower.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Variance {
    /// An upper (contravariant) index.
    Up,
    /// A lower (covariant) index.
    Down,
}
pub use Variance::{Down, Up};

/// A tensor of any rank up to 8 over a space of dimension `n`. It stores its nonzero components in
/// the order of their indices.
///
/// Slots are ordered: `c^i_jk` has the slots `[Up, Down, Down]`, and its component indices are
/// `[i, j, k]`, from 0. Zeros are never stored ([`Ring::vanishes`](crate::Ring::vanishes)). Clones
/// share their components.
///
/// ```
/// use affinor_tensors::{Down, Rational, Tensor, Up};
/// let delta = Tensor::<Rational>::identity(3);
/// assert_eq!(delta.slots(), [Up, Down]);
/// assert_eq!(delta.len(), 3);
/// assert_eq!(delta[[1, 1]], Rational::from(1));
///
/// let metric = Tensor::diagonal([1, 2, 3].map(Rational::from), [Down, Down]);
/// assert!(std::ptr::eq(&metric[[0, 0]], &metric.clone()[[0, 0]]));
/// assert_eq!((&metric * &Rational::from(2) - &metric).to_string(), "_11 = 1\n_22 = 2\n_33 = 3");
/// ```
#[derive(Clone)]
pub struct Tensor<S> {
    dimension: usize,
    slots: Box<[Variance]>,
    // the lists of components, which clones share
    keys: Arc<Vec<u64>>,
    values: Arc<Vec<S>>,
    /// The tolerance; `None` for the default. In a sum, a tolerance that was chosen takes
    /// precedence over the default.
    tolerance: Option<Tolerance>,
    /// The zero of the ring, which is the value of all components that are not stored.
    zero: S,
}

impl<S: Summable> Tensor<S> {
    /// The zero tensor.
    ///
    /// # Errors
    /// [`TensorError::TooLarge`] if `dimension^rank` exceeds 64 bits.
    pub fn zero(dimension: usize, slots: &[Variance]) -> Result<Self, TensorError> {
        let rank = slots.len();
        let fits = rank <= Indices::MAX
            && (dimension as u64).checked_pow(rank as u32).is_some_and(|n| n < u64::MAX);
        fits.then(|| Self::unchecked(dimension, slots))
            .ok_or(TensorError::TooLarge { dimension, rank })
    }

    /// The zero tensor of a shape. The caller must ensure that the keys of its components fit in 64
    /// bits.
    fn unchecked(dimension: usize, slots: &[Variance]) -> Self {
        let (keys, values) = Default::default();
        Tensor { dimension, slots: slots.into(), keys, values, tolerance: None, zero: S::zero() }
    }

    /// A tensor with these components, which may be in any order. Components with equal indices are
    /// added.
    ///
    /// # Errors
    /// An error if an index is out of range, if the number of indices is wrong, or if the tensor is
    /// too large.
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

    /// A tensor whose components are given as one sparse row. The position of a component is `i`
    /// for a vector, `i n + j` for a matrix, and `(i n + j) n + k` for rank 3. Components at equal
    /// positions are added. This function is the inverse of [`to_row`](Self::to_row).
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
    /// An error if a position is not below `n^rank`, or if the tensor is too large.
    pub fn from_row(
        dimension: usize,
        slots: &[Variance],
        row: impl IntoIterator<Item = (usize, S)>,
    ) -> Result<Self, TensorError> {
        let zero = Self::zero(dimension, slots)?;
        let positions = (dimension as u64).pow(slots.len() as u32);
        let keyed = row.into_iter().map(|(index, value)| match index as u64 {
            key if key < positions => Ok((key, value)),
            _ => Err(TensorError::IndexRange { index, dimension: positions as usize }),
        });
        let keyed = keyed.collect::<Result<_, _>>()?;
        Ok(zero.gather(keyed))
    }

    /// A tensor with the components `f([i, j, ...])`. Indices count from 0.
    ///
    /// # Errors
    /// [`TensorError::TooLarge`].
    pub fn from_fn<const RANK: usize>(
        dimension: usize,
        slots: [Variance; RANK],
        mut f: impl FnMut([usize; RANK]) -> S,
    ) -> Result<Self, TensorError> {
        let tensor = Self::zero(dimension, &slots)?;
        let shape = tensor.clone();
        let components = (0..(dimension as u64).pow(RANK as u32)).map(|key| {
            let mut indices = [0; RANK];
            indices.copy_from_slice(&shape.indices(key));
            (key, f(indices))
        });
        Ok(tensor.store(0, components))
    }

    /// The Kronecker delta, `delta^i_j`.
    pub fn identity(dimension: usize) -> Self {
        Self::diagonal(std::iter::repeat_n(S::one(), dimension), [Up, Down])
    }

    /// A tensor of rank 2 with these components on the diagonal, and zeros elsewhere.
    pub fn diagonal(entries: impl IntoIterator<Item = S>, slots: [Variance; 2]) -> Self {
        let entries: Vec<S> = entries.into_iter().collect();
        let n = entries.len();
        Self::unchecked(n, &slots).store(n, (0..).step_by(n + 1).zip(entries))
    }

    /// The vector `v^i` with these components. If `variance` is lower, it is the covector `v_i`.
    pub fn vector(components: &[S], variance: Variance) -> Self {
        let n = components.len();
        Self::unchecked(n, &[variance]).store(n, (0..).zip(components.iter().cloned()))
    }

    /// The same tensor with another tolerance. Only computations in floats use the tolerance.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// The dimension `n`. Indices run from 0 to `n - 1`.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The number of indices.
    pub fn rank(&self) -> usize {
        self.slots.len()
    }

    /// The variance of each slot.
    pub fn slots(&self) -> &[Variance] {
        &self.slots
    }

    /// The tolerance that sums over this tensor use.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance.unwrap_or_default()
    }

    /// The largest of the tolerances that were chosen for these tensors. Returns `None` if all
    /// tensors have the default tolerance.
    pub(crate) fn common_tolerance<'a>(
        tensors: impl Iterator<Item = &'a Self>,
    ) -> Option<Tolerance> {
        tensors.filter_map(|tensor| tensor.tolerance).reduce(|a, b| a.weaker(b))
    }

    /// The number of nonzero components.
    pub fn len(&self) -> usize {
        self.values.iter().filter(|value| !value.is_small()).count()
    }

    /// Whether every component is zero.
    pub fn is_empty(&self) -> bool {
        self.values.iter().all(Summable::is_small)
    }

    /// The component with these indices, from 0. It is zero if it is not stored.
    ///
    /// # Panics
    /// If an index is out of range, or if the number of indices is wrong, as for slices.
    /// [`try_get`](Self::try_get) returns an error instead.
    pub fn get(&self, indices: &[usize]) -> S {
        self[indices].clone()
    }

    /// The component with these indices, from 0. It is zero if it is not stored.
    ///
    /// # Errors
    /// [`TensorError::Rank`] if the number of indices is wrong; [`TensorError::IndexRange`] if an
    /// index is out of range.
    pub fn try_get(&self, indices: &[usize]) -> Result<&S, TensorError> {
        let key = self.key(indices)?;
        let found = self.keys.binary_search(&key).ok().map(|at| &self.values[at]);
        Ok(found.filter(|value| !value.is_small()).unwrap_or(&self.zero))
    }

    /// The nonzero components in the order of their indices.
    pub fn components(&self) -> Components<'_, S> {
        self.into_iter()
    }

    /// The components for which the index of `slot` has the value `index`, as a tensor of one rank
    /// less. For example, the slot 0 of `c^i_jk` and the index 2 yield `c^2_jk`.
    ///
    /// ```
    /// use affinor_tensors::{Down, Tensor, Up};
    /// let tensor = Tensor::from_fn(2, [Up, Down], |[i, j]| (10 * i + j) as f64)?;
    /// assert_eq!(tensor.slice(0, 1)?, Tensor::vector(&[10.0, 11.0], Down));
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// [`TensorError::Slots`] unless the tensor has this slot; [`TensorError::IndexRange`].
    pub fn slice(&self, slot: usize, index: usize) -> Result<Self, TensorError> {
        let (dimension, rank) = (self.dimension, self.rank());
        if slot >= rank {
            return Err(TensorError::Slots { slots: vec![slot], rank });
        }
        if index >= dimension {
            return Err(TensorError::IndexRange { index, dimension });
        }
        let slots = [&self.slots[..slot], &self.slots[slot + 1..]].concat();
        let mut slice = Self::unchecked(dimension, &slots);
        slice.tolerance = self.tolerance;
        let n = dimension as u64;
        let below = n.pow((rank - 1 - slot) as u32);
        let stored = self.keys.iter().zip(self.values.iter());
        let chosen = stored.filter(|(key, _)| *key / below % n == index as u64);
        let components =
            chosen.map(|(key, value)| (key / below / n * below + key % below, value.clone()));
        Ok(slice.store(0, components))
    }

    /// The value of a tensor of rank 0; `None` for other ranks.
    pub fn to_scalar(&self) -> Option<S> {
        self.slots.is_empty().then(|| self.get(&[]))
    }

    /// All `n` components of a tensor of rank 1, including zeros; `None` for other ranks.
    pub fn to_vector(&self) -> Option<Vec<S>> {
        (self.rank() == 1).then(|| (0..self.dimension).map(|i| self.get(&[i])).collect())
    }

    /// The nonzero components as one sparse row, each at the position that
    /// [`from_row`](Self::from_row) describes.
    pub fn to_row(&self) -> Row<S> {
        let shown = self.keys.iter().zip(self.values.iter()).filter(|(_, value)| !value.is_small());
        shown.map(|(&key, value)| (key as usize, value.clone())).collect()
    }

    /// Maps the components into another ring. The tolerance remains the same.
    pub fn map<T: Summable>(&self, f: impl Fn(&S) -> T) -> Tensor<T> {
        self.filter_map(|_, value| Some(f(value)))
    }

    /// Maps the components by `f`, whose arguments are the indices and the component. The result
    /// `None` means zero.
    pub fn filter_map<T: Summable>(&self, f: impl Fn(&[usize], &S) -> Option<T>) -> Tensor<T> {
        let mut tensor = Tensor::unchecked(self.dimension, &self.slots);
        tensor.tolerance = self.tolerance;
        let stored = self.keys.iter().zip(self.values.iter());
        let mut reader = Reader::new(self);
        let mapped = stored.filter_map(|(&key, value)| Some((key, f(&reader.read(key), value)?)));
        tensor.store(self.keys.len(), mapped)
    }

    /// A tensor with an additional slot in front. For each component `v`, its component with the
    /// first index `k` is `f(k, v)`. Components that count as zero but are stored
    /// ([`Summable::is_small`]) are mapped too.
    ///
    /// # Errors
    /// [`TensorError::TooLarge`].
    pub fn with_first_slot(
        &self,
        slot: Variance,
        f: impl Fn(usize, &S) -> S,
    ) -> Result<Self, TensorError> {
        let slots = [&[slot], self.slots()].concat();
        let mut tensor = Self::zero(self.dimension, &slots)?;
        tensor.tolerance = self.tolerance;
        let block = (self.dimension as u64).pow(self.rank() as u32);
        let f = &f;
        let components = (0..self.dimension).flat_map(|k| {
            let stored = self.keys.iter().zip(self.values.iter());
            stored.map(move |(key, value)| (k as u64 * block + key, f(k, value)))
        });
        Ok(tensor.store(0, components))
    }

    /// The tensor multiplied by `factor`.
    #[must_use]
    pub fn scale(&self, factor: &S) -> Self {
        self.map(|value| value.clone() * factor)
    }

    /// The tensor with its slots in another order. The slot `a` of the result is the slot
    /// `order[a]` of this tensor.
    ///
    /// # Errors
    /// [`TensorError::Rank`] or [`TensorError::Slots`] unless `order` is a permutation of the
    /// slots.
    pub fn permute(&self, order: &[usize]) -> Result<Self, TensorError> {
        if order.len() != self.rank() {
            return Err(TensorError::Rank { rank: self.rank(), given: order.len() });
        }
        let mut seen = order.to_vec();
        seen.sort_unstable();
        if !seen.iter().copied().eq(0..self.rank()) {
            return Err(TensorError::Slots { slots: order.to_vec(), rank: self.rank() });
        }
        let slots: Vec<_> = order.iter().map(|&a| self.slots[a]).collect();
        let moved = self.components().map(|(indices, value)| {
            (order.iter().map(|&a| indices[a]).collect::<Vec<_>>(), value.clone())
        });
        let tensor = Self::from_components(self.dimension, &slots, moved)?;
        Ok(Tensor { tolerance: self.tolerance, ..tensor })
    }

    /// The symmetry of the components in two slots of equal variance. It is `Some(1)` if they are
    /// symmetric, `Some(-1)` if they are antisymmetric, and `None` otherwise.
    pub fn pair_symmetry(&self, a: usize, b: usize) -> Option<i64> {
        if self.slots[a] != self.slots[b] || self.is_empty() {
            return None;
        }
        [-1, 1].into_iter().find(|&sign| {
            self.components().all(|(indices, value)| {
                let other = self.get(&indices.exchanged(a, b)) * &S::from_i64(-sign);
                let mut sum = S::Sum::term(value);
                sum.add_term(&other);
                sum.finish(self.tolerance()).is_none()
            })
        })
    }

    /// Stores components that are given in any order. Components with equal keys are added.
    fn gather(self, mut keyed: Vec<(u64, S)>) -> Self {
        keyed.sort_by_key(|(key, _)| *key);
        let tolerance = self.tolerance();
        let components = keyed.chunk_by(|a, b| a.0 == b.0).filter_map(|run| {
            let mut sum = S::Sum::term(&run[0].1);
            run[1..].iter().for_each(|(_, value)| sum.add_term(value));
            Some((run[0].0, sum.finish(tolerance)?))
        });
        self.store(keyed.len(), components)
    }

    /// Stores components that are given in the order of their keys, and omits zeros. The parameter
    /// `room` is the expected number of components.
    fn store(self, room: usize, components: impl Iterator<Item = (u64, S)>) -> Self {
        let (mut keys, mut values) = (Vec::with_capacity(room), Vec::with_capacity(room));
        for (key, value) in components.filter(|(_, value)| !value.vanishes() || value.is_small()) {
            keys.push(key);
            values.push(value);
        }
        self.fill(keys, values)
    }

    /// Stores components that are sorted and nonzero.
    pub(crate) fn fill(mut self, keys: Vec<u64>, values: Vec<S>) -> Self {
        debug_assert!(keys.is_sorted_by(|a, b| a < b) && keys.len() == values.len());
        (self.keys, self.values) = (Arc::new(keys), Arc::new(values));
        self
    }

    pub(crate) fn keys(&self) -> &[u64] {
        &self.keys
    }

    pub(crate) fn values(&self) -> &[S] {
        &self.values
    }

    /// The key of a component, which is its position in the order of all indices.
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
