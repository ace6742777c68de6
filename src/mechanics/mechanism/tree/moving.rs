//! A tree at a configuration, with rates: poses, velocities, energy and momentum.

use super::{BodyPoint, Tree, rotation};
use crate::group::{LieGroup, Se3, So3};
use nalgebra::{Isometry3, Matrix6, UnitQuaternion, Vector3, Vector6};
use std::sync::Arc;

/// A tree at a configuration, with rates, and the buffers of its recursions. The
/// methods [`place`](Self::place), [`forward`](Self::forward) and [`inverse`](Self::inverse) allocate
/// no memory.
#[derive(Clone, Debug)]
pub struct MovingTree {
    pub(super) tree: Arc<Tree>,
    pub(super) nodes: Vec<MovingNode>,
    /// For each rate, the data of the recursion of articulated bodies.
    pub(super) eliminated: Vec<Eliminated>,
}

/// A node at a configuration, in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovingNode {
    /// The pose of this frame relative to the frame before it, and its inverse.
    pub pose: Isometry3<f64>,
    pub back: Isometry3<f64>,
    /// The velocity of the frame.
    pub velocity: Vector6<f64>,
    /// The velocity `S v` relative to the frame before it.
    pub relative: Vector6<f64>,
    /// The acceleration; a free fall counts as zero.
    pub acceleration: Vector6<f64>,
    /// The wrench that acts on this node and all nodes behind it.
    pub wrench: Vector6<f64>,
    /// The external wrench on this node.
    pub load: Vector6<f64>,
    /// The inertia of this node and the nodes behind it.
    pub inertia: Matrix6<f64>,
}

/// A rate in the recursion of articulated bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Eliminated {
    /// The momentum `I S` of the articulated body for a unit of this rate.
    pub momentum: Vector6<f64>,
    /// The inertia `S . I S` of the rate.
    pub inertia: f64,
    /// The joint force that is left to accelerate this rate.
    pub force: f64,
}

impl MovingNode {
    /// The acceleration `Ad_(X^-1) A_before + [V, S v]` of the frame for rates that do not change, from
    /// the acceleration of the frame before it.
    pub fn carried(&self, before: &Vector6<f64>) -> Vector6<f64> {
        Se3.adjoint(&self.back, before) + Se3.bracket(&self.velocity, &self.relative)
    }
}

/// The covector `ad*_x h`: `(ad*_x h)(y) = h([x, y])`.
pub(super) fn coadjoint_bracket(x: &Vector6<f64>, h: &Vector6<f64>) -> Vector6<f64> {
    let part = |v: &Vector6<f64>, at: usize| Vector3::new(v[at], v[at + 1], v[at + 2]);
    let (w, u, m, f) = (part(x, 0), part(x, 3), part(h, 0), part(h, 3));
    let (m, f) = (m.cross(&w) + f.cross(&u), f.cross(&w));
    Vector6::new(m.x, m.y, m.z, f.x, f.y, f.z)
}

impl MovingTree {
    /// The tree at rest, at the position of its mechanism.
    pub fn new(tree: Arc<Tree>) -> Self {
        let still = MovingNode {
            pose: Isometry3::identity(),
            back: Isometry3::identity(),
            velocity: Vector6::zeros(),
            relative: Vector6::zeros(),
            acceleration: Vector6::zeros(),
            wrench: Vector6::zeros(),
            load: Vector6::zeros(),
            inertia: Matrix6::zeros(),
        };
        let (nodes, freedom) = (vec![still; tree.nodes.len()], tree.freedom());
        let home = tree.home();
        let mut moving =
            MovingTree { tree, nodes, eliminated: vec![Eliminated::default(); freedom] };
        moving.place(&home, &vec![0.0; freedom]);
        moving
    }

    /// The tree.
    pub fn tree(&self) -> &Arc<Tree> {
        &self.tree
    }

