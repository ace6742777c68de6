//! The form in which functions are written: angles in sines and cosines, roots below the line where that is shorter.
//!
//! Numerator and denominator are divided by the least power of `1 + t^2`, with `t = tan(x/2)`, that
//! makes both polynomials in `sin x` and `cos x`. They are linear in the sine: `1/(1 + t^2)` is
//! `(1 + cos x)/2`, `t/(1 + t^2)` is `sin(x)/2`, `t^2/(1 + t^2)` is `(1 - cos x)/2`. Then factors
//! `1 - cos^2 x` become `sin^2 x`. Polynomials are written in sines, or in powers of one total
//! degree, if that takes fewer terms: `a^2*sin(x)^2 + b^2*cos(x)^2`. Sines stay in denominators:
//! `1/(1 + sin x)` is shorter than `(1 - sin x)/cos^2 x`.

use super::argument::{by_power, by_powers};
use super::elementary::written_value;
use super::fraction::lowest_terms;
use super::polynomial::{Polynomial, constant};
use super::sum::SymbolicSum;
use super::variable::{Kind, Part, Variable};
use super::{Form, Rational, Symbolic};
use crate::scalar::function::Function;
use crate::scalar::{Field, Ring, Sum};
use num_traits::{One, Zero, pow};

/// The value as it is written.
pub(super) fn written(value: &Symbolic) -> Symbolic {
    let value = in_sines(value);
    let root = |variable: &Variable| matches!(variable.kind(), Kind::Root(_));
    let roots: Vec<Variable> = value.variables().iter().copied().filter(root).collect();
    roots.iter().fold(value, |value, root| below_the_line(&value, *root).unwrap_or(value))
}

/// Whether a variable occurs in written forms only.
pub(super) fn is_written(variable: &Variable) -> bool {
    matches!(variable.kind(), Kind::Written(..))
}

