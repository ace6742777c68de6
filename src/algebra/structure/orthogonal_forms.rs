//! Distinguishes the real forms so(p,q) and so*(2r) of D_r by one regular element.
//!
//! Let `a_1, -a_1, ..., a_r, -a_r` be the eigenvalues of `x` in the representation of dimension
//! `2 r`. The numbers `a_i^2` are the roots of a polynomial `g` over the rationals, and the
//! eigenvalues of `ad_x` are the sums `a_i + a_j` and differences `a_i - a_j`.
//!
//! In so(p,q), a positive `a_i^2` belongs to a plane of signature (1, 1). In so*(2r), no `a_i^2` is
//! positive, because a Cartan subalgebra is a sum of Cartan subalgebras of so*(4) and so*(2). In
//! so*(4) the `a_i^2` are complex conjugates, and in so*(2) they are negative.
//!
//! Let two negative numbers `u^2` and `v^2` belong to two planes that `x` rotates. In so(p,q), the
//! roots `u + v` and `u - v` are both compact if the form has the same sign on both planes;
//! otherwise both are noncompact. In so*(2r), exactly one of these roots is compact, because the
//! compact roots are the roots of u(r). The Killing form is negative on compact root spaces. If no
//! `a_i^2` is positive in so(p,q), at least `|p - q| / 2` of them are negative. S. Helgason,
//! *Differential Geometry, Lie Groups, and Symmetric Spaces*, ch. X.

use super::StructureTheory;
use super::dynkin::{Split, elementary_functions, weight_power_sums};
use super::reduction::{ModularAlgebra, PseudoRandom};
use super::subspace::{collected, denominator};
use crate::algebra::roots::Series;
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{PRIMES, RationalReconstruction, primes};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};
use polycore::Uni;
use std::cmp::Ordering;

/// The number of elements that are tried.
const TRIALS: usize = 24;
/// The smallest and the largest number of binary places. The precision doubles in each attempt.
const PLACES: [usize; 2] = [64, 1 << 14];

impl StructureTheory<Rational> {
    /// Whether a real form of D_r with `r >= 5` is so*(2r), and not so(p,q). Returns `None` for
    /// other algebras, or if no element that is tried is decisive. Also returns `None` if `r` is
    /// 16, 64, or a higher power of 4.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// let form = |name: &str| StructureTheory::new(catalogue::algebra(name).unwrap());
    /// assert_eq!(form("so*(10)").is_quaternionic_orthogonal(), Some(true));
    /// assert_eq!(form("so(6,4)").is_quaternionic_orthogonal(), Some(false));
    /// ```
    pub fn is_quaternionic_orthogonal(&self) -> Option<bool> {
        let types = self.dynkin_type().filter(|_| self.is_semisimple())?;
        let [one] = types[..] else { return None };
        let r = one.rank();
        if one.series() != Series::D || r < 5 {
            return None;
        }
        let [plus, minus, _] = self.killing().signature()?;
        // computes (p - q)^2 = p + q + 2 (dim k - dim p), where p + q = 2 r
        let square = (2 * r + 2 * minus).checked_sub(2 * plus)?;
        let n = self.dimension();
        let mut draw = PseudoRandom::new(5);
        let mut below = move |size: usize| draw.residue(PRIMES[0]) as usize % size;
        (0..TRIALS).find_map(|trial| {
            let many = (2 << (trial % 8)).min(n);
            let terms = (0..many).map(|_| (below(n), Rational::from(1 + below(4) as i64)));
            let x = collected(terms.collect());
            let start: Row<Rational> =
                (0..n).map(|at| (at, Rational::from(below(5) as i64 - 2))).collect();
            Element::new(self, &x, r)?.is_quaternionic(self, &start, square)
        })
    }
}

/// The map `ad_x` with integer entries, and polynomials of its eigenvalues.
struct Element {
    /// The columns of the matrix.
    columns: Vec<Vec<BigInt>>,
    /// The polynomial whose roots are `4 a_i^2`, with ascending powers.
    squares: Vec<BigInt>,
    /// The polynomial whose roots are `(a_i + a_j)^2` and `(a_i - a_j)^2`, with ascending powers.
    roots: Vec<BigInt>,
}