    /// Moves the tree to a configuration, with rates: `V = Ad_(X^-1) V_before + S v`. Quaternions
    /// need not be normalized.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn place(&mut self, numbers: &[f64], rates: &[f64]) {
        for (at, node) in self.tree.nodes.iter().enumerate() {
            let (first, rate) = (node.number, node.rates.start);
            let factor = if node.is_ball() {
                let turn = So3.project(rotation(&numbers[first..first + 4]));
                Isometry3::from_parts(Default::default(), turn)
            } else {
                Se3.exp(&(self.tree.twists[rate] * numbers[first]))
            };
            let offset = Isometry3::from_parts(node.offset.into(), UnitQuaternion::identity());
            let pose = Se3.compose(&offset, &factor);
            let back = Se3.inverse(&pose);
            let mut relative = Vector6::zeros();
            for k in node.rates.clone() {
                relative += self.tree.twists[k] * rates[k];
            }
            let mut velocity = relative;
            if let Some(parent) = node.parent {
                velocity += Se3.adjoint(&back, &self.nodes[parent].velocity);
            }
            let own = &mut self.nodes[at];
            (own.pose, own.back, own.relative, own.velocity) = (pose, back, relative, velocity);
        }
    }

    /// Removes all loads.
    pub fn unload(&mut self) {
        self.nodes.iter_mut().for_each(|node| node.load = Vector6::zeros());
    }

    /// Adds a load that acts on the body of a point: a moment about the point, and a force at the
    /// point, in ground components. The parameter `attitude` is the
    /// [attitude](super::GroundView::attitude) of the body. Loads on the ground have no effect.
    /// Loads remain until [`unload`](Self::unload).
    pub fn load(
        &mut self,
        point: &BodyPoint,
        attitude: &UnitQuaternion<f64>,
        moment: &Vector3<f64>,
        force: &Vector3<f64>,
    ) {
        let Some(node) = point.node else { return };
        let [moment, force] = [moment, force].map(|v| attitude.inverse_transform_vector(v));
        let moment = moment + point.point.cross(&force);
        let load = [moment.x, moment.y, moment.z, force.x, force.y, force.z];
        self.nodes[node].load += Vector6::from(load);
    }

    /// The wrench that the first body of a joint exerts on the second one, after
    /// [`inverse`](Self::inverse): a moment and a force. Components are those in the frame of the body
    /// that is farther from the ground. The moment is about the point of this body that is at `point`
    /// at the position of the mechanism. Returns `None` for a joint without freedom, because its bodies
    /// are one.
    ///
    /// # Panics
    /// Panics if the joint does not exist.
    pub fn reaction(&self, joint: usize, point: &Vector3<f64>) -> Option<Vector6<f64>> {
        let (node, sign) = self.tree.behind[joint]?;
        let wrench = self.nodes[node].wrench * sign;
        let origin = BodyPoint { node: Some(node), point: Vector3::zeros() };
        let arm = point - self.tree.at_home(&origin);
        let (moment, force) = (wrench.fixed_rows::<3>(0), wrench.fixed_rows::<3>(3));
        let moment = moment - arm.cross(&force);
        Some(Vector6::new(moment.x, moment.y, moment.z, force.x, force.y, force.z))
    }

    /// The poses of all bodies. The frame of each body is the ground frame at the position of the
    /// mechanism.
    pub fn poses(&self) -> Vec<Isometry3<f64>> {
        let nodes = self.node_poses();
        let pose = |body: &Option<(usize, Isometry3<f64>)>| match body {
            Some((node, to_node)) => Se3.compose(&nodes[*node], to_node),
            None => Isometry3::identity(),
        };
        self.tree.bodies.iter().map(pose).collect()
    }

    /// The velocities of all bodies, as twists in their frames.
    pub fn velocities(&self) -> Vec<Vector6<f64>> {
        let velocity = |body: &Option<(usize, Isometry3<f64>)>| match body {
            Some((node, to_node)) => {
                Se3.adjoint(&Se3.inverse(to_node), &self.nodes[*node].velocity)
            }
            None => Vector6::zeros(),
        };
        self.tree.bodies.iter().map(velocity).collect()
    }

    /// The kinetic energy `sum V . J V/2`.
    pub fn kinetic(&self) -> f64 {
        let nodes = self.tree.nodes.iter().zip(&self.nodes);
        nodes.map(|(node, own)| 0.5 * own.velocity.dot(&(node.inertia * own.velocity))).sum()
    }

    /// The potential `-g . sum m c` of gravity, with the centres of mass in the ground frame.
    pub fn potential(&self) -> f64 {
        let moment = |(node, pose): (&super::Node, &Isometry3<f64>)| {
            let j = &node.inertia;
            let own = Vector3::new(j[(2, 4)], j[(0, 5)], j[(1, 3)]);
            pose.translation.vector * j[(5, 5)] + pose.rotation * own
        };
        let poses = self.node_poses();
        let nodes = self.tree.nodes.iter().zip(&poses);
        -nodes.map(moment).sum::<Vector3<f64>>().dot(&self.tree.gravity)
    }

    /// The momentum of all bodies, with the moment about the origin of the ground frame: `(m, f)` in
    /// ground components.
    pub fn momentum(&self) -> Vector6<f64> {
        let mut sum = Vector6::zeros();
        let mut momenta: Vec<Vector6<f64>> = vec![];
        for (node, own) in self.tree.nodes.iter().zip(&self.nodes) {
            momenta.push(node.inertia * own.velocity);
        }
        for (at, node) in self.tree.nodes.iter().enumerate().rev() {
            let carried = Se3.coadjoint(&self.nodes[at].back, &momenta[at]);
            match node.parent {
                Some(parent) => momenta[parent] += carried,
                None => sum += carried,
            }
        }
        sum
    }

    /// The largest angular velocity of a body.
    pub fn spin(&self) -> f64 {
        let spins = self.nodes.iter().map(|node| node.velocity.fixed_rows::<3>(0).norm());
        spins.fold(0.0, f64::max)
    }

    /// The poses of the frames of all nodes.
    pub(super) fn node_poses(&self) -> Vec<Isometry3<f64>> {
        let mut poses: Vec<Isometry3<f64>> = vec![];
        for (node, own) in self.tree.nodes.iter().zip(&self.nodes) {
            poses.push(match node.parent {
                Some(parent) => Se3.compose(&poses[parent], &own.pose),
                None => own.pose,
            });
        }
        poses
    }

    /// The acceleration of the ground, in a frame that falls freely.
    pub(super) fn rise(&self) -> Vector6<f64> {
        let g = &self.tree.gravity;
        Vector6::new(0.0, 0.0, 0.0, -g.x, -g.y, -g.z)
    }
}
