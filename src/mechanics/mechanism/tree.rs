//! Trees of bodies in joint coordinates, and their recursions, whose cost is linear in the number of
//! bodies.
//!
//! The pose of a body relative to the body before it is `T exp(S q)`, with a constant pose `T`. For
//! a rotation `R` about a point it is `T R`. A joint of several freedoms
//! is a product of such factors. All twists are components in the frame of the later body. With the
//! relative pose `X`, the body velocity `V`, the twists `S` and the rates `v`,
//!
//! ```text
//! V = Ad_(X^-1) V_before + S v
//! ```
//!
//! In reading order: [`Tree`] is the tree; [`moving`] its poses, velocities, energy and momentum;
//! `inverse` computes joint forces from accelerations, and `articulated` accelerations from joint
//! forces. `composite` is the mass matrix, and `mass` its factorization. F. C. Park, J. E. Bobrow and
//! S. R. Ploen, *Int. J. Robotics Research* 14 (1995) 609-618; R. Featherstone, *Rigid Body Dynamics
//! Algorithms* (2008).

mod articulated;
mod composite;
pub mod cut;
pub mod ground;
mod inverse;
mod mass;
pub mod moving;

pub use cut::Cut;
pub use ground::{BodyPoint, GroundView, PointMotion};
pub(crate) use mass::MassFactor;
pub use moving::MovingTree;

use super::graph::Mechanism;
use super::joint::{Joint, JointKind};
use crate::Error;
use crate::group::{Embedded, LieGroup, Se3, So3};
use crate::mechanics::MassProperties;
use nalgebra::{
    DVector, Isometry3, Matrix6, Quaternion, Translation3, UnitQuaternion, Vector3, Vector4,
    Vector6,
};
use std::ops::Range;

/// A tree of bodies, in joint coordinates.
///
/// The **numbers** of a configuration are, for each joint in its order, the coordinate of each
/// factor: an angle in radians or a length. A rotation about a point has the four numbers `w, x, y,
/// z` of a unit quaternion. The **rates** are the time derivatives of angles and lengths, and the
/// body components of angular velocities. Coordinates vanish at the position of the mechanism. They
/// describe the motion of the second body of a joint relative to the first, but rotations about a
/// point that of the outer body relative to the inner one.
///
/// ```
/// use affinor::mechanics::MassProperties;
/// use affinor::mechanism::{Joint, Mechanism, MovingTree, Tree};
/// use nalgebra::{Isometry3, Vector3};
/// // a rod of length 1 along z, which hangs from a hinge at its upper end
/// let hinge = Joint::revolute(&[0.0; 3], &[0.0, 1.0, 0.0])?.between("hinge", [0, 1]);
/// let names = ["ground", "rod"].map(String::from).to_vec();
/// let mechanism = Mechanism::new(names, &[0], vec![hinge])?;
/// let rod = MassProperties::rod(1.0)?.moved(&Isometry3::translation(0.0, 0.0, -0.5));
/// let tree = Tree::new(&mechanism, &[None, Some(rod)], &Vector3::new(0.0, 0.0, -9.81))?;
/// let mut moving = MovingTree::new(tree.into());
/// moving.place(&[0.3], &[0.0]);
/// let mut acceleration = [0.0];
/// moving.forward(&[0.0], &mut acceleration)?;
/// // theta'' = -3 g/(2 l) sin(theta)
/// assert!((acceleration[0] + 1.5 * 9.81 * 0.3_f64.sin()).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tree {
    /// The factors of all joints. Each one follows the factor before it.
    nodes: Vec<Node>,
    /// For each rate, its twist in the frame of its node.
    twists: Vec<Vector6<f64>>,
    /// For each joint, its rates and its numbers.
    joints: Vec<(Range<usize>, Range<usize>)>,
    /// For each body, its node and the pose of the node relative to the body. `None` is the ground.
    bodies: Vec<Option<(usize, Isometry3<f64>)>>,
    /// For each joint, the node of the body behind it, and whether this is the second body: `1.0`,
    /// or `-1.0`. `None` for a joint without freedom.
    behind: Vec<Option<(usize, f64)>>,
    gravity: Vector3<f64>,
    /// The number of numbers of a configuration.
    numbers: usize,
    length: f64,
}

/// A factor of a joint, with the frame behind it. All frames are parallel at the position of the
/// mechanism.
#[derive(Clone, Debug)]
struct Node {
    /// The node before this one; `None` for the ground.
    parent: Option<usize>,
    /// The origin of this frame at the position of the mechanism, in the frame before it.
    offset: Vector3<f64>,
    /// The inertia of the bodies that are fixed to this frame. It maps twists to momenta.
    inertia: Matrix6<f64>,
    /// The rates: one for a one-parameter group, and three for rotations about the origin.
    rates: Range<usize>,
    /// The index of the first number.
    number: usize,
}

