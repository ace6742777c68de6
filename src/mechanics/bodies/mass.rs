//! Mass, centre and inertia of bodies.

pub mod mesh;
mod shapes;

pub use mesh::Mesh;

use super::Inertia;
use super::inertia::{asymmetry, require_physical};
use crate::mechanics::invalid_inertia;
use crate::{Error, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3};
use std::ops::Add;

/// If the ratio of a principal moment to the largest moment is below this value, the moment counts
/// as rounding error.
const ROUNDING: f64 = 1e-14;

/// The mass properties of a body: mass, centre of mass, and second moments about the centre.
///
/// The inertia, equation (12), is linear in the second moments `S = int X X^T dm`:
///
/// ```text
/// J = int ((X.X) I - X X^T) dm = tr(S) I - S,     S = tr(J)/2 I - J
/// ```
///
/// If all masses are positive, `S` is positive semidefinite. The principal moments then satisfy
/// `J_1 <= J_2 + J_3`, and so on cyclically. Shapes have density 1;
/// [`of_density`](Self::of_density) and [`of_mass`](Self::of_mass) scale them.
///
/// ```
/// use affinor::mechanics::MassProperties;
/// use nalgebra::{Isometry3, Vector3};
/// // a hammer: a head of steel across the end of a handle of wood
/// let head = MassProperties::cuboid(&Vector3::new(0.12, 0.03, 0.03))?.of_density(7850.0)?;
/// let handle = MassProperties::cylinder(0.015, 0.3)?.of_density(700.0)?;
/// let hammer = handle + head.moved(&Isometry3::translation(0.0, 0.0, 0.165));
/// assert!(hammer.centre().z > 0.12);
/// let (about_centre, about_end) = (hammer.inertia()?, hammer.inertia_about(&-Vector3::z())?);
/// assert!(about_centre.is_physical() && about_end.principal_moments().max() > about_centre.principal_moments().max());
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("centre of mass", "rigid body", "inertia tensor"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    mass: f64,
    centre: Vector3<f64>,
    second: Matrix3<f64>,
}

impl MassProperties {
    /// A body with this mass, this centre of mass, and this inertia about the centre.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the mass is not positive, if the matrix is not symmetric, or if the
    /// moments violate the triangle inequality; [`Error::Overflow`] for numbers that are not
    /// finite.
    pub fn new(mass: f64, centre: Vector3<f64>, inertia: &Matrix3<f64>) -> Result<Self, Error> {
        if mass <= 0.0 {
            return Err(invalid_inertia(format!("the mass is {mass}, which is not positive")));
        }
        if let Some(off) = asymmetry(inertia) {
            return Err(invalid_inertia(format!(
                "the matrix is not symmetric: entries differ by {off}"
            )));
        }
        let inertia = (inertia + inertia.transpose()) * 0.5;
        let second = Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
        Self::of_moments(mass, centre, second)?.checked(inertia.norm())
    }

    /// A body of positive masses with these second moments about the centre.
    fn of_moments(mass: f64, centre: Vector3<f64>, second: Matrix3<f64>) -> Result<Self, Error> {
        let numbers = [("the mass", mass), ("the centre", centre.sum()), ("S", second.sum())];
        match numbers.iter().find(|(_, value)| !value.is_finite()) {
            Some((what, value)) => {
                Err(Error::Overflow { component: (*what).into(), value: value.to_string() })
            }
            None => Ok(MassProperties { mass, centre, second }),
        }
    }

    /// Checks the triangle inequality of the principal moments, up to the rounding errors of
    /// numbers of this `size`.
    fn checked(self, size: f64) -> Result<Self, Error> {
        require_physical(&self.inertia_matrix().symmetric_eigenvalues(), size)?;
        Ok(self)
    }

    /// The mass.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The centre of mass.
    pub fn centre(&self) -> &Vector3<f64> {
        &self.centre
    }

    /// The matrix of the inertia `J`, equation (12), about the centre. The matrix is singular if
    /// all masses are on a line.
    pub fn inertia_matrix(&self) -> Matrix3<f64> {
        rotational(&self.second)
    }

    /// The inertia matrix about a point, computed by the parallel axis theorem:
    /// `J_c + m ((d.d) I - d d^T)`. Here `J_c` is the inertia matrix about the centre of mass, and
    /// `d` is the vector from the point to the centre.
    pub fn inertia_matrix_about(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let d = self.centre - point;
        rotational(&(self.second + d * d.transpose() * self.mass))
    }

    /// The inertia about the centre, with its principal axes.
    ///
    /// # Errors
    /// [`Error::Invalid`] if all masses are on a line.
    pub fn inertia(&self) -> Result<Inertia, Error> {
        rigid(&self.inertia_matrix())
    }

    /// The inertia about a point, such as the fixed point of a top.
    ///
    /// # Errors
    /// [`Error::Invalid`] if all masses are on a line through the point.
    pub fn inertia_about(&self, point: &Vector3<f64>) -> Result<Inertia, Error> {
        rigid(&self.inertia_matrix_about(point))
    }

