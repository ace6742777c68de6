//! Commands that end early: by signals, and by limits on the time and the memory.

use crate::program::{Outcome, program, run, wait};
use crate::simulate::running::{reaches, send};
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

/// A full symmetric matrix of symbols.
fn full(n: usize) -> String {
    let row = |i: usize| -> String {
        let entry = |j: usize| format!("g{}{}", i.min(j) + 1, i.max(j) + 1);
        format!("[{}]", (0..n).map(entry).collect::<Vec<_>>().join(","))
    };
    format!("[{}]", (0..n).map(row).collect::<Vec<_>>().join(","))
}

/// A dense positive definite matrix of integers.
fn dense(n: i64) -> String {
    let entry = |i: i64, j: i64| if i == j { 5 * n } else { (i * j * 7 + i + j) % 9 - 4 };
    let row = |i: i64| (1..=n).map(|j| entry(i, j).to_string()).collect::<Vec<_>>().join(",");
    format!("[{}]", (1..=n).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(","))
}

/// Commands that run for more than ten seconds, with a text of their messages. `properties` and
/// `transport` do not report a stage while they read a space.
fn long() -> Vec<(Vec<String>, &'static str)> {
    let diagonal: Vec<String> = (1..=248).map(|k: i32| k.to_string()).collect();
    let along = vec!["0.1"; 133].join(",");
    let (symbols, more, numbers) = (full(6), full(9), dense(28));
    let diagonal = format!("diag({})", diagonal.join(","));
    let commands = [
        (vec!["table", "se3", "--show", "curvature", "--metric", &symbols], "in the stage"),
        (vec!["properties", "se3", "--metric", &symbols], ""),
        (vec!["equations", "so3+so3+so3", "--solve", "--metric", &more], "in the stage"),
        (vec!["table", "so(8)", "--show", "nabla_curvature", "--metric", &numbers], "in the stage"),
        (vec!["check", "E8", "--metric", &diagonal], "in the stage"),
        (vec!["transport", "E7", "--along", &along, "--along", &along, "--along", &along], ""),
    ];
    commands.map(|(command, stage)| (command.into_iter().map(String::from).collect(), stage)).into()
}

/// A line of the system's information on a process. If there is none, half a second is enough for
/// every stage.
fn of_system(id: u32, file: &str) -> Option<String> {
    let text = fs::read_to_string(format!("/proc/{id}/{file}")).ok();
    if text.is_none() {
        thread::sleep(Duration::from_millis(500));
    }
    text
}

/// Whether a process has computed for 0.2 s of processor time: it has read its space and is in its long stage.
fn has_computed(id: u32) -> bool {
    of_system(id, "stat").is_none_or(|stat| {
        // the times follow the name, which may contain spaces
        let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
        let ticks = fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<u64>().ok());
        ticks.sum::<u64>() >= 20
    })
}

/// Whether a process has installed a handler for SIGINT.
fn has_handler(id: u32) -> bool {
    of_system(id, "status").is_none_or(|status| {
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        caught.is_some_and(|mask| mask >> 1 & 1 == 1)
    })
}

/// Runs a command and sends it a signal once it computes.
fn signalled(arguments: &[String], signal: &str) -> Outcome {
    let mut child = program(Path::new("."))
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let id = child.id();
    assert!(reaches(&mut child, || has_computed(id)), "{arguments:?} has ended before");
    send(signal, &child);
    let status = wait(&mut child);
    let (mut out, mut err) = (String::new(), String::new());
    child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
    child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
    Outcome { status, out, err }
}

#[test]
fn a_signal_ends_every_command() {
    for (arguments, stage) in long() {
        for (signal, status) in [("INT", 130), ("TERM", 143)] {
            let outcome = signalled(&arguments, signal);
            assert_eq!(outcome.status, status, "{arguments:?}: {}", outcome.err);
            assert!(outcome.out.is_empty());
            for part in ["interrupted", stage] {
                assert!(outcome.err.contains(part), "{part}: {}", outcome.err);
            }
        }
    }
    // a program that waits for its input
    let mut child =
        program(Path::new(".")).args(["log", "so3"]).stdin(Stdio::piped()).spawn().unwrap();
    // `wait` would close the input
    let input = child.stdin.take();
    let id = child.id();
    assert!(reaches(&mut child, || has_handler(id)));
    send("INT", &child);
    assert_eq!(wait(&mut child), 130);
    drop(input);
}

