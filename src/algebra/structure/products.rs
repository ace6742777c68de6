//! Brackets of vectors: structure constants by their first factor.

use super::subspace::collected;
use affinor_tensors::linear::Row;
use affinor_tensors::{Field, Tensor};

/// The constants `(k, i, c^i_jk)` of each `j`, sorted.
#[derive(Clone, Debug)]
pub(super) struct Products<S> {
    by_first: Vec<Vec<(usize, usize, S)>>,
}

/// The matrix of `[x, .]`: its columns.
pub(super) struct Ad<S>(Vec<Row<S>>);

impl<S: Field> Products<S> {
    pub fn new(structure: &Tensor<S>) -> Self {
        let mut by_first = vec![vec![]; structure.dimension()];
        for (at, value) in structure.components() {
            by_first[at[1]].push((at[2], at[0], value.clone()));
        }
        by_first.iter_mut().for_each(|line| line.sort_by_key(|&(k, i, _)| (k, i)));
        Products { by_first }
    }

    pub fn dimension(&self) -> usize {
        self.by_first.len()
    }

    /// The constants `(k, i, c^i_jk)` of `[e_j, .]`.
    pub fn of(&self, j: usize) -> &[(usize, usize, S)] {
        &self.by_first[j]
    }

    /// The matrix of `[x, .]`.
    pub fn ad(&self, x: &[(usize, S)]) -> Ad<S> {
        let mut columns = vec![vec![]; self.dimension()];
        for (j, factor) in x {
            for (k, i, value) in self.of(*j) {
                columns[*k].push((*i, value.clone() * factor));
            }
        }
        let collect = |terms| if x.len() > 1 { collected(terms) } else { terms };
        Ad(columns.into_iter().map(collect).collect())
    }
}

impl<S: Field> Ad<S> {
    /// `[x, e_k]`
    pub fn column(&self, k: usize) -> &Row<S> {
        &self.0[k]
    }

    /// The columns that are not zero.
    pub fn columns(&self) -> impl Iterator<Item = (usize, &Row<S>)> {
        self.0.iter().enumerate().filter(|(_, column)| !column.is_empty())
    }

    /// `[x, y]`
    pub fn image(&self, y: &[(usize, S)]) -> Row<S> {
        super::subspace::combination(&self.0, y)
    }
}
