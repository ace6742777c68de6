//! The house is in order: sizes, arrows and habits that ARCHITECTURE.md and CONTRIBUTING.md promise.

use std::fs;
use std::path::Path;

/// The most lines of a source file.
const LINES: usize = 600;
/// Larger ones, each with its own limit.
const LARGER: [(&str, usize); 0] = [];

struct File {
    /// From the root, with `/`.
    path: String,
    text: String,
}

impl File {
    /// The lines of code, numbered from 1: neither comments, nor docs, nor unit tests.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines = self.text.lines().enumerate().map(|(at, line)| (at + 1, line));
        let lines = lines.take_while(|(_, line)| line.trim() != "#[cfg(test)]");
        lines.filter(|(_, line)| !line.trim_start().starts_with("//"))
    }

    /// Refuses words in the code.
    fn forbid(&self, words: &[&str]) {
        for (number, line) in self.code() {
            for word in words {
                assert!(!contains_word(line, word), "{}:{number}: {word}", self.path);
            }
        }
    }

    fn is_library(&self) -> bool {
        !self.is_program()
    }

    fn is_program(&self) -> bool {
        ["src/main.rs", "src/cli.rs"].contains(&&*self.path) || self.path.starts_with("src/cli/")
    }
}

/// Whether `word` stands in `line` with no letter of a name on either side.
fn contains_word(line: &str, word: &str) -> bool {
    let of_name = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        let (before, after) = (&line[..at], &line[at + word.len()..]);
        let goes_on_before = word.starts_with(of_name) && before.ends_with(of_name);
        let goes_on_behind = word.ends_with(of_name) && after.starts_with(of_name);
        !goes_on_before && !goes_on_behind
    })
}

/// All Rust files below the folders.
fn sources(folders: &[&str]) -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut open: Vec<_> = folders.iter().map(|folder| root.join(folder)).collect();
    let mut files = vec![];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the project") {
            let path = entry.expect("an entry of the folder").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source is text");
                let path = path.strip_prefix(root).expect("a path below the root");
                let names: Vec<_> = path.iter().map(|name| name.to_string_lossy()).collect();
                files.push(File { path: names.join("/"), text });
            }
        }
    }
    assert!(!files.is_empty(), "{folders:?}");
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

fn library() -> Vec<File> {
    sources(&["src", "tensors/src"])
}

#[test]
fn no_source_is_long() {
    for file in library() {
        let larger = LARGER.iter().find(|(path, _)| *path == file.path);
        let limit = larger.map_or(LINES, |(_, limit)| *limit);
        let lines = file.text.lines().count();
        assert!(lines <= limit, "{} has {lines} lines, more than {limit}", file.path);
    }
}

#[test]
fn tensors_know_no_geometry() {
    let words =
        ["LieAlgebra", "Bracket", "Connection", "Frame", "Metric", "Geometry", "Jacobi", "affinor"];
    for file in sources(&["tensors/src"]) {
        file.forbid(&words);
    }
}

/// Who must not know whom: sources by the beginnings of their paths, then modules and types.
const ARROWS: [(&[&str], &[&str]); 8] = [
    (
        &[
            "src/frame.rs",
            "src/algebra",
            "src/connection",
            "src/metric.rs",
            "src/curvature",
            "src/forms.rs",
            "src/holonomy.rs",
            "src/invariants.rs",
            "src/lie_derivative.rs",
            "src/lie_poisson",
            "src/properties",
            "src/reductive.rs",
            "src/transport",
            "src/any_group.rs",
            "src/ode.rs",
            "src/chart",
            "src/group",
            "src/figures",
            "src/plot",
            "src/dynamics",
        ],
        &[
            "catalogue",
            "geometry",
            "definition",
            "paper",
            "report",
            "claims",
            "certificate",
            "cli",
            "Geometry",
            "Definition",
        ],
    ),
    (&["src/curvature", "src/holonomy.rs"], &["properties"]),
    (&["src/group"], &["transport", "any_group", "dynamics"]),
    (
        &["src/roots"],
        &[
            "algebra",
            "frame",
            "connection",
            "catalogue",
            "definition",
            "report",
            "cli",
            "Frame",
            "LieAlgebra",
        ],
    ),
    (
        &["src/catalogue"],
        &[
            "connection",
            "geometry",
            "definition",
            "paper",
            "report",
            "claims",
            "certificate",
            "cli",
            "Connection",
            "Geometry",
        ],
    ),
    (&["src/geometry.rs"], &["catalogue", "definition", "report", "claims", "certificate", "cli"]),
    (&["src/figures"], &["plot"]),
    (&["src/definition", "src/report"], &["cli"]),
];

