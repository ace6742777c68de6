//! Motions of trees of bodies, with joint coordinates as the state.

mod assembly;
pub mod closure;
pub mod constraint;
pub mod contact;
mod linearization;
mod multipliers;
mod reduction;
mod rows;
mod spring;

pub use assembly::{Hold, Unsatisfied, Violator};
pub use closure::Closure;
pub use constraint::{Motor, TreeConstraint};
pub use contact::{Contact, ContactShape};
pub use linearization::Linearization;
pub use spring::{JointSpring, PointSpring};

use super::System;
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanism::tree::GroundView;
use crate::mechanism::{MovingTree, Tree};
use constraint::Place;
use nalgebra::{DVector, Vector3, Vector6};
use reduction::Reduction;
use rows::Rows;
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

/// All forces on a tree except gravity.
#[derive(Clone, Debug, Default)]
pub struct TreeForces {
    /// The springs and dampers of joints.
    pub joint_springs: Vec<JointSpring>,
    /// The springs and dampers between points of bodies.
    pub point_springs: Vec<PointSpring>,
    /// The joint forces that are formulas.
    pub formulas: Vec<JointForce>,
}

/// A tree with gravity, springs, dampers, joint forces and constraints:
///
/// ```text
/// M(q) v' + h(q, v) = f(t, q, v) - G^T lambda,   Phi(t, q) = 0,   G(t, q) v = b(t, q)
/// ```
///
/// `G` contains the derivatives of `Phi`, and the coefficients of constraints on the rates.
/// Constraints may be redundant. Then the accelerations are unique, and the multipliers are those of
/// the smallest norm.
///
/// The state of a stage is first projected onto the constraints, in the metric of the kinetic
/// energy. So redundant constraints remain consistent, and steps pass through singular positions.
#[derive(Clone, Debug)]
pub struct TreeSystem {
    tree: Arc<Tree>,
    forces: TreeForces,
    constraints: Vec<TreeConstraint>,
    buffers: RefCell<Buffers>,
}

#[derive(Clone, Debug)]
struct Buffers {
    moving: MovingTree,
    view: GroundView,
    variables: Vec<f64>,
    forces: Vec<f64>,
    workspace: Workspace,
    /// The reason why the last slope is not a number.
    trouble: Option<String>,
}

/// The forces of the constraints of a tree at a state.
#[derive(Clone, Debug)]
pub struct TreeReactions {
    /// The multipliers `lambda`, in the order of the constraints.
    pub multipliers: DVector<f64>,
    /// For each joint the [reaction](MovingTree::reaction), `None` for a joint without freedom.
    pub joints: Vec<Option<Vector6<f64>>>,
    /// The power `-lambda . b` of constraints that depend on the time.
    pub power: f64,
}

/// The largest number of iterations of a projection onto the constraints.
const ITERATIONS: usize = 40;
/// The largest last change of a successful projection, in the units of [`Tree::units`].
const NEAR: f64 = 1e-8;
/// A change that is a rounding error.
const STILL: f64 = 1e-14;
/// The largest violation of a constraint by the rates, relative to the size of its terms. It is larger
/// than [`NEAR`], because constraints that are nearly dependent are left out.
const TORN: f64 = 1e-5;

impl TreeSystem {
    /// A tree with forces and constraints.
    pub fn new(tree: Arc<Tree>, forces: TreeForces, constraints: Vec<TreeConstraint>) -> Self {
        let buffers = Buffers {
            moving: MovingTree::new(tree.clone()),
            view: GroundView::default(),
            variables: vec![],
            forces: vec![],
            workspace: Workspace::default(),
            trouble: None,
        };
        TreeSystem { tree, forces, constraints, buffers: buffers.into() }
    }

    /// The tree.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The number of multipliers, which is the number of equations of all constraints.
    pub fn multipliers(&self) -> usize {
        self.constraints.iter().map(TreeConstraint::count).sum()
    }

    /// Whether the energy is conserved: gravity and springs are the only forces, and no constraint
    /// is a motor or a formula, which may depend on the time.
    pub fn is_conservative(&self) -> bool {
        let TreeForces { joint_springs, point_springs, formulas } = &self.forces;
        let is_formula = |constraint: &TreeConstraint| {
            !matches!(constraint, TreeConstraint::Closure(_) | TreeConstraint::Contact(_))
        };
        formulas.is_empty()
            && joint_springs.iter().all(|spring| spring.damping == 0.0)
            && point_springs.iter().all(|spring| spring.damping == 0.0)
            && !self.constraints.iter().any(is_formula)
    }

