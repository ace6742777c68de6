//! Left-invariant symplectic and contact forms, with a witness or a proof that there are none.
//!
//! Closed 2-forms and 1-forms depend linearly on parameters `t`. A symplectic form exists if and only if the
//! Pfaffian of the general closed form, a polynomial in `t`, is not zero. A 1-form `a` in dimension `2 k + 1` is a
//! contact form if `a (d a)^k` is not zero: that is `k!` times the Pfaffian of `d a`, bordered by `a`.
//! An exact symplectic form exists if and only if the index is 0 (Frobenius algebras). A unimodular algebra has no exact
//! one, and none at all if it is not solvable: B.-Y. Chu, *Trans. Amer. Math. Soc.* 197 (1974) 145-159.

use super::cocycles::TwoForms;
use super::{GroundField, StructureTheory, Subspace};
use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::lie_poisson::LiePoisson;
use affinor_tensors::Symbolic;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{Prime, ResidueMatrix, primes};
use num_traits::{One, Zero};

/// The largest dimension at which a Pfaffian is expanded, that is: at which "there is none" can be proved.
const MAX_PFAFFIAN: usize = 8;
/// How many forms are tried modulo a prime.
const TRIALS: usize = 12;
/// Modulo how many primes, and modulo how many where the Pfaffian is known not to vanish.
const PRIMES: usize = 3;
const MORE_PRIMES: usize = 40;

/// Whether a form exists.
#[derive(Clone, Debug, PartialEq)]
pub enum Existence<S> {
    /// Such a form, by its components; not degenerate for generic values of the parameters.
    Witness(Row<S>),
    /// The Pfaffian of the general form is the zero polynomial.
    Impossible,
    /// The index is proved to be this. The form `d a` has the rank `n - index` at most, and so the index is 0 for an exact
    /// symplectic form, and 1 for a contact form.
    Index(usize),
    /// The algebra is unimodular: then it has no exact symplectic form, and none at all if it is not solvable (Chu).
    Unimodular,
    /// None was found, and the Pfaffian was not expanded.
    Open,
}

impl<S: GroundField> StructureTheory<S> {
    /// A closed 2-form that is not degenerate, with components as in [`TwoForms`].
    pub fn symplectic_form(&self, forms: &TwoForms<S>) -> Existence<S> {
        if self.is_unimodular() && !self.is_solvable() {
            return Existence::Unimodular;
        }
        self.nondegenerate(&forms.closed)
    }

    /// An exact 2-form that is not degenerate.
    pub fn exact_symplectic_form(&self, forms: &TwoForms<S>) -> Existence<S> {
        if self.is_unimodular() && self.dimension() > 0 {
            return Existence::Unimodular;
        }
        match self.nondegenerate(&forms.exact) {
            Existence::Open => self.by_index(0),
            found => found,
        }
    }

    fn nondegenerate(&self, forms: &Subspace<S>) -> Existence<S> {
        let n = self.dimension();
        let family = forms.basis().iter().map(|row| antisymmetric(n, row)).collect();
        match search(n, family) {
            Found::Parameters(t) => Existence::Witness(forms.vector(&t)),
            Found::Nothing => Existence::Impossible,
            Found::Open => Existence::Open,
        }
    }

    /// A contact form `a`: `a (d a)^k` is not zero in dimension `2 k + 1`.
    pub fn contact_form(&self) -> Existence<S> {
        let n = self.dimension();
        let bordered = |i: usize| {
            let differential = antisymmetric(n, &self.differential(&[(i, S::one())]));
            let mut matrix = vec![vec![S::zero(); n + 1]; n + 1];
            for (j, row) in differential.iter().enumerate() {
                matrix[j + 1][1..].clone_from_slice(row);
            }
            matrix[0][i + 1] = S::one();
            matrix[i + 1][0] = -S::one();
            matrix
        };
        match search(n + 1, (0..n).map(bordered).collect()) {
            Found::Parameters(t) => Existence::Witness(t),
            Found::Nothing => Existence::Impossible,
            Found::Open => self.by_index(1),
        }
    }

    /// None, if the index is proved to be larger.
    fn by_index(&self, most: usize) -> Existence<S> {
        let index = self.index();
        match index.proved && index.dimension > most {
            true => Existence::Index(index.dimension),
            false => Existence::Open,
        }
    }

    /// A linear form `f` at which `f([x, y])` has its largest rank, the dimension minus the index.
    pub fn regular_form(&self) -> Option<Row<S>> {
        let n = self.dimension();
        let rank = n - self.index().dimension;
        let differentials: Vec<_> =
            (0..n).map(|i| antisymmetric(n, &self.differential(&[(i, S::one())]))).collect();
        shortened(&differentials, n, rank, PRIMES)
    }

    /// Generators of the polynomial Casimir functions up to a degree, in `mu_i = mu(e_i)`.
    ///
    /// # Errors
    /// As [`LiePoisson::casimir_generators`].
    pub fn casimirs(&self, most: u32) -> Result<Vec<Symbolic>, Error> {
        let algebra: LieAlgebra<Symbolic> = self.algebra().map(GroundField::symbolic)?;
        LiePoisson::right(&algebra)?.casimir_generators(most)
    }
}

