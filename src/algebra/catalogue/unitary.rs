//! The special unitary algebras: anti-hermitian matrices without trace.

use super::{Entry, Family, Reader, numbered, pairs};
use crate::algebra::Complex;
use affinor_tensors::{Rational, Ring};

/// The family su(n). The last n - 1 matrices are simple coroots. Gell-Mann's orthogonal diagonal
/// matrices are not used, because their normalization contains square roots if n >= 3.
pub(super) const FAMILY: Family = Family {
    pattern: "su(n)",
    needs: "n >= 2",
    summary: "anti-hermitian, traceless; basis e1.. = -i/2 (E_ij + E_ji), -1/2 (E_ij - E_ji) for \
              each i < j, then -i/2 (E_kk - E_k+1,k+1): su(2) has [e1,e2] = e3; from su(3) on the \
              diagonal ones are not orthogonal (Gell-Mann's need square roots)",
    example: "su(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| n[0].saturating_mul(n[0]) - 1),
        build: |name, n| build(name, &vec![1; n[0]], false),
    },
};

/// The family su(p,q).
pub(super) const INDEFINITE: Family = Family {
    pattern: "su(p,q)",
    needs: "p, q >= 1",
    summary: "traceless, preserves the hermitian form eta = diag(1 (p times), -1 (q times)); basis e1.. = \
              -i/2 (E_ij + eta_i eta_j E_ji), -1/2 (E_ij - eta_i eta_j E_ji) for each i < j, then the \
              diagonal ones of su(p+q)",
    example: "su(2,1)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| {
            let m = n[0].saturating_add(n[1]);
            (n[0] >= 1 && n[1] >= 1).then(|| m.saturating_mul(m) - 1)
        },
        build: |name, n| build(name, &[vec![1; n[0]], vec![-1; n[1]]].concat(), false),
    },
};

/// The family u(n).
pub(super) const FULL: Family = Family {
    pattern: "u(n)",
    needs: "n >= 1",
    summary: "anti-hermitian; basis e1.. of su(n), then z = -i/2 times the identity",
    example: "u(2)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_mul(n[0])),
        build: |name, n| build(name, &vec![1; n[0]], true),
    },
};

fn build(name: String, signs: &[i64], full: bool) -> Entry {
    let n = signs.len();
    let half = Rational::from(1) / &Rational::from(2);
    let (zero, minus) = (Rational::from_i64(0), -half.clone());
    let real = |re: &Rational| Complex::real(re.clone());
    let imaginary = |im: &Rational| Complex { re: zero.clone(), im: im.clone() };
    let off_diagonal = pairs(n).flat_map(|(i, j)| {
        let (same, other) = if signs[i] == signs[j] { (&minus, &half) } else { (&half, &minus) };
        [
            vec![(i, j, imaginary(&minus)), (j, i, imaginary(same))],
            vec![(i, j, real(&minus)), (j, i, real(other))],
        ]
    });
    let diagonal =
        (1..n).map(|k| vec![(k - 1, k - 1, imaginary(&minus)), (k, k, imaginary(&half))]);
    let centre = full.then(|| (0..n).map(|k| (k, k, imaginary(&minus))).collect());
    let mut labels = numbered("e", n * n - 1);
    labels.extend(full.then(|| "z".to_string()));
    let matrices = off_diagonal.chain(diagonal).chain(centre).collect();
    Entry::of_matrices(name, labels, n, matrices)
}
