//! Rational approximations of numbers that contain roots and pi.

use super::Symbolic;
use super::variable::{Kind, Part, Variable};
use crate::scalar::{Field, Notation, Rational};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero, pow};

/// The number of binary digits after the point in approximations of roots.
const DIGITS: u32 = 256;

/// The decimal digits of pi. The first digit is before the point.
const PI: &str = "31415926535897932384626433832795028841971693993751058209749445923078164062862089";

impl Symbolic {
    /// A rational approximation of a number that contains roots and pi. It is far more accurate
    /// than a float, unless terms of the value cancel to more than 30 digits, or functions other
    /// than roots occur.
    ///
    /// Returns `None` if the value has parameters.
    ///
    /// ```
    /// use affinor_tensors::scalar::PositiveFactors;
    /// use affinor_tensors::Symbolic;
    /// let root = PositiveFactors::default().function("sqrt", &Symbolic::from(3))?;
    /// let near = (root - &Symbolic::from(1)).approximation().ok_or("parameters")?;
    /// assert!((near.to_f64() - (3f64.sqrt() - 1.0)).abs() < 1e-15);
    /// assert_eq!(Symbolic::parameter("a").approximation(), None);
    /// # Ok::<(), String>(())
    /// ```
    pub fn approximation(&self) -> Option<Rational> {
        if let Some(constant) = self.as_constant() {
            return Some(constant.clone());
        }
        let [above, below] =
            [self.numerator(), self.denominator()].map(|sum| sum.polynomial_near());
        Some(above? * &below?.recip()?)
    }

    fn polynomial_near(&self) -> Option<Rational> {
        self.terms().into_iter().try_fold(Rational::zero(), |sum, (powers, coefficient)| {
            let mut term = coefficient;
            for (variable, power) in powers {
                term *= &pow(variable.near()?, power as usize);
            }
            Some(sum + &term)
        })
    }
}

impl Variable {
    fn near(self) -> Option<Rational> {
        match self.kind() {
            Kind::Pi => {
                let unit = pow(BigInt::from(10), PI.len() - 1);
                Some(BigRational::new(PI.parse().ok()?, unit).into())
            }
            Kind::Root(Part { of, parts }) => {
                let unit = BigInt::from(1) << DIGITS;
                let power = BigRational::from_integer(pow(unit.clone(), *parts as usize));
                let scaled = (BigRational::from(&of.approximation()?) * power).to_integer();
                let root = (!scaled.is_negative()).then(|| scaled.nth_root(*parts))?;
                Some(BigRational::new(root, unit).into())
            }
            _ => Rational::from_f64(Symbolic::variable(self).to_f64()?),
        }
    }
}
