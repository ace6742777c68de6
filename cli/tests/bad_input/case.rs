//! A row of the tables of malformed inputs.

use crate::program::{Outcome, run};
use std::path::Path;
use tempfile::TempDir;

/// The mathematics refuses.
pub const MATHEMATICS: i32 = 1;
/// Wrong usage, or input that cannot be read.
pub const USAGE: i32 = 2;

/// A command that has to be refused.
pub struct Case<'c> {
    /// What is wrong.
    pub name: &'c str,
    /// The arguments.
    pub arguments: &'c [&'c str],
    /// The file `a.toml` or `a.json`, and its content.
    pub file: Option<(&'c str, &'c [u8])>,
    /// Standard input.
    pub input: &'c [u8],
    /// The exit status.
    pub status: i32,
    /// What standard error says: the place and the witness.
    pub says: &'c [&'c str],
}

impl Case<'_> {
    /// Runs the case; returns what failed about it.
    pub fn failures(&self) -> Vec<String> {
        let folder = TempDir::new().unwrap();
        if let Some((name, content)) = self.file {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        let outcome = run(folder.path(), self.arguments, self.input);
        let mut failures = defects(&outcome, self.status);
        for part in self.says {
            if !outcome.err.contains(part) {
                failures.push(format!("does not say {part:?}"));
            }
        }
        if !failures.is_empty() {
            failures.push(outcome.err);
        }
        failures.into_iter().map(|what| format!("{}: {what}", self.name)).collect()
    }
}

/// A table `(what is wrong, content, status, what is said)` of definition files, each given to
/// `affinor table`.
pub type Files<'c> = [(&'c str, &'c str, i32, &'c [&'c str])];

/// Runs a table of definition files.
pub fn refuse_files(file: &str, table: &Files) {
    let arguments = ["table", file];
    refuse(table.iter().map(|&(name, content, status, says)| Case {
        name,
        arguments: &arguments,
        file: Some((file, content.as_bytes())),
        input: b"",
        status,
        says,
    }));
}

/// A table `(arguments, status, what is said)`.
pub type Commands<'c> = [(&'c [&'c str], i32, &'c [&'c str])];

/// Runs a table of commands without files.
pub fn refuse_commands(table: &Commands) {
    refuse(table.iter().map(|&(arguments, status, says)| Case {
        name: arguments[arguments.len() - 1],
        arguments,
        file: None,
        input: b"",
        status,
        says,
    }));
}

/// Runs cases, and fails with all that is wrong.
pub fn refuse<'c>(cases: impl IntoIterator<Item = Case<'c>>) {
    let failures: Vec<String> = cases.into_iter().flat_map(|case| case.failures()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// What no refusal may do.
fn defects(outcome: &Outcome, status: i32) -> Vec<String> {
    let Outcome { status: found, out, err } = outcome;
    let mut failures = Vec::new();
    let mut check = |ok: bool, what: &str| {
        if !ok {
            failures.push(what.to_string());
        }
    };
    check(*found == status, &format!("status {found}, not {status}"));
    check(out.is_empty(), "writes on standard output");
    check(!err.contains("panicked"), "panics");
    check(err.lines().any(|line| line.starts_with("error: ")), "says no error");
    check(!err.contains(|c: char| c.is_control() && c != '\n'), "control characters");
    check(err.chars().count() < 2500, "floods the terminal");
    let snippet = |line: &&str| line.contains(" | ");
    let wide = err.lines().filter(snippet).any(|line| line.chars().count() > 80);
    check(!wide, "a snippet wider than 80 columns");
    failures
}

/// The files of a folder, sorted.
pub fn listing(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
