//! How functions of angles are written: in sines and cosines.
//!
//! A fraction in `t = tan(x/2)` is `A + B sin x` with `A` and `B` rational in `cos x` in one way
//! only: its even part, and its odd part divided by `sin x`. That is the normal form: sines occur
//! to the first power, denominators have none. Then factors `1 - cos^2 x` become `sin^2 x`, above
//! and below, and cancel: `cos(x)/sin(x)` rather than `sin(x)*cos(x)/(1 - cos(x)^2)`.

use super::Symbolic;
use super::elementary::{angle, half_tangent};
use crate::scalar::Ring;
use num_traits::{One, Zero, pow};

/// The value over the variables `sin(x)`, `cos(x)` in the place of every `tan(x/2)`. They are for
/// the eye only: that their squares add up to 1 is not known to the result.
pub(super) fn in_sines(value: &Symbolic) -> Symbolic {
    let variables = value.variables();
    let angles: Vec<&str> = variables.iter().filter_map(|name| angle(name)).collect();
    let split = angles.iter().fold(value.clone(), |value, x| split(&value, x));
    angles.iter().fold(split, |value, x| gathered(value, x))
}

fn sine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("sin({x})"))
}

fn cosine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("cos({x})"))
}

/// `A + B sin x`.
fn split(value: &Symbolic, x: &str) -> Symbolic {
    let name = half_tangent(x);
    let t = Symbolic::parameter(&name);
    let mirrored = value.substitute(&[(name.clone(), -t.clone())].into());
    // a degree beyond the bound of substitutions: left as it is
    let Some(mirrored) = mirrored else { return value.clone() };
    let half = Symbolic::one() / &Symbolic::from_i64(2);
    let even = (value.clone() + &mirrored) * &half;
    let odd = (value.clone() - &mirrored) * &half;
    let over_sine = (t.clone() * &t + &Symbolic::one()) / &(t.clone() + &t);
    in_cosine(&even, x, &name) + &(in_cosine(&(odd * &over_sine), x, &name) * &sine(x))
}

/// An even function of `t`, by `t^2 = (1 - cos x)/(1 + cos x)`. In lowest terms numerator and
/// denominator are even themselves.
fn in_cosine(value: &Symbolic, x: &str, t: &str) -> Symbolic {
    let [above, below] = [value.numerator(), value.denominator()].map(|part| part.terms());
    let power = |powers: &[(String, u32)]| {
        powers.iter().find(|(name, _)| name == t).map_or(0, |(_, power)| *power as usize / 2)
    };
    let highest = above.iter().chain(&below).map(|(powers, _)| power(powers)).max().unwrap_or(0);
    let (more, less) = (Symbolic::one() + &cosine(x), Symbolic::one() - &cosine(x));
    let image = |terms: &[(Vec<(String, u32)>, crate::Rational)]| {
        terms.iter().fold(Symbolic::zero(), |sum, (powers, coefficient)| {
            let others = powers.iter().filter(|(name, _)| name != t);
            let others = others.fold(Symbolic::constant(coefficient.clone()), |term, (name, e)| {
                term * &pow(Symbolic::parameter(name), *e as usize)
            });
            let k = power(powers);
            sum + &(others * &pow(less.clone(), k) * &pow(more.clone(), highest - k))
        })
    };
    image(&above) / &image(&below)
}

/// Factors `1 - cos^2 x` as `sin^2 x`.
fn gathered(value: Symbolic, x: &str) -> Symbolic {
    let square = Symbolic::one() - &(cosine(x) * &cosine(x));
    let ratio = sine(x) * &sine(x) / &square;
    let count = |part: Symbolic| {
        let quotients = std::iter::successors(Some(part), |part| Some(part.clone() / &square));
        quotients.skip(1).take_while(|part| part.denominator().is_one()).count()
    };
    if value.vanishes() {
        return value;
    }
    let (above, below) = (count(value.numerator()), count(value.denominator()));
    value * &pow(ratio.clone(), above) / &pow(ratio, below)
}
