//! Roots, logarithms and powers of positive functions.
//!
//! The root `sqrt(f g)` is `sqrt(f) sqrt(g)` if `f` and `g` are positive, but not if both are
//! negative. Therefore, arguments are split into irreducible factors, each with the sign that makes
//! it positive. The sign may be declared. Otherwise, it is inferred if all terms are positive, or
//! if only one sign makes the argument positive.

use super::denominator::Denominator;
use super::elementary::function_of_sum;
use super::polynomial::primitive;
use super::substitution::Substitution;
use super::variable::{Kind, Part, Variable};
use super::{Form, Symbolic};
use crate::Rational;
use crate::expression::{MAX_EXPONENT, MAX_SIZE};
use crate::scalar::{Field, Notation, Ring};
use num_integer::Roots;
use num_rational::Ratio;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// The largest prime for which a number is searched for prime factors.
const MAX_PRIME: u64 = 1 << 21;

/// Functions that are declared to be positive, and the resulting signs of their factors.
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
    /// Primitive irreducible polynomials. The first coefficient may be negative.
    factors: Vec<Symbolic>,
}

/// The product of a positive number and powers of positive polynomials.
struct Oriented {
    content: Rational,
    factors: Vec<(Symbolic, i64)>,
}

impl PositiveFactors {
    /// Declares that a function is positive.
    ///
    /// # Errors
    /// A message unless the function is a polynomial or a quotient in parameters, and its
    /// irreducible factors are found. At most one factor may have an unknown sign. A function that
    /// is already negative is an error too.
    pub fn declare(&mut self, function: &Symbolic) -> Result<(), String> {
        let Oriented { factors, .. } = self.oriented("a positive function", function, true)?;
        let new = factors.into_iter().filter(|(_, e)| e % 2 != 0).map(|(factor, _)| factor);
        let new: Vec<_> = new.filter(|factor| !self.factors.contains(factor)).collect();
        self.factors.extend(new);
        Ok(())
    }

    /// The irreducible factors that are positive, by the declarations.
    pub fn factors(&self) -> &[Symbolic] {
        &self.factors
    }