/// `1/sqrt(p)` for `sqrt(p)/p`; `None` unless a power of the root is a factor above and `p` one below.
fn below_the_line(value: &Symbolic, root: Variable) -> Option<Symbolic> {
    let (Form::Fraction(f), Kind::Root(Part { of, parts })) = (&value.0, root.kind()) else {
        return None;
    };
    let Form::Fraction(p) = &of.0 else { return None };
    let at = f.variables.iter().position(|own| *own == root)?;
    let above = by_power(&value.numerator(), root);
    let (coefficient, lower) = above.split_last()?;
    if lower.is_empty() || lower.iter().any(|other| !other.vanishes()) {
        return None;
    }
    let mut denominator = f.denominator.clone();
    denominator.monomial = (0..f.variables.len()).map(|at| f.denominator.exponent(at)).collect();
    let exponent = match &p.numerator.terms[..] {
        [_] => {
            let place = f.variables.iter().position(|own| *own == p.variables[0])?;
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
    denominator.monomial[at] += parts - lower.len() as u32;
    let negative = p.numerator.lc().is_some_and(Rational::is_negative);
    let one = constant(Rational::from(if negative { -1 } else { 1 }), f.variables.len());
    Some(coefficient.clone() * &lowest_terms(&f.variables, one, denominator))
}

/// The value with variables `sin(x)` and `cos(x)` in place of every `tan(x/2)`. It is for writing
/// only, because it does not contain the relation `sin^2 + cos^2 = 1`.
fn in_sines(value: &Symbolic) -> Symbolic {
    let mut value = value.clone();
    // a coefficient may be a function of a larger part of another angle
    while let Some((t, x)) = angle(&value) {
        value = shortest(&gathered(over_sines(&value, t, x), x), x);
    }
    value
}

/// A half tangent of the value, and its angle.
fn angle(value: &Symbolic) -> Option<(Variable, &'static Part)> {
    value.variables().iter().find_map(|variable| match variable.kind() {
        Kind::HalfTangent(part) => Some((*variable, part)),
        _ => None,
    })
}

/// The value with cosines and first powers of sines in place of half tangents; `None` if they occur in a denominator.
pub(super) fn in_cosines(value: &Symbolic) -> Option<Symbolic> {
    let mut value = value.clone();
    while let Some((t, x)) = angle(&value) {
        let over = over_sines(&value, t, x);
        let square = Symbolic::one() - &(cosine(x) * &cosine(x));
        let sines = by_power(&over.numerator(), sine_variable(x)).into_iter().enumerate();
        let above = sines.fold(Symbolic::zero(), |sum, (power, rest)| {
            sum + &(rest * &pow(square.clone(), power / 2) * &pow(sine(x), power % 2))
        });
        value = above / &over.denominator();
        let [sin, cos] = [sine_variable(x), cosine_variable(x)];
        let below = value.denominator();
        if below.variables().iter().any(|own| *own == sin || *own == cos) {
            return None;
        }
    }
    Some(value)
}

/// The value with half tangents in place of sines and cosines.
pub(super) fn in_half_tangents(value: &Symbolic) -> Symbolic {
    let mut value = value.clone();
    let written = |value: &Symbolic| value.variables().iter().copied().find(is_written);
    while let Some(variable) = written(&value) {
        let Kind::Written(function, part) = variable.kind() else { break };
        let image = written_value(*function, part);
        let above = by_power(&value.numerator(), variable).into_iter().rev();
        let above = above.fold(Symbolic::zero(), |sum, c| sum * &image + &c);
        value = above / &value.denominator();
    }
    value
}

fn sine_variable(x: &Part) -> Variable {
    Variable::function(Kind::Written(Function::Sin, x.clone()))
}

fn cosine_variable(x: &Part) -> Variable {
    Variable::function(Kind::Written(Function::Cos, x.clone()))
}

fn sine(x: &Part) -> Symbolic {
    Symbolic::variable(sine_variable(x))
}

fn cosine(x: &Part) -> Symbolic {
    Symbolic::variable(cosine_variable(x))
}

/// The value in the sine and cosine of `x`, where `t` is the variable `tan(x/2)`.
///
/// A polynomial of degree `d` in `t` becomes one in sine and cosine times `(1 + cos x)^h`, with `h = d/2` rounded up. Factors of the
/// denominator that are even in `t` contain no sines, and stay apart.
fn over_sines(value: &Symbolic, t: Variable, x: &Part) -> Symbolic {
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
fn in_sine(coefficients: &[Symbolic], h: usize, x: &Part) -> Symbolic {
    let part = |from: usize| coefficients.iter().skip(from).step_by(2);
    homogeneous(part(0), h, x) + &(homogeneous(part(1), h.saturating_sub(1), x) * &sine(x))
}

/// The reciprocal of a value other than zero.
fn inverse(value: &Symbolic) -> Symbolic {
    value.recip().unwrap_or_default()
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
    x: &Part,
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
fn gathered(value: Symbolic, x: &Part) -> Symbolic {
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
fn divisible(polynomial: &Symbolic, x: &Part) -> bool {
    let mut sums = [SymbolicSum::default(), SymbolicSum::default()];
    for ([power], part) in by_powers(polynomial, [cosine_variable(x)]) {
        sums[power % 2].add_term(&part);
    }
    sums.iter().all(|sum| sum.value().vanishes())
}

/// Polynomials of a higher degree are written in only one form.
const DEGREE: usize = 64;

/// The value with numerator and denominator each in the form with the fewest terms.
fn shortest(value: &Symbolic, x: &Part) -> Symbolic {
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
fn others(polynomial: &Symbolic, x: &Part) -> Vec<Symbolic> {
    let (sin, cos) = (sine(x), cosine(x));
    let [sin2, cos2] = [&sin, &cos].map(|f| f.clone() * f);
    let one = Symbolic::one();
    let split = by_powers(polynomial, [sine_variable(x), cosine_variable(x)]);
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
