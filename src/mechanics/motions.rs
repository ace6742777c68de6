//! Motions of systems that are chosen at run time, from formulas.
//!
//! A [`Motion`] is a system, its state and a method that advances it. This is all that a program needs that writes rows, shows
//! progress and can be interrupted. In reading order:
//!
//! - [`quantities`]: the names that formulas may use; [`observables`]: their values at a point of a motion;
//! - [`forces`]: forces and potentials as formulas, and [`table`]s over time;
//! - [`on_group`] makes motions of Euler-Poincare systems with [`Forces`], [`on_constraints`] of systems with holonomic
//!   constraints, [`on_hamiltonian`] of Lie-Poisson systems, [`on_given`] of a velocity that is given over time, and
//!   [`on_matrices`] of isospectral flows; [`method`] lists the methods by name;
//! - [`chosen`]: the same motions on groups chosen at run time;
//! - [`Crossings`] finds events along a motion, a [`Snapshot`] saves its state;
//! - [`SimulationGroup`]: what a group provides for all this.

pub mod chosen;
mod constrained;
mod crossings;
mod drive;
pub mod forces;
mod given;
mod hamiltonian;
mod matrices;
pub mod method;
pub mod observables;
mod on_cotangent;
mod on_group;
mod pace;
pub mod quantities;
mod run;
mod simulated;
mod snapshot;
pub mod table;

pub use constrained::{ConstrainedSystem, Equations, on_constraints};
pub use crossings::{Crossing, Crossings};
pub use drive::Drive;
pub use forces::{ForceFunction, Forces, Side};
pub use given::{GivenVelocity, on_given};
pub use hamiltonian::{Hamiltonian, on_hamiltonian};
pub use matrices::{MatrixFlow, Started, on_matrices};
pub use method::Method;
pub use observables::{Observables, Point};
pub use on_group::{Setup, is_plus, on_group, share_of_plus};
pub use simulated::{Body, SimulationGroup};
pub use snapshot::{Reader, Saved, Snapshot};
pub use table::Table;

use crate::Error;
use std::ops::Range;

/// A motion, computed step by step.
pub trait Motion: Send {
    /// The time of the present state.
    fn time(&self) -> f64;

    /// Makes one step towards a time, and returns whether the time is reached.
    ///
    /// # Errors
    /// [`Error::Integration`]; the state is then that of the last good step.
    fn step(&mut self, until: f64) -> Result<bool, Error>;

    /// The same by a step short enough to check for events: it rotates a body by at most a quarter radian. Fixed steps keep their
    /// length.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn short_step(&mut self, until: f64) -> Result<bool, Error>;

    /// The number of columns.
    fn width(&self) -> usize;

    /// Appends the values of some columns to `list`, without allocation once the list is long enough.
    fn values(&self, columns: Range<usize>, list: &mut Vec<f64>);

    /// The values of all columns.
    fn row(&self) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.width());
        self.values(0..self.width(), &mut row);
        row
    }

    /// The number of steps so far.
    fn steps(&self) -> u64;

    /// Keeps a copy of the state in memory, in the place of an earlier copy.
    fn keep(&mut self);

    /// Returns to the state that was kept last, if there is one.
    fn back(&mut self);

    /// The state with all that its continuation depends on, to the last bit.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for a number that is not finite.
    fn save(&self) -> Result<Snapshot, Error>;

    /// Continues from a saved state.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for a state of another motion; the motion is then unchanged.
    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error>;
}
