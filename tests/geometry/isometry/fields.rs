//! Symmetry fields in the functions of a chart: as many as the dimension where they are known in
//! closed form, and inserted into their equation.

use super::{KERR, OnChart, TAUB_NUT, spacetimes, spherical};
use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
use affinor::{Chart, Metric, Symbolic, Tensor};
use affinor_tensors::{Notation, Ring};
use num_traits::Zero;

fn fields(space: &OnChart, symmetry: Symmetry) -> (IsometryAlgebra, Vec<Tensor<Symbolic>>) {
    let chart = Chart::new(&space.coordinates).unwrap();
    let frame = chart.fields(chart.labels(), Tensor::identity(chart.dimension())).unwrap();
    let metric = Metric::new(chart.labels(), space.tensor()).unwrap();
    IsometryAlgebra::with_fields(&frame, &metric, symmetry).unwrap()
}

/// `L_K g`, by the definition in coordinates.
fn lie_derivative(space: &OnChart, field: &Tensor<Symbolic>, i: usize, j: usize) -> Symbolic {
    let g = space.tensor();
    let d = |value: &Symbolic, at: usize| Notation::derivative(value, &space.coordinates[at]);
    (0..space.coordinates.len()).fold(Symbolic::zero(), |sum, m| {
        let k = field.get(&[m]);
        sum + &(d(&g.get(&[i, j]), m) * &k)
            + &(g.get(&[m, j]) * &d(&k, i))
            + &(g.get(&[i, m]) * &d(&k, j))
    })
}

/// Checks that the fields satisfy `L_K g = 2 phi g` with the kind of `phi` that the symmetry allows,
/// and that they are independent over the numbers.
fn check(name: &str, space: &OnChart, symmetry: Symmetry, found: &[Tensor<Symbolic>]) {
    let g = space.tensor();
    let n = space.coordinates.len();
    for field in found {
        let (at, first) = g.components().next().unwrap();
        let ratio = lie_derivative(space, field, at[0], at[1]) / first;
        match symmetry {
            Symmetry::Killing => assert!(ratio.vanishes(), "{name}: {field:?}"),
            Symmetry::Homothetic => {
                let d = |x: &String| Notation::derivative(&ratio, x).vanishes();
                assert!(space.coordinates.iter().all(d), "{name}");
            }
            Symmetry::Conformal => {}
        }
        for i in 0..n {
            for j in 0..n {
                let left = lie_derivative(space, field, i, j);
                assert_eq!(left, g.get(&[i, j]) * &ratio, "{name}: {field:?}");
            }
        }
    }
    if found.is_empty() {
        return;
    }
    // the values at some points on a curve, where other letters have one value
    let points = [0.31, 0.42, 0.55, 0.67, 0.83_f64];
    let row = |field: &Tensor<Symbolic>| {
        let at = |point: f64| {
            let lookup = |letter: &str| {
                let place = space.coordinates.iter().position(|x| x == letter);
                Some(place.map_or(0.37, |k| point.powf((k + 1) as f64 / (k + 2) as f64)))
            };
            (0..n).map(move |i| field.get(&[i]).evaluate(lookup).unwrap()).collect::<Vec<_>>()
        };
        points.iter().flat_map(|point| at(*point)).collect::<Vec<_>>()
    };
    let rows: Vec<f64> = found.iter().flat_map(row).collect();
    let matrix = nalgebra::DMatrix::from_row_slice(found.len(), points.len() * n, &rows);
    assert_eq!(matrix.rank(1e-9), found.len(), "{name}: dependent fields");
}

/// The spaces of which all Killing fields are found.
#[test]
fn killing_fields_are_found() {
    let sphere = OnChart::new("theta phi", &[("theta", "1"), ("phi", "sin(theta)^2")]);
    let half_plane = OnChart::new("x y", &[("x", "1/y^2"), ("y", "1/y^2")]);
    let disk = OnChart::new("x y", &[("x", "4/(1 - x^2 - y^2)^2"), ("y", "4/(1 - x^2 - y^2)^2")]);
    let polar = OnChart::new("r phi", &[("r", "1"), ("phi", "r^2")]);
    let half_space = OnChart::new("x y z", &[("x", "1/z^2"), ("y", "1/z^2"), ("z", "1/z^2")]);
    let three = OnChart::new("x y z", &[("x", "1"), ("y", "sin(x)^2"), ("z", "sin(x)^2*sin(y)^2")]);
    let spherical_flat = spherical("1");
    let cases = [
        ("sphere", sphere, 3),
        ("half-plane", half_plane, 3),
        ("disk", disk, 3),
        ("polar", polar, 3),
        ("half-space", half_space, 6),
        ("S^3", three, 6),
        ("Schwarzschild", spherical("1 - 2*M/r"), 4),
        ("Kerr", OnChart::new("t r theta phi", KERR), 2),
        ("Taub-NUT", OnChart::new("t r theta phi", TAUB_NUT), 4),
        ("Minkowski, spherical", spherical_flat, 10),
        // the boosts contain the root of g_tt and exponentials of H t, or sines of t/L
        ("de Sitter, static", spherical("1 - H^2*r^2"), 10),
        ("anti-de Sitter, static", spherical("1 + r^2/L^2"), 10),
    ];
    for (name, space, dimension) in cases {
        let (algebra, found) = fields(&space, Symmetry::Killing);
        check(name, &space, Symmetry::Killing, &found);
        assert_eq!((algebra.dimension(), found.len()), (dimension, dimension), "{name}: {found:?}");
    }
}

/// The fields of these spacetimes satisfy their equations, and are complete.
#[test]
fn spacetimes_have_their_fields() {
    let complete = [
        "Minkowski",
        "de Sitter",
        "anti-de Sitter",
        "Schwarzschild",
        "Kasner",
        "Goedel",
        "flat Friedmann",
        "homogeneous plane wave",
        "pp-wave",
        "Bertotti-Robinson",
        "diagonal without symmetry",
    ];
    for (name, space, [killing, homothetic, _], _) in spacetimes() {
        if !complete.contains(&name) {
            continue;
        }
        let (_, found) = fields(&space, Symmetry::Killing);
        check(name, &space, Symmetry::Killing, &found);
        assert_eq!(found.len(), killing, "{name}: {found:?}");
        if ["Minkowski", "Kasner", "homogeneous plane wave", "Schwarzschild"].contains(&name) {
            let (_, found) = fields(&space, Symmetry::Homothetic);
            check(name, &space, Symmetry::Homothetic, &found);
            assert_eq!(found.len(), homothetic, "{name}: {found:?}");
        }
    }
}

#[test]
fn conformal_fields_are_found() {
    let minkowski = OnChart::new("t x y z", &[("t", "-1"), ("x", "1"), ("y", "1"), ("z", "1")]);
    let half_space = OnChart::new("x y z", &[("x", "1/z^2"), ("y", "1/z^2"), ("z", "1/z^2")]);
    for (name, space, dimension) in [("Minkowski", minkowski, 15), ("half-space", half_space, 10)] {
        let (_, found) = fields(&space, Symmetry::Conformal);
        check(name, &space, Symmetry::Conformal, &found);
        assert_eq!(found.len(), dimension, "{name}: {found:?}");
    }
}
