//! Denominators as products of powers of coprime factors.
//!
//! Factors are found when a polynomial is inverted. Sums and products then only compare factors and
//! add exponents, without a search for common divisors. A factor that is proved to be irreducible
//! is cancelled by trial division. Other factors are cancelled by greatest common divisors.

use super::super::Rational;
use super::factors::{self, Part};
use super::polynomial::{Polynomial, cofactors, constant, lowered, power, product, select};
use super::variable::{Variables, places, union};
use num_traits::One;
use polycore::{Monomial, Order, Poly};
use std::sync::Arc;

/// A primitive polynomial with a positive leading coefficient. It depends on each of its variables,
/// and none of them divides it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Factor {
    pub variables: Variables,
    pub polynomial: Polynomial,
    /// Whether the factor is known to be irreducible over the rationals.
    pub irreducible: bool,
}

/// Factors and their exponents. The factors are pairwise coprime.
pub(super) type Powers = Vec<(Arc<Factor>, u32)>;

/// A product of powers of variables and factors.
#[derive(Clone, Debug, Default)]
pub(super) struct Denominator {
    /// The exponent of each variable of the fraction. The list is empty if all exponents are zero.
    pub monomial: Box<[u32]>,
    pub factors: Powers,
}

impl Factor {
    /// The factor, as a polynomial in the variables that occur in it.
    pub fn new(variables: &Variables, polynomial: &Polynomial, irreducible: bool) -> Arc<Self> {
        let degrees = polynomial.degrees();
        let kept: Vec<usize> = (0..degrees.len()).filter(|&k| degrees[k] > 0).collect();
        let names = kept.iter().map(|&k| variables[k]).collect();
        let columns: Vec<_> = kept.into_iter().map(Some).collect();
        let polynomial = select(polynomial, &columns);
        Arc::new(Factor { variables: names, polynomial, irreducible })
    }

    /// The polynomial in other variables. They must include all variables on which it depends.
    pub fn over(&self, variables: &Variables) -> Polynomial {
        let places = places(&self.variables, variables);
        let column = |k| places.iter().position(|place| *place == k);
        let columns: Vec<_> = (0..variables.len()).map(column).collect();
        select(&self.polynomial, &columns)
    }
}

impl Denominator {
    pub fn is_one(&self) -> bool {
        self.monomial.is_empty() && self.factors.is_empty()
    }

    /// The exponent of the variable at the position `at`.
    pub fn exponent(&self, at: usize) -> u32 {
        self.monomial.get(at).copied().unwrap_or(0)
    }

    /// The factorization of a nonzero primitive polynomial with a positive leading coefficient.
    pub fn of(variables: &Variables, polynomial: &Polynomial) -> Self {
        let least = polynomial.min_exps();
        let rest = lowered(polynomial, &least);
        let mut factors: Powers = Vec::new();
        for Part { polynomial, irreducible } in factors::parts(&rest) {
            let factor = Factor::new(variables, &polynomial, irreducible);
            match factors.iter_mut().find(|(other, _)| *other == factor) {
                Some((_, exponent)) => *exponent += 1,
                None => factors.push((factor, 1)),
            }
        }
        let monomial = if least.is_one() { Box::default() } else { least.exps().into() };
        Denominator { monomial, factors: coprime(factors) }
    }

    /// The denominator, expanded into a sum of terms, in the variables of the fraction.
    pub fn expanded(&self, variables: &Variables) -> Polynomial {
        let exponents: Vec<u32> = (0..variables.len()).map(|at| self.exponent(at)).collect();
        let mut expanded = constant(Rational::one(), variables.len());
        for (factor, exponent) in &self.factors {
            expanded = product(&expanded, &power(&factor.over(variables), *exponent));
        }
        expanded.mul_term(&Rational::one(), &Monomial::new(exponents))
    }

    /// The variables and factors of the denominator. Each is returned as a separate denominator,
    /// with its exponent.
    pub fn parts(&self, variables: &Variables) -> Vec<(Self, u32)> {
        let single = |at: usize| {
            let exponents = (0..variables.len()).map(|other| u32::from(other == at));
            Denominator { monomial: exponents.collect(), factors: Vec::new() }
        };
        let monomial = self.monomial.iter().enumerate().filter(|(_, e)| **e > 0);
        let factor = |(factor, e): &(Arc<Factor>, u32)| {
            (Denominator { monomial: Box::default(), factors: vec![(factor.clone(), 1)] }, *e)
        };
        let singles = monomial.map(|(at, e)| (single(at), *e));
        singles.chain(self.factors.iter().map(factor)).collect()
    }

    /// The variables and factors, with their exponents. Returns `None` if a factor may be
    /// reducible.
    pub fn irreducible(&self, variables: &Variables) -> Option<Vec<(Polynomial, u32)>> {
        let known = self.factors.iter().all(|(factor, _)| factor.irreducible);
        known.then(|| self.all(variables))
    }

