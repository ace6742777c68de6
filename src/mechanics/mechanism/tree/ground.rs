//! Points of a moving tree in the ground frame: positions, velocities, and their derivatives with
//! respect to the rates.

use super::{MovingTree, Tree};
use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};

/// A point that is fixed to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPoint {
    /// The node that carries the body; `None` for the ground.
    pub(crate) node: Option<usize>,
    /// The point in the frame of the node, or in the ground frame.
    pub(crate) point: Vector3<f64>,
}

/// The motion of a frame or a point: angular velocity `w` and its time derivative, position, velocity
/// and acceleration, all in ground components. The accelerations are those for rates that do not
/// change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointMotion {
    /// The angular velocity of the body.
    pub spin: Vector3<f64>,
    /// The time derivative of the angular velocity.
    pub spin_rate: Vector3<f64>,
    /// The position.
    pub position: Vector3<f64>,
    /// The velocity.
    pub velocity: Vector3<f64>,
    /// The acceleration.
    pub acceleration: Vector3<f64>,
}

/// The poses and the motions of all nodes in the ground frame.
#[derive(Clone, Debug, Default)]
pub struct GroundView {
    poses: Vec<Isometry3<f64>>,
    motions: Vec<PointMotion>,
}

impl Tree {
    /// The point of a body that is at `point` in the ground frame, at the position of the mechanism.
    ///
    /// # Panics
    /// Panics if the body does not exist.
    pub fn point(&self, body: usize, point: &Vector3<f64>) -> BodyPoint {
        match &self.bodies[body] {
            Some((node, to_node)) => {
                let point = to_node.translation.vector + to_node.rotation * point;
                BodyPoint { node: Some(*node), point }
            }
            None => BodyPoint { node: None, point: *point },
        }
    }

    /// The origin of the frame of a body in the tree, as a point of this body.
    ///
    /// # Panics
    /// Panics if the body does not exist.
    pub fn origin(&self, body: usize) -> BodyPoint {
        let node = self.bodies[body].as_ref().map(|(node, _)| *node);
        BodyPoint { node, point: Vector3::zeros() }
    }

    /// The position of a point at the position of the mechanism.
    pub fn at_home(&self, point: &BodyPoint) -> Vector3<f64> {
        let mut position = point.point;
        let mut node = point.node;
        while let Some(at) = node {
            position += self.nodes[at].offset;
            node = self.nodes[at].parent;
        }
        position
    }
}

impl GroundView {
    /// Computes the motions of all nodes at the configuration and the rates of a tree.
    pub fn update(&mut self, moving: &MovingTree) {
        self.poses = moving.node_poses();
        self.motions.clear();
        let mut accelerations: Vec<Vector6<f64>> = vec![];
        for ((node, own), pose) in moving.tree.nodes.iter().zip(&moving.nodes).zip(&self.poses) {
            let before = node.parent.map_or_else(Vector6::zeros, |parent| accelerations[parent]);
            let acceleration = own.carried(&before);
            let part = |v: &Vector6<f64>, at: usize| v.fixed_rows::<3>(at).into_owned();
            let (w, u) = (part(&own.velocity, 0), part(&own.velocity, 3));
            self.motions.push(PointMotion {
                spin: pose.rotation * w,
                spin_rate: pose.rotation * part(&acceleration, 0),
                position: pose.translation.vector,
                velocity: pose.rotation * u,
                acceleration: pose.rotation * (part(&acceleration, 3) + w.cross(&u)),
            });
            accelerations.push(acceleration);
        }
    }

    /// The attitude of the body of a point.
    pub fn attitude(&self, point: &BodyPoint) -> UnitQuaternion<f64> {
        point.node.map_or_else(Default::default, |node| self.poses[node].rotation)
    }

    /// The motion of a point.
    pub fn motion(&self, point: &BodyPoint) -> PointMotion {
        let Some(node) = point.node else {
            return PointMotion { position: point.point, ..Default::default() };
        };
        let own = &self.motions[node];
        let arm = self.poses[node].rotation * point.point;
        let turning = own.spin.cross(&arm);
        PointMotion {
            position: own.position + arm,
            velocity: own.velocity + turning,
            acceleration: own.acceleration + own.spin_rate.cross(&arm) + own.spin.cross(&turning),
            ..*own
        }
    }

    /// Calls `add` for each rate that moves a body, with the angular velocity of the body and the
    /// velocity of its point at `position`, for a unit of this rate. All vectors have ground
    /// components.
    pub fn for_rates(
        &self,
        tree: &Tree,
        point: &BodyPoint,
        position: &Vector3<f64>,
        mut add: impl FnMut(usize, Vector3<f64>, Vector3<f64>),
    ) {
        let mut next = point.node;
        while let Some(at) = next {
            let node = &tree.nodes[at];
            let pose = &self.poses[at];
            // a difference of positions is the same for all origins of the ground frame
            let arm = position - pose.translation.vector;
            for rate in node.rates.clone() {
                let twist = &tree.twists[rate];
                let w = pose.rotation * Vector3::new(twist[0], twist[1], twist[2]);
                let u = pose.rotation * Vector3::new(twist[3], twist[4], twist[5]);
                add(rate, w, u + w.cross(&arm));
            }
            next = node.parent;
        }
    }
}
