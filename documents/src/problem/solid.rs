//! Polyhedra that approximate solids in pictures.

use affinor::mechanics::MassProperties;
use nalgebra::{Isometry3, Vector3};
use std::f64::consts::{PI, TAU};

/// The number of corners around a round part.
const AROUND: usize = 10;
/// The number of rings between the poles of a ball.
const RINGS: usize = 3;

/// A convex solid or a closed surface, given by its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// The corners, in the frame of the body.
    pub corners: Vec<Vector3<f64>>,
    /// The faces, each as the indices of its corners, counterclockwise as seen from outside. A face
    /// with two corners is a line.
    pub faces: Vec<Vec<usize>>,
}

impl Solid {
    /// A box with three edge lengths.
    pub(super) fn cuboid(edges: &Vector3<f64>) -> Self {
        let sign = |at: usize, bit: usize| if at >> bit & 1 == 1 { 0.5 } else { -0.5 };
        let corner =
            |at: usize| edges.component_mul(&Vector3::new(sign(at, 0), sign(at, 1), sign(at, 2)));
        let faces =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        Solid { corners: (0..8).map(corner).collect(), faces: faces.map(Vec::from).into() }
    }

    /// A cylinder about the third axis.
    pub(super) fn cylinder(radius: f64, height: f64) -> Self {
        let ring = |z: f64| {
            (0..AROUND).map(move |k| {
                let (sin, cos) = (TAU * k as f64 / AROUND as f64).sin_cos();
                Vector3::new(radius * cos, radius * sin, z)
            })
        };
        let mut faces: Vec<Vec<usize>> =
            vec![(0..AROUND).rev().collect(), (AROUND..2 * AROUND).collect()];
        faces.extend((0..AROUND).map(|k| {
            let next = (k + 1) % AROUND;
            vec![k, next, AROUND + next, AROUND + k]
        }));
        Solid { corners: ring(-0.5 * height).chain(ring(0.5 * height)).collect(), faces }
    }

    /// The homogeneous ellipsoid with the mass, the centre and the inertia of a body. With the principal
    /// moments `I_k`, its half axes are `a_k^2 = 5 (I_1 + I_2 + I_3 - 2 I_k)/(2 m)`.
    pub(super) fn of_inertia(body: &MassProperties) -> Self {
        let principal = body.inertia_matrix().symmetric_eigen();
        let mut axes = principal.eigenvectors;
        if axes.determinant() < 0.0 {
            // faces keep their orientation
            axes.column_mut(0).neg_mut();
        }
        let (moments, sum) = (principal.eigenvalues, principal.eigenvalues.sum());
        let squares = moments.map(|moment| 2.5 * (sum - 2.0 * moment) / body.mass());
        // rounding errors of a flat body may be negative
        let ellipsoid = Solid::ellipsoid(&squares.map(|square| square.max(0.0).sqrt()));
        let corners = ellipsoid.corners.iter();
        let corners = corners.map(|x| axes * x + body.centre()).collect();
        Solid { corners, ..ellipsoid }
    }

    /// An ellipsoid with three half axes.
    pub(super) fn ellipsoid(half_axes: &Vector3<f64>) -> Self {
        let mut corners = vec![];
        for ring in 1..=RINGS {
            let (sin, cos) = (PI * ring as f64 / (RINGS + 1) as f64).sin_cos();
            corners.extend((0..AROUND).map(|k| {
                let (y, x) = (TAU * k as f64 / AROUND as f64).sin_cos();
                half_axes.component_mul(&Vector3::new(sin * x, sin * y, cos))
            }));
        }
        let (north, south) = (corners.len(), corners.len() + 1);
        corners.extend([Vector3::z() * half_axes.z, -Vector3::z() * half_axes.z]);
        let at = |ring: usize, k: usize| ring * AROUND + k % AROUND;
        let mut faces = vec![];
        for k in 0..AROUND {
            faces.push(vec![north, at(0, k), at(0, k + 1)]);
            faces.push(vec![south, at(RINGS - 1, k + 1), at(RINGS - 1, k)]);
            for ring in 1..RINGS {
                faces.push(vec![
                    at(ring - 1, k),
                    at(ring, k),
                    at(ring, k + 1),
                    at(ring - 1, k + 1),
                ]);
            }
        }
        Solid { corners, faces }
    }

    /// A rod along the third axis.
    pub(super) fn rod(length: f64) -> Self {
        let end = Vector3::z() * (0.5 * length);
        Solid { corners: vec![-end, end], faces: vec![vec![0, 1]] }
    }

    /// The solid, moved by a rigid motion.
    pub(super) fn moved(&self, motion: &Isometry3<f64>) -> Self {
        let corners = self.corners.iter().map(|x| motion.rotation * x + motion.translation.vector);
        Solid { corners: corners.collect(), faces: self.faces.clone() }
    }

    /// The largest distance of a corner from the origin.
    pub fn reach(&self) -> f64 {
        self.corners.iter().map(|x| x.norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces are counterclockwise as seen from outside: by the divergence theorem, they enclose
    /// the volume of the shape.
    #[test]
    fn faces_are_counterclockwise_from_outside() {
        let volume = |solid: &Solid| -> f64 {
            let fan = |face: &Vec<usize>| -> f64 {
                let at = |k: usize| solid.corners[face[k]];
                (1..face.len() - 1).map(|k| at(0).dot(&at(k).cross(&at(k + 1))) / 6.0).sum()
            };
            solid.faces.iter().map(fan).sum()
        };
        let axes = Vector3::new(1.0, 2.0, 3.0);
        assert!((volume(&Solid::cuboid(&axes)) - 6.0).abs() < 1e-12);
        // the ratio of the area of an inscribed polygon, or of the volume of a polyhedron, to that
        // of the round shape
        let disc = 0.5 * AROUND as f64 * (TAU / AROUND as f64).sin();
        assert!((volume(&Solid::cylinder(2.0, 5.0)) - 4.0 * disc * 5.0).abs() < 1e-12);
        let share = volume(&Solid::ellipsoid(&axes)) / (4.0 / 3.0 * PI * 6.0);
        assert!((0.7..1.0).contains(&share), "{share}");
        let moved = Solid::cuboid(&axes).moved(&Isometry3::new(axes, Vector3::x()));
        assert!((volume(&moved) - 6.0).abs() < 1e-12);
    }
}
