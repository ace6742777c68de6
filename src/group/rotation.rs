//! Coordinates of rotations: quaternions, matrices, Euler angles, Rodrigues parameters.
//!
//! Rotation vectors, the canonical coordinates of the first kind, are converted by `exp` and `log`
//! of [`So3`](super::So3). Every conversion uses the unit quaternion, with `w` first. Functions
//! return an error if the coordinates do not exist for a rotation.
//!
//! | coordinates | to and from the quaternion | singular |
//! |---|---|---|
//! | quaternion | [`wxyz`], [`from_wxyz`] | nowhere; `q` and `-q` are the same rotation |
//! | rotation vector | [`LieGroup::log`](super::LieGroup::log), [`exp`](super::LieGroup::exp) | nowhere; at `pi` a rule chooses the sign |
//! | matrix | [`matrix`], [`from_matrix`] | nowhere |
//! | Euler angles (second kind) | [`Sequence::angles`], [`Sequence::rotation`] | gimbal lock, reported with a rule |
//! | Gibbs vector `tan(angle/2) n` | [`rodrigues`], [`from_rodrigues`] | error at `pi` |
//! | modified Rodrigues `tan(angle/4) n` | [`modified_rodrigues`], [`from_modified_rodrigues`] | nowhere up to `pi` |

mod conversions;
pub mod euler;
pub(crate) mod formulas;

pub use conversions::{
    from_matrix, from_modified_rodrigues, from_rodrigues, from_wxyz, matrix, modified_rodrigues,
    rodrigues, wxyz,
};
pub use euler::{AxesFrame, Axis, EulerAngles, GimbalLock, Sequence};
