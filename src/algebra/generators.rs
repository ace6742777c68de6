//! Generators of an algebra whose bracket is not yet known to satisfy the Jacobi identity.
//!
//! Consider the `x` for which `[x, .]` is a derivation: `[x,[y,z]] = [[x,y],z] + [y,[x,z]]` for all
//! `y`, `z`. They form a vector space that is closed under the bracket, because `ad_[x,y] = ad_x
//! ad_y - ad_y ad_x` is a commutator of derivations. The Jacobi identity therefore holds for all
//! triples if it holds for the triples that begin with a generator.

use crate::algebra::SparseBracket;
use crate::algebra::structure::reduction::{ModularAlgebra, PseudoRandom};
use affinor_tensors::linear::modular::PRIMES;
use affinor_tensors::{Down, Scalar, Tensor, Up};
use nalgebra::{DMatrix, Dyn};
use std::collections::BTreeMap;

/// The largest dimension at which generators are searched in a dense basis. The time of the search
/// grows with the cube of the dimension.
const LARGEST_DENSE: usize = 600;
/// The smallest dimension at which generators are searched in a dense basis. In lower dimensions,
/// generators save few triples.
const SMALLEST_DENSE: usize = 24;
/// The largest dimension at which all constants are stored as a dense table of floats. Memory
/// limits this dimension.
const LARGEST_IN_FLOATS: usize = 200;
/// A table is multiplied as a dense matrix if at least one in `FILLED` constants is nonzero.
const FILLED: usize = 8;
/// The numbers of generators that are tried. Each generator is a random combination of the basis.
const COMBINATIONS: [usize; 3] = [2, 3, 5];

/// The matrices `a^i_jk` of `[x_j, .]`, `[x_j, e_k] = a^i_jk e_i`, for generators `x_j`, which are
/// fewer than the basis vectors. Returns `None` if the constants are not short rational numbers, or
/// if no generators are found.
pub(super) fn matrices_of_generators<S: Scalar>(structure: &Tensor<S>) -> Option<Tensor<S>> {
    let n = structure.dimension();
    let values: Vec<&S> = structure.components().map(|(_, value)| value).collect();
    let (integers, denominator) = S::clear_denominators(values.into_iter())?;
    let places = structure.components().map(|(at, _)| at);
    let constants = places.zip(integers).map(|(at, value)| (at[1], at[2], at[0], value));
    let constants = SparseBracket::new(n, constants);
    let basis = among_the_basis(&constants);
    let among_basis = |j: usize| basis.binary_search(&j).is_ok();
    let few = 2 * basis.len() <= n;
    // two random combinations have full matrices, 2 n^2 entries together; basis vectors are better
    // if their matrices have fewer
    let short = structure.components().filter(|(at, _)| among_basis(at[1])).count() <= 2 * n * n;
    let dense = (SMALLEST_DENSE..=LARGEST_DENSE).contains(&n) && structure.len() >= n * n;
    if dense
        && !(few && short)
        && let Some(components) = combinations(&constants)
    {
        let components = components
            .into_iter()
            .map(|([i, j, k], value)| Some(([i, j, k], S::from_quotient(value, denominator)?)));
        let components = components.collect::<Option<Vec<_>>>()?;
        return Tensor::from_components(n, &[Up, Down, Down], components).ok();
    }
    let chosen = structure.components().filter(|(at, _)| among_basis(at[1]));
    let chosen = chosen.map(|(at, value)| (at, value.clone()));
    few.then(|| Tensor::from_components(n, &[Up, Down, Down], chosen).ok()).flatten()
}

