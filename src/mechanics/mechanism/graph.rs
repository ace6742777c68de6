//! Mechanisms as graphs of bodies and joints, and their independent loops.

use super::joint::Joint;
use super::twist::{Twist, reversed};
use crate::{Error, Ring};
use std::collections::VecDeque;

/// Bodies and joints in an assembled position. The poses of all bodies at this position are the
/// origin of all coordinates.
///
/// ```
/// use affinor::Rational;
/// use affinor::mechanism::{Joint, Mechanism};
/// let axis = [0, 0, 1].map(Rational::from);
/// let at = |x: i64, y: i64| Joint::revolute(&[x, y, 0].map(Rational::from), &axis);
/// let corners = [(0, 0), (0, 1), (2, 1), (2, 0)];
/// let mut joints = vec![];
/// for (k, (x, y)) in corners.into_iter().enumerate() {
///     joints.push(at(x, y)?.between(format!("J{k}"), [k, (k + 1) % 4]));
/// }
/// let names = ["ground", "crank", "rod", "rocker"].map(String::from);
/// let linkage = Mechanism::new(names.to_vec(), &[0], joints)?;
/// assert_eq!((linkage.loops().len(), linkage.kutzbach()), (1, -2));
/// assert_eq!(linkage.mobility()?.verdict.exact(), Some(1));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mechanism<S> {
    bodies: Vec<String>,
    /// Whether each body is fixed to the ground.
    fixed: Vec<bool>,
    joints: Vec<Joint<S>>,
    loops: Vec<Loop>,
}

/// A closed chain of joints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loop {
    /// The joints in the order of the chain; `true` if the chain passes the joint from its first to
    /// its second body.
    pub joints: Vec<(usize, bool)>,
}

impl<S: Ring> Mechanism<S> {
    /// The mechanism of bodies and joints. All bodies in the list `fixed` are fixed to the ground;
    /// if the list is empty, the motion is relative to the first body.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a joint has a body that does not exist, or connects a body with
    /// itself, or if a body is not connected to the ground.
    pub fn new(bodies: Vec<String>, fixed: &[usize], joints: Vec<Joint<S>>) -> Result<Self, Error> {
        let invalid = |reason: String| Error::Invalid { what: "mechanism", reason };
        if bodies.is_empty() {
            return Err(invalid("it has no bodies".into()));
        }
        let count = bodies.len();
        let mut is_fixed = vec![false; count];
        for at in if fixed.is_empty() { &[0] } else { fixed } {
            match is_fixed.get_mut(*at) {
                Some(own) => *own = true,
                None => return Err(invalid(format!("body {} does not exist", at + 1))),
            }
        }
        for joint in &joints {
            let [a, b] = joint.bodies;
            if a >= count || b >= count {
                let missing = a.max(b) + 1;
                let reason = format!("joint `{}` names body {missing} of {count}", joint.name);
                return Err(invalid(reason));
            }
            if a == b || (is_fixed[a] && is_fixed[b]) {
                let reason = format!("joint `{}` connects `{}` with itself", joint.name, bodies[a]);
                return Err(invalid(reason));
            }
        }
        let loops = loops(&is_fixed, &joints)
            .map_err(|at| invalid(format!("no joint connects `{}` to the ground", bodies[at])))?;
        Ok(Mechanism { bodies, fixed: is_fixed, joints, loops })
    }

    /// The number of moving bodies.
    pub fn moving(&self) -> usize {
        self.fixed.iter().filter(|fixed| !**fixed).count()
    }

    /// The count of Gruebler and Kutzbach in space, `6 n - sum (6 - f_j)` for `n` moving bodies and
    /// joints of freedom `f_j`. It is correct for constraints that are independent.
    pub fn kutzbach(&self) -> i64 {
        self.freedom() as i64 - 6 * self.loops.len() as i64
    }

    /// The sum of the freedoms of all joints.
    pub fn freedom(&self) -> usize {
        self.joints.iter().map(Joint::freedom).sum()
    }

    /// The index of the first coordinate of each joint.
    pub fn offsets(&self) -> Vec<usize> {
        let mut next = 0;
        let offset = |joint: &Joint<S>| {
            let own = next;
            next += joint.freedom();
            own
        };
        self.joints.iter().map(offset).collect()
    }

    /// The chain of one-parameter factors of a loop: each with the index of its coordinate, and
    /// its twist with the sign of the direction. The product of the factors is the identity.
    pub fn chain(&self, own: &Loop) -> Vec<(usize, Twist<S>)> {
        let offsets = self.offsets();
        let mut chain = vec![];
        for &(at, forward) in &own.joints {
            let factors = self.joints[at].twists().iter().enumerate();
            let factors = factors.map(|(k, twist)| (offsets[at] + k, twist));
            match forward {
                true => chain.extend(factors.map(|(k, twist)| (k, twist.clone()))),
                false => chain.extend(factors.rev().map(|(k, twist)| (k, reversed(twist)))),
            }
        }
        chain
    }

