//! Figures of the paper and of trajectories, computed ([`figures`]) and drawn (`plot`, a feature).

pub mod figures;
#[cfg(feature = "plot")]
pub mod plot;
