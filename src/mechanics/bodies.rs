//! Rigid bodies: mass properties of shapes and meshes, the inertia with its principal axes, and the
//! motion of a free body in closed form, by elliptic functions.

pub mod elliptic;
pub mod free_body;
pub mod inertia;
pub mod mass;

pub use free_body::FreeBody;
pub use inertia::{BodyState, Inertia};
pub use mass::{MassProperties, Mesh};
