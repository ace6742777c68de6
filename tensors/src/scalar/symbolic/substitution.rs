//! Substitution of values for parameters, and evaluation.

use super::fraction::Fraction;
use super::free::FreeFunction;
use super::polynomial::Polynomial;
use super::variable::Variable;
use super::{Form, PositiveFactors, Symbolic, canonical};
use crate::scalar::Field;
use num_traits::Zero;
use std::collections::BTreeMap;

/// The largest total degree of the result of a substitution.
const DEGREE_LIMIT: u64 = 1 << 30;

/// Values for parameters, and for free functions of named arguments.
#[derive(Clone, Default)]
pub(super) struct Substitution {
    parameters: BTreeMap<String, Symbolic>,
    functions: Vec<(FreeFunction, Symbolic)>,
}

impl Substitution {
    pub fn of_parameters(parameters: BTreeMap<String, Symbolic>) -> Self {
        Substitution { parameters, functions: vec![] }
    }

    /// Adds the value of a function with these argument names. Does nothing if the function already
    /// has a value.
    pub fn add_function(&mut self, name: &str, arguments: &[String], value: Symbolic) {
        if self.function(name, arguments.len()).is_none()
            && let Ok(function) = FreeFunction::new(name, arguments)
        {
            self.functions.push((function, value));
        }
    }

    pub fn parameter(&self, name: &str) -> Option<&Symbolic> {
        self.parameters.get(name)
    }

    /// The names of the arguments, and the value, of the function `name` with `count` arguments.
    pub fn function(&self, name: &str, count: usize) -> Option<(&[String], &Symbolic)> {
        let own =
            |(f, _): &&(FreeFunction, Symbolic)| f.name() == name && f.arguments().len() == count;
        self.functions.iter().find(own).map(|(f, value)| (f.arguments(), value))
    }

    pub fn has_no_functions(&self) -> bool {
        self.functions.is_empty()
    }
}

impl From<&BTreeMap<String, Symbolic>> for Substitution {
    /// Builds a substitution. The keys are names of parameters, and declarations of functions such
    /// as `a(t)`.
    fn from(values: &BTreeMap<String, Symbolic>) -> Self {
        let mut substitution = Substitution::default();
        for (name, value) in values {
            match FreeFunction::read(name) {
                Ok(function) => substitution.functions.push((function, value.clone())),
                Err(_) => drop(substitution.parameters.insert(name.clone(), value.clone())),
            }
        }
        substitution
    }
}

impl Symbolic {
    /// Substitutes `values[name]` for every parameter `name`, simultaneously. Other parameters are
    /// unchanged. A declared free function such as `a(t)` may be substituted too; its derivatives
    /// are then substituted accordingly.
    ///
    /// Returns `None` if the denominator becomes zero, or if a total degree could exceed `2^30`.
    /// Also returns `None` if a function has no exact value at its new argument, such as `log(-1)`,
    /// or `a(2)` for a free function.
    ///
    /// ```
    /// use affinor_tensors::Symbolic;
    /// let [a, b] = ["a", "b"].map(Symbolic::parameter);
    /// let swapped = [("a".to_owned(), b.clone()), ("b".to_owned(), a.clone())].into();
    /// let value = a / &b;
    /// assert_eq!(value.substitute(&swapped).unwrap().to_string(), "b/a");
    /// ```
    pub fn substitute(&self, values: &BTreeMap<String, Symbolic>) -> Option<Symbolic> {
        self.substitute_where(&PositiveFactors::default(), &values.into()).ok()
    }

