//! Stored tables that cannot be read, or belong to another space.

use crate::bad_input::case::stored;
use crate::program::run;
use tempfile::TempDir;

#[test]
fn json() {
    let table =
        |tensors: &str| format!("{{\"schema\": \"affinor.table/1\", \"tensors\": {{{tensors}}}}}");
    let components =
        |components: &str| table(&format!("\"ricci\": {{\"components\": [{components}]}}"));
    let deep = "[".repeat(100_000);
    stored("a.json", str::to_string).usage(&[
        ("{", &["a.json", "line 1 column 1"]),
        ("{}", &["a.json", "the schema is missing"]),
        ("{\"schema\": \"affinor.table/2\"}", &["a.json", "`affinor.table/2`, not"]),
        ("{\"schema\": \"\\u001b[31m\"}", &["a.json", "`\\u{1b}[31m`"]),
        ("{\"schema\": \"affinor.table/1\"}", &["a.json", "no object `tensors`"]),
    ]);
    stored("a.json", table).usage(&[
        ("\"bach\": {}", &["a.json", "`bach` is not a tensor"]),
        ("\"ricci\": {}", &["a.json", "ricci has no components"]),
    ]);
    stored("a.json", components).usage(&[
        ("7", &["a.json", "ricci: 7 is not a component"]),
        ("[[0, 1], \"1\"]", &["a.json", "is not a component"]),
        ("[[\"1\", 1], \"1\"]", &["a.json", "is not a component"]),
        ("[[1.5, 1], \"1\"]", &["a.json", "is not a component"]),
        ("[[1, 1], []]", &["a.json", "is not a component"]),
        ("[[1], \"1\"]", &["a.json", "ricci"]),
        ("[[1, 1, 1], \"1\"]", &["a.json", "ricci"]),
        ("[[1, 1], \"1/0\"]", &["a.json", "`1/0`: division by zero"]),
        ("[[1, 1], \"a\"]", &["a.json", "`a`"]),
        ("[[1, 1], \"NaN\"]", &["a.json", "`NaN`"]),
        (&deep, &["a.json", "recursion limit"]),
    ]);
    let other = components("[[1, 1], \"1\"]")
        .replace("\"tensors\"", "\"algebra\": {\"dimension\": 6}, \"tensors\"");
    let says = &["the stored dimension is 6, but the computed one is 3"];
    stored("a.json", str::to_string).mathematics(&[(&other, says)]);
}

#[test]
fn csv() {
    let below = |rows: &str| format!("tensor,i,j,k,l,value\n{rows}");
    stored("a.csv", str::to_string).usage(&[
        ("", &["a.csv", "the header is not tensor,i,j,k,l,...,value"]),
        ("dimension = 2", &["a.csv", "the header is not"]),
        ("tensor,i,value\nricci,1,1", &["a.csv", "the header is not"]),
    ]);
    stored("a.csv", below).usage(&[
        ("ricci,1,1,,,\"1\nricci,2,2,,,1\n", &["a.csv", "a quote `\"` is not closed"]),
        ("ricci,1,1\n", &["a.csv", "3"]),
        ("bach,1,1,,,1\n", &["a.csv", "row 2: `bach` is not a tensor"]),
        ("ricci,1,1,,,1\nricci,x,1,,,1\n", &["a.csv", "row 3: an index is not a positive integer"]),
        ("ricci,0,1,,,1\n", &["a.csv", "row 2: an index is not a positive integer"]),
        ("ricci,1,1,,,\n", &["a.csv", "ricci: ``"]),
        ("ricci,1,1,,,1/0\n", &["a.csv", "`1/0`: division by zero"]),
        ("metric,1,1,,,1\n", &["a.csv", "metric is stored"]),
        ("\u{1b}[31m,1,1,,,1\n", &["a.csv", "`\\u{1b}[31m` is not a tensor"]),
    ]);
}

#[test]
fn not_text() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("a.json"), b"{\"schema\": \"\xff\"}").unwrap();
    let outcome = run(folder.path(), &["verify", "so3", "a.json"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("a.json is not text"), "{}", outcome.err);
    assert!(outcome.err.contains("UTF-8"), "{}", outcome.err);
}
