//! Evaluation of values over another scalar. The form of evaluation is accurate in floats.
//!
//! A quotient with functions is evaluated factor by factor. Powers of `t = tan(x/2)`, `1 - t^2` and
//! `1 + t^2` are replaced by powers of sines and cosines of `x` and `x/2`.
//!
//! A factor `p(E)` of degree `d` in `E = exp(x)` is written as `E^(d/2)` times a power of `cosh`
//! and a polynomial in `tanh` and `1/cosh`. This is done if the factor or the whole quotient is
//! symmetric in the exponentials of `x` and `-x`. This form neither overflows for large `x`, nor
//! causes cancellation for small `x`: `E - 1` is `2 sinh(x/2) E^(1/2)`. Factors that grow
//! exponentially are divided by one another before they are raised to powers.

use super::argument::by_power;
use super::common::CommonFactors;
use super::conjugates::cancelled;
use super::differences;
use super::factors::{Factors, factors};
use super::fraction::Fraction;
use super::normal_form::{half_angles, in_angles, in_bounded, is_balanced};
use super::shape::Shaping;
use super::variable::{Kind, Part, Variable};
use super::{Form, Symbolic, memo};
use crate::expression::{Evaluator, Scalars, no_function};
use crate::function::Function;
use crate::scalar::{Notation, Rational, Ring};
use num_traits::{One, Zero, pow};

impl Symbolic {
    /// The value over a scalar with elementary functions. The parameter `variable` returns the
    /// values of parameters and free functions.
    ///
    /// # Errors
    /// A message if a number or a function does not exist in the scalar, or if a divisor is zero.
    pub(in crate::scalar) fn in_scalars<S: Notation>(
        &self,
        variable: &dyn Fn(Variable) -> S,
    ) -> Result<S, String> {
        let value = match &self.0 {
            Form::Fraction(f) if f.has_functions() => cancelled(self.clone()),
            _ => self.clone(),
        };
        match &value.0 {
            Form::Constant(c) => number(c),
            Form::Fraction(f) if f.has_functions() => Numeric { f, variable }.value(),
            Form::Fraction(f) => shaped(f, variable),
        }
    }
}

fn number<S: Notation>(c: &Rational) -> Result<S, String> {
    S::from_rational(c).ok_or_else(|| "the number is beyond the range of f64".into())
}

/// The evaluator of expressions over the scalar.
fn meaning<S: Notation>() -> impl Evaluator<Value = S> {
    Scalars(|name: &str| Err::<S, _>(format!("`{name}` is unknown")), no_function)
}

/// Evaluates the fraction in the shape in which it is written.
fn shaped<S: Notation>(f: &Fraction, variable: &dyn Fn(Variable) -> S) -> Result<S, String> {
    let names = CommonFactors::default();
    let shape = memo::shape(f, || Shaping { names: &names }.fraction(f));
    shape.evaluate(&meaning(), &mut |at, e| f.variables[at].power_in(e, variable))
}

/// The evaluation of a fraction with functions.
struct Numeric<'f, S> {
    f: &'f Fraction,
    variable: &'f dyn Fn(Variable) -> S,
}

/// A polynomial with an exponent. The exponent is negative in the denominator.
type Power = (Symbolic, i64);

