//! Sines, cosines and exponentials of products of parameters, as rational functions.
//!
//! Sines, cosines and exponentials of a product `u` of parameters, like `x` or `a*x`, are rational in
//! `t = tan(u/2)` and `E = exp(u)`: `sin u = 2t/(1 + t^2)`, `cos u = (1 - t^2)/(1 + t^2)`,
//! `dt/du = (1 + t^2)/2`, `dE/du = E`. Different products are linearly independent modulo constants, so the
//! parameters and the functions `t` and `E` of all products are algebraically independent (J. Ax, *Ann. Math.*
//! 93 (1971) 252-268), and each is a variable of the fractions. Lowest terms are therefore unique, and
//! equality is exact. The variables `sin x` and `cos x` would not be independent: `1 - sin^2 x - cos^2 x`
//! is zero, nor would `tan(x/2)` and `tan(x/4)`: a value has one of them, that of the largest part of `x` with
//! which it can be written ([`canonical`](super::canonical)).
//!
//! | variable | stands for | made by |
//! |---|---|---|
//! | `tan(u/2)`, `tan(u/4)` | the half tangent of `u`, of `u/2` | `sin(u)`, `cos(u/2)` |
//! | `exp(u)`, `exp(u/2)` | the exponential | `exp(u)`, `cosh(u/2)` |
//! | `log(p)` | the logarithm of an irreducible polynomial or a prime | [`PositiveFactors`](super::PositiveFactors) |
//! | `sqrt(p)` | its square root | the same |
//! | `a(t)`, `a_t(t)` | a function that is not given, its derivative | [`FreeFunction`] |
//!
//! Only parsing, differentiation and substitution (here), normal forms and writing
//! ([`normal_form`](super::normal_form)) treat these variables in a special way.

use super::free::FreeFunction;
use super::function_names::{FUNCTIONS, is_elementary};
use super::variables::Name;
use super::{PositiveFactors, Symbolic};
use crate::expression::{MAX_SIZE, is_name};
use crate::scalar::{Field, Notation, Ring};
use num_rational::Ratio;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// The largest sum of multiples in the argument of a function: `sin(2*x - y)` has 3.
const MAX_MULTIPLES: u64 = 16;

/// The parts of a product divide this number, so that functions of different parts meet in few: `sin(x/12)`.
const PARTS: u32 = 12;

