//! Tests of `affinor-documents`: files follow `documents/src/`, and `claims/` contains claims about
//! several files.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../common/mod.rs"]
mod common;

mod space {
    mod chart;
    mod charts;
    mod homogeneous;
    mod tables;
}
mod figures;
mod input {
    mod urdf;
}
mod problem {
    mod horizontal;
    pub mod on_tree;
}
mod report;

mod claims {
    mod curves;
    mod double_double;
    mod equal_functions;
    mod formula_names;
    mod fuzz;
    mod hodge;
    mod hypersurfaces;
    mod line_elements;
    mod mass_properties;
    mod parameters;
    mod places;
    mod printed;
    pub mod problems;
    mod public_reports;
    mod random_charts;
    mod right_invariant;
    mod statement;
    mod weyl_scalars;
}
