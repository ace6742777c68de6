//! Structure constants grouped by their first factor, for any type of numbers.

use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Scalar, Tensor};

/// For each `j`, the sorted list of constants `(k, i, c^i_jk)`, where `[e_j, e_k] = c^i_jk e_i`.
///
/// The numbers may be scalars of tensors, residues modulo a prime, integers, or floats. Some of
/// these types have no operators, so methods have the operation `sum + a b` as a parameter.
#[derive(Clone, Debug)]
pub(crate) struct SparseBracket<C> {
    by_first: Vec<Vec<(usize, usize, C)>>,
}

impl<C> SparseBracket<C> {
    /// The bracket on `R^n` with the constants `(j, k, i, c^i_jk)`. The list must contain both
    /// orders of `j` and `k`.
    pub fn new(n: usize, constants: impl IntoIterator<Item = (usize, usize, usize, C)>) -> Self {
        let mut by_first: Vec<Vec<_>> = (0..n).map(|_| vec![]).collect();
        for (j, k, i, value) in constants {
            by_first[j].push((k, i, value));
        }
        by_first.iter_mut().for_each(|line| line.sort_by_key(|&(k, i, _)| (k, i)));
        SparseBracket { by_first }
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.by_first.len()
    }

    /// The constants `(k, i, c^i_jk)` of `[e_j, .]`.
    pub fn of(&self, j: usize) -> &[(usize, usize, C)] {
        &self.by_first[j]
    }

    /// The same bracket over another type of numbers: `image` converts each constant. Returns
    /// `None` if a constant has no image.
    pub fn map<D>(&self, image: impl Fn(&C) -> Option<D>) -> Option<SparseBracket<D>> {
        let line = |line: &Vec<(usize, usize, C)>| {
            line.iter().map(|(k, i, value)| Some((*k, *i, image(value)?))).collect()
        };
        let by_first = self.by_first.iter().map(line).collect::<Option<_>>()?;
        Some(SparseBracket { by_first })
    }
}

impl<S: Scalar> SparseBracket<S> {
    /// The constants `c^i_jk` of a tensor.
    pub fn of_tensor(structure: &Tensor<S>) -> Self {
        let constants = structure.components();
        let constants = constants.map(|(at, value)| (at[1], at[2], at[0], value.clone()));
        Self::new(structure.dimension(), constants)
    }
}

impl<C: Copy + PartialEq> SparseBracket<C> {
    /// The bracket of two vectors. The function `fused(s, a, b)` computes `s + a b`.
    pub fn bracket(&self, x: &[C], y: &[C], zero: C, fused: impl Fn(C, C, C) -> C) -> Vec<C> {
        checkpoint();
        let mut sum = vec![zero; self.dimension()];
        for (line, &factor) in self.by_first.iter().zip(x).filter(|(_, factor)| **factor != zero) {
            for &(k, i, value) in line.iter().filter(|(k, ..)| y[*k] != zero) {
                sum[i] = fused(sum[i], fused(zero, factor, y[k]), value);
            }
        }
        sum
    }

    /// The rows of the Killing form `tr(ad_a ad_b)`. The function `fused(s, a, b)` computes
    /// `s + a b`.
    pub fn killing(&self, zero: C, fused: impl Fn(C, C, C) -> C) -> Vec<Vec<C>> {
        let n = self.dimension();
        let mut dense = vec![zero; n * n];
        let row = |a: usize| {
            checkpoint();
            self.of(a).iter().for_each(|&(k, i, value)| dense[k * n + i] = value);
            let entry = |b: usize| {
                self.of(b).iter().fold(zero, |sum, &(k, i, v)| fused(sum, v, dense[i * n + k]))
            };
            let entries = (0..n).map(entry).collect();
            self.of(a).iter().for_each(|&(k, i, _)| dense[k * n + i] = zero);
            entries
        };
        (0..n).map(row).collect()
    }
}
