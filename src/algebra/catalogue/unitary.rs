//! The special unitary algebras: anti-hermitian matrices without trace.

use super::{Entry, Family, Reader, numbered, pairs};
use crate::algebra::Complex;
use affinor_tensors::{Rational, Ring};

/// su(n). The last n - 1 matrices are simple coroots rather than Gell-Mann's orthogonal diagonal
/// matrices, whose normalisation has square roots from n = 3 on.
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
        build: |name, n| build(name, n[0]),
    },
};

fn build(name: String, n: usize) -> Entry {
    let half = Rational::from(1) / &Rational::from(2);
    let (zero, minus) = (Rational::from_i64(0), -half.clone());
    let real = |re: &Rational| Complex::real(re.clone());
    let imaginary = |im: &Rational| Complex { re: zero.clone(), im: im.clone() };
    let off_diagonal = pairs(n).flat_map(|(i, j)| {
        [
            vec![(i, j, imaginary(&minus)), (j, i, imaginary(&minus))],
            vec![(i, j, real(&minus)), (j, i, real(&half))],
        ]
    });
    let diagonal =
        (1..n).map(|k| vec![(k - 1, k - 1, imaginary(&minus)), (k, k, imaginary(&half))]);
    let matrices = off_diagonal.chain(diagonal).collect();
    Entry::of_matrices(name, numbered("e", n * n - 1), n, matrices)
}
