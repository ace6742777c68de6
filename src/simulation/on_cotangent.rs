//! Systems of an element and a momentum as motions.

use super::drive::{Drive, Memory};
use super::quantities::Scope;
use super::{Forces, Motion, Point, Simulated, Snapshot};
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, Element, State, Vector};
use crate::formula::Formula;
use crate::group::{Coordinates, LieGroup as _};
use serde::{Deserialize, Serialize};

/// A system with names for what it has.
pub trait Seen: CotangentSystem<Group: Simulated> {
    /// The forces, which know the names.
    fn forces(&self) -> &Forces<Self::Group>;

    /// Looks at a state.
    fn seen<R>(&self, state: &State<Self::Group>, look: impl FnOnce(&Point<Self::Group>) -> R)
    -> R;
}

/// A system with its state, its way to go on, and the formulas of its columns.
pub struct OnCotangent<S: CotangentSystem> {
    pub system: S,
    pub state: State<S::Group>,
    pub drive: Drive<S>,
    pub steps: u64,
    pub columns: (Scope, Vec<Formula>),
}

/// The numbers of [`OnCotangent`].
#[derive(Serialize, Deserialize)]
struct Saved<E> {
    time: f64,
    element: E,
    spatial: Vec<f64>,
    memory: Memory,
    steps: u64,
}

impl<S: Seen> OnCotangent<S> {
    /// A step towards a time, at most so long where its length is free.
    fn go(&mut self, until: f64, longest: f64) -> Result<bool, Error> {
        let (time, forces) = (self.state.time, self.system.forces());
        self.steps = self.steps.saturating_add(u64::from(time != until));
        // that of an earlier step is none now
        let _ = forces.trouble();
        let mut pause = forces.pause(time, until);
        if (pause - time).abs() > longest {
            pause = time + longest.copysign(until - time);
        }
        let done = self.drive.step(&self.system, &mut self.state, until, pause);
        done.map_err(|error| match (error, forces.trouble()) {
            (_, Some(trouble)) => Error::Integration { t: self.state.time, reason: trouble },
            (Error::Integration { t, reason }, None) => Error::Integration { t, reason },
            (error, None) => Error::Integration {
                t: self.state.time,
                reason: format!("the step is too long: {error}"),
            },
        })
    }
}

impl<S: Seen + Send> Motion for OnCotangent<S> {
    fn time(&self) -> f64 {
        self.state.time
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        self.go(until, f64::INFINITY)
    }

    fn short_step(&mut self, until: f64) -> Result<bool, Error> {
        let look = self.drive.look(&self.system, &self.state);
        self.go(until, look)
    }

    fn row(&self) -> Vec<f64> {
        let (scope, formulas) = &self.columns;
        let forces = self.system.forces();
        let values = self.system.seen(&self.state, |point| scope.values(forces, point));
        formulas.iter().map(|formula| formula.value(&values)).collect()
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn save(&self) -> Result<Snapshot, Error> {
        Snapshot::of(&Saved {
            time: self.state.time,
            element: &self.state.element,
            spatial: self.state.spatial.components().to_vec(),
            memory: self.drive.memory(),
            steps: self.steps,
        })
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let saved: Saved<Element<S>> = snapshot.read()?;
        let n = self.system.group().dimension();
        let fits = saved.spatial.len() == n && self.system.group().has_shape(&saved.element);
        if !fits || !self.drive.remember(saved.memory) {
            return Err(Error::Snapshot { reason: "it is of another motion".into() });
        }
        let spatial = Vector::<S>::from_components(&saved.spatial);
        self.state = State { time: saved.time, element: saved.element, spatial };
        self.steps = saved.steps;
        Ok(())
    }
}
