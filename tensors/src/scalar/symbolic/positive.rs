//! Square roots and logarithms of functions that are positive.
//!
//! `sqrt(f g)` is `sqrt(f) sqrt(g)` where `f` and `g` are positive, and not where both are negative. So arguments are split
//! into irreducible factors, each with the sign with which it is positive: declared, or the only sign that makes the
//! argument positive.

use super::denominator::Denominator;
use super::elementary::Variable::{self, Free, Parameter};
use super::polynomial::primitive;
use super::{Form, Symbolic};
use crate::Rational;
use crate::scalar::{Field, Notation, Ring};
use num_integer::Roots;
use num_rational::Ratio;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// Primes above are not searched.
const MAX_PRIME: u64 = 1 << 21;

/// Functions that are declared to be positive, and what follows from that for their factors.
///
/// ```
/// use affinor_tensors::scalar::PositiveFactors;
/// use affinor_tensors::Symbolic;
/// let mut positive = PositiveFactors::default();
/// positive.declare(&"r".parse()?)?;
/// // then r - 2*M is positive, too
/// positive.declare(&"1 - 2*M/r".parse()?)?;
/// let root = positive.function("sqrt", &"4*r^2*(r - 2*M)".parse()?)?;
/// assert_eq!(root.to_string(), "2*r*sqrt(-2*M + r)");
/// assert!(positive.function("sqrt", &"a*b".parse()?).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct PositiveFactors {
    /// Primitive irreducible polynomials; the first coefficient may be negative.
    factors: Vec<Symbolic>,
}

/// A positive number times powers of positive polynomials.
struct Oriented {
    content: Rational,
    factors: Vec<(Symbolic, i64)>,
}

impl PositiveFactors {
    /// Adds a function.
    ///
    /// # Errors
    /// Unless it is a polynomial or a quotient of parameters, its irreducible factors are found, the sign of
    /// one of them at most is open, and it is not negative already.
    pub fn declare(&mut self, function: &Symbolic) -> Result<(), String> {
        let Oriented { factors, .. } = self.oriented("a positive function", function, true)?;
        let new = factors.into_iter().filter(|(_, e)| e % 2 != 0).map(|(factor, _)| factor);
        let new: Vec<_> = new.filter(|factor| !self.factors.contains(factor)).collect();
        self.factors.extend(new);
        Ok(())
    }

    /// The functions with values of their parameters, which have to leave them positive, as far as the signs of their terms
    /// show it.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// use affinor_tensors::Symbolic;
    /// let mut positive = PositiveFactors::default();
    /// positive.declare(&"a - r".parse()?)?;
    /// positive.declare(&"r".parse()?)?;
    /// let value = |a: i64| [("a".to_string(), Symbolic::from(a))].into();
    /// assert!(positive.with_values(&value(2))?.function("sqrt", &"(2 - r)^2".parse()?).is_ok());
    /// let refused = positive.with_values(&value(-1)).unwrap_err();
    /// assert_eq!(refused, "a - r is declared positive, and becomes -r - 1");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// In words: a function becomes zero, or a sum of negative terms.
    pub fn with_values(&self, values: &BTreeMap<String, Symbolic>) -> Result<Self, String> {
        let images = self.factors.iter().map(|factor| (factor, factor.substitute(values)));
        let images: Vec<_> = images.filter_map(|(factor, image)| Some((factor, image?))).collect();
        let is_positive = |name: &str| {
            let variable = Symbolic::parameter(name);
            images.iter().any(|(_, image)| *image == variable)
        };
        for (factor, image) in &images {
            let terms = image.numerator_terms();
            let negative = terms.iter().all(|(powers, coefficient)| {
                coefficient.is_negative()
                    && powers.iter().all(|(name, power)| power % 2 == 0 || is_positive(name))
            });
            if negative && image.denominator() == Symbolic::one() {
                return Err(format!("{factor} is declared positive, and becomes {image}"));
            }
        }
        let mut there = Self::default();
        // where the factors of an image are not known, nothing is
        images.iter().for_each(|(_, image)| drop(there.declare(image)));
        Ok(there)
    }

    /// As [`Symbolic::substitute`], with square roots and logarithms where these functions are positive.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// use affinor_tensors::Symbolic;
    /// let mut positive = PositiveFactors::default();
    /// let root = positive.function("sqrt", &"r^2 + a".parse()?)?;
    /// let values = [("a".to_string(), Symbolic::from(0))].into();
    /// let refused = positive.substitute(&root, &values).unwrap_err();
    /// assert_eq!(refused, "the argument of sqrt has factors of unknown sign: declare which are positive, of r");
    /// positive.declare(&"r".parse()?)?;
    /// assert_eq!(positive.substitute(&root, &values)?.to_string(), "r");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// In words, where [`Symbolic::substitute`] has no value.
    pub fn substitute(
        &self,
        value: &Symbolic,
        values: &BTreeMap<String, Symbolic>,
    ) -> Result<Symbolic, String> {
        value.substitute_where(self, values)
    }

    /// A function of an argument; `sqrt` and `log` where these functions are positive.
    ///
    /// # Errors
    /// In words: an unknown function, or an argument of which it has no exact value.
    pub fn function(&self, name: &str, argument: &Symbolic) -> Result<Symbolic, String> {
        match name {
            "sqrt" if argument.is_zero() => Ok(Symbolic::zero()),
            "sqrt" => self.root(argument),
            "log" => self.logarithm(argument),
            _ => Symbolic::function_of_sum(name, argument),
        }
    }

