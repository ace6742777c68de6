//! The form in which functions are written: angles in sines and cosines, roots below the line where that is shorter.
//!
//! Numerator and denominator are divided by the least power of `1 + t^2`, with `t = tan(x/2)`, that
//! makes both polynomials in `sin x` and `cos x`. They are linear in the sine: `1/(1 + t^2)` is
//! `(1 + cos x)/2`, `t/(1 + t^2)` is `sin(x)/2`, `t^2/(1 + t^2)` is `(1 - cos x)/2`. Then factors
//! `1 - cos^2 x` become `sin^2 x`. Polynomials are written in sines, or in powers of one total
//! degree, if that takes fewer terms: `a^2*sin(x)^2 + b^2*cos(x)^2`. Sines stay in denominators:
//! `1/(1 + sin x)` is shorter than `(1 - sin x)/cos^2 x`.

use super::elementary::{Variable, Variable::Root, angle};
use super::fraction::lowest_terms;
use super::polynomial::{Polynomial, constant};
use super::sum::SymbolicSum;
use super::{Form, Rational, Symbolic};
use crate::scalar::{Field, Ring, Sum};
use num_traits::{One, Zero, pow};
use polycore::{Monomial, Poly};
use std::collections::BTreeMap;
use std::mem;

/// The value as it is written.
pub(super) fn written(value: &Symbolic) -> Symbolic {
    let value = in_sines(value);
    let roots = value.variables().iter().filter(|name| matches!(Variable::of(name), Root(_)));
    let roots: Vec<_> = roots.cloned().collect();
    roots.iter().fold(value, |value, root| below_the_line(&value, root).unwrap_or(value))
}

/// `1/sqrt(p)` for `sqrt(p)/p`; `None` unless the root is a factor above and `p` one below.
fn below_the_line(value: &Symbolic, root: &str) -> Option<Symbolic> {
    let (Form::Fraction(f), Root(p)) = (&value.0, Variable::of(root)) else { return None };
    let Form::Fraction(p) = p.parse::<Symbolic>().ok()?.0 else { return None };
    let at = f.variables.iter().position(|name| **name == *root)?;
    let above = by_power(&value.numerator(), root);
    let [zero, coefficient] = &above[..] else { return None };
    if !zero.vanishes() {
        return None;
    }
    let mut denominator = f.denominator.clone();
    denominator.monomial = (0..f.variables.len()).map(|at| f.denominator.exponent(at)).collect();
    let exponent = match &p.numerator.terms[..] {
        [_] => {
            let place = f.variables.iter().position(|name| *name == p.variables[0])?;
            &mut denominator.monomial[place]
        }
        _ => {
            let same = |g: &Polynomial| *g == p.numerator || *g == -&p.numerator;
            let factors = denominator.factors.iter_mut();
            let found = factors.filter(|(g, _)| g.variables == p.variables && same(&g.polynomial));
            &mut found.last()?.1
        }
    };
    *exponent = exponent.checked_sub(1)?;
    denominator.factors.retain(|(_, e)| *e > 0);
    denominator.monomial[at] += 1;
    let negative = p.numerator.lc().is_some_and(Rational::is_negative);
    let one = constant(Rational::from(if negative { -1 } else { 1 }), f.variables.len());
    Some(coefficient.clone() * &lowest_terms(&f.variables, one, denominator))
}

/// The value with variables `sin(x)` and `cos(x)` in place of every `tan(x/2)`. It is for writing
/// only, because it does not contain the relation `sin^2 + cos^2 = 1`.
fn in_sines(value: &Symbolic) -> Symbolic {
    let mut value = value.clone();
    // a coefficient may be a function of a larger part of another angle
    while let Some((t, x)) = value.variables().iter().find_map(|t| Some((*t, angle(t)?))) {
        value = shortest(&gathered(over_sines(&value, &t, &x), &x), &x);
    }
    value
}

fn sine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("sin({x})"))
}

fn cosine(x: &str) -> Symbolic {
    Symbolic::parameter(&format!("cos({x})"))
}

/// The value in the sine and cosine of `x`, where `t` is the variable `tan(x/2)`.
///
/// A polynomial of degree `d` in `t` becomes one in sine and cosine times `(1 + cos x)^h`, with `h = d/2` rounded up. Factors of the
/// denominator that are even in `t` contain no sines, and stay apart.
fn over_sines(value: &Symbolic, t: &str, x: &str) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value.clone() };
    let half = |coefficients: &[Symbolic]| coefficients.len().saturating_sub(1).div_ceil(2);
    let mut below = Symbolic::one();
    let (mut rest, mut degree) = (Symbolic::one(), 0);
    for (part, exponent) in f.denominator.parts(&f.variables) {
        let polynomial = f.polynomial(&part.expanded(&f.variables));
        let coefficients = by_power(&polynomial, t);
        if coefficients.iter().skip(1).step_by(2).all(Symbolic::vanishes) {
            let image = in_sine(&coefficients, half(&coefficients), x);
            below *= &pow(inverse(&image), exponent as usize);
            degree += half(&coefficients) * exponent as usize;
        } else {
            rest *= &pow(polynomial, exponent as usize);
        }
    }
    let rest = by_power(&rest, t);
    below *= &inverse(&in_sine(&rest, half(&rest), x));
    degree += half(&rest);
    let above = by_power(&value.numerator(), t);
    let highest = half(&above).max(degree);
    if highest > degree {
        below *= &pow(inverse(&(Symbolic::one() + &cosine(x))), highest - degree);
    }
    in_sine(&above, highest, x) * &below
}

