//! The output for the paper's geometries in every format: the files in `snapshots/`.

use crate::program::{root, stdout};
use std::collections::BTreeSet;

/// The arguments of a command, and the name of its snapshots without the format.
const OBJECTS: [(&str, &[&str]); 10] = [
    ("m3_table", &["table", "M3"]),
    ("so3_table", &["table", "SO3"]),
    ("m3_so3_comparison", &["compare"]),
    ("poincare_info", &["info", "iso(3,1)"]),
    ("bianchi_info", &["info", "bianchi(VII,h=2)"]),
    ("e8_info", &["info", "E8"]),
    ("scrambled_sum_info", &["info", "tests/data/structure/scrambled_sum.json"]),
    ("berger_properties", &["properties", "so3", "--metric", "diag(1,1,1/4)"]),
    ("heisenberg_properties", &["properties", "heisenberg(3)", "--metric", "identity"]),
    ("hyperbolic_properties", &["properties", "bianchi(V)", "--metric", "identity"]),
];
const FORMATS: [&str; 6] = ["text", "markdown", "latex", "csv", "json", "html"];

/// The formats of an object. E8 has no JSON, which would be half a megabyte, and `info` asserts its
/// values. One page of each kind is enough, and for properties text and JSON.
fn formats(object: &str) -> impl Iterator<Item = &'static str> {
    let pages = ["so3_table", "m3_so3_comparison", "bianchi_info"].contains(&object);
    let kept = move |format: &&str| match *format {
        "html" => pages,
        format if object.ends_with("_properties") => ["text", "json"].contains(&format),
        format => (object, format) != ("e8_info", "json"),
    };
    FORMATS.into_iter().filter(kept)
}

fn print(arguments: &[&str], format: &str) -> String {
    stdout(root(), &[arguments, &["--format", format]].concat())
}

#[test]
fn tables_and_comparison() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (object, arguments) in OBJECTS {
            for format in formats(object) {
                insta::assert_snapshot!(format!("{object}_{format}"), print(arguments, format));
            }
        }
    });
}

#[test]
fn nothing_else_stands_in_the_folder() {
    let entries = std::fs::read_dir(root().join("snapshots")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    // a snapshot that waits for review is ignored
    let found: BTreeSet<String> = names.filter(|name| !name.ends_with(".snap.new")).collect();
    let expected = OBJECTS.iter().flat_map(|(object, _)| {
        formats(object).map(move |format| format!("{object}_{format}.snap"))
    });
    // the snapshots of `code` are tested elsewhere
    let programs = ["c", "python", "rust"].map(|name| format!("program_{name}.snap"));
    assert_eq!(found, expected.chain(programs).collect());
}
