//! Ensembles that resume from a checkpoint.

use super::running::{interrupted, kill, killed_and_resumed, reaches, saved, saved_rows};
use super::{TOP, done, folder, refused, simulate};
use std::fs;
use std::process::Stdio;

/// An ensemble of many short runs.
fn many() -> String {
    let problem = TOP.replace("end = 400", "end = 6").replace("samples = 40", "samples = 600");
    problem.replace("every = 0.25", "every = 3")
}

#[test]
fn a_single_run_has_no_checkpoint() {
    let folder = folder(TOP);
    let message = refused(simulate(folder.path()).args(["--checkpoint", "c"]), 2);
    assert!(message.contains("--ensemble"), "{message}");
}

#[test]
fn an_ensemble_depends_on_no_threads_and_no_kills() {
    let folder = folder(&many());
    let folder = folder.path();
    for threads in ["1", "2", "3"] {
        let file = format!("{threads}.csv");
        done(simulate(folder).args(["--ensemble", "--threads", threads, "-o", &file]));
    }
    killed_and_resumed(folder);
    let rows = fs::read_to_string(folder.join("1.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + 3 * 600);
    for other in ["2.csv", "3.csv", "killed.csv"] {
        assert!(rows == fs::read_to_string(folder.join(other)).unwrap(), "{other}");
    }
    // no temporary file remains
    assert!(!folder.join("c").exists() && !folder.join("c.rows").exists());
}

#[test]
fn a_checkpoint_is_of_one_problem() {
    let folder = folder(&many());
    let folder = folder.path();
    let mut child = simulate(folder)
        .args(["--ensemble", "--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    reaches(&mut child, || folder.join("c").exists());
    kill(child);
    let resume = ["--ensemble", "--checkpoint", "c", "--resume"];
    let message = refused(simulate(folder).args(resume).args(["--set", "w=0.2"]), 2);
    assert!(message.contains("a different --set"), "{message}");
    fs::write(folder.join("top.toml"), many().replace("every = 3", "every = 2")).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("a different problem"), "{message}");
    // neither a checkpoint nor the problem file is overwritten
    for file in ["c", "top.toml"] {
        let message = refused(simulate(folder).args(["--ensemble", "--checkpoint", file]), 2);
        assert!(message.contains("exists already"), "{message}");
    }
    fs::write(folder.join("c"), "{").unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c is not a checkpoint"), "{message}");
}

/// The error of a member is reported, even if the run was killed after the error.
#[test]
fn a_stopped_member_is_not_forgotten() {
    let problem = TOP.replace("-0.001*Omega1", "sqrt(0.2 - w)").replace("end = 400", "end = 3");
    let folder = folder(&problem.replace("samples = 40", "samples = 600"));
    let folder = folder.path();
    let whole = refused(simulate(folder).args(["--ensemble", "-o", "whole.csv"]), 1);
    let resume = ["--checkpoint", "c", "--checkpoint-every", "0", "--resume", "-o", "rows.csv"];
    let mut child =
        simulate(folder).arg("--ensemble").args(resume).stderr(Stdio::null()).spawn().unwrap();
    reaches(&mut child, || folder.join("c").exists());
    kill(child);
    let message = refused(simulate(folder).arg("--ensemble").args(resume), 1);
    let first = |text: &str| text.lines().find(|line| line.contains("member")).map(String::from);
    assert_eq!(first(&message), first(&whole), "{message}");
    assert!(first(&message).unwrap().contains("sqrt(0.2 - w) is NaN"), "{message}");
    assert_eq!(
        fs::read(folder.join("whole.partial.csv")).unwrap(),
        fs::read(folder.join("rows.partial.csv")).unwrap()
    );
}

/// A damaged checkpoint does not make the program panic or hang: each number is replaced by others
/// in turn.
#[ignore = "long: runs the program some 20 times"]
#[test]
fn checkpoints_that_were_changed_do_no_harm() {
    let folder = folder(&many());
    let folder = folder.path();
    let mut child = simulate(folder)
        .args(["--ensemble", "--checkpoint", "c", "--checkpoint-every", "0"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    reaches(&mut child, || saved_rows(folder) > 0);
    kill(child);
    let saved = fs::read_to_string(folder.join("c")).unwrap();
    let saved: serde_json::Value = serde_json::from_str(&saved).unwrap();
    let rows = fs::read(folder.join("c.rows")).unwrap();
    let mut places = vec![];
    numbers(&saved, String::new(), &mut places);
    assert!(places.len() > 1, "{places:?}");
    for place in places {
        for value in ["-1", "0", "1e300", "18446744073709551615", "null", "[]"] {
            let mut changed = saved.clone();
            *changed.pointer_mut(&place).unwrap() = serde_json::from_str(value).unwrap();
            println!("{place} = {value}");
            fs::write(folder.join("c"), changed.to_string()).unwrap();
            fs::write(folder.join("c.rows"), &rows).unwrap();
            let mut command = simulate(folder);
            command.args(["--ensemble", "--checkpoint", "c", "--resume"]).stdout(Stdio::null());
            let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
            let status = crate::program::wait(&mut child);
            assert!((0..=2).contains(&status), "{place} = {value}: {status}");
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

/// A run resumes only if the tables, meshes and definitions of its problem are unchanged.
#[test]
fn a_checkpoint_is_of_the_files_of_its_problem() {
    let pyramid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4";
    let brackets = "basis = [\"x\", \"y\", \"z\"]\nbrackets = \"[x, y] = z\"";
    let table = "t,M1,M2,M3\n0,0,0,0\n10,0.1,0,0\n";
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
            problem.replace("end = 400", "end = 4").replace("samples = 40", "samples = 600");
        let folder = folder(&short);
        let folder = folder.path();
        fs::write(folder.join(file), content).unwrap();
        let message = refused(simulate(folder).args(["-o", file]), 2);
        assert!(message.contains("would overwrite it"), "{message}");
        let mut run = simulate(folder);
        run.args(["--ensemble", "--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"]);
        let (status, message) = interrupted(&mut run, "INT", || saved_rows(folder) > 0);
        assert_eq!(status, 130, "{message}");
        let resume = ["--ensemble", "--checkpoint", "c", "--resume", "-o", "rows.csv"];
        fs::write(folder.join(file), format!("{content}\n ")).unwrap();
        let message = refused(simulate(folder).args(resume), 2);
        let expected = format!("c was saved with a different content of {file}");
        assert!(message.contains(&expected), "{message}");
        fs::write(folder.join(file), content).unwrap();
        done(simulate(folder).args(resume));
    }
}

/// An unrelated file with the name of the rows is left unchanged.
#[test]
fn rows_of_a_checkpoint_take_no_place_of_others() {
    let folder = folder(&TOP.replace("end = 400", "end = 1"));
    let folder = folder.path();
    fs::write(folder.join("c.rows"), "mine").unwrap();
    for resume in [&[][..], &["--resume"]] {
        let message =
            refused(simulate(folder).args(["--ensemble", "--checkpoint", "c"]).args(resume), 2);
        assert!(message.contains("c.rows exists already"), "{message}");
        assert_eq!(fs::read_to_string(folder.join("c.rows")).unwrap(), "mine");
        assert!(!folder.join("c").exists());
    }
}

/// The rows always have a checkpoint, however early a run ends.
#[test]
fn a_run_that_stops_leaves_no_rows_alone() {
    let broken = TOP.replace("-0.001*Omega1", "sqrt(3 - t)").replace("samples = 40", "samples = 4");
    let refusing = TOP.replace("tolerance = 1e-12", "method = \"exact\"");
    for (problem, left) in [(broken, true), (refusing, false)] {
        let folder = folder(&problem);
        let folder = folder.path();
        refused(simulate(folder).args(["--ensemble", "--checkpoint", "c"]), 1);
        assert_eq!(folder.join("c.rows").exists(), left);
        assert_eq!(folder.join("c").exists(), left);
        refused(simulate(folder).args(["--ensemble", "--checkpoint", "c", "--resume"]), 1);
    }
}

#[test]
fn a_checkpoint_without_its_rows_is_told() {
    let folder = folder(&many());
    let folder = folder.path();
    let mut run = simulate(folder);
    run.args(["--ensemble", "--checkpoint", "c", "--checkpoint-every", "0", "-o", "rows.csv"]);
    interrupted(&mut run, "INT", || saved_rows(folder) > 3);
    let resume = ["--ensemble", "--checkpoint", "c", "--resume"];
    fs::write(folder.join("c.rows"), [0; 17]).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c.rows is too short: according to c, it contains"), "{message}");
    fs::remove_file(folder.join("c.rows")).unwrap();
    let message = refused(simulate(folder).args(resume), 2);
    assert!(message.contains("c.rows is missing: according to c, it contains"), "{message}");
    let mut counted = saved(folder);
    for (rows, expected) in [(1, "it contains 1 row"), (2, "it contains 2 rows")] {
        counted["rows"] = rows.into();
        fs::write(folder.join("c"), counted.to_string()).unwrap();
        let message = refused(simulate(folder).args(resume), 2);
        assert!(message.contains(expected), "{message}");
    }
    assert!(!folder.join("c.rows").exists());
}