    /// The time derivative of the numbers and the rates. It is NaN if a force is not finite.
    pub(in crate::mechanics) fn slope(&self, time: f64, y: &DVector<f64>) -> DVector<f64> {
        let split = y.len() - self.tree.freedom();
        let mut slope = DVector::zeros(y.len());
        let (slopes, accelerations) = slope.as_mut_slice().split_at_mut(split);
        let mut buffers = self.buffers.borrow_mut();
        if self.constraints.is_empty() {
            let (numbers, rates) = y.as_slice().split_at(split);
            buffers.moving.place(numbers, rates);
            self.sum(time, y.as_slice(), &mut buffers);
            let Buffers { moving, forces, trouble, .. } = &mut *buffers;
            self.tree.slopes(numbers, rates, slopes);
            if let Err(error) = moving.forward(forces, accelerations) {
                *trouble = trouble.take().or_else(|| Some(error.to_string()));
                accelerations.fill(f64::NAN);
            }
            return slope;
        }
        match self.settled(time, y, &mut buffers) {
            Ok(settled) => {
                let (numbers, rates) = settled.y.as_slice().split_at(split);
                self.tree.slopes(numbers, rates, slopes);
                accelerations.copy_from_slice(settled.accelerations().as_slice());
            }
            Err(reason) => {
                buffers.trouble.get_or_insert(reason);
                accelerations.fill(f64::NAN);
            }
        }
        slope
    }

    /// The state on the constraints that is nearest to a state. The parameter `changes` contains
    /// changes of coordinates and of rates, and only their parts along the constraints remain.
    pub(in crate::mechanics) fn projected(
        &self,
        time: f64,
        y: &DVector<f64>,
        changes: &mut [[DVector<f64>; 2]],
    ) -> Result<DVector<f64>, String> {
        if self.constraints.is_empty() {
            let (mut y, split) = (y.clone(), y.len() - self.tree.freedom());
            self.tree.normalize(&mut y.as_mut_slice()[..split]);
            return Ok(y);
        }
        let buffers = &mut *self.buffers.borrow_mut();
        let settled = match self.settled(time, y, buffers) {
            Ok(settled) => settled,
            Err(reason) => {
                buffers.trouble = Some(reason.clone());
                return Err(reason);
            }
        };
        for change in changes.iter_mut().flatten() {
            *change += settled.reduction.shortest(&-settled.rows.product(change));
        }
        Ok(settled.y)
    }

    /// Projects a state onto the constraints, and evaluates forces and constraints there.
    fn settled(
        &self,
        time: f64,
        y: &DVector<f64>,
        buffers: &mut Buffers,
    ) -> Result<Settled, String> {
        let split = y.len() - self.tree.freedom();
        let mut y = y.clone();
        self.tree.normalize(&mut y.as_mut_slice()[..split]);
        let failed = || format!("the constraints cannot be satisfied at t = {time}");
        let singular = || format!("the equations of motion are not finite at t = {time}");
        let units: Vec<f64> = self.tree.units().collect();
        let mut rows = self.rows(time, y.as_slice(), buffers);
        let mut reduction = self.reduction(&rows, buffers).ok_or_else(singular)?;
        let (mut last, mut before) = (f64::INFINITY, f64::INFINITY);
        let mut is_fresh = true;
        for _ in 0..ITERATIONS {
            let change = reduction.shortest(&rows.missing());
            let size = self.tree.largest(&change);
            let is_slow = size.is_nan() || size > 0.1 * last;
            // near a singular position, rounding errors remain
            let is_still = size <= STILL || (size <= NEAR && size > 0.9 * before);
            if is_still && (is_slow || size <= STILL) {
                last = size;
                break;
            }
            if is_slow && !is_fresh {
                reduction = self.reduction(&rows, buffers).ok_or_else(singular)?;
                is_fresh = true;
                (last, before) = (f64::INFINITY, size);
                continue;
            }
            self.tree.displace(&mut y.as_mut_slice()[..split], change.as_slice());
            last = size;
            is_fresh = false;
            rows = self.rows(time, y.as_slice(), buffers);
        }
        let sizes = rows.sizes(&units);
        // constraints that depend on others may contradict them
        let is_torn = rows.values.iter().zip(&sizes).any(|(value, size)| {
            let value = value.unwrap_or(0.0).abs();
            value.is_nan() || value > NEAR * size
        });
        if last.is_nan() || last > NEAR || is_torn {
            return Err(failed());
        }
        if !is_fresh {
            reduction = self.reduction(&rows, buffers).ok_or_else(singular)?;
        }
        let given = y.rows(split, units.len()).into_owned();
        let rates = &given + reduction.shortest(&-rows.residual(&given));
        y.rows_mut(split, units.len()).copy_from(&rates);
        // the time derivatives of the constraints are those for the projected rates
        let rows = self.rows(time, y.as_slice(), buffers);
        let residual = rows.residual(&rates);
        let fastest = self.tree.largest(&given).max(self.tree.largest(&rates));
        let is_torn = residual.iter().zip(&sizes).zip(&rows.right).any(|((off, size), right)| {
            off.is_nan() || off.abs() > TORN * (size * fastest).max(right.abs())
        });
        if is_torn {
            return Err(failed());
        }
        self.sum(time, y.as_slice(), buffers);
        let mut inertial = vec![0.0; units.len()];
        buffers.moving.inverse(&vec![0.0; units.len()], &mut inertial);
        let forces = buffers.forces.iter().zip(&inertial).map(|(force, own)| force - own);
        let forces = DVector::from_iterator(units.len(), forces);
        if !forces.iter().chain(rows.bias.iter()).all(|value| value.is_finite()) {
            return Err(singular());
        }
        Ok(Settled { y, forces, rows, reduction })
    }