    /// The metric on se(3) of a body that moves freely, in the basis of [`Se3`](crate::group::Se3).
    /// The square of the velocity `(Omega, v)` of the body frame is twice the kinetic energy. If
    /// `J` is the inertia about the origin of the body frame, and the centre is at `c`,
    ///
    /// ```text
    /// G = [[J, m spin(c)], [-m spin(c), m I]]
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] if all masses are on a line.
    pub fn metric(&self) -> Result<Metric<f64>, Error> {
        self.inertia()?;
        let g = self.twist_inertia();
        let labels = (1..=6).map(|i| format!("e{i}"));
        Metric::new(labels, Tensor::from_fn(6, [Down, Down], |[i, j]| g[(i, j)])?)
    }

    /// The matrix `G` of the [`metric`](Self::metric), which maps the twist of the body frame to
    /// the momentum. It is singular if all masses are on a line.
    ///
    /// ```
    /// use affinor::mechanics::MassProperties;
    /// use nalgebra::{Isometry3, Vector6};
    /// let rod = MassProperties::rod(2.0)?.of_mass(3.0)?; // along the third axis
    /// let rod = rod.moved(&Isometry3::translation(0.0, 0.0, 1.0));
    /// // a rotation about the end of the rod: m l^2/3, and the momentum of the centre
    /// let momentum = rod.twist_inertia() * Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    /// assert!((momentum - Vector6::new(4.0, 0.0, 0.0, 0.0, -3.0, 0.0)).norm() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn twist_inertia(&self) -> Matrix6<f64> {
        let mixed = self.centre.cross_matrix() * self.mass;
        let mut g = Matrix6::from_diagonal_element(self.mass);
        g.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.inertia_matrix_about(&Vector3::zeros()));
        g.fixed_view_mut::<3, 3>(0, 3).copy_from(&mixed);
        g.fixed_view_mut::<3, 3>(3, 0).copy_from(&mixed.transpose());
        g
    }

    /// The body after a rigid motion: `c' = R c + t`, `J' = R J R^T`.
    #[must_use]
    pub fn moved(&self, motion: &Isometry3<f64>) -> Self {
        let turn = motion.rotation.to_rotation_matrix();
        let second = turn * self.second * turn.transpose();
        let centre = (motion * nalgebra::Point3::from(self.centre)).coords;
        MassProperties { centre, second: (second + second.transpose()) * 0.5, ..*self }
    }

    /// The same shape with another density.
    ///
    /// # Errors
    /// [`Error::Invalid`] unless the factor is positive; [`Error::Overflow`].
    pub fn of_density(&self, density: f64) -> Result<Self, Error> {
        let factor = positive("the density", density)?;
        Self::of_moments(self.mass * factor, self.centre, self.second * factor)
    }

    /// The same shape with another mass.
    ///
    /// # Errors
    /// The errors of [`of_density`](Self::of_density).
    pub fn of_mass(&self, mass: f64) -> Result<Self, Error> {
        self.of_density(positive("the mass", mass)? / self.mass)
    }

    /// The body without a part, such as a hole.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the rest is not a body of positive masses.
    pub fn subtract(&self, part: &Self) -> Result<Self, Error> {
        let left = self.joined(part, -1.0);
        positive("the remaining mass", left.mass)?;
        let about = part.inertia_matrix_about(&self.centre);
        let size = self.inertia_matrix().norm() + about.norm();
        Self::of_moments(left.mass, left.centre, left.second)?.checked(size)
    }

    /// The sum of this body and `sign` times the other body.
    fn joined(&self, other: &Self, sign: f64) -> Self {
        let part = sign * other.mass;
        let mass = self.mass + part;
        let (share, d) = (part / mass, other.centre - self.centre);
        let second = self.second + other.second * sign + d * d.transpose() * (self.mass * share);
        MassProperties { mass, centre: self.centre + d * share, second }
    }
}

/// The sum of two bodies is their union.
impl Add for MassProperties {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.joined(&other, 1.0)
    }
}

/// The inertia of a body. The masses must not be on a line.
fn rigid(matrix: &Matrix3<f64>) -> Result<Inertia, Error> {
    let inertia = Inertia::new(matrix)?;
    let (least, largest) = (inertia.principal_moments().min(), inertia.principal_moments().max());
    if least > ROUNDING * largest {
        return Ok(inertia);
    }
    Err(invalid_inertia(format!(
        "the masses are on a line: the smallest moment is {least}, the largest {largest}"
    )))
}

/// The inertia matrix `tr(S) I - S`.
fn rotational(second: &Matrix3<f64>) -> Matrix3<f64> {
    // computes the diagonal without terms that cancel
    let [x, y, z] = [second.m11, second.m22, second.m33];
    Matrix3::from_diagonal(&Vector3::new(y + z, z + x, x + y))
        - (second - Matrix3::from_diagonal(&second.diagonal()))
}

/// Checks that a number is positive and finite.
fn positive(what: &str, value: f64) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(invalid_inertia(format!("{what} is {value}, which is not positive and finite")))
}
