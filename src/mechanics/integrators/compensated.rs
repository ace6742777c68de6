//! Compensated summation.

use nalgebra::SVector;

/// A sum, and the rounding error of the sum, which is added to the next term (W. Kahan, *Commun.
/// ACM* 8 (1965) 40). The sum of many small terms then has only the rounding errors of the terms.
///
/// Compensated summation in integrators is described by E. Hairer, R. I. McLachlan and A.
/// Razakarivony, *BIT* 48 (2008) 231-243; for rigid bodies, by G. Vilmart, *J. Comput. Phys.* 227
/// (2008) 7083-7088.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sum<const N: usize> {
    pub(super) value: SVector<f64, N>,
    rest: SVector<f64, N>,
}

impl<const N: usize> Sum<N> {
    pub(super) fn new(value: SVector<f64, N>) -> Self {
        Sum { value, rest: SVector::zeros() }
    }

    #[inline]
    pub(super) fn add(&mut self, term: &SVector<f64, N>) {
        let term = term + self.rest;
        let next = self.value + term;
        self.rest = (self.value - next) + term;
        self.value = next;
    }
}
