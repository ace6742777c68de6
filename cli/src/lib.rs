//! The command line of affinor as a function, which the program and the Python package call.

mod commands;

use std::ffi::OsString;

/// The commands with their options, for manual pages.
pub fn command() -> clap::Command {
    commands::command()
}

/// The same commands, whose arguments suggest names of algebras, tensors and methods, for completions.
pub fn suggesting() -> clap::Command {
    commands::suggesting()
}

/// Runs the command line, once per process, and returns the exit status. The first argument is the
/// name of the program.
///
/// The command line handles signals. A command that exceeds a limit or receives a signal ends the
/// process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    commands::main(&arguments)
}
