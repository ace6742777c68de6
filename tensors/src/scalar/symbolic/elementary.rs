//! Sines, cosines and exponentials of parameters, as rational functions.
//!
//! Sines, cosines and exponentials of a parameter `x` are rational in `t = tan(x/2)` and
//! `E = exp(x)`: `sin x = 2t/(1 + t^2)`, `cos x = (1 - t^2)/(1 + t^2)`, `dt/dx = (1 + t^2)/2`,
//! `dE/dx = E`. The functions `x`, `t` and `E` are algebraically independent, so each is a variable
//! of the fractions. Lowest terms are therefore unique, and equality is exact. The variables `sin x`
//! and `cos x` would not be independent: `1 - sin^2 x - cos^2 x` is zero. Only parsing and
//! differentiation (here) and writing ([`normal_form`](super::normal_form)) treat these variables
//! in a special way.

use super::Symbolic;
use crate::expression::{MAX_SIZE, is_name};
use crate::scalar::{Field, Notation, Ring};
use num_traits::{One, ToPrimitive, Zero};

/// The largest sum of multiples in the argument of a function: `sin(2*x - y)` has 3.
const MAX_MULTIPLES: u64 = 16;

/// The names of the functions.
const FUNCTIONS: [&str; 8] = ["sin", "cos", "tan", "cot", "exp", "sinh", "cosh", "tanh"];

/// The name of the variable that stands for `tan(x/2)`.
pub(super) fn half_tangent(x: &str) -> String {
    format!("tan({x}/2)")
}

/// The name of the variable that stands for `exp(x)`.
pub(super) fn exponential(x: &str) -> String {
    format!("exp({x})")
}

/// The parameter `x`, if the variable is `tan(x/2)`.
pub(super) fn angle(variable: &str) -> Option<&str> {
    variable.strip_prefix("tan(")?.strip_suffix("/2)")
}

/// The parameter `x`, if the variable is `exp(x)`.
fn exponent(variable: &str) -> Option<&str> {
    variable.strip_prefix("exp(")?.strip_suffix(')')
}

/// The parameter on which a variable depends: itself, or the argument of its function.
pub(super) fn parameter(variable: &str) -> &str {
    angle(variable).or_else(|| exponent(variable)).unwrap_or(variable)
}

/// The value of a variable; `lookup` returns the values of parameters.
pub(super) fn value(variable: &str, lookup: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    match (angle(variable), exponent(variable)) {
        (Some(x), _) => Some((lookup(x)? / 2.0).tan()),
        (_, Some(x)) => Some(lookup(x)?.exp()),
        _ => lookup(variable),
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
        let through = |variable: String, rate: fn(Symbolic) -> Symbolic| {
            let outer = self.partial(&variable);
            if outer.vanishes() { outer } else { outer * &rate(Symbolic::parameter(&variable)) }
        };
        let half = |t: Symbolic| (t.clone() * &t + &Symbolic::one()) / &Symbolic::from_i64(2);
        self.partial(name) + &through(half_tangent(name), half) + &through(exponential(name), |e| e)
    }

    /// `sin`, `cos`, `tan`, `cot`, `exp`, `sinh`, `cosh` or `tanh` of an integer combination of
    /// parameters.
    pub(super) fn function_of(name: &str, argument: &Self) -> Result<Self, String> {
        if !FUNCTIONS.contains(&name) {
            return Err(format!(
                "`{name}` is no function here: there are {}",
                FUNCTIONS.join(", ")
            ));
        }
        let multiples = argument.multiples().ok_or_else(|| {
            format!("the argument of {name} is a sum of integer multiples of names, like 2*x - y")
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

    /// The value as a sum of integer multiples of parameters.
    fn multiples(&self) -> Option<Vec<(String, i64)>> {
        let multiple = |(powers, n): (Vec<(String, u32)>, crate::Rational)| match &powers[..] {
            [(x, 1)] if is_name(x) && n.is_integer() => Some((x.clone(), n.to_f64().to_i64()?)),
            _ => None,
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
