//! The closure of a loop in dual quaternions: power series of a motion, and curves in closed form.
//!
//! Let a line have the unit direction `w` and the moment `u`. A rotation about it by the angle
//! `theta` is `1 + x (w + eps u)` with `x = tan(theta/2)`, up to a real factor. A translation by
//! `2 x u` is `1 + eps x u`. The product of a loop is real in the closed positions. These are polynomial
//! equations over the field of the axes (M. Husty and H.-P. Schroecker, *Kinematics and algebraic
//! geometry*, 2013). Screws with a pitch use the exponential `exp(x (w + eps u))` instead.

use super::graph::Mechanism;
use super::twist::{Twist, angular, dot, linear};
use crate::tensors::linear::Matrix;
use crate::tensors::stop::checkpoint;
use crate::{Error, Field, Notation, Ring, Scalar};

/// A polynomial in the parameter of a motion, by increasing powers.
type Series<S> = Vec<S>;

/// A dual quaternion `p + eps d` of power series: the parts `1, i, j, k` of `p`, then of `d`.
struct DualQuaternion<S>([Series<S>; 8]);

/// The parts of the product of quaternions: `(row, column, result, sign)`.
const QUATERNION: [(usize, usize, usize, i64); 16] = [
    (0, 0, 0, 1),
    (0, 1, 1, 1),
    (0, 2, 2, 1),
    (0, 3, 3, 1),
    (1, 0, 1, 1),
    (1, 1, 0, -1),
    (1, 2, 3, 1),
    (1, 3, 2, -1),
    (2, 0, 2, 1),
    (2, 1, 3, -1),
    (2, 2, 0, -1),
    (2, 3, 1, 1),
    (3, 0, 3, 1),
    (3, 1, 2, 1),
    (3, 2, 1, -1),
    (3, 3, 0, -1),
];

/// The sum `a + factor b`.
fn add<S: Ring>(a: &mut Series<S>, b: &[S], factor: &S) {
    if a.len() < b.len() {
        a.resize(b.len(), S::zero());
    }
    for (a, b) in a.iter_mut().zip(b).filter(|(_, b)| !b.vanishes()) {
        *a = a.clone() + &(b.clone() * factor);
    }
}

/// The product of two series up to the power `order`.
fn product<S: Ring>(a: &[S], b: &[S], order: usize) -> Series<S> {
    let mut result: Series<S> = vec![];
    for (i, a) in a.iter().enumerate().take(order + 1).filter(|(_, a)| !a.vanishes()) {
        let length = b.len().min(order + 1 - i);
        if result.len() < i + length {
            result.resize(i + length, S::zero());
        }
        for (k, b) in b[..length].iter().enumerate().filter(|(_, b)| !b.vanishes()) {
            result[i + k] = result[i + k].clone() + &(a.clone() * b);
        }
    }
    result
}

impl<S: Field> DualQuaternion<S> {
    fn one() -> Self {
        let mut parts: [Series<S>; 8] = std::array::from_fn(|_| vec![]);
        parts[0] = vec![S::one()];
        DualQuaternion(parts)
    }

    /// The product with the constant `w + eps u`.
    fn by_twist(&self, twist: &Twist<S>) -> Self {
        let mut parts: [Series<S>; 8] = std::array::from_fn(|_| vec![]);
        for (row, column, result, sign) in QUATERNION.into_iter().filter(|(_, c, ..)| *c > 0) {
            let signed = |value: &S| if sign < 0 { -value.clone() } else { value.clone() };
            let [w, u] = [&twist[column - 1], &twist[column + 2]].map(signed);
            for (from, to, factor) in [(0, 0, &w), (4, 4, &w), (0, 4, &u)] {
                if !factor.vanishes() {
                    add(&mut parts[to + result], &self.0[from + row], factor);
                }
            }
        }
        DualQuaternion(parts)
    }

    /// The product with `denominator + numerator (w + eps u)`.
    fn by_rotation(&self, twist: &Twist<S>, [numerator, denominator]: [&[S]; 2], n: usize) -> Self {
        let turned = self.by_twist(twist);
        let part = |at: usize| {
            let mut sum = product(&self.0[at], denominator, n);
            add(&mut sum, &product(&turned.0[at], numerator, n), &S::one());
            sum
        };
        DualQuaternion(std::array::from_fn(part))
    }

    /// The product with `exp(x (w + eps u))` up to the power `order`, for a series without constant
    /// term.
    fn by_screw(&self, twist: &Twist<S>, x: &[S], order: usize) -> Self {
        let mut sum: [Series<S>; 8] = self.0.clone();
        let (mut term, mut power) = (DualQuaternion(self.0.clone()), vec![S::one()]);
        for k in 1..=order as i64 {
            term = term.by_twist(twist);
            power = product(&power, x, order);
            let inverse = S::from_quotient(1, k).unwrap_or_else(S::zero);
            let scaled: Series<S> = power.iter().map(|c| c.clone() * &inverse).collect();
            power = scaled;
            for (sum, part) in sum.iter_mut().zip(&term.0) {
                add(sum, &product(part, &power, order), &S::one());
            }
        }
        DualQuaternion(sum)
    }

    /// The six parts that vanish in closed positions.
    fn imaginary(self) -> impl Iterator<Item = Series<S>> {
        let kept = |(at, part)| (at % 4 > 0).then_some(part);
        self.0.into_iter().enumerate().filter_map(kept)
    }
}

/// Whether a twist is a rotation or a translation, whose factor is linear in its coordinate.
fn has_linear_factor<S: Ring>(twist: &Twist<S>) -> bool {
    dot(&angular(twist), &linear(twist)).vanishes()
}

