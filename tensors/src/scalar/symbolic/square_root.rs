//! Square roots of squares, up to sign.

use super::factors::{Factors, factors};
use super::{Form, Symbolic};
use crate::Rational;
use crate::scalar::Field;
use num_integer::Roots;
use num_rational::Ratio;
use num_traits::{One, pow};

impl Symbolic {
    /// A function whose square is this function up to a rational factor, if the factors of this
    /// function show one. Unlike a root, it changes its sign where the function touches zero.
    ///
    /// ```
    /// use affinor_tensors::{Notation, Symbolic};
    /// let r: Symbolic = "r".parse()?;
    /// let sine = <Symbolic as Notation>::call("sin", &["theta".parse()?])?;
    /// let volume = r.clone() * &r * &sine;
    /// assert_eq!((-(volume.clone() * &volume)).root_up_to_factor(), Some(volume));
    /// assert_eq!(r.root_up_to_factor(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn root_up_to_factor(&self) -> Option<Symbolic> {
        let root = self.halved(|e| e.is_multiple_of(2).then_some(e / 2))?;
        let ratio = self.clone() * &(root.clone() * &root).recip()?;
        let factor = ratio.as_constant().and_then(rational_root);
        Some(root * &Symbolic::constant(factor.unwrap_or_else(Rational::one)))
    }

    /// A function whose square divides this function: the quotient has only simple factors. A
    /// root is then needed of the quotient alone.
    ///
    /// ```
    /// use affinor_tensors::Symbolic;
    /// let value: Symbolic = "3*r^4*(r - a)^3".parse()?;
    /// let root = value.square_factor();
    /// assert_eq!((value / &(root.clone() * &root)).to_string(), "-3*a + 3*r");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn square_factor(&self) -> Symbolic {
        self.halved(|e| Some(e / 2)).unwrap_or_else(Symbolic::one)
    }

    /// The product of the irreducible factors with the exponents that `half` returns, as far as
    /// factors are found.
    fn halved(&self, half: impl Fn(u32) -> Option<u32>) -> Option<Symbolic> {
        let f = match &self.0 {
            Form::Constant(_) => return Some(Symbolic::one()),
            Form::Fraction(f) => f,
        };
        let Factors { factors, .. } = factors(&f.numerator);
        let times = |product: Symbolic, factor: Symbolic, e: u32| {
            half(e).map(|e| product * &pow(factor, e as usize))
        };
        let above = factors.iter().try_fold(Symbolic::one(), |product, (factor, e)| {
            times(product, f.polynomial(factor), *e)
        })?;
        let below = f.denominator.all(&f.variables);
        let below = below.iter().try_fold(Symbolic::one(), |product, (factor, e)| {
            times(product, f.polynomial(factor), *e)
        })?;
        Some(above * &below.recip()?)
    }
}

/// The root of the absolute value of a number, if it is a rational number of word size.
fn rational_root(value: &Rational) -> Option<Rational> {
    let value = Ratio::<i64>::try_from(value).ok()?;
    let [numerator, denominator] = [value.numer().checked_abs()?, *value.denom()].map(|n| {
        let root = n.sqrt();
        (root * root == n).then_some(root)
    });
    Rational::new(numerator?, denominator?)
}
