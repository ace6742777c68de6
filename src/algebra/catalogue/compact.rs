//! The compact forms of the simple complex algebras.
//!
//! Let `e_a, f_a, h_k` be a Chevalley basis. The compact form is spanned by `u_a = e_a - f_a`,
//! `v_a = i (e_a + f_a)` and `w_k = i h_k`. These vectors are fixed points of the antilinear map
//! `e_a -> -f_a`, `h_k -> -h_k`.

use super::name::{Argument, rule};
use super::triangular::cartan_type;
use super::{CatalogueError, Entry, Family, MAX_DIMENSION, Reader, numbered};
use crate::algebra::SparseBracket;
use crate::algebra::roots::{RootSystem, chevalley_constants};
use std::collections::BTreeMap;

/// The family compact(X).
pub(super) const FAMILY: Family = Family {
    pattern: "compact(TYPE)",
    needs: "a TYPE such as G2 or E8",
    summary: "compact form of a simple algebra; basis u1.. = e_a - f_a, v1.. = i (e_a + f_a) for the positive roots, \
              w1.. = i h_k, of the Chevalley basis of the split form",
    example: "compact(G2)",
    reader: Reader::Words(read),
};

/// A Gaussian integer.
type Gaussian = (i64, i64);

fn times((a, b): Gaussian, (c, d): Gaussian) -> Gaussian {
    (a * c - b * d, a * d + b * c)
}

fn read(name: &str, arguments: &[Argument]) -> Result<Entry, CatalogueError> {
    let refused =
        || CatalogueError::NoSuchAlgebra { name: name.trim().to_string(), rule: rule(&[&FAMILY]) };
    let [argument] = arguments else { return Err(refused()) };
    let cartan_type = cartan_type(argument.text).ok_or_else(refused)?;
    if cartan_type.dimension() > MAX_DIMENSION {
        return Err(CatalogueError::TooLarge { name: name.trim().to_string() });
    }
    let roots = RootSystem::new(cartan_type);
    let (positive, rank) = (roots.positive_roots().len(), cartan_type.rank());
    let n = 2 * positive + rank;
    // the brackets [e_j, e_k] of the Chevalley basis, in both orders of j and k
    let constants = chevalley_constants(&roots).into_iter();
    let both = constants.flat_map(|(j, k, i, value)| [(j, k, i, value), (k, j, i, -value)]);
    let split = SparseBracket::new(n, both);
    let vector = |at: usize| -> Vec<(usize, Gaussian)> {
        match (at / positive, at % positive) {
            (0, root) => vec![(root, (1, 0)), (root + positive, (-1, 0))],
            (1, root) => vec![(root, (0, 1)), (root + positive, (0, 1))],
            _ => vec![(at, (0, 1))],
        }
    };
    let mut constants = vec![];
    for j in 0..n {
        for k in j + 1..n {
            let mut sum: BTreeMap<usize, Gaussian> = BTreeMap::new();
            for (x, a) in vector(j) {
                for (y, b) in vector(k) {
                    let (re, im) = times(a, b);
                    for (_, i, value) in split.of(x).iter().filter(|(k, ..)| *k == y) {
                        let entry = sum.entry(*i).or_default();
                        *entry = (entry.0 + re * value, entry.1 + im * value);
                    }
                }
            }
            for (i, (re, im)) in sum {
                if i < positive {
                    constants.extend([(j, k, i, re), (j, k, i + positive, im)]);
                } else if i >= 2 * positive {
                    constants.push((j, k, i, im));
                }
            }
        }
    }
    let labels = [numbered("u", positive), numbered("v", positive), numbered("w", rank)].concat();
    Ok(Entry::of_integers(format!("compact({cartan_type})"), labels, constants))
}
