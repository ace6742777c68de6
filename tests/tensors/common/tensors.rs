//! Random tensors of one shape.

use affinor_tensors::{Rational, Tensor, Variance};
use proptest::collection::vec;
use proptest::prelude::*;

/// Tensors of one shape with few components.
pub fn tensors<const RANK: usize>(
    dimension: usize,
    slots: [Variance; RANK],
) -> impl Strategy<Value = Tensor<Rational>> {
    let component = (vec(0..dimension, RANK), (-4i64..=4, 1i64..=6));
    vec(component, 0..24).prop_map(move |components| {
        let value = |(n, d)| Rational::new(n, d).unwrap();
        let components = components.into_iter().map(|(at, parts)| (at, value(parts)));
        Tensor::from_components(dimension, &slots, components).unwrap()
    })
}
