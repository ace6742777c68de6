//! Kinematics: motions `g' = g Omega(t)` with a prescribed velocity.

use crate::Error;
use crate::group::{AnyGroup, Coordinates, LieGroup};
use crate::mechanics::formula::Formula;
use crate::mechanics::integrators::{KinematicState, PrescribedVelocity};
use crate::mechanics::simulation::group::{GroupVisitor, SimulationGroup, element, visit};
use crate::mechanics::simulation::methods::Method;
use crate::mechanics::simulation::motion::{Motion, ObservedMotion, simulation};
use crate::mechanics::simulation::observables::{
    Buffers, ColumnFormulas, Observables, ObservationPoint,
};
use crate::mechanics::simulation::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use crate::mechanics::simulation::stepper::Stepper;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::Range;

/// A prescribed velocity. Its components are formulas of `t` and the parameters.
#[derive(Clone, Debug, Default)]
pub struct VelocityFormulas {
    scope: FormulaScope,
    formulas: Vec<Formula>,
    buffers: RefCell<Buffers>,
}

impl VelocityFormulas {
    /// Adds the formula of the next component.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains names other than `t`
    /// and parameters.
    pub fn add(&mut self, text: &str, names: &SymbolTable) -> Result<(), ExpressionError> {
        let allowed =
            |quantity| matches!(quantity, MotionQuantity::Time | MotionQuantity::Parameter(_));
        self.formulas.push(self.scope.read(text, names, &allowed)?);
        Ok(())
    }

    fn at<V: Coordinates>(&self, time: f64) -> V {
        let Buffers { values, workspace, .. } = &mut *self.buffers.borrow_mut();
        self.scope.evaluate(|_| time, values);
        V::from_fn(self.formulas.len(), |i| self.formulas[i].value_in(values, workspace))
    }
}

/// The specification of a motion with a prescribed velocity. The group is a separate argument.
pub struct PrescribedVelocitySpec {
    /// The velocity, in the frame of the equations.
    pub velocity: VelocityFormulas,
    /// The names of quantities.
    pub observables: Observables,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element.
    pub element: DVector<f64>,
    /// The method, which must belong to [`Class::PrescribedVelocity`](super::super::Class).
    pub method: Method,
    /// The largest step size.
    pub step: f64,
    /// The columns.
    pub columns: ColumnFormulas,
}

impl PrescribedVelocitySpec {
    /// Starts the motion on a group.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the method belongs to another class.
    pub fn start(self, group: &AnyGroup) -> Result<Box<dyn Motion>, Error> {
        visit(group, self)
    }
}

impl GroupVisitor for PrescribedVelocitySpec {
    type Output = Result<Box<dyn Motion>, Error>;

    fn visit<G: SimulationGroup>(self, group: &G) -> Self::Output {
        let magnus = self.method.magnus();
        let magnus = magnus.ok_or_else(|| self.method.refused("it is not for a velocity"))?;
        let start = KinematicState { time: self.time, element: element(group, &self.element) };
        let formulas = self.velocity.clone();
        let velocity: Rate<G> = Box::new(move |time| formulas.at(time));
        let moving = Moving {
            system: PrescribedVelocity { group: group.clone(), velocity },
            velocity: self.velocity,
            observables: self.observables,
            columns: self.columns,
            buffers: RefCell::default(),
        };
        Ok(simulation(moving, start, Stepper::fixed(magnus, self.step)))
    }
}

type Rate<G> = Box<dyn Fn(f64) -> <G as LieGroup>::Vector + Send>;

/// The motion, with the values of its columns.
struct Moving<G: LieGroup> {
    system: PrescribedVelocity<G, Rate<G>>,
    velocity: VelocityFormulas,
    observables: Observables,
    columns: ColumnFormulas,
    buffers: RefCell<Buffers>,
}

impl<G: SimulationGroup> ObservedMotion for Moving<G> {
    type System = PrescribedVelocity<G, Rate<G>>;

    fn system(&self) -> &Self::System {
        &self.system
    }

    fn set_time(&self, state: &mut KinematicState<G>, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len()
    }

    fn values(&self, state: &KinematicState<G>, range: Range<usize>, list: &mut Vec<f64>) {
        let velocity: G::Vector = self.velocity.at(state.time);
        let point = ObservationPoint::new(state.time, &state.element, &velocity);
        let (group, buffers) = (&self.system.group, &mut *self.buffers.borrow_mut());
        self.columns.values(range, group, &self.observables, &point, &|_| 0.0, buffers, list);
    }
}
