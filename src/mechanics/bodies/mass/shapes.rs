//! Bodies of simple shapes, with density 1, and point masses.

use super::{MassProperties, positive};
use crate::Error;
use crate::mechanics::invalid_inertia;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Shapes are centred at the origin; their axes are the coordinate axes.
impl MassProperties {
    /// A body that consists of point masses.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a mass is not positive, or if there are no masses;
    /// [`Error::Overflow`].
    pub fn points(masses: &[(f64, Vector3<f64>)]) -> Result<Self, Error> {
        let point = |(mass, place): &(f64, Vector3<f64>)| {
            Self::of_moments(positive("a mass", *mass)?, *place, Matrix3::zeros())
        };
        let Some((first, others)) = masses.split_first() else {
            return Err(invalid_inertia("there are no masses"));
        };
        let body = others
            .iter()
            .try_fold(point(first)?, |body, other| Ok::<_, Error>(body + point(other)?))?;
        Self::of_moments(body.mass, body.centre, body.second)
    }

    /// A box with these three edge lengths: `S = m diag(a^2, b^2, c^2)/12`.
    ///
    /// ```
    /// use affinor::mechanics::MassProperties;
    /// use nalgebra::Vector3;
    /// // m (b^2 + c^2)/12
    /// let brick = MassProperties::cuboid(&Vector3::new(1.0, 2.0, 3.0))?.of_mass(12.0)?;
    /// assert!((brick.inertia_matrix()[(0, 0)] - 13.0).abs() < 1e-13);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] if a length is not positive; [`Error::Overflow`].
    #[doc(alias("box", "brick"))]
    pub fn cuboid(edges: &Vector3<f64>) -> Result<Self, Error> {
        Self::shape(edges, 1.0, &(edges.component_mul(edges) / 12.0))
    }

    /// An ellipsoid with these three half axes: `S = m diag(a^2, b^2, c^2)/5`.
    ///
    /// # Errors
    /// The errors of [`cuboid`](Self::cuboid).
    pub fn ellipsoid(half_axes: &Vector3<f64>) -> Result<Self, Error> {
        Self::shape(half_axes, 4.0 / 3.0 * PI, &(half_axes.component_mul(half_axes) / 5.0))
    }

    /// A ball of density 1, centred at the origin.
    ///
    /// ```
    /// use affinor::mechanics::MassProperties;
    /// // 2/5 m r^2
    /// let ball = MassProperties::ball(1.0)?.of_mass(5.0)?;
    /// assert!((ball.inertia_matrix()[(0, 0)] - 2.0).abs() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`cuboid`](Self::cuboid).
    #[doc(alias("sphere"))]
    pub fn ball(radius: f64) -> Result<Self, Error> {
        Self::ellipsoid(&Vector3::repeat(radius))
    }

    /// A cylinder about the third axis: `S = m diag(r^2/4, r^2/4, h^2/12)`.
    ///
    /// ```
    /// use affinor::mechanics::MassProperties;
    /// // m r^2/2 about its axis
    /// let wheel = MassProperties::cylinder(1.0, 0.5)?.of_mass(4.0)?;
    /// assert!((wheel.inertia_matrix()[(2, 2)] - 2.0).abs() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`cuboid`](Self::cuboid).
    #[doc(alias("disk"))]
    pub fn cylinder(radius: f64, height: f64) -> Result<Self, Error> {
        let across = radius * radius / 4.0;
        let squares = Vector3::new(across, across, height * height / 12.0);
        Self::shape(&Vector3::new(radius, radius, height), PI, &squares)
    }

    /// A thin rod along the third axis, of linear density 1: `S = m diag(0, 0, l^2/12)`.
    ///
    /// # Errors
    /// The errors of [`cuboid`](Self::cuboid).
    pub fn rod(length: f64) -> Result<Self, Error> {
        let squares = Vector3::new(0.0, 0.0, length * length / 12.0);
        Self::shape(&Vector3::new(1.0, 1.0, length), 1.0, &squares)
    }

    /// A shape whose volume is `factor` times the product of the lengths. The parameter `squares`
    /// contains the mean squares of its coordinates.
    fn shape(lengths: &Vector3<f64>, factor: f64, squares: &Vector3<f64>) -> Result<Self, Error> {
        for length in lengths.iter() {
            positive("a length", *length)?;
        }
        let mass = factor * lengths.product();
        if mass == 0.0 {
            return Err(invalid_inertia("the volume is below the range of floats"));
        }
        Self::of_moments(mass, Vector3::zeros(), Matrix3::from_diagonal(&(squares * mass)))
    }
}
