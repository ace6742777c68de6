//! Runs of integrators, and their observed orders.
#![allow(dead_code, reason = "each test takes what it needs")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::mechanics::{Integrator, System};

/// The state after a time, by equal steps.
pub fn run<S: System>(
    method: &impl Integrator<S>,
    system: &S,
    start: &S::State,
    time: f64,
    steps: usize,
) -> S::State {
    let mut state = start.clone();
    for _ in 0..steps {
        method.step(system, &mut state, time / steps as f64).unwrap();
    }
    state
}

/// Checks that the observed order over each of some halvings is the nominal one, within a tenth.
pub fn expect_order(
    name: &str,
    order: u32,
    steps: usize,
    halvings: usize,
    error: impl Fn(usize) -> f64,
) {
    let errors: Vec<f64> = (0..=halvings).map(|halving| error(steps << halving)).collect();
    for pair in errors.windows(2) {
        let observed = (pair[0] / pair[1]).log2();
        assert!((observed - f64::from(order)).abs() < 0.1, "{name}: {observed}, errors {errors:?}");
    }
}