    /// Whether the signs of the terms and the declarations show that a function is positive.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// let mut positive = PositiveFactors::default();
    /// assert!(positive.show(&"1 + r^2".parse()?) && !positive.show(&"r".parse()?));
    /// positive.declare(&"r".parse()?)?;
    /// assert!(positive.show(&"r + r^3".parse()?));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn show(&self, function: &Symbolic) -> bool {
        self.is_positive(&function.numerator()) && self.is_positive(&function.denominator())
    }

    /// The declared functions after a substitution of parameters. The resulting functions must
    /// still be positive, as far as the signs of their terms show.
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
    /// assert_eq!(refused, "a - r is declared positive, but becomes -r - 1");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if a function becomes zero, or becomes a sum of negative terms.
    pub fn with_values(&self, values: &BTreeMap<String, Symbolic>) -> Result<Self, String> {
        let images = self.factors.iter().map(|factor| (factor, factor.substitute(values)));
        let images: Vec<_> = images.filter_map(|(factor, image)| Some((factor, image?))).collect();
        let mut positive = Self::default();
        let variables = images.iter().map(|(_, image)| image.clone());
        positive.factors.extend(variables.filter(|image| image.as_variable().is_some()));
        for (factor, image) in &images {
            let negative = || positive.has_positive_terms(&-image.clone());
            if image.is_zero() || image.denominator() == Symbolic::one() && negative() {
                return Err(format!("{factor} is declared positive, but becomes {image}"));
            }
        }
        let mut there = Self::default();
        // ignores errors: images whose factors are unknown are not declared
        images.iter().for_each(|(_, image)| drop(there.declare(image)));
        Ok(there)
    }

    /// Substitutes as in [`Symbolic::substitute`], but square roots and logarithms are evaluated
    /// under the assumption that the declared functions are positive.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// use affinor_tensors::Symbolic;
    /// let mut positive = PositiveFactors::default();
    /// let root = positive.function("sqrt", &"r^2 + a".parse()?)?;
    /// let values = [("a".to_string(), Symbolic::from(0))].into();
    /// let refused = positive.substitute(&root, &values).unwrap_err();
    /// assert_eq!(refused, "the argument of sqrt has factors of unknown sign: declare the positive ones among r");
    /// positive.declare(&"r".parse()?)?;
    /// assert_eq!(positive.substitute(&root, &values)?.to_string(), "r");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if [`Symbolic::substitute`] has no value.
    pub fn substitute(
        &self,
        value: &Symbolic,
        values: &BTreeMap<String, Symbolic>,
    ) -> Result<Symbolic, String> {
        value.substitute_where(self, &Substitution::from(values))
    }

    /// The value of a function at an argument. The functions `sqrt` and `log` are evaluated under
    /// the assumption that the declared functions are positive.
    ///
    /// # Errors
    /// A message if the function is unknown, or has no exact value at this argument.
    pub fn function(&self, name: &str, argument: &Symbolic) -> Result<Symbolic, String> {
        match name {
            "sqrt" => self.root(argument, 2),
            "log" => self.logarithm(argument),
            _ => function_of_sum(name, argument),
        }
    }

    /// The power `base^exponent`. It is a root if the exponent is rational, and
    /// `exp(exponent*log(base))` if the exponent contains parameters.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// use affinor_tensors::Symbolic;
    /// let power = PositiveFactors::default().power(&"t".parse()?, &"2*p + 1".parse()?)?;
    /// assert_eq!(power.to_string(), "t*t^(2*p)");
    /// assert_eq!(power.derivative("t").to_string(), "t^(2*p)*(2*p + 1)");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if the sign of the base is unknown, or if the power is too large.
    pub fn power(&self, base: &Symbolic, exponent: &Symbolic) -> Result<Symbolic, String> {
        let Some(number) = exponent.as_constant() else {
            let logarithm = self.logarithm(base)?;
            return function_of_sum("exp", &(exponent.clone() * &logarithm));
        };
        let number = Ratio::<i64>::try_from(number).ok();
        let small =
            number.filter(|n| n.numer().abs() <= MAX_EXPONENT && *n.denom() <= MAX_EXPONENT);
        let Some(number) = small else {
            return Err(format!(
                "the numerator and denominator of an exponent must be at most {MAX_EXPONENT}"
            ));
        };
        let root = match u32::try_from(*number.denom()) {
            Ok(1) => base.clone(),
            Ok(n) => self.root(base, n)?,
            Err(_) => return Err("the denominator of an exponent must be positive".into()),
        };
        let exponent = *number.numer();
        if root.size().saturating_mul(exponent.unsigned_abs() as usize) > MAX_SIZE {
            return Err(format!("the value grows beyond the limit of {MAX_SIZE}"));
        }
        if root.is_zero() && exponent < 0 {
            return Err("division by zero".into());
        }
        Ok(power(&root, exponent))
    }

    /// The power as in [`power`](Self::power), for an exponent with parameters. If the signs of the
    /// base and its variables are unknown, they are assumed to be positive, and are declared
    /// positive for later calls.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// let mut positive = PositiveFactors::default();
    /// let power = positive.assumed_power(&"1 - 2*m/r".parse()?, &"p".parse()?)?;
    /// assert_eq!(power.to_string(), "(-2*m + r)^p/r^p");
    /// assert_eq!(positive.function("sqrt", &"r^2 - 2*m*r".parse()?)?.to_string(), "sqrt(-2*m + r)*sqrt(r)");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`power`](Self::power), if the signs of several sums are unknown.
    pub fn assumed_power(
        &mut self,
        base: &Symbolic,
        exponent: &Symbolic,
    ) -> Result<Symbolic, String> {
        let refused = match self.power(base, exponent) {
            Ok(power) => return Ok(power),
            Err(reason) => reason,
        };
        if exponent.as_constant().is_some() {
            return Err(refused);
        }
        self.assuming(base, refused, |assumed| assumed.power(base, exponent))
    }

    /// The square root. Squares are taken out first; they may contain any functions. If the signs
    /// of the other factors and their variables are unknown, they are assumed to be positive, and are
    /// declared positive for later calls.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// let mut positive = PositiveFactors::default();
    /// assert_eq!(positive.assumed_root(&"1 - 2*m/r".parse()?)?.to_string(), "sqrt(-2*m + r)/sqrt(r)");
    /// // now 2*m - r is negative
    /// assert!(positive.assumed_root(&"2*m - r".parse()?).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if the signs of several sums are unknown, or if the argument is negative.
    pub fn assumed_root(&mut self, argument: &Symbolic) -> Result<Symbolic, String> {
        let square = argument.square_factor();
        let rest = square.recip().map(|inverse| argument.clone() * &inverse * &inverse);
        let rest = rest.unwrap_or_default();
        let root = match self.root(&rest, 2) {
            Ok(root) => {
                // a root of one factor of unknown sign assumes that the factor is positive; roots of
                // functions without factors assume nothing
                let _ = self.declare(&rest);
                root
            }
            Err(refused) => self.assuming(&rest, refused, |assumed| assumed.root(&rest, 2))?,
        };
        Ok(square * &root)
    }

    /// Evaluates a function of a base that is declared positive together with its variables. If
    /// this fails, the declarations remain as they were.
    fn assuming(
        &mut self,
        base: &Symbolic,
        refused: String,
        value: impl Fn(&Self) -> Result<Symbolic, String>,
    ) -> Result<Symbolic, String> {
        let mut assumed = self.clone();
        let Ok((_, factors)) = factors("a base", base) else { return Err(refused) };
        for (factor, _) in factors.iter().filter(|(factor, _)| factor.as_variable().is_some()) {
            assumed.declare(factor).map_err(|_| refused.clone())?;
        }
        assumed.declare(base).map_err(|_| refused.clone())?;
        let value = value(&assumed).map_err(|_| refused)?;
        *self = assumed;
        Ok(value)
    }

    /// The root `argument^(1/n)`.
    ///
    /// # Errors
    /// A message if the sign of a factor is unknown.
    pub(super) fn root(&self, argument: &Symbolic, n: u32) -> Result<Symbolic, String> {
        if argument.is_zero() {
            return Ok(Symbolic::zero());
        }
        let name = if n == 2 { "sqrt" } else { "a root" };
        let powers = self.powers(name, argument)?.into_iter();
        let root = |product: Symbolic, (factor, e): (Symbolic, i64)| {
            let (whole, rest) = (e.div_euclid(n.into()), e.rem_euclid(n.into()));
            let product = product * &power(&factor, whole);
            if rest == 0 { product } else { product * &power(&root_of_factor(&factor, n), rest) }
        };
        Ok(powers.fold(Symbolic::one(), root))
    }

    fn logarithm(&self, argument: &Symbolic) -> Result<Symbolic, String> {
        let powers = self.powers("log", argument)?.into_iter();
        let term = |sum: Symbolic, (factor, e): (Symbolic, i64)| {
            sum + &(logarithm_of_factor(&factor) * &Symbolic::from_i64(e))
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

    /// The factors of a positive function, each with the sign that makes it positive. If the
    /// function is `declared`, squares of factors of unknown sign are omitted.
    fn oriented(&self, what: &str, value: &Symbolic, declared: bool) -> Result<Oriented, String> {
        let (mut content, factors) = factors(what, value)?;
        let mut oriented = Vec::new();
        let mut open = Vec::new();
        for (factor, e) in factors {
            let negative = -factor.clone();
            if self.is_positive(&factor) {
                oriented.push((factor, e));
            } else if self.is_positive(&negative) {
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
                    "{what} has factors of unknown sign: declare the positive ones among {}",
                    names.join(", ")
                ))
            }
        }
    }
}

