//! The orthogonal algebras: `A^T η + η A = 0`.

use super::{Entry, Family, Reader, numbered, pair_count, pairs};

/// The family so(n).
pub(super) const DEFINITE: Family = Family {
    pattern: "so(n)",
    needs: "n >= 2",
    summary: "rotations of R^n; basis e1.. = (-1)^(i+j) (E_ij - E_ji) for i < j, the last pair \
              (n-1,n) first: so(3) has e_k = spin(e_k), [e1,e2] = e3",
    example: "so(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| pair_count(n[0])),
        build: |name, n| build(name, &vec![1; n[0]]),
    },
};

/// The family so(p,q).
pub(super) const INDEFINITE: Family = Family {
    pattern: "so(p,q)",
    needs: "p, q >= 1",
    summary: "preserves eta = diag(1 (p times), -1 (q times)); basis e1.. = \
              (-1)^(i+j) (E_ij - eta_i eta_j E_ji) for i < j, the last pair (n-1,n) first, n = p + q",
    example: "so(3,1)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| (n[0] >= 1 && n[1] >= 1).then(|| pair_count(n[0].saturating_add(n[1]))),
        build: |name, n| build(name, &[vec![1; n[0]], vec![-1; n[1]]].concat()),
    },
};

/// The generators `(-1)^(i+j) (E_ij - η_i η_j E_ji)` for `i < j`, the last pair first.
pub(super) fn rotations(signs: &[i64]) -> impl Iterator<Item = Vec<(usize, usize, i64)>> {
    pairs(signs.len()).rev().map(|(i, j)| {
        let sign = if (i + j) % 2 == 0 { 1 } else { -1 };
        vec![(i, j, sign), (j, i, -sign * signs[i] * signs[j])]
    })
}

pub(super) fn build(name: String, signs: &[i64]) -> Entry {
    let n = signs.len();
    Entry::of_integer_matrices(name, numbered("e", pair_count(n)), n, rotations(signs))
}
