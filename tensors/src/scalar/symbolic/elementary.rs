//! Elementary functions of values. They are rational functions of additional variables.
//!
//! Let `u` be a member of the basis of arguments ([`argument`](super::argument)), such as `x`,
//! `a*x` or `Phi(r)`. Its sine, cosine and exponential are rational in `t = tan(u/2)` and
//! `E = exp(u)`: `sin u = 2t/(1 + t^2)`, `cos u = (1 - t^2)/(1 + t^2)`, `dt/du = (1 + t^2)/2`,
//! `dE/du = E`.
//!
//! The functions `t` and `E` of all members are algebraically independent, and each is a variable
//! of the fractions. Therefore, lowest terms are unique, and equality is exact. The variables
//! `sin x` and `cos x` would not be independent, because `1 - sin^2 x - cos^2 x` is zero. The
//! variables `tan(x/2)` and `tan(x/4)` would not be independent either. Therefore, a value contains
//! only one half tangent of `x`. It belongs to the largest part of `x` in which the value can be
//! written ([`canonical`](super::canonical)).
//!
//! | variable | meaning | made by |
//! |---|---|---|
//! | `tan(u/2)`, `tan(u/4)` | the half tangent of `u`, of `u/2` | `sin(u)`, `cos(u/2)` |
//! | `exp(u)`, `exp(u/2)` | the exponential | `exp(u)`, `cosh(u/2)`; `x^p` is `exp(p*log(x))` |
//! | `log(p)` | the logarithm of an irreducible polynomial or a prime | [`PositiveFactors`](super::PositiveFactors) |
//! | `sqrt(p)`, `p^(1/n)` | the root of such a number or polynomial | the same type |
//! | `a(t)`, `a_t(t)` | an undetermined function, its derivative | [`FreeFunction`](super::FreeFunction) |
//!
//! Numbers may be arguments too: `exp(1)` and `tan(1/2)` are independent by the theorem of
//! Lindemann and Weierstrass. The number `pi` counts as independent of all other values, which has
//! not been proved for `exp(1)` and logarithms of numbers.

use super::argument::{Multiple, logarithm, multiples};
use super::free::Applied;
use super::substitution::Substitution;
use super::variable::{Kind, Part, Variable};
use super::{PositiveFactors, Symbolic};
use crate::expression::{MAX_SIZE, POWER};
use crate::function::{Function, is_elementary, names};
use crate::scalar::{Field, Notation, Ring};
use num_traits::{One, Zero, pow};

/// The largest sum of the multiples of angles in the argument of a function. For `sin(2*x - y)`,
/// this sum is 3.
const MAX_ANGLES: u64 = 64;

/// The largest multiple of the argument of an exponential.
const MAX_MULTIPLE: u64 = 10_000;

impl Variable {
    /// The derivative of the variable with respect to a parameter, computed by the chain rule.
    fn rate(self, parameter: Variable) -> Symbolic {
        let own = Symbolic::variable(self);
        match self.kind() {
            Kind::Parameter(_) if self == parameter => Symbolic::one(),
            Kind::Parameter(_) | Kind::Pi => Symbolic::zero(),
            Kind::HalfTangent(part) => {
                let slope = own.clone() * &own + &Symbolic::one();
                slope * &part.derivative(2, parameter)
            }
            Kind::Exponential(part) => own * &part.derivative(1, parameter),
            Kind::Logarithm(p) => p.derivative_by(parameter) / p,
            Kind::Root(Part { of, parts }) => {
                own / of * &(of.derivative_by(parameter) / &Symbolic::from_i64((*parts).into()))
            }
            Kind::Applied(applied) => applied.derivative(parameter),
            // returns an unused value, because written forms are never differentiated
            Kind::Written(..) | Kind::FreeRoot(_) | Kind::Secant(_) => Symbolic::zero(),
        }
    }

    /// The value of the variable in floats. The function `lookup` returns the values of parameters
    /// and of free functions.
    pub(super) fn evaluate(self, lookup: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
        let part = |part: &Part| Some(part.of.evaluate_at(lookup)? / f64::from(part.parts));
        match self.kind() {
            Kind::Parameter(_) | Kind::Applied(_) => lookup(self.text()),
            Kind::Pi => Some(std::f64::consts::PI),
            Kind::HalfTangent(angle) => Some((part(angle)? / 2.0).tan()),
            Kind::Exponential(exponent) => part(exponent).map(f64::exp),
            Kind::Logarithm(p) => p.evaluate_at(lookup).map(f64::ln),
            Kind::Root(Part { of, parts }) | Kind::FreeRoot(Part { of, parts }) => {
                of.evaluate_at(lookup).map(|p| match parts {
                    2 => p.sqrt(),
                    3 => p.cbrt(),
                    _ => p.powf(1.0 / f64::from(*parts)),
                })
            }
            Kind::Written(function, argument) => part(argument).map(|x| function.value(x)),
            Kind::Secant(argument) => part(argument).map(|x| x.cosh().recip()),
        }
    }

