//! Motions of left-invariant mechanical systems, in floats; so far the free rigid body.
//!
//! [`FreeBody`] knows attitude and momentum at any time, by elliptic functions and without steps.
//! [`MoserVeselov`] makes steps that keep energy and momentum.
//!
//! Attitudes map body to space components, `Rdot = R spin(Omega)`; momentum `H = J Omega` and velocity are in
//! body components, `Hdot = H cross Omega` is (108) without torque, and `R H` is the momentum in space.

pub mod elliptic;
pub mod free_body;
pub mod inertia;
pub mod moser_veselov;

pub use free_body::FreeBody;
pub use inertia::{BodyState, Inertia};
pub use moser_veselov::MoserVeselov;
