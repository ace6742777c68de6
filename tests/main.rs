//! Tests of the library: folders and files follow `src/`; `claims/` contains claims about several
//! modules.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;
#[path = "common/ode.rs"]
mod ode;

mod numerics {
    mod blocks;
    mod tableaux;
}

mod algebra {
    mod basis;
    mod bch;
    mod catalogue;
    mod distribution;
    mod frame;
    mod generators;
    mod invariants;
    mod lie_derivative;
    mod lie_poisson;
    mod module;
    mod rational_basis;
    mod roots;
    pub mod structure;
}

mod representation {
    mod algebra;
    mod casimirs;
    mod character;
    mod class;
    mod clebsch_gordan;
    mod common;
    mod decomposition;
    mod diagram;
    mod embeddings;
    mod highest_weight;
    mod matrices;
    mod named;
    mod names;
    mod powers;
    mod products;
    mod regular;
    mod spanned;
    mod subalgebra;
}

mod geometry {
    mod chart;
    mod conditions;
    mod connection;
    mod curvature;
    mod equations;
    mod forms;
    mod holonomy;
    mod homogeneous;
    mod isometry;
    mod metric_affine;
    mod petrov;
    mod properties;
    mod reductive;
}

mod group {
    mod batch;
    mod embedded;
    mod groups;
    mod kak;
    mod laws;
    mod restored;
    mod rotation;
    mod tangent;
    mod transport;
    mod velocity;
}

mod mechanics {
    mod bodies {
        mod elliptic;
        mod free_body;
        mod inertia;
    }
    mod events;
    mod formula;
    mod geodesics {
        mod sub_riemannian;
    }
    mod integrators;
    mod mechanism;
    mod systems {
        mod constrained;
        mod euler_poincare;
        mod homogeneous;
        mod isospectral;
    }
}

mod claims {
    mod constructors;
    mod covariance;
    mod embedding;
    mod families;
    mod floats;
    mod frames;
    mod group_thresholds;
    mod long_runs;
    mod milnor;
    mod no_numbers;
    mod orbit;
    mod power;
    mod property_witnesses;
    mod right_frame;
    mod scalars_agree;
    mod stops;
    mod structure_constants;
    mod travelling;
    mod trials;
}

mod error;
mod serial;
mod tidy;
mod words;
