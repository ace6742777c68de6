//! Frames at a point, in floats, from closures.

use crate::Error;
use crate::algebra::BasisChange;
use crate::algebra::frame::Frame;
use affinor_tensors::{Down, Jet, Tensor, Up};
use std::sync::Arc;

impl Frame<Jet> {
    /// The frame of the fields `e_i = e^a_i(x) d/dx^a` at a point: `fields(x, [a, i])` is the
    /// component `e^a_i` at the coordinates `x`, and is differentiated automatically.
    ///
    /// Jets carry two derivatives, which suffice for the curvature (B14) of a metric.
    ///
    /// ```
    /// use affinor::{Connection, Frame, Jet, Metric};
    /// // the paraboloid z = (x^2 + y^2)/2 at (1, 0), by an orthonormal frame: K = 1/(1 + r^2)^2
    /// let frame = Frame::at_point(["e1", "e2"], &[1.0, 0.0], |x, at| {
    ///     let r2 = x[0].clone() * &x[0] + &(x[1].clone() * &x[1]);
    ///     // (1 + x x^T)^(-1/2) = 1 - x x^T / (s (s + 1)) with s^2 = 1 + r^2
    ///     let s = (r2 + Jet::constant(1.0)).sqrt();
    ///     let one = Jet::constant(f64::from(at[0] == at[1]));
    ///     one - x[at[0]].clone() * &x[at[1]] / (s.clone() * &(s + Jet::constant(1.0)))
    /// })?;
    /// let metric = Metric::identity(2)?;
    /// let connection = Connection::levi_civita(&frame, &metric)?;
    /// assert!((connection.curvature().get(&[0, 1, 0, 1]).value() - 0.25).abs() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless there are as many labels as coordinates; [`Error::SingularBasis`] for
    /// fields that are dependent at the point.
    pub fn at_point(
        labels: impl IntoIterator<Item: AsRef<str>>,
        point: &[f64],
        fields: impl Fn(&[Jet], [usize; 2]) -> Jet,
    ) -> Result<Self, Error> {
        let n = point.len();
        let coordinate = |(a, value): (usize, &f64)| Jet::coordinate(*value, a, n);
        let x: Vec<Jet> = point.iter().enumerate().map(coordinate).collect();
        let names: Vec<_> = (1..=n).map(|a| format!("d_{a}")).collect();
        let coordinates = Frame::holonomic(&names, Arc::new(|a, f: &Jet| f.derivative(a)))?;
        let matrix = Tensor::from_fn(n, [Up, Down], |at| fields(&x, at))?;
        coordinates.moved(labels, &BasisChange::new(matrix)?)
    }
}
