//! Mechanisms with loops as trees, in which bodies are cut.

use super::Tree;
use crate::Error;
use crate::mechanics::MassProperties;
use crate::mechanism::Mechanism;
use nalgebra::Vector3;

/// A mechanism without loops, made from one with loops. All joints remain.
///
/// A joint that closes a loop leads to a second copy of a body. The mass of the body is shared
/// equally among its copies. So the equations of motion hold for the tree, if the
/// [constraints](crate::mechanics::systems::tree::Closure) hold all copies of a body together.
///
/// ```
/// use affinor::mechanics::MassProperties;
/// use affinor::mechanism::{Cut, Joint, Mechanism};
/// use nalgebra::Vector3;
/// let axis = [0.0, 0.0, 1.0];
/// let mut joints = vec![];
/// for (k, (x, y)) in [(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)].into_iter().enumerate() {
///     let hinge = Joint::revolute(&[x, y, 0.0], &axis)?;
///     joints.push(hinge.between(format!("J{k}"), [k, (k + 1) % 4]));
/// }
/// let names = ["ground", "crank", "rod", "rocker"].map(String::from).to_vec();
/// let linkage = Mechanism::new(names, &[0], joints)?;
/// let ball = MassProperties::ball(0.1)?;
/// let cut = Cut::new(&linkage, &[None, Some(ball), Some(ball), Some(ball)])?;
/// assert_eq!(cut.tree(&Vector3::zeros())?.freedom(), 4);
/// assert_eq!(cut.copies.len(), 1);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cut {
    /// The mechanism without loops. The bodies of the original mechanism come first.
    pub mechanism: Mechanism<f64>,
    /// The inertia of each body, as for [`Tree::new`].
    pub inertias: Vec<Option<MassProperties>>,
    /// For each loop, a body and its copy.
    pub copies: Vec<[usize; 2]>,
}

impl Cut {
    /// Cuts all loops of a mechanism. The inertias are those of [`Tree::new`].
    ///
    /// # Errors
    /// [`Error::Shape`] if the list of inertias has another length; [`Error::Invalid`] if the bodies
    /// of a joint that closes a loop have no mass.
    pub fn new(
        mechanism: &Mechanism<f64>,
        inertias: &[Option<MassProperties>],
    ) -> Result<Self, Error> {
        super::expect_inertias(mechanism, inertias)?;
        let spanning = mechanism.spanning()?;
        let mut names = mechanism.bodies().to_vec();
        let mut joints = mechanism.joints().to_vec();
        let fixed: Vec<usize> = (0..names.len()).filter(|at| mechanism.is_fixed(*at)).collect();
        let mut copies: Vec<[usize; 2]> = vec![];
        for (at, joint) in joints.iter_mut().enumerate() {
            if spanning.in_tree[at] {
                continue;
            }
            let Some(end) = (0..2).rev().find(|end| inertias[joint.bodies[*end]].is_some()) else {
                let reason = format!("the bodies of the joint `{}` have no mass", joint.name);
                return Err(super::invalid(reason));
            };
            let body = joint.bodies[end];
            joint.bodies[end] = names.len();
            copies.push([body, names.len()]);
            names.push(names[body].clone());
        }
        let mut shared = inertias.to_vec();
        shared.resize(names.len(), None);
        for (body, whole) in inertias.iter().enumerate() {
            let own = copies.iter().filter(|copy| copy[0] == body);
            let own: Vec<usize> = own.map(|copy| copy[1]).chain([body]).collect();
            let Some(whole) = whole.filter(|_| own.len() > 1) else { continue };
            let part = whole.of_mass(whole.mass() / own.len() as f64)?;
            own.into_iter().for_each(|copy| shared[copy] = Some(part));
        }
        let mechanism = Mechanism::new(names, &fixed, joints)?;
        Ok(Cut { mechanism, inertias: shared, copies })
    }

    /// The tree of the mechanism, with this acceleration of gravity.
    ///
    /// # Errors
    /// The errors of [`Tree::new`].
    pub fn tree(&self, gravity: &Vector3<f64>) -> Result<Tree, Error> {
        Tree::new(&self.mechanism, &self.inertias, gravity)
    }
}
