//! Tests of the program: one file per command, or per claim about several commands.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../tests/common/mod.rs"]
mod common;
mod compiled;
mod program;

mod bad_input;
mod chart_definitions;
mod claims;
mod cli;
mod code;
mod compare;
mod constructions;
mod coupling;
mod documents;
mod e8;
mod endings;
mod equations;
mod examples;
mod first_mistakes;
mod float_tables;
mod geodesic;
mod group_commands;
mod guide;
mod heads;
mod homogeneous;
mod horizontal;
mod info;
mod limits;
mod mobility;
mod notations;
mod paper;
mod plot;
mod range_of_floats;
mod rep;
mod roots;
#[cfg(unix)]
mod simulate;
mod snapshots;
mod solve;
#[cfg(unix)]
mod stops;
mod tables;
mod values;
mod verify;