#[test]
fn a_limit_on_the_time_names_the_stage() {
    for (arguments, stage) in long() {
        let limited = [&arguments[..], &["--timeout".into(), "2".into()]].concat();
        let outcome = run(Path::new("."), &limited, b"");
        assert_eq!(outcome.status, 1, "{arguments:?}: {}", outcome.err);
        assert!(outcome.out.is_empty());
        for part in ["exceeds its time limit of 2 s", stage, "--timeout"] {
            assert!(outcome.err.contains(part), "{part}: {}", outcome.err);
        }
    }
    // a limit that is not reached changes nothing, whatever its position
    let plain = run(Path::new("."), &["table", "so3@zero"], b"");
    for limited in
        [["--timeout", "1000", "table", "so3@zero"], ["table", "so3@zero", "--timeout", "1000"]]
    {
        assert_eq!(run(Path::new("."), &limited, b"").out, plain.out);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_the_memory_names_the_stage() {
    let metric = full(6);
    let table = ["table", "se3", "--show", "curvature", "--metric", &metric];
    let limited = [&table[..], &["--memory", "40M"]].concat();
    let outcome = run(Path::new("."), &limited, b"");
    assert_eq!(outcome.status, 1, "{}", outcome.err);
    for part in ["exceeds its memory limit of 40 MiB", "in the stage", "--memory"] {
        assert!(outcome.err.contains(part), "{part}: {}", outcome.err);
    }
    let plain = run(Path::new("."), &["info", "so3"], b"");
    assert_eq!(run(Path::new("."), &["info", "so3", "--memory", "4 GiB"], b"").out, plain.out);
}

#[test]
fn limits_are_sizes_and_seconds() {
    for (option, value) in [("--memory", "much"), ("--memory", "-1M"), ("--memory", "0")] {
        let outcome = run(Path::new("."), &["info", "so3", option, value], b"");
        assert_eq!(outcome.status, 2, "{option} {value}: {}", outcome.err);
    }
    for value in ["1000", "1e3s", "20m", "20 min", "2h"] {
        let outcome = run(Path::new("."), &["info", "so3", &format!("--timeout={value}")], b"");
        assert_eq!(outcome.status, 0, "{value}: {}", outcome.err);
    }
    for value in ["-1", "nan", "soon", "1d"] {
        let outcome = run(Path::new("."), &["info", "so3", &format!("--timeout={value}")], b"");
        assert_eq!(outcome.status, 2, "{value}: {}", outcome.err);
    }
}

/// A command that is stopped leaves its output file unchanged, and no temporary file.
#[test]
fn a_stopped_command_writes_no_file() {
    let folder = tempfile::TempDir::new().unwrap();
    fs::write(folder.path().join("kept"), "old").unwrap();
    let metric = full(6);
    let table = ["table", "se3", "--metric", &metric, "-o", "kept", "--timeout", "0.6"];
    assert_eq!(run(folder.path(), &table, b"").status, 1);
    assert_eq!(fs::read_to_string(folder.path().join("kept")).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// A limit ends a simulation like a signal: the rows so far are written.
#[test]
fn a_limit_keeps_the_rows_of_a_simulation() {
    let folder = tempfile::TempDir::new().unwrap();
    let problem = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.3, 1, 0.2]\n\
                   [integrator]\nmethod = \"rkmk4\"\nstep = 0.01\n[output]\nend = 1e5\nevery = 0.5\n";
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    let simulate = ["simulate", "problem.toml", "-o", "rows.csv", "--timeout", "0.5"];
    let outcome = run(folder.path(), &simulate, b"");
    assert_eq!(outcome.status, 1, "{}", outcome.err);
    for part in
        ["exceeds its time limit of 0.5 s", "rows up to this time to rows.partial.csv", "--timeout"]
    {
        assert!(outcome.err.contains(part), "{part}: {}", outcome.err);
    }
    let rows = fs::read_to_string(folder.path().join("rows.partial.csv")).unwrap();
    assert!(rows.lines().count() > 3);
}
