//! Small square matrices, such as an inertia, whose rows are vectors of the group.

use crate::group::Coordinates;
use affinor_tensors::Tensor;

/// A square matrix, whose rows are vectors of the type `V`.
#[derive(Clone, Debug)]
pub(in crate::mechanics) enum Matrix<V> {
    Diagonal(V),
    Full(Vec<V>),
}

impl<V: Coordinates> Matrix<V> {
    /// The matrix with the components `b_ij` of a tensor of rank 2.
    pub(in crate::mechanics) fn new(tensor: &Tensor<f64>) -> Self {
        let n = tensor.dimension();
        let mut rows = vec![vec![0.0; n]; n];
        tensor.components().for_each(|(at, value)| rows[at[0]][at[1]] = *value);
        if tensor.components().all(|(at, _)| at[0] == at[1]) {
            return Matrix::Diagonal(V::from_fn(n, |i| rows[i][i]));
        }
        Matrix::Full(rows.iter().map(|row| V::from_components(row)).collect())
    }

    /// The product `b_ij x^j`.
    #[inline(always)]
    pub(in crate::mechanics) fn apply(&self, x: &V) -> V {
        match self {
            Matrix::Diagonal(b) => {
                let (b, x) = (b.components(), x.components());
                V::from_fn(x.len(), |i| b[i] * x[i])
            }
            Matrix::Full(rows) => product(rows, x),
        }
    }

    /// The entry `b_ij`.
    #[inline(always)]
    pub(in crate::mechanics) fn entry(&self, i: usize, j: usize) -> f64 {
        match self {
            Matrix::Diagonal(b) if i == j => b.components()[i],
            Matrix::Diagonal(_) => 0.0,
            Matrix::Full(rows) => rows[i].components()[j],
        }
    }
}

fn product<V: Coordinates>(rows: &[V], x: &V) -> V {
    let x = x.components();
    let product = |row: &V| row.components().iter().zip(x).map(|(b, x)| b * x).sum();
    V::from_fn(x.len(), |i| product(&rows[i]))
}
