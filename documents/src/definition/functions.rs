//! The functions that expressions over a chart may contain.

use affinor_tensors::scalar::PositiveFactors;

/// The functions on a chart: of its coordinates, with the signs by which roots and logarithms are defined.
#[derive(Clone, Debug)]
pub(crate) struct Functions {
    pub coordinates: Vec<String>,
    pub positive: PositiveFactors,
}
