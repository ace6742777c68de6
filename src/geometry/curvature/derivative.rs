//! The covariant derivatives of torsion and curvature.

use crate::geometry::connection::Connection;
use affinor_tensors::{Ring, Tensor};

impl<S: Ring> Connection<S> {
    /// The derivative of the torsion, slots `^i_mjk`: `(nabla_m tau)^i_jk`. Zero for the canonical
    /// connections of a group.
    pub fn nabla_torsion(&self) -> Tensor<S> {
        self.nabla(&self.torsion()).expect("the torsion belongs to the frame")
    }

    /// The derivative of the curvature, slots `^i_mjkl`: `(nabla_m R)^i_jkl`. Zero for a
    /// torsion-free connection exactly where the space is locally symmetric.
    pub fn nabla_curvature(&self) -> Tensor<S> {
        self.nabla(self.curvature()).expect("the curvature belongs to the frame")
    }
}
