//! Results that cannot be written: the old file is preserved. A closed pipe is not a failure.

use crate::bad_input::case::listing;
use crate::program::{program, run, wait};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;
use tempfile::TempDir;

const PLANE: &str = "basis = ['x', 'y']\nbrackets = '[x, y] = x'\n";
/// Brackets that violate the Jacobi identity.
const BROKEN: &str = "dimension = 3\nbrackets = '[e1, e2] = e3; [e2, e3] = e2'\n";

/// A folder with `a.toml` (valid), `b.toml` (invalid), and `old`.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.toml"), PLANE).unwrap();
    fs::write(folder.path().join("b.toml"), BROKEN).unwrap();
    fs::write(folder.path().join("old"), "as it was").unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    folder
}

#[test]
fn a_target_that_cannot_be_written_is_named() {
    let folder = folder();
    for (target, says) in [
        ("no/file", "cannot write no/file: No such file or directory"),
        ("sub", "cannot write sub: is a directory"),
        (".", "is a directory"),
        ("old/file", "cannot write old/file: not a directory"),
    ] {
        let outcome = run(folder.path(), &["table", "a.toml", "-o", target], b"");
        assert_eq!(outcome.status, 2, "{target}: {}", outcome.err);
        assert!(outcome.err.contains(says), "{target}: {}", outcome.err);
        assert!(!outcome.err.contains(".affinor-"), "{target}: {}", outcome.err);
        assert_eq!(outcome.out, "");
    }
    assert_eq!(listing(folder.path()), ["a.toml", "b.toml", "old", "sub"]);
}

