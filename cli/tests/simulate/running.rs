//! Runs that the test kills or interrupts.

use super::simulate;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

/// Kills the run a few times, each time after it has saved new rows, then lets it finish.
pub fn killed_and_resumed(folder: &Path) {
    let saved = || fs::read(folder.join("c")).ok();
    let start = |seconds: &str| {
        let mut command = simulate(folder);
        command.args(["--ensemble", "--checkpoint", "c", "--checkpoint-every", seconds]);
        command.args(["--resume", "-o", "killed.csv"]).stderr(Stdio::null());
        command.spawn().unwrap()
    };
    for _ in 0..6 {
        let (before, mut child) = (saved(), start("0"));
        if !reaches(&mut child, || saved() != before) {
            assert!(child.wait().unwrap().success());
            return;
        }
        kill(child);
    }
    // a checkpoint at every step would be limited by the disk
    assert!(start("1").wait().unwrap().success());
}

/// Waits until a run reaches a state (true), or ends before (false).
pub fn reaches(child: &mut Child, state: impl Fn() -> bool) -> bool {
    while !state() {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        // leaves the processor to the run
        thread::sleep(Duration::from_millis(1));
    }
    true
}

/// Kills a run, unless it has already ended.
pub fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Sends a signal to a run as soon as `begun` holds. Returns its status and its messages.
pub fn interrupted(command: &mut Command, signal: &str, begun: impl Fn() -> bool) -> (i32, String) {
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    reaches(&mut child, begun);
    // twice, like a program that stops a process group
    for _ in 0..2 {
        send(signal, &child);
    }
    let status = crate::program::wait(&mut child);
    let mut message = String::new();
    child.stderr.take().unwrap().read_to_string(&mut message).unwrap();
    (status, message)
}

/// Sends a signal to a process that has not been waited for.
pub fn send(signal: &str, child: &Child) {
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-s", signal, &id]).status().unwrap().success());
}

/// The checkpoint, or null if there is none.
pub fn saved(folder: &Path) -> serde_json::Value {
    let saved = fs::read_to_string(folder.join("c")).unwrap_or_default();
    serde_json::from_str(&saved).unwrap_or_default()
}

/// The number of rows that the checkpoint counts.
pub fn saved_rows(folder: &Path) -> u64 {
    saved(folder)["rows"].as_u64().unwrap_or(0)
}
