//! The written form of functions. Angles occur in sines and cosines, and roots in the denominator
//! if this form is shorter.
//!
//! Let `t = tan(x/2)`. The numerator and the denominator are divided by the least power of
//! `1 + t^2` for which both become polynomials in `sin x` and `cos x`. These polynomials are linear
//! in the sine: `1/(1 + t^2)` is `(1 + cos x)/2`, `t/(1 + t^2)` is `sin(x)/2`, `t^2/(1 + t^2)` is
//! `(1 - cos x)/2`. Then factors `1 - cos^2 x` become `sin^2 x`. Polynomials are written in sines,
//! or in powers of one total degree, if that takes fewer terms: `a^2*sin(x)^2 + b^2*cos(x)^2`.
//! Sines remain in denominators, because `1/(1 + sin x)` is shorter than `(1 - sin x)/cos^2 x`.
//! Hyperbolic functions are written in the same way, with `T = tanh(x/2)`.

use super::argument::{by_power, by_powers};
use super::conjugates::cancelled;
use super::elementary::written_value;
use super::fraction::lowest_terms;
use super::polynomial::{Polynomial, constant};
use super::sum::SymbolicSum;
use super::variable::{Kind, Part, Variable};
use super::{Form, Rational, Symbolic};
use crate::function::Function;
use crate::scalar::{Field, Ring, Sum};
use num_traits::{One, Zero, pow};

/// The written form of a value.
pub(super) fn written(value: &Symbolic) -> Symbolic {
    let value = in_sines(&cancelled(value.clone()));
    let root = |variable: &Variable| matches!(variable.kind(), Kind::Root(_));
    let roots: Vec<Variable> = value.variables().iter().copied().filter(root).collect();
    roots.iter().fold(value, |value, root| below_the_line(&value, *root).unwrap_or(value))
}

/// Whether a variable occurs only in written forms.
pub(super) fn is_written(variable: &Variable) -> bool {
    matches!(variable.kind(), Kind::Written(..))
}

/// Rewrites `sqrt(p)/p` as `1/sqrt(p)`. Returns `None` unless a power of the root is a factor of
/// the numerator, and `p` is a factor of the denominator.
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

/// The value in which the variables `sin(x)` and `cos(x)` replace every `tan(x/2)`. If powers of an
/// exponential of `x` and of `-x` occur symmetrically, hyperbolic functions replace them. The
/// result can only be written, because it does not contain the relation `sin^2 + cos^2 = 1`.
fn in_sines(value: &Symbolic) -> Symbolic {
    let mut value = value.clone();
    // repeats the replacement, because a coefficient may be a function of another angle
    while let Some((t, x)) = angle(&value) {
        value = shortest(&gathered(over_sines(&value, t, x), x), x);
    }
    let exponentials = value.variables().iter().copied();
    let exponentials: Vec<Variable> =
        exponentials.filter(|variable| matches!(variable.kind(), Kind::Exponential(_))).collect();
    exponentials.into_iter().fold(value, |value, exponential| {
        match over_hyperbolic(&value, exponential) {
            Some((over, x)) => shortest(&gathered(over, x), x),
            None => value,
        }
    })
}

/// A half tangent that occurs in the value, with its angle.
fn angle(value: &Symbolic) -> Option<(Variable, Angle)> {
    value.variables().iter().find_map(|variable| match variable.kind() {
        Kind::HalfTangent(part) => Some((*variable, Angle { part, hyperbolic: false })),
        _ => None,
    })
}

/// Whether the value is `p(E)/q(E)` for an exponential `E = exp(x)`, and the mean of the lowest and
/// the highest power is equal in `p` and `q`. This condition holds for `sinh(x)^2`, but not for
/// `exp(2*x)`.
pub(super) fn is_balanced(value: &Symbolic, exponential: Variable) -> bool {
    let (Form::Fraction(f), Kind::Exponential(part)) = (&value.0, exponential.kind()) else {
        return false;
    };
    let logarithm = |variable: &Variable| matches!(variable.kind(), Kind::Logarithm(_));
    let Some(at) = f.variables.iter().position(|own| *own == exponential) else { return false };
    let powers = || f.numerator.terms.iter().map(|(monomial, _)| monomial.exps()[at]);
    let above = powers().min().unwrap_or(0) + powers().max().unwrap_or(0);
    let below = f.denominator.factors.iter().map(|(factor, e)| {
        let polynomial = factor.over(&f.variables);
        polynomial.degrees()[at] * e
    });
    let below = below.sum::<u32>() + 2 * f.denominator.exponent(at);
    // excludes powers such as x^p, which are stored as exponentials of logarithms
    above == below && !part.of.variables().iter().any(logarithm)
}

