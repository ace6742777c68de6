//! Tests of `affinor-tensors`: files follow `tensors/src/`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

mod contraction;
mod dense;
mod expression;
mod linear;
mod operations;
mod polynomial;
mod scalar;
mod stop;
mod tensor;
