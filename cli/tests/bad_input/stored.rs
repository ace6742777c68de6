//! Stored tables that cannot be read, or are of something else.

use crate::bad_input::case::{Case, MATHEMATICS, USAGE, refuse};
use crate::program::run;
use tempfile::TempDir;

fn refuse_stored(name: &str, file: &str, content: &str, status: i32, says: &[&str]) {
    refuse([Case {
        name,
        arguments: &["verify", "so3", file],
        file: Some((file, content.as_bytes())),
        input: b"",
        status,
        says,
    }]);
}

#[test]
fn json() {
    let table =
        |tensors: &str| format!("{{\"schema\": \"affinor.table/1\", \"tensors\": {{{tensors}}}}}");
    let components =
        |components: &str| table(&format!("\"ricci\": {{\"components\": [{components}]}}"));
    let deep = "[".repeat(100_000);
    for (name, content, says) in [
        ("syntax", "{".to_string(), "line 1 column 1"),
        ("no schema", "{}".into(), "the schema is missing"),
        (
            "another schema",
            "{\"schema\": \"affinor.table/2\"}".into(),
            "`affinor.table/2`, not affinor.table/1",
        ),
        ("an escape sequence", "{\"schema\": \"\\u001b[31m\"}".into(), "`\\u{1b}[31m`"),
        ("no tensors", "{\"schema\": \"affinor.table/1\"}".into(), "no object `tensors`"),
        ("unknown tensor", table("\"bach\": {}"), "`bach` is no tensor"),
        ("no components", table("\"ricci\": {}"), "ricci has no components"),
        ("no component", components("7"), "ricci: 7 is no component"),
        ("index zero", components("[[0, 1], \"1\"]"), "is no component"),
        ("index of text", components("[[\"1\", 1], \"1\"]"), "is no component"),
        ("a broken index", components("[[1.5, 1], \"1\"]"), "is no component"),
        ("a value that is an array", components("[[1, 1], []]"), "is no component"),
        ("too few indices", components("[[1], \"1\"]"), "ricci"),
        ("too many indices", components("[[1, 1, 1], \"1\"]"), "ricci"),
        ("a bad value", components("[[1, 1], \"1/0\"]"), "`1/0`: division by zero"),
        ("a parameter", components("[[1, 1], \"a\"]"), "`a`"),
        ("not a number", components("[[1, 1], \"NaN\"]"), "`NaN`"),
        ("10^5 nested arrays", components(&deep), "recursion limit"),
    ] {
        refuse_stored(name, "a.json", &content, USAGE, &["a.json", says]);
    }
    let other = components("[[1, 1], \"1\"]")
        .replace("\"tensors\"", "\"algebra\": {\"dimension\": 6}, \"tensors\"");
    let says = &["the stored dimension is 6, the computed one 3"];
    refuse_stored("another dimension", "a.json", &other, MATHEMATICS, says);
}

#[test]
fn csv() {
    const HEADER: &str = "tensor,i,j,k,l,value\n";
    for (name, content, says) in [
        ("empty", "", "the header is not tensor,i,j,k,l,...,value"),
        ("no table", "dimension = 2", "the header is not"),
        ("only a header", HEADER, "there is no component in it"),
        ("too few columns", "tensor,i,value\nricci,1,1", "the header is not"),
        ("a short row", "tensor,i,j,k,l,value\nricci,1,1\n", "3"),
        ("unknown tensor", "tensor,i,j,k,l,value\nbach,1,1,,,1\n", "row 2: `bach` is no tensor"),
        (
            "no index",
            "tensor,i,j,k,l,value\nricci,1,1,,,1\nricci,x,1,,,1\n",
            "row 3: an index is no number",
        ),
        ("index zero", "tensor,i,j,k,l,value\nricci,0,1,,,1\n", "row 2: an index is no number"),
        ("no value", "tensor,i,j,k,l,value\nricci,1,1,,,\n", "ricci: ``"),
        ("a bad value", "tensor,i,j,k,l,value\nricci,1,1,,,1/0\n", "`1/0`: division by zero"),
        ("what does not apply", "tensor,i,j,k,l,value\nmetric,1,1,,,1\n", "metric is stored"),
        (
            "an escape sequence",
            "tensor,i,j,k,l,value\n\u{1b}[31m,1,1,,,1\n",
            "`\\u{1b}[31m` is no tensor",
        ),
    ] {
        refuse_stored(name, "a.csv", content, USAGE, &["a.csv", says]);
    }
}

#[test]
fn not_text() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("a.json"), b"{\"schema\": \"\xff\"}").unwrap();
    let outcome = run(folder.path(), &["verify", "so3", "a.json"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("cannot read a.json"), "{}", outcome.err);
    assert!(outcome.err.contains("UTF-8"), "{}", outcome.err);
}
