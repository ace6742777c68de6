//! Systems with constraints as motions.

use super::pace::Pace;
use super::quantities::{Names, Quantity, Scope};
use super::{Forces, Motion, Point, Simulated, Snapshot};
use crate::Error;
use crate::dynamics::constrained::ConstrainedState;
use crate::dynamics::{Constrained, Constraint, GeneralisedAlpha, Integrator};
use crate::formula::Formula;
use crate::group::Coordinates;
use affinor_tensors::expression::ExpressionError;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Equations `Phi(g) = 0`, by formulas of the entries of the element and the parameters.
#[derive(Clone, Debug)]
pub struct Equations<G: Simulated> {
    group: G,
    scope: Scope,
    formulas: Vec<Formula>,
    parameters: Vec<f64>,
    generators: Vec<DMatrix<f64>>,
}

impl<G: Simulated> Equations<G> {
    /// None yet.
    pub fn new(group: G, parameters: Vec<f64>) -> Self {
        let generators = group.generators();
        Equations { group, scope: Scope::default(), formulas: vec![], parameters, generators }
    }

    /// Adds an equation, what has to be zero.
    ///
    /// # Errors
    /// As [`Formula::parse`].
    pub fn add(&mut self, text: &str, names: &Names) -> Result<(), ExpressionError> {
        let allowed = |quantity| matches!(quantity, Quantity::Parameter(_) | Quantity::Entry(..));
        self.formulas.push(self.scope.read(text, names, &allowed)?);
        Ok(())
    }

    fn values(&self, element: &DMatrix<f64>) -> Vec<f64> {
        let value = |quantity: &Quantity| match *quantity {
            Quantity::Parameter(k) => self.parameters[k],
            Quantity::Entry(i, j) => element[(i, j)],
            _ => f64::NAN,
        };
        self.scope.quantities().iter().map(value).collect()
    }
}

impl<G: Simulated> Constraint<G> for Equations<G> {
    fn value(&self, element: &G::Element) -> DVector<f64> {
        let values = self.values(&self.group.write(element));
        DVector::from_iterator(self.formulas.len(), self.formulas.iter().map(|f| f.value(&values)))
    }

    fn gradient(&self, element: &G::Element) -> DMatrix<f64> {
        let values = self.values(&self.group.write(element));
        let fields = self.group.slopes(element, &self.generators);
        let rows = self.formulas.iter().map(|f| self.scope.along_fields(f, &values, &fields).1);
        let entries: Vec<f64> = rows.flatten().collect();
        DMatrix::from_row_slice(self.formulas.len(), fields.len(), &entries)
    }
}

/// The system of a [`Constrained`] motion.
pub type ConstrainedSystem<G> = Constrained<G, Equations<G>, Forces<G>>;

/// The motion from an element with a velocity in the frame of the equations. Rows have the values of the first `visible`
/// formulas, the multipliers, how far the constraints are violated, and the values of the other formulas.
///
/// # Errors
/// As [`Constrained::state`].
pub fn on_constraints<G: Simulated>(
    system: ConstrainedSystem<G>,
    (time, element, velocity): (f64, G::Element, G::Vector),
    step: f64,
    columns: (Scope, Vec<Formula>),
    visible: usize,
) -> Result<Box<dyn Motion>, Error> {
    let state = system.state(time, element, &velocity)?;
    let pace = Pace::new(step);
    Ok(Box::new(OnConstraints { system, state, pace, steps: 0, columns, visible }))
}

struct OnConstraints<G: Simulated> {
    system: ConstrainedSystem<G>,
    state: ConstrainedState<G>,
    pace: Pace,
    steps: u64,
    columns: (Scope, Vec<Formula>),
    visible: usize,
}

/// The numbers of [`OnConstraints`].
#[derive(Serialize, Deserialize)]
struct Saved<E> {
    time: f64,
    element: E,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    multipliers: Vec<f64>,
    lead: Option<Vec<f64>>,
    pace: Pace,
    steps: u64,
}

impl<G: Simulated> Motion for OnConstraints<G> {
    fn time(&self) -> f64 {
        self.state.time
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        if self.state.time != until {
            let OnConstraints { system, state, pace, .. } = self;
            let method = GeneralisedAlpha::default();
            let time = state.time;
            // that of an earlier step is none now
            let _ = system.force().trouble();
            let reached = pace.step(time, until, |h| method.step(system, state, h));
            state.time = reached.map_err(|error| match system.force().trouble() {
                Some(reason) => Error::Integration { t: time, reason },
                None => error,
            })?;
            self.steps = self.steps.saturating_add(1);
        }
        Ok(self.state.time == until)
    }

    fn row(&self) -> Vec<f64> {
        let ConstrainedState { time, element, velocity, multipliers, .. } = &self.state;
        let (scope, formulas) = &self.columns;
        let values = scope.values(self.system.force(), &Point::new(*time, element, velocity));
        let mut row: Vec<f64> = formulas.iter().map(|formula| formula.value(&values)).collect();
        let held = multipliers.iter().copied().chain([self.system.violation(&self.state)]);
        row.splice(self.visible..self.visible, held);
        row
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn save(&self) -> Result<Snapshot, Error> {
        let ConstrainedState { time, element, velocity, acceleration, multipliers, lead } =
            &self.state;
        Snapshot::of(&Saved {
            time: *time,
            element,
            velocity: velocity.components().to_vec(),
            acceleration: acceleration.components().to_vec(),
            multipliers: multipliers.as_slice().to_vec(),
            lead: lead.as_ref().map(|lead| lead.components().to_vec()),
            pace: self.pace,
            steps: self.steps,
        })
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let saved: Saved<G::Element> = snapshot.read()?;
        let n = self.system.group().dimension();
        let lengths = [Some(&saved.velocity), Some(&saved.acceleration), saved.lead.as_ref()];
        let fits = lengths.into_iter().flatten().all(|list| list.len() == n)
            && self.system.group().has_shape(&saved.element)
            && self.pace.fits(&saved.pace);
        if !fits || saved.multipliers.len() != self.state.multipliers.len() {
            return Err(Error::Snapshot { reason: "it is of another motion".into() });
        }
        let vector = |list: &Vec<f64>| G::Vector::from_components(list);
        self.state = ConstrainedState {
            time: saved.time,
            element: saved.element,
            velocity: vector(&saved.velocity),
            acceleration: vector(&saved.acceleration),
            multipliers: DVector::from_vec(saved.multipliers),
            lead: saved.lead.as_ref().map(vector),
        };
        (self.pace, self.steps) = (saved.pace, saved.steps);
        Ok(())
    }
}
