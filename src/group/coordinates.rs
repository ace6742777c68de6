//! Components of vectors, of a size known to the compiler or not.

use nalgebra::{DVector, SVector};
use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

/// Components in a basis: what nalgebra's column vectors of floats are.
pub trait Coordinates:
    Clone
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
{
    /// From the list of components.
    ///
    /// # Panics
    /// If the size is fixed and the list is shorter.
    fn from_components(components: &[f64]) -> Self;

    /// From a function of the index, for a dimension; a fixed size wins over it.
    fn from_fn(dimension: usize, component: impl FnMut(usize) -> f64) -> Self;

    /// The list of components.
    fn components(&self) -> &[f64];
}

impl<const N: usize> Coordinates for SVector<f64, N> {
    fn from_components(components: &[f64]) -> Self {
        Self::from_column_slice(&components[..N])
    }

    fn from_fn(_: usize, mut component: impl FnMut(usize) -> f64) -> Self {
        SVector::from_fn(|i, _| component(i))
    }

    fn components(&self) -> &[f64] {
        self.as_slice()
    }
}

impl Coordinates for DVector<f64> {
    fn from_components(components: &[f64]) -> Self {
        Self::from_column_slice(components)
    }

    fn from_fn(dimension: usize, mut component: impl FnMut(usize) -> f64) -> Self {
        DVector::from_fn(dimension, |i, _| component(i))
    }

    fn components(&self) -> &[f64] {
        self.as_slice()
    }
}
