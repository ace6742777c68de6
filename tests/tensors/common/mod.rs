//! Common parts of several test modules.

pub mod cases;
pub mod dual;
pub mod matrices;
pub mod oracle;
#[path = "../../common/property.rs"]
pub mod property;
pub mod tensors;
