//! Sparse vectors, and sums of multiples of sparse vectors.

use crate::stop::checkpoint;
use crate::{Sum, Summable, Tolerance};

/// A sparse vector: its nonzero components `(index, value)`. Indices count from 0 and are
/// ascending.
pub type Row<S> = Vec<(usize, S)>;

/// The value of a sparse vector at an index; `None` if it is zero.
pub(super) fn at<S>(row: &[(usize, S)], index: usize) -> Option<&S> {
    let place = row.binary_search_by_key(&index, |(j, _)| *j).ok()?;
    Some(&row[place].1)
}

/// The sparse vector with these components, which may be in any order. Components with equal
/// indices are added.
pub(super) fn collect<S: Summable>(
    entries: impl IntoIterator<Item = (usize, S)>,
    tolerance: Tolerance,
) -> Row<S> {
    added(entries.into_iter().collect(), tolerance)
}

/// Builds the vector from a list. This function is compiled once for each scalar, and not for each
/// iterator.
fn added<S: Summable>(mut entries: Row<S>, tolerance: Tolerance) -> Row<S> {
    checkpoint();
    entries.sort_by_key(|(j, _)| *j);
    let sums = entries.chunk_by(|a, b| a.0 == b.0).map(|run| {
        let mut sum = S::Sum::term(&run[0].1);
        run[1..].iter().for_each(|(_, value)| sum.add_term(value));
        (run[0].0, sum)
    });
    finish(sums.collect(), tolerance)
}

/// Converts the components of a sparse vector to sums, to which more terms can be added.
pub(super) fn open<S: Summable>(row: &[(usize, S)]) -> Row<S::Sum> {
    row.iter().map(|(j, value)| (*j, S::Sum::term(value))).collect()
}

/// Converts a vector of sums to values. Values that count as zero are omitted.
pub(super) fn finish<S: Summable>(sums: Row<S::Sum>, tolerance: Tolerance) -> Row<S> {
    let value = |(j, sum): (usize, S::Sum)| Some((j, sum.finish(tolerance)?));
    sums.into_iter().filter_map(value).collect()
}

/// Computes `sums + factor * row`.
pub(super) fn add_multiple<S: Summable>(
    sums: Row<S::Sum>,
    factor: &S,
    row: &[(usize, S)],
) -> Row<S::Sum> {
    checkpoint();
    let mut total = Vec::with_capacity(sums.len() + row.len());
    let mut rest = row.iter().peekable();
    for (column, mut sum) in sums {
        while let Some((j, value)) = rest.next_if(|(j, _)| *j < column) {
            total.push((*j, S::Sum::product(factor, value)));
        }
        if let Some((_, value)) = rest.next_if(|(j, _)| *j == column) {
            sum.add_product(factor, value);
        }
        total.push((column, sum));
    }
    total.extend(rest.map(|(j, value)| (*j, S::Sum::product(factor, value))));
    total
}