/// Whether `[x_j, .]` is a derivation for all `x_j`. The matrices `A` of the `x_j` must satisfy
/// `A ad_y - ad_y A = ad_(A y)` for each basis vector `y`. Returns `None` if few constants are
/// nonzero, or if the constants are not short rational numbers.
///
/// Matrix products of integers are exact in floats as long as no sum exceeds 2^53.
pub(super) fn are_dense_derivations<S: Scalar>(
    structure: &Tensor<S>,
    matrices: &Tensor<S>,
) -> Option<bool> {
    let n = structure.dimension();
    if !(SMALLEST_DENSE..=LARGEST_IN_FLOATS).contains(&n) || FILLED * structure.len() < n * n * n {
        return None;
    }
    // for each j, the integer entries a^i_jk of its matrix, at [i, k]
    let numbers = |tensor: &Tensor<S>| {
        let values: Vec<&S> = tensor.components().map(|(_, value)| value).collect();
        let (integers, _) = S::clear_denominators(values.into_iter())?;
        let largest = integers.iter().map(|value| value.unsigned_abs()).max()?;
        let mut found = BTreeMap::new();
        for ((at, _), value) in tensor.components().zip(integers) {
            let matrix = found.entry(at[1]).or_insert_with(|| DMatrix::<f64>::zeros(n, n));
            matrix[(at[0], at[2])] = value as f64;
        }
        Some((found, largest))
    };
    let ((ads, size), (generators, other)) = (numbers(structure)?, numbers(matrices)?);
    let sums = size.checked_mul(other)?.checked_mul(3 * n as u64)?;
    if sums >= 1 << 53 {
        return None;
    }
    let mut all = DMatrix::zeros(n * n, n);
    ads.iter().for_each(|(k, ad)| all.column_mut(*k).copy_from_slice(ad.as_slice()));
    Some(generators.values().all(|a| {
        let images = &all * a;
        (0..n).all(|k| {
            let mut rest = images.column(k).clone_owned().reshape_generic(Dyn(n), Dyn(n));
            if let Some(ad) = ads.get(&k) {
                rest.gemm(1.0, ad, a, 1.0);
                rest.gemm(-1.0, a, ad, 1.0);
            }
            rest.iter().all(|entry| *entry == 0.0)
        })
    }))
}

/// Basis vectors that generate the algebra, in ascending order. The search follows only brackets
/// that yield one new basis vector.
fn among_the_basis(constants: &SparseBracket<i64>) -> Vec<usize> {
    let n = constants.dimension();
    let mut known = vec![false; n];
    let mut generators = vec![];
    for first in 0..n {
        if known[first] {
            continue;
        }
        generators.push(first);
        known[first] = true;
        let mut open = vec![first];
        while let Some(j) = open.pop() {
            for image in constants.of(j).chunk_by(|a, b| a.0 == b.0) {
                let mut new = image.iter().filter(|(_, i, _)| !known[*i]);
                if let (true, Some(&(_, i, _)), None) = (known[image[0].0], new.next(), new.next())
                {
                    known[i] = true;
                    open.push(i);
                }
            }
        }
    }
    generators
}

/// The components `([i, j, k], v)` of `[x_j, e_k]` for a few combinations `x_j` of the basis that
/// generate the algebra modulo a prime. These combinations also generate the algebra over the
/// rationals, because vectors with independent residues are independent.
fn combinations(constants: &SparseBracket<i64>) -> Option<Vec<([usize; 3], i64)>> {
    let (n, prime) = (constants.dimension(), PRIMES[0]);
    let reduction = ModularAlgebra::of_integers(prime, constants)?;
    let small = |residue: u64| (residue % 5) as i64 - 2;
    let found = COMBINATIONS.into_iter().find_map(|count| {
        let mut draw = PseudoRandom::new(count as u64);
        let vectors = (0..count).map(|_| draw.vector(prime, n).into_iter().map(small).collect());
        let vectors: Vec<Vec<i64>> = vectors.collect();
        let residues = vectors.iter().map(|x| x.iter().map(|&v| prime.integer(v)).collect());
        reduction.generates(&residues.collect::<Vec<_>>()).then_some(vectors)
    })?;
    let mut components = vec![];
    for (j, x) in found.iter().enumerate() {
        let mut image = vec![0i64; n * n];
        for (j, &factor) in x.iter().enumerate().filter(|(_, factor)| **factor != 0) {
            for &(k, i, value) in constants.of(j) {
                let sum = value.checked_mul(factor).and_then(|v| v.checked_add(image[k * n + i]));
                image[k * n + i] = sum?;
            }
        }
        let nonzero = image.into_iter().enumerate().filter(|(_, value)| *value != 0);
        components.extend(nonzero.map(|(at, value)| ([at % n, j, at / n], value)));
    }
    Some(components)
}
