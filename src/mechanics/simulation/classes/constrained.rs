//! Euler-Poincare equations with constraints.

mod formulas;

pub use formulas::Constraints;

use super::cotangent::{any_system, spectral_radius_of};
use crate::group::AnyGroup;
use crate::mechanics::simulation::forces::{Forces, ForcesOn};
use crate::mechanics::simulation::group::{GroupVisitor, SimulationGroup, element, vector, visit};
use crate::mechanics::simulation::methods::Method;
use crate::mechanics::simulation::motion::{Motion, ObservedMotion, simulation};
use crate::mechanics::simulation::observables::{Buffers, ColumnFormulas, ObservationPoint};
use crate::mechanics::simulation::quantities::MotionQuantity;
use crate::mechanics::systems::reduced::Reduced;
use crate::mechanics::{Adaptive, Constrained, ConstrainedState, State, System};
use crate::{Connection, Error, Metric};
use formulas::ConstraintsOn;
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::Range;

/// The specification of a motion with constraints. The group is a separate argument.
pub struct ConstrainedSpec<'s> {
    /// The connection `Lambda` in `DH/Dt = M`.
    pub connection: &'s Connection<f64>,
    /// The metric `J`.
    pub metric: &'s Metric<f64>,
    /// The forces.
    pub forces: Forces,
    /// The constraints.
    pub constraints: Constraints,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element.
    pub element: DVector<f64>,
    /// The initial velocity, in the frame of the equations.
    pub velocity: DVector<f64>,
    /// The method, which must belong to [`Class::Constrained`](super::super::Class).
    pub method: Method,
    /// The largest step size.
    pub step: f64,
    /// The formulas of the columns. A row contains the first `visible` formulas, the Lagrange
    /// multipliers, the largest violation of a constraint, and the other formulas.
    pub columns: ColumnFormulas,
    /// The number of formulas before the multipliers.
    pub visible: usize,
}

impl ConstrainedSpec<'_> {
    /// Starts the motion on a group, by a method for constraints.
    ///
    /// # Errors
    /// The errors of [`Constrained::new`] and [`Constrained::state`]; [`Error::Unsupported`] if the
    /// method belongs to another class.
    pub fn start(self, group: &AnyGroup) -> Result<Box<dyn Motion>, Error> {
        visit(group, self)
    }

    /// Starts the motion on a group, by a method for any equations of motion on a group. The
    /// constraints determine the multipliers ([`Reduced`]), and each step is projected onto the
    /// constraints. Methods with step-size control use `control`, which replaces the step.
    ///
    /// # Errors
    /// The errors of [`Constrained::new`], [`Constrained::state`] and [`Reduced::reduced`];
    /// [`Error::Unsupported`] if the method belongs to another class.
    pub fn start_reduced(
        self,
        group: &AnyGroup,
        control: Adaptive,
    ) -> Result<Box<dyn Motion>, Error> {
        // uses the type of all groups, because the solution of linear equations in each stage costs
        // more than its memory
        ReducedSpec { spec: self, control }.visit(group)
    }

    /// The constrained system with its initial state, and the settings of the motion.
    #[allow(clippy::type_complexity, reason = "a system, its state and its settings")]
    fn begin<G: SimulationGroup>(
        self,
        group: &G,
    ) -> Result<(SystemOn<G>, ConstrainedState<G>, Settings), Error> {
        let (forces, constraints) =
            (ForcesOn::new(group, self.forces), ConstraintsOn::new(group, self.constraints));
        let system =
            Constrained::new(group.clone(), self.connection, self.metric, forces, constraints)?;
        let (element, velocity) = (element(group, &self.element), vector(&self.velocity));
        let state = system.state(self.time, element, &velocity).map_err(|error| {
            let trouble = system.force().forces.observables().take_trouble();
            trouble.map_or(error, |reason| Error::Invalid { what: "state", reason })
        })?;
        let ConstrainedSpec { method, step, columns, visible, .. } = self;
        let count = state.multipliers.len() + 1;
        Ok((system, state, Settings { method, step, columns, visible, count }))
    }
}

/// The settings of a motion with constraints.
struct Settings {
    method: Method,
    step: f64,
    columns: ColumnFormulas,
    visible: usize,
    /// The number of columns of the multipliers and the violation.
    count: usize,
}

impl Settings {
    fn moving<S>(self, system: S) -> Moving<S> {
        Moving { system, settings: self, buffers: RefCell::default() }
    }
}

/// A constrained system on a group.
type SystemOn<G> = Constrained<G, ConstraintsOn<G>, ForcesOn<G>>;
/// The same system without multipliers.
type ReducedOn<G> = Reduced<G, ConstraintsOn<G>, ForcesOn<G>>;

impl GroupVisitor for ConstrainedSpec<'_> {
    type Output = Result<Box<dyn Motion>, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Self::Output {
        let (system, state, settings) = self.begin(group)?;
        let method = settings.method;
        let stepper = method.constrained(settings.step);
        let stepper = stepper.ok_or_else(|| method.refused("it is not for constraints"))?;
        Ok(simulation(settings.moving(system), state, stepper))
    }
}

/// A [`ConstrainedSpec`] for a method without constraints.
struct ReducedSpec<'s> {
    spec: ConstrainedSpec<'s>,
    control: Adaptive,
}