/// The polynomial with these coefficients in `tan(x/2)` times `(1 + cos x)^h`.
fn in_sine(coefficients: &[Symbolic], h: usize, x: &str) -> Symbolic {
    let part = |from: usize| coefficients.iter().skip(from).step_by(2);
    homogeneous(part(0), h, x) + &(homogeneous(part(1), h.saturating_sub(1), x) * &sine(x))
}

/// The reciprocal of a value other than zero.
fn inverse(value: &Symbolic) -> Symbolic {
    value.recip().unwrap_or_default()
}

/// The coefficients of the powers of a variable, the constant first.
fn by_power(polynomial: &Symbolic, variable: &str) -> Vec<Symbolic> {
    let mut coefficients = Vec::new();
    for ([at], part) in apart(polynomial, [variable]) {
        coefficients.resize(at, Symbolic::zero());
        coefficients.push(part);
    }
    coefficients
}

/// A polynomial by the powers of some variables: the rest of the terms with each.
fn apart<const N: usize>(
    polynomial: &Symbolic,
    variables: [&str; N],
) -> BTreeMap<[usize; N], Symbolic> {
    let Form::Fraction(f) = &polynomial.0 else {
        let constant = (!polynomial.vanishes()).then(|| ([0; N], polynomial.clone()));
        return constant.into_iter().collect();
    };
    let columns = variables.map(|name| f.variables.iter().position(|own| **own == *name));
    let mut parts = BTreeMap::<_, Vec<_>>::new();
    for (monomial, c) in &f.numerator.terms {
        let mut rest = monomial.exps().to_vec();
        let powers = columns.map(|k| k.map_or(0, |k| mem::take(&mut rest[k]) as usize));
        // of equal powers, so that the order of the terms stays
        parts.entry(powers).or_default().push((Monomial::new(rest), c.clone()));
    }
    let polynomial = |terms| Poly { terms, ..f.numerator.clone() };
    parts.into_iter().map(|(at, terms)| (at, f.polynomial(&polynomial(terms)))).collect()
}

/// The number of terms of the numerator.
fn length(value: &Symbolic) -> usize {
    match &value.0 {
        Form::Constant(_) => usize::from(!value.vanishes()),
        Form::Fraction(f) => f.numerator.terms.len(),
    }
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
    let count = |part: Symbolic| {
        let divided = |part: &Symbolic| divisible(part, x).then(|| part.clone() / &square);
        std::iter::successors(Some(part), divided).count() - 1
    };
    let (above, below) = (count(value.numerator()), count(value.denominator()));
    if above == below {
        return value;
    }
    let ratio = sine(x) * &sine(x) / &square;
    value * &pow(ratio.clone(), above) / &pow(ratio, below)
}

/// Whether a polynomial is divisible by `1 - cos^2 x`: zero where `cos x` is 1 and where it is -1.
fn divisible(polynomial: &Symbolic, x: &str) -> bool {
    let mut sums = [SymbolicSum::default(), SymbolicSum::default()];
    for ([power], part) in apart(polynomial, [&format!("cos({x})")]) {
        sums[power % 2].add_term(&part);
    }
    sums.iter().all(|sum| sum.value().vanishes())
}

/// Polynomials of a higher degree are written in only one form.
const DEGREE: usize = 64;

/// The value with numerator and denominator each in the form with the fewest terms.
fn shortest(value: &Symbolic, x: &str) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value.clone() };
    let [above, below] = [value.numerator(), value.denominator()].map(|part| {
        let forms = others(&part, x).into_iter();
        let shorter = |best: Option<Symbolic>, form| match length(&form) {
            found if found < length(best.as_ref().unwrap_or(&part)) => Some(form),
            _ => best,
        };
        forms.fold(None, shorter)
    });
    let one = constant(Rational::one(), f.variables.len());
    let below = match below {
        Some(below) => inverse(&below),
        None => lowest_terms(&f.variables, one, f.denominator.clone()),
    };
    above.unwrap_or_else(|| value.numerator()) * &below
}

/// The other forms of a polynomial: with as few sines or cosines as possible, and homogeneous.
fn others(polynomial: &Symbolic, x: &str) -> Vec<Symbolic> {
    let (sin, cos) = (sine(x), cosine(x));
    let [sin2, cos2] = [&sin, &cos].map(|f| f.clone() * f);
    let one = Symbolic::one();
    let names = [format!("sin({x})"), format!("cos({x})")];
    let split = apart(polynomial, names.each_ref().map(String::as_str));
    let highest = split.keys().map(|[s, c]| s + c).max().unwrap_or(0);
    if highest > DEGREE {
        return Vec::new();
    }
    let sum = |form: &dyn Fn(usize, usize) -> Symbolic| {
        let mut sum = SymbolicSum::default();
        split.iter().for_each(|([s, c], rest)| sum.add_product(rest, &form(*s, *c)));
        sum.value()
    };
    let even = split.keys().all(|[s, c]| (highest - s - c) % 2 == 0);
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
