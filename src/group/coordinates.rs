//! Components of vectors. Their number is fixed at compile time or dynamic.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

/// Components in a basis: a column vector of nalgebra, whose size is fixed or dynamic.
pub trait Coordinates:
    Clone
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
{
    /// Square matrices that act on these vectors. Matrices have a fixed size if vectors have one.
    type Matrix: Clone + Debug + PartialEq;

    /// The matrix with these columns. If the size is fixed, `dimension` is ignored.
    fn matrix(dimension: usize, column: impl FnMut(usize) -> Self) -> Self::Matrix;

    /// The vector whose components are a function of the index. If the size is fixed, `dimension`
    /// is ignored.
    fn from_fn(dimension: usize, component: impl FnMut(usize) -> f64) -> Self;

    /// The list of components.
    fn components(&self) -> &[f64];

    /// The vector with these components.
    ///
    /// # Panics
    /// If the size is fixed and the list is too short.
    #[inline]
    fn from_components(components: &[f64]) -> Self {
        Self::from_fn(components.len(), |i| components[i])
    }

    /// The zero vector of a dimension.
    #[inline]
    fn zeros(dimension: usize) -> Self {
        Self::from_fn(dimension, |_| 0.0)
    }

    /// The largest absolute value of a component. NaN is ignored.
    #[inline]
    fn largest(&self) -> f64 {
        self.components().iter().fold(0.0, |most, x| if x.abs() > most { x.abs() } else { most })
    }

    /// Whether no component is infinite or NaN.
    #[inline]
    fn is_finite(&self) -> bool {
        // tests without branches: x * 0.0 is NaN if x is infinite or NaN, and zero otherwise
        self.components().iter().fold(0.0, |sum, x| sum + x * 0.0) == 0.0
    }
}

impl<const N: usize> Coordinates for SVector<f64, N> {
    type Matrix = SMatrix<f64, N, N>;

    #[inline]
    fn matrix(_: usize, mut column: impl FnMut(usize) -> Self) -> Self::Matrix {
        let mut matrix = Self::Matrix::zeros();
        (0..N).for_each(|k| matrix.set_column(k, &column(k)));
        matrix
    }

    #[inline]
    fn from_fn(_: usize, mut component: impl FnMut(usize) -> f64) -> Self {
        SVector::from_fn(|i, _| component(i))
    }

    #[inline]
    fn components(&self) -> &[f64] {
        self.as_slice()
    }
}

impl Coordinates for DVector<f64> {
    type Matrix = DMatrix<f64>;

    fn matrix(dimension: usize, column: impl FnMut(usize) -> Self) -> Self::Matrix {
        // passes the number of rows, which nalgebra needs even if there are no columns
        let columns: Vec<_> = (0..dimension).map(column).collect();
        DMatrix::from_fn(dimension, dimension, |i, k| columns[k][i])
    }

    #[inline]
    fn from_fn(dimension: usize, mut component: impl FnMut(usize) -> f64) -> Self {
        DVector::from_fn(dimension, |i, _| component(i))
    }

    #[inline]
    fn components(&self) -> &[f64] {
        self.as_slice()
    }
}
