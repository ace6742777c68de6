//! Isomorphisms between nilpotent algebras of dimension 5 and 6 and algebras of the catalogue.
//!
//! An isomorphism maps the terms of both central series, and their centralizers, to the
//! corresponding subspaces of the other algebra. This condition yields linear equations for the
//! matrix of the isomorphism. The equations `f([x, y]) = [f(x), f(y)]` for the basis are quadratic.
//! The solver determines the images of the generators first.

use super::polynomials::{
    MAX_VARIABLES, Polynomial, Search, System, plus, product, value, variable,
};
use super::witness::sum;
use super::{StructureTheory, Subspace, Vector, scale};
use crate::algebra::BasisChange;
use crate::algebra::structure::subspace::combination;
use affinor_tensors::{Down, Rational, Ring, Tensor, Up};

/// The number of orders of the generators and values that are tried, and of steps of each attempt.
const ATTEMPTS: usize = 24;
const STEPS: usize = 160;
/// The multiples of the second basis vector that are added to the first basis vector, one in each
/// attempt.
const SHEARS: [i64; 4] = [0, 1, -1, 2];

impl StructureTheory<Rational> {
    /// The images of the basis of a named nilpotent algebra. Returns `None` if no isomorphism is
    /// found.
    pub(super) fn onto_nilpotent(&self, named: &Self) -> Option<Vec<Vector>> {
        // changes to a basis that is adapted to the characteristic subspaces, because brackets are
        // sparse in this basis
        let n = self.dimension();
        let mut flags = self.flags();
        flags.sort_by_key(Subspace::dimension);
        let mut span = Subspace::zero(n);
        let vectors = flags.iter().flat_map(|flag| flag.basis().to_vec());
        let mut basis: Vec<Vector> = vectors.filter(|row| span.add(row.clone())).collect();
        basis.reverse();
        // tries several first vectors, because the solver tries only small values for the unknowns
        SHEARS.into_iter().find_map(|factor| {
            let mut sheared = basis.clone();
            sheared[0] = sum(&basis[0], &scale(&basis[1], &Rational::from(factor)));
            self.in_basis_onto(&sheared, named)
        })
    }

    fn in_basis_onto(&self, basis: &[Vector], named: &Self) -> Option<Vec<Vector>> {
        let n = self.dimension();
        let mut entries = vec![vec![Rational::from(0); n]; n];
        for (a, row) in basis.iter().enumerate() {
            row.iter().for_each(|(i, value)| entries[*i][a] = value.clone());
        }
        let change =
            Tensor::from_fn(n, [Up, Down], |[i, a]: [usize; 2]| entries[i][a].clone()).ok()?;
        let adapted = self.algebra.change_basis(&BasisChange::new(change).ok()?).ok()?;
        let found = StructureTheory::new(adapted).adapted_onto(named)?;
        Some(found.iter().map(|row| combination(basis, row)).collect())
    }

