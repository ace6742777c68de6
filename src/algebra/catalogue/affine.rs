//! The affine maps of the line.

use super::{Entry, Family, Reader};

/// aff(1): `x = E_11` scales and `y = E_12` translates.
pub(super) const FAMILY: Family = Family {
    pattern: "aff(n)",
    needs: "n = 1",
    summary: "affine maps of the line, not unimodular; basis x (scaling), y (translation): [x,y] = y",
    example: "aff(1)",
    head: "aff",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] == 1).then_some(2),
        build: |name, _| {
            let labels = ["x", "y"].map(String::from).to_vec();
            Entry::of_integer_matrices(name, labels, 2, [vec![(0, 0, 1)], vec![(0, 1, 1)]])
        },
    },
};
