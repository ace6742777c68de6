//! Forward dynamics: the accelerations of given joint forces, by the recursion of articulated
//! bodies.

use super::MovingTree;
use super::composite::carried;
use super::moving::{Eliminated, coadjoint_bracket};
use crate::Error;
use crate::group::{LieGroup, Se3};

impl MovingTree {
    /// The accelerations, which are the time derivatives of the rates, for joint forces, at the
    /// configuration and the rates of [`place`](Self::place).
    ///
    /// # Errors
    /// [`Error::Invalid`] if a body resists no motion of a joint, or for numbers that are not
    /// finite.
    ///
    /// # Panics
    /// Panics if a list is too short.
    pub fn forward(&mut self, forces: &[f64], accelerations: &mut [f64]) -> Result<(), Error> {
        self.reduce(forces).map_err(|rate| {
            super::invalid(format!(
                "the inertia for rate {} is {:e}, which is not positive",
                rate + 1,
                self.eliminated[rate].inertia
            ))
        })?;
        let rise = self.rise();
        for (at, node) in self.tree.nodes.iter().enumerate() {
            let before = node.parent.map_or(rise, |parent| self.nodes[parent].acceleration);
            let own = &mut self.nodes[at];
            let mut acceleration = own.carried(&before);
            // the rate that was eliminated last is the closest to the ground
            for k in node.rates.clone().rev() {
                let Eliminated { momentum, inertia, force } = &self.eliminated[k];
                accelerations[k] = (force - momentum.dot(&acceleration)) / inertia;
                acceleration += self.tree.twists[k] * accelerations[k];
            }
            own.acceleration = acceleration;
        }
        Ok(())
    }

    /// Eliminates the rates from the last node to the first. The inertia `I` and the wrench `p` of
    /// an articulated body begin as those of its node, `I = J` and `p = -ad*_V J V - F_load`. A rate with the
    /// twist `S` and the force `f` changes them by
    ///
    /// ```text
    /// I - I S (I S)^T/(S . I S),     p + I S (f - S . p)/(S . I S)
    /// ```
    ///
    /// Then they are carried to the node before, `p` with the acceleration `[V, S v]` of the joint.
    /// The error is a rate without inertia.
    pub(super) fn reduce(&mut self, forces: &[f64]) -> Result<(), usize> {
        for (node, own) in self.tree.nodes.iter().zip(&mut self.nodes) {
            own.inertia = node.inertia;
            let momentum = node.inertia * own.velocity;
            own.wrench = -coadjoint_bracket(&own.velocity, &momentum) - own.load;
        }
        for (at, node) in self.tree.nodes.iter().enumerate().rev() {
            let own = &mut self.nodes[at];
            for k in node.rates.clone() {
                let twist = &self.tree.twists[k];
                let momentum = own.inertia * twist;
                let inertia = twist.dot(&momentum);
                let force = forces[k] - twist.dot(&own.wrench);
                self.eliminated[k] = Eliminated { momentum, inertia, force };
                // rounding errors of a singular inertia are not positive inertia
                let size = own.inertia.diagonal().dot(&twist.component_mul(twist));
                if inertia.is_nan() || inertia <= 8.0 * f64::EPSILON * size {
                    return Err(k);
                }
                let share = momentum / inertia;
                own.inertia -= share * momentum.transpose();
                own.wrench += share * force;
            }
            if let Some(parent) = node.parent {
                let bias = Se3.bracket(&own.velocity, &own.relative);
                let wrench = Se3.coadjoint(&own.back, &(own.wrench + own.inertia * bias));
                let inertia = carried(&own.inertia, &own.pose);
                self.nodes[parent].wrench += wrench;
                self.nodes[parent].inertia += inertia;
            }
        }
        Ok(())
    }
}