    fn adapted_onto(&self, named: &Self) -> Option<Vec<Vector>> {
        let n = self.dimension();
        // in the list of unknowns, the component k of the image of e_i has the index i n + k
        let flags = self.flags().into_iter().zip(named.flags());
        let mut rows = vec![];
        for (own, other) in flags {
            if own.dimension() != other.dimension() {
                return None;
            }
            // the linear functionals that vanish on the subspace
            let zero_on = Subspace::kernel(n, own.basis().iter().cloned());
            for (x, functional) in
                other.basis().iter().flat_map(|x| zero_on.basis().iter().map(move |f| (x, f)))
            {
                let terms = x.iter().flat_map(|(i, a)| {
                    functional.iter().map(move |(k, b)| (i * n + k, a.clone() * b))
                });
                rows.push(terms.collect());
            }
        }
        let maps = Subspace::kernel(n * n, rows);
        if maps.dimension() > MAX_VARIABLES {
            return None;
        }
        let mut matrix: Vec<Polynomial> = vec![vec![]; n * n];
        for (at, row) in maps.basis().iter().enumerate() {
            for (place, factor) in row {
                matrix[*place] = plus(&matrix[*place], &scale(&variable(at), factor));
            }
        }
        let equations = self.equations(named, &matrix);
        let generators: Vec<usize> = named.derived().complement().collect();
        let image_of: Vec<usize> =
            maps.basis().iter().map(|row| row.first().map_or(0, |(at, _)| at / n)).collect();
        (0..ATTEMPTS).find_map(|attempt| {
            // first the generators, in a different order for each attempt, then the other vectors
            let mut rows = generators.clone();
            rows.rotate_left(attempt % generators.len());
            if attempt / generators.len() % 2 == 1 {
                rows[1..].reverse();
            }
            let rank = |at: usize| {
                rows.iter().position(|row| *row == image_of[at]).unwrap_or(image_of[at] + n)
            };
            let mut order: Vec<usize> = (0..maps.dimension()).collect();
            order.sort_by_key(|at| (rank(*at), *at));
            let before = 1 + attempt % 2;
            let first = order.iter().filter(|at| rank(**at) < before).count();
            let admissible = |results: &[Polynomial]| regular(n, results);
            let mut search = Search {
                admissible: &admissible,
                order: &order,
                first,
                seed: attempt / 2,
                left: STEPS,
            };
            let system = System { equations: equations.clone(), results: matrix.clone() };
            let found = search.solve(system)?;
            let vectors: Vec<Vector> = found.chunks(n).map(sparse).collect();
            self.respects(named, &vectors).then_some(vectors)
        })
    }

    /// Subspaces that every isomorphism maps to the corresponding subspaces.
    fn flags(&self) -> Vec<Subspace<Rational>> {
        let mut flags = self.lower_central_series().to_vec();
        flags.extend(self.upper_central_series());
        let centralizers: Vec<_> = flags.iter().map(|v| self.centralizer(v)).collect();
        let brackets: Vec<_> = centralizers.iter().map(|v| self.bracket(v, v)).collect();
        flags.extend(centralizers);
        flags.extend(brackets.iter().map(|v| self.centralizer(v)));
        flags.extend(brackets);
        flags
    }

    /// The components of `f([e_i, e_j]) - [f(e_i), f(e_j)]`, which vanish if `f` is a homomorphism.
    fn equations(&self, named: &Self, matrix: &[Polynomial]) -> Vec<Polynomial> {
        let n = self.dimension();
        let mut equations = vec![];
        for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
            let mut difference: Vec<Polynomial> = vec![vec![]; n];
            for (k, c) in named.column_of(i, j) {
                for (at, sum) in difference.iter_mut().enumerate() {
                    *sum = plus(sum, &scale(&matrix[k * n + at], &c));
                }
            }
            for a in 0..n {
                for (b, at, c) in self.products.of(a) {
                    let both = product(&matrix[i * n + a], &matrix[j * n + b]);
                    difference[*at] = plus(&difference[*at], &scale(&both, &-c.clone()));
                }
            }
            equations.extend(difference.into_iter().filter(|row| !row.is_empty()));
        }
        equations
    }

    pub(super) fn column_of(&self, i: usize, j: usize) -> Vector {
        let unit = |at: usize| vec![(at, Rational::from(1))];
        self.products.ad(&unit(i)).image(&unit(j))
    }
}

fn sparse(row: &[Rational]) -> Vector {
    row.iter().cloned().enumerate().filter(|(_, value)| !value.vanishes()).collect()
}

/// Whether the matrix is invertible at one of two pseudorandom points.
fn regular(n: usize, matrix: &[Polynomial]) -> bool {
    [(7919, 1013), (104_729, 997)].into_iter().any(|(factor, modulus)| {
        let at = |v: usize| {
            let mixed = (v as i64 + 3) * (v as i64 + 17) * factor % modulus;
            Rational::from(mixed * mixed % modulus - 300)
        };
        let numbers: Vec<Rational> = matrix.iter().map(|entry| value(entry, &at)).collect();
        Subspace::span(n, numbers.chunks(n).map(sparse)).dimension() == n
    })
}