impl Node {
    /// Whether the factor consists of the rotations about a point.
    fn is_ball(&self) -> bool {
        self.rates.len() == 3
    }
}

/// A factor of a joint in the ground frame: its twists, its first rate and its first number.
struct Factor {
    twists: Vec<Vector6<f64>>,
    rate: usize,
    number: usize,
}

impl Tree {
    /// The tree of a mechanism without loops. The inertia of each body is given in the ground frame
    /// at the position of the mechanism, `None` for a body without mass; `gravity` is an
    /// acceleration.
    ///
    /// # Errors
    /// [`Error::Invalid`] if joints form a loop, or if the bodies beyond a joint do not resist its
    /// motion; [`Error::Shape`] if the list of inertias has another length.
    pub fn new(
        mechanism: &Mechanism<f64>,
        inertias: &[Option<MassProperties>],
        gravity: &Vector3<f64>,
    ) -> Result<Self, Error> {
        let names = mechanism.bodies();
        expect_inertias(mechanism, inertias)?;
        if let Some(closed) = mechanism.loops().first() {
            let name = |(at, _): &(usize, bool)| format!("`{}`", mechanism.joints()[*at].name);
            let list: Vec<String> = closed.joints.iter().map(name).collect();
            return Err(invalid(format!("the joints {} form a loop", list.join(", "))));
        }
        let (factors, joints) = factors(mechanism.joints());
        let spanning = mechanism.spanning()?;
        let count = joints.last().map_or((0, 0), |(rates, numbers)| (rates.end, numbers.end));
        let mut tree = Tree {
            nodes: vec![],
            twists: vec![Vector6::zeros(); count.0],
            joints,
            bodies: vec![None; names.len()],
            behind: vec![None; mechanism.joints().len()],
            gravity: *gravity,
            numbers: count.1,
            length: 1.0,
        };
        // the origins of the frames of the nodes, in the ground frame
        let mut origins: Vec<Vector3<f64>> = vec![];
        for &body in &spanning.order {
            let Some((before, joint, forward)) = spanning.parent[body] else { continue };
            let mut node = tree.bodies[before].map(|(node, _)| node);
            let centre = inertias[body].map(|own| *own.centre());
            let ordered: Vec<&Factor> = match forward {
                true => factors[joint].iter().collect(),
                false => factors[joint].iter().rev().collect(),
            };
            for factor in ordered {
                let before = node.map_or_else(Vector3::zeros, |at: usize| origins[at]);
                let origin = factor.origin(&centre.unwrap_or(before));
                let rates = factor.rate..factor.rate + factor.twists.len();
                let sign = if forward || rates.len() == 3 { 1.0 } else { -1.0 };
                let back = Isometry3::from_parts((-origin).into(), Default::default());
                for (twist, own) in tree.twists[rates.clone()].iter_mut().zip(&factor.twists) {
                    *twist = Se3.adjoint(&back, own) * sign;
                }
                let (inertia, number) = (Matrix6::zeros(), factor.number);
                let offset = origin - before;
                tree.nodes.push(Node { parent: node, offset, inertia, rates, number });
                origins.push(origin);
                node = Some(tree.nodes.len() - 1);
                tree.behind[joint] = node.map(|node| (node, if forward { 1.0 } else { -1.0 }));
            }
            let Some(at) = node else { continue };
            let origin = Translation3::from(-origins[at]);
            let to_node = Isometry3::from_parts(origin, Default::default());
            tree.bodies[body] = Some((at, to_node));
            if let Some(own) = &inertias[body] {
                tree.nodes[at].inertia += own.moved(&to_node).twist_inertia();
            }
        }
        tree.length = tree.size();
        tree.expect_inertia(mechanism)?;
        Ok(tree)
    }

    /// The number of degrees of freedom.
    pub fn freedom(&self) -> usize {
        self.twists.len()
    }

    /// The rates of a joint, as a range of indices.
    pub fn rates(&self, joint: usize) -> Range<usize> {
        self.joints[joint].0.clone()
    }

    /// The numbers of a joint, as a range of indices.
    pub fn numbers(&self, joint: usize) -> Range<usize> {
        self.joints[joint].1.clone()
    }

    /// The numbers of the position of the mechanism.
    pub fn home(&self) -> Vec<f64> {
        let mut numbers = vec![0.0; self.numbers];
        self.balls().for_each(|(_, number)| numbers[number] = 1.0);
        numbers
    }

