//! Bodies that roll or slide on a plane: wheels, balls and knife edges.

use super::rows::Rows;
use crate::mechanism::tree::{BodyPoint, GroundView, PointMotion};
use crate::mechanism::{MovingTree, Tree};
use nalgebra::{UnitQuaternion, Vector3};

/// The shape of a body where it touches the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactShape {
    /// A ball of this radius about the point. It rolls.
    Ball(f64),
    /// A thin wheel of this radius about the point, with an axis in the frame of the body. It rolls,
    /// also if it leans.
    Wheel(f64, Vector3<f64>),
    /// A knife edge at the point, with a direction in the frame of the body. It slides along its
    /// direction only.
    Edge(Vector3<f64>),
}

/// A contact without slip between a body and a plane that is fixed in the ground frame.
///
/// Let `n` be the normal of the plane, `c` the position of the point, and `r` the vector from it to
/// the point of contact. The body touches the plane, and its material point at the contact is at
/// rest:
///
/// ```text
/// n . (c + r) = height,   c' + w x r = 0
/// ball:  r = -radius n
/// wheel: r = -radius (n - (n . a) a)/|n - (n . a) a|,   with the axis a
/// ```
///
/// A knife edge with the direction `e` has `r = 0` and only the two equations along `n` and along
/// `n x e`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The centre of a wheel or a ball, or a point of a knife edge.
    pub centre: BodyPoint,
    /// The shape.
    pub shape: ContactShape,
    /// The unit normal of the plane, towards the body.
    pub normal: Vector3<f64>,
    /// The product `n . x` for all points `x` of the plane.
    pub height: f64,
}

/// A contact at a state.
struct Touch {
    /// The vector from the centre to the point of contact, and its time derivative.
    arm: Vector3<f64>,
    arm_rate: Vector3<f64>,
    /// The directions of the equations on the velocity, and their time derivatives. The first one is
    /// the normal.
    directions: Vec<[Vector3<f64>; 2]>,
}

impl Contact {
    /// The contact of a body with the plane that it touches at the position of the mechanism.
    pub fn at_home(
        tree: &Tree,
        centre: BodyPoint,
        shape: ContactShape,
        normal: &Vector3<f64>,
    ) -> Self {
        let normal = normal.normalize();
        let mut contact = Contact { centre, shape, normal, height: 0.0 };
        let still = PointMotion { position: tree.at_home(&centre), ..Default::default() };
        let touch = contact.touch(&still, &Default::default());
        contact.height = normal.dot(&(still.position + touch.arm));
        contact
    }

    /// The number of equations on the velocity.
    pub fn count(&self) -> usize {
        if let ContactShape::Edge(_) = self.shape { 2 } else { 3 }
    }

    fn touch(&self, motion: &PointMotion, attitude: &UnitQuaternion<f64>) -> Touch {
        let (n, zero) = (self.normal, Vector3::zeros());
        let fixed = |n: Vector3<f64>| {
            let across = n.cross(&Vector3::ith((n.iamax() + 1) % 3, 1.0)).normalize();
            vec![[n, zero], [across, zero], [n.cross(&across), zero]]
        };
        match &self.shape {
            ContactShape::Ball(radius) => {
                Touch { arm: -n * *radius, arm_rate: zero, directions: fixed(n) }
            }
            ContactShape::Wheel(radius, axis) => {
                let a = attitude * axis;
                let a_rate = motion.spin.cross(&a);
                let lean = n.dot(&a);
                let up = n - a * lean;
                let up_rate = -a * n.dot(&a_rate) - a_rate * lean;
                let [d, d_rate] = direction(&up, &up_rate);
                Touch { arm: d * -*radius, arm_rate: d_rate * -*radius, directions: fixed(n) }
            }
            ContactShape::Edge(edge) => {
                let e = attitude * edge;
                let across = direction(&n.cross(&e), &n.cross(&motion.spin.cross(&e)));
                Touch { arm: zero, arm_rate: zero, directions: vec![[n, zero], across] }
            }
        }
    }

    /// Appends the equations of this contact.
    pub(super) fn add(&self, tree: &Tree, view: &GroundView, rows: &mut Rows) {
        let motion = view.motion(&self.centre);
        let touch = self.touch(&motion, &view.attitude(&self.centre));
        let position = motion.position + touch.arm;
        let velocity = motion.velocity + motion.spin.cross(&touch.arm);
        let acceleration = motion.acceleration
            + motion.spin_rate.cross(&touch.arm)
            + motion.spin.cross(&touch.arm_rate);
        rows.begin(tree.length());
        for (at, [along, along_rate]) in touch.directions.iter().enumerate() {
            let value = (at == 0).then(|| along.dot(&position) - self.height);
            let bias = along.dot(&acceleration) + along_rate.dot(&velocity);
            let row = rows.push(value, 0.0, bias);
            view.for_rates(tree, &self.centre, &position, |rate, _, u| {
                rows.add(row, rate, along.dot(&u));
            });
        }
    }
}

impl Contact {
    /// Adds the force of this contact to the loads of its body.
    pub(super) fn load(&self, view: &GroundView, multipliers: &[f64], moving: &mut MovingTree) {
        let attitude = view.attitude(&self.centre);
        let touch = self.touch(&view.motion(&self.centre), &attitude);
        let directions = touch.directions.iter().zip(multipliers);
        let force: Vector3<f64> = directions.map(|([along, _], own)| along * -*own).sum();
        moving.load(&self.centre, &attitude, &touch.arm.cross(&force), &force);
    }
}

/// The direction of a vector, and its time derivative.
fn direction(v: &Vector3<f64>, rate: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let size = v.norm();
    let unit = v / size;
    [unit, (rate - unit * unit.dot(rate)) / size]
}
