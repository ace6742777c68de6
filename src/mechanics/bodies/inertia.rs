//! The inertia of a rigid body, and its state.

use crate::Error;
use crate::mechanics::invalid_inertia;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// The tolerance of the symmetry of a matrix, relative to the largest entry.
const SYMMETRIC: f64 = 1e-12;
/// The relative tolerance of the triangle inequality of the moments, which is an equality for flat
/// bodies.
const FLAT: f64 = 1e-12;

/// The attitude and the momentum of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// The attitude, which maps body components to spatial components.
    pub attitude: UnitQuaternion<f64>,
    /// The angular momentum `H = J Omega` (103), in body components.
    pub momentum: Vector3<f64>,
}

impl BodyState {
    /// The spatial angular momentum `R H`, which a free body conserves.
    pub fn space_momentum(&self) -> Vector3<f64> {
        self.attitude * self.momentum
    }
}

/// A symmetric, positive definite inertia with its principal axes.
///
/// ```
/// use affinor::mechanics::Inertia;
/// use nalgebra::{Matrix3, Vector3};
/// let inertia = Inertia::new(&Matrix3::new(2.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 2.5))?;
/// let mut moments: Vec<f64> = inertia.principal_moments().iter().copied().collect();
/// moments.sort_by(f64::total_cmp);
/// assert!((moments[0] - 1.0).abs() < 1e-15 && (moments[2] - 3.0).abs() < 1e-15);
/// assert!(inertia.is_physical());
/// assert!(!Inertia::diagonal(&Vector3::new(1.0, 1.0, 3.0))?.is_physical());
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("moments of inertia", "rigid body"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Inertia {
    moments: Vector3<f64>,
    /// The principal axes, as columns of a rotation matrix in body components.
    axes: Matrix3<f64>,
}

impl Inertia {
    /// The inertia with these principal moments. The principal axes are the axes of the body.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a moment that is not positive and finite.
    pub fn diagonal(moments: &Vector3<f64>) -> Result<Self, Error> {
        Self::principal(*moments, Matrix3::identity())
    }

    /// The inertia of a matrix, with its principal axes. If the matrix is diagonal, the principal
    /// axes are the axes of the body, in the same order.
    ///
    /// ```
    /// use affinor::mechanics::Inertia;
    /// use nalgebra::Matrix3;
    /// let matrix = Matrix3::new(2.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 5.0);
    /// let moments = *Inertia::new(&matrix)?.principal_moments();
    /// assert!((moments.min() - 1.0).abs() < 1e-14 && (moments.sum() - 9.0).abs() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for a matrix that is not symmetric to 12 digits, or not positive
    /// definite.
    #[doc(alias("inertia tensor"))]
    pub fn new(matrix: &Matrix3<f64>) -> Result<Self, Error> {
        let size = matrix.amax();
        if let Some(off) = asymmetry(matrix) {
            return Err(invalid_inertia(format!(
                "the matrix is not symmetric: entries differ by {off}"
            )));
        }
        let scaled = matrix / size;
        let symmetric = (scaled + scaled.transpose()) * 0.5;
        let diagonal = Matrix3::from_diagonal(&symmetric.diagonal());
        if symmetric == diagonal || size == 0.0 {
            return Self::diagonal(&matrix.diagonal());
        }
        let eigen = symmetric.symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(0).neg_mut();
        }
        Self::principal(eigen.eigenvalues * size, axes)
    }

    fn principal(moments: Vector3<f64>, axes: Matrix3<f64>) -> Result<Self, Error> {
        // rejects moments that are not normal, because the reciprocal of the moment must be finite
        // too
        match moments.iter().find(|moment| !(moment.is_normal() && **moment > 0.0)) {
            Some(moment) => Err(invalid_inertia(format!(
                "a principal moment is {moment}, but moments must be positive and finite"
            ))),
            None => Ok(Inertia { moments, axes }),
        }
    }

    /// The principal moments, in the order of the [`axes`](Self::axes).
    pub fn principal_moments(&self) -> &Vector3<f64> {
        &self.moments
    }

    /// The principal axes, as columns of a rotation matrix in body components.
    pub fn axes(&self) -> &Matrix3<f64> {
        &self.axes
    }

    /// The edges, up to a common factor, of the homogeneous box whose moments have these ratios:
    /// `a_i^2 = J_j + J_k - J_i`. An edge is 0 if no body has these moments.
    ///
    /// ```
    /// use affinor::mechanics::Inertia;
    /// use nalgebra::Vector3;
    /// // J_1 = m (b^2 + c^2)/12 of a box with the edges a, b, c = 1, 2, 3
    /// let body = Inertia::diagonal(&Vector3::new(13.0, 10.0, 5.0))?;
    /// assert!((body.box_edges() / body.box_edges()[0] - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-15);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn box_edges(&self) -> Vector3<f64> {
        let moments = self.principal_moments();
        Vector3::from_fn(|i, _| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            (moments[j] + moments[k] - moments[i]).max(0.0).sqrt()
        })
    }

    /// The inertia matrix in body components, `A diag(J_1, J_2, J_3) A^T`.
    pub fn matrix(&self) -> Matrix3<f64> {
        self.axes * Matrix3::from_diagonal(&self.moments) * self.axes.transpose()
    }

    /// The inertia of the same body, expressed in its principal axes.
    #[must_use]
    pub fn in_principal_axes(&self) -> Self {
        Inertia { moments: self.moments, axes: Matrix3::identity() }
    }

    /// Whether a body of positive masses can have this inertia, which means that no moment exceeds
    /// the sum of the others. Equations of motion do not require this condition.
    pub fn is_physical(&self) -> bool {
        self.require_physical().is_ok()
    }

    /// Checks to 12 digits that a body of positive masses can have this inertia:
    /// `J_1 <= J_2 + J_3`, and so on cyclically.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the moments.
    pub fn require_physical(&self) -> Result<(), Error> {
        require_physical(&self.moments, self.moments.max())
    }

    /// The momentum `H = J Omega` (103) of a velocity, in the body frame.
    ///
    /// ```
    /// use affinor::mechanics::Inertia;
    /// use nalgebra::Vector3;
    /// let body = Inertia::diagonal(&Vector3::new(1.0, 2.0, 3.0))?;
    /// assert_eq!(body.momentum(&Vector3::new(0.0, 0.0, 2.0)), Vector3::new(0.0, 0.0, 6.0));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("angular momentum"))]
    pub fn momentum(&self, velocity: &Vector3<f64>) -> Vector3<f64> {
        self.axes * (self.axes.tr_mul(velocity)).component_mul(&self.moments)
    }

    /// The velocity `Omega = J^-1 H` of a momentum, in the body frame.
    pub fn velocity(&self, momentum: &Vector3<f64>) -> Vector3<f64> {
        self.axes * (self.axes.tr_mul(momentum)).component_div(&self.moments)
    }

    /// The kinetic energy `H . J^-1 H/2`.
    ///
    /// ```
    /// use affinor::mechanics::Inertia;
    /// use nalgebra::Vector3;
    /// let body = Inertia::diagonal(&Vector3::new(1.0, 2.0, 3.0))?;
    /// assert!((body.energy(&Vector3::new(0.0, 0.0, 6.0)) - 6.0).abs() < 1e-15);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("kinetic energy"))]
    pub fn energy(&self, momentum: &Vector3<f64>) -> f64 {
        0.5 * momentum.dot(&self.velocity(momentum))
    }
}

/// The asymmetry of a matrix, if it exceeds rounding errors. Returns NaN if an entry is not finite.
pub(super) fn asymmetry(matrix: &Matrix3<f64>) -> Option<f64> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Some(f64::NAN);
    }
    let off = (matrix - matrix.transpose()).amax();
    (off > SYMMETRIC * matrix.amax()).then_some(off)
}

/// Checks the triangle inequality of principal moments, up to the rounding errors of numbers of
/// this `size`.
///
/// # Errors
/// [`Error::Invalid`] with the moments.
pub(super) fn require_physical(moments: &Vector3<f64>, size: f64) -> Result<(), Error> {
    let mut ordered: [f64; 3] = (*moments).into();
    ordered.sort_by(f64::total_cmp);
    let [a, b, c] = ordered;
    if (c - b) - a <= FLAT * size {
        return Ok(());
    }
    Err(invalid_inertia(format!(
        "moments {a}, {b}, {c}: no body has these moments, because {c} > {a} + {b}"
    )))
}