#[test]
fn the_input_is_not_overwritten() {
    let folder = folder();
    let stored = run(folder.path(), &["table", "a.toml", "--format", "json", "-o", "t.json"], b"");
    assert_eq!(stored.status, 0, "{}", stored.err);
    let before = fs::read(folder.path().join("t.json")).unwrap();
    for arguments in [
        vec!["table", "a.toml", "-o", "a.toml"],
        vec!["table", "a.toml", "-o", "./sub/../a.toml"],
        vec!["table", "a.toml@plus", "-o", "a.toml"],
        vec!["table", "a.toml@plus;metric=identity", "-o", "a.toml"],
        vec!["check", "a.toml", "-o", "a.toml"],
        vec!["compare", "so3", "a.toml@plus", "-o", "a.toml"],
        vec!["compare", "a.toml", "so3", "-o", "a.toml"],
        vec!["verify", "a.toml", "t.json", "-o", "a.toml"],
        vec!["verify", "a.toml", "t.json", "-o", "t.json"],
    ] {
        let outcome = run(folder.path(), &arguments, b"");
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.err);
        assert!(outcome.err.contains("is the input"), "{arguments:?}: {}", outcome.err);
        assert!(outcome.err.contains("give -o another name"), "{arguments:?}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("a.toml")).unwrap(), PLANE);
    assert_eq!(fs::read(folder.path().join("t.json")).unwrap(), before);
}

#[test]
fn a_failed_run_leaves_the_old_file() {
    let folder = folder();
    for arguments in [
        ["table", "b.toml", "-o", "old"],
        ["table", "no.toml", "-o", "old"],
        ["table", "so31", "-o", "old"],
        ["verify", "a.toml", "-o", "old"],
    ] {
        let outcome = run(folder.path(), &arguments, b"");
        assert!(outcome.status == 1 || outcome.status == 2, "{arguments:?}");
        assert_eq!(fs::read_to_string(folder.path().join("old")).unwrap(), "as it was");
    }
    assert_eq!(listing(folder.path()), ["a.toml", "b.toml", "old", "sub"]);
    let outcome = run(folder.path(), &["table", "a.toml", "-o", "old"], b"");
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(fs::read_to_string(folder.path().join("old")).unwrap().contains("[x, y] = x"));
    assert_eq!(listing(folder.path()), ["a.toml", "b.toml", "old", "sub"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_modes_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    symlink("a.toml", folder.path().join("link")).unwrap();
    let outcome = run(folder.path(), &["table", "a.toml", "-o", "link"], b"");
    assert_eq!(outcome.status, 2, "{}", outcome.err);
    assert_eq!(fs::read_to_string(folder.path().join("a.toml")).unwrap(), PLANE);

    let old = folder.path().join("old");
    symlink("old", folder.path().join("link to old")).unwrap();
    fs::set_permissions(&old, fs::Permissions::from_mode(0o640)).unwrap();
    let outcome = run(folder.path(), &["table", "a.toml", "-o", "link to old"], b"");
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert_ne!(fs::read_to_string(&old).unwrap(), "as it was");
    assert_eq!(fs::metadata(&old).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(fs::symlink_metadata(folder.path().join("link to old")).unwrap().is_symlink());
}

#[cfg(unix)]
#[test]
fn folders_without_permission() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let sub = folder.path().join("sub");
    fs::set_permissions(&sub, fs::Permissions::from_mode(0o500)).unwrap();
    // the user root can write everywhere
    if fs::write(sub.join("probe"), "").is_err() {
        let outcome = run(folder.path(), &["table", "a.toml", "-o", "sub/file"], b"");
        assert_eq!(outcome.status, 2);
        assert!(outcome.err.contains("cannot write sub/file"), "{}", outcome.err);
    }
    fs::set_permissions(&sub, fs::Permissions::from_mode(0o700)).unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn devices() {
    use std::os::unix::fs::FileTypeExt;
    let folder = folder();
    let full = run(folder.path(), &["table", "a.toml", "-o", "/dev/full"], b"");
    assert_eq!(full.status, 2);
    assert!(full.err.contains("cannot write /dev/full: No space left"), "{}", full.err);

    let null = run(folder.path(), &["table", "a.toml", "-o", "/dev/null"], b"");
    assert_eq!(null.status, 0, "{}", null.err);
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());

    let whole = run(folder.path(), &["table", "a.toml"], b"");
    let device = run(folder.path(), &["table", "a.toml", "-o", "/dev/stdout"], b"");
    assert_eq!((device.status, device.out), (0, whole.out), "{}", device.err);

    let mut program = program(folder.path());
    program.args(["table", "a.toml"]).stderr(Stdio::piped());
    program.stdout(fs::File::options().write(true).open("/dev/full").unwrap());
    let output = program.output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("cannot write standard output: No space left"), "{message}");
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let folder = folder();
    let long = "space = 'so3'\nmetric = 'diag(1, 2, 3)'\ninitial.velocity = [1, 2, 3]\n\
                output = { end = 1000, every = 0.05 }\nintegrator.method = 'exact'\n";
    fs::write(folder.path().join("long.toml"), long).unwrap();
    for arguments in [
        &["table", "sl6@plus", "--format", "csv"][..],
        &["table", "sl6@plus", "--format", "json"],
        &["table", "sl6@plus"],
        &["completions", "zsh"],
        &["simulate", "long.toml"],
        &["simulate", "long.toml", "--format", "json"],
    ] {
        let mut program = program(folder.path());
        program.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = program.spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        out.read_line(&mut line).unwrap();
        assert!(!line.is_empty());
        drop(out);
        let mut message = String::new();
        std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut message).unwrap();
        let quiet = message.lines().all(|line| line.starts_with("note: "));
        assert!(wait(&mut child) == 0 && quiet, "{arguments:?}: {message}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn standard_error_may_be_full_or_closed() {
    let folder = folder();
    for (arguments, status) in [
        (&["table", "a.toml", "--timings"][..], 0),
        (&["table", "a.toml", "--metric", "diag(1,m)"], 0),
        (&["table", "b.toml"], 1),
        (&["table", "no.toml"], 2),
        (&["tabel"], 2),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut program = program(folder.path());
        program.args(arguments).stderr(full).stdout(Stdio::null());
        assert_eq!(wait(&mut program.spawn().unwrap()), status, "{arguments:?}");
    }
}

#[test]
fn standard_input_may_be_the_target() {
    let folder = folder();
    let mut program = program(folder.path());
    program.args(["table", "-", "-o", "a.toml"]).stderr(Stdio::null());
    program.stdin(fs::File::open(folder.path().join("a.toml")).unwrap());
    let status = wait(&mut program.spawn().unwrap());
    if cfg!(target_os = "linux") {
        assert_eq!(status, 2);
        assert_eq!(fs::read_to_string(folder.path().join("a.toml")).unwrap(), PLANE);
    }
}
