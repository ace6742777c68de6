//! The linear algebras sl(n) and gl(n), and the affine algebras aff(n).

use super::{Entry, Family, Reader, at, numbered, pairs};

/// The family sl(n).
pub(super) const SPECIAL: Family = Family {
    pattern: "sl(n)",
    needs: "n >= 2",
    summary: "real n x n matrices without trace; basis E_ij for i < j, then E_ji in the same \
              order, then H_k = E_kk - E_k+1,k+1",
    example: "sl(2)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| n[0].saturating_mul(n[0]) - 1),
        build: |name, n| special(name, n[0]),
    },
};

/// The family gl(n).
pub(super) const GENERAL: Family = Family {
    pattern: "gl(n)",
    needs: "n >= 1",
    summary: "all real n x n matrices; basis E_ij row by row",
    example: "gl(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_mul(n[0])),
        build: |name, n| general(name, n[0]),
    },
};

/// The family aff(n), as matrices of size n + 1 with a last row of zeros.
pub(super) const AFFINE: Family = Family {
    pattern: "aff(n)",
    needs: "n >= 1",
    summary: "affine maps of R^n, not unimodular; basis E_ij row by row, then the translations \
              p1..pn = E_i,n+1: [E_ij,p_j] = p_i; of the line x = E_11, y = p1: [x,y] = y",
    example: "aff(1)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_mul(n[0].saturating_add(1))),
        build: |name, n| affine(name, n[0]),
    },
};

pub(super) fn special(name: String, n: usize) -> Entry {
    let places: Vec<_> = pairs(n).chain(pairs(n).map(|(i, j)| (j, i))).collect();
    let mut labels: Vec<_> = places.iter().map(|&place| at("E", place, n)).collect();
    labels.extend(numbered("H", n - 1));
    let off_diagonal = places.into_iter().map(|(i, j)| vec![(i, j, 1)]);
    let diagonal = (1..n).map(|k| vec![(k - 1, k - 1, 1), (k, k, -1)]);
    Entry::of_integer_matrices(name, labels, n, off_diagonal.chain(diagonal))
}

fn affine(name: String, n: usize) -> Entry {
    let places = (0..n * n).map(|place| (place / n, place % n));
    let labels = match n {
        1 => ["x", "y"].map(String::from).to_vec(),
        _ => places.clone().map(|place| at("E", place, n)).chain(numbered("p", n)).collect(),
    };
    let translations = (0..n).map(|i| (i, n));
    let matrices = places.chain(translations).map(|(i, j)| vec![(i, j, 1)]);
    Entry::of_integer_matrices(name, labels, n + 1, matrices)
}

fn general(name: String, n: usize) -> Entry {
    let places: Vec<_> = (0..n * n).map(|place| (place / n, place % n)).collect();
    let labels = places.iter().map(|&place| at("E", place, n)).collect();
    let matrices = places.into_iter().map(|(i, j)| vec![(i, j, 1)]);
    Entry::of_integer_matrices(name, labels, n, matrices)
}
