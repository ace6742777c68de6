//! Motions of trees of bodies, with joint coordinates as the state.

use crate::Error;
use crate::group::{MatrixNotation, Se3};
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanics::integrators::{TreeScheme, TreeSteps};
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{ObservedMotion, Started, simulation};
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::systems::tree::{TreeState, TreeSystem};
use nalgebra::{DVector, Vector3};
use std::cell::RefCell;
use std::ops::Range;

/// The specification of a motion of a tree.
pub struct TreeSpec {
    /// The tree with its forces.
    pub system: TreeSystem,
    /// The initial time.
    pub time: f64,
    /// The initial numbers and rates; see [`TreeState`].
    pub numbers: DVector<f64>,
    /// The method and its settings.
    pub integration: Integration,
    /// The columns.
    pub columns: TreeColumns,
}

/// The columns of a motion of a tree, as formulas in its quantities.
///
/// The quantities begin with the time, the numbers, the rates, and the joint forces without gravity.
/// Then follow the kinetic energy, the potential, the energy and the power. The next six quantities
/// are the momentum about the origin of the ground. Then follow the largest violation of a
/// constraint, all multipliers, and six components of the
/// [reaction](crate::mechanism::MovingTree::reaction) of each joint that has freedom. Then follow, for
/// each body in `bodies`, the named coordinates of its pose and the entries of its matrix, row by row
/// without the last row. The last quantities are the velocities of these bodies in their frames, six
/// components each.
#[derive(Clone, Debug, Default)]
pub struct TreeColumns {
    /// The bodies whose poses are quantities.
    pub bodies: Vec<usize>,
    /// The points of the moments of reactions, one for each joint; see
    /// [`reaction`](crate::mechanism::MovingTree::reaction).
    pub points: Vec<Vector3<f64>>,
    /// The formulas of the columns.
    pub formulas: Vec<Formula>,
}

impl TreeColumns {
    /// The index of the power, counted from the first joint force.
    const fn power(freedom: usize) -> usize {
        freedom + 3
    }

    /// The number of quantities from the joint forces to the violation.
    pub const fn loads(freedom: usize) -> usize {
        freedom + 11
    }

    /// The number of quantities of a pose: seven named coordinates and twelve entries.
    pub const POSE: usize = 19;
}

impl TreeSpec {
    /// Starts the motion.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the method belongs to another class.
    pub fn start(self) -> Result<Started, Error> {
        let method = self.integration.method.unwrap_or(Method::DormandPrince853);
        let scheme = match method {
            Method::DormandPrince853 => TreeScheme::DormandPrince,
            Method::Radau5 => TreeScheme::Radau,
            _ => {
                let names = Method::names_of(&[Class::Chart, Class::Tree]);
                return Err(method.refused(&format!("joint coordinates need one of {names}")));
            }
        };
        self.integration.step_of(method)?;
        let state = TreeState { time: self.time, numbers: self.numbers };
        let control = TreeSteps { scheme, control: self.integration.control };
        let first = control.first_step(&self.system, &state);
        if let Some(reason) = self.system.take_trouble() {
            return Err(Error::Invalid { what: "state", reason });
        }
        let step = move |system: &TreeSystem, state: &mut TreeState, next: &mut f64, end| {
            control.step(system, state, next, end)
        };
        let stepper = Stepper::by(step, control.control.max_steps, first);
        let (columns, buffers) = (self.columns, RefCell::default());
        let moving = Moving::new(self.system, columns, buffers);
        Ok(Started { motion: simulation(moving, state, stepper), method })
    }
}

/// The motion, with the values of its columns.
struct Moving {
    system: TreeSystem,
    columns: TreeColumns,
    /// The number of multipliers, and of components of reactions.
    reactions: [usize; 2],
    /// Whether a column contains a reaction, or the power of a constraint.
    has_reactions: bool,
    buffers: RefCell<(Vec<f64>, Workspace)>,
}

impl Moving {
    fn new(
        system: TreeSystem,
        columns: TreeColumns,
        buffers: RefCell<(Vec<f64>, Workspace)>,
    ) -> Self {
        let tree = system.tree();
        let multipliers = system.multipliers();
        let joints = (0..columns.points.len()).filter(|joint| !tree.rates(*joint).is_empty());
        let reactions = [multipliers, 6 * joints.count()];
        let forces = 1 + tree.home().len() + tree.freedom();
        let power = forces + TreeColumns::power(tree.freedom());
        let first = forces + TreeColumns::loads(tree.freedom());
        let listed = first..first + reactions[0] + reactions[1];
        let is_reaction = |k: &usize| listed.contains(k) || (multipliers > 0 && *k == power);
        let has_reactions =
            columns.formulas.iter().any(|formula| formula.variables().iter().any(is_reaction));
        Moving { system, columns, reactions, has_reactions, buffers }
    }

    /// Replaces `values` by the quantities at a state.
    fn quantities(&self, state: &TreeState, values: &mut Vec<f64>) {
        let system = &self.system;
        values.clear();
        values.push(state.time);
        values.extend(state.numbers.iter());
        values.extend(system.forces(state));
        let (kinetic, momentum) = system.at(state, |moving| (moving.kinetic(), moving.momentum()));
        let potential = system.potential(state);
        let [multipliers, components] = self.reactions;
        let wanted = self.has_reactions.then(|| system.reactions(state, &self.columns.points));
        let driven = wanted.as_ref().map_or(0.0, |found| match found {
            Some(found) => found.power,
            None => f64::NAN,
        });
        let power = system.power(state) + driven;
        values.extend([kinetic, potential, kinetic + potential, power]);
        values.extend(momentum.iter());
        values.push(system.violation(state));
        match wanted.flatten() {
            Some(found) => {
                values.extend(found.multipliers.iter());
                found.joints.iter().flatten().for_each(|wrench| values.extend(wrench.iter()));
            }
            None => values.resize(values.len() + multipliers + components, f64::NAN),
        }
        if self.columns.bodies.is_empty() {
            return;
        }
        let poses = system.at(state, |moving| moving.poses());
        for body in &self.columns.bodies {
            let pose = &poses[*body];
            values.extend((0..Se3.names().len()).map(|k| Se3.named(pose, k)));
            let matrix = pose.to_homogeneous();
            values.extend((0..12).map(|at| matrix[(at / 4, at % 4)]));
        }
        let velocities = system.at(state, |moving| moving.velocities());
        self.columns.bodies.iter().for_each(|body| values.extend(velocities[*body].iter()));
    }
}

impl ObservedMotion for Moving {
    type System = TreeSystem;

    fn system(&self) -> &TreeSystem {
        &self.system
    }

    fn set_time(&self, state: &mut TreeState, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len()
    }

    fn values(&self, state: &TreeState, columns: Range<usize>, list: &mut Vec<f64>) {
        let (values, workspace) = &mut *self.buffers.borrow_mut();
        self.quantities(state, values);
        let formulas = &self.columns.formulas[columns];
        list.extend(formulas.iter().map(|formula| formula.value_in(values, workspace)));
    }

    fn rate(&self, state: &TreeState) -> f64 {
        self.system.rate(state)
    }

    fn take_trouble(&self) -> Option<String> {
        self.system.take_trouble()
    }
}
