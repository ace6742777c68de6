//! Power series in several variables, known up to a total degree.

use super::residue::Residue;
use affinor_tensors::scalar::ExactSum;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Ring, Scalar, Summable};
use num_traits::{One, Zero};
use std::collections::HashMap;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};
use std::sync::Arc;

/// The monomials in `n` variables up to a total degree, sorted by degree.
pub struct Monomials {
    /// The exponents of each monomial.
    exponents: Vec<Vec<u8>>,
    /// The number of monomials up to each degree.
    up_to: Vec<usize>,
    /// The index of the product of a monomial with each variable; `usize::MAX` beyond the degree.
    raised: Vec<Vec<usize>>,
    /// The index of the product of two monomials, for the pairs within the degree.
    products: Vec<Vec<u32>>,
}

impl Monomials {
    /// The monomials in `n` variables up to `degree`.
    pub fn new(n: usize, degree: usize) -> Self {
        let mut exponents = vec![vec![0u8; n]];
        let mut up_to = vec![1];
        let mut from = 0;
        for _ in 0..degree {
            let last: Vec<Vec<u8>> = exponents[from..].to_vec();
            from = exponents.len();
            for monomial in last {
                // each monomial arises once: from the factor with the largest index
                let first = monomial.iter().rposition(|e| *e > 0).unwrap_or(0);
                for variable in first..n {
                    let mut next = monomial.clone();
                    next[variable] += 1;
                    exponents.push(next);
                }
            }
            up_to.push(exponents.len());
        }
        let index: HashMap<&[u8], usize> =
            exponents.iter().enumerate().map(|(at, e)| (e.as_slice(), at)).collect();
        let find = |e: &[u8]| index.get(e).copied().unwrap_or(usize::MAX);
        let raise = |e: &Vec<u8>, variable: usize| {
            let mut next = e.clone();
            next[variable] += 1;
            find(&next)
        };
        let raised = exponents.iter().map(|e| (0..n).map(|v| raise(e, v)).collect()).collect();
        let degree_of = |at: usize| up_to.partition_point(|count| *count <= at);
        let products = (0..exponents.len())
            .map(|a| {
                let others = &exponents[..up_to[degree - degree_of(a)]];
                let product = |e: &Vec<u8>| {
                    let sum: Vec<u8> = e.iter().zip(&exponents[a]).map(|(x, y)| x + y).collect();
                    find(&sum) as u32
                };
                others.iter().map(product).collect()
            })
            .collect();
        Monomials { raised, products, exponents, up_to }
    }

    /// The degree of a monomial.
    fn degree(&self, at: usize) -> usize {
        self.up_to.partition_point(|count| *count <= at)
    }
}

/// A power series around a point whose coefficients are known up to a total degree. A constant is
/// known to all degrees.
///
/// Its derivative is known to one degree less. Two series are combined up to the smaller of their
/// degrees. A formula of `k` derivatives of series of degree `k` has an exact constant term.
#[derive(Clone)]
pub struct PowerSeries {
    /// The coefficients in the order of the monomials, at least the first one.
    coefficients: Vec<Residue>,
    /// `None` for a constant.
    monomials: Option<Arc<Monomials>>,
}

impl PowerSeries {
    /// A constant.
    pub fn constant(value: Residue) -> Self {
        PowerSeries { coefficients: vec![value], monomials: None }
    }

    /// The series of degree `degree` with the constant term `value` and the given derivatives, as
    /// pairs of a variable and a series of one degree less. Derivatives that are left out vanish.
    pub fn from_derivatives(
        monomials: &Arc<Monomials>,
        degree: usize,
        value: Residue,
        derivatives: &[(usize, PowerSeries)],
    ) -> Self {
        let mut coefficients = vec![Residue::zero(); monomials.up_to[degree]];
        coefficients[0] = value;
        for (variable, derivative) in derivatives {
            for (at, coefficient) in derivative.coefficients.iter().enumerate() {
                let raised = monomials.raised[at][*variable];
                if raised < coefficients.len() && !coefficient.is_zero() {
                    let exponent = i64::from(monomials.exponents[raised][*variable]);
                    let inverse = Residue::from_quotient(1, exponent).unwrap_or_else(Zero::zero);
                    coefficients[raised] = *coefficient * inverse;
                }
            }
        }
        PowerSeries { coefficients, monomials: Some(monomials.clone()) }
    }

    /// The constant term.
    pub fn value(&self) -> Residue {
        self.coefficients[0]
    }

    /// The partial derivative with respect to a variable, from 0.
    pub fn derivative(&self, variable: usize) -> Self {
        let Some(monomials) = &self.monomials else { return Self::zero() };
        let degree = monomials.degree(self.coefficients.len() - 1);
        let known = monomials.up_to[degree.saturating_sub(1)];
        let coefficient = |at: usize| {
            let raised = monomials.raised[at][variable];
            let exponent = monomials.exponents.get(raised).map_or(0, |e| e[variable]);
            match self.coefficients.get(raised) {
                Some(coefficient) if !coefficient.is_zero() => {
                    *coefficient * Residue::from_i64(exponent.into())
                }
                _ => Residue::zero(),
            }
        };
        let coefficients = (0..known).map(coefficient).collect();
        PowerSeries { coefficients, monomials: Some(monomials.clone()) }
    }

