//! Left-invariant symplectic and contact forms, with a witness or a proof that none exists.
//!
//! The general closed 2-form and the general 1-form depend linearly on parameters `t`. A symplectic
//! form exists if and only if the Pfaffian of the general closed 2-form is not zero, as a
//! polynomial in `t`. A 1-form `a` in dimension `2 k + 1` is a contact form if `a (d a)^k` is not
//! zero; this product is `k!` times the Pfaffian of `d a`, bordered by `a`. An exact symplectic
//! form exists if and only if the index is 0 (Frobenius algebras). A unimodular algebra has no
//! exact symplectic form, and no symplectic form at all if it is not solvable: B.-Y. Chu, *Trans.
//! Amer. Math. Soc.* 197 (1974) 145-159.

use super::certificates::Certified;
use super::cocycles::TwoForms;
use super::reduction::{ModularAlgebra, PseudoRandom};
use super::{GroundField, StructureTheory, Subspace};
use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::lie_poisson::LiePoisson;
use affinor_tensors::Symbolic;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{Prime, ResidueMatrix, primes};
use affinor_tensors::stop::stage;
use num_traits::{One, Zero};

/// The largest dimension at which a Pfaffian is expanded to prove that no form exists.
const MAX_PFAFFIAN: usize = 8;
/// The number of forms that are tried modulo each prime.
const TRIALS: usize = 12;
/// The number of primes that are tried.
const PRIMES: usize = 3;
const MORE_PRIMES: usize = 40;

/// The answer to the question whether a form exists.
#[derive(Clone, Debug, PartialEq)]
pub enum Existence<S> {
    /// A form, by its components. It is nondegenerate for generic values of the parameters.
    Witness(Row<S>),
    /// The Pfaffian of the general form is the zero polynomial.
    Impossible,
    /// The index has this value, with a proof. The rank of a form `d a` is at most `n - index`, so
    /// the index would have to be 0 for an exact symplectic form, and 1 for a contact form.
    Index(usize),
    /// The algebra is unimodular, so it has no exact symplectic form, and no symplectic form at all
    /// if it is not solvable (Chu).
    Unimodular,
    /// The general form has this rank, which is too small. The rank is computed modulo primes at
    /// pseudorandom forms; it is proved if a common kernel of all forms explains it. For a contact
    /// form, it is the rank of `d a`, bordered by `a`.
    Rank(Certified),
    /// No form was found, but one may exist.
    Open,
}

impl<S: GroundField> StructureTheory<S> {
    /// A closed 2-form that is not degenerate, with components as in [`TwoForms`].
    pub fn symplectic_form(&self, forms: &TwoForms<S>) -> Existence<S> {
        let _stage = stage("symplectic form");
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
            found @ (Existence::Open | Existence::Rank(Certified { proved: false, .. })) => {
                match self.by_index(0) {
                    Existence::Open => found,
                    proved => proved,
                }
            }
            found => found,
        }
    }

    fn nondegenerate(&self, forms: &Subspace<S>) -> Existence<S> {
        let n = self.dimension();
        let family: Vec<Entries<S>> =
            forms.basis().iter().map(|row| antisymmetric(n, row)).collect();
        match search(n, &family) {
            Found::Parameters(t) => Existence::Witness(forms.vector(&t)),
            Found::Nothing => Existence::Impossible,
            Found::Open => self.by_rank(n, &family),
        }
    }

    /// The answer if the rank of the general form of a family is too small. The rank is computed
    /// modulo primes.
    fn by_rank(&self, n: usize, family: &[Entries<S>]) -> Existence<S> {
        let residues = |reduction: ModularAlgebra| generic_rank(reduction.prime(), n, family);
        let rank = self.reductions().filter_map(residues).take(2).max().unwrap_or(0);
        if rank == n {
            return Existence::Open;
        }
        let mut rows = vec![];
        for form in family {
            let mut by_row = vec![vec![]; n];
            form.iter().for_each(|(i, j, value)| by_row[*i].push((*j, value.clone())));
            rows.extend(by_row.into_iter().filter(|row| !row.is_empty()));
        }
        let kernel = n - Subspace::span(n, rows).dimension();
        // an antisymmetric form has even rank, so a difference of 1 from the upper bound is a proof
        Existence::Rank(Certified { dimension: rank, proved: rank + 1 >= n - kernel })
    }

    /// A contact form `a`: `a (d a)^k` is not zero in dimension `2 k + 1`.
    pub fn contact_form(&self) -> Existence<S> {
        let _stage = stage("contact form");
        let n = self.dimension();
        let bordered = |i: usize| {
            let differential = antisymmetric(n, &self.differential(&[(i, S::one())]));
            let shifted = differential.into_iter().map(|(j, k, value)| (j + 1, k + 1, value));
            let border = [(0, i + 1, S::one()), (i + 1, 0, -S::one())];
            border.into_iter().chain(shifted).collect()
        };
        let family: Vec<Entries<S>> = (0..n).map(bordered).collect();
        match search(n + 1, &family) {
            Found::Parameters(t) => Existence::Witness(t),
            Found::Nothing => Existence::Impossible,
            Found::Open => match self.by_index(1) {
                Existence::Open => self.by_rank(n + 1, &family),
                found => found,
            },
        }
    }

    /// The answer if the index is proved to exceed `most`.
    fn by_index(&self, most: usize) -> Existence<S> {
        let index = self.index();
        match index.proved && index.dimension > most {
            true => Existence::Index(index.dimension),
            false => Existence::Open,
        }
    }

    /// A linear form `f` at which the rank of `f([x, y])` is largest, which is the dimension minus
    /// the index.
    pub fn regular_form(&self) -> Option<Row<S>> {
        let n = self.dimension();
        let rank = n - self.index().dimension;
        let differentials: Vec<_> =
            (0..n).map(|i| antisymmetric(n, &self.differential(&[(i, S::one())]))).collect();
        shortened(&differentials, n, rank, PRIMES)
    }

    /// Generators of the polynomial Casimir functions up to the degree `most`, in the coordinates
    /// `mu_i = mu(e_i)`.
    ///
    /// # Errors
    /// The errors of [`LiePoisson::casimir_generators`].
    pub fn casimirs(&self, most: u32) -> Result<Vec<Symbolic>, Error> {
        let _stage = stage("casimirs");
        let algebra: LieAlgebra<Symbolic> = self.algebra().map(GroundField::symbolic)?;
        LiePoisson::right(&algebra)?.casimir_generators(most)
    }
}