    /// The rows of all constraints at a state. The tree is moved to the state.
    fn rows(&self, time: f64, y: &[f64], buffers: &mut Buffers) -> Rows {
        let (numbers, rates) = y.split_at(y.len() - self.tree.freedom());
        let Buffers { moving, view, workspace, .. } = buffers;
        moving.place(numbers, rates);
        view.update(moving);
        let place = Place { tree: &self.tree, view, time, numbers, rates };
        TreeConstraint::rows(&self.constraints, &place, workspace)
    }

    fn reduction(&self, rows: &Rows, buffers: &mut Buffers) -> Option<Reduction> {
        Reduction::new(buffers.moving.mass_factor()?, rows)
    }

    /// Computes the joint forces of springs, dampers and formulas, and the loads of springs between
    /// points, at the state of the tree.
    fn sum(&self, time: f64, y: &[f64], buffers: &mut Buffers) {
        let Buffers { moving, view, variables, forces, workspace, trouble } = buffers;
        let split = y.len() - self.tree.freedom();
        forces.clear();
        forces.resize(self.tree.freedom(), 0.0);
        for spring in &self.forces.joint_springs {
            forces[spring.rate] -= spring.pull(y) + spring.damping * y[split + spring.rate];
        }
        if !self.forces.point_springs.is_empty() {
            moving.unload();
            view.update(moving);
            self.forces.point_springs.iter().for_each(|spring| spring.load(view, moving));
        }
        if self.forces.formulas.is_empty() {
            return;
        }
        variables.clear();
        variables.push(time);
        variables.extend_from_slice(y);
        for JointForce { rate, formula, text } in &self.forces.formulas {
            let value = formula.value_in(variables, workspace);
            if !value.is_finite() {
                *trouble = Some(format!("the force {text} is {value} at t = {time}"));
            }
            forces[*rate] += value;
        }
    }

    /// The joint forces of springs, dampers and formulas at a state, without gravity and without
    /// springs between points.
    pub fn forces(&self, state: &TreeState) -> Vec<f64> {
        let mut buffers = self.buffers.borrow_mut();
        self.sum(state.time, state.numbers.as_slice(), &mut buffers);
        buffers.forces.clone()
    }

    /// The power of the forces that have no potential: those of formulas and dampers.
    pub fn power(&self, state: &TreeState) -> f64 {
        let y = state.numbers.as_slice();
        let split = y.len() - self.tree.freedom();
        let mut forces = self.forces(state);
        for spring in &self.forces.joint_springs {
            forces[spring.rate] += spring.pull(y);
        }
        let of_joints = forces.iter().zip(&y[split..]).map(|(force, rate)| force * rate);
        let of_joints: f64 = of_joints.sum();
        of_joints + self.of_point_springs(state, PointSpring::power)
    }

