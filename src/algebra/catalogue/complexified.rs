//! Complex matrix algebras, regarded as real algebras of twice the dimension.

use super::{Entry, Family, Reader, linear, orthogonal, symplectic};
use crate::MatrixBasis;
use crate::algebra::Complex;
use affinor_tensors::{Rational, Symbolic, Tolerance};

/// The family sl(n,C).
pub(super) const LINEAR: Family = Family {
    pattern: "sl(n,C)",
    needs: "n >= 2",
    summary: "complex n x n matrices without trace, as a real algebra; the basis of sl(n), then i times \
              it, labelled iE12..",
    example: "sl(2,C)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| n[0].saturating_mul(n[0]).saturating_mul(2) - 2),
        build: |name, n| complexified(name, linear::special(String::new(), n[0])),
    },
};

/// The family so(n,C).
pub(super) const ORTHOGONAL: Family = Family {
    pattern: "so(n,C)",
    needs: "n >= 2",
    summary: "complex rotations, as a real algebra; the basis of so(n), then i times it, labelled ie1..",
    example: "so(3,C)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| n[0].saturating_mul(n[0] - 1)),
        build: |name, n| complexified(name, orthogonal::build(String::new(), &vec![1; n[0]])),
    },
};

/// The family sp(2n,C).
pub(super) const SYMPLECTIC: Family = Family {
    pattern: "sp(2n,C)",
    needs: "an even number, at least 2",
    summary: "complex symplectic, as a real algebra; the basis of sp(2n), then i times it, labelled iA11..",
    example: "sp(4,C)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2 && n[0] % 2 == 0).then(|| n[0].saturating_mul(n[0] + 1)),
        build: |name, n| complexified(name, symplectic::build(String::new(), n[0] / 2)),
    },
};

/// The complex algebra in the basis `x` and `i x`: `[x, iy] = i[x,y]`, `[ix, iy] = -[x,y]`. The
/// matrices are the matrices of the real algebra, and their products with `i`.
fn complexified(name: String, real: Entry) -> Entry {
    let n = real.dimension();
    let imaginary = real.labels.iter().map(|label| format!("i{label}"));
    let labels: Vec<String> = real.labels.iter().cloned().chain(imaginary).collect();
    let matrices = real.matrices.as_ref().and_then(|basis| {
        let size = basis.matrices().first()?.rows();
        let entries = |i: bool| {
            let entry = move |value: &Rational| match i {
                true => Complex { re: Rational::from(0), im: value.clone() },
                false => Complex::real(value.clone()),
            };
            let matrices = basis.matrices().iter();
            matrices.map(move |m| m.entries().map(|(j, k, v)| (j, k, entry(v))).collect())
        };
        let matrices = entries(false).chain(entries(true)).collect();
        MatrixBasis::new(&labels, size, matrices, Tolerance::default()).ok()
    });
    let constants = real.constants.iter().flat_map(|(j, k, i, value): &(_, _, _, Symbolic)| {
        let (j, k, i) = (*j, *k, *i);
        [
            (j, k, i, value.clone()),
            (j, k + n, i + n, value.clone()),
            // [ix, y] = -[y, ix]
            (k, j + n, i + n, -value.clone()),
            (j + n, k + n, i, -value.clone()),
        ]
    });
    Entry { matrices, ..Entry::new(name, labels, constants) }
}