#[test]
fn arrows_point_downward() {
    for (paths, unknown) in ARROWS {
        let files: Vec<File> = sources(&["src"])
            .into_iter()
            .filter(|file| paths.iter().any(|path| file.path.starts_with(path)))
            .collect();
        assert!(files.len() >= paths.len(), "{paths:?}");
        for file in files {
            for name in unknown {
                let is_type = name.starts_with(char::is_uppercase);
                let path = if is_type { name.to_string() } else { format!("crate::{name}") };
                file.forbid(&[&path]);
            }
        }
    }
}

#[test]
fn definitions_and_reports_do_not_know_each_other() {
    for file in sources(&["src/definition", "src/report"]) {
        let other = if file.path.contains("report") { "definition" } else { "report" };
        file.forbid(&[&format!("crate::{other}")]);
    }
}

#[test]
fn the_library_neither_panics_nor_prints() {
    for file in library().iter().filter(|file| file.is_library()) {
        file.forbid(&[
            "unwrap()",
            "panic!",
            "todo!",
            "unimplemented!",
            "dbg!",
            "println!",
            "eprintln!",
            "print!",
            "eprint!",
        ]);
        if !file.path.starts_with("src/definition/") {
            file.forbid(&["std::fs", "stdin", "stdout", "std::env"]);
        }
    }
}

#[test]
fn only_the_program_uses_what_a_terminal_needs() {
    for file in library().iter().filter(|file| file.is_library()) {
        file.forbid(&["clap", "clap_complete", "indicatif", "annotate_snippets", "tempfile"]);
        file.forbid(&["signal_hook"]);
    }
}

/// Properties are drawn from the fixed seed, and leave no file behind.
#[test]
fn every_property_has_the_shared_configuration() {
    let mut blocks = 0;
    for file in sources(&["src", "tests", "tensors/src", "tensors/tests", "benches", "examples"]) {
        // in pieces, so that this test does not find itself
        let (block, given) = (concat!("proptest", "!"), concat!("#![proptest", "_config("));
        for (at, _) in file.text.match_indices(block) {
            let number = file.text[..at].lines().count();
            let inside = file.text[at + block.len()..].trim_start().strip_prefix('{');
            let inside = inside.unwrap_or_default().trim_start().strip_prefix(given);
            let config = inside.and_then(|rest| rest.split_once("(")).map(|(path, _)| path);
            let shared = config.is_some_and(|path| path.ends_with("property::cases"));
            assert!(shared, "{}:{number}: begin with {given}property::cases(256))]", file.path);
            blocks += 1;
        }
        if !file.path.ends_with("tests/common/property.rs") {
            file.forbid(&[concat!("Proptest", "Config"), concat!("Test", "Runner")]);
        }
    }
    assert!(blocks > 50, "{blocks}");
}

#[test]
fn every_source_says_what_it_is() {
    for file in library() {
        assert!(file.text.starts_with("//! "), "{} has no module doc", file.path);
    }
}

/// The paths named in the map: code that ends in `.rs`, with `{a,b}` spelled out.
fn named(map: &str) -> Vec<String> {
    let mut paths = vec![];
    for word in
        map.split(|c: char| c.is_whitespace() || c == '`').filter(|word| word.ends_with(".rs"))
    {
        match word.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
        {
            Some((before, (names, after))) => {
                paths.extend(names.split(',').map(|name| format!("{before}{name}{after}")));
            }
            None => paths.push(word.to_string()),
        }
    }
    paths
}

#[test]
fn the_map_is_true() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let map = fs::read_to_string(root.join("ARCHITECTURE.md")).expect("the map");
    assert!(map.lines().count() <= 215, "ARCHITECTURE.md has {} lines", map.lines().count());
    let named = named(&map);
    for file in library() {
        assert!(named.contains(&file.path), "{} is not in ARCHITECTURE.md", file.path);
    }
    for path in named.iter().filter(|path| path.contains('/')) {
        assert!(root.join(path).exists(), "ARCHITECTURE.md names {path}, which does not exist");
    }
}

#[test]
fn every_dependency_is_justified() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let map = fs::read_to_string(root.join("ARCHITECTURE.md")).expect("the map");
    for manifest in ["Cargo.toml", "tensors/Cargo.toml"] {
        let text = fs::read_to_string(root.join(manifest)).expect("a manifest");
        let table: toml::Table = text.parse().expect("a manifest is TOML");
        for section in ["dependencies", "dev-dependencies"] {
            let Some(toml::Value::Table(names)) = table.get(section) else {
                continue;
            };
            for name in names.keys().filter(|name| *name != "affinor-tensors") {
                assert!(map.contains(&format!("**{name}**")), "{manifest}: {name}");
            }
        }
    }
}
