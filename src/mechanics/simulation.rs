//! Motions of systems that are given by formulas and chosen at run time.
//!
//! A [`Motion`] is a system, its state and the method that advances it. Its interface suffices for
//! programs that write rows, show progress and can be interrupted. In reading order:
//!
//! - `classes`, with one file for each class of problems: [`EulerPoincareSpec`],
//!   [`ConstrainedSpec`], [`LiePoissonSpec`], [`PrescribedVelocitySpec`] and [`MatrixFlow`] start
//!   motions on groups chosen at run time. [`ChartSpec`] starts curves on charts,
//!   [`HomogeneousSpec`] curves on homogeneous spaces, and [`TreeSpec`] trees of bodies;
//! - [`Method`]: the table of the methods of integration; [`Integration`]: the settings of the
//!   integration of a motion;
//! - [`quantities`]: the names that formulas may use; [`Observables`]: the values of these names at
//!   a point of a motion;
//! - [`Forces`]: forces and potentials as formulas; [`ForceTable`]: forces as tables over time;
//! - [`Crossings`] finds events along a motion;
//! - [`SimulationGroup`]: the operations that a group must provide for simulations.

mod classes;
mod crossings;
mod fixed_steps;
mod forces;
mod group;
mod integration;
mod methods;
mod motion;
mod observables;
pub mod quantities;
mod stepper;
mod table;

pub use classes::chart::{ChartColumns, ChartSpec, CurveLength};
pub use classes::constrained::{ConstrainedSpec, Constraints};
pub use classes::euler_poincare::{EulerPoincareSpec, cartan_schouten_factor, is_plus};
pub use classes::homogeneous::{HomogeneousColumns, HomogeneousSpec};
pub use classes::lie_poisson::{Hamiltonian, LiePoissonSpec};
pub use classes::matrix_flow::{MatrixFlow, StartedFlow};
pub use classes::prescribed_velocity::{PrescribedVelocitySpec, VelocityFormulas};
pub use classes::tree::{TreeColumns, TreeSpec};
pub use crossings::{Crossings, RecordedCrossing};
pub use forces::{ForceFrame, ForceFunction, Forces};
pub use group::SimulationGroup;
pub use integration::Integration;
pub use methods::{Class, Method, Steps};
pub use motion::{Motion, Started};
pub use observables::{ColumnFormulas, Observables};
pub use table::ForceTable;
