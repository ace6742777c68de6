//! Options that override keys of the file.

use super::running::{interrupted, saved_rows};
use super::{TOP, done, folder, refused, simulate};
use std::fs;
use std::path::Path;

const SHORT: &str = "end = 4";

fn rows(folder: &Path, options: &[&str]) -> String {
    String::from_utf8(done(simulate(folder).args(options)).stdout).unwrap()
}

/// Options give the rows of a file with the same values.
#[test]
fn options_are_keys_of_the_file() {
    let top = TOP.replace("end = 400", SHORT);
    let integrator = "tolerance = 1e-12";
    let cases: [(&[&str], &str, &str); 8] = [
        (
            &["--method", "rkmk4", "--step", "w^2/2"],
            integrator,
            "method = \"rkmk4\"\nstep = \"w^2/2\"",
        ),
        (&["--step", "0.01"], integrator, "step = 0.01"),
        (&["--tolerance", "1e-6"], integrator, "tolerance = 1e-6"),
        (&["--method", "rkmk54"], integrator, "tolerance = 1e-12\nmethod = \"rkmk54\""),
        (&["--end", "2"], SHORT, "end = 2"),
        (&["--end=-2*w"], SHORT, "end = \"-2*w\""),
        (&["--every", "pi/4"], "every = 0.25", "every = \"pi/4\""),
        (&["--end", "1", "--every", "1/8"], "end = 4\nevery = 0.25", "end = 1\nevery = 0.125"),
    ];
    let original = folder(&top);
    let whole = rows(original.path(), &[]);
    for (options, old, new) in cases {
        assert!(top.contains(old), "{old}");
        let found = rows(original.path(), options);
        assert_eq!(found, rows(folder(&top.replace(old, new)).path(), &[]), "{options:?}");
        assert_ne!(found, whole, "{options:?}");
    }
    // a list of times ends at its last one
    let listed = folder(&top.replace("end = 4\nevery = 0.25", "times = [1, 4]"));
    assert_eq!(rows(listed.path(), &["--every", "0.25"]), whole);
    assert_eq!(rows(listed.path(), &["--end", "4", "--every", "0.25"]), whole);
}

/// If an option chooses a method, the keys for the other kind of step size are ignored, and only
/// these.
#[test]
fn methods_are_compared_without_editing_the_file() {
    let fixed = TOP.replace("end = 400", SHORT).replace("tolerance = 1e-12", "step = 0.01");
    let controlled =
        fixed.replace("step = 0.01", "tolerance = 1e-12\nmax_step = 1\nmax_steps = 99");
    let (fixed, controlled) = (folder(&fixed), folder(&controlled));
    for (folder, method) in [(&fixed, "cf4"), (&controlled, "projected853")] {
        let output = done(simulate(folder.path()).args(["--method", method]));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(&format!("top: method {method}")), "{message}");
    }
    done(simulate(fixed.path()).args(["--method", "rkmk853"]));
    done(simulate(controlled.path()).args(["--method", "cf4", "--step", "0.01"]));
    done(simulate(controlled.path()).args(["--step", "0.01"]));
    let message = refused(simulate(controlled.path()).args(["--method", "cf4"]), 1);
    assert!(message.contains("cf4") && message.contains("it needs a step"), "{message}");
}

/// Options have the checks and messages of the keys, with the option as location.
#[test]
fn options_are_checked_as_keys_are() {
    let folder = folder(&TOP.replace("end = 400", SHORT));
    let cases: [(&[&str], &str, &str, i32); 10] = [
        (&["--method", "rk4"], "--method:1:1", "`rk4` is not a method", 2),
        (&["--step", "0"], "--step:1:1", "0 is not positive", 2),
        (&["--step", "2*x"], "--step:1:3", "`x` is not a known name here", 2),
        (&["--step", "inf"], "--step:1:1", "`inf` is not a known name here", 2),
        (&["--tolerance", "1/0"], "--tolerance:1:1", "`1/0` is inf, which is not finite", 1),
        (&["--tolerance", "1e-20"], "", "is too small for floats", 1),
        (&["--method", "rkmk853", "--step", "1"], "--step:1:1", "has no `step`", 2),
        (
            &["--method", "cf4", "--step", "1", "--tolerance", "1e-3"],
            "--tolerance:1:1",
            "has no `tolerance`",
            2,
        ),
        (&["--every=-1"], "--every:1:1", "interval between rows must be positive", 2),
        (&["--end", "1e300"], "top.toml:15:9", "rows exceed the limit", 2),
    ];
    for (options, place, what, status) in cases {
        let message = refused(simulate(folder.path()).args(options), status);
        assert!(message.contains(place) && message.contains(what), "{options:?}: {message}");
    }
}

/// A checkpoint is valid for the same options only. The file of an incomplete run is removed when
/// the run is complete.
#[test]
fn a_checkpoint_is_of_its_options() {
    let folder =
        folder(&TOP.replace("end = 400", "end = 4").replace("samples = 40", "samples = 600"));
    let folder = folder.path();
    let options = ["--ensemble", "--end", "3", "--checkpoint", "c", "-o", "rows.csv"];
    let mut run = simulate(folder);
    run.args(options).args(["--checkpoint-every", "0"]);
    interrupted(&mut run, "INT", || saved_rows(folder) > 3);
    assert!(folder.join("rows.partial.csv").exists());
    let other = ["--ensemble", "--end", "3.5", "--checkpoint", "c", "--resume"];
    let message = refused(simulate(folder).args(other), 2);
    assert!(message.contains("a different --end"), "{message}");
    let message =
        refused(simulate(folder).args(options).args(["--method", "rkmk54", "--resume"]), 2);
    assert!(message.contains("a different --method"), "{message}");
    done(simulate(folder).args(options).arg("--resume"));
    let mut left: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["rows.csv", "top.toml"]);
}