/// The motion with a single first-order rate, as power series.
#[derive(Clone, Debug)]
pub struct Expansion<S> {
    /// The coefficients of each coordinate by increasing powers, from the power 0. The coordinate
    /// of a rotation is the tangent of half the angle, and half the distance for a translation.
    pub coordinates: Vec<Vec<S>>,
    /// The first order at which the closure equations have no solution; `None` if they have
    /// solutions up to the order of the expansion.
    pub obstructed: Option<usize>,
}

/// A motion whose coordinates are rational functions of one parameter: for each coordinate the
/// coefficients of the numerator and of the denominator.
#[derive(Clone, Debug)]
pub struct RationalCurve<S> {
    /// The numerators and denominators, by increasing powers.
    pub coordinates: Vec<[Vec<S>; 2]>,
}

impl<S: Field + Scalar + Notation> Expansion<S> {
    /// Solves the closure equations order by order, beginning with a vector of rates that is the
    /// only one up to factors. By the reduction of Lyapunov and Schmidt, the mechanism is rigid if
    /// an order has no solution.
    ///
    /// # Errors
    /// Those of linear algebra.
    pub fn new(
        mechanism: &Mechanism<S>,
        jacobian: &Matrix<S>,
        rates: &[S],
        order: usize,
    ) -> Result<Self, Error> {
        let chains: Vec<_> = mechanism.loops().iter().map(|own| mechanism.chain(own)).collect();
        let mut coordinates: Vec<Series<S>> =
            rates.iter().map(|rate| vec![S::zero(), rate.clone()]).collect();
        for n in 2..=order {
            checkpoint();
            let right: Vec<S> = chains
                .iter()
                .flat_map(|chain| coefficient(chain, &coordinates, n))
                .map(|value| -value)
                .collect();
            let Some(next) = jacobian.solve(&right)? else {
                return Ok(Expansion { coordinates, obstructed: Some(n) });
            };
            coordinates.iter_mut().zip(next).for_each(|(series, value)| series.push(value));
        }
        Ok(Expansion { coordinates, obstructed: None })
    }

    /// The curve of rational functions of at most this degree with the same expansion, if the
    /// closure equations hold identically on it. Two powers of the expansion beyond those that
    /// determine the functions must agree.
    ///
    /// # Errors
    /// Those of linear algebra.
    pub fn rational_curve(
        &self,
        mechanism: &Mechanism<S>,
        degree: usize,
    ) -> Result<Option<RationalCurve<S>>, Error> {
        let known = self.coordinates.first().map_or(0, Vec::len);
        if self.obstructed.is_some() || known < 2 * degree + 3 {
            return Ok(None);
        }
        let mut curve = vec![];
        for series in &self.coordinates {
            match pade(series, degree)? {
                Some(quotient) => curve.push(quotient),
                None => return Ok(None),
            }
        }
        let curve = RationalCurve { coordinates: curve };
        Ok(curve.closes(mechanism, degree).then_some(curve))
    }
}

impl<S: Field + Scalar + Notation> RationalCurve<S> {
    /// Whether the closure equations hold identically.
    fn closes(&self, mechanism: &Mechanism<S>, degree: usize) -> bool {
        mechanism.loops().iter().all(|own| {
            let chain = mechanism.chain(own);
            let order = degree * chain.len();
            let mut value = DualQuaternion::one();
            for (at, twist) in &chain {
                if !has_linear_factor(twist) {
                    return false;
                }
                let [numerator, denominator] = &self.coordinates[*at];
                value = value.by_rotation(twist, [numerator, denominator], order);
                checkpoint();
            }
            value.imaginary().all(|part| part.iter().all(S::vanishes))
        })
    }

    /// The largest degree of a numerator or a denominator.
    pub fn degree(&self) -> usize {
        let degree = |part: &Vec<S>| part.iter().rposition(|value| !value.vanishes()).unwrap_or(0);
        self.coordinates.iter().flatten().map(degree).max().unwrap_or(0)
    }
}

/// The coefficients of a power in the six closure equations of a loop.
fn coefficient<S: Field>(
    chain: &[(usize, Twist<S>)],
    coordinates: &[Series<S>],
    power: usize,
) -> Vec<S> {
    let mut value = DualQuaternion::one();
    let one = [S::one()];
    for (at, twist) in chain {
        let x = &coordinates[*at];
        value = match has_linear_factor(twist) {
            true => value.by_rotation(twist, [x, &one], power),
            false => value.by_screw(twist, x, power),
        };
    }
    value.imaginary().map(|part| part.get(power).cloned().unwrap_or_else(S::zero)).collect()
}

/// The quotient of two polynomials of at most a degree that has a given expansion, with a
/// denominator that is 1 at 0.
fn pade<S: Field + Scalar>(series: &[S], degree: usize) -> Result<Option<[Series<S>; 2]>, Error> {
    let at = |k: usize| series.get(k).cloned().unwrap_or_else(S::zero);
    let powers = degree + 1..series.len();
    let rows: Vec<Vec<S>> =
        powers.clone().map(|n| (1..=degree).map(|j| at(n - j)).collect()).collect();
    let right: Vec<S> = powers.map(|n| -at(n)).collect();
    let Some(rest) = Matrix::from_dense(&rows)?.solve(&right)? else { return Ok(None) };
    let denominator: Series<S> = std::iter::once(S::one()).chain(rest).collect();
    let numerator = product(series, &denominator, degree);
    Ok(Some([numerator, denominator]))
}
