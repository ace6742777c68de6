//! Brackets of sparse vectors.

use super::subspace::collected;
use crate::algebra::SparseBracket;
use affinor_tensors::linear::Row;
use affinor_tensors::{Field, Scalar};

/// The matrix of `[x, .]`, stored as its nonzero columns in order.
pub(super) struct Ad<S>(Vec<(usize, Row<S>)>);

impl<S: Field + Scalar> SparseBracket<S> {
    /// The matrix of `[x, .]`.
    pub(super) fn ad(&self, x: &[(usize, S)]) -> Ad<S> {
        let terms = x.iter().flat_map(|(j, factor)| {
            self.of(*j).iter().map(move |(k, i, value)| (*k, (*i, value.clone() * factor)))
        });
        let mut terms: Vec<(usize, (usize, S))> = terms.collect();
        if x.len() > 1 {
            terms.sort_by_key(|(k, (i, _))| (*k, *i));
        }
        let mut columns: Vec<(usize, Row<S>)> = vec![];
        for (k, entry) in terms {
            match columns.last_mut() {
                Some((last, column)) if *last == k => column.push(entry),
                _ => columns.push((k, vec![entry])),
            }
        }
        if x.len() > 1 {
            for (_, column) in &mut columns {
                *column = collected(std::mem::take(column));
            }
            columns.retain(|(_, column)| !column.is_empty());
        }
        Ad(columns)
    }
}

impl<S: Field + Scalar> Ad<S> {
    /// The column `[x, e_k]`.
    pub fn column(&self, k: usize) -> &[(usize, S)] {
        match self.0.binary_search_by_key(&k, |(k, _)| *k) {
            Ok(at) => &self.0[at].1,
            Err(_) => &[],
        }
    }

    /// The nonzero columns.
    pub fn columns(&self) -> impl Iterator<Item = (usize, &Row<S>)> {
        self.0.iter().map(|(k, column)| (*k, column))
    }

    /// The image `[x, y]`.
    pub fn image(&self, y: &[(usize, S)]) -> Row<S> {
        let terms = y.iter().flat_map(|(k, factor)| {
            self.column(*k).iter().map(move |(i, value)| (*i, value.clone() * factor))
        });
        collected(terms.collect())
    }
}
