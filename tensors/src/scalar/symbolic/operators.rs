//! The operators of rational functions, and the conversions to and from other types.

use super::sum::SymbolicSum;
use super::{Form, Rational, Symbolic, once};
use crate::expression::{Expression, ExpressionError, Scalars};
use crate::scalar::Field;
use crate::scalar::operators::forward_operators;
use num_traits::{One, Zero};
use std::hash::{Hash, Hasher};
use std::ops::{Add, Div, Mul, Neg};

impl Add<&Symbolic> for Symbolic {
    type Output = Symbolic;
    fn add(self, other: &Symbolic) -> Symbolic {
        match (self.0, &other.0) {
            (Form::Constant(a), Form::Constant(b)) => Symbolic::constant(a + b),
            (f, Form::Constant(c)) if c.is_zero() => Symbolic(f),
            (Form::Constant(c), f) if c.is_zero() => Symbolic(f.clone()),
            (Form::Fraction(f), Form::Constant(c)) => f.plus(c).into(),
            (Form::Constant(c), Form::Fraction(f)) => f.plus(&c).into(),
            (Form::Fraction(f), Form::Fraction(g)) => SymbolicSum::of_terms([f, g.clone()]),
        }
    }
}

impl Mul<&Symbolic> for Symbolic {
    type Output = Symbolic;
    /// # Panics
    /// If a total degree exceeds `u32::MAX`; sums of fractions panic for the same reason.
    /// [`Notation::size`](crate::Notation::size) is at least the degree, so a limit on the size of
    /// input prevents this.
    fn mul(self, other: &Symbolic) -> Symbolic {
        match (self.0, &other.0) {
            (Form::Constant(a), Form::Constant(b)) => Symbolic::constant(a * b),
            (Form::Fraction(f), Form::Fraction(g)) => SymbolicSum::of_product([f, g.clone()]),
            (f, Form::Constant(c)) => scaled(f, c),
            (Form::Constant(c), f) => scaled(f.clone(), &c),
        }
    }
}

/// The product of the value and a constant.
fn scaled(form: Form, c: &Rational) -> Symbolic {
    match form {
        _ if c.is_zero() => Symbolic::zero(),
        form if c.is_one() => Symbolic(form),
        Form::Fraction(f) => once::multiple(c, &f),
        Form::Constant(a) => Symbolic::constant(a * c),
    }
}

impl Div<&Symbolic> for Symbolic {
    type Output = Symbolic;
    /// # Panics
    /// If `other` is zero, as for integers. [`Field::recip`] returns `None` instead.
    fn div(self, other: &Symbolic) -> Symbolic {
        self.mul(&other.recip().expect("division by zero"))
    }
}

impl Neg for Symbolic {
    type Output = Symbolic;
    fn neg(self) -> Symbolic {
        match self.0 {
            Form::Constant(c) => Symbolic::constant(-c),
            Form::Fraction(f) => once::multiple(&-Rational::one(), &f),
        }
    }
}

forward_operators!(Symbolic: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign, Div div DivAssign div_assign);

impl From<Rational> for Symbolic {
    fn from(value: Rational) -> Self {
        Symbolic::constant(value)
    }
}

impl std::str::FromStr for Symbolic {
    type Err = ExpressionError;

    /// Parses an [`Expression`] in any parameters, such as `(a^2 - b)/(4*c)`, `sin(2*x)`, and free
    /// functions `f(x)`.
    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        let value =
            |name: &str| if name == "pi" { Symbolic::pi() } else { Symbolic::parameter(name) };
        let names = Scalars(|name: &str| Ok(value(name)), Self::called);
        Expression::parse(text)?.evaluate(&names)
    }
}

/// Hashes variables and numerators, which are equal for equal values.
impl Hash for Symbolic {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match &self.0 {
            Form::Constant(c) => c.hash(state),
            Form::Fraction(f) => {
                f.variables.hash(state);
                f.numerator.terms.hash(state);
            }
        }
    }
}