    /// The velocities of the bodies, as twists in the ground frame, for rates of all joint
    /// coordinates that close the loops.
    ///
    /// # Panics
    /// Panics if there are fewer rates than coordinates.
    pub fn velocities(&self, rates: &[S]) -> Vec<Twist<S>> {
        let still = || -> Twist<S> { std::array::from_fn(|_| S::zero()) };
        let offsets = self.offsets();
        let mut known: Vec<Option<Twist<S>>> =
            self.fixed.iter().map(|fixed| fixed.then(still)).collect();
        // every body is connected to the ground
        while known.iter().any(Option::is_none) {
            for (joint, first) in self.joints.iter().zip(&offsets) {
                let [a, b] = joint.bodies;
                let (from, to, forward) = match (&known[a], &known[b]) {
                    (Some(own), None) => (own.clone(), b, true),
                    (None, Some(own)) => (own.clone(), a, false),
                    _ => continue,
                };
                let mut sum = from;
                for (k, twist) in joint.twists().iter().enumerate() {
                    let twist = if forward { twist.clone() } else { reversed(twist) };
                    for (sum, value) in sum.iter_mut().zip(twist) {
                        *sum = sum.clone() + &(value * &rates[first + k]);
                    }
                }
                known[to] = Some(sum);
            }
        }
        known.into_iter().map(|own| own.unwrap_or_else(still)).collect()
    }

    /// The mechanism over another scalar.
    ///
    /// # Errors
    /// The error of `f`.
    pub fn map<T, E>(&self, f: impl Fn(&S) -> Result<T, E>) -> Result<Mechanism<T>, E> {
        Ok(Mechanism {
            bodies: self.bodies.clone(),
            fixed: self.fixed.clone(),
            joints: self.joints.iter().map(|joint| joint.map(&f)).collect::<Result<_, _>>()?,
            loops: self.loops.clone(),
        })
    }
}

impl<S> Mechanism<S> {
    /// The names of the bodies.
    pub fn bodies(&self) -> &[String] {
        &self.bodies
    }

    /// Whether a body is fixed to the ground.
    ///
    /// # Panics
    /// Panics if the body does not exist.
    pub fn is_fixed(&self, body: usize) -> bool {
        self.fixed[body]
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint<S>] {
        &self.joints
    }

    /// A spanning tree. It is the same as for the [`loops`](Self::loops).
    pub(super) fn spanning(&self) -> Result<Spanning, Error> {
        // all bodies are connected, because the constructor checked it
        Spanning::new(&self.fixed, &self.joints).map_err(|at| {
            let reason = format!("no joint connects `{}` to the ground", self.bodies[at]);
            Error::Invalid { what: "mechanism", reason }
        })
    }

    /// A basis of the loops: one for each joint that does not belong to a spanning tree.
    pub fn loops(&self) -> &[Loop] {
        &self.loops
    }
}

/// A breadth-first spanning tree of the bodies, whose root is the ground.
pub(super) struct Spanning {
    /// For each body except the ground: the body before it, the joint between them, and whether the
    /// joint leads from its first to its second body. All fixed bodies are the ground.
    pub parent: Vec<Option<(usize, usize, bool)>>,
    /// The moving bodies in the order of the search. Each body follows the body before it.
    pub order: Vec<usize>,
    /// Whether each joint belongs to the tree.
    pub in_tree: Vec<bool>,
    /// The index of the ground.
    ground: usize,
}

impl Spanning {
    /// The spanning tree. The error is a body that is not connected.
    fn new<S>(fixed: &[bool], joints: &[Joint<S>]) -> Result<Self, usize> {
        // all fixed bodies are one node
        let ground = fixed.iter().position(|fixed| *fixed).unwrap_or(0);
        let node = |body: usize| if fixed[body] { ground } else { body };
        let mut of_body: Vec<Vec<usize>> = vec![vec![]; fixed.len()];
        for (at, joint) in joints.iter().enumerate() {
            joint.bodies.iter().for_each(|body| of_body[node(*body)].push(at));
        }
        let mut parent: Vec<Option<(usize, usize, bool)>> = vec![None; fixed.len()];
        let mut seen: Vec<bool> = fixed.to_vec();
        let mut in_tree = vec![false; joints.len()];
        let (mut waiting, mut order) = (VecDeque::from([ground]), vec![]);
        while let Some(body) = waiting.pop_front() {
            for &at in &of_body[body] {
                let [a, b] = joints[at].bodies.map(node);
                let (next, forward) = if body == a { (b, true) } else { (a, false) };
                if !seen[next] {
                    (seen[next], in_tree[at]) = (true, true);
                    parent[next] = Some((body, at, forward));
                    order.push(next);
                    waiting.push_back(next);
                }
            }
        }
        match seen.iter().position(|seen| !seen) {
            Some(at) => Err(at),
            None => Ok(Spanning { parent, order, in_tree, ground }),
        }
    }
}

/// The fundamental loops of the spanning tree. The error is a body that is not connected.
fn loops<S>(fixed: &[bool], joints: &[Joint<S>]) -> Result<Vec<Loop>, usize> {
    let Spanning { parent, in_tree, ground, .. } = Spanning::new(fixed, joints)?;
    let node = |body: usize| if fixed[body] { ground } else { body };
    let path = |mut body: usize| {
        let mut path = vec![];
        while let Some((above, joint, forward)) = parent[body] {
            path.push((joint, forward));
            body = above;
        }
        path.reverse();
        path
    };
    let closed = |at: usize| {
        let [a, b] = joints[at].bodies.map(|body| path(node(body)));
        let common = a.iter().zip(&b).take_while(|(first, second)| first == second).count();
        let mut joints = a[common..].to_vec();
        joints.push((at, true));
        joints.extend(b[common..].iter().rev().map(|(joint, forward)| (*joint, !forward)));
        Loop { joints }
    };
    Ok((0..joints.len()).filter(|at| !in_tree[*at]).map(closed).collect())
}
