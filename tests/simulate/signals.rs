//! Signals: what they leave.

use super::running::{interrupted, saved_rows};
use super::{TOP, done, folder, program, simulate};
use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A signal ends a run between two rows too, and loses nothing.
#[test]
fn a_signal_leaves_rows_and_a_checkpoint() {
    for (signal, status) in [("INT", 130), ("TERM", 143)] {
        let folder = folder(TOP);
        let folder = folder.path();
        done(simulate(folder).args(["-o", "whole.csv"]));
        let mut run = simulate(folder);
        run.args(["--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"]);
        let begun = || saved_rows(folder) > 3;
        let (found, message) = interrupted(&mut run, signal, begun);
        assert_eq!(found, status, "{message}");
        assert!(message.contains("rows up to there are in rows.partial.csv"), "{message}");
        let whole = fs::read_to_string(folder.join("whole.csv")).unwrap();
        let part = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
        assert!(part.lines().count() > 3 && part.len() < whole.len(), "{message}");
        assert!(whole.starts_with(&part));
        done(simulate(folder).args(["--checkpoint", "c", "--resume", "-o", "rows.csv"]));
        assert!(whole == fs::read_to_string(folder.join("rows.csv")).unwrap());
    }
    // between two rows that are far apart, to standard output
    let far = folder(&TOP.replace("end = 400", "end = 1e6").replace("0.25", "1e6"));
    let start = Instant::now();
    let (status, message) =
        interrupted(simulate(far.path()).stdout(Stdio::null()), "INT", || later(start));
    assert_eq!(status, 130, "{message}");
    assert!(message.contains("1 rows up to there were written"), "{message}");
}

#[test]
fn a_signal_keeps_the_members_that_are_done() {
    let problem = TOP.replace("samples = 40", "samples = 300").replace("end = 400", "end = 10");
    let folder = folder(&problem);
    let folder = folder.path();
    let ensemble = ["--ensemble", "--checkpoint", "c", "--checkpoint-every", "0"];
    done(simulate(folder).args(["--ensemble", "-o", "whole.csv"]));
    let mut run = simulate(folder);
    let (status, message) =
        interrupted(run.args(ensemble).args(["-o", "rows.csv"]), "TERM", || saved_rows(folder) > 0);
    assert_eq!(status, 143, "{message}");
    let part = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
    assert!(part.lines().count() > 128 * 41, "{message}");
    done(simulate(folder).args(ensemble).args(["--resume", "-o", "rows.csv"]));
    assert!(
        fs::read(folder.join("whole.csv")).unwrap() == fs::read(folder.join("rows.csv")).unwrap()
    );
}

/// Here the run cannot end, as nobody reads its rows.
#[test]
fn a_second_signal_kills() {
    let folder = folder(&TOP.replace("0.25", "0.001").replace("end = 400", "end = 1000"));
    let start = Instant::now();
    let mut child =
        simulate(folder.path()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    let mut ended = vec![];
    for limit in [1, 3] {
        while start.elapsed() < Duration::from_secs(limit) {
            std::thread::sleep(Duration::from_millis(10));
        }
        ended.push(child.try_wait().unwrap().is_some());
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-s", "INT", &id]).status().unwrap().success());
    }
    assert_eq!((ended, program::wait(&mut child)), (vec![false, false], 130));
}

/// What is computed and only waits for a reader has nothing to stop.
#[test]
fn a_signal_kills_what_is_written_out() {
    let folder = folder(&TOP.replace("0.25", "0.0005").replace("end = 400", "end = 5"));
    let mut child =
        simulate(folder.path()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(Duration::from_secs(3));
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-s", "TERM", &id]).status().unwrap().success());
    assert_eq!(program::wait(&mut child), 143);
}

fn later(start: Instant) -> bool {
    start.elapsed() > Duration::from_millis(500)
}
