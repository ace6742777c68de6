//! `affinor simulate`: what is written, and what happens when something goes wrong.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "common/program.rs"]
mod program;

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::{TempDir, tempdir};

/// A spinning top that takes a while.
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
    let mut command = Command::new(env!("CARGO_BIN_EXE_affinor"));
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

/// Kills the run a few times, each time once it has saved something new, then lets it come to its end.
fn killed_and_resumed(folder: &Path, options: &[&str]) -> u32 {
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

#[test]
fn a_killed_run_goes_on_to_the_same_rows() {
    let folder = folder(TOP);
    let folder = folder.path();
    done(simulate(folder).args(["-o", "whole.csv"]));
    assert!(killed_and_resumed(folder, &[]) > 0);
    assert_eq!(
        fs::read(folder.join("whole.csv")).unwrap(),
        fs::read(folder.join("killed.csv")).unwrap()
    );
    // nothing is left behind
    assert!(!folder.join("c").exists() && !folder.join("c.rows").exists());
}

#[test]
fn an_ensemble_depends_on_no_threads_and_no_kills() {
    let problem = TOP.replace("end = 400", "end = 6").replace("samples = 40", "samples = 600");
    let folder = folder(&problem.replace("every = 0.25", "every = 3"));
    let folder = folder.path();
    for threads in ["1", "2", "3"] {
        let file = format!("{threads}.csv");
        done(simulate(folder).args(["--ensemble", "--threads", threads, "-o", &file]));
    }
    killed_and_resumed(folder, &["--ensemble"]);
    let rows = fs::read_to_string(folder.join("1.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + 3 * 600);
    for other in ["2.csv", "3.csv", "killed.csv"] {
        assert!(rows == fs::read_to_string(folder.join(other)).unwrap(), "{other}");
    }
}

#[test]
fn a_checkpoint_is_of_one_problem() {
    let folder = folder(TOP);
    let folder = folder.path();
    let mut child = simulate(folder)
        .args(["--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while !folder.join("c").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let resume = ["--checkpoint", "c", "--resume"];
    let message = refused(simulate(folder).args(resume).args(["--set", "w=0.2"]), 2);
    assert!(message.contains("another --set"), "{message}");
    fs::write(folder.join("top.toml"), TOP.replace("0.25", "0.5")).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("another problem"), "{message}");
    // nothing is written over, neither a checkpoint nor the problem
    for file in ["c", "top.toml"] {
        let message = refused(simulate(folder).args(["--checkpoint", file]), 2);
        assert!(message.contains("exists already"), "{message}");
    }
    fs::write(folder.join("c"), "{").unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c is no checkpoint"), "{message}");
}

/// Results up to what went wrong are kept, and the old file stays.
#[test]
fn what_is_no_number_is_told_with_time_and_state() {
    let problem = TOP.replace("-0.001*Omega1", "sqrt(3 - t)");
    let folder = folder(&problem);
    let folder = folder.path();
    fs::write(folder.join("rows.csv"), "old").unwrap();
    let message = refused(simulate(folder).args(["-o", "rows.csv"]), 1);
    for part in ["sqrt(3 - t) is NaN at t = 3", "Omega = [", "g = [", "13 rows", "partial.csv"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert_eq!(fs::read_to_string(folder.join("rows.csv")).unwrap(), "old");
    let rows = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
    assert_eq!(rows.lines().count(), 14);
    assert!(rows.lines().last().unwrap().starts_with("3,"));
}

/// Slopes that are numbers do not hide a potential that is none, nor a Hamiltonian.
#[test]
fn a_potential_is_a_number() {
    for integrator in ["tolerance = 1e-8", "step = 0.1", "step = 0.1\nmethod = \"rkmk4\""] {
        for potential in ["log(g33 - 2)", "g33 + log(3 - t) + 0*g11"] {
            let problem = format!(
                "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.3, 1, 0.2]\n\
                 forces.potential = \"{potential}\"\n[integrator]\n{integrator}\n\
                 [output]\nend = 5\nevery = 1\n"
            );
            let message = refused(&mut simulate(folder(&problem).path()), 1);
            for part in [&format!("the potential {potential} is"), "at t = ", "g = [", "row"] {
                assert!(message.contains(part), "{part}: {message}");
            }
        }
    }
    let problem = "space = \"so3\"\nhamiltonian = \"H1^2 + H2^2 + 2*H3^2 + log(H1 - 3)\"\n\
                   initial.momentum = [1, 0.2, 0.3]\noutput.end = 1\n";
    let message = refused(&mut simulate(folder(problem).path()), 1);
    assert!(message.contains("log(H1 - 3) is NaN"), "{message}");
}

/// A pipe takes what there is of a run as well.
#[test]
fn part_of_a_run_goes_to_a_pipe() {
    let folder = folder(&TOP.replace("-0.001*Omega1", "sqrt(3 - t)"));
    let output = simulate(folder.path()).args(["-o", "/dev/stdout"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(output.stdout.iter().filter(|byte| **byte == b'\n').count(), 14);
}

#[test]
fn an_event_is_a_number() {
    let problem = TOP.replace("every = 0.25", "every = 0.25\nstop = \"k\"");
    let folder = folder(&format!("{problem}[events]\nk = \"sqrt(2.9 - t)\"\n"));
    let message = refused(&mut simulate(folder.path()), 1);
    assert!(message.contains("the function of an event is not a number"), "{message}");
    assert!(message.contains("12 rows"), "{message}");
}

#[test]
fn what_blows_up_or_is_stiff_ends_with_a_word() {
    let explodes = TOP.replace("-0.001*Omega1", "Omega1^2");
    let message = refused(&mut simulate(folder(&explodes).path()), 1);
    assert!(message.contains("the steps become too small"), "{message}");
    let stiff = TOP.replace("0.001*Omega1", "1e9*Omega1");
    let stiff = stiff.replace("tolerance = 1e-12", "tolerance = 1e-6\nmax_steps = 10000");
    let message = refused(&mut simulate(folder(&stiff).path()), 1);
    assert!(message.contains("the problem is stiff"), "{message}");
    let fixed = TOP.replace("-0.001*Omega1", "Omega1^2");
    let fixed = fixed.replace("tolerance = 1e-12", "method = \"rkmk4\"\nstep = 0.05");
    let message = refused(&mut simulate(folder(&fixed).path()), 1);
    assert!(message.contains("t = "), "{message}");
}

/// Whatever grows beyond floats, is beyond their digits or is stiff, ends soon and with a word.
#[test]
fn nothing_is_waited_for_without_end() {
    let line = "space = \"R^1\"\nmetric = \"identity\"\ninitial.velocity = [0.3]\noutput.end = 1\n";
    for (force, word) in [
        ("exp(1000*t)", "exp(1000*t) is inf"),
        ("exp(exp(20*t))", "exp(exp(20*t)) is inf"),
        ("1/(0.5 - t)^3", "the steps become too small"),
        ("100*Omega1^3", "the steps become too small"),
    ] {
        let problem = folder(&format!("{line}forces.body = [\"{force}\"]\n"));
        let start = std::time::Instant::now();
        let message = refused(&mut simulate(problem.path()), 1);
        assert!(message.contains(word), "{force}: {message}");
        assert!(start.elapsed() < Duration::from_secs(120), "{force}: {:?}", start.elapsed());
    }
    let tolerance = |tolerance: &str| {
        folder(&format!("{line}forces.body = [\"sin(t)\"]\nintegrator.tolerance = {tolerance}\n"))
    };
    for small in ["1e-300", "1e-20", "9e-16"] {
        let message = refused(&mut simulate(tolerance(small).path()), 1);
        assert!(message.contains("floats do not resolve the tolerance"), "{message}");
    }
    done(&mut simulate(tolerance("1e-15").path()));
    let top = TOP.replace("tolerance = 1e-12", "tolerance = 1e-15").replace("end = 400", "end = 5");
    for method in ["rkmk54", "rkmk853", "projected853"] {
        let top = top.replace("[integrator]", &format!("[integrator]\nmethod = \"{method}\""));
        done(&mut simulate(folder(&top).path()));
    }
}

/// Where the rounding of time is a turn, there is no attitude to tell.
#[test]
fn a_phase_without_meaning_is_refused() {
    let body = |end: &str| {
        folder(&format!(
            "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.1, 2, 0.1]\n\
             [output]\nend = {end}\ncolumns = [\"t\"]\n"
        ))
    };
    for end in ["1e13", "1e15", "-1e15", "1e300"] {
        let message = refused(&mut simulate(body(end).path()), 1);
        assert!(message.contains("its rounding alone turns the body"), "{end}: {message}");
    }
    assert_eq!(times(body("1e9").path()), [0.0, 1e9]);
    // it does not turn
    let still = body("1e300");
    let text = fs::read_to_string(still.path().join("top.toml")).unwrap();
    fs::write(still.path().join("top.toml"), text.replace("[0.1, 2, 0.1]", "[0, 0, 0]")).unwrap();
    assert_eq!(times(still.path()), [0.0, 1e300]);
}

/// A potential of `|x|` has no slope where it has its corner.
#[test]
fn a_corner_is_a_place_of_rest() {
    let problem = "space = \"R^1\"\nmetric = \"identity\"\ninitial.velocity = [0]\n\
                   forces.potential = \"abs(x1)\"\n\
                   [output]\nend = 1\ncolumns = [\"x1\"]\n";
    assert_eq!(times(folder(problem).path()), [0.0, 0.0]);
}

#[test]
fn a_full_disk_is_told() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = folder(&TOP.replace("end = 400", "end = 1"));
    let message = refused(simulate(folder.path()).args(["-o", "/dev/full"]), 2);
    assert!(message.contains("cannot write /dev/full"), "{message}");
}

/// All formats hold the same numbers.
#[test]
fn formats_agree() {
    let folder = folder(&TOP.replace("end = 400", "end = 20"));
    let folder = folder.path();
    done(simulate(folder).args(["-o", "rows.csv"]));
    done(simulate(folder).args(["-o", "rows.json"]));
    let text = fs::read_to_string(folder.join("rows.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|value| value.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 81);
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.join("rows.json")).unwrap()).unwrap();
    assert_eq!(json["schema"], "affinor.run/1");
    assert_eq!(serde_json::from_value::<Vec<String>>(json["columns"].clone()).unwrap(), names);
    assert_eq!(serde_json::from_value::<Vec<Vec<f64>>>(json["rows"].clone()).unwrap(), rows);
    #[cfg(feature = "parquet")]
    {
        use parquet::file::reader::{FileReader, SerializedFileReader};
        done(simulate(folder).args(["-o", "rows.parquet"]));
        let file = fs::File::open(folder.join("rows.parquet")).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let mut count = 0;
        for (row, expected) in reader.get_row_iter(None).unwrap().zip(&rows) {
            let row = row.unwrap();
            for (k, (name, field)) in row.get_column_iter().enumerate() {
                assert_eq!(name, names[k]);
                assert_eq!(*field, parquet::record::Field::Double(expected[k]));
            }
            count += 1;
        }
        assert_eq!(count, rows.len());
    }
}

/// A potential conserves the energy on every group, in both invariances, and its power is the rate of the kinetic
/// energy (109).
#[test]
fn potentials_conserve_the_energy_on_every_group() {
    let cases = [
        ("space = \"so2\"", 1, "g11^2 + g21"),
        ("space = \"so3\"", 3, "g33 + g12*g23"),
        ("space = \"se2\"", 3, "g13^2 + g23*g11"),
        ("space = \"se3\"", 6, "g14^2 + g24*g31 + sin(g34)"),
        ("space = \"sl2\"", 3, "g11^2 + g21^2 + g12^2 + g22^2"),
        ("space = \"heisenberg3\"", 3, "g12^2 + g13^2*g23"),
        (
            "definition.basis = [\"x\", \"y\", \"z\"]\ndefinition.brackets = \"[x, y] = z\"",
            3,
            "x1^2 + x2^4 + x3^2*x1",
        ),
        ("space = \"aff1\"", 2, "1/g11 + g12^2 + g11"),
        ("space = \"su2\"", 3, "g11 + g12^2"),
    ];
    for (space, n, potential) in cases {
        for invariance in ["left", "right"] {
            let metric: Vec<String> = (0..n)
                .map(|i: i32| {
                    let entry = |j: i32| match (i - j).abs() {
                        0 => format!("\"{}/2\"", 2 + i),
                        1 => "\"1/5\"".into(),
                        _ => "\"1/20\"".into(),
                    };
                    format!("[{}]", (0..n).map(entry).collect::<Vec<_>>().join(","))
                })
                .collect();
            let velocity: Vec<String> =
                (0..n).map(|i| format!("{}", 0.3 - 0.2 * f64::from(i))).collect();
            let problem = format!(
                "{space}\nmetric = [{}]\ninvariance = \"{invariance}\"\n\
                 [initial]\nvelocity = [{}]\ncoordinates = [{}]\n\
                 [forces]\npotential = \"{potential}\"\n\
                 [integrator]\ntolerance = 1e-12\n\
                 [output]\nend = 2\nevery = 0.01\ncolumns = [\"t\", \"kinetic\", \"energy\", \"power\"]\n",
                metric.join(","),
                velocity.join(","),
                velocity.join(","),
            );
            let output = done(&mut simulate(folder(&problem).path()));
            let text = String::from_utf8(output.stdout).unwrap();
            let column = |k: usize| -> Vec<f64> {
                text.lines()
                    .skip(1)
                    .map(|line| line.split(',').nth(k).unwrap().parse().unwrap())
                    .collect()
            };
            let (kinetic, energy, power) = (column(1), column(2), column(3));
            let off = energy.iter().map(|e| (e - energy[0]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-10, "{space}, {invariance}: {off}");
            let moved = kinetic.iter().map(|t| (t - kinetic[0]).abs()).fold(0.0, f64::max);
            assert!(moved > 1e-3, "{space}, {invariance}: the potential does no work");
            // Simpson's rule
            let weighted = power.windows(3).step_by(2).map(|p| p[0] + 4.0 * p[1] + p[2]);
            let work = weighted.sum::<f64>() * 0.01 / 3.0;
            let off = (work - (kinetic[200] - kinetic[0])).abs();
            assert!(off < 1e-5 * (1.0 + moved), "{space}, {invariance}: power off by {off}");
        }
    }
}

/// Sections of a free body come once a period, known to 12 digits; the run ends at an event if so asked.
#[test]
fn events_are_located() {
    const PERIOD: f64 = 6.862_616_178_058_116;
    let body = "space = \"so3\"\nmetric = \"diag(0.6, 0.8, 1)\"\n\
                initial.momentum = [1.8, 0.4, -0.9]\nevents = { section = \"H2\" }\n";
    let integrators = [
        (
            "method = \"rkmk54\"
tolerance = 1e-13",
            1e-11,
        ),
        ("step = 0.01", 1e-12),
        ("method = \"exact\"", 1e-13),
    ];
    for (integrator, tolerance) in integrators {
        let output = "[output]\nend = 30\nevery = 0.3\nsection = \"section\"\n";
        let problem = format!("{body}{output}[integrator]\n{integrator}\n");
        let found = done(&mut simulate(folder(&problem).path()));
        let text = String::from_utf8(found.stdout).unwrap();
        let times: Vec<f64> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').next().unwrap().parse().unwrap())
            .collect();
        // two in each period
        assert_eq!(times.len(), 9, "{integrator}: {times:?}");
        for pair in times.windows(3) {
            assert!((pair[2] - pair[0] - PERIOD).abs() < tolerance, "{integrator}: {pair:?}");
        }
        let problem = problem.replace("section = \"section\"", "stop = \"section\"");
        let found = done(&mut simulate(folder(&problem).path()));
        let text = String::from_utf8(found.stdout).unwrap();
        let last = text.lines().last().unwrap();
        assert_eq!(last.split(',').next().unwrap().parse::<f64>().unwrap(), times[0]);
    }
}

/// The first column of what is written.
fn times(folder: &Path) -> Vec<f64> {
    let output = done(&mut simulate(folder));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect()
}

/// However far apart rows are, no event is passed over: of a body that flips, and of uniform turns, whose steps under control
/// have no error that would keep them short.
#[test]
fn events_are_seen_between_rows_far_apart() {
    let flips = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.1, 2, 0.1]\n\
                 events = { turn = \"H2\" }\n";
    let section = |problem: &str, integrator: &str, every: f64| {
        let output = format!("[output]\nend = 100\nevery = {every}\nsection = \"turn\"\n");
        times(folder(&format!("{problem}{output}[integrator]\n{integrator}\n")).path())
    };
    let same = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8), "{a:?} and {b:?}");
    };
    let all = section(flips, "method = \"dmv10\"\nstep = 0.01", 100.0);
    assert_eq!(all.len(), 14);
    for every in [100.0, 5.0, 0.1] {
        same(&section(flips, "method = \"exact\"", every), &all);
    }
    same(&section(flips, "method = \"rkmk853\"\ntolerance = 1e-14", 100.0), &all);
    // a stop at the first, and backwards, where the last one is as near
    for (end, first) in [(100.0, all[0]), (-100.0, all[0] - (all[1] - all[0]))] {
        let output = format!("[output]\nend = {end}\nstop = \"turn\"\n");
        let found = times(folder(&format!("{flips}{output}")).path());
        assert!((found[found.len() - 1] - first).abs() < 1e-8, "{found:?}, not {first}");
    }
    let turns = "metric = \"identity\"\ninitial.velocity = [0, 0, 1, 0, 0, 0]\n";
    for (space, entry) in [("se3", "g11"), ("so(4)", "g33 - 1/2")] {
        let problem = format!("space = \"{space}\"\n{turns}events = {{ turn = \"{entry}\" }}\n");
        let found = section(&problem, "method = \"rkmk853\"", 100.0);
        let dense = section(&problem, "method = \"rkmk4\"\nstep = 0.05", 100.0);
        assert!(dense.len() > 25, "{space}: {dense:?}");
        assert_eq!(found.len(), dense.len(), "{space}");
    }
}

/// A table acts between rows far apart, and its corners cost no digits: the impulse is its integral.
#[test]
fn a_table_is_not_passed_over() {
    let thruster = "t,M1,M2,M3\n20,0,0,0\n20.25,0.5,0,0\n20.75,0.5,0,0\n21,0,0,0\n";
    let pulse = "t,a,b,c\n0,0,0,0\n50,0,0,0\n50.001,1000,0,0\n50.002,0,0,0\n";
    for (table, rate, end) in [(thruster, 0.05, 0.425), (pulse, 0.05, 1.05), (pulse, 0.0, 1.0)] {
        for (start, stop, sign) in [(0.0, 100.0, 1.0), (100.0, 0.0, -1.0)] {
            for every in [100.0, 50.0, 7.0, 0.5] {
                for integrator in ["rkmk853", "rkmk54", "projected853"] {
                    let problem = format!(
                        "space = \"so3\"\nmetric = \"diag(1, 2, 2.5)\"\n\
                         [initial]\ntime = {start}\nvelocity = [{rate}, 0, 0]\n\
                         [forces]\ntable = \"table.csv\"\n\
                         [integrator]\nmethod = \"{integrator}\"\n\
                         [output]\nend = {stop}\nevery = {every}\ncolumns = [\"Omega1\", \"t\"]\n"
                    );
                    let folder = folder(&problem);
                    fs::write(folder.path().join("table.csv"), table).unwrap();
                    let found = times(folder.path());
                    assert_eq!(found.len(), (100.0_f64 / every).ceil() as usize + 1);
                    let expected = rate + sign * (end - rate);
                    let off = (found[found.len() - 1] - expected).abs();
                    assert!(off < 1e-10, "{integrator}, {every}: off by {off:e}");
                }
            }
        }
    }
}

/// With corners between rows and events among them: to the same rows after a kill.
#[test]
fn a_table_survives_a_kill() {
    let problem =
        TOP.replace("body =", "table = \"table.csv\"\nbody =").replace("end = 400", "end = 100");
    let problem = problem.replace("every = 0.25", "every = 5");
    let folder = folder(&format!("{problem}[events]\nflip = \"Omega2\"\n"));
    let folder = folder.path();
    let row = |k: u32| format!("{},{},0.1,0\n", f64::from(k) * 0.37, 0.2 * f64::from(k % 3));
    let rows: String = (0..300).map(row).collect();
    fs::write(folder.join("table.csv"), format!("t,a,b,c\n{rows}")).unwrap();
    done(simulate(folder).args(["-o", "whole.csv"]));
    assert!(killed_and_resumed(folder, &[]) > 0);
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    assert_eq!(read("whole.csv"), read("killed.csv"));
}

/// A motion with events is resumed to the same rows.
#[test]
fn events_survive_a_kill() {
    let problem = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.1, 2, 0.1]\n\
                   events = { turn = \"H2\" }\n\
                   [output]\nend = 100\nevery = 50\nsection = \"turn\"\n";
    let folder = folder(problem);
    let folder = folder.path();
    done(simulate(folder).args(["-o", "whole.csv"]));
    killed_and_resumed(folder, &[]);
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    assert_eq!(read("whole.csv"), read("killed.csv"));
}

/// A member that was stopped is told though the run was killed behind it.
#[test]
fn a_stopped_member_is_not_forgotten() {
    let problem = TOP.replace("-0.001*Omega1", "sqrt(0.2 - w)").replace("end = 400", "end = 3");
    let folder = folder(&problem.replace("samples = 40", "samples = 600"));
    let folder = folder.path();
    let whole = refused(simulate(folder).args(["--ensemble", "-o", "whole.csv"]), 1);
    let resume = ["--checkpoint", "c", "--checkpoint-every", "0", "--resume", "-o", "rows.csv"];
    let mut child =
        simulate(folder).arg("--ensemble").args(resume).stderr(Stdio::null()).spawn().unwrap();
    while !folder.join("c").exists() && child.try_wait().unwrap().is_none() {}
    child.kill().unwrap();
    child.wait().unwrap();
    let message = refused(simulate(folder).arg("--ensemble").args(resume), 1);
    let first = |text: &str| text.lines().find(|line| line.contains("member")).map(String::from);
    assert_eq!(first(&message), first(&whole), "{message}");
    assert!(first(&message).unwrap().contains("sqrt(0.2 - w) is NaN"), "{message}");
    assert_eq!(
        fs::read(folder.join("whole.partial.csv")).unwrap(),
        fs::read(folder.join("rows.partial.csv")).unwrap()
    );
}

/// Where rows cannot go is told before the work, which would be lost.
#[test]
fn places_are_looked_at_first() {
    let folder = folder(&TOP.replace("end = 400", "end = 1e6"));
    let folder = folder.path();
    let cases = [
        (&["-o", "top.toml"][..], "top.toml is the input"),
        (&["-o", "none/rows.csv"], "cannot write none/rows.csv"),
        (&["-o", "."], "cannot write ."),
        (&["-o", "rows.csv", "--checkpoint", "./rows.csv"], "one file"),
        (&["-o", "c.rows", "--checkpoint", "c"], "one file"),
    ];
    for (options, expected) in cases {
        let message = refused(simulate(folder).args(options), 2);
        assert!(message.contains(expected), "{message}");
        let left: Vec<_> = fs::read_dir(folder).unwrap().collect();
        assert_eq!(left.len(), 1, "{options:?}: {left:?}");
    }
}

/// No checkpoint makes the program panic or hang: each number of one is replaced by others.
#[test]
fn checkpoints_that_were_changed_do_no_harm() {
    let fixed = TOP.replace("tolerance = 1e-12", "method = \"rkmk4\"\nstep = 0.01");
    let bounded = TOP.replace("tolerance = 1e-12", "tolerance = 1e-12\nmax_steps = 10000");
    for problem in [bounded, fixed] {
        let problem = problem.replace("end = 400", "end = 20").replace("0.25", "5");
        let folder = folder(&problem);
        let folder = folder.path();
        let mut child = simulate(folder)
            .args(["--checkpoint", "c", "--checkpoint-every", "0"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let begun = || !saved(folder)["snapshot"].is_null();
        while !begun() && child.try_wait().unwrap().is_none() {}
        child.kill().unwrap();
        child.wait().unwrap();
        let saved = fs::read_to_string(folder.join("c")).unwrap();
        let saved: serde_json::Value = serde_json::from_str(&saved).unwrap();
        let rows = fs::read(folder.join("c.rows")).unwrap();
        let mut places = vec![];
        numbers(&saved, String::new(), &mut places);
        assert!(places.len() > 10, "{places:?}");
        for place in places {
            for value in ["-1", "0", "1e300", "18446744073709551615", "null", "[]"] {
                let mut changed = saved.clone();
                *changed.pointer_mut(&place).unwrap() = serde_json::from_str(value).unwrap();
                println!("{place} = {value}");
                fs::write(folder.join("c"), changed.to_string()).unwrap();
                fs::write(folder.join("c.rows"), &rows).unwrap();
                let mut command = simulate(folder);
                command.args(["--checkpoint", "c", "--resume"]).stdout(Stdio::null());
                let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
                let status = program::wait(&mut child);
                assert!((0..=2).contains(&status), "{place} = {value}: {status}");
            }
        }
    }
}

/// Pointers to all numbers.
fn numbers(value: &serde_json::Value, at: String, found: &mut Vec<String>) {
    match value {
        serde_json::Value::Number(_) => found.push(at),
        serde_json::Value::Array(items) => {
            items
                .iter()
                .enumerate()
                .for_each(|(k, item)| numbers(item, format!("{at}/{k}"), found));
        }
        serde_json::Value::Object(items) => {
            items.iter().for_each(|(key, item)| numbers(item, format!("{at}/{key}"), found));
        }
        _ => {}
    }
}

/// Sends a signal to a run that is on its way; its status and what it said.
fn interrupted(command: &mut Command, signal: &str, begun: impl Fn() -> bool) -> (i32, String) {
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

/// The checkpoint, or null if there is none.
fn saved(folder: &Path) -> serde_json::Value {
    let saved = fs::read_to_string(folder.join("c")).unwrap_or_default();
    serde_json::from_str(&saved).unwrap_or_default()
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

/// How many rows the checkpoint counts.
fn saved_rows(folder: &Path) -> u64 {
    saved(folder)["rows"].as_u64().unwrap_or(0)
}

fn later(start: Instant) -> bool {
    start.elapsed() > Duration::from_millis(500)
}

/// A table, a mesh or the definition of the space is of the problem as well as its own text.
#[test]
fn a_checkpoint_is_of_the_files_of_its_problem() {
    let pyramid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4";
    let brackets = "basis = [\"x\", \"y\", \"z\"]\nbrackets = \"[x, y] = z\"";
    let table = "t,a,b,c\n0,0,0,0\n10,0.1,0,0\n";
    let body = TOP.replace("metric = \"diag(1, 2, 3)\"", "");
    let body = body.replace(
        "[ensemble]",
        "[inertia]\nparts = [{ mesh = \"other.obj\", mass = 1 }]\n[ensemble]",
    );
    let cases = [
        ("other.csv", table, TOP.replace("[forces]", "[forces]\ntable = \"other.csv\"")),
        ("other.obj", pyramid, body),
        (
            "other.toml",
            brackets,
            TOP.replace("so3", "other.toml").replace("g33 + g12*g23", "x1*x2"),
        ),
    ];
    for (file, content, problem) in cases {
        let short =
            problem.replace("end = 400", "end = 4").replace("every = 0.25", "every = 0.005");
        let folder = folder(&short);
        let folder = folder.path();
        fs::write(folder.join(file), content).unwrap();
        let message = refused(simulate(folder).args(["-o", file]), 2);
        assert!(message.contains("would lose it"), "{message}");
        let mut run = simulate(folder);
        run.args(["--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"]);
        let (status, message) = interrupted(&mut run, "INT", || saved_rows(folder) > 0);
        assert_eq!(status, 130, "{message}");
        let resume = ["--checkpoint", "c", "--resume", "-o", "rows.csv"];
        fs::write(folder.join(file), format!("{content}\n ")).unwrap();
        let message = refused(simulate(folder).args(resume), 2);
        let expected = format!("c was saved with another content of {file}");
        assert!(message.contains(&expected), "{message}");
        fs::write(folder.join(file), content).unwrap();
        done(simulate(folder).args(resume));
    }
}

/// A file of the name of the rows is nobody's but of who made it.
#[test]
fn rows_of_a_checkpoint_take_no_place_of_others() {
    let folder = folder(&TOP.replace("end = 400", "end = 1"));
    let folder = folder.path();
    fs::write(folder.join("c.rows"), "mine").unwrap();
    for resume in [&[][..], &["--resume"]] {
        let message = refused(simulate(folder).args(["--checkpoint", "c"]).args(resume), 2);
        assert!(message.contains("c.rows exists already"), "{message}");
        assert_eq!(fs::read_to_string(folder.join("c.rows")).unwrap(), "mine");
        assert!(!folder.join("c").exists());
    }
}

/// Rows are not left without their checkpoint, whatever ends the run before the first is due.
#[test]
fn a_run_that_stops_leaves_no_rows_alone() {
    let broken = TOP.replace("-0.001*Omega1", "sqrt(3 - t)");
    let refusing = TOP.replace("tolerance = 1e-12", "method = \"exact\"");
    for (problem, left) in [(broken, true), (refusing, false)] {
        let folder = folder(&problem);
        let folder = folder.path();
        refused(simulate(folder).args(["--checkpoint", "c"]), 1);
        assert_eq!(folder.join("c.rows").exists(), left);
        assert_eq!(folder.join("c").exists(), left);
        refused(simulate(folder).args(["--checkpoint", "c", "--resume"]), 1);
    }
}

#[test]
fn a_checkpoint_without_its_rows_is_told() {
    let folder = folder(TOP);
    let folder = folder.path();
    let mut run = simulate(folder);
    run.args(["--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"]);
    interrupted(&mut run, "INT", || saved_rows(folder) > 3);
    let resume = ["--checkpoint", "c", "--resume"];
    fs::write(folder.join("c.rows"), [0; 17]).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c.rows is too short: c counts"), "{message}");
    fs::remove_file(folder.join("c.rows")).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c.rows is missing: c counts"), "{message}");
    assert!(!folder.join("c.rows").exists());
}

/// A table of forces says where it is wrong, and a first row is not taken for names.
#[test]
fn tables_have_names_and_numbers() {
    let folder = folder(&TOP.replace("[forces]", "[forces]\ntable = \"pulse.csv\""));
    let folder = folder.path();
    let cases = [
        ("0,0,0,0\n1,5,0,0\n", "names its columns", "pulse.csv:1:1"),
        ("\u{feff}0, 1/2, -1e3, pi\n1,5,0,0\n", "names its columns", "pulse.csv:1:1"),
        ("# c\nt,a,b,c\n0,1,2,3\n", "`t` is no number", "pulse.csv:2:1"),
        ("t,a,b,c\n\n0,0,0,0\n1,5,x,0\n", "`x` is no number", "pulse.csv:4:5"),
        ("t,a,b,c\n0,0,0,0\n1,5,0\n", "a row of 3 numbers", "pulse.csv:3:1"),
    ];
    for (table, what, place) in cases {
        fs::write(folder.join("pulse.csv"), table).unwrap();
        let message = refused(&mut simulate(folder), 2);
        assert!(message.contains(what) && message.contains(place), "{message}");
    }
}

/// What is said of one motion is said once of many.
#[test]
fn an_ensemble_says_its_method_and_notes() {
    let problem = TOP.replace("diag(1, 2, 3)", "diag(1, 2, -3)").replace("end = 400", "end = 0.5");
    let folder = folder(&problem);
    for (options, whose) in [(&[][..], ""), (&["--ensemble"], "member 1: ")] {
        let output = done(simulate(folder.path()).args(options));
        let message = String::from_utf8(output.stderr).unwrap();
        let indefinite = format!("note: {whose}the metric is indefinite");
        for expected in [&*indefinite, "note: method rkmk853: "] {
            assert_eq!(message.matches(expected).count(), 1, "{message}");
        }
    }
}

/// Formulas of quantities and large numbers leave the summary within 80 columns.
#[test]
fn the_summary_is_as_wide_as_a_terminal() {
    let long = ["2.5*Omega1"; 9].join(" + ");
    let problem = format!("{TOP}[quantities]\nk = \"1e290*({long})\"\nlast = \"h1\"\n");
    let problem = problem.replace("end = 400", "end = 0.5").replace("[1, \"w\"", "[-1, \"w\"");
    let free = "space = \"so(4)\"\nmetric = \"identity\"\n\
                initial.velocity = [1, 2, 3, 4, 5, 6]\noutput = { end = 1, columns = [\"t\"] }";
    for (problem, expected) in [(&*problem, &long), (free, &"H1^2 + H2^2".to_string())] {
        let output = done(&mut simulate(folder(problem).path()));
        let message = String::from_utf8(output.stderr).unwrap();
        let table = message.split_once("top: method").unwrap().1;
        assert!(table.lines().all(|line| line.len() <= 80), "{message}");
        let words = |text: &str| text.split_whitespace().map(String::from).collect::<Vec<_>>();
        // nothing of a formula is lost, though numbers stand between its lines
        let mut found = words(table).into_iter();
        assert!(
            words(expected).iter().all(|word| found.any(|other| other.contains(word))),
            "{message}"
        );
    }
}