    /// The variables and factors, with their exponents.
    pub fn all(&self, variables: &Variables) -> Vec<(Polynomial, u32)> {
        let n = variables.len();
        let monomial = self.monomial.iter().enumerate().filter(|(_, e)| **e > 0);
        let singles = monomial.map(|(at, e)| (Poly::var(at, n, Order::GrLex), *e));
        let factor = |(factor, e): &(Arc<Factor>, u32)| (factor.over(variables), *e);
        singles.chain(self.factors.iter().map(factor)).collect()
    }

    /// An upper bound of the number of terms of the expanded product.
    pub fn terms(&self) -> u64 {
        let power =
            |(f, e): &(Arc<Factor>, u32)| (f.polynomial.terms.len() as u64).saturating_pow(*e);
        self.factors.iter().map(power).fold(1, u64::saturating_mul)
    }

    /// The denominator raised to a power.
    ///
    /// # Panics
    /// If an exponent exceeds `u32::MAX`.
    pub fn power(&self, exponent: u32) -> Self {
        let times = |e: u32| e.checked_mul(exponent).expect("an exponent passes u32::MAX");
        Denominator {
            monomial: self.monomial.iter().map(|e| times(*e)).collect(),
            factors: self.factors.iter().map(|(f, e)| (f.clone(), times(*e))).collect(),
        }
    }

    /// The total degree.
    pub fn degree(&self) -> u32 {
        let degrees = self.factors.iter().map(|(f, e)| f.polynomial.total_degree().checked_mul(*e));
        let monomial = self.monomial.iter().map(|e| Some(*e));
        let sum = degrees.chain(monomial).try_fold(0u32, |sum, d| sum.checked_add(d?));
        sum.expect("total degree of a denominator passes u32::MAX")
    }
}

impl PartialEq for Denominator {
    /// Compares two denominators of fractions with the same variables.
    fn eq(&self, other: &Self) -> bool {
        let found = |(factor, exponent): &(Arc<Factor>, u32)| {
            other.factors.iter().any(|(f, e)| e == exponent && f == factor)
        };
        if self.monomial != other.monomial {
            return false;
        }
        if self.factors.len() == other.factors.len() && self.factors.iter().all(found) {
            return true;
        }
        let irreducible = |d: &Self| d.factors.iter().all(|(factor, _)| factor.irreducible);
        if irreducible(self) && irreducible(other) {
            return false;
        }
        // multiplies the factors, because different factors may have equal products
        let names = self.factors.iter().chain(&other.factors).map(|(f, _)| &f.variables);
        let variables = names.fold(Variables::from([]), |all, names| union(&all, names));
        let [own, others] = [self, other].map(|d| {
            Denominator { monomial: Box::default(), factors: d.factors.clone() }
                .expanded(&variables)
        });
        own == others
    }
}

impl Eq for Denominator {}

/// The same product, written with pairwise coprime factors.
pub(super) fn coprime(factors: Powers) -> Powers {
    if factors.len() < 2 || factors.iter().all(|(factor, _)| factor.irreducible) {
        return factors;
    }
    let (originals, exponents): (Vec<_>, Vec<_>) = factors.into_iter().unzip();
    let (base, shares) = common_base(originals);
    let total =
        |at: usize| -> u32 { exponents.iter().zip(&shares).map(|(e, share)| e * share[at]).sum() };
    base.into_iter().enumerate().map(|(at, factor)| (factor, total(at))).collect()
}

/// Pairwise coprime factors of the given polynomials, and the exponents of these factors in each
/// polynomial.
pub(super) fn common_base(originals: Vec<Arc<Factor>>) -> (Vec<Arc<Factor>>, Vec<Vec<u32>>) {
    let count = originals.len();
    let unit = |at: usize| (0..count).map(|other| u32::from(other == at)).collect::<Vec<_>>();
    let mut work: Vec<(Arc<Factor>, Vec<u32>)> =
        originals.into_iter().enumerate().map(|(at, factor)| (factor, unit(at))).rev().collect();
    let mut base: Vec<(Arc<Factor>, Vec<u32>)> = Vec::new();
    'next: while let Some((factor, exponents)) = work.pop() {
        for at in 0..base.len() {
            let (other, shares) = &mut base[at];
            if *other == factor {
                shares.iter_mut().zip(&exponents).for_each(|(share, e)| *share += e);
                continue 'next;
            }
            if other.irreducible && factor.irreducible {
                continue;
            }
            let variables = union(&other.variables, &factor.variables);
            let (common, left, right) =
                cofactors(&other.over(&variables), &factor.over(&variables));
            if common.is_constant() {
                continue;
            }
            let (_, shares) = base.swap_remove(at);
            let both: Vec<u32> = shares.iter().zip(&exponents).map(|(a, b)| a + b).collect();
            for (part, exponents) in [(common, both), (left, shares), (right, exponents)] {
                for (factor, e) in Denominator::of(&variables, &part).factors {
                    work.push((factor, exponents.iter().map(|own| own * e).collect()));
                }
            }
            continue 'next;
        }
        base.push((factor, exponents));
    }
    let shares = |at: usize| base.iter().map(|(_, shares)| shares[at]).collect();
    let shares = (0..count).map(shares).collect();
    (base.into_iter().map(|(factor, _)| factor).collect(), shares)
}
