//! The examples run, and every definition next to them passes `affinor check`.

use crate::program::{definition, root, stdout};
use affinor_documents::input::InputError;
use affinor_documents::space::{Request, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::Tolerance;

#[path = "../../examples/01_so3_two_geometries.rs"]
mod so3_two_geometries;

#[path = "../../examples/02_any_bracket.rs"]
mod any_bracket;

#[path = "../../examples/03_levi_civita_of_a_metric.rs"]
mod levi_civita_of_a_metric;

#[path = "../../examples/04_moving_frames.rs"]
mod moving_frames;

#[path = "../../examples/05_definition_from_gap.rs"]
#[allow(dead_code, reason = "its main takes the arguments of the test run for its own")]
mod definition_from_gap;

#[path = "../../examples/06_matrix_basis.rs"]
mod matrix_basis;

#[path = "../../examples/07_group_and_exponential.rs"]
mod group_and_exponential;

#[path = "../../examples/08_poses.rs"]
mod poses;

#[path = "../../examples/09_parallel_transport.rs"]
mod parallel_transport;

#[path = "../../examples/10_top_with_torque.rs"]
mod top_with_torque;

#[path = "../../examples/11_events_and_dense_output.rs"]
mod events_and_dense_output;

#[path = "../../examples/12_own_scalar.rs"]
mod own_scalar;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn one_group_two_geometries() -> Outcome {
    so3_two_geometries::main()
}

#[test]
fn any_bracket() -> Outcome {
    any_bracket::main()
}

#[test]
fn levi_civita_of_a_metric() -> Outcome {
    levi_civita_of_a_metric::main()
}

#[test]
fn moving_frames() -> Outcome {
    moving_frames::main()
}

#[test]
fn matrix_basis() -> Outcome {
    matrix_basis::main()
}

#[test]
fn group_and_exponential() -> Outcome {
    group_and_exponential::main()
}

#[test]
fn poses() -> Outcome {
    poses::main()
}

#[test]
fn parallel_transport() -> Outcome {
    parallel_transport::main()
}

#[test]
fn top_with_torque() -> Outcome {
    top_with_torque::main()
}

#[test]
fn events_and_dense_output() -> Outcome {
    events_and_dense_output::main()
}

#[test]
fn own_scalar() -> Outcome {
    own_scalar::main()
}

/// The dimension and the number of structure constants. Also checks the Jacobi identity.
fn dimension<S: Coefficient>(space: &Space) -> Result<(usize, usize), InputError> {
    let algebra = space.definition.algebra::<S>(Tolerance::default())?;
    Ok((algebra.dimension(), algebra.structure_constants().len()))
}

#[test]
fn a_table_of_gap_becomes_a_definition() -> Outcome {
    let text = definition_from_gap::definition("E8", 248, definition_from_gap::E8)?;
    let file = tempfile::Builder::new().suffix(".toml").tempfile()?;
    std::fs::write(file.path(), text)?;
    let space = file.path().to_str().ok_or("a path that is not valid text")?.to_string();
    let space = Space::open(&Request { space: Some(space), ..Request::default() })?;
    let found = over_kind!(space.kind(ScalarChoice::Exact)?, S => dimension::<S>(&space))?;
    assert_eq!(found, (248, 2 * 8347));
    assert!(definition_from_gap::definition("short", 2, "1 2 1").is_err());
    Ok(())
}

#[test]
fn every_definition_passes_check() -> Outcome {
    let mut checked = 0;
    for entry in std::fs::read_dir(definition(""))? {
        let path = entry?.path();
        stdout(root(), &["check", path.to_str().unwrap()]);
        checked += 1;
    }
    assert!(checked >= 15, "{checked} definitions");
    Ok(())
}

/// The Killing form of so(3).
const KILLING: &str = "killing,1,1,,,-2\nkilling,2,2,,,-2\nkilling,3,3,,,-2\n";

/// The Killing form of so(4) in the basis of `jensen_so4.toml`.
const JENSEN: &str = "killing,1,1,,,-4\nkilling,2,2,,,-4\nkilling,3,3,,,-4\n\
                      killing,4,4,,,-4\nkilling,5,5,,,-4\nkilling,6,6,,,-4\n";

#[test]
fn the_definitions_say_what_they_claim() {
    let expected = [
        ("aff1_hyperbolic.toml", "scalar_curvature", "scalar_curvature,,,,,-2\n"),
        ("affinities.toml", "torsion", ""),
        ("so3.toml", "killing", KILLING),
        ("structure_constants.json", "killing", KILLING),
        ("su2_complex.toml", "killing", KILLING),
        ("sl2_matrices.toml", "killing", "killing,1,2,,,4\nkilling,2,1,,,4\nkilling,3,3,,,8\n"),
        ("heisenberg.toml", "ricci", "ricci,1,1,,,-1/2\nricci,2,2,,,-1/2\nricci,3,3,,,1/2\n"),
        ("bianchi_vi_h.toml", "killing", "killing,3,3,,,h^2 + 1\n"),
        ("hyperbolic_space.toml", "weyl,kretschmann", "kretschmann,,,,,24\n"),
        ("hyperbolic_space.toml", "ricci_trace_free", ""),
        ("complex_hyperbolic_plane.toml", "cotton", ""),
        ("jensen_so4.toml", "killing", JENSEN),
        ("milnor_nonunimodular.toml", "ricci_antisymmetric", ""),
        ("sphere.toml", "scalar_curvature", "scalar_curvature,,,,,2/a^2\n"),
        ("hyperbolic_plane.toml", "scalar_curvature", "scalar_curvature,,,,,-2\n"),
        ("schwarzschild.toml", "ricci", ""),
    ];
    for (file, show, rows) in expected {
        let path = definition(file);
        let text = stdout(root(), &["table", &path, "--format", "csv", "--show", show]);
        assert_eq!(text, format!("tensor,i,j,k,l,value\n{rows}"), "{file}");
    }
}
