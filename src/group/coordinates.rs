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
    /// From a function of the index, for a dimension; a fixed size wins over it.
    fn from_fn(dimension: usize, component: impl FnMut(usize) -> f64) -> Self;

    /// The list of components.
    fn components(&self) -> &[f64];

    /// From the list of components.
    ///
    /// # Panics
    /// If the size is fixed and the list is shorter.
    #[inline]
    fn from_components(components: &[f64]) -> Self {
        Self::from_fn(components.len(), |i| components[i])
    }

    /// The zero vector of a dimension.
    #[inline]
    fn zeros(dimension: usize) -> Self {
        Self::from_fn(dimension, |_| 0.0)
    }

    /// The largest modulus of a component; NaN is not seen.
    #[inline]
    fn largest(&self) -> f64 {
        self.components().iter().fold(0.0, |most, x| x.abs().max(most))
    }

    /// Whether no component is infinite or NaN.
    #[inline]
    fn is_finite(&self) -> bool {
        self.components().iter().all(|x| x.is_finite())
    }
}

impl<const N: usize> Coordinates for SVector<f64, N> {
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
    #[inline]
    fn from_fn(dimension: usize, mut component: impl FnMut(usize) -> f64) -> Self {
        DVector::from_fn(dimension, |i, _| component(i))
    }

    #[inline]
    fn components(&self) -> &[f64] {
        self.as_slice()
    }
}