impl Element {
    /// Computes the matrix and the polynomials of `ad_x`. Returns `None` if `x` is not regular.
    fn new(structure: &StructureTheory<Rational>, x: &Row<Rational>, r: usize) -> Option<Self> {
        let n = structure.dimension();
        let ad = structure.products.ad(x);
        let factor =
            denominator(ad.columns().flat_map(|(_, column)| column).map(|(_, value)| value));
        let mut columns = vec![vec![BigInt::zero(); n]; n];
        for (k, column) in ad.columns() {
            for (i, value) in column {
                columns[k][*i] = integer(&(value.clone() * &factor));
            }
        }
        // The numbers 2 a_i = (a_i + a_j) + (a_i - a_j) are sums of eigenvalues of an integer
        // matrix, so they are algebraic integers, and the coefficients are integers. The sum of
        // the squared sizes of all eigenvalues is at most the sum of the squared entries. The
        // coefficients are therefore below (1 + sum / (2 r (r - 1)))^(r (r - 1)).
        let norm: BigInt = columns.iter().flatten().map(|entry| entry * entry).sum();
        let half = r * (r - 1);
        let most: BigInt = (BigInt::from(2) + norm / BigInt::from(2 * half)).pow(half);
        let mut images = RationalReconstruction::new(r + half);
        let mut product = BigInt::one();
        let mut draw = PseudoRandom::new(6);
        let mut refused = 0;
        for prime in primes() {
            if product > &most * BigInt::from(2) {
                break;
            }
            let found = ModularAlgebra::new(structure, prime).and_then(|reduction| {
                let factor = prime.rational(&factor)?;
                let mut dense = vec![0; n];
                for (at, value) in x {
                    dense[*at] = prime.mul(prime.rational(value)?, factor);
                }
                let split = Split::of(&reduction.ad(&dense), &mut draw)?;
                let sums = weight_power_sums(prime, Series::D, r, &split.power_sums(), r)?;
                let elementary = elementary_functions(prime, &sums)?;
                let squares = (1..=r).rev().map(|k| {
                    let four = polycore::modp::pow(4, k as u64, prime.get());
                    let value = prime.mul(elementary[k], four);
                    if k % 2 == 1 { prime.neg(value) } else { value }
                });
                let squares: Vec<u64> = squares.collect();
                let roots = split.relation().iter().step_by(2).map(|v| prime.neg(*v));
                Some(squares.into_iter().chain(roots).collect::<Vec<u64>>())
            });
            match found {
                Some(found) if images.add(prime, &found) => product *= prime.get(),
                _ if refused > 3 => return None,
                _ => refused += 1,
            }
        }
        let mut squares: Vec<BigInt> = images.integers().iter().map(integer).collect();
        let mut roots = squares.split_off(r);
        squares.push(BigInt::one());
        roots.push(BigInt::one());
        Some(Element { columns, squares, roots })
    }

    fn is_quaternionic(
        &self,
        structure: &StructureTheory<Rational>,
        start: &Row<Rational>,
        difference: usize,
    ) -> Option<bool> {
        let rational = self.squares.iter().map(|c| BigRational::from_integer(c.clone()));
        let polynomial = Uni::new(rational.collect());
        let separable = polynomial.gcd(&polynomial.derivative()).deg() == 0;
        if self.squares[0].is_zero() || !separable {
            return None;
        }
        let places = polynomial.isolate();
        let (first, last) = (places.first(), places.last());
        let zero = BigRational::zero();
        if last.is_some_and(|(_, upper)| polynomial.sturm(&zero, upper) > 0) {
            return Some(false);
        }
        let negative = first.map_or(0, |(lower, _)| polynomial.sturm(lower, &zero));
        if negative < 2 {
            return (difference > 4).then_some(true);
        }
        let moments = self.moments(structure, start);
        let mut digits = PLACES[0];
        while digits <= PLACES[1] {
            if let Some(same) = self.same_kind(&places[..2], &moments, digits) {
                return Some(!same);
            }
            digits *= 2;
        }
        None
    }

    /// The moments `K(v, X^2k v)` for `v = X u`.
    fn moments(&self, structure: &StructureTheory<Rational>, u: &Row<Rational>) -> Vec<BigInt> {
        let killing = structure.killing_matrix();
        let n = self.columns.len();
        let factor = denominator((0..n).flat_map(|i| killing.row(i)).map(|(_, value)| value));
        let form: Vec<Vec<(usize, BigInt)>> = (0..n)
            .map(|i| killing.row(i).iter().map(|(j, v)| (*j, integer(&(v.clone() * &factor)))))
            .map(Iterator::collect)
            .collect();
        let apply = |vector: &[BigInt]| {
            let mut image = vec![BigInt::zero(); n];
            for (column, value) in self.columns.iter().zip(vector).filter(|(_, v)| !v.is_zero()) {
                let entries = image.iter_mut().zip(column).filter(|(_, entry)| !entry.is_zero());
                entries.for_each(|(sum, entry)| *sum += entry * value);
            }
            image
        };
        let mut vector = vec![BigInt::zero(); n];
        u.iter().for_each(|(at, value)| vector[*at] = integer(value));
        let mut moments = vec![];
        for k in 0..self.roots.len() - 1 {
            vector = apply(&vector);
            let square = form.iter().zip(&vector).map(|(row, value)| {
                row.iter().map(|(j, entry)| entry * &vector[*j]).sum::<BigInt>() * value
            });
            let square: BigInt = square.sum();
            // alternates the sign, because X is antisymmetric with respect to the form
            moments.push(if k % 2 == 0 { square } else { -square });
        }
        moments
    }

