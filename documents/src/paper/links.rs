//! Where the functions and the tests of an equation stand, relative to the repository, which has no address elsewhere.

/// Files with the functions of the library that the document names.
const FUNCTIONS: &[(&str, &[&str])] = &[
    ("src/algebra.rs", &["LieAlgebra::change_basis"]),
    ("src/algebra/bch.rs", &["LieAlgebra::bch"]),
    ("src/algebra/bracket.rs", &["Bracket::new"]),
    ("src/algebra/frame.rs", &["Frame::coordinates", "Frame::derivative", "Frame::structure"]),
    ("src/algebra/lie_derivative.rs", &["Frame::bracket"]),
    ("src/algebra/matrices.rs", &["MatrixBasis::bracket", "MatrixBasis::frobenius"]),
    ("src/geometry.rs", &["Geometry::in_right_frame"]),
    ("src/geometry/chart/at_point.rs", &["Frame::canonical_at_point"]),
    ("src/geometry/chart/invariant_fields.rs", &["Chart::invariant_fields"]),
    ("src/geometry/chart/moved.rs", &["Connection::moved"]),
    ("src/geometry/connection.rs", &["Connection::gamma", "Connection::nabla"]),
    ("src/geometry/connection/canonical.rs", &["Connection::canonical"]),
    (
        "src/geometry/curvature.rs",
        &["Connection::curvature", "Connection::ricci", "Connection::torsion"],
    ),
    ("src/geometry/equations.rs", &["Equations", "Equations::euler_poincare"]),
    ("src/geometry/forms.rs", &["Form::interior", "Frame::coframe"]),
    (
        "src/geometry/metric.rs",
        &["Metric", "Metric::ad_variation", "Metric::lower", "Metric::trace"],
    ),
    ("src/geometry/metric_affine.rs", &["Connection::levi_civita", "Connection::nonmetricity"]),
    ("src/geometry/paper.rs", &["paper::m3", "paper::so3"]),
    (
        "src/group/lie_group.rs",
        &[
            "LieGroup::adjoint",
            "LieGroup::algebra",
            "LieGroup::basis",
            "LieGroup::bracket",
            "LieGroup::compose",
            "LieGroup::exp",
            "LieGroup::identity",
            "LieGroup::log",
            "LieGroup::matrix",
            "LieGroup::tangent_left",
            "LieGroup::tangent_right",
        ],
    ),
    (
        "src/group/fields.rs",
        &["InvariantField", "InvariantField::at", "InvariantField::flow", "right_translate"],
    ),
    ("src/group/rotation/conversions.rs", &["rotation::matrix"]),
    ("src/group/groups/so3.rs", &["So3::exp", "So3::log", "So3::log_near", "group::So3"]),
    (
        "src/group/transport.rs",
        &[
            "Connection::transport_along",
            "Connection::transport_generator",
            "ParallelTranslation::along_curve",
            "ParallelTranslation::along_samples",
            "ParallelTranslation::along_subgroup",
        ],
    ),
    ("src/group/transport/autoparallel.rs", &["ParallelTranslation::autoparallel"]),
    (
        "src/group/velocity.rs",
        &[
            "Velocity",
            "Velocity::from_body",
            "Velocity::in_coordinates",
            "Velocity::of_path",
            "Velocity::of_samples",
        ],
    ),
    ("src/mechanics/bodies/mass.rs", &["MassProperties::inertia_matrix_about"]),
];

/// Files with the tests of equations.
const TESTS: &[(&str, &[&str])] = &[
    ("tests/canonical_at_point.rs", &["(75)"]),
    ("tests/charts.rs", &["(75)"]),
    (
        "tests/paper/appendices.rs",
        &[
            "(A1), (A2)",
            "(A3)-(A8)",
            "(A9)",
            "(A10)",
            "(B1)-(B3)",
            "(B4), (B5)",
            "(B6)-(B8)",
            "(B9), (B10)",
            "(B11), (B12)",
            "(B13), (B14)",
        ],
    ),
    (
        "tests/paper/canonical.rs",
        &["(38)", "after (38)", "before (39)", "(39)", "after (39)", "(40)", "after (40)"],
    ),
    (
        "tests/paper/classical.rs",
        &["(1)-(3)", "(4)", "(5)-(8)", "(9), (10)", "(11)-(14)", "(15)", "(16)"],
    ),
    (
        "tests/paper/coordinates.rs",
        &[
            "(72)",
            "at (72)",
            "(73)",
            "(74)",
            "(76)-(79)",
            "(80)-(83)",
            "(84), (85)",
            "(86)",
            "after (86)",
            "(87)-(90)",
        ],
    ),
    (
        "tests/paper/dynamics.rs",
        &["(100), (101)", "(104)", "(106)", "(107)", "(108)", "after (108)", "(109)"],
    ),
    (
        "tests/paper/fields.rs",
        &[
            "(A3)-(A8)",
            "(B6)-(B8)",
            "(100), (101)",
            "(105)",
            "(28)",
            "(29)-(31)",
            "(32)-(34)",
            "(35)",
            "(36), (37)",
        ],
    ),
    ("tests/paper/groups.rs", &["(28)", "(29)-(31)", "(32)-(34)", "(35)", "(36), (37)"]),
    ("tests/paper/halves.rs", &["(62), (63)", "(66)-(69)", "(70)", "(71)", "after (71)"]),
    (
        "tests/paper/kinematics.rs",
        &["(42)", "(43)", "(44), (45)", "(46)", "(49)-(51)", "(57)", "(60)"],
    ),
    ("tests/paper/metrics.rs", &["(91)-(98)", "(99)", "(102)", "after (102)", "(103)"]),
    (
        "tests/paper/motion.rs",
        &[
            "(9), (10)",
            "(41), (52)-(56), (59)",
            "(42)",
            "(43)",
            "(44), (45)",
            "(46)",
            "(47), (48)",
            "(49)-(51)",
            "(57)",
            "(58)",
            "after (59)",
            "(60)",
            "after (60)",
            "(61)",
            "(65)",
            "(66)-(69)",
        ],
    ),
    ("tests/paper/power.rs", &["after (109)"]),
    (
        "tests/paper/rotations.rs",
        &[
            "(87)-(90)",
            "(62), (63)",
            "(64)",
            "(65)",
            "after (65)",
            "(66)-(69)",
            "(71)",
            "after (71)",
        ],
    ),
    ("tests/paper/translations.rs", &["(17), (18)", "(19)-(24)", "(25)-(27)", "(70)"]),
];

/// The file of a function.
pub(super) fn function(name: &str) -> Option<&'static str> {
    FUNCTIONS.iter().find(|(_, names)| names.contains(&name)).map(|(file, _)| *file)
}

/// The files with tests of an equation.
pub(super) fn tests(equation: &str) -> impl Iterator<Item = &'static str> + use<'_> {
    TESTS.iter().filter(move |(_, equations)| equations.contains(&equation)).map(|(file, _)| *file)
}
