//! What the program does, a module a claim.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../tests/common/mod.rs"]
mod common;
mod compiled;
mod program;

mod bad_input;
mod chart_definitions;
mod cli;
mod compare;
mod documents;
mod e8;
mod equations;
mod examples;
mod float_tables;
mod group_commands;
mod guide;
mod heads;
mod info;
mod limits;
mod notations;
mod paper;
mod plot;
mod plot_motions;
mod program_accuracy;
mod program_pivots;
mod programs;
mod range_of_floats;
mod roots;
#[cfg(unix)]
mod simulate;
mod snapshots;
mod values;
mod verify;
