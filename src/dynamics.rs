//! Motions of left-invariant mechanical systems, in floats.
//!
//! [`EulerPoincare`] is the system that a connection, a metric and a torque make on any group;
//! [`integrators`] step it and stay on the group. [`FreeBody`] knows attitude and momentum of the free rigid
//! body at any time, by elliptic functions and without steps; [`MoserVeselov`] makes steps of it that
//! keep energy and momentum. [`MassProperties`] are mass, centre and inertia of shapes, meshes and points.
//!
//! [`isospectral`] has flows of matrices that keep their spectrum: the Toda lattice, the rigid body in n dimensions,
//! the ideal fluid on the sphere. [`Constrained`] systems have holonomic constraints and their multipliers.
//!
//! Attitudes map body to space components, `Rdot = R spin(Omega)`; momentum `H = J Omega` and velocity are in
//! body components, `Hdot = H cross Omega` is (108) without torque, and `R H` is the momentum in space.

mod centred;
mod compensated;
pub mod constrained;
pub mod cotangent;
pub mod dense;
pub mod elliptic;
pub mod euler_poincare;
pub mod events;
pub mod free_body;
pub mod inertia;
pub mod integrators;
pub mod isospectral;
pub mod lie_poisson;
pub mod mass;
mod matrix;
pub mod moser_veselov;
mod principal;

pub use constrained::{Constrained, ConstrainedState, Constraint};
pub use cotangent::{CotangentSystem, State};
pub use euler_poincare::EulerPoincare;
pub use free_body::FreeBody;
pub use inertia::{BodyState, Inertia};
pub use integrators::{Adaptive, CommutatorFree, Integrator, MuntheKaas, Projected, System};
pub use integrators::{Composed, GeneralisedAlpha, IsospectralMidpoint};
pub use integrators::{CrouchGrossman, Kick, Linear, Magnus, Place, SimoWong, Splitting};
pub use isospectral::{Isospectral, Manakov, MatrixState, Toda, Zeitlin};
pub use lie_poisson::LiePoissonSystem;
pub use mass::{MassProperties, Mesh};
pub use moser_veselov::MoserVeselov;