/// The content and the irreducible factors of a polynomial or quotient.
fn factors(what: &str, value: &Symbolic) -> Result<(Rational, Vec<(Symbolic, i64)>), String> {
    let f = match &value.0 {
        Form::Constant(c) if c.is_zero() => return Err(format!("{what} is zero")),
        Form::Constant(c) => return Ok((c.clone(), Vec::new())),
        Form::Fraction(f) => f,
    };
    let angle = |variable: &Variable| matches!(variable.kind(), Kind::HalfTangent(_));
    let sum = |f: &super::polynomial::Polynomial| f.terms.len() > 1;
    let root = |variable: &Variable| matches!(variable.kind(), Kind::Root(_));
    let sums = sum(&f.numerator) || !f.denominator.factors.is_empty();
    if f.variables.iter().any(angle) || sums && f.variables.iter().any(root) {
        return Err(format!("{what} contains a function, but must be a quotient of polynomials"));
    }
    let (content, above) = primitive(&f.numerator);
    let above = Denominator::of(&f.variables, &above);
    let mut all = Vec::new();
    for (part, sign) in [(&above, 1), (&f.denominator, -1)] {
        let found = part.irreducible(&f.variables);
        let found = found.ok_or_else(|| format!("{what} cannot be factored: {value}"))?;
        let signed = |(p, e)| (f.polynomial(&p), i64::from(e) * sign);
        all.extend(found.into_iter().map(signed));
    }
    Ok((content, all))
}

