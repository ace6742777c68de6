//! Orthographic projection along a direction of view.

use super::Point;
use nalgebra::Vector3;

/// The direction from the centre to the viewer, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The angle of azimuth, from the first axis towards the second axis.
    pub azimuth: f64,
    /// The angle of elevation above the plane of these two axes.
    pub elevation: f64,
}

impl Default for View {
    fn default() -> Self {
        View { azimuth: 28.0, elevation: 20.0 }
    }
}

impl View {
    /// The point in the picture: to the right and down, before scaling.
    pub(super) fn flat(&self, x: &Vector3<f64>) -> Point {
        let [_, right, up] = self.axes();
        [x.dot(&right), -x.dot(&up)]
    }

    /// The coordinate in the direction towards the viewer.
    pub(super) fn depth(&self, x: &Vector3<f64>) -> f64 {
        x.dot(&self.axes()[0])
    }

    /// The unit vectors towards the viewer, to the right, and up.
    pub(super) fn axes(&self) -> [Vector3<f64>; 3] {
        let (sin_a, cos_a) = self.azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation.to_radians().sin_cos();
        [
            Vector3::new(cos_e * cos_a, cos_e * sin_a, sin_e),
            Vector3::new(-sin_a, cos_a, 0.0),
            Vector3::new(-sin_e * cos_a, -sin_e * sin_a, cos_e),
        ]
    }
}
