//! The abelian algebras.

use super::{Entry, Family, Reader, numbered};

/// R^n.
pub(super) const FAMILY: Family = Family {
    pattern: "R^n",
    needs: "n >= 1",
    summary: "abelian; basis e1..en",
    example: "R^3",
    head: "R",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then_some(n[0]),
        build: |name, n| Entry::new(name, numbered("e", n[0]), []),
    },
};
