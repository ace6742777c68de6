//! Inverse dynamics: the joint forces of given accelerations, by the recursion of Newton and Euler.

use super::MovingTree;
use super::moving::coadjoint_bracket;
use crate::group::{LieGroup, Se3};

impl MovingTree {
    /// The joint forces that cause these accelerations, at the configuration and the rates of
    /// [`place`](Self::place). With the rates `v` and their time derivatives `a`,
    ///
    /// ```text
    /// A = Ad_(X^-1) A_before + S a + [V, S v]
    /// F = J A - ad*_V J V - F_load + sum Ad*_(X^-1) F_after,   force = S . F
    /// ```
    ///
    /// ```
    /// # use affinor::mechanics::MassProperties;
    /// # use affinor::mechanism::{Joint, Mechanism, MovingTree, Tree};
    /// # use nalgebra::Vector3;
    /// # let lift = Joint::prismatic(&[0.0, 0.0, 1.0])?.between("lift", [0, 1]);
    /// # let names = ["ground", "cabin"].map(String::from).to_vec();
    /// # let mechanism = Mechanism::new(names, &[0], vec![lift])?;
    /// # let cabin = MassProperties::ball(1.0)?.of_mass(800.0)?;
    /// // a lift of 800 kg that accelerates upwards with 1 m/s^2
    /// let tree = Tree::new(&mechanism, &[None, Some(cabin)], &Vector3::new(0.0, 0.0, -9.81))?;
    /// let mut moving = MovingTree::new(tree.into());
    /// let mut force = [0.0];
    /// moving.inverse(&[1.0], &mut force);
    /// assert!((force[0] - 800.0 * 10.81).abs() < 1e-11);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn inverse(&mut self, accelerations: &[f64], forces: &mut [f64]) {
        let rise = self.rise();
        for (at, node) in self.tree.nodes.iter().enumerate() {
            let before = node.parent.map_or(rise, |parent| self.nodes[parent].acceleration);
            let own = &mut self.nodes[at];
            let mut acceleration = own.carried(&before);
            for k in node.rates.clone() {
                acceleration += self.tree.twists[k] * accelerations[k];
            }
            own.acceleration = acceleration;
            let momentum = node.inertia * own.velocity;
            own.wrench = node.inertia * acceleration
                - coadjoint_bracket(&own.velocity, &momentum)
                - own.load;
        }
        for (at, node) in self.tree.nodes.iter().enumerate().rev() {
            let wrench = self.nodes[at].wrench;
            for k in node.rates.clone() {
                forces[k] = self.tree.twists[k].dot(&wrench);
            }
            if let Some(parent) = node.parent {
                let carried = Se3.coadjoint(&self.nodes[at].back, &wrench);
                self.nodes[parent].wrench += carried;
            }
        }
    }
}
