//! Runs that are stopped from outside.

use super::{program, simulate};
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Kills the run a few times, each time once it has saved something new, then lets it come to its end.
pub fn killed_and_resumed(folder: &Path, options: &[&str]) -> u32 {
    let saved = || fs::read(folder.join("c")).ok();
    let start = |seconds: &str| {
        let mut command = simulate(folder);
        command.args(options).args(["--checkpoint", "c", "--checkpoint-every", seconds]);
        command.args(["--resume", "-o", "killed.csv"]).stderr(Stdio::null());
        command.spawn().unwrap()
    };
    let mut kills = 0;
    for _ in 0..6 {
        let (before, mut child) = (saved(), start("0"));
        while saved() == before && child.try_wait().unwrap().is_none() {}
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success());
            return kills;
        }
        child.kill().unwrap();
        child.wait().unwrap();
        kills += 1;
    }
    // a checkpoint at every step would wait for the disk
    assert!(start("1").wait().unwrap().success());
    kills
}

/// Sends a signal to a run that is on its way; its status and what it said.
pub fn interrupted(command: &mut Command, signal: &str, begun: impl Fn() -> bool) -> (i32, String) {
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    while !begun() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    // twice, as a program that stops a whole group does
    for _ in 0..2 {
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-s", signal, &id]).status().unwrap().success());
    }
    let status = program::wait(&mut child);
    let mut message = String::new();
    child.stderr.take().unwrap().read_to_string(&mut message).unwrap();
    (status, message)
}

/// The checkpoint, or null if there is none.
pub fn saved(folder: &Path) -> serde_json::Value {
    let saved = fs::read_to_string(folder.join("c")).unwrap_or_default();
    serde_json::from_str(&saved).unwrap_or_default()
}

/// How many rows the checkpoint counts.
pub fn saved_rows(folder: &Path) -> u64 {
    saved(folder)["rows"].as_u64().unwrap_or(0)
}
