//! Motion on groups: Euler-Poincare systems and their integrators.
//!
//! [`EulerPoincare`] is the system that a geometry defines on a group, with a torque; [`integrators`]
//! step it and stay on the group.

pub mod euler_poincare;
pub mod integrators;

pub use euler_poincare::{EulerPoincare, State};
pub use integrators::{Adaptive, CommutatorFree, Integrator, MuntheKaas};