impl PositiveFactors {
    /// Whether a primitive polynomial is positive: it is declared positive, or its terms are
    /// positive.
    fn is_positive(&self, factor: &Symbolic) -> bool {
        self.factors.contains(factor) || self.has_positive_terms(factor)
    }

    /// Whether a polynomial has at least one positive term and no negative terms.
    fn has_positive_terms(&self, polynomial: &Symbolic) -> bool {
        let f = match &polynomial.0 {
            Form::Constant(c) => return !c.is_negative() && !c.is_zero(),
            Form::Fraction(f) => f,
        };
        let positive: Vec<bool> =
            f.variables.iter().map(|own| self.is_positive_variable(*own)).collect();
        let (mut all, mut strictly) = (true, false);
        for (monomial, c) in &f.numerator.terms {
            let powers = || monomial.exps().iter().zip(&positive);
            all &= !c.is_negative() && powers().all(|(e, positive)| *positive || e % 2 == 0);
            strictly |= powers().all(|(e, positive)| *positive || *e == 0);
        }
        all && strictly
    }

    fn is_positive_variable(&self, variable: Variable) -> bool {
        match variable.kind() {
            Kind::Exponential(_) | Kind::Root(_) => true,
            _ => self.factors.contains(&Symbolic::variable(variable)),
        }
    }
}

/// The root `p^(1/n)` of a positive irreducible polynomial or a prime. The root of a root or of an
/// exponential is a root or an exponential of a smaller part.
pub(super) fn root_of_factor(p: &Symbolic, n: u32) -> Symbolic {
    let within = p.as_variable().and_then(|variable| variable.kind().in_parts_of(n));
    let kind = within.unwrap_or_else(|| Kind::Root(Part { of: p.clone(), parts: n }));
    Symbolic::variable(Variable::function(kind))
}

/// The logarithm of a positive irreducible polynomial or a prime.
fn logarithm_of_factor(p: &Symbolic) -> Symbolic {
    match p.as_variable().map(Variable::kind) {
        Some(Kind::Exponential(part)) => part.value(),
        Some(Kind::Root(Part { of, parts })) => {
            logarithm_of_factor(of) / &Symbolic::from_i64((*parts).into())
        }
        _ => Symbolic::variable(Variable::function(Kind::Logarithm(p.clone()))),
    }
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
            // the number has no factors up to its cube root, so if it is a square, it is the square
            // of a prime
            _ if root * root == rest => all.push((root as i64, 2 * sign)),
            _ => return Err(large()),
        }
    }
    Ok(all)
}
