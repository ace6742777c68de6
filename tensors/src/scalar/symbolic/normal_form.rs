//! The normal form in which functions of angles are written, in sines and cosines.
//!
//! Numerator and denominator are divided by the least power of `1 + t^2`, with `t = tan(x/2)`, that
//! makes both polynomials in `sin x` and `cos x`. They are linear in the sine: `1/(1 + t^2)` is
//! `(1 + cos x)/2`, `t/(1 + t^2)` is `sin(x)/2`, `t^2/(1 + t^2)` is `(1 - cos x)/2`. Then factors
//! `1 - cos^2 x` become `sin^2 x`. Polynomials are written in sines, or in powers of one total
//! degree, if that takes fewer terms: `a^2*sin(x)^2 + b^2*cos(x)^2`. Sines stay in denominators:
//! `1/(1 + sin x)` is shorter than `(1 - sin x)/cos^2 x`.

use super::Symbolic;
use super::elementary::{angle, half_tangent};
use crate::scalar::Ring;
use num_traits::{One, Zero, pow};

/// The value with variables `sin(x)` and `cos(x)` in place of every `tan(x/2)`. It is for writing
/// only, because it does not contain the relation `sin^2 + cos^2 = 1`.
pub(super) fn in_sines(value: &Symbolic) -> Symbolic {
    let variables = value.variables();
    let angles: Vec<&str> = variables.iter().filter_map(|name| angle(name)).collect();
    angles.iter().fold(value.clone(), |value, x| shortest(&gathered(over_sines(&value, x), x), x))
}

fn sine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("sin({x})"))
}

fn cosine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("cos({x})"))
}

fn over_sines(value: &Symbolic, x: &str) -> Symbolic {
    let t = half_tangent(x);
    let [above, below] = [value.numerator(), value.denominator()].map(|part| by_power(&part, &t));
    let highest = above.len().max(below.len()).saturating_sub(1).div_ceil(2);
    let image = |coefficients: &[Symbolic]| {
        let half = |from: usize| coefficients.iter().skip(from).step_by(2);
        let odd = homogeneous(half(1), highest.saturating_sub(1), x);
        homogeneous(half(0), highest, x) + &(odd * &sine(x))
    };
    image(&above) / &image(&below)
}

/// The coefficients of the powers of a variable, the constant first.
fn by_power(polynomial: &Symbolic, variable: &str) -> Vec<Symbolic> {
    let mut coefficients = Vec::new();
    for ([at], term) in apart(polynomial, [variable]) {
        coefficients.resize(coefficients.len().max(at + 1), Symbolic::zero());
        coefficients[at] += &term;
    }
    coefficients
}

/// The terms of a polynomial: the powers of some variables, and the rest of the term.
fn apart<const N: usize>(
    polynomial: &Symbolic,
    variables: [&str; N],
) -> impl Iterator<Item = ([usize; N], Symbolic)> {
    polynomial.terms().into_iter().map(move |(powers, c)| {
        let power = |variable| {
            let found = powers.iter().find(|(name, _)| name == variable);
            found.map_or(0, |(_, e)| *e as usize)
        };
        let others = powers.iter().filter(|(name, _)| !variables.contains(&&**name));
        let rest = others.fold(Symbolic::constant(c), |rest, (name, e)| {
            rest * &pow(Symbolic::parameter(name), *e as usize)
        });
        (variables.map(power), rest)
    })
}

/// `sum p_a (1 - cos x)^a (1 + cos x)^(degree - a)`, by Horner's rule.
fn homogeneous<'s>(
    coefficients: impl DoubleEndedIterator<Item = &'s Symbolic> + ExactSizeIterator,
    degree: usize,
    x: &str,
) -> Symbolic {
    let (more, less) = (Symbolic::one() + &cosine(x), Symbolic::one() - &cosine(x));
    let mut power = pow(more.clone(), (degree + 1).saturating_sub(coefficients.len()));
    coefficients.rev().fold(Symbolic::zero(), |sum, p| {
        let next = sum * &less + &(p.clone() * &power);
        power = power.clone() * &more;
        next
    })
}

/// Replaces factors `1 - cos^2 x` by `sin^2 x`.
fn gathered(value: Symbolic, x: &str) -> Symbolic {
    if value.vanishes() {
        return value;
    }
    let square = Symbolic::one() - &(cosine(x) * &cosine(x));
    let ratio = sine(x) * &sine(x) / &square;
    let count = |part: Symbolic| {
        let quotients = std::iter::successors(Some(part), |part| Some(part.clone() / &square));
        quotients.skip(1).take_while(|part| part.denominator().is_one()).count()
    };
    let (above, below) = (count(value.numerator()), count(value.denominator()));
    value * &pow(ratio.clone(), above) / &pow(ratio, below)
}

/// Polynomials of a higher degree are written in only one form.
const DEGREE: usize = 64;

/// The value with numerator and denominator each in the form with the fewest terms.
fn shortest(value: &Symbolic, x: &str) -> Symbolic {
    let [above, below] = [value.numerator(), value.denominator()].map(|part| {
        let count = |form: &Symbolic| form.terms().len();
        let forms = others(&part, x).into_iter();
        forms.fold(part, |best, form| if count(&form) < count(&best) { form } else { best })
    });
    above / &below
}

/// The other forms of a polynomial: with as few sines or cosines as possible, and homogeneous.
fn others(polynomial: &Symbolic, x: &str) -> Vec<Symbolic> {
    let (sin, cos) = (sine(x), cosine(x));
    let [sin2, cos2] = [&sin, &cos].map(|f| f.clone() * f);
    let one = Symbolic::one();
    let names = [format!("sin({x})"), format!("cos({x})")];
    let split: Vec<_> = apart(polynomial, names.each_ref().map(String::as_str)).collect();
    let highest = split.iter().map(|([s, c], _)| s + c).max().unwrap_or(0);
    if highest > DEGREE {
        return Vec::new();
    }
    let sum = |form: &dyn Fn(usize, usize) -> Symbolic| {
        let terms = split.iter().map(|([s, c], rest)| rest.clone() * &form(*s, *c));
        terms.fold(Symbolic::zero(), |sum, term| sum + &term)
    };
    let even = split.iter().all(|([s, c], _)| (highest - s - c) % 2 == 0);
    let by_cosines = sum(&|s, c| {
        pow(one.clone() - &cos2, s / 2) * &pow(sin.clone(), s % 2) * &pow(cos.clone(), c)
    });
    let by_sines = sum(&|s, c| {
        pow(one.clone() - &sin2, c / 2) * &pow(cos.clone(), c % 2) * &pow(sin.clone(), s)
    });
    let of_one_degree = even.then(|| {
        sum(&|s, c| {
            let rest = pow(sin2.clone() + &cos2, (highest - s - c) / 2);
            rest * &pow(sin.clone(), s) * &pow(cos.clone(), c)
        })
    });
    [by_cosines, by_sines].into_iter().chain(of_one_degree).collect()
}