    /// The rotations about points: the index of the first rate, and the index of the first number.
    pub fn balls(&self) -> impl Iterator<Item = (usize, usize)> {
        self.nodes.iter().filter(|node| node.is_ball()).map(|node| (node.rates.start, node.number))
    }

    /// The angles and lengths: the index of the rate, and the index of the number.
    pub fn coordinates(&self) -> impl Iterator<Item = (usize, usize)> {
        let single = self.nodes.iter().filter(|node| !node.is_ball());
        single.map(|node| (node.rates.start, node.number))
    }

    /// The length to which translations are compared: the largest radius of gyration of a body about
    /// its joint, or the largest distance between two joints. It does not depend on the ground frame.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Whether a rate is an angular velocity, and not the velocity of a translation.
    pub fn is_angular(&self, rate: usize) -> bool {
        self.twists[rate].fixed_rows::<3>(0).norm_squared() > 0.0
    }

    /// The unit of each rate and of its coordinate: 1 for angles, and the [`length`](Self::length)
    /// for translations.
    pub fn units(&self) -> impl Iterator<Item = f64> {
        (0..self.freedom()).map(|rate| if self.is_angular(rate) { 1.0 } else { self.length })
    }

    /// The largest of some displacements or rates, in [`units`](Self::units). It is NaN if one of them
    /// is NaN.
    pub fn largest<'x>(&self, list: impl IntoIterator<Item = &'x f64>) -> f64 {
        let sizes = list.into_iter().zip(self.units()).map(|(x, unit)| (x / unit).abs());
        sizes.fold(0.0, |most, x| if x <= most { most } else { x })
    }

    /// The time derivatives of the numbers for rates. Equal to the rates unless there are rotations
    /// about points.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn slopes(&self, numbers: &[f64], rates: &[f64], slopes: &mut [f64]) {
        for node in &self.nodes {
            let (at, rate) = (node.number, node.rates.start);
            if node.is_ball() {
                let turn = rotation(&numbers[at..at + 4]);
                let slope = So3.rate(&turn, &Vector3::from_column_slice(&rates[rate..rate + 3]));
                slopes[at..at + 4].copy_from_slice(&in_order(&slope));
            } else {
                slopes[at] = rates[rate];
            }
        }
    }

    /// Normalizes the quaternions of the numbers.
    ///
    /// # Panics
    /// Panics if the list is too short.
    pub fn normalize(&self, numbers: &mut [f64]) {
        for (_, at) in self.balls() {
            let turn = So3.project(rotation(&numbers[at..at + 4]));
            numbers[at..at + 4].copy_from_slice(&in_order(&turn.coords));
        }
    }

    /// Moves a configuration by a displacement, which has a component for each rate: angles and
    /// lengths are added, and rotations about points are multiplied by the exponential.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn displace(&self, numbers: &mut [f64], displacement: &[f64]) {
        for node in &self.nodes {
            let (at, rate) = (node.number, node.rates.start);
            if node.is_ball() {
                let by = Vector3::from_column_slice(&displacement[rate..rate + 3]);
                let turn = So3.compose(&rotation(&numbers[at..at + 4]), &So3.exp(&by));
                numbers[at..at + 4].copy_from_slice(&in_order(&turn.coords));
            } else {
                numbers[at] += displacement[rate];
            }
        }
    }

    /// The displacement that changes a configuration by a small change of its numbers, the inverse of
    /// [`displace`](Self::displace) to first order.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn displacement(&self, numbers: &[f64], change: &[f64]) -> DVector<f64> {
        let mut displacement = DVector::zeros(self.freedom());
        for (rate, number) in self.coordinates() {
            displacement[rate] = change[number];
        }
        for (rate, number) in self.balls() {
            // the change is the quaternion times half of the displacement
            let quaternion = |list: &[f64]| {
                Quaternion::new(list[number], list[number + 1], list[number + 2], list[number + 3])
            };
            let half = quaternion(numbers).conjugate() * quaternion(change);
            displacement.rows_mut(rate, 3).copy_from(&(half.imag() * 2.0));
        }
        displacement
    }

    /// The derivatives of a function of the numbers with respect to the three rates of a rotation
    /// about a point, whose first number has the index `number`. The parameter `gradient` lists the
    /// derivatives with respect to all numbers.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn along_ball(&self, numbers: &[f64], number: usize, gradient: &[f64]) -> [f64; 3] {
        let turn = rotation(&numbers[number..number + 4]);
        [0, 1, 2].map(|k| {
            let slope = in_order(&So3.rate(&turn, &Vector3::ith(k, 1.0)));
            slope.iter().zip(&gradient[number..]).map(|(slope, by)| slope * by).sum()
        })
    }

    /// The [`length`](Self::length); 1 if all lengths are zero.
    fn size(&self) -> f64 {
        let mut most = 0.0_f64;
        for node in &self.nodes {
            let (mass, second) = (node.inertia[(5, 5)], node.inertia.fixed_view::<3, 3>(0, 0));
            let radius = if mass > 0.0 { (second.trace() / (2.0 * mass)).sqrt() } else { 0.0 };
            let distance = if node.parent.is_some() { node.offset.norm() } else { 0.0 };
            most = most.max(radius).max(distance);
        }
        if most > 0.0 && most.is_finite() { most } else { 1.0 }
    }

    /// Checks that accelerations exist at the position of the mechanism.
    fn expect_inertia(&self, mechanism: &Mechanism<f64>) -> Result<(), Error> {
        let mut moving = MovingTree::new(self.clone().into());
        moving.place(&self.home(), &vec![0.0; self.freedom()]);
        match moving.reduce(&vec![0.0; self.freedom()]) {
            Ok(()) => Ok(()),
            Err(rate) => {
                let joint = self.joints.iter().position(|(rates, _)| rates.contains(&rate));
                let name = joint.map_or("", |at| &mechanism.joints()[at].name);
                let reason =
                    format!("the bodies beyond the joint `{name}` do not resist its motion");
                Err(invalid(reason))
            }
        }
    }
}

