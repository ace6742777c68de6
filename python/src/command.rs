//! The program affinor as a function, for the entry point of the Python package.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command line, once per process, and returns the exit status. The first argument is the name of the program.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| affinor_cli::run(arguments))
}
