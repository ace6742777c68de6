//! What the documents of affinor claim, a module a claim.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../common/mod.rs"]
mod common;

mod claims;
mod double_double;
mod equal_functions;
mod figures;
mod formula_names;
mod fuzz;
mod line_elements;
mod mass_properties;
mod parameters;
mod places;
mod printed;
mod problems;
mod public_reports;
mod random_charts;
mod read_back;
mod report;
mod right_invariant;
