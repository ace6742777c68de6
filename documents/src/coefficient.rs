//! The scalars that spaces of documents and their reports are computed in.

use affinor::tensors::{Scalar, Tabular};

/// A scalar whose tensors can be contracted and written in tables.
pub trait Coefficient: Tabular + Scalar {}

impl<S: Tabular + Scalar> Coefficient for S {}
