//! `affinor compare`: two spaces side by side.

use crate::program::{root, stdout};
use affinor_documents::report::Claim;
use serde_json::Value;

/// The output of `affinor compare` with these arguments.
fn compare(arguments: &[&str]) -> String {
    stdout(root(), &[&["compare"], arguments].concat())
}

/// The verdicts in the JSON of a comparison: `true`, `false` or `null` on both sides.
fn holds(arguments: &[&str]) -> Vec<[Option<bool>; 2]> {
    let json: Value =
        serde_json::from_str(&compare(&[arguments, &["--format", "json"]].concat())).unwrap();
    assert_eq!(json["schema"], "affinor.compare/1");
    let claims = json["claims"].as_array().unwrap().iter();
    claims.map(|claim| [0, 1].map(|side| claim["verdicts"][side]["holds"].as_bool())).collect()
}

#[test]
fn compare_so3_plus_with_so3_minus() {
    let text = compare(&["so3@plus", "so3@minus"]);
    assert!(text.starts_with("so(3)@plus and so(3)@minus\n"), "{text}");
    let (yes, no, none) = (Some(true), Some(false), None);
    let expected = [
        [yes, no],
        [yes, no],
        [yes, yes],
        [yes, no],
        [none, none],
        [yes, yes],
        [no, no],
        [no, no],
        [no, no],
        [no, no],
        [none, none],
        [none, none],
    ];
    assert_eq!(holds(&["so3@plus", "so3@minus"]), expected);
}

#[test]
fn compare_tells_two_spaces_of_one_name_apart() {
    let first = |arguments: &[&str]| compare(arguments).lines().next().unwrap().to_string();
    assert_eq!(first(&[]), "M(3) and SO(3)");
    assert_eq!(first(&["so3@lambda=1/3", "so3@zero"]), "so(3)@lambda=1/3 and so(3)@zero");
    assert_eq!(
        first(&["so3;metric=diag(1,2,3)", "so3;metric=diag(1,1,3)"]),
        "so(3)@levi-civita (1) and so(3)@levi-civita (2)"
    );
}

#[test]
fn comparisons_stay_within_80_columns() {
    let pairs: [&[&str]; 6] = [
        &[],
        &["so3@plus", "so3@minus"],
        &["se3", "heisenberg5"],
        &["A2", "heisenberg(11);metric=identity"],
        &["so3@lambda=a+b", "bianchi(VI,h=h)"],
        &["so3;metric=diag(1,2,3)", "so3;metric=[[1,0,1/2],[0,2,0],[1/2,0,3]]"],
    ];
    for pair in pairs {
        let text = compare(pair);
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{pair:?}: {line}");
        }
        // every claim and its verdict occur in every format
        for format in ["markdown", "latex", "csv", "json"] {
            let written = compare(&[pair, &["--format", format]].concat());
            for claim in Claim::ALL {
                assert!(written.contains(claim.equation()), "{pair:?} {format}: {claim:?}");
            }
        }
    }
}