    fn root(&self, argument: &Symbolic) -> Result<Symbolic, String> {
        let powers = self.powers("sqrt", argument)?.into_iter();
        let root = |product: Symbolic, (factor, e): (Symbolic, i64)| {
            let variable = Symbolic::parameter(&format!("sqrt({factor})"));
            let product = product * &power(&factor, e.div_euclid(2));
            if e % 2 == 0 { product } else { product * &variable }
        };
        Ok(powers.fold(Symbolic::one(), root))
    }

    fn logarithm(&self, argument: &Symbolic) -> Result<Symbolic, String> {
        let powers = self.powers("log", argument)?.into_iter();
        let term = |sum: Symbolic, (factor, e): (Symbolic, i64)| {
            sum + &(Symbolic::parameter(&format!("log({factor})")) * &Symbolic::from_i64(e))
        };
        Ok(powers.fold(Symbolic::zero(), term))
    }

    /// The primes and the positive polynomials in the argument of a function, with their exponents.
    fn powers(&self, function: &str, argument: &Symbolic) -> Result<Vec<(Symbolic, i64)>, String> {
        let what = format!("the argument of {function}");
        let Oriented { content, factors } = self.oriented(&what, argument, false)?;
        let primes = prime_powers(function, &content)?.into_iter();
        Ok(primes.map(|(p, e)| (Symbolic::constant(p.into()), e)).chain(factors).collect())
    }

    /// The factors of a positive function, each positive. Where the function is `declared`, squares of factors of
    /// unknown sign are left out.
    fn oriented(&self, what: &str, value: &Symbolic, declared: bool) -> Result<Oriented, String> {
        let (mut content, factors) = factors(what, value)?;
        let mut oriented = Vec::new();
        let mut open = Vec::new();
        for (factor, e) in factors {
            let negative = -factor.clone();
            if self.factors.contains(&factor) {
                oriented.push((factor, e));
            } else if self.factors.contains(&negative) {
                if e % 2 != 0 {
                    content = -content;
                }
                oriented.push((negative, e));
            } else if e % 2 != 0 || !declared {
                open.push((factor, e));
            }
        }
        match &open[..] {
            [] if content.is_negative() => Err(format!(
                "{what} is negative: {value}{}",
                if self.factors.is_empty() { "" } else { ", by the functions declared positive" }
            )),
            [] => Ok(Oriented { content, factors: oriented }),
            [(factor, e)] if e % 2 != 0 => {
                let positive = if content.is_negative() { -factor.clone() } else { factor.clone() };
                oriented.push((positive, *e));
                Ok(Oriented { content: content.abs(), factors: oriented })
            }
            open => {
                let names: Vec<String> =
                    open.iter().map(|(factor, _)| factor.to_string()).collect();
                Err(format!(
                    "{what} has factors of unknown sign: declare which are positive, of {}",
                    names.join(", ")
                ))
            }
        }
    }
}

/// The content and the irreducible factors of a polynomial or quotient of parameters.
fn factors(what: &str, value: &Symbolic) -> Result<(Rational, Vec<(Symbolic, i64)>), String> {
    let f = match &value.0 {
        Form::Constant(c) if c.is_zero() => return Err(format!("{what} is zero")),
        Form::Constant(c) => return Ok((c.clone(), Vec::new())),
        Form::Fraction(f) => f,
    };
    if f.variables.iter().any(|name| !matches!(Variable::of(name), Parameter | Free(_))) {
        return Err(format!("{what} contains a function, and may be a quotient of polynomials"));
    }
    let (content, above) = primitive(&f.numerator);
    let above = Denominator::of(&f.variables, &above);
    let mut all = Vec::new();
    for (part, sign) in [(&above, 1), (&f.denominator, -1)] {
        let found = part.irreducible(&f.variables);
        let found = found.ok_or_else(|| format!("the factors of {what} are not found: {value}"))?;
        let signed = |(p, e)| (f.polynomial(&p), i64::from(e) * sign);
        all.extend(found.into_iter().map(signed));
    }
    Ok((content, all))
}

fn power(value: &Symbolic, exponent: i64) -> Symbolic {
    let power = num_traits::pow(value.clone(), exponent.unsigned_abs() as usize);
    if exponent < 0 { power.recip().unwrap_or_default() } else { power }
}

/// The prime factors of a positive number.
fn prime_powers(function: &str, value: &Rational) -> Result<Vec<(i64, i64)>, String> {
    let large = || format!("the number {value} in the argument of {function} is too large");
    let value = Ratio::<i64>::try_from(value).map_err(|_| large())?;
    let mut all = Vec::new();
    for (number, sign) in [(*value.numer(), 1), (*value.denom(), -1)] {
        let mut rest = number.unsigned_abs();
        let mut prime = 2;
        while prime * prime <= rest && prime <= MAX_PRIME {
            let mut e = 0;
            while rest.is_multiple_of(prime) {
                rest /= prime;
                e += sign;
            }
            all.extend((e != 0).then_some((prime as i64, e)));
            prime += 1;
        }
        let root = rest.sqrt();
        match rest {
            1 => {}
            _ if prime * prime > rest => all.push((rest as i64, sign)),
            // a square of a prime, because it has no factor below its cube root
            _ if root * root == rest => all.push((root as i64, 2 * sign)),
            _ => return Err(large()),
        }
    }
    Ok(all)
}