    /// Whether a substitution changes the variable.
    pub(super) fn changes(self, values: &Substitution) -> bool {
        self.parameters().any(|parameter| values.parameter(parameter.text()).is_some())
            || self.calls(values)
    }

    /// Whether the variable is a function that the substitution replaces, or contains such a
    /// function in its arguments.
    fn calls(self, values: &Substitution) -> bool {
        let own = match self.kind() {
            Kind::Applied(applied) => {
                values.function(&applied.name, applied.arguments.len()).is_some()
            }
            _ => false,
        };
        let mut arguments = self.kind().arguments().into_iter();
        own || !values.has_no_functions()
            && arguments.any(|value| value.variables().iter().any(|inner| inner.calls(values)))
    }

    /// The variable after a substitution of parameters and functions.
    ///
    /// # Errors
    /// A message if the function has no value at the new argument.
    pub(super) fn image(
        self,
        positive: &PositiveFactors,
        values: &Substitution,
    ) -> Result<Symbolic, String> {
        match self.kind() {
            Kind::Parameter(name) => Ok(match values.parameter(name) {
                Some(value) => value.clone(),
                None => Symbolic::variable(self),
            }),
            Kind::HalfTangent(part) => {
                // avoids the tangent of the half angle, which would have twice as many parts
                let angle = part.value().substitute_where(positive, values)?;
                let [p, q] = half_angle("sin", &multiples("sin", &angle)?)?;
                let undefined = || format!("{} has a pole at these values", self.text());
                Ok(q * &p.recip().ok_or_else(undefined)?)
            }
            Kind::Exponential(part) => {
                let argument = part.value().substitute_where(positive, values)?;
                positive.function("exp", &argument)
            }
            Kind::Logarithm(p) => positive.function("log", &p.substitute_where(positive, values)?),
            Kind::Root(part) | Kind::FreeRoot(part) => {
                let base = part.of.substitute_where(positive, values)?;
                positive.root(&base, part.parts)
            }
            Kind::Applied(applied) => applied.image(positive, values),
            Kind::Written(function, part) => positive
                .function(function.name(), &part.value().substitute_where(positive, values)?),
            // leaves these variables unchanged; a secant occurs only in programs, in which nothing
            // is substituted
            Kind::Pi | Kind::Secant(_) => Ok(Symbolic::variable(self)),
        }
    }
}

impl Part {
    /// The part as a value.
    pub(super) fn value(&self) -> Symbolic {
        self.of.clone() / &Symbolic::from_i64(self.parts.into())
    }

    /// The derivative of a multiple of the part.
    fn derivative(&self, of: i64, parameter: Variable) -> Symbolic {
        self.of.derivative_by(parameter) / &Symbolic::from_i64(of * i64::from(self.parts))
    }
}

/// The value of an elementary function in its written form.
pub(super) fn written_value(function: Function, part: &Part) -> Symbolic {
    let value = function_of_sum(function.name(), &part.value());
    value.unwrap_or_else(|_| {
        Symbolic::variable(Variable::function(Kind::Written(function, part.clone())))
    })
}

impl Symbolic {
    /// The partial derivative with respect to the parameter `name`. Functions are differentiated by
    /// the chain rule.
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
        self.derivative_by(Variable::parameter(name))
    }

    pub(super) fn derivative_by(&self, parameter: Variable) -> Self {
        let functions = self.variables().iter().filter(|variable| !variable.is_parameter());
        let functions =
            functions.filter(|function| function.parameters().any(|own| own == parameter));
        functions.fold(self.partial(parameter), |sum, function| {
            sum + &(self.partial(*function) * &function.rate(parameter))
        })
    }

    /// The value of an elementary function of one argument, of a power, or of a free function.
    pub(super) fn called(name: &str, arguments: &[Self]) -> Result<Self, String> {
        PositiveFactors::default().call(name, arguments)
    }
}

impl PositiveFactors {
    /// The value of an elementary function of one argument, of a power (the function `pow`), or of
    /// a free function.
    ///
    /// # Errors
    /// A message if the function is unknown, or has no exact value at these arguments.
    pub fn call(&self, name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        match arguments {
            [argument] if is_elementary(name) => self.function(name, argument),
            [base, exponent] if name == POWER => self.power(base, exponent),
            // rejects well-known functions, because they would otherwise be read as free functions
            _ if UNKNOWN.contains(&name) => Err(unknown(name)),
            _ => Applied::read(name, arguments),
        }
    }
}

/// The names of well-known functions that have no exact values in this package.
const UNKNOWN: [&str; 13] = [
    "abs", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "erf", "gamma", "max",
    "min", "sign",
];

