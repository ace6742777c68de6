//! The quotient algebra of a system with finitely many complex solutions, and its real points.
//!
//! The minimal polynomials of the letters are added to the ideal until it is radical (A. Seidenberg,
//! *Trans. AMS* 197 (1974) 273-313). Then the powers of a separating linear form `u` are a basis, in
//! which all letters are polynomials in `u`.

use super::algebraic::RealNumber;
use super::factors::univariate_factors;
use super::groebner::remainder;
use super::minimal::minimal_polynomial;
use super::point::Point;
use super::real_roots::isolate;
use super::{Budget, ORDER, Polynomial, TooLarge, Univariate};
use crate::Rational;
use crate::linear::Matrix;
use num_traits::{One, Zero};
use polycore::{Monomial, Poly, Uni};

/// The largest dimension of a quotient algebra.
const MAX_DIMENSION: usize = 200;

/// The quotient algebra by an ideal with finitely many zeros.
pub(super) struct Quotient<'a> {
    basis: &'a [Polynomial],
    letters: usize,
    monomials: Vec<Monomial>,
}

/// The outcome of the search for points.
pub(super) enum Found {
    /// All real points.
    Points(Vec<Point>),
    /// Equations that split the system: one of them vanishes.
    Equations(Vec<Polynomial>),
}

/// The dimension of the set of complex zeros, and a largest set of independent letters, from the
/// leading monomials of a Groebner basis.
pub(super) fn independent(basis: &[Polynomial], letters: usize) -> Vec<usize> {
    let supports: Vec<usize> = basis
        .iter()
        .filter_map(Poly::lm)
        .map(|m| (0..letters).filter(|x| m.exps()[*x] > 0).fold(0, |mask, x| mask | 1 << x))
        .collect();
    let free = |mask: &usize| supports.iter().all(|support| support & !mask != 0);
    let best = (0..1usize << letters).filter(free).max_by_key(|mask| mask.count_ones());
    (0..letters).filter(|x| best.unwrap_or(0) >> x & 1 == 1).collect()
}

impl<'a> Quotient<'a> {
    /// The quotient by a Groebner basis.
    pub fn new(basis: &'a [Polynomial], letters: usize) -> Result<Self, TooLarge> {
        let heads: Vec<&Monomial> = basis.iter().filter_map(Poly::lm).collect();
        let mut monomials = vec![Monomial::one(letters)];
        let mut at = 0;
        while at < monomials.len() {
            for x in 0..letters {
                let next = &monomials[at] * &Monomial::var(x, letters);
                if !heads.iter().any(|head| head.divides(&next)) && !monomials.contains(&next) {
                    monomials.push(next);
                }
            }
            if monomials.len() > MAX_DIMENSION {
                return Err(TooLarge("it has more than 200 isolated complex solutions"));
            }
            at += 1;
        }
        Ok(Quotient { basis, letters, monomials })
    }

    /// The components of a polynomial in the basis of monomials.
    fn components(&self, f: &Polynomial, budget: &mut Budget) -> Result<Vec<Rational>, TooLarge> {
        let divisors: Vec<&Polynomial> = self.basis.iter().collect();
        let rest = remainder(f, &divisors, budget)?;
        let value = |m: &Monomial| {
            let found = rest.terms.iter().find(|(other, _)| other == m);
            found.map_or_else(Rational::zero, |(_, c)| c.clone())
        };
        Ok(self.monomials.iter().map(value).collect())
    }

    /// The matrix of the multiplication by a linear form; its columns are images.
    fn multiplication(
        &self,
        form: &[Rational],
        budget: &mut Budget,
    ) -> Result<Matrix<Rational>, TooLarge> {
        let terms = form.iter().enumerate();
        let terms = terms.map(|(x, c)| (Monomial::var(x, self.letters), c.clone()));
        let form = Poly::new(terms.collect(), self.letters, ORDER);
        let images = self.monomials.iter().map(|m| {
            let product = form.mul_term(&Rational::one(), m);
            self.components(&product, budget)
        });
        let rows = images.collect::<Result<Vec<_>, _>>()?;
        let matrix = Matrix::from_dense(&rows);
        matrix.map(|m| m.transpose()).map_err(|_| TooLarge("it has no quotient algebra"))
    }

    /// The real points, or equations that split the system.
    pub fn points(&self, budget: &mut Budget) -> Result<Found, TooLarge> {
        let unit = |x: usize| (0..self.letters).map(move |y| Rational::from(i64::from(x == y)));
        let mut candidates = vec![];
        for x in 0..self.letters {
            let matrix = self.multiplication(&unit(x).collect::<Vec<_>>(), budget)?;
            let (minimal, _) = minimal_polynomial(&matrix, budget)?;
            let factors = univariate_factors(&minimal);
            let degrees: usize = factors.iter().map(Uni::deg).sum();
            let real: Vec<_> = factors.iter().filter(|f| !isolate(f).is_empty()).collect();
            if degrees < minimal.deg() || factors.len() > 1 || real.is_empty() {
                let lifted = |f: &&Univariate| f.to_poly(x, self.letters, ORDER);
                return Ok(Found::Equations(real.iter().map(lifted).collect()));
            }
            candidates.push(RealNumber::roots_of(&minimal));
        }
        // now the ideal is radical: its dimension is the number of complex points
        let last = (0..self.letters).rev().map(|x| unit(x).collect::<Vec<_>>());
        let mixed = (1..).map(|k: i64| {
            let powers = std::iter::successors(Some(Rational::one()), |p| {
                Some(p.clone() * &Rational::from(k))
            });
            powers.take(self.letters).collect::<Vec<_>>()
        });
        for form in last.chain(mixed) {
            let matrix = self.multiplication(&form, budget)?;
            let (minimal, powers) = minimal_polynomial(&matrix, budget)?;
            if minimal.deg() == self.monomials.len() {
                return Ok(Found::Points(self.represented(
                    &minimal,
                    powers,
                    &candidates,
                    budget,
                )?));
            }
        }
        Ok(Found::Points(vec![]))
    }

    /// The real points, from the minimal polynomial of a separating form, the powers of the form, and
    /// the candidates for the value of each letter.
    fn represented(
        &self,
        minimal: &Univariate,
        powers: Vec<Vec<Rational>>,
        candidates: &[Vec<RealNumber>],
        budget: &mut Budget,
    ) -> Result<Vec<Point>, TooLarge> {
        let failed = TooLarge("its quotient algebra has no basis of powers");
        let matrix = Matrix::from_dense(&powers).map_err(|_| failed)?.transpose();
        let mut coordinates = vec![];
        for x in 0..self.letters {
            let letter = Poly::var(x, self.letters, ORDER);
            let components = self.components(&letter, budget)?;
            let solved = matrix.solve(&components).ok().flatten().ok_or(failed)?;
            coordinates.push(Uni::new(solved));
        }
        let factors = univariate_factors(minimal);
        let points = factors.iter().flat_map(|factor| {
            let coordinates: Vec<Univariate> = coordinates.iter().map(|q| q % factor).collect();
            let point = move |interval| {
                Point::new(factor.clone(), interval, coordinates.clone(), candidates)
            };
            isolate(factor).into_iter().map(point)
        });
        Ok(points.collect())
    }
}