    /// Whether the roots `u + v` and `u - v` are both compact or both noncompact. The two isolating
    /// intervals contain `4 u^2` and `4 v^2`. Returns `None` if the precision is too low.
    fn same_kind(
        &self,
        intervals: &[(BigRational, BigRational)],
        moments: &[BigInt],
        places: usize,
    ) -> Option<bool> {
        let one = BigRational::from_integer(BigInt::one() << places);
        let mut sizes = vec![];
        for (lower, upper) in intervals {
            let (lower, upper) = (lower * &one, upper * &one);
            if !lower.is_integer() || !upper.is_integer() {
                return None;
            }
            let root = bisected(&self.squares, lower.to_integer(), upper.to_integer(), places)?;
            // 2 |u| is the square root of -4 u^2, where 4 u^2 is the root in the interval
            let opposite = Interval { lower: -root.upper, upper: -root.lower };
            sizes.push(opposite.sqrt(places)?);
        }
        let kind = |size: Interval| {
            let square = size.times(&size, places);
            // the interval of -(u +- v)^2, computed from 2 u and 2 v
            let eigenvalue =
                Interval { lower: -(square.upper >> 2usize) - 1, upper: -(square.lower >> 2usize) };
            self.kind(&eigenvalue, moments, places)
        };
        let sum = sizes[0].plus(&sizes[1]);
        let difference = sizes[0]
            .plus(&Interval { lower: -sizes[1].upper.clone(), upper: -sizes[1].lower.clone() });
        Some(kind(sum)? == kind(difference)?)
    }

    /// The sign of `K(w, w)`, where `w` is the part of `v` in the eigenspace of `X^2` for a simple
    /// root `m` of `F`. It is the sign of `K(h(X^2) v, v) F'(m)` with `h = F / (t - m)`, because
    /// `h(X^2)` is `F'(m)` on this eigenspace and zero on all others.
    fn kind(&self, eigenvalue: &Interval, moments: &[BigInt], places: usize) -> Option<Ordering> {
        let constant = |value: &BigInt| {
            let value = value.clone() << places;
            Interval { lower: value.clone(), upper: value }
        };
        let mut value = constant(&BigInt::one());
        let mut derivative = constant(&BigInt::zero());
        let mut part = constant(&BigInt::zero());
        for (coefficient, moment) in self.roots.iter().zip(moments).rev() {
            part = part.plus(&value.multiple(moment));
            derivative = derivative.times(eigenvalue, places).plus(&value);
            value = value.times(eigenvalue, places).plus(&constant(coefficient));
        }
        Some(if part.sign()? == derivative.sign()? { Ordering::Greater } else { Ordering::Less })
    }
}

/// An interval. Its bounds are integers times a power of 2.
struct Interval {
    lower: BigInt,
    upper: BigInt,
}

impl Interval {
    fn plus(&self, other: &Self) -> Self {
        Interval { lower: &self.lower + &other.lower, upper: &self.upper + &other.upper }
    }

    fn multiple(&self, factor: &BigInt) -> Self {
        let (a, b) = (&self.lower * factor, &self.upper * factor);
        if factor.is_negative() {
            Interval { lower: b, upper: a }
        } else {
            Interval { lower: a, upper: b }
        }
    }

    fn times(&self, other: &Self, places: usize) -> Self {
        let (a, b) = (self.multiple(&other.lower), self.multiple(&other.upper));
        // a shift rounds down, also for negative numbers, so the bounds still enclose the product
        let lower = a.lower.min(b.lower) >> places;
        let upper = -(-a.upper.max(b.upper) >> places);
        Interval { lower, upper }
    }

    /// The interval of the square root. Returns `None` if the interval contains negative numbers.
    fn sqrt(&self, places: usize) -> Option<Self> {
        let root = |value: &BigInt| (value << places).sqrt();
        let positive = self.lower.is_positive();
        positive.then(|| Interval { lower: root(&self.lower), upper: root(&self.upper) + 1 })
    }

    /// The common sign of all numbers in the interval; `None` if it contains zero.
    fn sign(&self) -> Option<Ordering> {
        match (self.lower.is_positive(), self.upper.is_negative()) {
            (true, _) => Some(Ordering::Greater),
            (_, true) => Some(Ordering::Less),
            _ => None,
        }
    }
}

/// Bisects until the interval around the root has length 1, in units of a power of 2. Returns
/// `None` if the signs at the bounds are equal.
fn bisected(
    polynomial: &[BigInt],
    mut lower: BigInt,
    mut upper: BigInt,
    places: usize,
) -> Option<Interval> {
    let sign = |at: &BigInt| {
        let terms = polynomial.iter().rev().enumerate();
        let value = terms.fold(BigInt::zero(), |sum, (k, c)| sum * at + (c << (places * k)));
        value.sign()
    };
    let (below, above) = (sign(&lower), sign(&upper));
    if below != -above || below == num_bigint::Sign::NoSign {
        return None;
    }
    while &upper - &lower > BigInt::one() {
        let middle: BigInt = (&lower + &upper) >> 1usize;
        if sign(&middle) == below {
            lower = middle;
        } else {
            upper = middle;
        }
    }
    Some(Interval { lower, upper })
}

fn integer(value: &Rational) -> BigInt {
    BigRational::from(value).to_integer()
}
