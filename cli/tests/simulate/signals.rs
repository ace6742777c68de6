//! Signals: exit status, rows and checkpoints of interrupted runs.

use super::running::{interrupted, saved_rows, send};
use super::{TOP, done, folder, simulate};
use crate::program::wait;
use std::fs;
use std::io::{BufRead, BufReader, Lines, Read};
use std::process::{Child, ChildStderr, Command, Stdio};
use std::thread;

/// Starts a run with events, and waits for the first event.
fn at_an_event(run: &mut Command) -> (Child, Lines<BufReader<ChildStderr>>) {
    let mut child = run.stderr(Stdio::piped()).spawn().unwrap();
    let mut messages = BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(messages.any(|line| line.unwrap().starts_with("flip at t = ")));
    (child, messages)
}

/// A signal ends a run, also between two output rows, without losing rows.
#[test]
fn a_signal_leaves_the_rows() {
    let fixed = TOP.replace("tolerance = 1e-12", "method = \"rkmk4\"\nstep = 0.005");
    let fixed = format!("{fixed}[events]\nflip = \"Omega2\"\n").replace("end = 400", "end = 1e5");
    for (signal, status) in [("INT", 130), ("TERM", 143)] {
        let folder = folder(&fixed);
        let folder = folder.path();
        let (mut child, messages) = at_an_event(simulate(folder).args(["-o", "rows.csv"]));
        send(signal, &child);
        assert_eq!(wait(&mut child), status);
        let message: String = messages.map(Result::unwrap).collect();
        assert!(message.contains("up to this time to rows.partial.csv"), "{message}");
        let part = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
        assert!(part.lines().count() > 3, "{message}");
        let end = part.lines().last().unwrap().split(',').next().unwrap();
        done(simulate(folder).args(["--end", end, "-o", "whole.csv"]));
        assert!(part == fs::read_to_string(folder.join("whole.csv")).unwrap());
    }
    // between two rows that are far apart, to standard output
    let far = folder(&fixed.replace("end = 1e5", "end = 1e6").replace("0.25", "1e6"));
    let (mut child, messages) = at_an_event(simulate(far.path()).stdout(Stdio::null()));
    send("INT", &child);
    assert_eq!(wait(&mut child), 130);
    let message: String = messages.map(Result::unwrap).collect();
    assert!(message.contains("wrote 1 row up to this time"), "{message}");
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
    assert!(part.lines().count() > 41, "{message}");
    done(simulate(folder).args(ensemble).args(["--resume", "-o", "rows.csv"]));
    assert!(
        fs::read(folder.join("whole.csv")).unwrap() == fs::read(folder.join("rows.csv")).unwrap()
    );
}

/// The first byte on standard output. The rest is not read, so that a long run cannot end.
fn first_byte(child: &mut Child) {
    child.stdout.as_mut().unwrap().read_exact(&mut [0]).unwrap();
}

#[test]
fn a_second_signal_kills() {
    let problem = TOP.replace("0.25", "0.001").replace("end = 400", "end = 1000");
    let folder = folder(&format!("{problem}[events]\nflip = \"Omega2\"\n"));
    let mut run = simulate(folder.path());
    let mut child = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut messages = BufReader::new(child.stderr.take().unwrap()).lines();
    // two events are a thousand rows apart, more than the buffer of a pipe
    let mut flip = || assert!(messages.any(|line| line.unwrap().starts_with("flip at t = ")));
    flip();
    flip();
    send("INT", &child);
    first_byte(&mut child);
    assert!(child.try_wait().unwrap().is_none());
    // further signals that follow at once are treated as the same signal
    while child.try_wait().unwrap().is_none() {
        send("INT", &child);
        thread::yield_now();
    }
    assert_eq!(wait(&mut child), 130);
}

/// If a run has computed all rows and waits for its reader, the first signal kills it.
#[test]
fn a_signal_kills_what_is_written_out() {
    let folder = folder(&TOP.replace("0.25", "0.0005").replace("end = 400", "end = 5"));
    let mut run = simulate(folder.path());
    let mut child = run.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    first_byte(&mut child);
    send("TERM", &child);
    assert_eq!(wait(&mut child), 143);
}
