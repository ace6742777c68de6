//! Motions of trees of bodies, with joint coordinates as the state.

use super::System;
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanism::{MovingTree, Tree};
use nalgebra::DVector;
use std::cell::RefCell;
use std::sync::Arc;

/// A state of a tree: the time, and the numbers of the configuration followed by the rates; see
/// [`Tree`].
#[derive(Clone, Debug, PartialEq)]
pub struct TreeState {
    /// The time.
    pub time: f64,
    /// The numbers, then the rates.
    pub numbers: DVector<f64>,
}

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

/// A joint force as a formula, which acts along one rate.
#[derive(Clone, Debug)]
pub struct JointForce {
    /// The index of the rate.
    pub rate: usize,
    /// The formula. Its variables are the time, the numbers and the rates, in this order.
    pub formula: Formula,
    /// The text of the formula, for messages.
    pub text: String,
}

/// A tree with gravity, springs, dampers and joint forces.
#[derive(Clone, Debug)]
pub struct TreeSystem {
    tree: Arc<Tree>,
    springs: Vec<JointSpring>,
    forces: Vec<JointForce>,
    buffers: RefCell<Buffers>,
}

#[derive(Clone, Debug)]
struct Buffers {
    moving: MovingTree,
    variables: Vec<f64>,
    forces: Vec<f64>,
    workspace: Workspace,
    /// The reason why the last slope is not a number.
    trouble: Option<String>,
}

impl TreeSystem {
    /// A tree with springs and joint forces.
    pub fn new(tree: Arc<Tree>, springs: Vec<JointSpring>, forces: Vec<JointForce>) -> Self {
        let buffers = Buffers {
            moving: MovingTree::new(tree.clone()),
            variables: vec![],
            forces: vec![],
            workspace: Workspace::default(),
            trouble: None,
        };
        TreeSystem { tree, springs, forces, buffers: buffers.into() }
    }

    /// The tree.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Whether gravity and springs are the only forces, so that the energy is conserved.
    pub fn is_conservative(&self) -> bool {
        self.forces.is_empty() && self.springs.iter().all(|spring| spring.damping == 0.0)
    }

    /// The time derivative of the numbers and the rates. It is NaN if a force is not finite.
    pub(in crate::mechanics) fn slope(&self, time: f64, y: &DVector<f64>) -> DVector<f64> {
        let split = y.len() - self.tree.freedom();
        let (numbers, rates) = y.as_slice().split_at(split);
        let mut slope = DVector::zeros(y.len());
        let (slopes, accelerations) = slope.as_mut_slice().split_at_mut(split);
        let mut buffers = self.buffers.borrow_mut();
        self.sum(time, y.as_slice(), &mut buffers);
        let Buffers { moving, forces, trouble, .. } = &mut *buffers;
        self.tree.slopes(numbers, rates, slopes);
        moving.place(numbers, rates);
        if let Err(error) = moving.forward(forces, accelerations) {
            *trouble = trouble.take().or_else(|| Some(error.to_string()));
            accelerations.fill(f64::NAN);
        }
        slope
    }

    /// Computes the joint forces of springs, dampers and formulas.
    fn sum(&self, time: f64, y: &[f64], buffers: &mut Buffers) {
        let Buffers { variables, forces, workspace, trouble, .. } = buffers;
        let split = y.len() - self.tree.freedom();
        forces.clear();
        forces.resize(self.tree.freedom(), 0.0);
        for spring in &self.springs {
            let stretch = spring.number.map_or(0.0, |at| y[at] - spring.rest);
            forces[spring.rate] -=
                spring.stiffness * stretch + spring.damping * y[split + spring.rate];
        }
        if self.forces.is_empty() {
            return;
        }
        variables.clear();
        variables.push(time);
        variables.extend_from_slice(y);
        for JointForce { rate, formula, text } in &self.forces {
            let value = formula.value_in(variables, workspace);
            if !value.is_finite() {
                *trouble = Some(format!("the force {text} is {value} at t = {time}"));
            }
            forces[*rate] += value;
        }
    }

    /// The joint forces of springs, dampers and formulas at a state, without gravity.
    pub fn forces(&self, state: &TreeState) -> Vec<f64> {
        let mut buffers = self.buffers.borrow_mut();
        self.sum(state.time, state.numbers.as_slice(), &mut buffers);
        buffers.forces.clone()
    }

    /// The power of the joint forces that have no potential: those of formulas and dampers.
    pub fn power(&self, state: &TreeState) -> f64 {
        let y = state.numbers.as_slice();
        let split = y.len() - self.tree.freedom();
        let mut forces = self.forces(state);
        for spring in &self.springs {
            let stretch = spring.number.map_or(0.0, |at| y[at] - spring.rest);
            forces[spring.rate] += spring.stiffness * stretch;
        }
        forces.iter().zip(&y[split..]).map(|(force, rate)| force * rate).sum()
    }

    /// The potential of gravity and of the springs at a state.
    pub fn potential(&self, state: &TreeState) -> f64 {
        let springs = self.springs.iter().map(|spring| {
            let stretch = spring.number.map_or(0.0, |at| state.numbers[at] - spring.rest);
            0.5 * spring.stiffness * stretch * stretch
        });
        springs.sum::<f64>() + self.at(state, MovingTree::potential)
    }

    /// A value of the tree at a state.
    pub fn at<T>(&self, state: &TreeState, value: impl FnOnce(&MovingTree) -> T) -> T {
        let split = state.numbers.len() - self.tree.freedom();
        let (numbers, rates) = state.numbers.as_slice().split_at(split);
        let moving = &mut self.buffers.borrow_mut().moving;
        moving.place(numbers, rates);
        value(moving)
    }

    /// The largest rate of a coordinate in its unit, or angular velocity of a body.
    pub(in crate::mechanics) fn rate(&self, state: &TreeState) -> f64 {
        let rates = &state.numbers.as_slice()[state.numbers.len() - self.tree.freedom()..];
        let rates = self.tree.units().zip(rates).map(|(unit, rate)| rate.abs() / unit);
        rates.fold(self.at(state, MovingTree::spin), f64::max)
    }

    /// Removes and returns the reason why a slope was not a number.
    pub(in crate::mechanics) fn take_trouble(&self) -> Option<String> {
        self.buffers.borrow_mut().trouble.take()
    }
}

impl System for TreeSystem {
    type State = TreeState;

    fn time(&self, state: &TreeState) -> f64 {
        state.time
    }
}
