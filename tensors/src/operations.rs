//! Operations on the slots of one tensor: traces, symmetrization, raising and lowering.
//!
//! Slots count from 0. Each operation calls [`contract`] with a notation that is built from the
//! slots.

use crate::contraction::indices;
use crate::{Down, Field, Scalar, Tensor, TensorError, Up, Variance, contract};

/// The index letters of the slots, in order.
const LETTERS: &str = "abcdefgh";
/// The index letter of a summed index.
const SUMMED: char = 'p';

impl<S: Scalar> Tensor<S> {
    /// The trace `T^p_p` over an upper and a lower slot. The other slots remain in the same order.
    ///
    /// ```
    /// use affinor_tensors::{Rational, Tensor};
    /// let delta = Tensor::<Rational>::identity(3);
    /// assert_eq!(delta.trace(0, 1)?.to_scalar(), Some(Rational::from(3)));
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// [`TensorError::Slots`] unless `a` and `b` are two slots of this tensor;
    /// [`TensorError::Notation`] if both are upper, or both are lower.
    pub fn trace(&self, a: usize, b: usize) -> Result<Self, TensorError> {
        self.distinct(&[a, b])?;
        let mut letters = self.letters();
        (letters[a].0, letters[b].0) = (SUMMED, SUMMED);
        let kept = letters.iter().filter(|(letter, _)| *letter != SUMMED);
        let (result, operand) = (indices(kept.copied()), indices(letters.iter().copied()));
        contract(&format!("T{operand} -> {result}"), &[("T", self)])
    }

    /// Lowers the upper slot `slot`, which remains at its position: `g_ap T^p`, where `g` is a
    /// metric with the slots `[Down, Down]`.
    ///
    /// # Errors
    /// [`TensorError::Slots`] unless `slot` is a slot of this tensor; [`TensorError::Notation`]
    /// unless it is upper and `metric` has two lower slots; [`TensorError::Dimension`].
    pub fn lower(&self, slot: usize, metric: &Self) -> Result<Self, TensorError> {
        self.shift(slot, metric, Down)
    }

    /// Raises the lower slot `slot`, which remains at its position: `g^ap T_p`, where `g` is an
    /// inverse metric with the slots `[Up, Up]`.
    ///
    /// # Errors
    /// [`TensorError::Slots`] unless `slot` is a slot of this tensor; [`TensorError::Notation`]
    /// unless it is lower and `inverse_metric` has two upper slots; [`TensorError::Dimension`].
    pub fn raise(&self, slot: usize, inverse_metric: &Self) -> Result<Self, TensorError> {
        self.shift(slot, inverse_metric, Up)
    }

    /// Raises or lowers one slot to the variance `to`. The metric must have two slots of this
    /// variance.
    fn shift(&self, slot: usize, metric: &Self, to: Variance) -> Result<Self, TensorError> {
        self.distinct(&[slot])?;
        let (mut operand, mut result) = (self.letters(), self.letters());
        let letter = result[slot].0;
        operand[slot].0 = SUMMED;
        result[slot].1 = to;
        let metric_indices = indices([(letter, to), (SUMMED, to)]);
        let (operand, result) = (indices(operand), indices(result));
        let text = format!("g{metric_indices} T{operand} -> {result}");
        contract(&text, &[("g", metric), ("T", self)])
    }

    /// The sum (`sign` is `+`) or the difference (`sign` is `-`) of two tensors of the same shape.
    pub(crate) fn combined(&self, sign: char, other: &Self) -> Result<Self, TensorError> {
        let own = indices(self.letters());
        contract(&format!("a{own} {sign} b{own} -> {own}"), &[("a", self), ("b", other)])
    }

    /// The index letters of the slots, with their variances.
    fn letters(&self) -> Vec<(char, Variance)> {
        LETTERS.chars().zip(self.slots().iter().copied()).collect()
    }

    /// Checks that `slots` are different slots of this tensor.
    fn distinct(&self, slots: &[usize]) -> Result<(), TensorError> {
        let rank = self.rank();
        let valid = |(at, slot): (usize, &usize)| *slot < rank && !slots[..at].contains(slot);
        let all = slots.iter().enumerate().all(valid);
        all.then_some(()).ok_or_else(|| TensorError::Slots { slots: slots.to_vec(), rank })
    }
}

impl<S: Field + Scalar> Tensor<S> {
    /// The part of the tensor that is symmetric in `slots`. It is the mean over all orders of their
    /// indices, such as `T_(ab) = (T_ab + T_ba)/2`.
    ///
    /// # Errors
    /// [`TensorError::Slots`] unless `slots` are different slots of this tensor;
    /// [`TensorError::Notation`] if some are upper and some are lower.
    /// [`TensorError::NotInvertible`] if `k!` has no inverse in the field, where `k` is the number
    /// of slots.
    pub fn symmetrise(&self, slots: &[usize]) -> Result<Self, TensorError> {
        self.mean(slots, '+')
    }

    /// The part of the tensor that is antisymmetric in `slots`. It is the signed mean over all
    /// orders of their indices, such as `T_[ab] = (T_ab - T_ba)/2`.
    ///
    /// ```
    /// use affinor_tensors::{Down, Rational, Tensor};
    /// let t = Tensor::from_fn(2, [Down, Down], |[i, j]| Rational::from((2 * i + j) as i64))?;
    /// assert_eq!(t.antisymmetrise(&[0, 1])?.get(&[0, 1]).to_string(), "-1/2");
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`symmetrise`](Self::symmetrise).
    pub fn antisymmetrise(&self, slots: &[usize]) -> Result<Self, TensorError> {
        self.mean(slots, '-')
    }

    /// The mean over all permutations of the `k` indices in `slots`. If `sign` is `-`, every
    /// exchange of two indices changes the sign of the term.
    fn mean(&self, slots: &[usize], sign: char) -> Result<Self, TensorError> {
        self.distinct(slots)?;
        let orders = (1..=slots.len() as i64).product();
        let weight = S::from_i64(orders).recip().ok_or(TensorError::NotInvertible(orders))?;
        let letters = self.letters();
        let result = indices(letters.iter().copied());
        let mut sum = self.clone();
        // a permutation of k slots is a permutation of the first k - 1 slots, followed by at most
        // one exchange with the last slot
        for (behind, &last) in slots.iter().enumerate() {
            let mut text = format!("T{result}");
            for &slot in &slots[..behind] {
                let mut exchanged = letters.clone();
                (exchanged[slot].0, exchanged[last].0) = (letters[last].0, letters[slot].0);
                text += &format!(" {sign} T{}", indices(exchanged));
            }
            sum = contract(&format!("{text} -> {result}"), &[("T", &sum)])?;
        }
        Ok(sum.scale(&weight))
    }
}