type Dense<S> = Vec<Vec<S>>;

fn antisymmetric<S: GroundField>(n: usize, form: &[(usize, S)]) -> Dense<S> {
    let mut matrix = vec![vec![S::zero(); n]; n];
    for (at, value) in form {
        matrix[at / n][at % n] = value.clone();
        matrix[at % n][at / n] = -value.clone();
    }
    matrix
}

enum Found<S> {
    Parameters(Row<S>),
    Nothing,
    Open,
}

/// Parameters at which a combination of antisymmetric matrices of size `n` is regular.
fn search<S: GroundField>(n: usize, family: Vec<Dense<S>>) -> Found<S> {
    if n % 2 == 1 || family.is_empty() {
        return if n == 0 { Found::Parameters(vec![]) } else { Found::Nothing };
    }
    if let Some(t) = shortened(&family, n, n, PRIMES) {
        return Found::Parameters(t);
    }
    if n > MAX_PFAFFIAN {
        return Found::Open;
    }
    // no parameter of the brackets begins with a space
    let parameters: Vec<Symbolic> =
        (0..family.len()).map(|at| Symbolic::parameter(&format!(" t{at}"))).collect();
    let entry = |i: usize, j: usize| {
        family.iter().zip(&parameters).fold(Symbolic::zero(), |sum, (matrix, t)| {
            match matrix[i][j].vanishes() {
                true => sum,
                false => sum + &(matrix[i][j].symbolic() * t),
            }
        })
    };
    let general: Vec<Vec<Symbolic>> =
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    match pfaffian(&general, &(0..n).collect::<Vec<_>>()).is_zero() {
        true => Found::Nothing,
        false => shortened(&family, n, n, MORE_PRIMES).map_or(Found::Open, Found::Parameters),
    }
}

/// The Pfaffian of the rows and columns in a list, expanded along the first.
pub(super) fn pfaffian(matrix: &[Vec<Symbolic>], rows: &[usize]) -> Symbolic {
    let Some((&first, rest)) = rows.split_first() else { return Symbolic::one() };
    let mut sum = Symbolic::zero();
    for (at, &second) in rest.iter().enumerate() {
        if matrix[first][second].is_zero() {
            continue;
        }
        let others: Vec<usize> = rest.iter().copied().filter(|row| *row != second).collect();
        let term = matrix[first][second].clone() * &pfaffian(matrix, &others);
        sum = if at % 2 == 0 { sum + &term } else { sum - &term };
    }
    sum
}

/// Small parameters at which a combination of matrices has a rank: of a few pseudorandom ones, with as many zeros and ones
/// as the rank allows. The rank modulo a prime is no larger than the rank, so it proves that. Primes that divide an entry are
/// passed over.
fn shortened<S: GroundField>(
    family: &[Dense<S>],
    n: usize,
    rank: usize,
    most: usize,
) -> Option<Row<S>> {
    let residues = |prime: Prime| {
        let entry = |v: &S| v.residue(prime).filter(|residue| *residue != 0 || v.vanishes());
        let matrix = |matrix: &Dense<S>| -> Option<Vec<Vec<u64>>> {
            matrix.iter().map(|row| row.iter().map(entry).collect()).collect()
        };
        Some((prime, family.iter().map(matrix).collect::<Option<Vec<_>>>()?))
    };
    let mut reductions = primes().filter_map(residues).take(most);
    reductions.find_map(|(prime, reduced)| shortened_modulo(prime, &reduced, n, rank))
}

fn shortened_modulo<S: GroundField>(
    prime: Prime,
    reduced: &[Vec<Vec<u64>>],
    n: usize,
    rank: usize,
) -> Option<Row<S>> {
    let regular = |t: &[i64]| {
        let mut sum = vec![vec![0; n]; n];
        for (factor, matrix) in t.iter().zip(reduced).filter(|(factor, _)| **factor != 0) {
            let factor = prime.integer(*factor);
            for (row, terms) in sum.iter_mut().zip(matrix) {
                for (entry, term) in row.iter_mut().zip(terms) {
                    *entry = prime.add(*entry, prime.mul(factor, *term));
                }
            }
        }
        ResidueMatrix::new(prime, n, sum).rank() == rank
    };
    let mut state = 0x9e37_79b9_u64;
    let mut draw = |below: u64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        1 + ((state >> 33) % below) as i64
    };
    for trial in 0..TRIALS as u64 {
        let mut t: Vec<i64> = reduced.iter().map(|_| draw(5 << trial)).collect();
        if !regular(&t) {
            continue;
        }
        for value in [0, 1] {
            for at in (0..t.len()).rev() {
                if t[at] != 0 {
                    let old = std::mem::replace(&mut t[at], value);
                    if !regular(&t) {
                        t[at] = old;
                    }
                }
            }
        }
        let kept = t.into_iter().enumerate().filter(|(_, value)| *value != 0);
        return Some(kept.map(|(at, value)| (at, S::from_i64(value))).collect());
    }
    None
}
