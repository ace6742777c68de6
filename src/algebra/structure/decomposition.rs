//! Decomposition into indecomposable ideals (de Graaf 1.15; Rand, Winternitz, Zassenhaus, *Linear
//! Algebra Appl.* 109 (1988) 197-246).
//!
//! Central lines outside the derived algebra are split off first. The rest is decomposed by its
//! centroid, which consists of the maps that commute with all `ad`. Each coprime factor of the
//! minimal polynomial of a general element yields an ideal.
//!
//! The certificate is as follows. The commutators of the centroid `C` map to the centre, which is
//! contained in the derived algebra, and they annihilate the derived algebra. Therefore `C` modulo
//! its radical is a product of number fields, and `C` has `dim C - dim rad C` characters over the
//! complex numbers. An element on which all characters differ generates the product, and the number
//! of distinct roots of its minimal polynomial is the number of characters.

use super::radical::on_moment_curve;
use super::{StructureTheory, Subspace};
use crate::Error;
use crate::algebra::irreducible_factors;
use crate::algebra::matrix_polynomials::{evaluate, minimal_polynomial};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring};

/// The largest dimension at which the centroid is computed.
pub const MAX_DIMENSION: usize = 12;

/// The number of elements with short coefficients that are tried first.
const SHORT: i64 = 3;

/// An ideal that is indecomposable over the rationals.
#[derive(Clone, Debug)]
pub struct Indecomposable {
    /// The ideal.
    pub ideal: Subspace<Rational>,
    /// The number of indecomposable ideals of its decomposition over the reals.
    pub real_parts: usize,
}

impl StructureTheory<Rational> {
    /// Decomposes the algebra into ideals that are indecomposable over the rationals. Returns
    /// `None` beyond [`MAX_DIMENSION`].
    ///
    /// # Errors
    /// The errors of [`subalgebra`](Self::subalgebra). They cannot occur for a Lie algebra.
    pub fn indecomposable_ideals(&self) -> Result<Option<Vec<Indecomposable>>, Error> {
        let _stage = stage("decomposition");
        let n = self.dimension();
        if n > MAX_DIMENSION {
            return Ok(None);
        }
        let mut span = self.derived().clone();
        let mut ideals = vec![];
        for line in self.centre().basis() {
            if span.add(line.clone()) {
                let ideal = Subspace::span(n, [line.clone()]);
                ideals.push(Indecomposable { ideal, real_parts: 1 });
            }
        }
        // computes a complement of the central lines that contains the derived algebra
        let mut rest = self.derived().clone();
        for vector in self.whole().basis() {
            if span.add(vector.clone()) {
                rest.add(vector.clone());
            }
        }
        if rest.is_zero() {
            return Ok(Some(ideals));
        }
        let inside = self.subalgebra(&rest)?;
        let Some(parts) = inside.parts_by_centroid() else { return Ok(None) };
        ideals.extend(
            parts
                .into_iter()
                .map(|(part, real_parts)| Indecomposable { ideal: rest.within(&part), real_parts }),
        );
        Ok(Some(ideals))
    }

    fn parts_by_centroid(&self) -> Option<Vec<(Subspace<Rational>, usize)>> {
        let n = self.dimension();
        let centroid = self.centroid_by_equations();
        let eigenvalues = geometric_idempotents(n, centroid.basis());
        for trial in 1.. {
            let factors: Vec<Rational> = match trial <= SHORT {
                true => {
                    let factor = |at: i64| (trial * 7 + (at + 1) * (at + trial)) % 23;
                    (0..centroid.dimension() as i64).map(|at| Rational::from(factor(at))).collect()
                }
                false => on_moment_curve(trial - SHORT + 1, centroid.dimension()),
            };
            let terms: Row<Rational> =
                factors.into_iter().enumerate().filter(|(_, factor)| !factor.vanishes()).collect();
            let gamma = square(n, &centroid.vector(&terms))?;
            let minimal = minimal_polynomial(&gamma)?;
            let factors = irreducible_factors(&minimal);
            if factors.iter().map(|(factor, _)| factor.deg()).sum::<usize>() < eigenvalues {
                continue;
            }
            let part = |(factor, multiplicity): &(polycore::Uni<_>, u32)| {
                let kernel = evaluate(&gamma, &factor.pow(*multiplicity));
                let kernel = Subspace::kernel(n, (0..n).map(|i| kernel.row(i).to_vec()));
                let real = factor.isolate().len();
                (kernel, real + (factor.deg() - real) / 2)
            };
            return Some(factors.iter().map(part).collect());
        }
        None
    }

    /// The centroid: the maps `A^i_j` with `A [e_a, e_k] = [e_a, A e_k]` for all `a` and `k`. The
    /// component `A^i_j` is stored at `i n + j`.
    fn centroid_by_equations(&self) -> Subspace<Rational> {
        let n = self.dimension();
        let mut equations: Vec<Row<Rational>> = vec![];
        for a in 0..n {
            let ad = self.products.ad(&[(a, Rational::from_i64(1))]);
            let dense: Vec<Vec<Rational>> = (0..n)
                .map(|k| {
                    let mut image = vec![Rational::from(0); n];
                    ad.column(k).iter().for_each(|(i, v)| image[*i] = v.clone());
                    image
                })
                .collect();
            for (k, i) in (0..n).flat_map(|k| (0..n).map(move |i| (k, i))) {
                let left = ad.column(k).iter().map(|(m, v)| (i * n + m, v.clone()));
                let right = dense.iter().enumerate().filter(|(_, image)| !image[i].vanishes());
                let right = right.map(|(m, image)| (m * n + k, -image[i].clone()));
                let row = super::subspace::collected(left.chain(right).collect());
                if !row.is_empty() {
                    equations.push(row);
                }
            }
        }
        Subspace::kernel_of_long(n * n, equations)
    }
}

/// The matrix of a map. Its component `A^i_j` is stored at `i n + j` of `map`.
fn square(n: usize, map: &[(usize, Rational)]) -> Option<Matrix<Rational>> {
    let mut rows = vec![vec![]; n];
    map.iter().for_each(|(at, value)| rows[at / n].push((at % n, value.clone())));
    Matrix::from_rows(n, rows).ok()
}

/// The number `dim C - dim rad C` for an algebra `C` of maps. It is the rank of the form `tr(A B)`,
/// whose kernel is the radical in characteristic 0.
fn geometric_idempotents(n: usize, maps: &[Row<Rational>]) -> usize {
    let transposed = |at: usize| at % n * n + at / n;
    let form = maps.iter().map(|a| {
        let trace = |b: &Row<Rational>| {
            let terms = a.iter().filter_map(|(at, value)| {
                let place = b.binary_search_by_key(&transposed(*at), |(at, _)| *at).ok()?;
                Some(value.clone() * &b[place].1)
            });
            terms.fold(Rational::from(0), |sum, term| sum + &term)
        };
        let row = maps.iter().map(trace).enumerate();
        row.filter(|(_, value)| !value.vanishes()).collect::<Row<Rational>>()
    });
    Subspace::span(maps.len(), form).dimension()
}
