//! The rules of ARCHITECTURE.md and CONTRIBUTING.md on file sizes, dependencies and style.

use crate::common::root;
use std::collections::BTreeSet;
use std::fs;

/// The maximum number of lines of a source file.
const LINES: usize = 600;

struct File {
    /// The path from the root of the workspace, with `/`.
    path: String,
    text: String,
}

impl File {
    /// The lines of code, numbered from 1, without comments, docs and unit tests.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines = self.text.lines().enumerate().map(|(at, line)| (at + 1, line));
        let unit_tests = self.path.ends_with("/tests.rs");
        let lines = lines.take_while(move |(_, line)| !unit_tests && line.trim() != "#[cfg(test)]");
        lines.filter(|(_, line)| !line.trim_start().starts_with("//"))
    }

    /// Fails if words occur in the code.
    fn forbid(&self, words: &[&str]) {
        for (number, line) in self.code() {
            for word in words {
                assert!(!contains_word(line, word), "{}:{number}: {word}", self.path);
            }
        }
    }
}

/// Whether `word` occurs in `line` as a whole name.
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
    let root = root();
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

/// The packages, from the bottom up.
const PACKAGES: [&str; 6] =
    ["tensors/src", "src", "documents/src", "paper/src", "cli/src", "python/src"];
/// The modules of the library, from the bottom up: each may use the modules before it.
const ROOMS: [&str; 6] =
    ["numerics", "algebra", "representation", "geometry", "group", "mechanics"];

#[test]
fn no_source_is_long() {
    for file in sources(&PACKAGES) {
        let lines = file.text.lines().count();
        assert!(lines <= LINES, "{} has {lines} lines, more than {LINES}", file.path);
    }
}

#[test]
fn the_library_has_few_rooms() {
    let root = root();
    let entries = fs::read_dir(root.join("src")).expect("the sources").count();
    assert!(entries <= 16, "src has {entries} entries");
}

#[test]
fn rooms_know_only_those_below() {
    for (at, room) in ROOMS.iter().enumerate() {
        let files = sources(&["src"]).into_iter().filter(|file| {
            file.path == format!("src/{room}.rs") || file.path.starts_with(&format!("src/{room}/"))
        });
        let files: Vec<File> = files.collect();
        assert!(files.len() > 5, "{room}");
        for file in files {
            for above in &ROOMS[at + 1..] {
                file.forbid(&[&format!("crate::{above}")]);
            }
        }
    }
}

/// The names of the functions of the block that begins with a line.
fn functions(file: &File, begins: impl Fn(&str) -> bool) -> Vec<&str> {
    let mut block = file.text.lines().skip_while(|line| !begins(line) || line.ends_with("{}"));
    let first = block.next().unwrap_or_default();
    let end = format!("{}}}", &first[..first.len() - first.trim_start().len()]);
    let names = block.take_while(|line| *line != end).filter_map(|line| {
        let after = line.trim_start().strip_prefix("fn ")?;
        after.split(['(', '<']).next()
    });
    names.collect()
}

/// Groups that contain groups forward every closed form of a trait: no method uses its default
/// silently.
#[test]
fn groups_of_groups_forward_all_closed_forms() {
    /// Methods whose defaults call forwarded methods, or that are meaningless for a product.
    const DEFAULTS: [(&str, &str); 4] = [
        ("src/group/groups/opposite.rs", "adjoint_exp"),
        ("src/group/groups/opposite.rs", "relative_linear_part"),
        ("src/group/groups/product.rs", "entries"),
        ("src/group/groups/product.rs", "names"),
    ];
    let files = sources(&["src/group"]);
    let groups = || files.iter().filter(|file| file.path.starts_with("src/group/groups/"));
    let mut count = 0;
    for name in ["LieGroup", "TranslationSplit", "Embedded", "MatrixNotation"] {
        let begins = |line: &str| line.contains("impl") && line.contains(&format!(" {name} for "));
        let closed: BTreeSet<&str> = groups().flat_map(|file| functions(file, begins)).collect();
        count += closed.len();
        for path in
            ["src/group/any.rs", "src/group/groups/product.rs", "src/group/groups/opposite.rs"]
        {
            let file = files.iter().find(|file| file.path == path).expect("a group of groups");
            let forwarded = functions(file, begins);
            for method in &closed {
                let known = forwarded.contains(method) || DEFAULTS.contains(&(path, method));
                assert!(known, "{path} does not forward {name}::{method}");
            }
        }
    }
    assert!(count > 35, "only {count} methods were found");
}

#[test]
fn libraries_neither_panic_nor_print() {
    for file in sources(&["tensors/src", "src", "documents/src", "paper/src"]) {
        file.forbid(&["unwrap()", "panic!", "todo!", "unimplemented!", "dbg!"]);
        file.forbid(&["println!", "eprintln!", "print!", "eprint!"]);
        if !file.path.starts_with("documents/") {
            file.forbid(&["std::fs", "stdin", "stdout", "std::env"]);
        }
    }
}

