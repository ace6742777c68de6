//! The classes of problems. Each class has a file with its data, its motion and the values of its
//! columns.

pub mod chart;
pub mod constrained;
mod cotangent;
pub mod euler_poincare;
pub mod free_body;
pub mod homogeneous;
pub mod lie_poisson;
pub mod matrix_flow;
pub mod prescribed_velocity;
pub mod tree;
