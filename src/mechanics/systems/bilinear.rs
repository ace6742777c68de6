//! Bilinear maps with few nonzero coefficients.

use crate::group::Coordinates;
use affinor_tensors::Tensor;
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// The bilinear map `f_i = b_i^jk x_j y_k`, stored as its nonzero coefficients.
#[derive(Clone, Debug)]
pub(super) struct Bilinear {
    /// For each `i`, the list of indices `[j, k]`, each with its coefficient `b_i^jk`. The zero map
    /// has no rows.
    rows: Vec<Vec<([usize; 2], f64)>>,
}

impl Bilinear {
    /// The map with the coefficients `(i, [j, k], b_i^jk)`, on vectors of dimension `dimension`.
    pub(super) fn new(
        dimension: usize,
        coefficients: impl IntoIterator<Item = (usize, [usize; 2], f64)>,
    ) -> Self {
        let mut rows = vec![vec![]; dimension];
        for (i, at, value) in coefficients {
            rows[i].push((at, value));
        }
        Bilinear { rows: if rows.iter().all(Vec::is_empty) { vec![] } else { rows } }
    }

    /// The map `b^j_ki x^k y_j` of a velocity and a momentum, as in the equations of motion (104).
    pub(super) fn of_momentum(coefficients: &Tensor<f64>) -> Self {
        let terms = coefficients.components().map(|(at, value)| (at[2], [at[1], at[0]], *value));
        Self::new(coefficients.dimension(), terms)
    }

    /// The map `f_i = m^l_i b_l^jk x_j y_k` of a matrix `m^l_i` with rows `l` and columns `i`.
    pub(super) fn combined(&self, matrix: &DMatrix<f64>) -> Self {
        let mut sums: BTreeMap<(usize, [usize; 2]), f64> = BTreeMap::new();
        for i in 0..matrix.ncols() {
            for (l, row) in self.rows.iter().enumerate() {
                for (at, value) in row {
                    *sums.entry((i, *at)).or_default() += matrix[(l, i)] * value;
                }
            }
        }
        let terms = sums.into_iter().filter(|(_, value)| *value != 0.0);
        Self::new(matrix.ncols(), terms.map(|((i, at), value)| (i, at, value)))
    }

    #[inline]
    pub(super) fn is_zero(&self) -> bool {
        self.rows.is_empty()
    }

    /// The value `f` for two vectors or covectors, which are given by their components.
    #[inline]
    pub(super) fn apply<V: Coordinates>(&self, x: &V, y: &V) -> V {
        let (x, y) = (x.components(), y.components());
        if self.is_zero() {
            return V::zeros(x.len());
        }
        let term = |([j, k], value): &([usize; 2], f64)| value * x[*j] * y[*k];
        let row = |i: usize| self.rows[i].iter().map(term).sum();
        V::from_fn(x.len(), row)
    }

    /// The same map, stored in layers.
    pub(super) fn layers<V: Coordinates>(&self) -> Layers<V> {
        let layer = |at: usize| {
            let term = |i: usize| self.rows[i].get(at).copied().unwrap_or(([0, 0], 0.0));
            let values = V::from_fn(self.rows.len(), |i| term(i).1);
            ((0..self.rows.len()).map(|i| term(i).0).collect(), values)
        };
        let count = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        Layers { layers: (0..count).map(layer).collect() }
    }
}

/// A [`Bilinear`] map for vectors with few components, stored in layers. The first layer contains
/// the first term of each `f_i`, the second layer the second term, and so on. A processor computes
/// a layer in registers.
#[derive(Clone, Debug)]
pub(super) struct Layers<V> {
    /// The layers. Each layer has, for each `i`, the indices `[j, k]` and the coefficient.
    layers: Vec<(Vec<[usize; 2]>, V)>,
}

impl<V> Default for Layers<V> {
    /// The zero map.
    fn default() -> Self {
        Layers { layers: vec![] }
    }
}

impl<V: Coordinates> Layers<V> {
    #[inline]
    pub(super) fn is_zero(&self) -> bool {
        self.layers.is_empty()
    }

    /// The value `f` for two vectors or covectors, which are given by their components.
    #[inline]
    pub(super) fn apply(&self, x: &V, y: &V) -> V {
        let (x, y) = (x.components(), y.components());
        self.layers.iter().fold(V::zeros(x.len()), |sum, (at, values)| {
            let values = values.components();
            sum + V::from_fn(x.len(), |i| values[i] * x[at[i][0]] * y[at[i][1]])
        })
    }
}
