//! The index: the dimension minus the largest rank of the forms `f([x, y])`.
//!
//! For a reductive algebra, the index is the rank. In general, the rank at one form, modulo a
//! prime, is a lower bound of the largest rank `r`. An upper bound of `r` follows from a lower
//! bound of the index. One lower bound is the dimension of the centre. Another is `2 dim a - n` for
//! an abelian ideal `a`, because only two blocks of the form are nonzero. In addition, the rank of
//! an antisymmetric form is even.
//!
//! Otherwise, Pfaffians prove the upper bound; they are polynomials in `f`. Assume that the
//! Pfaffian of `r` rows is nonzero, and that the Pfaffians of the same rows and any two others
//! vanish. Then the Schur complement of the rows is zero, and the rank is `r`.

use super::certificates::Certified;
use super::reduction::{ModularAlgebra, PseudoRandom};
use super::symplectic::pfaffian;
use super::{GroundField, StructureTheory, Subspace};
use affinor_tensors::linear::modular::ResidueMatrix;
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring, Symbolic};
use num_traits::Zero;

/// The number of primes modulo which a form is reduced.
const PRIMES: usize = 6;
/// The largest dimension at which abelian ideals are searched for.
const MAX_IDEALS: usize = 60;
/// The largest number of products of entries in one expanded Pfaffian.
const MAX_PRODUCTS: usize = 4000;
/// The largest average number of coordinates of `f` in the entries of one row of a Pfaffian.
const MAX_TERMS: usize = 30;

impl<S: GroundField> StructureTheory<S> {
    /// The index: the dimension minus the largest rank of the forms `f([x, y])`, with a proof if
    /// one is found. The index is the number of independent invariants of the coadjoint
    /// representation.
    pub fn index(&self) -> Certified {
        let _stage = stage("index");
        if self.is_reductive() {
            // the index is the dimension of a Cartan subalgebra: an invariant form identifies forms
            // with elements, and the centralizer of a regular element is a Cartan subalgebra
            return Certified::theorem(self.cartan_subalgebra().dimension());
        }
        let (n, rows) = (self.dimension(), self.regular_rows());
        let dimension = n - rows.len();
        let proved = self.has_index(dimension)
            || self.over_the_rationals().is_some_and(|all| all.has_no_more_rows(&rows));
        Certified { dimension, proved }
    }

    /// The indices of a nonsingular principal minor of a form `f([x, y])`. The minor is the largest
    /// that was found.
    fn regular_rows(&self) -> Vec<usize> {
        let rows = self.reductions().take(PRIMES).map(|reduction| reduction.regular_rows());
        rows.max_by_key(Vec::len).unwrap_or_default()
    }

    /// Whether one of the lower bounds proves that the index is at least `index`.
    fn has_index(&self, index: usize) -> bool {
        let n = self.dimension();
        if index <= self.centre().dimension().max(n % 2) {
            return true;
        }
        let large = |v: &Subspace<S>| 2 * v.dimension() >= n + index;
        let abelian = |v: &Subspace<S>| self.bracket(v, v).is_zero();
        let derived = self.derived_series().iter().filter(|v| large(v));
        let lower = self.lower_central_series().iter().filter(|v| large(v));
        let mut terms = derived.chain(lower);
        let centralizer = |v: &Subspace<S>| Some(self.centralizer(v)).filter(large);
        terms.any(abelian)
            || n <= MAX_IDEALS
                && self.lower_central_series().iter().filter_map(centralizer).any(|v| abelian(&v))
    }
}

impl StructureTheory<Rational> {
    /// Whether every Pfaffian of the given rows and two other rows is zero. Returns `false` if the
    /// Pfaffians are too long.
    fn has_no_more_rows(&self, rows: &[usize]) -> bool {
        let n = self.dimension();
        let others: Vec<usize> = (0..n).filter(|row| rows.binary_search(row).is_err()).collect();
        let pairs = others.len() * others.len().saturating_sub(1) / 2;
        let products = (1..=rows.len() + 1).step_by(2).try_fold(pairs, usize::checked_mul);
        let terms = (0..n).map(|j| self.products.of(j).len()).sum::<usize>();
        if products.is_none_or(|all| all > MAX_PRODUCTS) || terms > MAX_TERMS * n {
            return false;
        }
        let mut form = vec![vec![Symbolic::zero(); n]; n];
        for (j, row) in form.iter_mut().enumerate() {
            for (k, i, value) in self.products.of(j) {
                let term =
                    Symbolic::constant(value.clone()) * &Symbolic::parameter(&format!("f{i}"));
                row[*k] = std::mem::replace(&mut row[*k], Symbolic::zero()) + &term;
            }
        }
        others.iter().enumerate().all(|(at, &a)| {
            others[at + 1..].iter().all(|&b| {
                let mut rows = [rows, &[a, b]].concat();
                rows.sort_unstable();
                pfaffian(&form, &rows).vanishes()
            })
        })
    }
}

impl ModularAlgebra {
    /// The indices of a nonsingular principal minor of `f([e_i, e_j])` for a pseudorandom linear
    /// form `f`. For an antisymmetric matrix, any maximal set of independent rows yields such a
    /// minor.
    fn regular_rows(&self) -> Vec<usize> {
        let (n, p) = (self.dimension(), self.prime());
        let form = PseudoRandom::new(1).vector(p, n);
        let mut rows = vec![vec![0; n]; n];
        for (j, row) in rows.iter_mut().enumerate() {
            for &(k, i, value) in self.of(j) {
                row[k] = p.reduce(row[k] + value * form[i]);
            }
        }
        ResidueMatrix::new(p, n, rows).reduce()
    }
}
