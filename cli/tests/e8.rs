//! E8 from end to end: by name, and from a definition file made from GAP's table.

use affinor::{Bracket, LieAlgebra};
use affinor_documents::space::{Request, Space};
use affinor_tensors::{Rational, Tolerance};
use std::fs;
use std::process::Command;

/// GAP's table as a definition file.
fn definition() -> String {
    let table = include_str!("../../tests/data/E8.txt");
    let rows = table.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let [i, j, k, v] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            panic!("four numbers in {line}")
        };
        format!("[{i}, {j}, {k}, \"{v}\"]")
    });
    let rows = rows.collect::<Vec<_>>().join(",\n");
    format!("name = \"E8 of GAP\"\ndimension = 248\nstructure_constants = [\n{rows}\n]\n")
}

fn bracket(space: &str) -> Bracket<Rational> {
    let request = Request { space: Some(space.into()), ..Request::default() };
    let definition = Space::open(&request).expect("E8 is understood").definition;
    definition.bracket(Tolerance::default()).expect("E8 is a bracket")
}

/// `[e_i, f_i] = h_i` for the simple roots in both tables, so `e_i` and `f_i` may differ by one
/// sign; the signs of the others follow from their brackets. With them the tables are equal.
#[test]
fn name_and_file_agree_up_to_signs() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("E8.toml");
    fs::write(&file, definition()).expect("a file");
    let (mine, gap) = (bracket("E8"), bracket(file.to_str().expect("a plain path")));
    assert_eq!(
        (mine.structure_constants().len(), gap.structure_constants().len()),
        (16_694, 16_694)
    );
    let mut sign: Vec<Option<Rational>> = vec![None; 248];
    let one = || Some(Rational::from(1));
    (0..8).chain(240..248).for_each(|i| sign[i] = one());
    for _ in 0..248 {
        for (at, value) in mine.structure_constants().components() {
            // e_i' = s_i e_i, so c'^i_jk = s_i s_j s_k c^i_jk with signs s
            let ratio = value.clone() / gap.structure_constants().get(&at);
            let known = at.iter().filter_map(|&i| sign[i].clone());
            let product = known.fold(ratio, |product, s| product * &s);
            if let [unknown] = at.iter().filter(|&&i| sign[i].is_none()).collect::<Vec<_>>()[..] {
                sign[*unknown] = Some(product);
            }
        }
    }
    let sign: Vec<Rational> = sign.into_iter().map(|s| s.expect("every root is reached")).collect();
    assert!(sign.iter().any(|s| s.is_negative()), "the tables differ by signs");
    for (at, value) in mine.structure_constants().components() {
        let signs = at.iter().fold(Rational::from(1), |product, &i| product * &sign[i]);
        assert_eq!(gap.structure_constants().get(&at), value.clone() * &signs, "at {at:?}");
    }
    assert!(LieAlgebra::try_from(gap).is_ok());
}

/// The command of the README's largest example: 1,031,700 rows, sorted, none of them zero.
#[test]
fn curvature_of_the_file_as_csv() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    fs::write(file("E8.toml"), definition()).expect("a file");
    let status = Command::new(env!("CARGO_BIN_EXE_affinor"))
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
