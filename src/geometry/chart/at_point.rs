//! Frames at a point, in floats. The fields are given as closures, or they are the invariant fields
//! of any Lie algebra in canonical coordinates.

use super::canonical::invariant_forms;
use super::series::{Scaling, series};
use super::{CanonicalCoordinates, Side};
use crate::algebra::frame::Frame;
use crate::algebra::{BasisChange, LieAlgebra, to_matrix};
use crate::{Error, Law};
use affinor_tensors::linear::Matrix;
use affinor_tensors::text::combination;
use affinor_tensors::{Down, Jet, Tensor, Tolerance, Up};
use std::sync::Arc;

/// The coordinates of a point as jets.
fn jets(point: &[f64]) -> Vec<Jet> {
    let coordinate = |(a, value): (usize, &f64)| Jet::coordinate(*value, a, point.len());
    point.iter().enumerate().map(coordinate).collect()
}

impl LieAlgebra<f64> {
    /// The invariant forms `f^i = f^i_a dx^a` that are dual to the fields of
    /// [`Frame::canonical_at_point`]: `g^-1 dg` (left) or `dg g^-1` (right), slots `[Up, Down]`.
    /// For coordinates of the first kind, the matrix `f^i_a` is `T_left(x)` or `T_right(x)`. The
    /// forms exist even at points where the coordinates are singular.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Overflow`] for points too far from the identity.
    pub fn canonical_forms(
        &self,
        kind: CanonicalCoordinates,
        side: Side,
        point: &[f64],
    ) -> Result<Tensor<Jet>, Error> {
        let structure = self.structure_constants().map(|value| Jet::constant(*value));
        let forms = invariant_forms(&structure, &jets(point), kind, side, |function, ad, _| {
            let scaling = Scaling::of(&ad.map(Jet::value))?;
            series(function, &side.signed(ad), &scaling)
        })?;
        finite("f", &forms)?;
        Ok(forms)
    }
}

impl Frame<Jet> {
    /// The frame of the fields `e_i = e^a_i(x) d/dx^a` at a point. The function `fields(x, [a, i])`
    /// returns the component `e^a_i` at the coordinates `x`. It is differentiated automatically.
    ///
    /// Jets contain two derivatives, which are sufficient for the curvature (B14) of a metric.
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
    /// [`Error::Shape`] unless there are as many labels as coordinates; [`Error::SingularBasis`]
    /// for fields that are linearly dependent at the point.
    pub fn at_point(
        labels: impl IntoIterator<Item: AsRef<str>>,
        point: &[f64],
        fields: impl Fn(&[Jet], [usize; 2]) -> Jet,
    ) -> Result<Self, Error> {
        let n = point.len();
        let x = jets(point);
        let names: Vec<_> = (1..=n).map(|a| format!("d_{a}")).collect();
        let coordinates = Frame::holonomic(&names, Arc::new(|a, f: &Jet| f.derivative(a)))?;
        let matrix = Tensor::from_fn(n, [Up, Down], |at| fields(&x, at))?;
        coordinates.moved(labels, &BasisChange::new(matrix)?)
    }

    /// The invariant fields of any algebra at a point in canonical coordinates, with their
    /// derivatives. [`Chart::invariant_fields`](crate::Chart::invariant_fields) computes the closed
    /// form, if there is one. The series in `ad` are summed near zero, and the results are squared
    /// repeatedly.
    ///
    /// ```
    /// use affinor::geometry::chart::{CanonicalCoordinates, Side};
    /// use affinor::Frame;
    /// use affinor::algebra::catalogue;
    /// // so(3) in rotation vectors
    /// let so3 = catalogue::algebra("so(3)")?;
    /// let frame = Frame::canonical_at_point(&so3, CanonicalCoordinates::First, Side::Left, &[0.3, 2.0, -1.0])?;
    /// assert!((frame.structure_functions().get(&[2, 0, 1]).value() - 1.0).abs() < 1e-14);
    /// // the coordinates are singular at a full turn
    /// let turn = [std::f64::consts::TAU, 0.0, 0.0];
    /// assert!(Frame::canonical_at_point(&so3, CanonicalCoordinates::First, Side::Left, &turn).is_err());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Law::RegularPoint`] if the coordinates are singular up to rounding
    /// errors; [`Error::Overflow`] if numbers are out of range, or eigenvalues of `ad_x` exceed
    /// `2^20`.
    pub fn canonical_at_point(
        algebra: &LieAlgebra<f64>,
        kind: CanonicalCoordinates,
        side: Side,
        point: &[f64],
    ) -> Result<Self, Error> {
        let forms = algebra.canonical_forms(kind, side, point)?;
        if let Some(vector) = kernel(algebra, kind, side, point)? {
            return Err(Law::RegularPoint.broken([vector], "0"));
        }
        let fields = to_matrix(&forms).inverse().ok_or(Error::SingularBasis)?;
        let frame = Frame::at_point(algebra.labels(), point, |_, [a, i]| fields.get(a, i))?;
        finite("c", frame.structure_functions())?;
        Ok(frame)
    }
}

/// A vector on which all forms vanish up to rounding errors. The vector is computed in `f64` with a
/// tolerance, and not in jets.
fn kernel(
    algebra: &LieAlgebra<f64>,
    kind: CanonicalCoordinates,
    side: Side,
    point: &[f64],
) -> Result<Option<String>, Error> {
    let tolerance = std::cell::Cell::new(Tolerance::default());
    let forms = invariant_forms(
        algebra.structure_constants(),
        point,
        kind,
        side,
        |function, ad: &Matrix<f64>, _| {
            let scaling = Scaling::of(ad)?;
            tolerance.set(tolerance.get().weaker(scaling.tolerance));
            series(function, &side.signed(ad), &scaling)
        },
    )?;
    let kernel = to_matrix(&forms).with_tolerance(tolerance.get()).nullspace()?;
    let vector = || kernel.row(0).iter().map(|(a, value)| (*value, format!("d_{}", a + 1)));
    Ok((kernel.rows() > 0).then(|| combination(vector())))
}

fn finite(name: &str, tensor: &Tensor<Jet>) -> Result<(), Error> {
    match tensor.components().find(|(_, value)| !value.is_finite()) {
        None => Ok(()),
        Some((at, value)) => {
            let at: Vec<_> = at.iter().map(|index| (index + 1).to_string()).collect();
            let component = format!("{name}^{}_{}", at[0], at[1..].concat());
            Err(Error::Overflow { component, value: format!("{value} or its derivatives") })
        }
    }
}
