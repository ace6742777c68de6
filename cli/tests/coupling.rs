//! `affinor coupling`: coefficients in every format, and invalid spins.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};

fn coupling(arguments: &[&str]) -> Value {
    let all = [&["coupling"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&stdout(root(), &all)).unwrap()
}

#[test]
fn coefficients_are_exact() {
    let report = coupling(&["1/2", "1/2", "0"]);
    assert_eq!(report["kind"], "clebsch-gordan");
    let first = &report["coefficients"][0];
    assert_eq!(first["value"], "-sqrt(1/2)");
    assert_eq!(first["signed_square"], "-1/2");
    assert_eq!((&first["m1"], &first["m"]), (&json!("-1/2"), &json!("0")));
    let six = coupling(&["1", "1", "1", "1", "1", "1", "--symbol", "6j"]);
    assert_eq!(six["coefficients"][0]["value"], "1/6");
    let three = coupling(&["1", "1", "0", "--symbol", "3j"]);
    assert_eq!(three["coefficients"].as_array().unwrap().len(), 3);
    let real = coupling(&["1", "1", "1", "--real"]);
    assert_eq!(real["coefficients"].as_array().unwrap().len(), 6);
    // all coefficients for two spins: the columns of an orthogonal matrix of size 6
    let all = coupling(&["1", "1/2"]);
    let squares = all["coefficients"].as_array().unwrap().iter();
    let sum: f64 = squares.map(|one| one["decimal"].as_f64().unwrap().powi(2)).sum();
    assert!((sum - 6.0).abs() < 1e-12);
}

#[test]
fn invalid_spins_are_rejected() {
    for (arguments, reason) in [
        (&["1", "1", "3"][..], "do not couple to 3"),
        (&["1", "1/3"], "write an integer or half"),
        (&["1", "1", "1", "1"], "write two or three spins"),
        (&["1", "1", "--symbol", "6j"], "6 spins"),
        (&["1/2", "1/2", "1", "--real"], "integers"),
        (&["1", "1", "--real", "--symbol", "3j"], "cannot be used"),
        (&["1"], "SPIN"),
    ] {
        let all = [&["coupling"], arguments].concat();
        let outcome = run(root(), &all, b"");
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.err);
        assert!(outcome.err.contains(reason), "{arguments:?}: {}", outcome.err);
    }
}

/// Large spins: the squares of the coefficients are below the least float, and the number of
/// coefficients is limited before the computation begins.
#[test]
fn large_spins() {
    let large = coupling(&["80", "80", "160", "--symbol", "3j"]);
    let all = large["coefficients"].as_array().unwrap();
    assert!(all.iter().all(|one| one["decimal"].as_f64().unwrap() != 0.0));
    let outcome = run(root(), &["coupling", "100", "100"], b"");
    assert_ne!(outcome.status, 0);
    assert!(outcome.err.contains("exceeds the limit of 1048576"), "{}", outcome.err);
    assert!(outcome.err.contains("third spin"), "{}", outcome.err);
}
