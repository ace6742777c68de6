//! `affinor simulate`: output, and the handling of errors.
#![cfg(unix)]

mod charts;
mod checkpoints;
mod events;
mod forces;
mod homogeneous;
mod messages;
mod options;
pub mod running;
mod signals;
mod stops;
mod sums;
mod units;
mod written;

use crate::program;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::{TempDir, tempdir};

/// A spinning top with a long run time.
const TOP: &str = r#"
space = "so3"
metric = "diag(1, 2, 3)"
[initial]
velocity = [1, "w", 0.2]
[parameters]
w = 0.1
[forces]
potential = "g33 + g12*g23"
body = ["-0.001*Omega1", "0.01*sin(t)", 0]
[integrator]
tolerance = 1e-12
[output]
end = 400
every = 0.25
[ensemble]
samples = 40
seed = 5
random = { w = "normal(0, 0.1)" }
"#;

fn folder(problem: &str) -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("top.toml"), problem).unwrap();
    folder
}

fn simulate(folder: &Path) -> Command {
    let mut command = Command::new(program::path());
    command.current_dir(folder).args(["simulate", "top.toml"]);
    command
}

fn done(command: &mut Command) -> Output {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

fn refused(command: &mut Command, status: i32) -> String {
    let output = command.output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{message}");
    message
}

/// The columns of a run, each with its name.
fn columns(folder: &Path) -> Vec<(String, Vec<f64>)> {
    let output = done(&mut simulate(folder));
    let mut rows = csv::Reader::from_reader(&output.stdout[..]);
    let names = rows.headers().unwrap().iter();
    let mut columns: Vec<_> = names.map(|name| (name.to_string(), vec![])).collect();
    for row in rows.records() {
        for ((_, values), value) in columns.iter_mut().zip(&row.unwrap()) {
            values.push(value.parse().unwrap());
        }
    }
    columns
}

/// The first column of a run.
fn times(folder: &Path) -> Vec<f64> {
    columns(folder).swap_remove(0).1
}