/// The value in hyperbolic functions of `x`. The value must be balanced in `E = exp(x)`. In
/// addition, its numerator or denominator must be symmetric in `x` and `-x`, or must have such a
/// factor.
///
/// With `T = tanh(x/2)`, `E = (1 + T)/(1 - T)`. In a balanced quotient, the remaining powers of
/// `1 + T` and `1 - T` are equal.
fn over_hyperbolic(value: &Symbolic, exponential: Variable) -> Option<(Symbolic, Angle)> {
    let (Form::Fraction(f), Kind::Exponential(part)) = (&value.0, exponential.kind()) else {
        return None;
    };
    if !is_balanced(value, exponential) {
        return None;
    }
    let (mut above, lowest) = in_tangents(&by_power(&value.numerator(), exponential));
    let at = f.variables.iter().position(|variable| *variable == exponential)?;
    let mut divides = false;
    let mut below = Vec::new();
    for (factor, e) in &f.denominator.factors {
        let polynomial = f.polynomial(&factor.over(&f.variables));
        let coefficients = by_power(&polynomial, exponential);
        divides |= coefficients.len() > 1;
        below.push((in_tangents(&coefficients).0, *e));
    }
    let even = |odd: usize| above.iter().skip(odd).step_by(2).all(Symbolic::vanishes);
    if !(divides || even(0) || even(1)) {
        return None;
    }
    let mut rest = f.denominator.clone();
    rest.factors.clear();
    if let Some(exponent) = rest.monomial.get_mut(at) {
        *exponent = 0;
    }
    let one = constant(Rational::one(), f.variables.len());
    let monomial = lowest_terms(&f.variables, one, rest);
    // divides by powers of 1 - T^2
    let square = vec![Symbolic::one(), Symbolic::zero(), -Symbolic::one()];
    let power = f.denominator.exponent(at);
    (power..lowest).for_each(|_| above = times(&above, &square));
    if power > lowest {
        below.push((square, power - lowest));
    }
    let x = Angle { part, hyperbolic: true };
    Some((over(&above, below, x) * &monomial, x))
}

/// The written form of a polynomial of even degree `d` in `t = tan(x/2)`, divided by
/// `(1 + t^2)^(d/2)`.
pub(super) fn in_angles(polynomial: &Symbolic, t: Variable, part: &'static Part) -> Symbolic {
    let x = Angle { part, hyperbolic: false };
    let coefficients = by_power(polynomial, t);
    let square = vec![Symbolic::one(), Symbolic::zero(), Symbolic::one()];
    let half = coefficients.len() as u32 / 2;
    shortest(&gathered(over(&coefficients, vec![(square, half)], x), x), x)
}

/// The product of `c^d` and a polynomial of degree `d` in `t = s/c`.
pub(super) fn half_angles(
    polynomial: &Symbolic,
    t: Variable,
    s: &Symbolic,
    c: &Symbolic,
) -> Symbolic {
    let coefficients = by_power(polynomial, t);
    let degree = coefficients.len() - 1;
    let terms = coefficients.into_iter().enumerate();
    let terms = terms.map(|(k, p)| p * &pow(s.clone(), k) * &pow(c.clone(), degree - k));
    terms.fold(Symbolic::zero(), |sum, term| sum + &term)
}