impl<S: Notation> Numeric<'_, S> {
    fn value(&self) -> Result<S, String> {
        let Factors { content, factors } = factors(&self.f.numerator);
        let above = factors.iter().map(|(factor, e)| (self.f.polynomial(factor), i64::from(*e)));
        let below = self.f.denominator.all(&self.f.variables);
        let below = below.iter().map(|(factor, e)| (self.f.polynomial(factor), -i64::from(*e)));
        let mut all: Vec<Power> = differences::separated(above.chain(below).collect());
        let value = Symbolic::from(self.f.clone());
        for variable in self.f.variables.iter().copied() {
            match variable.kind() {
                Kind::HalfTangent(part) => all = angular(separated(all, variable), variable, part),
                Kind::Exponential(part) => {
                    let all_factors = is_balanced(&value, variable);
                    all = hyperbolic(separated(all, variable), variable, part, all_factors);
                }
                _ => {}
            }
        }
        let (mut growing, others) = collected(all).into_iter().partition::<Vec<_>, _>(grows);
        let mut product = number(&content)?;
        for (factor, e) in others {
            product = meaning().multiply(product, self.power(&factor, e)?)?;
        }
        while let Some(up) = growing.iter().position(|(_, e)| *e > 0)
            && let Some(down) = growing.iter().position(|(_, e)| *e < 0)
        {
            let [a, b] = [growing[up].1, -growing[down].1];
            let common = a.min(b);
            let quotient = meaning().multiply(
                self.power(&growing[up].0, a / common)?,
                self.power(&growing[down].0, -(b / common))?,
            )?;
            product = meaning().multiply(product, signed(quotient, common)?)?;
            growing[up].1 -= common * (a / common);
            growing[down].1 += common * (b / common);
            growing.retain(|(_, e)| *e != 0);
        }
        for (factor, e) in growing {
            product = meaning().multiply(product, self.power(&factor, e)?)?;
        }
        Ok(product)
    }

    fn power(&self, factor: &Symbolic, e: i64) -> Result<S, String> {
        let value = match &factor.0 {
            Form::Constant(c) => number(c)?,
            Form::Fraction(f) => match factor.as_variable() {
                // evaluates a power of an exponential as one exponential, whose exponent is
                // multiplied
                Some(own) if matches!(own.kind(), Kind::Exponential(_)) => {
                    let size = u32::try_from(e.unsigned_abs()).map_err(|_| "too large")?;
                    return signed(own.power_in(size, self.variable)?, e.signum());
                }
                _ => shaped(f, self.variable)?,
            },
        };
        signed(value, e)
    }
}

/// Whether a factor may be so large or small at moderate arguments that its powers overflow.
fn grows((factor, _): &Power) -> bool {
    let exponential = |variable: &Variable| {
        use Function::{Cosh, Sinh};
        matches!(variable.kind(), Kind::Exponential(_) | Kind::Written(Sinh | Cosh, _))
    };
    factor.variables().iter().any(exponential)
}

/// Separates the factors `v - 1` and `v + 1` from the other factors, because they vanish at special
/// arguments of functions.
fn separated(all: Vec<Power>, v: Variable) -> Vec<Power> {
    let mut apart = Vec::new();
    for (mut factor, e) in all {
        for root in [Symbolic::one(), -Symbolic::one()] {
            let linear = Symbolic::variable(v) - &root;
            loop {
                let coefficients = by_power(&factor, v);
                let at_root =
                    coefficients.iter().rev().fold(Symbolic::zero(), |sum, c| sum * &root + c);
                if coefficients.len() < 3 || !at_root.vanishes() {
                    break;
                }
                factor /= &linear;
                apart.push((linear.clone(), e));
            }
        }
        apart.push((factor, e));
    }
    apart
}

/// A power whose exponent may have any sign. If the exponent is negative, the reciprocal is
/// computed first, because the power may overflow.
fn signed<S: Notation>(value: S, e: i64) -> Result<S, String> {
    let base = if e < 0 { meaning().reciprocal(value)? } else { value };
    Ok(pow(base, e.unsigned_abs() as usize))
}

/// The same product, with equal factors collected.
fn collected(all: Vec<Power>) -> Vec<Power> {
    let mut different: Vec<Power> = Vec::new();
    for (factor, e) in all {
        match different.iter_mut().find(|(other, _)| *other == factor) {
            Some((_, exponent)) => *exponent += e,
            None => different.push((factor, e)),
        }
    }
    different.retain(|(factor, e)| *e != 0 && *factor != Symbolic::one());
    different
}

fn written(function: Function, of: &Symbolic, parts: u32) -> Symbolic {
    let part = Part { of: of.clone(), parts };
    Symbolic::variable(Variable::function(Kind::Written(function, part)))
}

