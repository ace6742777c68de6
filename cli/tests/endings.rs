//! The format of an output file, by its ending.

use crate::program::run;
use std::fs;
use tempfile::TempDir;

/// The ending of the output file chooses the format, unless `--format` does.
#[test]
fn endings_choose_the_format() {
    let folder = TempDir::new().unwrap();
    let written = |arguments: &[&str], file: &str| {
        let outcome = run(folder.path(), &[arguments, &["-o", file]].concat(), b"");
        assert_eq!(outcome.status, 0, "{}", outcome.err);
        fs::read_to_string(folder.path().join(file)).unwrap()
    };
    let table = ["table", "so3@zero", "--show", "ricci"];
    for (file, beginning) in [
        ("a.json", "{"),
        ("a.CSV", "tensor,"),
        ("a.md", "# so(3)"),
        ("a.tex", "% A fragment"),
        ("a.html", "<!DOCTYPE html>"),
        ("a.txt", "so(3)"),
        ("a", "so(3)"),
    ] {
        let text = written(&table, file);
        assert!(text.starts_with(beginning), "{file}: {}", &text[..40.min(text.len())]);
    }
    let chosen = written(&[&table[..], &["--format", "csv"]].concat(), "b.json");
    assert!(chosen.starts_with("tensor,"), "{chosen}");
    assert!(written(&["exp", "so3", "0,0,1"], "c.json").starts_with('['));
}