/// A polynomial of degree `d` in `E = exp(x)`, divided by `E^(d/2)` and a power of `cosh`. For an
/// even degree, the power is `cosh(x)^(d/2)`, and `tanh` is `tanh(x)`. For an odd degree, the power
/// is `cosh(x/2)^d`.
pub(super) fn in_bounded(
    polynomial: &Symbolic,
    exponential: Variable,
    tanh: &Symbolic,
    secant: &Symbolic,
) -> Symbolic {
    let coefficients = by_power(polynomial, exponential);
    let degree = coefficients.len() as i64 - 1;
    let (step, half) = if degree % 2 == 0 { (1, degree / 2) } else { (2, degree) };
    let [more, less] = [Symbolic::one() + tanh, Symbolic::one() - tanh];
    let terms = coefficients.into_iter().enumerate().filter(|(_, c)| !c.vanishes());
    let terms = terms.map(|(k, c)| {
        let power = step * k as i64 - half;
        let base = if power < 0 { less.clone() } else { more.clone() };
        let size = power.unsigned_abs() as usize;
        c * &pow(base, size) * &pow(secant.clone(), half as usize - size)
    });
    terms.fold(Symbolic::zero(), |sum, term| sum + &term)
}

/// Rewrites the polynomial `sum c_k E^k`, divided by its lowest power of `E` and multiplied by a
/// power of `1 - T`, as a polynomial in `T`. Also returns the lowest power of `E`.
fn in_tangents(coefficients: &[Symbolic]) -> (Vec<Symbolic>, u32) {
    let lowest = coefficients.iter().take_while(|c| c.vanishes()).count();
    let own = &coefficients[lowest.min(coefficients.len())..];
    let degree = own.len().saturating_sub(1);
    let [plus, minus] = [1, -1].map(|sign| vec![Symbolic::one(), Symbolic::from_i64(sign)]);
    let power = |base: &Vec<Symbolic>, e: usize| {
        (0..e).fold(vec![Symbolic::one()], |power, _| times(&power, base))
    };
    let mut sums = vec![SymbolicSum::default(); degree + 1];
    for (k, c) in own.iter().enumerate().filter(|(_, c)| !c.vanishes()) {
        let product = times(&power(&plus, k), &power(&minus, degree - k));
        sums.iter_mut().zip(&product).for_each(|(sum, p)| sum.add_product(c, p));
    }
    let mut sums: Vec<Symbolic> = sums.iter().map(SymbolicSum::value).collect();
    while sums.last().is_some_and(Symbolic::vanishes) {
        sums.pop();
    }
    (sums, lowest as u32)
}

/// The product of two polynomials, which are given by their coefficients.
fn times(a: &[Symbolic], b: &[Symbolic]) -> Vec<Symbolic> {
    let mut sums = vec![SymbolicSum::default(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        b.iter().enumerate().for_each(|(j, y)| sums[i + j].add_product(x, y));
    }
    sums.iter().map(SymbolicSum::value).collect()
}

/// The value in which cosines and first powers of sines replace half tangents. Returns `None` if
/// half tangents occur in a denominator.
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

/// The value in which half tangents replace sines and cosines.
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

/// The argument of trigonometric or hyperbolic functions.
#[derive(Clone, Copy)]
struct Angle {
    part: &'static Part,
    hyperbolic: bool,
}

impl Angle {
    fn variable(self, angle: Function, hyperbolic: Function) -> Variable {
        let function = if self.hyperbolic { hyperbolic } else { angle };
        Variable::function(Kind::Written(function, self.part.clone()))
    }

    /// Negates the value for hyperbolic functions, because `1 - cos^2` is `sin^2`, but `1 - cosh^2`
    /// is `-sinh^2`.
    fn signed(self, value: Symbolic) -> Symbolic {
        if self.hyperbolic { -value } else { value }
    }
}

fn sine_variable(x: Angle) -> Variable {
    x.variable(Function::Sin, Function::Sinh)
}

fn cosine_variable(x: Angle) -> Variable {
    x.variable(Function::Cos, Function::Cosh)
}

fn sine(x: Angle) -> Symbolic {
    Symbolic::variable(sine_variable(x))
}

fn cosine(x: Angle) -> Symbolic {
    Symbolic::variable(cosine_variable(x))
}

/// The value in the sine and cosine of `x`. The variable `t` is `tan(x/2)`.
///
/// A polynomial of degree `d` in `t` becomes `(1 + cos x)^h` times a polynomial in sine and cosine,
/// with `h = d/2` rounded up. Factors of the denominator that are even in `t` contain no sines, and
/// are treated separately.
fn over_sines(value: &Symbolic, t: Variable, x: Angle) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value.clone() };
    let below = f.denominator.parts(&f.variables).into_iter().map(|(part, exponent)| {
        let polynomial = f.polynomial(&part.expanded(&f.variables));
        (by_power(&polynomial, t), exponent)
    });
    over(&by_power(&value.numerator(), t), below.collect(), x)
}

