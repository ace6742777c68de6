//! Constraints on the element and on the velocity of a mechanical system.

use crate::group::LieGroup;
use nalgebra::{DMatrix, DVector};

/// Holonomic constraints `Phi(t, q) = 0`, and constraints `A(t, q) v = b(t, q)` that are affine in
/// the velocity. Steps panic if the number of constraints depends on the time or the element.
pub trait Constraint<G: LieGroup> {
    /// The values `Phi^a(t, q)` of the holonomic constraints.
    fn value(&self, time: f64, element: &G::Element) -> DVector<f64>;

    /// The gradient `B^a_i`, the derivative of `Phi^a(t, q exp(s e_i))` at `s = 0`, with one row for
    /// each holonomic constraint.
    fn gradient(&self, time: f64, element: &G::Element) -> DMatrix<f64>;

    /// The value and the gradient of the holonomic constraint `a`, counted from 0. By default, all
    /// constraints are evaluated.
    fn single(&self, time: f64, element: &G::Element, a: usize) -> (f64, DVector<f64>) {
        (self.value(time, element)[a], self.gradient(time, element).row(a).transpose())
    }

    /// The partial derivatives of `Phi^a` with respect to time. `None`, the default, means that the
    /// holonomic constraints do not depend on time.
    fn rate(&self, time: f64, element: &G::Element) -> Option<DVector<f64>> {
        let _ = (time, element);
        None
    }

    /// The second derivatives of `Phi^a(t + s, q exp(s v))` at `s = 0`. By default, the system
    /// computes them by difference quotients of the gradient and the rate.
    fn second_rate(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> Option<DVector<f64>> {
        let _ = (time, element, velocity);
        None
    }

    /// The matrix `A` and the vector `b` of the constraints `A v = b`. By default, there are no such
    /// constraints, and the result is `None`.
    fn affine(&self, time: f64, element: &G::Element) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let _ = (time, element);
        None
    }

    /// The derivatives of `A(t + s, q exp(s v)) v - b(t + s, q exp(s v))` at `s = 0`. They are used
    /// only if [`affine`](Self::affine) returns constraints. By default they are zero, which is
    /// true for constant coefficients.
    fn affine_rate(&self, time: f64, element: &G::Element, velocity: &G::Vector) -> DVector<f64> {
        let _ = velocity;
        DVector::zeros(self.affine(time, element).map_or(0, |(_, right)| right.len()))
    }

    /// The matrix `A` if all constraints are `A v = 0` with constant coefficients, so that the
    /// constraints are left-invariant. The default is `None`.
    fn invariant(&self) -> Option<DMatrix<f64>> {
        None
    }
}

/// All constraints on the velocity, `rows v = right`: the time derivatives of the holonomic
/// constraints, followed by the constraints that are affine in the velocity.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::mechanics) struct VelocityConstraints {
    pub(in crate::mechanics) rows: DMatrix<f64>,
    pub(in crate::mechanics) right: DVector<f64>,
    /// The number of holonomic constraints.
    pub(in crate::mechanics) holonomic: usize,
}

impl VelocityConstraints {
    /// The constraints at a time and an element.
    pub(in crate::mechanics) fn at<G: LieGroup>(
        constraint: &impl Constraint<G>,
        time: f64,
        element: &G::Element,
    ) -> Self {
        let gradient = constraint.gradient(time, element);
        let holonomic = gradient.nrows();
        let rate = match constraint.rate(time, element) {
            Some(rate) => -rate,
            None => DVector::zeros(holonomic),
        };
        let Some((matrix, right)) = constraint.affine(time, element) else {
            return VelocityConstraints { rows: gradient, right: rate, holonomic };
        };
        let (count, columns) = (holonomic + matrix.nrows(), gradient.ncols());
        let rows = DMatrix::from_fn(count, columns, |a, i| {
            if a < holonomic { gradient[(a, i)] } else { matrix[(a - holonomic, i)] }
        });
        let right = DVector::from_iterator(count, rate.iter().chain(&right).copied());
        VelocityConstraints { rows, right, holonomic }
    }

    /// The difference `rows v - right`.
    pub(in crate::mechanics) fn residual(&self, velocity: &DVector<f64>) -> DVector<f64> {
        &self.rows * velocity - &self.right
    }
}
