//! The dual numbers of the crate num-dual as a scalar: `a + b eps` with `eps^2 = 0`.

use super::float::FloatSum;
use super::{Field, Ring, Sum, Summable, Tolerance};
use num_dual::{Dual64, DualNum};

/// The sums of the real parts and of the coefficients of `eps`.
#[derive(Clone, Copy, Debug, Default)]
pub struct DualSum(FloatSum, FloatSum);

impl Sum<Dual64> for DualSum {
    fn add_term(&mut self, a: &Dual64) {
        self.0.add_term(&a.re);
        self.1.add_term(&a.eps);
    }
    fn add_product(&mut self, a: &Dual64, b: &Dual64) {
        self.0.add_product(&a.re, &b.re);
        self.1.add_product(&a.re, &b.eps);
        self.1.add_product(&a.eps, &b.re);
    }
    fn finish(&self, tolerance: Tolerance) -> Option<Dual64> {
        let (re, eps) = (self.0.finish(tolerance), self.1.finish(tolerance));
        (re.is_some() || eps.is_some()).then(|| Dual64::new(re.unwrap_or(0.0), eps.unwrap_or(0.0)))
    }
}

/// A dual number is zero if its real part and its `eps` part are zero. The operator `==` of
/// num-dual compares only real parts.
impl Ring for Dual64 {
    fn from_i64(n: i64) -> Self {
        Dual64::new(n as f64, 0.0)
    }
    fn vanishes(&self) -> bool {
        self.re == 0.0 && self.eps == 0.0
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        f64::from_quotient(numerator, denominator).map(|re| Dual64::new(re, 0.0))
    }
}

impl Summable for Dual64 {
    type Sum = DualSum;
    fn is_number(&self) -> bool {
        self.re.is_finite() && self.eps.is_finite()
    }
}

/// The non-units of this ring are the numbers whose real part is zero.
impl Field for Dual64 {
    fn recip(&self) -> Option<Self> {
        Field::recip(&self.re).map(|_| DualNum::recip(self))
    }
    fn pivot_weight(&self) -> f64 {
        self.re.abs()
    }
}