    /// Substitutes as in [`substitute`](Self::substitute), but square roots and logarithms are
    /// evaluated under the assumption that the declared functions are positive.
    pub(super) fn substitute_where(
        &self,
        positive: &PositiveFactors,
        values: &Substitution,
    ) -> Result<Symbolic, String> {
        let Form::Fraction(f) = &self.0 else {
            return Ok(self.clone());
        };
        if !f.variables.iter().any(|variable| variable.changes(values)) {
            return Ok(self.clone());
        }
        let image_of = |variable: &Variable| match variable.changes(values) {
            true => variable.image(positive, values),
            false => Ok(Symbolic::variable(*variable)),
        };
        let given = f.variables.iter().map(image_of).collect::<Result<Vec<Symbolic>, _>>()?;
        if degree_bound(f, &given) > DEGREE_LIMIT {
            return Err(format!("the degree of {self} could exceed {DEGREE_LIMIT}"));
        }
        let mut value = image(&f.numerator, &given);
        for (part, exponent) in f.denominator.parts(&f.variables) {
            let part = image(&part.expanded(&f.variables), &given).recip();
            let part = part.ok_or_else(|| format!("the denominator of {self} becomes zero"))?;
            value *= &power(&part, exponent);
        }
        Ok(value)
    }

    /// The value as a float. The function `lookup` returns the value of each parameter.
    ///
    /// Returns `None` if a parameter is not found, or if the value is not a finite number. The
    /// numerator and the denominator are evaluated as polynomials in `tan(x/2)` and `exp(x)`. They
    /// overflow, or lose accuracy, near `x = pi`, for large exponents, and where terms cancel.
    pub fn evaluate(&self, lookup: impl Fn(&str) -> Option<f64>) -> Option<f64> {
        self.evaluate_at(&lookup)
    }

    pub(super) fn evaluate_at(&self, lookup: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
        let value = match &self.0 {
            Form::Constant(c) => c.to_f64(),
            Form::Fraction(f) => {
                let point = f.variables.iter().map(|variable| variable.evaluate(lookup));
                let point: Vec<f64> = point.collect::<Option<_>>()?;
                at(&f.numerator, &point) / at(&f.expanded_denominator(), &point)
            }
        };
        value.is_finite().then_some(value)
    }
}

/// The value of the polynomial at a point, in floats.
fn at(f: &Polynomial, point: &[f64]) -> f64 {
    let term = |exponents: &[u32], c: f64| {
        let powers = exponents.iter().zip(point).filter(|(e, _)| **e > 0);
        powers.fold(c, |value, (&e, x)| value * x.powf(e.into()))
    };
    f.terms.iter().map(|(m, c)| term(m.exps(), c.to_f64())).sum()
}

/// The value of the polynomial for symbolic values of its variables.
fn image(f: &Polynomial, values: &[Symbolic]) -> Symbolic {
    let mut powers = vec![BTreeMap::new(); values.len()];
    f.terms.iter().fold(Symbolic::zero(), |sum, (m, c)| {
        let mut term = Symbolic::constant(c.clone());
        for (k, &e) in m.exps().iter().enumerate().filter(|(_, e)| **e > 0) {
            let factor = powers[k].entry(e).or_insert_with(|| power(&values[k], e));
            term *= &*factor;
        }
        sum + &term
    })
}

fn power(value: &Symbolic, exponent: u32) -> Symbolic {
    match &value.0 {
        Form::Constant(c) => Symbolic::constant(num_traits::pow(c.clone(), exponent as usize)),
        Form::Fraction(f) => canonical::settled(f.power(exponent).into()),
    }
}

/// An upper bound of the total degrees of all intermediate numerators and denominators. The images
/// of `N` and `D` have a common denominator, whose degree is at most the sum over the variables.
/// Adding two fractions at most doubles the degree.
fn degree_bound(f: &Fraction, values: &[Symbolic]) -> u64 {
    let degrees = f.numerator.degrees().into_iter().zip(f.expanded_denominator().degrees());
    let degrees = degrees.map(|(n, d)| u64::from(n) + u64::from(d));
    let of_value = |value: &Symbolic| match &value.0 {
        Form::Constant(_) => 0,
        Form::Fraction(f) => u64::from(f.degree()),
    };
    let products = degrees.zip(values).map(|(d, v)| d.saturating_mul(of_value(v)));
    products.fold(0, |sum, d| sum.saturating_add(d.saturating_mul(2)))
}
