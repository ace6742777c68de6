//! Sines, cosines and exponentials of products of parameters, as rational functions.
//!
//! Sines, cosines and exponentials of a product `u` of parameters, like `x` or `a*x`, are rational in
//! `t = tan(u/2)` and `E = exp(u)`: `sin u = 2t/(1 + t^2)`, `cos u = (1 - t^2)/(1 + t^2)`,
//! `dt/du = (1 + t^2)/2`, `dE/du = E`. Different products are linearly independent modulo constants, so the
//! parameters and the functions `t` and `E` of all products are algebraically independent (J. Ax, *Ann. Math.*
//! 93 (1971) 252-268), and each is a variable of the fractions. Lowest terms are therefore unique, and
//! equality is exact. The variables `sin x` and `cos x` would not be independent: `1 - sin^2 x - cos^2 x`
//! is zero, nor would `tan(x/2)` and `tan(x/4)`. Only parsing, differentiation and substitution (here) and
//! writing ([`normal_form`](super::normal_form)) treat these variables in a special way.

use super::Symbolic;
use super::variables::natural;
use crate::expression::{MAX_SIZE, is_name};
use crate::scalar::{Field, Notation, Ring};
use num_traits::{One, ToPrimitive, Zero};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The largest sum of multiples in the argument of a function: `sin(2*x - y)` has 3.
const MAX_MULTIPLES: u64 = 16;

/// The names of the functions.
const FUNCTIONS: [&str; 8] = ["sin", "cos", "tan", "cot", "exp", "sinh", "cosh", "tanh"];

/// The name of the variable that stands for `tan(u/2)`.
pub(super) fn half_tangent(u: &str) -> String {
    format!("tan({u}/2)")
}

/// The name of the variable that stands for `exp(u)`.
pub(super) fn exponential(u: &str) -> String {
    format!("exp({u})")
}

/// The product `u`, if the variable is `tan(u/2)`.
pub(super) fn angle(variable: &str) -> Option<&str> {
    variable.strip_prefix("tan(")?.strip_suffix("/2)")
}

/// The product `u`, if the variable is `exp(u)`.
fn exponent(variable: &str) -> Option<&str> {
    variable.strip_prefix("exp(")?.strip_suffix(')')
}

/// The argument of a variable that is a function.
fn argument(variable: &str) -> Option<&str> {
    angle(variable).or_else(|| exponent(variable))
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
    powers(argument(variable).unwrap_or(variable)).map(|(name, _)| name)
}

/// Whether this is a name, or that of a variable as it is written here.
pub(super) fn is_variable(name: &str) -> bool {
    let Some(u) = argument(name) else { return is_name(name) };
    let powers: Vec<(String, u32)> = powers(u).map(|(name, e)| (name.to_owned(), e)).collect();
    let ordered = powers.is_sorted_by(|(a, _), (b, _)| natural(a, b).is_lt());
    ordered && powers.iter().all(|(name, e)| is_name(name) && *e > 0) && product(&powers) == u
}

/// The value of a variable; `lookup` returns the values of parameters.
pub(super) fn value(variable: &str, lookup: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let Some(u) = argument(variable) else { return lookup(variable) };
    let argument =
        powers(u).try_fold(1.0, |value, (name, e)| Some(value * lookup(name)?.powf(e.into())))?;
    Some(if angle(variable).is_some() { (argument / 2.0).tan() } else { argument.exp() })
}

/// A product as a value.
fn of_product(u: &str) -> Symbolic {
    powers(u).fold(Symbolic::one(), |value, (name, e)| {
        value * &num_traits::pow(Symbolic::parameter(name), e as usize)
    })
}

/// The variable, a function, at another argument; `None` if that has no function here.
pub(super) fn at_argument(variable: &str, values: &BTreeMap<String, Symbolic>) -> Option<Symbolic> {
    let u = of_product(argument(variable)?).substitute(values)?;
    match angle(variable) {
        None => Symbolic::function_of("exp", &u).ok(),
        Some(_) => {
            let [p, q] = half_angle(&u.multiples()?).ok()?;
            Some(q * &p.recip()?)
        }
    }
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
        let along = |variable: &Arc<str>| {
            let Some(u) = argument(variable).filter(|u| powers(u).any(|(own, _)| own == name))
            else {
                return Self::zero();
            };
            let own = Self::parameter(variable);
            let rate = match angle(variable) {
                Some(_) => (own.clone() * &own + &Self::one()) / &Self::from_i64(2),
                None => own,
            };
            self.partial(variable) * &rate * &of_product(u).partial(name)
        };
        self.variables().iter().map(along).fold(self.partial(name), |sum, rate| sum + &rate)
    }

    /// `sin`, `cos`, `tan`, `cot`, `exp`, `sinh`, `cosh` or `tanh` of an integer combination of products of
    /// parameters.
    pub(super) fn function_of(name: &str, argument: &Self) -> Result<Self, String> {
        if !FUNCTIONS.contains(&name) {
            return Err(format!(
                "`{name}` is no function here: there are {}",
                FUNCTIONS.join(", ")
            ));
        }
        let multiples = argument.multiples().ok_or_else(|| {
            format!("the argument of {name} is a sum of integer multiples of products of names, like 2*x - a*y")
        })?;
        let sum = multiples.iter().fold(0, |sum: u64, (_, n)| sum.saturating_add(n.unsigned_abs()));
        if sum > MAX_MULTIPLES {
            return Err(format!("the argument of {name} has more than {MAX_MULTIPLES} multiples"));
        }
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
                let e = multiples.iter().fold(Symbolic::one(), |product, (x, n)| {
                    let e = Symbolic::parameter(&exponential(x));
                    let e = if *n < 0 { Symbolic::one() / &e } else { e };
                    product * &num_traits::pow(e, n.unsigned_abs() as usize)
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

    /// The value as a sum of integer multiples of products of parameters.
    fn multiples(&self) -> Option<Vec<(String, i64)>> {
        let multiple = |(powers, n): (Vec<(String, u32)>, crate::Rational)| {
            let names = !powers.is_empty() && powers.iter().all(|(name, _)| is_name(name));
            let n = n.to_f64().to_i64().filter(|_| n.is_integer())?;
            names.then(|| (product(&powers), n))
        };
        if !self.denominator().is_one() {
            return None;
        }
        self.terms().into_iter().map(multiple).collect()
    }
}

/// `p` and `q` with `tan(y/2) = q/p`, from `p + iq`, the product of the `(1 + i tan(x/2))^n`.
fn half_angle(multiples: &[(String, i64)]) -> Result<[Symbolic; 2], String> {
    let (mut p, mut q) = (Symbolic::one(), Symbolic::zero());
    for (x, n) in multiples {
        let t = Symbolic::parameter(&half_tangent(x));
        let t = if *n < 0 { -t } else { t };
        for _ in 0..n.unsigned_abs() {
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
