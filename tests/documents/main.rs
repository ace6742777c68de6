//! What the documents of affinor claim, a module a claim.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../common/mod.rs"]
mod common;

mod formula_names;
mod fuzz;
mod mass_properties;
mod parameters;
mod places;
mod problems;
mod read_back;
mod report;
mod right_invariant;
