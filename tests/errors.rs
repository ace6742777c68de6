//! The table of laws: each message names its witness, and each class exists in Python.

use crate::common::root;
use affinor::{Error, Law};
use std::collections::BTreeSet;

/// Entries and a residual that occur in no message by chance.
fn broken(law: Law) -> (Vec<String>, Error) {
    let count = law.parts().iter().map(|(_, names)| names.len()).sum();
    let at: Vec<_> = (0..count).map(|entry| format!("<{entry}>")).collect();
    (at.clone(), law.broken(at, "<residual>"))
}

#[test]
fn messages_contain_the_whole_witness() {
    for law in Law::ALL {
        let (at, error) = broken(*law);
        let message = error.to_string();
        for entry in &at {
            assert!(message.contains(entry), "{law:?}: {message}");
        }
        assert!(!message.contains(['{', '}']) && !message.contains("  "), "{law:?}: {message}");
        // only the value 0 may be absent
        let silent = [Law::KillingOnSubalgebra, Law::RegularPoint, Law::RegularTangent];
        assert_eq!(message.contains("<residual>"), !silent.contains(law), "{law:?}: {message}");
    }
}

/// A witness without its entries, or with more, is written without a panic.
#[test]
fn messages_accept_any_number_of_entries() {
    for law in Law::ALL {
        let (at, _) = broken(*law);
        for count in 0..at.len() + 2 {
            let entries: Vec<_> = (0..count).map(|entry| entry.to_string()).collect();
            assert!(!law.broken(entries, "").to_string().is_empty());
        }
    }
}

#[test]
fn parts_of_a_witness_have_different_keys() {
    for law in Law::ALL {
        let mut keys = BTreeSet::from(["residual"]);
        for (part, names) in law.parts() {
            assert!(keys.insert(part) && !names.is_empty(), "{law:?}: {part}");
        }
    }
}

#[test]
fn python_has_an_exception_for_each_class() {
    let path = root().join("python/pysrc/affinor/errors.py");
    let classes = std::fs::read_to_string(path).unwrap();
    let kinds = [
        Error::Name(String::new()),
        Error::NoMetric,
        Error::SingularBasis,
        Error::Shape { what: "", expected: String::new(), found: String::new() },
        Error::Degenerate { null: String::new(), components: vec![] },
        Error::Integration { t: 0.0, reason: String::new() },
        Error::Symmetry {
            what: "",
            symmetry: "",
            slots: [1, 2],
            at: vec![],
            residual: String::new(),
        },
    ];
    let laws = Law::ALL.iter().map(|law| broken(*law).1);
    for error in kinds.into_iter().chain(laws) {
        let class = error.class();
        assert!(classes.contains(&format!("class {class}(")), "{error:?}: {class}");
    }
}