    /// The potential of gravity and of the springs at a state.
    pub fn potential(&self, state: &TreeState) -> f64 {
        let y = state.numbers.as_slice();
        let joints: f64 = self.forces.joint_springs.iter().map(|spring| spring.potential(y)).sum();
        let points = self.of_point_springs(state, PointSpring::potential);
        joints + self.at(state, MovingTree::potential) + points
    }

    /// The sum of a value of all springs between points, at a state.
    fn of_point_springs(
        &self,
        state: &TreeState,
        value: impl Fn(&PointSpring, &GroundView) -> f64,
    ) -> f64 {
        if self.forces.point_springs.is_empty() {
            return 0.0;
        }
        let mut view = GroundView::default();
        self.at(state, |moving| view.update(moving));
        self.forces.point_springs.iter().map(|spring| value(spring, &view)).sum()
    }

    /// The multipliers, and the reactions of all joints, at a state that satisfies the constraints.
    /// The moment of each reaction is about a point; see [`MovingTree::reaction`]. Returns `None` if
    /// they are not finite.
    pub fn reactions(&self, state: &TreeState, points: &[Vector3<f64>]) -> Option<TreeReactions> {
        let buffers = &mut *self.buffers.borrow_mut();
        let settled = self.settled(state.time, &state.numbers, buffers).ok()?;
        let accelerations = settled.accelerations();
        let multipliers = settled.multipliers();
        if self.forces.point_springs.is_empty() {
            buffers.moving.unload();
        }
        let mut first = 0;
        for constraint in &self.constraints {
            let own = &multipliers.as_slice()[first..first + constraint.count()];
            constraint.load(&buffers.view, own, &mut buffers.moving);
            first += own.len();
        }
        let mut forces = vec![0.0; accelerations.len()];
        buffers.moving.inverse(accelerations.as_slice(), &mut forces);
        let joints = points.iter().enumerate();
        let joints = joints.map(|(joint, point)| buffers.moving.reaction(joint, point)).collect();
        buffers.moving.unload();
        let power = -multipliers.dot(&settled.rows.right);
        multipliers.iter().all(|value| value.is_finite()).then_some(TreeReactions {
            multipliers,
            joints,
            power,
        })
    }

    /// The largest violation of a constraint at a state: of its value for a constraint on the
    /// coordinates, and of `G v - b` for one on the rates only. It is 0 without constraints.
    pub fn violation(&self, state: &TreeState) -> f64 {
        if self.constraints.is_empty() {
            return 0.0;
        }
        let y = &state.numbers;
        let rows = self.rows(state.time, y.as_slice(), &mut self.buffers.borrow_mut());
        let rates = rows.residual(&y.rows_range(y.len() - self.tree.freedom()..).into_owned());
        let violations = rows.values.iter().zip(&rates);
        violations.map(|(value, rate)| value.unwrap_or(*rate).abs()).fold(0.0, f64::max)
    }

    /// The number of independent constraints at a state. Returns `None` if they are not finite.
    pub fn rank(&self, state: &TreeState) -> Option<usize> {
        let mut buffers = self.buffers.borrow_mut();
        let rows = self.rows(state.time, state.numbers.as_slice(), &mut buffers);
        self.reduction(&rows, &mut buffers).map(|reduction| reduction.rank())
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
        self.tree.largest(rates).max(self.at(state, MovingTree::spin))
    }

    /// Removes and returns the reason why a slope was not a number.
    pub(in crate::mechanics) fn take_trouble(&self) -> Option<String> {
        self.buffers.borrow_mut().trouble.take()
    }
}

/// A state that satisfies the constraints, with all forces and constraints.
struct Settled {
    y: DVector<f64>,
    /// The forces `f - h`.
    forces: DVector<f64>,
    rows: Rows,
    reduction: Reduction,
}

impl Settled {
    fn accelerations(&self) -> DVector<f64> {
        self.reduction.nearest(&self.forces, &-&self.rows.bias)
    }

    /// The accelerations without constraints.
    fn unbound(&self) -> DVector<f64> {
        self.reduction.unbound(&self.forces)
    }

    fn multipliers(&self) -> DVector<f64> {
        self.reduction.multipliers(&self.forces, &-&self.rows.bias)
    }
}

impl System for TreeSystem {
    type State = TreeState;

    fn time(&self, state: &TreeState) -> f64 {
        state.time
    }
}
