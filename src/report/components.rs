//! Components as a reader wants them: grouped by value, or one for each symmetric set.
use affinor_tensors::{Notation, Tensor};

/// Components of equal size: each with its sign relative to the value.
#[derive(Clone, Debug)]
pub struct Group<S> {
    /// The common value.
    pub value: S,
    /// The indices, from 0, and whether the component is minus the value.
    pub members: Vec<(Vec<usize>, bool)>,
}

/// The nonzero components grouped by value up to sign, in the order of first appearance.
pub fn groups<S: Notation>(tensor: &Tensor<S>) -> Vec<Group<S>> {
    let _ = tensor;
    vec![]
}

/// One component for each set that is equal by the symmetries of the tensor.
pub fn independent<S: Notation>(tensor: &Tensor<S>) -> Tensor<S> {
    tensor.clone()
}