fn unknown(name: &str) -> String {
    format!("`{name}` is not a function here: there are {}, and free functions", names())
}

/// The value of a function at a sum of basis arguments with integer factors.
pub(super) fn function_of_sum(name: &str, argument: &Symbolic) -> Result<Symbolic, String> {
    if !is_elementary(name) {
        return Err(unknown(name));
    }
    let multiples = multiples(name, argument)?;
    let quotient = |above: Symbolic, below: Symbolic| {
        let below = below.recip().ok_or_else(|| format!("{name} has a pole at its argument"))?;
        Ok(above * &below)
    };
    match name {
        "sin" | "cos" | "tan" | "cot" => {
            let [p, q] = half_angle(name, &multiples)?;
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
            let e = exponential(name, &multiples)?;
            let back = Symbolic::one() / &e;
            let (sum, difference) = (e.clone() + &back, e.clone() - &back);
            match name {
                "exp" => Ok(e),
                "sinh" => quotient(difference, Symbolic::from_i64(2)),
                "cosh" => quotient(sum, Symbolic::from_i64(2)),
                "tanh" => quotient(difference, sum),
                other => Err(unknown(other)),
            }
        }
    }
}

/// The exponential of a sum of multiples. The exponentials of rational multiples of logarithms are
/// powers.
fn exponential(name: &str, multiples: &[Multiple]) -> Result<Symbolic, String> {
    multiples.iter().try_fold(Symbolic::one(), |product, multiple| {
        let count = multiple.count.unsigned_abs();
        if count > MAX_MULTIPLE {
            return Err(format!(
                "the argument of {name} has an integer factor greater than {MAX_MULTIPLE}"
            ));
        }
        let base = match logarithm(&multiple.of) {
            Some(p) if multiple.parts == 1 => p.clone(),
            Some(p) => super::positive::root_of_factor(p, multiple.parts),
            None => Symbolic::variable(Variable::function(Kind::Exponential(multiple.part()))),
        };
        let base = if multiple.count < 0 { base.recip().unwrap_or_default() } else { base };
        Ok(product * &pow(base, count as usize))
    })
}

/// The numbers `p` and `q` with `tan(y/2) = q/p`. They are computed from `p + iq`, which is the
/// product of all `(1 + i tan(x/2))^n`.
fn half_angle(name: &str, multiples: &[Multiple]) -> Result<[Symbolic; 2], String> {
    let counts = multiples.iter().map(|multiple| multiple.count.unsigned_abs());
    if counts.fold(0, u64::saturating_add) > MAX_ANGLES {
        return Err(format!(
            "the integer factors in the argument of {name} add up to more than {MAX_ANGLES}"
        ));
    }
    let (mut p, mut q) = (Symbolic::one(), Symbolic::zero());
    for multiple in multiples {
        if multiple.of == Symbolic::pi() {
            let [a, b] = half_angle_of_pi(name, multiple)?;
            (p, q) = (p.clone() * &a - &(q.clone() * &b), q * &a + &(p * &b));
            continue;
        }
        let t = Symbolic::variable(Variable::function(Kind::HalfTangent(multiple.part())));
        let t = if multiple.count < 0 { -t } else { t };
        for _ in 0..multiple.count.unsigned_abs() {
            (p, q) = (p.clone() - &bounded(&q, &t)?, q + &bounded(&p, &t)?);
        }
    }
    Ok([p, q])
}

/// The numbers `p` and `q` with `tan(y/2) = q/p`, for a multiple `y` of pi.
fn half_angle_of_pi(name: &str, multiple: &Multiple) -> Result<[Symbolic; 2], String> {
    let root = |n: i64| super::positive::root_of_factor(&Symbolic::from_i64(n), 2);
    let number = Symbolic::from_i64;
    let (a, b) = match multiple.parts {
        1 => (number(0), number(1)),
        2 => (number(1), number(1)),
        3 => (root(3), number(1)),
        4 => (number(1) + &root(2), number(1)),
        6 => (number(2) + &root(3), number(1)),
        parts => {
            return Err(format!(
                "{name} is known at multiples of pi/2, pi/3, pi/4 and pi/6, but not at multiples of pi/{parts}"
            ));
        }
    };
    let turns = multiple.count.rem_euclid(4 * i64::from(multiple.parts));
    let one = (Symbolic::one(), Symbolic::zero());
    let (p, q) =
        (0..turns).fold(one, |(p, q), _| (p.clone() * &a - &(q.clone() * &b), q * &a + &(p * &b)));
    Ok([p, q])
}

fn bounded(a: &Symbolic, b: &Symbolic) -> Result<Symbolic, String> {
    if a.product_size(b) > MAX_SIZE {
        return Err(format!("the value grows beyond the limit of {MAX_SIZE}"));
    }
    Ok(a.clone() * b)
}
