//! Malformed input: every one is refused with its place, its witness and the right status, soon.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../common/program.rs"]
mod program;

mod case;
mod charts;
mod definitions;
mod encodings;
mod expressions;
mod forces;
mod huge;
mod names;
mod options;
mod outputs;
mod problems;
mod stored;
