//! The symplectic algebras: `M^T J + J M = 0` with `J = [[0, 1], [-1, 0]]`.

use super::{Entry, Family, Reader, at, pairs};

/// The family sp(2n) = sp(2n,R).
pub(super) const FAMILY: Family = Family {
    pattern: "sp(2n)",
    needs: "an even number, at least 2",
    summary: "sp(2n,R), the real matrices [[A, B], [C, -A^T]] with B and C symmetric; basis A_ij = \
              E_ij - E_n+j,n+i row by row, then B_ij = E_i,n+j + E_j,n+i for i < j and E_i,n+i for \
              i = j, row by row, then C_ij = B_ij^T",
    example: "sp(6)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2 && n[0] % 2 == 0).then(|| (n[0] / 2).saturating_mul(n[0] + 1)),
        build: |name, n| build(name, n[0] / 2),
    },
};

pub(super) fn build(name: String, n: usize) -> Entry {
    let all: Vec<_> = (0..n * n).map(|place| (place / n, place % n)).collect();
    let mut symmetric: Vec<_> = pairs(n).chain((0..n).map(|i| (i, i))).collect();
    symmetric.sort_unstable();

    let blocks = [("A", &all), ("B", &symmetric), ("C", &symmetric)];
    let labels = blocks
        .iter()
        .flat_map(|&(letter, places)| places.iter().map(move |&place| at(letter, place, n)));
    let labels = labels.collect();

    let a = all.iter().map(|&(i, j)| vec![(i, j, 1), (n + j, n + i, -1)]);
    let b = symmetric.iter().map(|&(i, j)| {
        let both = [(i, n + j, 1), (j, n + i, 1)];
        both[usize::from(i == j)..].to_vec()
    });
    let transposed = |entries: Vec<_>| entries.into_iter().map(|(i, j, v)| (j, i, v)).collect();
    let c = b.clone().map(transposed);
    Entry::of_integer_matrices(name, labels, 2 * n, a.chain(b).chain(c))
}
