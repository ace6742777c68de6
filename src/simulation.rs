//! Motions that are computed as far as they are asked for, of systems chosen while the program runs.
//!
//! A [`Motion`] is a system, a state and a way to go on; it is all that a program that writes rows,
//! shows progress and can be interrupted has to know. [`on_group`] makes one of an Euler-Poincare system with
//! [`Forces`], [`on_constraints`] of one that is held by constraints,
//! [`on_hamiltonian`] of a Lie-Poisson system,
//! [`on_given`] of a velocity over time, [`on_matrices`] of an isospectral flow.

mod constrained;
mod crossings;
mod drive;
pub mod forces;
mod given;
mod groups;
mod hamiltonian;
mod matrices;
pub mod method;
mod on_cotangent;
mod on_group;
mod pace;
pub mod quantities;
pub mod table;

pub use constrained::{ConstrainedSystem, Equations, on_constraints};
pub use crossings::{Crossing, Crossings};
pub use forces::{Forces, Point, Side};
pub use given::{GivenVelocity, on_given};
pub use hamiltonian::{Hamiltonian, on_hamiltonian};
pub use matrices::{MatrixFlow, Started, on_matrices};
pub use method::Method;
pub use on_group::{Setup, is_plus, on_group};
pub use table::Table;

use crate::Error;
use crate::any_group::Written;
use crate::dynamics::{EulerPoincare, Inertia, State};
use crate::group::logarithm;
use drive::Drive;
use nalgebra::DMatrix;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// A motion that is computed as far as it is asked for.
pub trait Motion: Send {
    /// The time that was reached.
    fn time(&self) -> f64;

    /// One step towards a time, and whether it is reached.
    ///
    /// # Errors
    /// [`Error::Integration`]; the state is then that of the last good step.
    fn step(&mut self, until: f64) -> Result<bool, Error>;

    /// The same by a step in which nothing turns far, so that looks between steps see what happens. One of a given length
    /// is what it is.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn short_step(&mut self, until: f64) -> Result<bool, Error> {
        self.step(until)
    }

    /// The values of the columns.
    fn row(&self) -> Vec<f64>;

    /// How many steps were made.
    fn steps(&self) -> u64;

    /// All that goes on from here depends on, to the last bit.
    ///
    /// # Errors
    /// [`Error::Snapshot`] where a number is not finite.
    fn save(&self) -> Result<Snapshot, Error>;

    /// Goes back to what was saved.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for one of another motion.
    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error>;
}

/// What [`Motion::save`] writes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Snapshot(serde_json::Value);

impl Snapshot {
    fn of(numbers: &impl Serialize) -> Result<Self, Error> {
        let value = serde_json::to_value(numbers);
        value.map(Snapshot).map_err(|error| Error::Snapshot { reason: error.to_string() })
    }

    fn read<T: DeserializeOwned>(&self) -> Result<T, Error> {
        T::deserialize(&self.0).map_err(|error| Error::Snapshot { reason: error.to_string() })
    }
}

/// An Euler-Poincare system with forces as formulas.
pub type Body<G> = EulerPoincare<G, Forces<G>>;

/// A group on which motions are simulated.
pub trait Simulated:
    Written<Element: Serialize + DeserializeOwned + Send + Sync, Vector: Send + Sync>
    + Clone
    + Debug
    + Send
    + Sync
    + 'static
{
    /// The numbers in which there are projected methods, or `()`.
    type Numbers: drive::Numbers<Self>;

    /// Whether its left-invariant frame is the right-invariant one of the group it stands for.
    const RIGHT: bool = false;

    /// Names of coordinates of an element beside its entries, such as those of a quaternion.
    const NAMED: &'static [&'static str] = &[];

    /// The values of [`NAMED`](Self::NAMED).
    fn named(&self, g: &Self::Element) -> Vec<f64> {
        let _ = g;
        vec![]
    }

    /// Whether something read is of the size of an element.
    fn has_shape(&self, g: &Self::Element) -> bool {
        self.write(g).shape() == self.write(&self.identity()).shape()
    }

    /// The derivatives at 0 of `exp(s e_i)` as written: the matrices of the basis. Entries that are zero have to be so to the
    /// last bit: a derivative along them is multiplied by the coordinates of a place, which may be large.
    fn generators(&self) -> Vec<DMatrix<f64>> {
        let half = |x: &Self::Vector| self.write(&self.exp(&(x.clone() * 0.5)));
        // half of a basis vector has a principal logarithm
        let log = |x: &Self::Vector| match logarithm(&half(x)) {
            Ok(half) => half * 2.0,
            Err(_) => DMatrix::from_element(1, 1, f64::NAN),
        };
        self.basis().iter().map(log).collect()
    }

    /// The derivatives at 0 of `g exp(s e_i)` as written.
    fn slopes(&self, g: &Self::Element, generators: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
        let element = self.write(g);
        generators.iter().map(|generator| &element * generator).collect()
    }

    /// The inertia of a body, where the group is that of rotations.
    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        let _ = inertia;
        None
    }

    /// A way to go on that only this group has; none if there is no such method here.
    fn own_drive(
        &self,
        method: Method,
        system: &Body<Self>,
        inertia: &Inertia,
        start: &State<Self>,
        step: f64,
    ) -> Option<Result<Drive<Body<Self>>, Error>> {
        let _ = (method, system, inertia, start, step);
        None
    }
}