/// What a variable of a fraction stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variable<'v> {
    Parameter,
    /// `tan(product/(2 parts))`.
    HalfTangent {
        product: &'v str,
        parts: u32,
    },
    /// `exp(product/parts)`.
    Exponential {
        product: &'v str,
        parts: u32,
    },
    /// The logarithm of a polynomial.
    Logarithm(&'v str),
    /// The square root of a polynomial.
    Root(&'v str),
    /// A function that is not given, or a derivative of one.
    Free(&'v str),
}

use Variable::{Exponential, Free, HalfTangent, Logarithm, Parameter, Root};

impl<'v> Variable<'v> {
    pub fn of(name: &'v str) -> Self {
        let inside = name.strip_suffix(')').and_then(|rest| rest.split_once('('));
        let Some((function, inside)) = inside else { return Parameter };
        let (product, parts) = match inside.rsplit_once('/') {
            Some((product, parts)) => (product, parts.parse().unwrap_or(0)),
            None => (inside, 1),
        };
        match function {
            "tan" if parts > 0 && parts % 2 == 0 => HalfTangent { product, parts: parts / 2 },
            "exp" if parts > 0 => Exponential { product, parts },
            "log" => Logarithm(inside),
            "sqrt" => Root(inside),
            _ if is_elementary(function) => Parameter,
            _ => Free(name),
        }
    }

    /// The product and its parts, of half tangents and exponentials.
    pub fn parts(self) -> Option<(&'v str, u32)> {
        match self {
            HalfTangent { product, parts } | Exponential { product, parts } => {
                Some((product, parts))
            }
            _ => None,
        }
    }

    /// The elementary function that the variable is, and its argument.
    fn call(self) -> Option<(&'static str, Symbolic)> {
        let part = |product, parts: u32| of_product(product) / &Symbolic::from_i64(parts.into());
        Some(match self {
            Parameter | Free(_) => return None,
            HalfTangent { product, parts } => ("tan", part(product, 2 * parts)),
            Exponential { product, parts } => ("exp", part(product, parts)),
            Logarithm(p) => ("log", p.parse().ok()?),
            Root(p) => ("sqrt", p.parse().ok()?),
        })
    }

    /// The derivative of the variable by the argument of its function; `own` is the variable.
    fn slope(self, own: &Symbolic, argument: &Symbolic) -> Symbolic {
        match self {
            Parameter | Free(_) => Symbolic::zero(),
            HalfTangent { .. } => own.clone() * own + &Symbolic::one(),
            Exponential { .. } => own.clone(),
            Logarithm(_) => Symbolic::one() / argument,
            Root(_) => own.clone() / &(argument.clone() * &Symbolic::from_i64(2)),
        }
    }
}

/// The name of the variable that stands for `tan(product/(2 parts))`.
pub(super) fn half_tangent(product: &str, parts: u32) -> String {
    format!("tan({product}/{})", 2 * parts)
}

/// The name of the variable that stands for `exp(product/parts)`.
pub(super) fn exponential(product: &str, parts: u32) -> String {
    format!("exp({})", part(product, parts))
}

/// A part of a product as it is written: `a*x/2`.
pub(super) fn part(product: &str, parts: u32) -> String {
    if parts == 1 { product.to_owned() } else { format!("{product}/{parts}") }
}

/// The angle `u` as it is written, if the variable is `tan(u/2)`.
pub(super) fn angle(variable: &str) -> Option<String> {
    match Variable::of(variable) {
        HalfTangent { product, parts } => Some(part(product, parts)),
        _ => None,
    }
}

/// The parameters of a product and their powers: `a^2*x`.
fn powers(product: &str) -> impl Iterator<Item = (&str, u32)> {
    product.split('*').map(|factor| match factor.split_once('^') {
        Some((name, power)) => (name, power.parse().unwrap_or(1)),
        None => (factor, 1),
    })
}

/// A product as it is written in the names of variables.
fn product(powers: &[(String, u32)]) -> String {
    let power = |(name, e): &(String, u32)| match e {
        1 => name.clone(),
        _ => format!("{name}^{e}"),
    };
    powers.iter().map(power).collect::<Vec<_>>().join("*")
}

/// The parameters on which a variable depends: itself, or those of the argument of its function.
pub(super) fn parameters(variable: &str) -> impl Iterator<Item = &str> {
    let inside = match Variable::of(variable) {
        Parameter => variable,
        _ => variable.split_once('(').map_or(variable, |(_, inside)| inside),
    };
    let whole = inside == variable;
    let end = move |c: char| !whole && !c.is_ascii_alphanumeric() && c != '_';
    // a name before a parenthesis is that of a function
    let names = inside.split_inclusive(end).filter(move |name| whole || !name.ends_with('('));
    let names = names.map(move |name| name.trim_end_matches(end));
    names.filter(move |name| whole || is_name(name))
}

/// Whether this is a name, or that of a variable as it is written here.
pub(super) fn is_variable(name: &str) -> bool {
    let is = |(function, argument): (&str, Symbolic)| {
        Symbolic::function_of(function, &argument).is_ok_and(|f| f == Symbolic::parameter(name))
    };
    let free = |name| FreeFunction::read(name).is_ok_and(|f| f.variable() == name);
    is_name(name) || Variable::of(name).call().map_or_else(|| free(name), is)
}

/// The value of a variable; `lookup` returns the values of parameters.
pub(super) fn value(variable: &str, lookup: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
    let part = |product, parts: u32| {
        let power = |value, (name, e): (&str, u32)| Some(value * lookup(name)?.powf(e.into()));
        Some(powers(product).try_fold(1.0, power)? / f64::from(parts))
    };
    let polynomial = |p: &str| p.parse::<Symbolic>().ok()?.evaluate_at(lookup);
    match Variable::of(variable) {
        Parameter | Free(_) => lookup(variable),
        HalfTangent { product, parts } => part(product, 2 * parts).map(f64::tan),
        Exponential { product, parts } => part(product, parts).map(f64::exp),
        Logarithm(p) => polynomial(p).map(f64::ln),
        Root(p) => polynomial(p).map(f64::sqrt),
    }
}

/// A product as a value.
fn of_product(u: &str) -> Symbolic {
    powers(u).fold(Symbolic::one(), |value, (name, e)| {
        value * &num_traits::pow(Symbolic::parameter(name), e as usize)
    })
}

/// Whether a variable changes where these parameters and functions get values.
pub(super) fn changes(variable: &str, values: &BTreeMap<String, Symbolic>) -> bool {
    let given = |name: &str| values.contains_key(name);
    given(variable)
        || parameters(variable).any(given)
        || matches!(Variable::of(variable), Free(_))
            && FreeFunction::read(variable).is_ok_and(|f| given(&f.original().variable()))
}

/// The variable, a function, at another argument.
///
/// # Errors
/// In words: the argument has no function here.
pub(super) fn at_argument(
    variable: &str,
    positive: &PositiveFactors,
    values: &BTreeMap<String, Symbolic>,
) -> Result<Symbolic, String> {
    let undefined = || format!("{variable} is not defined there");
    if let Free(name) = Variable::of(variable) {
        return FreeFunction::read(name)?.image(positive, values);
    }
    if let HalfTangent { product, parts } = Variable::of(variable) {
        // not the tangent of an angle, which would have twice as many parts
        let angle = of_product(product) / &Symbolic::from_i64(parts.into());
        let multiples = angle.substitute_where(positive, values)?.argument_of("sin")?;
        let [p, q] = half_angle(&multiples)?;
        return Ok(q * &p.recip().ok_or_else(undefined)?);
    }
    let (function, argument) = Variable::of(variable).call().ok_or_else(undefined)?;
    positive.function(function, &argument.substitute_where(positive, values)?)
}

impl Symbolic {
    /// The partial derivative by the parameter of that name; functions of it follow the chain
    /// rule.
    ///
    /// ```
    /// use affinor_tensors::{Notation, Symbolic};
    /// let [a, b] = ["a", "b"].map(Symbolic::parameter);
    /// assert_eq!((a.clone() / &b).derivative("b").to_string(), "-a/b^2");
    /// let sine = <Symbolic as Notation>::function("sin", &a)?;
    /// assert_eq!(sine.derivative("a").to_string(), "cos(a)");
    /// # Ok::<(), String>(())
    /// ```
    pub fn derivative(&self, name: &str) -> Self {
        let along = |variable: &Name| {
            let of = Variable::of(variable);
            if let Free(free) = of {
                let derivative = FreeFunction::read(free).ok().and_then(|f| f.derivative(name));
                return derivative.map_or_else(Self::zero, |derivative| {
                    self.partial(variable) * &Self::parameter(&derivative.variable())
                });
            }
            let depends = of != Parameter && parameters(variable).any(|own| own == name);
            let Some((_, argument)) = depends.then(|| of.call()).flatten() else {
                return Self::zero();
            };
            let slope = of.slope(&Self::parameter(variable), &argument);
            self.partial(variable) * &slope * &argument.derivative(name)
        };
        self.variables().iter().map(along).fold(self.partial(name), |sum, rate| sum + &rate)
    }

    /// `sin`, `cos`, `tan`, `cot`, `exp`, `sinh`, `cosh` or `tanh` of a combination of products of
    /// parameters; `sqrt` and `log` of a power of one irreducible polynomial or quotient.
    pub(super) fn function_of(name: &str, argument: &Self) -> Result<Self, String> {
        PositiveFactors::default().function(name, argument)
    }

    /// An elementary function of one argument, or a free function of names.
    pub(super) fn called(name: &str, arguments: &[Self]) -> Result<Self, String> {
        if let ([argument], true) = (arguments, is_elementary(name)) {
            return Self::function_of(name, argument);
        }
        let argument =
            |value: &Self| value.parameters().pop().filter(|own| *value == Self::parameter(own));
        let names = arguments.iter().map(argument).collect::<Option<Vec<_>>>();
        let names = names.ok_or_else(|| {
            format!(
                "`{name}` is no function here: there are {}, and free functions of names",
                FUNCTIONS.join(", ")
            )
        })?;
        Ok(Self::parameter(&FreeFunction::new(name, &names)?.variable()))
    }

    /// A function of a sum of multiples of products of parameters.
    pub(super) fn function_of_sum(name: &str, argument: &Self) -> Result<Self, String> {
        if !is_elementary(name) {
            return Err(format!(
                "`{name}` is no function here: there are {}",
                FUNCTIONS.join(", ")
            ));
        }
        let multiples = argument.argument_of(name)?;
        let quotient = |above: Symbolic, below: Symbolic| {
            let below = below.recip().ok_or_else(|| format!("{name} is not defined here"))?;
            Ok(above * &below)
        };
        match name {
            "sin" | "cos" | "tan" | "cot" => {
                let [p, q] = half_angle(&multiples)?;
                let [pp, qq, pq] = [bounded(&p, &p)?, bounded(&q, &q)?, bounded(&p, &q)?];
                let (cos, sin, one) = (pp.clone() - &qq, pq.clone() + &pq, pp + &qq);
                match name {
                    "sin" => quotient(sin, one),
                    "cos" => quotient(cos, one),
                    "tan" => quotient(sin, cos),
                    _ => quotient(cos, sin),
                }
            }
            _ => {
                let e = multiples.iter().fold(Symbolic::one(), |result, multiple| {
                    let e = Symbolic::parameter(&exponential(&multiple.product, multiple.parts));
                    let e = if multiple.count < 0 { Symbolic::one() / &e } else { e };
                    result * &num_traits::pow(e, multiple.count.unsigned_abs() as usize)
                });
                let back = Symbolic::one() / &e;
                let (sum, difference) = (e.clone() + &back, e.clone() - &back);
                match name {
                    "exp" => Ok(e),
                    "sinh" => quotient(difference, Symbolic::from_i64(2)),
                    "cosh" => quotient(sum, Symbolic::from_i64(2)),
                    _ => quotient(difference, sum),
                }
            }
        }
    }

    /// The value as the argument of a function of that name.
    fn argument_of(&self, name: &str) -> Result<Vec<Multiple>, String> {
        let multiples = self.multiples().ok_or_else(|| {
            format!("the argument of {name} is a sum of multiples of products of names, like 2*x - a*y/2")
        })?;
        let sum = multiples
            .iter()
            .fold(0, |sum: u64, multiple| sum.saturating_add(multiple.count.unsigned_abs()));
        if sum > MAX_MULTIPLES {
            return Err(format!("the argument of {name} has more than {MAX_MULTIPLES} multiples"));
        }
        if multiples.iter().any(|multiple| !PARTS.is_multiple_of(multiple.parts)) {
            return Err(format!("the argument of {name} has parts other than twelfths"));
        }
        Ok(multiples)
    }

    /// The value as a sum of multiples of products of parameters.
    fn multiples(&self) -> Option<Vec<Multiple>> {
        let multiple = |(powers, n): (Vec<(String, u32)>, crate::Rational)| {
            let names = !powers.is_empty() && powers.iter().all(|(name, _)| is_name(name));
            let n = Ratio::<i64>::try_from(&n).ok().filter(|_| names)?;
            let parts = u32::try_from(*n.denom()).ok()?;
            Some(Multiple { product: product(&powers), count: *n.numer(), parts })
        };
        if !self.denominator().is_one() {
            return None;
        }
        self.terms().into_iter().map(multiple).collect()
    }
}

/// `count/parts` times a product.
struct Multiple {
    product: String,
    count: i64,
    parts: u32,
}

/// `p` and `q` with `tan(y/2) = q/p`, from `p + iq`, the product of the `(1 + i tan(x/2))^n`.
fn half_angle(multiples: &[Multiple]) -> Result<[Symbolic; 2], String> {
    let (mut p, mut q) = (Symbolic::one(), Symbolic::zero());
    for Multiple { product, count, parts } in multiples {
        let t = Symbolic::parameter(&half_tangent(product, *parts));
        let t = if *count < 0 { -t } else { t };
        for _ in 0..count.unsigned_abs() {
            (p, q) = (p.clone() - &bounded(&q, &t)?, q + &bounded(&p, &t)?);
        }
    }
    Ok([p, q])
}

fn bounded(a: &Symbolic, b: &Symbolic) -> Result<Symbolic, String> {
    if a.product_size(b) > MAX_SIZE {
        return Err(format!("the value grows beyond the limit of {MAX_SIZE}"));
    }
    Ok(a.clone() * b)
}
