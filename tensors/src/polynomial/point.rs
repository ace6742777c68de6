//! Isolated real solutions, and exact signs of polynomials at them.

use super::algebraic::RealNumber;
use super::minimal::minimal_polynomial_of;
use super::real_roots::{Interval, sign};
use super::{Budget, Polynomial, Univariate};
use crate::Rational;
use num_traits::{One, Zero};
use polycore::Uni;
use std::cmp::Ordering;

/// An isolated real solution. Its coordinates are polynomials in a real root `u` of a polynomial.
#[derive(Clone, Debug)]
pub struct Point {
    /// The polynomial of `u`, without multiple roots.
    modulus: Univariate,
    /// An isolating interval of `u`.
    interval: Interval,
    coordinates: Vec<Univariate>,
    values: Vec<RealNumber>,
}

impl Point {
    /// The point at which `u` is the root in an interval. For each letter, the candidates for its
    /// value are given.
    pub(super) fn new(
        modulus: Univariate,
        mut interval: Interval,
        coordinates: Vec<Univariate>,
        candidates: &[Vec<RealNumber>],
    ) -> Self {
        // most signs are certain at once in a short interval
        (0..40).for_each(|_| interval.refine(&modulus));
        let mut point = Point { modulus, interval, coordinates, values: vec![] };
        let pairs = point.coordinates.iter().zip(candidates);
        point.values = pairs.map(|(h, roots)| point.chosen(h, roots)).collect();
        point
    }

    /// The values of the letters, in the order of the letters of the system.
    pub fn values(&self) -> &[RealNumber] {
        &self.values
    }

    /// Whether two points are equal.
    pub fn is_same(&self, other: &Self) -> bool {
        self.values == other.values
    }

    /// The value of a polynomial in the letters as a polynomial in `u`.
    pub(super) fn element(&self, f: &Polynomial) -> Univariate {
        let terms = f.terms.iter().map(|(m, c)| {
            let start = Uni::constant(c.clone());
            let powers = m.exps().iter().zip(&self.coordinates);
            powers.fold(start, |product, (power, x)| {
                (0..*power).fold(product, |product, _| &(&product * x) % &self.modulus)
            })
        });
        terms.fold(Uni::constant(Rational::zero()), |sum, term| &sum + &term)
    }

    /// The product of two elements.
    fn product(&self, x: &Univariate, y: &Univariate) -> Univariate {
        &(x * y) % &self.modulus
    }

    /// The exact sign of an element. A common divisor with the polynomial of `u` decides whether it
    /// vanishes; otherwise the interval shrinks until the sign is certain.
    fn sign(&self, h: &Univariate) -> Ordering {
        if h.0.is_empty() || h.0.iter().all(Zero::is_zero) {
            return Ordering::Equal;
        }
        let common = self.modulus.gcd(h);
        if common.deg() > 0 && self.interval.contains_root(&common) {
            return Ordering::Equal;
        }
        let mut interval = self.interval.clone();
        loop {
            let image = interval.image(h);
            let ends = (sign(&image.low), sign(&image.high));
            if ends.0 == ends.1 && ends.0 != Ordering::Equal {
                return ends.0;
            }
            interval.refine(&self.modulus);
        }
    }

    /// The exact sign of a polynomial at the point.
    pub(super) fn sign_of(&self, f: &Polynomial) -> Ordering {
        self.sign(&self.element(f))
    }

    /// The value of an element as a real algebraic number.
    fn number(&self, h: &Univariate) -> RealNumber {
        let f = &self.modulus;
        if f.deg() == 1 {
            let root = -f.0[0].clone() / &f.0[1];
            return RealNumber::from_rational(h.eval(&root));
        }
        // this cannot exceed the budget: the degree is limited
        let minimal = minimal_polynomial_of(h, f, &mut Budget(u64::MAX));
        let minimal = minimal.unwrap_or_else(|_| Uni::new(vec![Rational::zero(), Rational::one()]));
        self.chosen(h, &RealNumber::roots(&minimal.0))
    }

