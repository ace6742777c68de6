//! Runs the program as a process.
#![allow(dead_code, reason = "each test takes what it needs")]

pub use crate::common::root;
use std::ffi::{OsStr, OsString};
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;

/// The exit status and the outputs of a run.
#[derive(Debug)]
pub struct Outcome {
    pub status: i32,
    pub out: String,
    pub err: String,
}

/// The path of one of the definitions of the examples.
pub fn definition(file: &str) -> String {
    format!("{}/examples/definitions/{file}", root().display())
}

/// The program under test: the one that cargo built, or another one, such as that of the Python package, by `AFFINOR_PROGRAM`.
pub fn path() -> OsString {
    std::env::var_os("AFFINOR_PROGRAM").unwrap_or_else(|| env!("CARGO_BIN_EXE_affinor").into())
}

/// The program, to be run in `folder`.
pub fn program(folder: &Path) -> Command {
    let mut program = Command::new(path());
    program.current_dir(folder).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    program
}

/// Runs the program in `folder`.
pub fn run<A: AsRef<OsStr>>(folder: &Path, arguments: &[A], input: &[u8]) -> Outcome {
    let mut program = program(folder);
    program.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = program.spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // a program that does not read its input closes the pipe
    let feeder = thread::spawn(move || drop(stdin.write_all(&input)));
    let out = drain(child.stdout.take().unwrap());
    let err = drain(child.stderr.take().unwrap());
    let status = wait(&mut child);
    feeder.join().unwrap();
    Outcome { status, out: out.join().unwrap(), err: err.join().unwrap() }
}

/// The words of a command; double quotes hold words together.
pub fn words(arguments: &str) -> Vec<&str> {
    let pieces = arguments.split('"').enumerate();
    let words = pieces.flat_map(|(at, piece)| match at % 2 {
        0 => piece.split_whitespace().collect(),
        _ => vec![piece],
    });
    words.collect()
}

/// Runs what has to succeed in `folder`; standard output.
pub fn stdout(folder: &Path, arguments: &[&str]) -> String {
    let outcome = run(folder, arguments, b"");
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    outcome.out
}

/// The exit status, after the program has ended.
pub fn wait(child: &mut Child) -> i32 {
    let status = child.wait().unwrap();
    status.code().unwrap_or_else(|| panic!("ended by a signal: {status}"))
}

fn drain(mut pipe: impl Read + Send + 'static) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.read_to_end(&mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    })
}