    fn scaled(mut self, factor: &Residue) -> Self {
        for coefficient in self.coefficients.iter_mut().filter(|c| !c.is_zero()) {
            *coefficient = *coefficient * *factor;
        }
        self
    }
}

impl Add<&PowerSeries> for PowerSeries {
    type Output = PowerSeries;
    fn add(self, other: &PowerSeries) -> PowerSeries {
        let (mut longer, shorter) = match (&self.monomials, &other.monomials) {
            (None, Some(_)) => (other.clone(), &self),
            _ => (self.clone(), other),
        };
        if longer.monomials.is_some() && shorter.monomials.is_some() {
            longer.coefficients.truncate(shorter.coefficients.len());
        }
        for (a, b) in longer.coefficients.iter_mut().zip(&shorter.coefficients) {
            *a = *a + *b;
        }
        longer
    }
}

impl Add for PowerSeries {
    type Output = PowerSeries;
    fn add(self, other: PowerSeries) -> PowerSeries {
        self + &other
    }
}

impl Sub<&PowerSeries> for PowerSeries {
    type Output = PowerSeries;
    fn sub(self, other: &PowerSeries) -> PowerSeries {
        self + &-other.clone()
    }
}

impl Neg for PowerSeries {
    type Output = PowerSeries;
    fn neg(mut self) -> PowerSeries {
        self.coefficients.iter_mut().for_each(|coefficient| *coefficient = -*coefficient);
        self
    }
}

impl Mul<&PowerSeries> for PowerSeries {
    type Output = PowerSeries;
    fn mul(self, other: &PowerSeries) -> PowerSeries {
        let monomials = match (&self.monomials, &other.monomials) {
            (Some(monomials), Some(_)) => monomials,
            (None, _) => return other.clone().scaled(&self.value()),
            (_, None) => return self.scaled(&other.value()),
        };
        checkpoint();
        let length = self.coefficients.len().min(other.coefficients.len());
        let nonzero = |series: &PowerSeries| -> Vec<(usize, Residue)> {
            let known = series.coefficients[..length].iter().copied().enumerate();
            known.filter(|(_, coefficient)| !coefficient.is_zero()).collect()
        };
        let (left, right) = (nonzero(&self), nonzero(other));
        let mut coefficients = vec![Residue::zero(); length];
        for (at, a) in &left {
            let products = &monomials.products[*at];
            for (j, b) in &right {
                match products.get(*j) {
                    Some(place) if (*place as usize) < length => {
                        let sum = &mut coefficients[*place as usize];
                        *sum = *sum + *a * *b;
                    }
                    _ => break,
                }
            }
        }
        PowerSeries { coefficients, monomials: Some(monomials.clone()) }
    }
}

impl Mul for PowerSeries {
    type Output = PowerSeries;
    fn mul(self, other: PowerSeries) -> PowerSeries {
        self * &other
    }
}

impl Zero for PowerSeries {
    fn zero() -> Self {
        Self::constant(Residue::zero())
    }
    fn is_zero(&self) -> bool {
        self.coefficients.iter().all(Residue::is_zero)
    }
}

impl One for PowerSeries {
    fn one() -> Self {
        Self::constant(Residue::one())
    }
}

impl PartialEq for PowerSeries {
    fn eq(&self, other: &Self) -> bool {
        (self.clone() - other).is_zero()
    }
}

impl Ring for PowerSeries {
    fn from_i64(n: i64) -> Self {
        Self::constant(Residue::from_i64(n))
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        Residue::from_quotient(numerator, denominator).map(Self::constant)
    }
}

impl Summable for PowerSeries {
    type Sum = ExactSum<Self>;
}

impl Scalar for PowerSeries {}

/// A local ring: the units are the series whose constant term is not zero.
impl Field for PowerSeries {
    fn recip(&self) -> Option<Self> {
        let inverse = self.value().recip()?;
        let Some(monomials) = &self.monomials else { return Some(Self::constant(inverse)) };
        // 1/(1 - x) = 1 + x (1 + x (1 + ...))
        let mut x = -self.clone().scaled(&inverse);
        x.coefficients[0] = Residue::zero();
        let degree = monomials.degree(self.coefficients.len() - 1);
        let mut sum = Self::one();
        for _ in 0..degree {
            sum = sum * &x + &Self::one();
        }
        Some(sum.scaled(&inverse))
    }
    fn pivot_weight(&self) -> f64 {
        if self.value().is_zero() { -1.0 } else { 0.0 }
    }
}

/// Writes the constant term.
impl fmt::Display for PowerSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value().fmt(f)
    }
}

impl fmt::Debug for PowerSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
