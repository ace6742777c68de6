//! The groups, with one file for each group.

mod heisenberg;
mod homotheties;
mod matrix_group;
mod nilpotent;
mod opposite;
mod product;
mod se2;
mod se23;
mod se3;
mod semidirect_so3;
mod sl2;
mod so2;
pub(super) mod so3;
mod translations;

pub use heisenberg::Heisenberg;
pub use homotheties::Homotheties;
pub use matrix_group::MatrixGroup;
pub use nilpotent::Nilpotent;
pub use opposite::Opposite;
pub use product::Product;
pub use se2::Se2;
pub use se3::Se3;
pub use se23::{ExtendedPose, Se23};
pub use sl2::Sl2;
pub use so2::So2;
pub use so3::So3;
pub use translations::Translations;
