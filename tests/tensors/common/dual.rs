//! Dual numbers as a scalar: a ring with non-units that are not zero.

use affinor_tensors::{Field, Ring, Scalar, Sum, Summable, Tolerance};
use num_dual::Dual64;
use num_traits::{One, Zero};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// Dual numbers of num-dual, whose own equality and zero test use the real part only. `WHOLE` says
/// whether ours use both parts.
#[derive(Clone, Copy, Debug)]
pub struct Dual<const WHOLE: bool>(pub Dual64);

impl<const W: bool> Dual<W> {
    pub fn new(re: f64, eps: f64) -> Self {
        Dual(Dual64::new(re, eps))
    }
}

impl<const W: bool> PartialEq for Dual<W> {
    fn eq(&self, other: &Self) -> bool {
        self.0.re == other.0.re && self.0.eps == other.0.eps
    }
}

impl<const W: bool> fmt::Display for Dual<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<const W: bool> Neg for Dual<W> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual(-self.0)
    }
}

macro_rules! dual_operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<const W: bool> $operator for Dual<W> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Dual($operator::$method(self.0, other.0))
            }
        }
        impl<const W: bool> $operator<&Self> for Dual<W> {
            type Output = Self;
            fn $method(self, other: &Self) -> Self {
                Dual($operator::$method(self.0, other.0))
            }
        }
    )*};
}
dual_operators!(Add add, Sub sub, Mul mul);

impl<const W: bool> Zero for Dual<W> {
    fn zero() -> Self {
        Self::new(0.0, 0.0)
    }
    fn is_zero(&self) -> bool {
        self.vanishes()
    }
}

impl<const W: bool> One for Dual<W> {
    fn one() -> Self {
        Self::new(1.0, 0.0)
    }
}

/// The sum of the wrapped numbers.
#[derive(Clone, Default)]
pub struct DualSum(<Dual64 as Summable>::Sum);

impl<const W: bool> Sum<Dual<W>> for DualSum {
    fn add_term(&mut self, a: &Dual<W>) {
        self.0.add_term(&a.0);
    }
    fn add_product(&mut self, a: &Dual<W>, b: &Dual<W>) {
        self.0.add_product(&a.0, &b.0);
    }
    fn finish(&self, tolerance: Tolerance) -> Option<Dual<W>> {
        self.0.finish(tolerance).map(Dual)
    }
}

impl<const W: bool> Ring for Dual<W> {
    fn from_i64(n: i64) -> Self {
        Self::new(n as f64, 0.0)
    }
    fn vanishes(&self) -> bool {
        if W { self.0.vanishes() } else { self.0.re == 0.0 }
    }
}

impl<const W: bool> Summable for Dual<W> {
    type Sum = DualSum;
}

impl<const W: bool> Scalar for Dual<W> {}

impl<const W: bool> Field for Dual<W> {
    fn recip(&self) -> Option<Self> {
        Field::recip(&self.0).map(Dual)
    }
    fn pivot_weight(&self) -> f64 {
        self.0.pivot_weight()
    }
}
