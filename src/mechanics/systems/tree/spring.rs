//! Springs and dampers at joints and between points.

use crate::mechanism::MovingTree;
use crate::mechanism::tree::{BodyPoint, GroundView};
use nalgebra::Vector3;

/// A spring with a damper at a joint coordinate: the joint force `-stiffness (q - rest) - damping
/// v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSpring {
    /// The index of the rate.
    pub rate: usize,
    /// The index of the coordinate among the numbers. `None` for a rotation about a point, which has
    /// a damper only.
    pub number: Option<usize>,
    /// The force for a unit of the coordinate.
    pub stiffness: f64,
    /// The coordinate at which the spring is free of force.
    pub rest: f64,
    /// The force for a unit of the rate.
    pub damping: f64,
}

impl JointSpring {
    fn stretch(&self, y: &[f64]) -> f64 {
        self.number.map_or(0.0, |at| y[at] - self.rest)
    }

    /// The force of the spring against its stretch, at a state.
    pub(super) fn pull(&self, y: &[f64]) -> f64 {
        self.stiffness * self.stretch(y)
    }

    pub(super) fn potential(&self, y: &[f64]) -> f64 {
        0.5 * self.stiffness * self.stretch(y).powi(2)
    }
}

/// A spring with a damper between two points: with their distance `d`, the points attract each other
/// with the force `stiffness (d - length) + damping d'`. The force vanishes if the distance is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointSpring {
    /// The points.
    pub ends: [BodyPoint; 2],
    /// The force for a unit of the distance.
    pub stiffness: f64,
    /// The distance at which the spring is free of force.
    pub length: f64,
    /// The force for a unit of the rate of the distance.
    pub damping: f64,
}

impl PointSpring {
    /// The stretch `d - length`, its rate, and the direction from the first to the second point.
    fn stretch(&self, view: &GroundView) -> (f64, f64, Vector3<f64>) {
        let [a, b] = self.ends.map(|end| view.motion(&end));
        let apart = b.position - a.position;
        let distance = apart.norm();
        let along = if distance > 0.0 { apart / distance } else { Vector3::zeros() };
        (distance - self.length, along.dot(&(b.velocity - a.velocity)), along)
    }

    /// Adds the force to the loads.
    pub(super) fn load(&self, view: &GroundView, moving: &mut MovingTree) {
        let (stretch, rate, along) = self.stretch(view);
        let force = along * (self.stiffness * stretch + self.damping * rate);
        for (end, force) in self.ends.iter().zip([force, -force]) {
            moving.load(end, &view.attitude(end), &Vector3::zeros(), &force);
        }
    }

    /// The power of the damper.
    pub(super) fn power(&self, view: &GroundView) -> f64 {
        -self.damping * self.stretch(view).1.powi(2)
    }

    pub(super) fn potential(&self, view: &GroundView) -> f64 {
        0.5 * self.stiffness * self.stretch(view).0.powi(2)
    }
}
