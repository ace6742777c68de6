//! What affinor-tensors claims, a module a claim.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

mod contraction;
mod contraction_limits;
mod contraction_notation;
mod contraction_paths;
mod contraction_sizes;
mod conversions;
mod denominators;
mod effort;
mod elementary;
mod expression;
mod free_functions;
mod jets;
mod linear;
mod linear_laws;
mod operations;
mod positive;
mod recorded;
mod recorded_solutions;
mod repeated_sums;
mod scalars;
mod symbolic;
mod tensor;
mod tracked;
mod written_sums;