/// The factors, in which sines and cosines replace the half tangent `t` of an angle.
fn angular(all: Vec<Power>, t: Variable, angle: &'static Part) -> Vec<Power> {
    let Part { of, parts } = angle;
    let [sin, cos] = [Function::Sin, Function::Cos].map(|function| written(function, of, *parts));
    let [s, c] = [Function::Sin, Function::Cos].map(|function| written(function, of, 2 * parts));
    let variable = Symbolic::variable(t);
    let one = Symbolic::one;
    let square = variable.clone() * &variable;
    let [minus, plus] = [one() - &variable, one() + &variable];
    let mut rest = Vec::new();
    // the exponents of sin(x/2), cos(x/2), 1 - t and 1 + t
    let (mut sines, mut cosines, mut less, mut more) = (0i64, 0i64, 0i64, 0i64);
    for (factor, e) in all {
        let degree = by_power(&factor, t).len() as i64 - 1;
        cosines -= degree * e;
        if degree == 0 {
            rest.push((factor, e));
        } else if factor == variable {
            sines += e;
        } else if factor == one() + &square {
            // the factor is 1/cos(x/2)^2, which the exponent of the cosine already contains
        } else if factor == plus {
            more += e;
        } else if factor == minus || factor == -minus.clone() {
            less += e;
            rest.push((if factor == minus { one() } else { -one() }, e));
        } else if degree % 2 == 0 {
            rest.push((in_angles(&factor, t, angle), e));
        } else {
            rest.push((half_angles(&factor, t, &s, &c), e));
        }
    }
    let common = |a: i64, b: i64| {
        if a.signum() == b.signum() { a.signum() * a.abs().min(b.abs()) } else { 0 }
    };
    let both = common(less, more);
    rest.push((cos, both));
    rest.push((c.clone() - &s, less - both));
    rest.push((c.clone() + &s, more - both));
    let both = common(sines, cosines);
    rest.push((sin, both));
    rest.push((Symbolic::from_i64(2), -both));
    rest.push((s, sines - both));
    rest.push((c, cosines - both));
    rest
}

/// Whether the list of coefficients is symmetric or antisymmetric.
fn is_symmetric(coefficients: &[Symbolic]) -> bool {
    let pairs = || coefficients.iter().zip(coefficients.iter().rev());
    pairs().all(|(a, b)| a == b) || pairs().all(|(a, b)| *a == -b.clone())
}