/// Properties are drawn from the fixed seed, and leave no file behind.
#[test]
fn every_property_has_the_shared_configuration() {
    for file in
        sources(&["src", "tests", "tensors", "documents", "paper", "cli", "benches", "examples"])
    {
        if !file.path.ends_with("tests/common/property.rs") {
            // written in pieces, so that this test does not find itself
            let macros = [concat!("proptest", "!"), concat!("Proptest", "Config")];
            file.forbid(&[macros[0], macros[1], concat!("Test", "Runner")]);
        }
    }
}

#[test]
fn every_source_says_what_it_is() {
    for file in sources(&PACKAGES) {
        assert!(file.text.starts_with("//! "), "{} has no module doc", file.path);
    }
}

/// A test file has the name of the source file or folder that it tests, or is in `claims`.
#[test]
fn tests_follow_the_sources() {
    let rooms = ROOMS.map(|room| (format!("tests/{room}"), format!("src/{room}")));
    let packages = ["tensors", "documents"].map(|p| (format!("tests/{p}"), format!("{p}/src")));
    for (tests, guarded) in rooms.into_iter().chain(packages) {
        for file in sources(&[&tests]) {
            let name = file.path[tests.len() + 1..].trim_end_matches(".rs");
            if name != "main" && !name.starts_with("claims/") && !name.starts_with("common/") {
                let source = root().join(&guarded).join(name);
                let exists = source.is_dir() || source.with_extension("rs").exists();
                assert!(exists, "{}: no source {guarded}/{name}.rs", file.path);
            }
        }
    }
}

fn architecture() -> String {
    let root = root();
    fs::read_to_string(root.join("ARCHITECTURE.md")).expect("the page")
}

/// ARCHITECTURE.md is one page, names every module, and names only existing ones.
#[test]
fn the_page_on_architecture_is_true() {
    let (page, root) = (architecture(), root());
    assert!(page.lines().count() <= 120, "ARCHITECTURE.md has {} lines", page.lines().count());
    for room in PACKAGES.iter().map(|p| p.to_string()).chain(ROOMS.map(|r| format!("src/{r}/"))) {
        assert!(page.contains(&room), "{room} is not in ARCHITECTURE.md");
    }
    let words = page.split(|c: char| c.is_whitespace() || "`(),;".contains(c));
    let paths = words.filter(|word| word.contains('/') && !word.contains("://"));
    for path in paths.filter(|path| path.ends_with('/') || path.ends_with(".rs")) {
        assert!(root.join(path).exists(), "ARCHITECTURE.md names {path}, which does not exist");
    }
}

#[test]
fn every_dependency_is_justified() {
    let (page, root) = (architecture(), root());
    for manifest in
        ["", "tensors/", "documents/", "paper/", "cli/", "tests/", "benches/", "python/"]
    {
        let manifest = format!("{manifest}Cargo.toml");
        let text = fs::read_to_string(root.join(&manifest)).expect("a manifest");
        let table: toml::Table = text.parse().expect("a manifest is TOML");
        for section in ["dependencies", "dev-dependencies"] {
            let Some(toml::Value::Table(names)) = table.get(section) else { continue };
            for name in names.keys().filter(|name| !name.starts_with("affinor")) {
                assert!(page.contains(&format!("**{name}**")), "{manifest}: {name}");
            }
        }
    }
}

fn manifest(folder: &str) -> toml::Table {
    let path = root().join(folder).join("Cargo.toml");
    fs::read_to_string(path).expect("a manifest").parse().expect("a manifest is TOML")
}

/// Every published package has what its registry shows.
#[test]
fn packages_are_complete() {
    for folder in ["", "tensors", "documents", "paper", "cli"] {
        let package = manifest(folder)["package"].clone();
        for key in ["description", "keywords", "categories", "license", "repository", "include"] {
            assert!(package.get(key).is_some(), "{folder}/Cargo.toml: no `{key}`");
        }
        for file in ["README.md", "LICENSE-MIT", "LICENSE-APACHE"] {
            let text =
                |folder: &str| fs::read_to_string(root().join(folder).join(file)).expect("a file");
            assert!(
                file == "README.md" || text(folder) == text(""),
                "{folder}/{file} is another licence"
            );
        }
    }
}

/// Files that must write out the address and the version have those of Cargo.toml.
#[test]
fn addresses_and_versions_agree() {
    let package = manifest("")["workspace"]["package"].clone();
    let value = |key: &str| package[key].as_str().expect("a text").to_string();
    let (repository, version) = (value("repository"), value("version"));
    for file in ["CITATION.cff", "codemeta.json", "release/homebrew.rb", "release/conda.yaml"] {
        let text = fs::read_to_string(root().join(file)).expect("a file");
        assert!(text.contains(&repository), "{file}: the address");
        assert!(text.contains(&version), "{file}: the version");
    }
}
