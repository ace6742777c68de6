//! Mechanisms: rigid bodies and joints, their loops, and an exact account of their mobility.
//!
//! A joint between two bodies restricts their relative pose to a subgroup of SE(3), which is given
//! by its subalgebra. All twists are components `(w, u)` in the ground frame at the given position,
//! with the basis of [`Se3`](crate::group::Se3). In reading order: [`twist`] defines twists of
//! axes, [`joint`] the joints, [`graph`] bodies and loops, [`mobility`] the rates and the verdict.
//! The proofs of the verdict have one file each: [`closure`], [`subgroups`] and [`symmetry`].
//! [`positions`] computes other assembled positions in floats, and [`constraint`] states the
//! equations of a joint for moving bodies. [`tree`] computes motions of trees in joint coordinates.

pub mod closure;
pub mod constraint;
pub mod denavit_hartenberg;
pub mod graph;
pub mod joint;
pub mod mobility;
pub mod positions;
pub mod subgroups;
pub mod symmetry;
pub mod tree;
pub mod twist;

pub use constraint::JointConstraint;
pub use graph::{Loop, Mechanism};
pub use joint::{Joint, JointKind};
pub use mobility::{Mobility, Reason, Verdict};
pub use tree::{Cut, MovingTree, Tree};
pub use twist::Twist;
