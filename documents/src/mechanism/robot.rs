//! The numbers of robots as exact values.
//!
//! A URDF file has decimals, also where an angle of 90 degrees is meant. Angles that agree with a
//! multiple of 30 or 45 degrees in all decimals are such multiples, so that loops close exactly. The
//! tangent of half of any other angle is rounded to a rational number: its rotation is exact, and
//! differs from the rotation of the file by rounding errors.

use crate::input::urdf::pose::Number;
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::{Field, Rational, Ring, Symbolic};
use num_traits::{One, Zero};
use std::f64::consts::PI;

/// The largest distance of a rounded angle from the multiple that is meant, as in 1.57 for a right
/// angle.
const ROUNDED: f64 = 1e-3;
/// The size below which a number is the rounding error of zero, as in 6.1e-17 for the cosine of a
/// right angle.
const NOISE: f64 = 1e-14;
/// The number of digits behind the point of a number in scientific notation that is not rounded.
const DIGITS: i32 = 16;

impl Number for Symbolic {
    fn of(number: f64) -> Self {
        Symbolic::from(if number.abs() < NOISE { Rational::zero() } else { decimal(number) })
    }

    fn turn(angle: f64) -> [Self; 2] {
        let degrees = (0..24).map(|k| 15 * k).filter(|d| d % 30 == 0 || d % 45 == 0);
        let turns = (angle / (2.0 * PI)).floor() * 360.0;
        let unit = 10f64.powi(-decimals(angle)).clamp(f64::EPSILON * 8.0, ROUNDED);
        let meant = |d: &i32| {
            [0.0, 360.0]
                .iter()
                .any(|more| ((turns + f64::from(*d) + more).to_radians() - angle).abs() <= unit)
        };
        match degrees.into_iter().find(meant).and_then(special) {
            Some(values) => values,
            None => of_half(decimal((0.5 * angle).tan())),
        }
    }
}

/// The shortest decimal that parses to this float: the decimal of the file, up to 15 digits.
fn decimal(number: f64) -> Rational {
    format!("{number:e}").parse().unwrap_or_else(|_| Rational::zero())
}

/// The number of decimals of the shortest decimal.
fn decimals(number: f64) -> i32 {
    let text = format!("{number:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let behind = mantissa.split_once('.').map_or(0, |(_, behind)| behind.len() as i32);
    (behind - exponent.parse().unwrap_or(0)).clamp(0, DIGITS)
}

/// Cosine and sine of a multiple of 30 or 45 degrees.
fn special(degrees: i32) -> Option<[Symbolic; 2]> {
    let cos = |degrees: i32| -> Option<Symbolic> {
        let half = |square: i64| -> Option<Symbolic> {
            let root = PositiveFactors::default().function("sqrt", &Symbolic::from(square)).ok()?;
            Some(root * &Symbolic::from_quotient(1, 2)?)
        };
        // the squares of twice the cosine
        let (folded, sign) = match degrees.rem_euclid(360) {
            d @ 0..=90 => (d, 1),
            d @ 91..=180 => (180 - d, -1),
            d @ 181..=270 => (d - 180, -1),
            d => (360 - d, 1),
        };
        let value = half(match folded {
            0 => 4,
            30 => 3,
            45 => 2,
            60 => 1,
            _ => return Some(Symbolic::zero()),
        })?;
        Some(if sign > 0 { value } else { -value })
    };
    Some([cos(degrees)?, cos(degrees - 90)?])
}

/// Cosine and sine of an angle, from the tangent of its half.
fn of_half(t: Rational) -> [Symbolic; 2] {
    let square = t.clone() * &t;
    let sum = Rational::one() + &square;
    // a sum of one and a square has an inverse
    let inverse = sum.recip().unwrap_or_else(Rational::one);
    let cos = (Rational::one() - &square) * &inverse;
    [cos.into(), ((t.clone() + &t) * &inverse).into()]
}
