//! Motions with a velocity that is given over time: `g' = g Omega(t)`.

use super::pace::Pace;
use super::quantities::{Names, Quantity, Scope};
use super::{Forces, Motion, Point, Simulated, Snapshot};
use crate::Error;
use crate::dynamics::Integrator;
use crate::dynamics::integrators::{Linear, Magnus, Place};
use crate::formula::Formula;
use crate::group::Coordinates;
use affinor_tensors::expression::ExpressionError;
use serde::{Deserialize, Serialize};

/// A velocity over time, by formulas of `t` and the parameters.
#[derive(Clone, Debug)]
pub struct GivenVelocity {
    scope: Scope,
    formulas: Vec<Formula>,
    parameters: Vec<f64>,
}

impl GivenVelocity {
    /// Without components yet.
    pub fn new(parameters: Vec<f64>) -> Self {
        GivenVelocity { scope: Scope::default(), formulas: vec![], parameters }
    }

    /// Adds the next component.
    ///
    /// # Errors
    /// As [`Formula::parse`].
    pub fn add(&mut self, text: &str, names: &Names) -> Result<(), ExpressionError> {
        let allowed = |quantity| matches!(quantity, Quantity::Time | Quantity::Parameter(_));
        self.formulas.push(self.scope.read(text, names, &allowed)?);
        Ok(())
    }

    fn at<V: Coordinates>(&self, time: f64) -> V {
        let value = |quantity: &Quantity| match *quantity {
            Quantity::Parameter(k) => self.parameters[k],
            _ => time,
        };
        let values: Vec<f64> = self.scope.quantities().iter().map(value).collect();
        V::from_fn(self.formulas.len(), |i| self.formulas[i].value(&values))
    }
}

/// The motion from an element, by Magnus' method.
pub fn on_given<G: Simulated>(
    group: G,
    velocity: GivenVelocity,
    start: (f64, G::Element),
    (method, step): (Magnus, f64),
    columns: (Scope, Vec<Formula>),
    names: Forces<G>,
) -> Box<dyn Motion> {
    let place = Place { time: start.0, element: start.1 };
    let given = velocity.clone();
    let rate: Box<dyn Fn(f64) -> G::Vector + Send> = Box::new(move |time| given.at(time));
    let system = Linear { group, velocity: rate };
    Box::new(OnGiven {
        system,
        velocity,
        place,
        method,
        pace: Pace::new(step),
        steps: 0,
        columns,
        names,
    })
}

struct OnGiven<G: Simulated> {
    system: Linear<G, Box<dyn Fn(f64) -> G::Vector + Send>>,
    velocity: GivenVelocity,
    place: Place<G>,
    method: Magnus,
    pace: Pace,
    steps: u64,
    columns: (Scope, Vec<Formula>),
    names: Forces<G>,
}

/// The numbers of [`OnGiven`].
#[derive(Serialize, Deserialize)]
struct Saved<E> {
    time: f64,
    element: E,
    pace: Pace,
    steps: u64,
}

impl<G: Simulated> Motion for OnGiven<G> {
    fn time(&self) -> f64 {
        self.place.time
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        if self.place.time != until {
            let OnGiven { system, place, method, pace, .. } = self;
            let time = place.time;
            place.time = pace.step(time, until, |h| method.step(system, place, h))?;
            self.steps = self.steps.saturating_add(1);
        }
        Ok(self.place.time == until)
    }

    fn row(&self) -> Vec<f64> {
        let velocity: G::Vector = self.velocity.at(self.place.time);
        let (time, element) = (self.place.time, &self.place.element);
        let (scope, formulas) = &self.columns;
        let values = scope.values(&self.names, &Point::new(time, element, &velocity));
        formulas.iter().map(|formula| formula.value(&values)).collect()
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn save(&self) -> Result<Snapshot, Error> {
        let Place { time, element } = &self.place;
        Snapshot::of(&Saved { time: *time, element, pace: self.pace, steps: self.steps })
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let saved: Saved<G::Element> = snapshot.read()?;
        if !(self.system.group.has_shape(&saved.element) && self.pace.fits(&saved.pace)) {
            return Err(Error::Snapshot { reason: "it is of another motion".into() });
        }
        self.place = Place { time: saved.time, element: saved.element };
        (self.pace, self.steps) = (saved.pace, saved.steps);
        Ok(())
    }
}