impl GroupVisitor for ReducedSpec<'_> {
    type Output = Result<Box<dyn Motion>, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Self::Output {
        let ReducedSpec { spec, control } = self;
        let (connection, metric) = (spec.connection, spec.metric);
        let (system, state, settings) = spec.begin(group)?;
        let system = Reduced::reduced(system, connection, metric)?;
        let start = system.state(state.time, state.element, &state.velocity);
        let method = settings.method;
        let stepper = any_system::<ReducedOn<G>>(group, method, settings.step, control)?;
        let stepper = stepper.ok_or_else(|| method.refused("it is not for constraints"))?;
        let stepper = stepper.followed_by(|system: &ReducedOn<G>, state: &mut State<G>| {
            *state = system.projected(state)?;
            Ok(())
        });
        Ok(simulation(settings.moving(system), start, stepper))
    }
}

/// A system with constraints, with or without multipliers in its state.
trait WithConstraints: System<State: Send> + Send + 'static {
    type Group: SimulationGroup;

    /// The system with multipliers.
    fn constrained(&self) -> &SystemOn<Self::Group>;

    /// Calls a function with the observation point of a state.
    fn at<R>(
        &self,
        state: &Self::State,
        look: impl FnOnce(&ObservationPoint<Self::Group>) -> R,
    ) -> R;

    /// The multipliers of a state. Missing multipliers are not numbers.
    fn multipliers(&self, state: &Self::State) -> DVector<f64>;

    fn set_time(state: &mut Self::State, time: f64);

    /// Begins a step, as in [`ObservedMotion::begin_step`].
    fn begin_step(&self, from: f64, until: f64) -> f64;
}

impl<G: SimulationGroup> WithConstraints for SystemOn<G> {
    type Group = G;

    fn constrained(&self) -> &SystemOn<G> {
        self
    }

    fn at<R>(
        &self,
        state: &ConstrainedState<G>,
        look: impl FnOnce(&ObservationPoint<G>) -> R,
    ) -> R {
        look(&ObservationPoint::new(state.time, &state.element, &state.velocity))
    }

    fn multipliers(&self, state: &ConstrainedState<G>) -> DVector<f64> {
        state.multipliers.clone()
    }

    fn set_time(state: &mut ConstrainedState<G>, time: f64) {
        state.time = time;
    }

    fn begin_step(&self, _: f64, until: f64) -> f64 {
        until
    }
}

impl<G: SimulationGroup> WithConstraints for ReducedOn<G> {
    type Group = G;

    fn constrained(&self) -> &SystemOn<G> {
        self.torque().system()
    }

    fn at<R>(&self, state: &State<G>, look: impl FnOnce(&ObservationPoint<G>) -> R) -> R {
        let velocity = self.velocity(state);
        look(&ObservationPoint::new(state.time, &state.element, &velocity))
    }

    fn multipliers(&self, state: &State<G>) -> DVector<f64> {
        let count = self.constrained().constraint().count();
        Reduced::multipliers(self, state).unwrap_or_else(|| DVector::repeat(count, f64::NAN))
    }

    fn set_time(state: &mut State<G>, time: f64) {
        state.time = time;
    }

    fn begin_step(&self, from: f64, until: f64) -> f64 {
        self.constrained().force().forces.begin_step(from, until)
    }
}

/// The motion, with the values of its columns.
struct Moving<S> {
    system: S,
    settings: Settings,
    buffers: RefCell<Buffers>,
}

impl<S: WithConstraints> ObservedMotion for Moving<S> {
    type System = S;

    fn system(&self) -> &S {
        &self.system
    }

    fn set_time(&self, state: &mut S::State, time: f64) {
        S::set_time(state, time);
    }

    fn column_count(&self) -> usize {
        self.settings.columns.formulas.len() + self.settings.count
    }

    fn values(&self, state: &S::State, range: Range<usize>, list: &mut Vec<f64>) {
        let system = self.system.constrained();
        let (forces, group) = (system.force(), system.group());
        self.system.at(state, |point| {
            let load = |quantity| match quantity {
                MotionQuantity::Potential => forces.potential(point),
                _ => forces.power(point),
            };
            let &Settings { ref columns, visible, count, .. } = &self.settings;
            let behind = visible + count;
            let buffers = &mut *self.buffers.borrow_mut();
            // appends the values of the formulas whose indices are in a range
            let mut formulas = |range: Range<usize>, list: &mut Vec<f64>| {
                let observables = forces.forces.observables();
                columns.values(range, group, observables, point, &load, buffers, list);
            };
            formulas(range.start.min(visible)..range.end.min(visible), list);
            let own = range.start.max(visible)..range.end.min(behind);
            if !own.is_empty() {
                let multipliers = self.system.multipliers(state);
                let violation = || system.violation_at(point.time, point.element, point.velocity);
                list.extend(own.map(|column| {
                    multipliers.get(column - visible).copied().unwrap_or_else(violation)
                }));
            }
            let [start, end] = [range.start, range.end].map(|at| at.max(behind) - count);
            formulas(start..end, list);
        });
    }

    /// The spectral radius of `ad_Omega`.
    fn rate(&self, state: &S::State) -> f64 {
        let group = self.system.constrained().group();
        self.system.at(state, |point| spectral_radius_of(group, point.velocity))
    }

    fn begin_step(&self, from: f64, until: f64) -> f64 {
        self.system.begin_step(from, until)
    }

    fn take_trouble(&self) -> Option<String> {
        self.system.constrained().force().forces.observables().take_trouble()
    }
}
