//! Solvable families: R^n and the Heisenberg algebras.

use super::{Entry, Family, Reader, numbered};

/// The family R^n.
pub(super) const ABELIAN: Family = Family {
    pattern: "R^n",
    needs: "n >= 1",
    summary: "abelian; basis e1..en",
    example: "R^3",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then_some(n[0]),
        build: |name, n| Entry::new(name, numbered("e", n[0]), []),
    },
};

/// The family heisenberg(2m+1), as upper triangular matrices of size m + 2.
pub(super) const HEISENBERG: Family = Family {
    pattern: "heisenberg(2m+1)",
    needs: "an odd number, at least 3",
    summary: "nilpotent, centre z; basis x1..xm, y1..ym, z: [x_i,y_i] = z",
    example: "heisenberg(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 3 && n[0] % 2 == 1).then_some(n[0]),
        build: |name, n| heisenberg(name, n[0] / 2),
    },
};

fn heisenberg(name: String, m: usize) -> Entry {
    let labels = [numbered("x", m), numbered("y", m), vec!["z".into()]].concat();
    let x = (1..=m).map(|i| vec![(0, i, 1)]);
    let y = (1..=m).map(|i| vec![(i, m + 1, 1)]);
    let z = [vec![(0, m + 1, 1)]];
    Entry::of_integer_matrices(name, labels, m + 2, x.chain(y).chain(z))
}
