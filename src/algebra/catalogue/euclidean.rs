//! The Euclidean algebras: rotations of R^n, together with one or two copies of the translations.

use super::orthogonal::rotations;
use super::{Entry, Family, Reader, numbered, pair_count};

/// The family se(n), as matrices of size n + 1.
pub(super) const FAMILY: Family = Family {
    pattern: "se(n)",
    needs: "n >= 2",
    summary: "rigid motions of R^n; basis e1.. as in so(n), then the translations p1..pn = \
              E_i,n+1: se(3) has [e1,e2] = e3, [e1,p2] = p3",
    example: "se(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| pair_count(n[0].saturating_add(1))),
        build: |name, n| build(name, n[0]),
    },
};

/// The family se_2(n), as matrices of size n + 2.
pub(super) const EXTENDED: Family = Family {
    pattern: "se_2(n)",
    needs: "n >= 2",
    summary: "extended poses: rotations of R^n, velocities v1..vn, positions p1..pn; basis e1.. as in \
              so(n), then v and p: se_2(3) has [e1,v2] = v3, [e1,p2] = p3",
    example: "se_2(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| pair_count(n[0].saturating_add(1)).saturating_add(n[0])),
        build: |name, n| build_extended(name, n[0]),
    },
};

fn build_extended(name: String, n: usize) -> Entry {
    let labels = [numbered("e", pair_count(n)), numbered("v", n), numbered("p", n)].concat();
    let vectors = (n..n + 2).flat_map(|column| (0..n).map(move |i| vec![(i, column, 1)]));
    Entry::of_integer_matrices(name, labels, n + 2, rotations(&vec![1; n]).chain(vectors))
}

fn build(name: String, n: usize) -> Entry {
    let mut labels = numbered("e", pair_count(n));
    labels.extend(numbered("p", n));
    let signs = vec![1; n];
    let translations = (0..n).map(|i| vec![(i, n, 1)]);
    Entry::of_integer_matrices(name, labels, n + 1, rotations(&signs).chain(translations))
}
