//! Brackets of vectors: structure constants by their first factor.

use super::subspace::collected;
use affinor_tensors::linear::Row;
use affinor_tensors::{Field, Scalar, Tensor};

/// The constants `(k, i, c^i_jk)` of each `j`, sorted.
#[derive(Clone, Debug)]
pub(super) struct Products<S> {
    by_first: Vec<Vec<(usize, usize, S)>>,
}

/// The matrix of `[x, .]`: the columns that are not zero, sorted.
pub(super) struct Ad<S>(Vec<(usize, Row<S>)>);

impl<S: Field + Scalar> Products<S> {
    pub fn new(structure: &Tensor<S>) -> Self {
        let mut by_first = vec![vec![]; structure.dimension()];
        for (at, value) in structure.components() {
            by_first[at[1]].push((at[2], at[0], value.clone()));
        }
        by_first.iter_mut().for_each(|line| line.sort_by_key(|&(k, i, _)| (k, i)));
        Products { by_first }
    }

    /// The constants `(k, i, c^i_jk)` of `[e_j, .]`.
    pub fn of(&self, j: usize) -> &[(usize, usize, S)] {
        &self.by_first[j]
    }

    /// The matrix of `[x, .]`.
    pub fn ad(&self, x: &[(usize, S)]) -> Ad<S> {
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
    /// `[x, e_k]`
    pub fn column(&self, k: usize) -> &[(usize, S)] {
        match self.0.binary_search_by_key(&k, |(k, _)| *k) {
            Ok(at) => &self.0[at].1,
            Err(_) => &[],
        }
    }

    /// The columns that are not zero.
    pub fn columns(&self) -> impl Iterator<Item = (usize, &Row<S>)> {
        self.0.iter().map(|(k, column)| (*k, column))
    }

    /// `[x, y]`
    pub fn image(&self, y: &[(usize, S)]) -> Row<S> {
        let terms = y.iter().flat_map(|(k, factor)| {
            self.column(*k).iter().map(move |(i, value)| (*i, value.clone() * factor))
        });
        collected(terms.collect())
    }
}
