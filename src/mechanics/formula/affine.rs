//! Formulas that are affine in some of their names.

use affinor_tensors::Rational;
use affinor_tensors::expression::{Evaluator, Expression, ExpressionError};
use num_traits::Zero;

/// The terms of a formula that is affine in some names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AffineTerms {
    /// Whether there are terms without these names.
    pub constant: bool,
    /// Whether there are terms with one of these names.
    pub linear: bool,
}

/// The terms of a formula that must be affine in the names for which `is_linear` is true. Only the
/// form of the formula counts: terms that cancel are terms.
///
/// ```
/// use affinor::mechanics::formula::affine_terms;
/// let in_velocity = |name: &str| name.starts_with('v');
/// let slope = affine_terms("2*v1 - sin(x)*v2", &in_velocity)?;
/// assert!(slope.linear && !slope.constant);
/// let error = affine_terms("v1 + x*v1*v2", &in_velocity).unwrap_err();
/// assert_eq!(error.span, 5..12);
/// # Ok::<(), affinor::tensors::expression::ExpressionError>(())
/// ```
///
/// # Errors
/// A syntax error, and an error with its position in the text if the formula is not affine in these
/// names.
pub fn affine_terms(
    text: &str,
    is_linear: &dyn Fn(&str) -> bool,
) -> Result<AffineTerms, ExpressionError> {
    Expression::parse(text)?.evaluate(&Terms(is_linear))
}

struct Terms<'n>(&'n dyn Fn(&str) -> bool);

const CONSTANT: AffineTerms = AffineTerms { constant: true, linear: false };

/// The terms of a function of these terms. A function is not affine.
fn of_constant(a: AffineTerms, what: &str) -> Result<AffineTerms, String> {
    if a.linear {
        return Err(format!("{what} a velocity is not affine in the velocity"));
    }
    Ok(CONSTANT)
}

impl Evaluator for Terms<'_> {
    type Value = AffineTerms;

    fn number(&self, number: &Rational) -> Result<AffineTerms, String> {
        Ok(AffineTerms { constant: !number.is_zero(), linear: false })
    }

    fn name(&self, name: &str) -> Result<AffineTerms, String> {
        let linear = (self.0)(name);
        Ok(AffineTerms { constant: !linear, linear })
    }

    fn add(&self, a: AffineTerms, b: AffineTerms) -> Result<AffineTerms, String> {
        Ok(AffineTerms { constant: a.constant || b.constant, linear: a.linear || b.linear })
    }

    fn multiply(&self, a: AffineTerms, b: AffineTerms) -> Result<AffineTerms, String> {
        if a.linear && b.linear {
            return Err("a product of velocities is not affine in the velocity".into());
        }
        Ok(AffineTerms {
            constant: a.constant && b.constant,
            linear: a.linear && b.constant || a.constant && b.linear,
        })
    }

    fn negate(&self, a: AffineTerms) -> AffineTerms {
        a
    }

    fn reciprocal(&self, a: AffineTerms) -> Result<AffineTerms, String> {
        of_constant(a, "a quotient by")
    }

    fn raise(&self, base: AffineTerms, exponent: AffineTerms) -> Result<AffineTerms, String> {
        of_constant(base, "a power of").and(of_constant(exponent, "a power by"))
    }

    fn function(&self, _: &str, argument: AffineTerms) -> Result<AffineTerms, String> {
        of_constant(argument, "a function of")
    }

    fn call(&self, _: &str, arguments: Vec<AffineTerms>) -> Result<AffineTerms, String> {
        arguments
            .into_iter()
            .try_fold(CONSTANT, |_, argument| of_constant(argument, "a function of"))
    }
}