/// The entries `(i, j, v)` of an antisymmetric matrix.
type Entries<S> = Vec<(usize, usize, S)>;

fn antisymmetric<S: GroundField>(n: usize, form: &[(usize, S)]) -> Entries<S> {
    let both = |(at, value): &(usize, S)| {
        let (i, j) = (at / n, at % n);
        [(i, j, value.clone()), (j, i, -value.clone())]
    };
    form.iter().flat_map(both).collect()
}

/// The rank of a pseudorandom combination of matrices modulo a prime; `None` if the prime divides
/// an entry.
fn generic_rank<S: GroundField>(prime: Prime, n: usize, family: &[Entries<S>]) -> Option<usize> {
    let reduced: Vec<_> = family.iter().map(|form| residues(prime, form)).collect::<Option<_>>()?;
    let t = PseudoRandom::new(5).vector(prime, family.len());
    Some(combined(prime, n, &t, &reduced).rank())
}

/// The residues of a matrix; `None` if the prime divides an entry.
fn residues<S: GroundField>(prime: Prime, form: &Entries<S>) -> Option<Entries<u64>> {
    let residue = |(i, j, value): &(usize, usize, S)| {
        let residue = value.residue(prime).filter(|residue| *residue != 0)?;
        Some((*i, *j, residue))
    };
    form.iter().map(residue).collect()
}

/// The combination of the matrices with the coefficients `t`.
fn combined(prime: Prime, n: usize, t: &[u64], reduced: &[Entries<u64>]) -> ResidueMatrix {
    let mut sum = vec![vec![0; n]; n];
    for (&factor, matrix) in t.iter().zip(reduced).filter(|(factor, _)| **factor != 0) {
        for (i, j, value) in matrix {
            sum[*i][*j] = prime.add(sum[*i][*j], prime.mul(factor, *value));
        }
    }
    ResidueMatrix::new(prime, n, sum)
}

enum Found<S> {
    Parameters(Row<S>),
    Nothing,
    Open,
}

/// Searches for parameters at which a combination of antisymmetric matrices of size `n` is
/// nonsingular.
fn search<S: GroundField>(n: usize, family: &[Entries<S>]) -> Found<S> {
    if n % 2 == 1 || family.is_empty() {
        return if n == 0 { Found::Parameters(vec![]) } else { Found::Nothing };
    }
    if let Some(t) = shortened(family, n, n, PRIMES) {
        return Found::Parameters(t);
    }
    if n > MAX_PFAFFIAN {
        return Found::Open;
    }
    // the names of the parameters begin with a space, so they differ from all parameters of the
    // bracket
    let parameters: Vec<Symbolic> =
        (0..family.len()).map(|at| Symbolic::parameter(&format!(" t{at}"))).collect();
    let mut general = vec![vec![Symbolic::zero(); n]; n];
    for (matrix, t) in family.iter().zip(&parameters) {
        for (i, j, value) in matrix {
            let sum = std::mem::replace(&mut general[*i][*j], Symbolic::zero());
            general[*i][*j] = sum + &(value.symbolic() * t);
        }
    }
    match pfaffian(&general, &(0..n).collect::<Vec<_>>()).is_zero() {
        true => Found::Nothing,
        false => shortened(family, n, n, MORE_PRIMES).map_or(Found::Open, Found::Parameters),
    }
}

/// The Pfaffian of the submatrix with these rows and columns, expanded along the first row.
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

/// Small parameters at which a combination of matrices has a given rank. The search starts from a
/// few pseudorandom parameters, and replaces as many as possible by zeros and ones. The rank modulo
/// a prime is at most the rank over the field, so it is a proof. Primes that divide an entry are
/// skipped.
fn shortened<S: GroundField>(
    family: &[Entries<S>],
    n: usize,
    rank: usize,
    most: usize,
) -> Option<Row<S>> {
    let reduced = |prime: Prime| {
        let reduced = family.iter().map(|form| residues(prime, form));
        Some((prime, reduced.collect::<Option<Vec<_>>>()?))
    };
    let mut reductions = primes().filter_map(reduced).take(most);
    reductions.find_map(|(prime, reduced)| shortened_modulo(prime, &reduced, n, rank))
}

fn shortened_modulo<S: GroundField>(
    prime: Prime,
    reduced: &[Entries<u64>],
    n: usize,
    rank: usize,
) -> Option<Row<S>> {
    let regular = |t: &[i64]| {
        let t: Vec<u64> = t.iter().map(|factor| prime.integer(*factor)).collect();
        combined(prime, n, &t, reduced).rank() == rank
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
