//! The cases of malformed input, and their checks.

use crate::program::{Outcome, run};
use std::path::Path;
use tempfile::TempDir;

/// Exit status for valid input without a mathematical answer.
pub const MATHEMATICS: i32 = 1;
/// Wrong usage, or input that cannot be read.
pub const USAGE: i32 = 2;

/// A command that must fail.
pub struct Case<'c> {
    /// A description of the fault.
    pub name: &'c str,
    /// The arguments.
    pub arguments: &'c [&'c str],
    /// The file `a.toml` or `a.json`, and its content.
    pub file: Option<(&'c str, &'c [u8])>,
    /// Standard input.
    pub input: &'c [u8],
    /// The exit status.
    pub status: i32,
    /// Texts that standard error must contain: the location and the witness.
    pub says: &'c [&'c str],
}

impl Case<'_> {
    /// Runs the case. Returns the checks that failed.
    pub fn failures(&self) -> Vec<String> {
        let folder = TempDir::new().unwrap();
        if let Some((name, content)) = self.file {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        let outcome = run(folder.path(), self.arguments, self.input);
        let mut failures = defects(&outcome, self.status);
        for part in self.says {
            if !outcome.err.contains(part) {
                failures.push(format!("does not say {part:?}"));
            }
        }
        if !failures.is_empty() {
            failures.push(outcome.err);
        }
        failures.into_iter().map(|what| format!("{}: {what}", self.name)).collect()
    }
}

/// Rows `(fault, expected texts)`.
pub type Rows<'c> = [(&'c str, &'c [&'c str])];

/// Inputs that differ only in the text of a row.
pub struct Inputs<'c> {
    arguments: Vec<&'c str>,
    /// The words of the text are appended to the arguments.
    words: bool,
    /// The name of the file, and its content for a text.
    file: Option<(&'c str, Content<'c>)>,
}

type Content<'c> = Box<dyn Fn(&str) -> String + 'c>;

/// Definitions in `file`, given to `affinor table`; `content` builds them from the texts.
pub fn definitions<'c>(file: &'c str, content: impl Fn(&str) -> String + 'c) -> Inputs<'c> {
    Inputs { arguments: vec!["table", file], words: false, file: Some((file, Box::new(content))) }
}

/// Problems in `file`, given to `affinor simulate`.
pub fn problems<'c>(file: &'c str, content: impl Fn(&str) -> String + 'c) -> Inputs<'c> {
    Inputs { arguments: vec!["simulate", file], ..definitions(file, content) }
}

/// Tables in `file`, given to `affinor verify so3`.
pub fn stored<'c>(file: &'c str, content: impl Fn(&str) -> String + 'c) -> Inputs<'c> {
    Inputs { arguments: vec!["verify", "so3", file], ..definitions(file, content) }
}

/// Commands of `arguments` and the words of the texts.
pub fn commands<'c>(arguments: &[&'c str]) -> Inputs<'c> {
    Inputs { arguments: arguments.to_vec(), words: true, file: None }
}

impl<'c> Inputs<'c> {
    /// Adds these arguments.
    pub fn with(mut self, arguments: &[&'c str]) -> Self {
        self.arguments.extend(arguments);
        self
    }

    /// Adds a second file.
    pub fn beside(self, file: &'c str, content: &'c str) -> Self {
        Self { file: Some((file, Box::new(move |_| content.to_string()))), ..self }
    }

    /// Expects every command to fail with wrong usage or unreadable input.
    pub fn usage(&self, rows: &Rows) {
        self.refused(USAGE, rows);
    }

    /// Expects every command to fail with a mathematical error.
    pub fn mathematics(&self, rows: &Rows) {
        self.refused(MATHEMATICS, rows);
    }

    fn refused(&self, status: i32, rows: &Rows) {
        let failures = rows.iter().flat_map(|&(text, says)| {
            let words = self.words.then(|| text.split(' ')).into_iter().flatten();
            let arguments: Vec<&str> = self.arguments.iter().copied().chain(words).collect();
            let content = self.file.as_ref().map(|(name, content)| (*name, content(text)));
            let file = content.as_ref().map(|(name, content)| (*name, content.as_bytes()));
            let name = &text.chars().take(200).collect::<String>();
            Case { name, arguments: &arguments, file, input: b"", status, says }.failures()
        });
        assert_none(failures.collect());
    }
}

/// Runs cases, and fails with a list of all defects.
pub fn refuse<'c>(cases: impl IntoIterator<Item = Case<'c>>) {
    assert_none(cases.into_iter().flat_map(|case| case.failures()).collect());
}

fn assert_none(failures: Vec<String>) {
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The defects that no error may have.
fn defects(outcome: &Outcome, status: i32) -> Vec<String> {
    let Outcome { status: found, out, err } = outcome;
    let mut failures = Vec::new();
    let mut check = |ok: bool, what: &str| {
        if !ok {
            failures.push(what.to_string());
        }
    };
    check(*found == status, &format!("status {found}, not {status}"));
    check(out.is_empty(), "writes on standard output");
    check(!err.contains("panicked"), "panics");
    check(err.lines().any(|line| line.starts_with("error: ")), "says no error");
    check(!err.contains(|c: char| c.is_control() && c != '\n'), "control characters");
    check(err.chars().count() < 2500, "floods the terminal");
    let snippet = |line: &&str| line.contains(" | ");
    let wide = err.lines().filter(snippet).any(|line| line.chars().count() > 80);
    check(!wide, "a snippet wider than 80 columns");
    failures
}

/// The files of a folder, sorted.
pub fn listing(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