    /// The number in a list that is the value of an element.
    fn chosen(&self, h: &Univariate, roots: &[RealNumber]) -> RealNumber {
        let mut interval = self.interval.clone();
        loop {
            let image = interval.image(h);
            let mut near = roots.iter().filter(|root| root.may_be_in(&image));
            match (near.next(), near.next()) {
                (Some(only), None) => return only.clone(),
                (None, _) => return RealNumber::from_rational(image.low),
                _ => interval.refine(&self.modulus),
            }
        }
    }

    /// The quotient of two polynomials at the point. Returns `None` if the denominator vanishes.
    pub(super) fn quotient(&self, above: &Polynomial, below: &Polynomial) -> Option<RealNumber> {
        let (above, below) = (self.element(above), self.element(below));
        if self.sign(&below) == Ordering::Equal {
            return None;
        }
        let common = self.modulus.gcd(&below);
        let modulus = &self.modulus / &common;
        let (inverse, _, _) = (&below % &modulus).bezout(&modulus);
        let point = Point { modulus, ..self.clone() };
        Some(point.number(&point.product(&above, &inverse)))
    }

    /// The numbers of positive, negative and zero eigenvalues of a symmetric matrix of polynomials in
    /// the letters. Its characteristic polynomial has only real roots, so the variations of signs of
    /// its coefficients are the numbers of roots of each sign.
    pub(super) fn inertia(&self, matrix: &[Vec<Polynomial>]) -> [usize; 3] {
        let entries: Vec<Vec<Univariate>> =
            matrix.iter().map(|row| row.iter().map(|f| self.element(f)).collect()).collect();
        let mut count = [0; 3];
        for block in blocks(matrix) {
            let coefficients = self.characteristic(&entries, &block);
            let signs: Vec<Ordering> = coefficients.iter().map(|c| self.sign(c)).collect();
            let zero = signs.iter().take_while(|s| s.is_eq()).count();
            let alternating = signs.iter().enumerate().map(|(power, s)| match power % 2 {
                0 => *s,
                _ => s.reverse(),
            });
            count[0] += variations(signs.iter().copied());
            count[1] += variations(alternating);
            count[2] += zero;
        }
        count
    }

    /// The coefficients of the characteristic polynomial of a block, by the algorithm of Faddeev and
    /// LeVerrier.
    fn characteristic(&self, entries: &[Vec<Univariate>], block: &[usize]) -> Vec<Univariate> {
        let n = block.len();
        let zero = || Uni::constant(Rational::zero());
        let a = |i: usize, j: usize| &entries[block[i]][block[j]];
        let mut m = vec![vec![zero(); n]; n];
        let mut coefficients = vec![Uni::constant(Rational::one())];
        for k in 1..=n {
            // m = a m + c
            let last = coefficients[k - 1].clone();
            let cell = |i: usize, j: usize| {
                let start = if i == j { last.clone() } else { zero() };
                (0..n).fold(start, |sum, l| &sum + &self.product(a(i, l), &m[l][j]))
            };
            m = (0..n).map(|i| (0..n).map(|j| cell(i, j)).collect()).collect();
            let pairs = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
            let trace = pairs.fold(zero(), |sum, (i, j)| &sum + &self.product(a(i, j), &m[j][i]));
            let factor = Rational::new(-1, k as i64).unwrap_or_default();
            coefficients.push(trace.scale(&factor));
        }
        coefficients.reverse();
        coefficients
    }
}

/// The number of changes of sign.
fn variations(signs: impl Iterator<Item = Ordering>) -> usize {
    let signs: Vec<Ordering> = signs.filter(|s| s.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The finest partition of the indices for which the matrix has blocks.
fn blocks(matrix: &[Vec<Polynomial>]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..matrix.len()).collect();
    let mut found = vec![];
    while let Some(first) = left.pop() {
        let mut block = vec![first];
        let mut at = 0;
        while at < block.len() {
            let row = block[at];
            let linked = |i: &usize| !matrix[row][*i].is_zero() || !matrix[*i][row].is_zero();
            let (next, rest): (Vec<usize>, Vec<usize>) = left.iter().partition(|i| linked(i));
            block.extend(next);
            left = rest;
            at += 1;
        }
        found.push(block);
    }
    found
}
