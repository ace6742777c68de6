//! Values over another scalar, computed in the form in which they are written.

use super::common::CommonFactors;
use super::shape::Shaping;
use super::variable::{Kind, Part, Variable};
use super::{Form, Symbolic, memo};
use crate::expression::{Scalars, no_function};
use crate::scalar::{Notation, Rational};
use num_traits::{One, pow};

impl Symbolic {
    /// The value over a scalar with elementary functions; `variable` gives the values of parameters and free functions.
    ///
    /// # Errors
    /// In words: a number or a function that the scalar does not have, or a division by zero.
    pub(in crate::scalar) fn in_scalars<S: Notation>(
        &self,
        variable: &dyn Fn(Variable) -> S,
    ) -> Result<S, String> {
        let names = CommonFactors::default();
        let number = |c: &Rational| S::from_rational(c).ok_or("the number is beyond the range of f64");
        match &names.written(self).0 {
            Form::Constant(c) => Ok(number(c)?),
            Form::Fraction(f) => {
                let shape = memo::shape(f, || Shaping { names: &names }.fraction(f));
                let meaning = Scalars(|name: &str| Err(format!("`{name}` is unknown")), no_function);
                shape.evaluate(&meaning, &mut |at, e| f.variables[at].power_in(e, variable))
            }
        }
    }
}

impl Variable {
    /// A power of the variable over a scalar.
    fn power_in<S: Notation>(self, e: u32, variable: &dyn Fn(Variable) -> S) -> Result<S, String> {
        let fraction = |value: &Symbolic, above: u32, below: u32| {
            let factor = Rational::new(above.into(), below.into()).unwrap_or_else(Rational::one);
            (value.clone() * &Symbolic::constant(factor)).in_scalars(variable)
        };
        let call = |name: &str, Part { of, parts }: &Part| S::function(name, &fraction(of, 1, *parts)?);
        let value = match self.kind() {
            Kind::Parameter(_) | Kind::Applied(_) => variable(self),
            Kind::HalfTangent(Part { of, parts }) => S::function("tan", &fraction(of, 1, 2 * parts)?)?,
            Kind::Exponential(Part { of, parts }) => {
                return S::function("exp", &fraction(of, e, *parts)?);
            }
            Kind::Logarithm(p) => S::function("log", &p.in_scalars(variable)?)?,
            Kind::Root(Part { of, parts: 2 }) => S::function("sqrt", &of.in_scalars(variable)?)?,
            Kind::Root(Part { of, parts }) => {
                let logarithm = S::function("log", &of.in_scalars(variable)?)?;
                let exponent = Rational::new(e.into(), (*parts).into()).unwrap_or_else(Rational::one);
                let exponent = S::from_rational(&exponent).unwrap_or_else(S::one);
                return S::function("exp", &(logarithm * &exponent));
            }
            Kind::Written(function, part) => call(function.name(), part)?,
        };
        Ok(pow(value, e as usize))
    }
}
