//! What several modules of tests share.

pub mod cases;
pub mod dual;
pub mod matrices;
pub mod oracle;
pub mod property;
pub mod tensors;
