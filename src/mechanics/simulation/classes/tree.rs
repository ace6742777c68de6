//! Motions of trees of bodies, with joint coordinates as the state.

use crate::Error;
use crate::group::{MatrixNotation, Se3};
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanics::integrators::TreeSteps;
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{ObservedMotion, Started, simulation};
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::systems::tree::{TreeState, TreeSystem};
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::Range;

/// The specification of a motion of a tree.
pub struct TreeSpec {
    /// The tree with its forces.
    pub system: TreeSystem,
    /// The initial time.
    pub time: f64,
    /// The initial numbers; see [`Tree`](crate::mechanism::Tree).
    pub numbers: Vec<f64>,
    /// The initial rates.
    pub rates: Vec<f64>,
    /// The method and its settings.
    pub integration: Integration,
    /// The columns.
    pub columns: TreeColumns,
}

/// The columns of a motion of a tree, as formulas in its quantities.
///
/// The quantities begin with the time, the numbers, the rates, and the joint forces without gravity.
/// Then follow the kinetic energy, the potential, the energy and the power. The next six quantities
/// are the momentum about the origin of the ground. The last quantities are, for each body in
/// `bodies`, the named coordinates of its pose and the entries of its matrix. They are listed row by
/// row, without the last row.
#[derive(Clone, Debug, Default)]
pub struct TreeColumns {
    /// The bodies whose poses are quantities.
    pub bodies: Vec<usize>,
    /// The formulas of the columns.
    pub formulas: Vec<Formula>,
}

impl TreeColumns {
    /// The number of quantities between the rates and the poses of bodies.
    pub const fn loads(freedom: usize) -> usize {
        freedom + 10
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
        if method.class() != Class::Chart {
            let names = Method::names_of(&[Class::Chart]);
            return Err(method.refused(&format!("joint coordinates need one of {names}")));
        }
        self.integration.step_of(method)?;
        let numbers = DVector::from_vec([self.numbers, self.rates].concat());
        let state = TreeState { time: self.time, numbers };
        let control = TreeSteps(self.integration.control);
        let first = control.first_step(&self.system, &state);
        if let Some(reason) = self.system.take_trouble() {
            return Err(Error::Invalid { what: "state", reason });
        }
        let step = move |system: &TreeSystem, state: &mut TreeState, next: &mut f64, end| {
            control.step(system, state, next, end)
        };
        let stepper = Stepper::by(step, self.integration.control.max_steps, first);
        let (columns, buffers) = (self.columns, RefCell::default());
        let moving = Moving { system: self.system, columns, buffers };
        Ok(Started { motion: simulation(moving, state, stepper), method })
    }
}

/// The motion, with the values of its columns.
struct Moving {
    system: TreeSystem,
    columns: TreeColumns,
    buffers: RefCell<(Vec<f64>, Workspace)>,
}

impl Moving {
    /// Replaces `values` by the quantities at a state.
    fn quantities(&self, state: &TreeState, values: &mut Vec<f64>) {
        let system = &self.system;
        values.clear();
        values.push(state.time);
        values.extend(state.numbers.iter());
        values.extend(system.forces(state));
        let (kinetic, momentum) = system.at(state, |moving| (moving.kinetic(), moving.momentum()));
        let potential = system.potential(state);
        values.extend([kinetic, potential, kinetic + potential, system.power(state)]);
        values.extend(momentum.iter());
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
