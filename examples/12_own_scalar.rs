//! How do I compute over a user-defined scalar type?
//!
//! Implement [`Ring`] and [`Field`], and name the accumulator of sums ([`Summable`]). In this
//! example, the scalars are the integers modulo a prime. The program finds the primes modulo which
//! the Killing form of sl(2) is a metric.

use affinor::tensors::scalar::{ExactSum, laws};
use affinor::tensors::{Field, Ring, Scalar, Summable, Tolerance};
use affinor::{Bracket, Connection, Error, LieAlgebra, Metric};
use num_traits::{One, Zero};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// An integer modulo a prime `P`, stored as a number from 0 to `P - 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modulo<const P: i64>(i64);

impl<const P: i64> fmt::Display for Modulo<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// Implements the operators, by value and by reference.
macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<const P: i64> $operator for Modulo<P> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Modulo($operator::$method(self.0, other.0).rem_euclid(P))
            }
        }
        impl<const P: i64> $operator<&Self> for Modulo<P> {
            type Output = Self;
            fn $method(self, other: &Self) -> Self {
                $operator::$method(self, *other)
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul);

impl<const P: i64> Neg for Modulo<P> {
    type Output = Self;
    fn neg(self) -> Self {
        Modulo((-self.0).rem_euclid(P))
    }
}

impl<const P: i64> Zero for Modulo<P> {
    fn zero() -> Self {
        Modulo(0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
}

impl<const P: i64> One for Modulo<P> {
    fn one() -> Self {
        Modulo(1)
    }
}

impl<const P: i64> Ring for Modulo<P> {
    fn from_i64(n: i64) -> Self {
        Modulo(n.rem_euclid(P))
    }
    fn vanishes(&self) -> bool {
        self.0 == 0
    }
}

impl<const P: i64> Summable for Modulo<P> {
    type Sum = ExactSum<Self>;
}

impl<const P: i64> Scalar for Modulo<P> {}

impl<const P: i64> Field for Modulo<P> {
    fn recip(&self) -> Option<Self> {
        (1..P).map(Modulo).find(|x| *x * *self == Self::one())
    }
    fn pivot_weight(&self) -> f64 {
        1.0
    }
}

/// The algebra sl(2): `[h, e] = 2 e`, `[h, f] = -2 f`, `[e, f] = h`.
fn sl2<S: Scalar>() -> Result<LieAlgebra<S>, Error> {
    LieAlgebra::try_from(Bracket::from_fn(&["e", "f", "h"], |j, k| match (j, k) {
        (0, 1) => vec![(2, S::one())],
        (0, 2) => vec![(0, S::from_i64(-2))],
        _ => vec![(1, S::from_i64(2))],
    })?)
}

/// The scalar curvature of the group whose metric is the Killing form.
fn curvature<const P: i64>() -> Result<Modulo<P>, Error> {
    let algebra = sl2::<Modulo<P>>()?;
    let killing = Metric::new(algebra.labels(), algebra.killing_form())?;
    Connection::levi_civita(algebra.left_frame(), &killing)?.scalar_curvature(&killing)
}

/// Computes the scalar curvature modulo three primes.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // the laws of a field test the implementation
    let [a, b, c] = [3, 5, 0].map(Modulo::<7>);
    laws::field(&a, &b, &c, Tolerance::default())?;

    // modulo 2, the Killing form K = 4 (e f + f e) + 8 h h is zero
    let refused = curvature::<2>().expect_err("the Killing form is zero");
    println!("modulo 2: {refused}");
    assert!(matches!(refused, Error::Degenerate { .. }));

    // the Ricci tensor is -K/4, so S = -3/4, which is 3 modulo 5 and 1 modulo 7
    println!("modulo 5: S = {}, modulo 7: S = {}", curvature::<5>()?, curvature::<7>()?);
    assert_eq!(curvature::<5>()? * Modulo(4), Modulo::from_i64(-3));
    assert_eq!(curvature::<7>()? * Modulo(4), Modulo::from_i64(-3));
    Ok(())
}
