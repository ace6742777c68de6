//! Two bodies that move as one, which closes a loop.

use super::rows::Rows;
use crate::mechanism::tree::{BodyPoint, GroundView};
use crate::mechanism::{MovingTree, Tree};
use nalgebra::Vector3;

/// The equations of two bodies that move as one, because a loop was [cut](crate::mechanism::Cut)
/// there.
///
/// With the attitudes `R_a`, `R_b` and the positions `x_a`, `x_b` of one point in both bodies, the
/// six equations are
///
/// ```text
/// 2 l vec(R_a R_b^T) = 0,   x_a - x_b = 0
/// ```
///
/// where `vec` is the vector part of the quaternion with a positive real part, and `l` is the
/// [length](Tree::length) of the tree. Their derivatives with respect to the time are the differences
/// of the angular velocities, times `l`, and of the velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    points: [BodyPoint; 2],
}

impl Closure {
    /// The equations of a body and its copy.
    ///
    /// # Panics
    /// Panics if a body does not exist.
    pub fn new(tree: &Tree, [body, copy]: [usize; 2]) -> Self {
        let first = tree.origin(body);
        Closure { points: [first, tree.point(copy, &tree.at_home(&first))] }
    }

    /// Appends the equations.
    pub(super) fn add(&self, tree: &Tree, view: &GroundView, rows: &mut Rows) {
        let [a, b] = self.points.map(|point| view.motion(&point));
        let [turn_a, turn_b] = self.points.map(|point| view.attitude(&point));
        let turn = turn_a * turn_b.inverse();
        let angle = turn.imag() * (2.0_f64).copysign(turn.w);
        let length = tree.length();
        let values = [angle * length, a.position - b.position];
        let biases = [(a.spin_rate - b.spin_rate) * length, a.acceleration - b.acceleration];
        let first = rows.begin(length);
        for (value, bias) in values.iter().zip(&biases) {
            for i in 0..3 {
                rows.push(Some(value[i]), 0.0, bias[i]);
            }
        }
        for (point, motion, sign) in [(self.points[0], a, 1.0), (self.points[1], b, -1.0)] {
            view.for_rates(tree, &point, &motion.position, |rate, w, u| {
                for (block, part) in [w * length, u].iter().enumerate() {
                    for i in 0..3 {
                        rows.add(first + 3 * block + i, rate, sign * part[i]);
                    }
                }
            });
        }
    }

    /// Adds the forces `-G^T lambda` to the loads of both bodies.
    pub(super) fn load(&self, view: &GroundView, multipliers: &[f64], moving: &mut MovingTree) {
        let part = |at: usize| Vector3::from_column_slice(&multipliers[at..at + 3]);
        let [moment, force] = [part(0) * moving.tree().length(), part(3)];
        for (point, sign) in self.points.iter().zip([-1.0, 1.0]) {
            let attitude = view.attitude(point);
            moving.load(point, &attitude, &(moment * sign), &(force * sign));
        }
    }
}