/// The quotient of a polynomial and powers of other polynomials. All polynomials are given by their
/// coefficients in `tan(x/2)` or `tanh(x/2)`.
fn over(above: &[Symbolic], below: Vec<(Vec<Symbolic>, u32)>, x: Angle) -> Symbolic {
    let half = |coefficients: &[Symbolic]| coefficients.len().saturating_sub(1).div_ceil(2);
    let mut product = Symbolic::one();
    let (mut rest, mut degree) = (vec![Symbolic::one()], 0);
    for (coefficients, exponent) in below {
        if coefficients.iter().skip(1).step_by(2).all(Symbolic::vanishes) {
            let image = in_sine(&coefficients, half(&coefficients), x);
            product *= &pow(inverse(&image), exponent as usize);
            degree += half(&coefficients) * exponent as usize;
        } else {
            rest = (0..exponent).fold(rest, |rest, _| times(&rest, &coefficients));
        }
    }
    product *= &inverse(&in_sine(&rest, half(&rest), x));
    degree += half(&rest);
    let highest = half(above).max(degree);
    if highest > degree {
        product *= &pow(inverse(&(Symbolic::one() + &cosine(x))), highest - degree);
    }
    in_sine(above, highest, x) * &product
}

/// The product of `(1 + cos x)^h` and the polynomial in `tan(x/2)` with these coefficients.
fn in_sine(coefficients: &[Symbolic], h: usize, x: Angle) -> Symbolic {
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

/// The sum `sum p_a (1 - cos x)^a (1 + cos x)^(degree - a)`, computed by Horner's rule.
fn homogeneous<'s>(
    coefficients: impl DoubleEndedIterator<Item = &'s Symbolic> + ExactSizeIterator,
    degree: usize,
    x: Angle,
) -> Symbolic {
    let (more, less) = (Symbolic::one() + &cosine(x), x.signed(Symbolic::one() - &cosine(x)));
    let mut power = pow(more.clone(), (degree + 1).saturating_sub(coefficients.len()));
    coefficients.rev().fold(Symbolic::zero(), |sum, p| {
        let next = sum * &less + &(p.clone() * &power);
        power = power.clone() * &more;
        next
    })
}

/// Replaces the factors `1 - cos^2 x` by `sin^2 x`.
fn gathered(value: Symbolic, x: Angle) -> Symbolic {
    if value.vanishes() {
        return value;
    }
    let square = x.signed(Symbolic::one() - &(cosine(x) * &cosine(x)));
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

/// Whether a polynomial is divisible by `1 - cos^2 x`, which means that it vanishes at `cos x = 1`
/// and at `cos x = -1`.
fn divisible(polynomial: &Symbolic, x: Angle) -> bool {
    let mut sums = [SymbolicSum::default(), SymbolicSum::default()];
    for ([power], part) in by_powers(polynomial, [cosine_variable(x)]) {
        sums[power % 2].add_term(&part);
    }
    sums.iter().all(|sum| sum.value().vanishes())
}

/// Polynomials above this degree are written in only one form.
const DEGREE: usize = 64;

/// The value, whose numerator and denominator are each in the form with the fewest terms.
fn shortest(value: &Symbolic, x: Angle) -> Symbolic {
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

/// The other forms of a polynomial: with as few sines as possible, with as few cosines as possible,
/// and homogeneous.
fn others(polynomial: &Symbolic, x: Angle) -> Vec<Symbolic> {
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
        pow(x.signed(one.clone() - &cos2), s / 2) * &pow(sin.clone(), s % 2) * &pow(cos.clone(), c)
    });
    let by_sines = sum(&|s, c| {
        pow(one.clone() - &x.signed(sin2.clone()), c / 2)
            * &pow(cos.clone(), c % 2)
            * &pow(sin.clone(), s)
    });
    let of_one_degree = even.then(|| {
        sum(&|s, c| {
            let rest = pow(x.signed(sin2.clone()) + &cos2, (highest - s - c) / 2);
            rest * &pow(sin.clone(), s) * &pow(cos.clone(), c)
        })
    });
    [by_cosines, by_sines].into_iter().chain(of_one_degree).collect()
}