/// The factors, in which hyperbolic functions replace an exponential. Either all factors are
/// rewritten, or only the factors that are symmetric in the exponential and its inverse.
fn hyperbolic(
    all: Vec<Power>,
    exponential: Variable,
    part: &'static Part,
    all_factors: bool,
) -> Vec<Power> {
    let Part { of, parts } = part;
    let logarithm = |variable: &Variable| matches!(variable.kind(), Kind::Logarithm(_));
    let is_power = of.variables().iter().any(logarithm);
    let minus = Symbolic::variable(exponential) - &Symbolic::one();
    let mut rest = Vec::new();
    // the exponents of sinh(x/2), cosh(x/2) and exp(x/2)
    let (mut sines, mut cosines, mut exponents) = (0i64, 0i64, 0i64);
    for (factor, e) in all {
        let lowest = by_power(&factor, exponential).iter().take_while(|c| c.is_zero()).count();
        let factor = factor / &pow(Symbolic::variable(exponential), lowest);
        exponents += 2 * lowest as i64 * e;
        let coefficients = by_power(&factor, exponential);
        let degree = coefficients.len() - 1;
        let alike = is_symmetric(&coefficients) && (!is_power || factor == minus);
        if degree == 0 || !all_factors && !alike {
            rest.push((factor, e));
            continue;
        }
        exponents += degree as i64 * e;
        // uses functions of x for an even degree, and functions of x/2 for an odd degree
        let (parts, half) =
            if degree.is_multiple_of(2) { (*parts, degree / 2) } else { (2 * parts, degree) };
        let [tanh, cosh] =
            [Function::Tanh, Function::Cosh].map(|function| written(function, of, parts));
        let secant = Kind::Secant(Part { of: of.clone(), parts });
        let secant = Symbolic::variable(Variable::function(secant));
        let image = in_bounded(&factor, exponential, &tanh, &secant);
        let image = match (image.clone() / &tanh).as_constant().filter(|_| degree == 1) {
            Some(c) => {
                sines += e;
                cosines -= e;
                Symbolic::constant(c.clone())
            }
            None => image,
        };
        rest.push((image, e));
        match degree {
            1 => cosines += e,
            _ => rest.push((cosh, e * half as i64)),
        }
    }
    let half = Part { of: of.clone(), parts: 2 * parts };
    rest.push((Symbolic::variable(Variable::function(Kind::Exponential(half))), exponents));
    let common = |a: i64, b: i64| {
        if a.signum() == b.signum() { a.signum() * a.abs().min(b.abs()) } else { 0 }
    };
    let whole = |function| written(function, of, *parts);
    let half = |function| written(function, of, 2 * parts);
    // uses sinh(x) = 2 sinh(x/2) cosh(x/2), and sinh = tanh cosh
    let both = common(sines, cosines);
    let (sines, cosines) = (sines - both, cosines - both);
    let quotient = common(sines, -cosines);
    rest.push((Symbolic::from_i64(2), -both));
    rest.push((half(Function::Tanh), quotient));
    rest.push((half(Function::Sinh), sines - quotient));
    rest.push((half(Function::Cosh), cosines + quotient));
    let cosh = whole(Function::Cosh);
    let power: i64 = rest.iter().filter(|(factor, _)| *factor == cosh).map(|(_, e)| e).sum();
    let quotient = common(both, -power);
    rest.push((whole(Function::Tanh), quotient));
    rest.push((whole(Function::Sinh), both - quotient));
    rest.push((cosh, quotient));
    rest
}

impl Variable {
    /// A power of the variable, evaluated over a scalar.
    fn power_in<S: Notation>(self, e: u32, variable: &dyn Fn(Variable) -> S) -> Result<S, String> {
        let fraction = |value: &Symbolic, above: u32, below: u32| {
            let factor = Rational::new(above.into(), below.into()).unwrap_or_else(Rational::one);
            (value.clone() * &Symbolic::constant(factor)).in_scalars(variable)
        };
        let value = match self.kind() {
            Kind::Parameter(_) | Kind::Applied(_) => variable(self),
            Kind::Pi => {
                number(&Rational::from_f64(std::f64::consts::PI).unwrap_or_else(Rational::one))?
            }
            Kind::HalfTangent(Part { of, parts }) => {
                S::function("tan", &fraction(of, 1, 2 * parts)?)?
            }
            Kind::Exponential(Part { of, parts }) => {
                return S::function("exp", &fraction(of, e, *parts)?);
            }
            Kind::Logarithm(p) => S::function("log", &p.in_scalars(variable)?)?,
            Kind::Root(Part { of, parts: 2 }) | Kind::FreeRoot(Part { of, parts: 2 }) => {
                S::function("sqrt", &of.in_scalars(variable)?)?
            }
            Kind::Root(Part { of, parts }) | Kind::FreeRoot(Part { of, parts }) => {
                let logarithm = S::function("log", &of.in_scalars(variable)?)?;
                let exponent =
                    Rational::new(e.into(), (*parts).into()).unwrap_or_else(Rational::one);
                let exponent = S::from_rational(&exponent).unwrap_or_else(S::one);
                return S::function("exp", &(logarithm * &exponent));
            }
            Kind::Written(function, Part { of, parts }) => {
                S::function(function.name(), &fraction(of, 1, *parts)?)?
            }
            Kind::Secant(Part { of, parts }) => {
                meaning().reciprocal(S::function("cosh", &fraction(of, 1, *parts)?)?)?
            }
        };
        Ok(pow(value, e as usize))
    }
}
