//! A row of the tables of malformed inputs.

use crate::program::{Outcome, run};
use std::path::Path;
use tempfile::TempDir;

/// The mathematics refuses.
pub const MATHEMATICS: i32 = 1;
/// Wrong usage, or input that cannot be read.
pub const USAGE: i32 = 2;

/// A command that has to be refused.
pub struct Case<'c> {
    /// What is wrong.
    pub name: &'c str,
    /// The arguments.
    pub arguments: &'c [&'c str],
    /// The file `a.toml` or `a.json`, and its content.
    pub file: Option<(&'c str, &'c [u8])>,
    /// Standard input.
    pub input: &'c [u8],
    /// The exit status.
    pub status: i32,
    /// What standard error says: the place and the witness.
    pub says: &'c [&'c str],
}

impl Case<'_> {
    /// Runs the case; returns what failed about it.
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

/// Rows `(what is wrong, what is said)`.
pub type Rows<'c> = [(&'c str, &'c [&'c str])];

/// Inputs that are alike but for the text of a row.
pub struct Inputs<'c> {
    arguments: Vec<&'c str>,
    /// The words of the text are further arguments.
    words: bool,
    /// The name of a file, and its content for a text.
    file: Option<(&'c str, Content<'c>)>,
}

type Content<'c> = Box<dyn Fn(&str) -> String + 'c>;

/// Definitions in `file`, given to `affinor table`: `content` makes them of the texts.
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

/// Commands that begin with `arguments` and go on with the words of the texts.
pub fn commands<'c>(arguments: &[&'c str]) -> Inputs<'c> {
    Inputs { arguments: arguments.to_vec(), words: true, file: None }
}

impl<'c> Inputs<'c> {
    /// With these arguments too.
    pub fn with(mut self, arguments: &[&'c str]) -> Self {
        self.arguments.extend(arguments);
        self
    }

    /// Beside a file.
    pub fn beside(self, file: &'c str, content: &'c str) -> Self {
        Self { file: Some((file, Box::new(move |_| content.to_string()))), ..self }
    }

    /// Each is wrong usage, or cannot be read.
    pub fn usage(&self, rows: &Rows) {
        self.refused(USAGE, rows);
    }

    /// Each is refused by the mathematics.
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

/// Runs cases, and fails with all that is wrong.
pub fn refuse<'c>(cases: impl IntoIterator<Item = Case<'c>>) {
    assert_none(cases.into_iter().flat_map(|case| case.failures()).collect());
}

fn assert_none(failures: Vec<String>) {
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// What no refusal may do.
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