impl Factor {
    /// The origin of the frame behind the factor: the centre of rotations about a point, otherwise
    /// the point of the axis that is closest to `near`.
    fn origin(&self, near: &Vector3<f64>) -> Vector3<f64> {
        if let [first, second, third] = &self.twists[..] {
            // the twists are (e_k, p cross e_k)
            return Vector3::new(second[5], third[3], first[4]);
        }
        let parts = |at: usize| self.twists[0].fixed_rows::<3>(at).into_owned();
        let (w, u) = (parts(0), parts(3));
        let square = w.norm_squared();
        if square == 0.0 {
            return *near;
        }
        // relative to `near`, which avoids cancellation far from the origin
        near + w.cross(&(u + w.cross(near))) / square
    }
}

/// The factors of each joint, and its rates and numbers. Twists have unit angular velocity, or unit
/// velocity for translations.
#[allow(clippy::type_complexity, reason = "two lists that are made together")]
fn factors(joints: &[Joint<f64>]) -> (Vec<Vec<Factor>>, Vec<(Range<usize>, Range<usize>)>) {
    let (mut all, mut ranges) = (vec![], vec![]);
    let (mut rate, mut number) = (0, 0);
    for joint in joints {
        let start = (rate, number);
        let twists: Vec<Vector6<f64>> = joint.twists().iter().map(|t| Vector6::from(*t)).collect();
        // the last three twists of these kinds are the rotations about a point
        let has_ball = matches!(joint.kind(), JointKind::Spherical | JointKind::Free);
        let single = if has_ball { twists.len() - 3 } else { twists.len() };
        let mut factors = vec![];
        for twist in &twists[..single] {
            let turn = twist.fixed_rows::<3>(0).norm();
            let size = if turn > 0.0 { turn } else { twist.fixed_rows::<3>(3).norm() };
            factors.push(Factor { twists: vec![twist / size], rate, number });
            (rate, number) = (rate + 1, number + 1);
        }
        if has_ball {
            factors.push(Factor { twists: twists[single..].to_vec(), rate, number });
            (rate, number) = (rate + 3, number + 4);
        }
        ranges.push((start.0..rate, start.1..number));
        all.push(factors);
    }
    (all, ranges)
}

/// Checks the number of inertias.
fn expect_inertias(
    mechanism: &Mechanism<f64>,
    inertias: &[Option<MassProperties>],
) -> Result<(), Error> {
    let (expected, found) = (mechanism.bodies().len(), inertias.len());
    if expected == found {
        return Ok(());
    }
    let expected = format!("{expected} inertias");
    Err(Error::Shape { what: "the tree", expected, found: found.to_string() })
}

/// The quaternion with the numbers `w, x, y, z`, which need not be normalized.
fn rotation(numbers: &[f64]) -> UnitQuaternion<f64> {
    So3.from_coordinates(&Vector4::new(numbers[1], numbers[2], numbers[3], numbers[0]))
}

/// The numbers `w, x, y, z` of the coordinates `x, y, z, w` of a quaternion.
fn in_order(coordinates: &Vector4<f64>) -> [f64; 4] {
    let [x, y, z, w] = (*coordinates).into();
    [w, x, y, z]
}

fn invalid(reason: String) -> Error {
    Error::Invalid { what: "tree", reason }
}
