//! `docs/paper.md` keeps its word: all rows are there, and each is shown by a test that names it.

use crate::program::root;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The names of all tests.
fn tests(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            tests(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            for rest in text.split("#[test]").skip(1) {
                let name = rest.split_once("fn ").and_then(|(_, rest)| rest.split_once('('));
                found.insert(name.unwrap().0.to_string());
            }
        }
    }
}

/// A row such as `57` or `a8`: its letter and its number.
type Row = (String, usize);

fn row(text: &str) -> Option<Row> {
    let digits = text.find(|c: char| c.is_ascii_digit())?;
    let letter = text[..digits].to_lowercase();
    (letter.len() < 2).then_some((letter, text[digits..].parse().ok()?))
}

fn through(first: &Row, last: &Row) -> impl Iterator<Item = Row> {
    assert!(first.0 == last.0 && first.1 < last.1, "{first:?} to {last:?}");
    let letter = first.0.clone();
    (first.1..=last.1).map(move |number| (letter.clone(), number))
}

/// The rows of a name: `eq_52_to_56_and_59_..`.
fn rows_of_test(name: &str) -> Vec<Row> {
    let words: Vec<&str> = name.split('_').collect();
    let mut rows: Vec<Row> = vec![];
    if words[0] != "eq" {
        return rows;
    }
    rows.extend(words.get(1).and_then(|word| row(word)));
    for pair in words[2.min(words.len())..].chunks(2) {
        match (pair, pair.get(1).and_then(|word| row(word)), rows.last().cloned()) {
            (["and", _], Some(next), _) => rows.push(next),
            (["to", _], Some(next), Some(last)) => rows.extend(through(&last, &next).skip(1)),
            _ => break,
        }
    }
    rows
}

/// The rows of a cell: `(17), (18)` or `(19)-(24)`.
fn rows_of_cell(cell: &str) -> Vec<Row> {
    let inside = |text: &str| row(text.trim_matches(|c| c == '(' || c == ')'));
    let ranges = cell.split(", ").map(|part| match part.split_once('-') {
        Some((first, last)) => {
            through(&inside(first).unwrap(), &inside(last).unwrap()).collect::<Vec<_>>()
        }
        None => vec![inside(part).unwrap()],
    });
    ranges.flatten().collect()
}

fn expected() -> BTreeSet<Row> {
    let rows = |letter: &str, last: usize| {
        let letter = letter.to_string();
        (1..=last).map(move |number| (letter.clone(), number))
    };
    rows("", 109).chain(rows("a", 10)).chain(rows("b", 14)).collect()
}

#[test]
fn every_row_is_shown_by_a_test() {
    let root = root();
    let page = fs::read_to_string(root.join("docs/paper.md")).unwrap();
    let mut names = BTreeSet::new();
    tests(&root.join("tests"), &mut names);
    let tested: BTreeSet<Row> = names.iter().flat_map(|name| rows_of_test(name)).collect();
    let (mut claimed, mut remarks) = (BTreeSet::new(), 0);
    let cells = page.lines().filter_map(|line| line.strip_prefix("| ")?.split_once(" |"));
    for (cell, _) in cells.filter(|(cell, _)| cell.ends_with(')')) {
        if cell.starts_with('(') {
            for row in rows_of_cell(cell) {
                assert!(tested.contains(&row), "no test shows {row:?}");
                assert!(claimed.insert(row.clone()), "{row:?} stands twice");
            }
        } else {
            // `after (71)`: a test `after_71_..`
            let name = cell.replace(['(', ')'], "").replace(' ', "_");
            let shown = names.iter().any(|test| test.starts_with(&format!("{name}_")));
            assert!(shown, "no test `{name}_..`");
            remarks += 1;
        }
    }
    assert_eq!(claimed, expected());
    assert!(remarks > 10, "{remarks}");
}

/// `Type::function` and modules in the third column are words of the source.
#[test]
fn every_function_exists() {
    let root = root();
    let page = fs::read_to_string(root.join("docs/paper.md")).unwrap();
    let mut source = String::new();
    let mut open = vec![root.join("src"), root.join("documents/src"), root.join("cli/src")];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                source += &fs::read_to_string(&path).unwrap();
            }
        }
    }
    let rows = page.lines().filter(|line| line.starts_with("| ("));
    let columns = rows.map(|line| line.split(" | ").nth(2).unwrap());
    let mut found = 0;
    for code in columns.flat_map(|cell| cell.split('`').skip(1).step_by(2)) {
        for word in code.split("::") {
            let kinds = ["fn ", "struct ", "trait ", "mod ", "pub "];
            let known = kinds.iter().any(|kind| {
                source.match_indices(&format!("{kind}{word}")).any(|(at, name)| {
                    !source[at + name.len()..]
                        .starts_with(|c: char| c.is_alphanumeric() || c == '_')
                })
            });
            assert!(known, "`{code}`: {word}");
            found += 1;
        }
    }
    assert!(found > 80, "{found}");
}

#[test]
fn names_are_read() {
    let plain = |numbers: &[usize]| numbers.iter().map(|n| (String::new(), *n)).collect::<Vec<_>>();
    assert_eq!(rows_of_test("eq_41_and_52_to_54_the_velocity"), plain(&[41, 52, 53, 54]));
    assert_eq!(
        rows_of_test("eq_a3_to_a5"),
        ["a"; 3].into_iter().map(String::from).zip(3..).collect::<Vec<_>>()
    );
    assert_eq!(rows_of_test("after_71_holonomy"), []);
    assert_eq!(rows_of_cell("(9), (10)"), plain(&[9, 10]));
    assert_eq!(rows_of_cell("(1)-(4)"), plain(&[1, 2, 3, 4]));
}
