//! Every problem of `examples/motions` is run by the library and compared with references of 25 and
//! more digits, closed forms and conserved quantities.
//!
//! Guards `documents::problem` and `mechanics::simulation`.

mod checks;
pub mod linkages;
mod mechanisms;
mod nonholonomic;
mod references;
mod run;

use affinor::mechanics::simulation::Method;
use affinor::mechanics::{MassProperties, Mesh};
use affinor_documents::input::mesh;
use affinor_documents::problem::Problem;
use checks::CHECKS;
use nalgebra::{DMatrix, Isometry3, Vector3};
use references::off;
use run::{Run, folder, open};

#[test]
fn every_problem_moves_as_it_should() {
    let mut failed = vec![];
    for (name, check) in CHECKS {
        if std::panic::catch_unwind(|| check(name)).is_err() {
            failed.push(*name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn no_problem_is_without_a_check() {
    let entries = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let problems = entries.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    let mut names: Vec<String> =
        problems.map(|path| path.file_stem().unwrap().to_str().unwrap().to_string()).collect();
    names.sort();
    let mut checked: Vec<&str> = CHECKS.iter().map(|(name, _)| *name).collect();
    checked.sort_unstable();
    assert_eq!(names, checked);
}

/// The body of every key of `[inertia]` agrees with the library's sum of the same parts.
#[test]
fn a_body_is_the_sum_of_its_parts() {
    let text = r#"
space = "so3"
initial.velocity = [0, 0, 1]
output.end = 1
[parameters]
r = 0.5
[inertia]
about = [0.1, "r", 0]
parts = [
    { shape = "box", edges = [1, 2, 3], mass = 2, position = [0, 0, 1], rotation = [0, 0, "pi/4"] },
    { shape = "cylinder", radius = "r", height = 2, density = 3 },
    { shape = "ball", radius = "r/2", density = 3, position = [0, 0, 0.5], hole = true },
    { shape = "ellipsoid", half_axes = [1, 2, 3], mass = "2*r", rotation = [0.1, 0.2, 0.3] },
    { shape = "rod", length = 4, density = 0.5, position = [1, 0, 0] },
    { shape = "points", points = [[1, 0, 0, 1], ["r", 1, 0, 0]] },
]
"#;
    let problem = Problem::parse("body.toml", text).unwrap();
    let turn = |x: f64, y: f64, z: f64| Isometry3::rotation(Vector3::new(x, y, z));
    let block = MassProperties::cuboid(&Vector3::new(1.0, 2.0, 3.0)).unwrap();
    let block = block.of_mass(2.0).unwrap();
    let block = block.moved(&turn(0.0, 0.0, std::f64::consts::FRAC_PI_4));
    let cylinder = MassProperties::cylinder(0.5, 2.0).unwrap().of_density(3.0).unwrap();
    let ball = MassProperties::ball(0.25).unwrap().of_density(3.0).unwrap();
    let ellipsoid = MassProperties::ellipsoid(&Vector3::new(1.0, 2.0, 3.0)).unwrap();
    let rod = MassProperties::rod(4.0).unwrap().of_density(0.5).unwrap();
    let points = [(1.0, Vector3::z()), (0.5, Vector3::x())];
    let body = block.moved(&Isometry3::translation(0.0, 0.0, 1.0))
        + cylinder
        + ellipsoid.of_mass(1.0).unwrap().moved(&turn(0.1, 0.2, 0.3))
        + rod.moved(&Isometry3::translation(1.0, 0.0, 0.0))
        + MassProperties::points(&points).unwrap();
    let body = body.subtract(&ball.moved(&Isometry3::translation(0.0, 0.0, 0.5))).unwrap();
    let expected = body.inertia_matrix_about(&Vector3::new(0.1, 0.5, 0.0));
    let found = problem.motion(0).unwrap().inertia.unwrap();
    assert!(off(found.as_slice(), expected.as_slice()) < 1e-15, "{found} {expected}");
    // about the centre, gravity has no torque
    let text = text.replace("about = [0.1, \"r\", 0]", "about = \"centre\"");
    let text = text + "[quantities]\nm = \"mass\"\nc = \"centre1^2 + centre2^2 + centre3^2\"\n";
    let run = Run::new(&Problem::parse("body.toml", &text).unwrap(), 0);
    assert!(off(&run.values(0, &["m", "c"]), &[body.mass(), 0.0]) < 1e-15);
}

/// The mesh of the examples is the box.
#[test]
fn the_mesh_of_the_examples_is_a_box() {
    let bytes = std::fs::read(folder().join("block.stl")).unwrap();
    let block: Mesh = mesh("block.stl", &bytes).unwrap();
    let expected = MassProperties::cuboid(&Vector3::new(1.0, 2.0, 3.0)).unwrap();
    let found = block.mass_properties().inertia_matrix();
    assert!((found - expected.inertia_matrix()).amax() < 1e-13);
}

#[test]
fn an_indefinite_metric_is_allowed_and_named() {
    let text = "space = 'so3'\nmetric = 'diag(1, 2, -3)'\ninitial.momentum = [1, 2, 3]\n\
                integrator.tolerance = 1e-12\noutput = { end = 0.5, every = 0.1 }";
    let problem = Problem::parse("lorentz.toml", text).unwrap();
    let ready = problem.motion(0).unwrap();
    assert_eq!(
        ready.notes,
        ["the metric is indefinite, so the energy does not bound the velocity"]
    );
    assert_eq!(ready.method.name(), "rkmk853");
    Run::new(&problem, 0).keeps(&["energy", "h1", "h2", "h3", "casimir1"], 1e-10);
}

/// For every kind of motion, an infinite or NaN end time is an error, and the motion continues from
/// its last state.
#[test]
fn motions_towards_no_time_are_refused() {
    for (name, _) in CHECKS {
        let problem = open(name);
        let mut motion = problem.motion(0).unwrap().motion;
        let row = motion.row();
        for until in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let error = motion.step(until).unwrap_err();
            assert!(error.to_string().contains("not finite"), "{name}: {error}");
        }
        assert_eq!((motion.row(), motion.steps()), (row, 0), "{name}");
    }
}

/// Motions in embedding coordinates are the same, on the groups with closed forms.
#[test]
fn projected_methods_agree() {
    for name in [
        "free_body",
        "heavy_top",
        "heavy_top_reduced",
        "friction",
        "kirchhoff",
        "geodesic_sl2",
        "geodesic_se2",
        "geodesic_heisenberg",
        "thrown_ball",
    ] {
        let problem = open(name);
        let rows = |method, step| {
            Run::new(&problem.with_method(method, step, Some(1e-12)), 0).rows.concat()
        };
        let expected = rows(Method::MuntheKaas853, None);
        for (method, step, tolerance) in [
            (Method::Projected54, None, 1e-9),
            (Method::Projected853, None, 1e-9),
            (Method::Projected4, Some(0.001), 1e-5),
        ] {
            let error = off(&rows(method, step), &expected);
            println!("{name}, {method}: {error:.1e}");
            assert!(error < tolerance, "{name}, {method}: {error:e}");
        }
    }
    for name in ["euler_poincare_so4", "fluid_se2"] {
        let problem = open(name).with_method(Method::Projected4, Some(0.1), Some(1.0));
        let Err(error) = problem.motion(0) else { panic!("{name}: projected") };
        assert!(error.to_string().contains("it is for left-invariant systems"), "{error}");
    }
}

fn with_element(space: &str, dimension: usize, element: &DMatrix<f64>) -> Result<(), String> {
    let rows: Vec<Vec<f64>> = element.row_iter().map(|row| row.iter().copied().collect()).collect();
    let velocity: Vec<f64> = (0..dimension).map(|i| 0.4 - 0.3 * (i % 3) as f64).collect();
    let text = format!(
        "space = \"{space}\"\nmetric = \"identity\"\n[initial]\nelement = {rows:?}\n\
         velocity = {velocity:?}\n[output]\nend = 1\ncolumns = [\"g\"]\n"
    );
    let problem = Problem::parse("element.toml", &text).unwrap();
    problem.motion(0).map(drop).map_err(|error| error.to_string())
}

/// Groups of matrices accept their elements: elements of a motion, and central elements. Matrices
/// near the group and scaled elements are rejected.
#[test]
fn elements_are_of_the_group() {
    let spaces = [
        ("so(4)", 6),
        ("so(5)", 10),
        ("so(2,1)", 3),
        ("su(2)", 3),
        ("su(3)", 8),
        ("sp(4)", 10),
        ("sl(3)", 8),
        ("gl(2)", 4),
        ("aff(1)", 2),
        ("se(4)", 10),
        ("so3+sl2", 6),
    ];
    for (space, dimension) in spaces {
        // first with an element of the size 1, and then far along a motion
        for (end, every) in [(0.0, 1.0), (20.0, 1.0)] {
            let velocity: Vec<f64> = (0..dimension).map(|i| 0.4 - 0.3 * (i % 3) as f64).collect();
            let text = format!(
                "space = \"{space}\"\nmetric = \"identity\"\n[initial]\nvelocity = {velocity:?}\n\
                 [integrator]\ntolerance = 1e-12\n[output]\nend = {end}\nevery = {every}\n\
                 columns = [\"g\"]\n"
            );
            let text =
                if end == 0.0 { text.replace("end = 0\nevery = 1\n", "end = 0.1\n") } else { text };
            let run = Run::new(&Problem::parse("motion.toml", &text).unwrap(), 0);
            let entries = run.names.iter().filter(|name| name.starts_with('g')).count();
            // a matrix, or the column of a sum
            let size = entries.isqrt();
            let shape = if space.contains('+') { (entries, 1) } else { (size, size) };
            for row in &run.rows {
                let element = DMatrix::from_row_slice(shape.0, shape.1, &row[..entries]);
                // unbounded elements lose accuracy
                let inverse = if shape.1 == 1 { None } else { element.clone().try_inverse() };
                if element.norm() * inverse.as_ref().unwrap_or(&element).norm() < 1e5 {
                    let taken = with_element(space, dimension, &element);
                    assert!(taken.is_ok(), "{space}: {taken:?} for {element}");
                    let mut other = element.clone();
                    other[(0, shape.1 - 1)] += 0.1;
                    other[(0, 0)] *= 1.5;
                    let refused = with_element(space, dimension, &other);
                    assert!(
                        space == "gl(2)" || space == "aff(1)" || refused.is_err(),
                        "{space}: {other}"
                    );
                }
            }
        }
    }
    let refused = |space: &str, dimension: usize, rows: &[f64]| {
        let size = rows.len().isqrt();
        let message = with_element(space, dimension, &DMatrix::from_row_slice(size, size, rows));
        let message = message.expect_err(space);
        assert!(message.contains("invalid element of the group"), "{space}: {message}");
    };
    let diagonal = |entries: &[f64]| -> Vec<f64> {
        DMatrix::from_diagonal(&nalgebra::DVector::from_column_slice(entries)).as_slice().to_vec()
    };
    refused("so(4)", 6, &diagonal(&[2.0, 1.0, 1.0, 1.0]));
    refused("so(4)", 6, &diagonal(&[2.0; 4]));
    refused("so(4)", 6, &diagonal(&[-1.0, 1.0, 1.0, 1.0]));
    refused("so(4)", 6, &diagonal(&[0.0; 4]));
    refused("sl(3)", 8, &diagonal(&[-2.0, -1.0, 1.0]));
    refused("gl(2)", 4, &diagonal(&[-1.0, 1.0]));
    refused("aff(1)", 2, &[2.0, 0.3, 0.6, 2.0]);
    refused("sp(4)", 10, &diagonal(&[2.0; 4]));
    // central elements, half turns, and elements without a logarithm
    let taken = |space: &str, dimension: usize, entries: &[f64]| {
        let size = entries.len().isqrt();
        let element = DMatrix::from_row_slice(size, size, entries);
        let taken = with_element(space, dimension, &element);
        assert!(taken.is_ok(), "{space}: {taken:?}");
    };
    taken("so(4)", 6, &diagonal(&[-1.0; 4]));
    taken("so(4)", 6, &diagonal(&[-1.0, -1.0, 1.0, 1.0]));
    taken("sl(3)", 8, &diagonal(&[-2.0, -0.5, 1.0]));
    taken("gl(2)", 4, &[-1.0, 1.0, 0.0, -1.0]);
    let (third, half) = (-0.5, 0.75_f64.sqrt());
    let mut centre = DMatrix::identity(6, 6) * third;
    for i in 0..3 {
        centre[(i, i + 3)] = -half;
        centre[(i + 3, i)] = half;
    }
    taken("su(3)", 8, centre.as_slice());
}
