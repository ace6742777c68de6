//! E8 from end to end, from a definition file that contains GAP's table.

use crate::program;
use std::fs;
use std::process::Command;

/// GAP's table as a definition file.
fn definition() -> String {
    let table = include_str!("../../examples/data/E8.txt");
    let rows = table.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let [i, j, k, v] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            panic!("four numbers in {line}")
        };
        format!("[{i}, {j}, {k}, \"{v}\"]")
    });
    let rows = rows.collect::<Vec<_>>().join(",\n");
    format!("name = \"E8 of GAP\"\ndimension = 248\nstructure_constants = [\n{rows}\n]\n")
}

/// The command of the README's largest example: 1,031,700 sorted rows, all nonzero.
#[test]
fn curvature_of_the_file_as_csv() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    fs::write(file("E8.toml"), definition()).expect("a file");
    let status = Command::new(program::path())
        .arg("table")
        .arg(file("E8.toml"))
        .args(["--connection", "zero", "--show", "curvature", "--format", "csv", "-o"])
        .arg(file("out.csv"))
        .status()
        .expect("the command runs");
    assert!(status.success());
    let csv = fs::read_to_string(file("out.csv")).expect("a table");
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some("tensor,i,j,k,l,value"));
    let keys: Vec<Vec<usize>> = rows
        .map(|row| {
            let fields: Vec<&str> = row.split(',').collect();
            assert!(fields[0] == "curvature" && fields[5] != "0", "{row}");
            fields[1..5].iter().map(|index| index.parse().expect("an index")).collect()
        })
        .collect();
    assert_eq!(keys.len(), 1_031_700);
    assert!(keys.is_sorted_by(|a, b| a < b));
}
