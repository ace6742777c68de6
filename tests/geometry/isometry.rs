//! Isometry algebras of metrics on charts: published dimensions and names, other coordinates, and the
//! Killing equation solved by polynomials.

mod conformal;
mod fields;
mod jets;

use affinor::geometry::isometry::{Certainty, IsometryAlgebra, Symmetry};
use affinor::{Chart, Down, Error, Metric, Rational, Symbolic, Tensor, Up};
use affinor_tensors::linear::{Echelon, Matrix, Row};
use affinor_tensors::{Notation, Ring};
use num_traits::Zero;
use std::collections::BTreeMap;

/// A metric on a chart by its components, `("t", value)` for `g(d_t, d_t)` and `("t x", value)` for
/// `g(d_t, d_x)`.
#[derive(Clone)]
struct OnChart {
    coordinates: Vec<String>,
    components: Vec<([usize; 2], Symbolic)>,
}

type Components<'a> = &'a [(&'a str, &'a str)];

fn value(text: &str) -> Symbolic {
    text.parse().unwrap()
}

impl OnChart {
    fn new(coordinates: &str, components: Components) -> Self {
        let coordinates: Vec<String> = coordinates.split_whitespace().map(String::from).collect();
        let at = |name: &str| coordinates.iter().position(|c| c == name).unwrap();
        let entry = |(place, text): &(&str, &str)| {
            let (x, y) = place.split_once(' ').unwrap_or((place, place));
            ([at(x), at(y)], value(text))
        };
        let upper: Vec<_> = components.iter().map(entry).collect();
        OnChart { coordinates, components: both(upper) }
    }

    fn tensor(&self) -> Tensor<Symbolic> {
        let entries = self.components.iter().cloned();
        Tensor::from_components(self.coordinates.len(), &[Down, Down], entries).unwrap()
    }

    fn symmetries(&self, symmetry: Symmetry) -> Result<IsometryAlgebra, Error> {
        let chart = Chart::new(&self.coordinates)?;
        let fields = chart.fields(chart.labels(), Tensor::identity(chart.dimension()))?;
        IsometryAlgebra::on_chart(&fields, &Metric::new(chart.labels(), self.tensor())?, symmetry)
    }

    fn isometries(&self) -> IsometryAlgebra {
        self.symmetries(Symmetry::Killing).unwrap()
    }

    /// The metric in new coordinates with the same names, where `old` are the old coordinates as
    /// functions of the new ones.
    fn pulled_back(&self, old: &[Symbolic]) -> Self {
        let n = old.len();
        let values = self.coordinates.iter().cloned().zip(old.iter().cloned()).collect();
        let slope = |i: usize, a: usize| Notation::derivative(&old[i], &self.coordinates[a]);
        let mut components: BTreeMap<[usize; 2], Symbolic> = BTreeMap::new();
        for ([i, j], value) in &self.components {
            let moved = value.substitute(&values).unwrap();
            for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
                let term = moved.clone() * &slope(*i, a) * &slope(*j, b);
                *components.entry([a, b]).or_insert_with(Symbolic::zero) += &term;
            }
        }
        OnChart { components: components.into_iter().collect(), ..self.clone() }
    }
}

fn both(upper: Vec<([usize; 2], Symbolic)>) -> Vec<([usize; 2], Symbolic)> {
    let mirrored: Vec<_> = upper
        .iter()
        .filter(|([i, j], _)| i != j)
        .map(|([i, j], v)| ([*j, *i], v.clone()))
        .collect();
    upper.into_iter().chain(mirrored).collect()
}

/// `-f dt^2 + dr^2/f + r^2 (dtheta^2 + sin(theta)^2 dphi^2)`.
fn spherical(f: &str) -> OnChart {
    let (lapse, radial) = (format!("-({f})"), format!("1/({f})"));
    let components =
        [("t", &*lapse), ("r", &*radial), ("theta", "r^2"), ("phi", "r^2*sin(theta)^2")];
    OnChart::new("t r theta phi", &components)
}

const KERR: Components = &[
    ("t", "-(1 - 2*M*r/(r^2 + a^2*cos(theta)^2))"),
    ("t phi", "-2*M*a*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2)"),
    ("r", "(r^2 + a^2*cos(theta)^2)/(r^2 - 2*M*r + a^2)"),
    ("theta", "r^2 + a^2*cos(theta)^2"),
    ("phi", "(r^2 + a^2 + 2*M*a^2*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2))*sin(theta)^2"),
];

const TAUB_NUT: Components = &[
    ("t", "-(r^2 - 2*M*r - n^2)/(r^2 + n^2)"),
    ("t phi", "-2*n*cos(theta)*(r^2 - 2*M*r - n^2)/(r^2 + n^2)"),
    ("r", "(r^2 + n^2)/(r^2 - 2*M*r - n^2)"),
    ("theta", "r^2 + n^2"),
    ("phi", "(r^2 + n^2)*sin(theta)^2 - 4*n^2*cos(theta)^2*(r^2 - 2*M*r - n^2)/(r^2 + n^2)"),
];

/// A space with the published dimensions of its isometry and homothety algebras, of the isotropy, and
/// the name of the isometry algebra; an empty name is not tested.
type Published = (&'static str, OnChart, [usize; 3], &'static str);

/// Dimensions and groups: H. Stephani, D. Kramer, M. MacCallum, C. Hoenselaers, E. Herlt, *Exact
/// Solutions of Einstein's Field Equations* (2003), chapters 8 and 11 to 24.
fn spacetimes() -> Vec<Published> {
    let flat = ["t", "x", "y", "z"];
    let expanding = |a: &str| {
        let squared = format!("({a})^2");
        OnChart::new(
            "t x y z",
            &[(flat[0], "-1"), (flat[1], &squared), (flat[2], &squared), (flat[3], &squared)],
        )
    };
    let closed = |radial: &str, a: &str| {
        let components = [
            ("t", "-1".to_string()),
            ("x", a.to_string()),
            ("y", format!("{a}*{radial}^2")),
            ("z", format!("{a}*{radial}^2*sin(y)^2")),
        ];
        let components: Vec<_> = components.iter().map(|(at, v)| (*at, v.as_str())).collect();
        OnChart::new("t x y z", &components)
    };
    let wave = |profile: &str| {
        OnChart::new("u v x y", &[("u v", "1"), ("u", profile), ("x", "1"), ("y", "1")])
    };
    vec![
        ("Minkowski", expanding("1"), [10, 11, 6], "iso(3,1)"),
        ("de Sitter", expanding("exp(t)"), [10, 10, 6], "so(4,1)"),
        (
            "anti-de Sitter",
            OnChart::new(
                "t x y z",
                &[("t", "-1/z^2"), ("x", "1/z^2"), ("y", "1/z^2"), ("z", "1/z^2")],
            ),
            [10, 10, 6],
            "so(3,2)",
        ),
        ("Schwarzschild", spherical("1 - 2*M/r"), [4, 4, 1], "so(3) + R^1"),
        ("Reissner-Nordstroem", spherical("1 - 2*M/r + q^2/r^2"), [4, 4, 1], "so(3) + R^1"),
        ("Kerr", OnChart::new("t r theta phi", KERR), [2, 2, 0], "R^2"),
        ("Taub-NUT", OnChart::new("t r theta phi", TAUB_NUT), [4, 4, 1], "so(3) + R^1"),
        // t = s^7 in the exponents -2/7, 3/7, 6/7
        (
            "Kasner",
            OnChart::new(
                "s x y z",
                &[("s", "-49*s^12"), ("x", "s^-4"), ("y", "s^6"), ("z", "s^12")],
            ),
            [3, 4, 0],
            "R^3",
        ),
        // t = s^3 in the exponents -1/3, 2/3, 2/3
        (
            "axisymmetric Kasner",
            OnChart::new("s x y z", &[("s", "-9*s^4"), ("x", "s^-2"), ("y", "s^4"), ("z", "s^4")]),
            [4, 5, 1],
            "se(2) + R^1",
        ),
        (
            "Goedel",
            OnChart::new(
                "t x y z",
                &[("t", "-1"), ("t y", "-exp(x)"), ("x", "1"), ("y", "-exp(2*x)/2"), ("z", "1")],
            ),
            [5, 5, 1],
            "sl(2,R) + R^2",
        ),
        ("flat Friedmann", expanding("a(t)"), [6, 6, 3], "se(3)"),
        (
            "flat Friedmann with dust, t = s^3",
            OnChart::new("t x y z", &[("t", "-9*t^4"), ("x", "t^4"), ("y", "t^4"), ("z", "t^4")]),
            [6, 7, 3],
            "se(3)",
        ),
        ("closed Friedmann", closed("sin(x)", "a(t)^2"), [6, 6, 3], "so(3) + so(3)"),
        ("open Friedmann", closed("sinh(x)", "a(t)^2"), [6, 6, 3], "so(3,1)"),
        ("Einstein static", closed("sin(x)", "1"), [7, 7, 3], "so(3) + so(3) + R^1"),
        ("vacuum plane wave", wave("f(u)*(x^2 - y^2)"), [5, 6, 2], "heisenberg(5)"),
        ("homogeneous plane wave", wave("x^2 - y^2"), [6, 7, 2], ""),
        ("conformally flat plane wave", wave("f(u)*(x^2 + y^2)"), [6, 7, 3], ""),
        ("electromagnetic plane wave", wave("x^2 + y^2"), [7, 8, 3], ""),
        ("pp-wave", wave("h(u,x,y)"), [1, 1, 0], "R^1"),
        (
            "Nariai",
            OnChart::new(
                "t x theta phi",
                &[("t", "-1"), ("x", "cosh(t)^2"), ("theta", "1"), ("phi", "sin(theta)^2")],
            ),
            [6, 6, 2],
            "so(3) + sl(2,R)",
        ),
        (
            "Bertotti-Robinson",
            OnChart::new(
                "t x theta phi",
                &[("t", "-1/x^2"), ("x", "1/x^2"), ("theta", "1"), ("phi", "sin(theta)^2")],
            ),
            [6, 6, 2],
            "so(3) + sl(2,R)",
        ),
        (
            "Kantowski-Sachs",
            OnChart::new(
                "t x theta phi",
                &[
                    ("t", "-1"),
                    ("x", "a(t)^2"),
                    ("theta", "b(t)^2"),
                    ("phi", "b(t)^2*sin(theta)^2"),
                ],
            ),
            [4, 4, 1],
            "so(3) + R^1",
        ),
        (
            "Vaidya",
            OnChart::new(
                "u r theta phi",
                &[
                    ("u", "-(1 - 2*m(u)/r)"),
                    ("u r", "-1"),
                    ("theta", "r^2"),
                    ("phi", "r^2*sin(theta)^2"),
                ],
            ),
            [3, 3, 1],
            "so(3)",
        ),
        (
            "diagonal, static and axisymmetric",
            OnChart::new(
                "t r z phi",
                &[("t", "-k(r,z)"), ("r", "h(r,z)"), ("z", "h(r,z)"), ("phi", "r^2/k(r,z)")],
            ),
            [2, 2, 0],
            "R^2",
        ),
        (
            "diagonal without symmetry",
            OnChart::new(
                "t x y z",
                &[("t", "-1 - x*y"), ("x", "1 + z^2"), ("y", "2 + t*x"), ("z", "3 + y^2*t")],
            ),
            [0, 0, 0],
            "0",
        ),
        (
            "BTZ",
            OnChart::new(
                "t r phi",
                &[
                    ("t", "M - r^2"),
                    ("t phi", "-j/2"),
                    ("r", "1/(-M + r^2 + j^2/(4*r^2))"),
                    ("phi", "r^2"),
                ],
            ),
            [6, 6, 3],
            "sl(2,R) + sl(2,R)",
        ),
    ]
}

#[test]
fn spacetimes_have_their_published_symmetries() {
    for (name, space, [killing, homothetic, isotropy], algebra) in spacetimes() {
        let found = space.isometries();
        assert_eq!((found.dimension(), found.isotropy()), (killing, isotropy), "{name}: {found:?}");
        assert_ne!(found.certainty(), Certainty::UpperBound, "{name}");
        assert_eq!(found.signature(), [found.space() - 1, 1], "{name}");
        assert_eq!(found.is_transitive(), found.orbit() == found.space());
        if !algebra.is_empty() {
            let mut parts: Vec<_> = algebra.split(" + ").collect();
            let found = found.name().unwrap_or_default();
            let mut own: Vec<_> = found.split(" + ").collect();
            parts.sort_unstable();
            own.sort_unstable();
            assert_eq!(own, parts, "{name}");
        }
        let scaled = space.symmetries(Symmetry::Homothetic).unwrap();
        assert_eq!(scaled.dimension(), homothetic, "{name}: {scaled:?}");
    }
}

/// Spaces of constant curvature in `n` dimensions, surfaces, and the complex projective plane.
#[test]
fn riemannian_spaces_have_their_published_isometries() {
    let sphere = |n: usize| {
        let names = ["x1", "x2", "x3", "x4", "x5"];
        let mut components = vec![];
        for at in 0..n {
            let factors: Vec<_> = names[..at].iter().map(|x| format!("sin({x})^2")).collect();
            components.push((names[at], if at == 0 { "1".into() } else { factors.join("*") }));
        }
        let components: Vec<_> =
            components.iter().map(|(x, v): &(&str, String)| (*x, v.as_str())).collect();
        OnChart::new(&names[..n].join(" "), &components)
    };
    let names = ["so(3)", "so(3) + so(3)", "so(5)", "su(4)"];
    for (n, name) in (2..=5).zip(names) {
        let found = sphere(n).isometries();
        assert_eq!(found.dimension(), n * (n + 1) / 2);
        let own = found.name().unwrap_or_default();
        let expected = name.split('(').next().unwrap();
        assert!(own.starts_with(expected) || own == "so(6)" || own == "sp(4)", "S^{n}: {own}");
    }
    let spaces = [
        ("surface of revolution", OnChart::new("x y", &[("x", "1"), ("y", "f(x)^2")]), 1),
        ("torus", OnChart::new("x y", &[("x", "1"), ("y", "(3 + cos(x))^2")]), 1),
        ("cone", OnChart::new("x y", &[("x", "1"), ("y", "x^2/4")]), 3),
        ("hyperbolic plane", OnChart::new("x y", &[("x", "1/y^2"), ("y", "1/y^2")]), 3),
        ("flat, isothermal", OnChart::new("x y", &[("x", "exp(x*y)"), ("y", "exp(x*y)")]), 3),
        ("isothermal", OnChart::new("x y", &[("x", "exp(x*y^2)"), ("y", "exp(x*y^2)")]), 0),
        ("H^2 x R", OnChart::new("x y z", &[("x", "1/y^2"), ("y", "1/y^2"), ("z", "1")]), 4),
        ("Sol", OnChart::new("x y z", &[("x", "exp(2*z)"), ("y", "exp(-2*z)"), ("z", "1")]), 3),
        (
            "Nil",
            OnChart::new("x y z", &[("x", "1"), ("y", "1 + x^2"), ("y z", "-x"), ("z", "1")]),
            4,
        ),
    ];
    for (name, space, dimension) in spaces {
        let found = space.isometries();
        assert_eq!(found.dimension(), dimension, "{name}: {found:?}");
        assert_eq!(found.signature(), [found.space(), 0], "{name}");
    }
}

/// The dimension is proved where all fields are translations of ignorable coordinates.
#[test]
fn translations_of_ignorable_coordinates_are_a_proof() {
    assert_eq!(OnChart::new("t r theta phi", KERR).isometries().certainty(), Certainty::Proved);
    assert_eq!(spherical("1 - 2*M/r").isometries().certainty(), Certainty::Generic);
}

/// Dimension, orbits and name are the same in other coordinates.
#[test]
fn symmetries_do_not_depend_on_the_coordinates() {
    let spaces = [
        OnChart::new("x y", &[("x", "1/y^2"), ("y", "1/y^2")]),
        OnChart::new("x y", &[("x", "1"), ("y", "1 + x^2")]),
        OnChart::new("x y z", &[("x", "1/y^2"), ("y", "1/y^2"), ("z", "-1")]),
        OnChart::new("x y z", &[("x", "1"), ("y", "1 + x^2"), ("y z", "-x"), ("z", "1")]),
        OnChart::new("x y z", &[("x", "z^2"), ("y", "z^4"), ("z", "-z")]),
    ];
    let changes = [
        ["x + y^2/3", "y*(1 + x)", "z + x/2"],
        ["2*x/(1 + y)", "x + y", "z*(2 + y)"],
        ["x*y", "y + z^2", "z/(1 + x)"],
    ];
    for space in spaces {
        let n = space.coordinates.len();
        let known = space.isometries();
        for change in &changes {
            let text = |text: &&str| {
                value(&if n == 2 { text.replace('z', "x") } else { text.to_string() })
            };
            let old: Vec<Symbolic> = change.iter().take(n).map(text).collect();
            let found = space.pulled_back(&old).isometries();
            assert_eq!(found.dimension(), known.dimension(), "{change:?}");
            assert_eq!(found.isotropy(), known.isotropy(), "{change:?}");
            assert_eq!(found.name(), known.name(), "{change:?}");
        }
    }
}

/// The dimension of the 1-jets of polynomial fields of degree `degree` that satisfy the Killing
/// equation up to terms of degree `degree`, at the point where all coordinates are `shift`.
fn by_polynomials(space: &OnChart, degree: u32, shift: i64) -> usize {
    let n = space.coordinates.len();
    let moved = |name: &String| (name.clone(), Symbolic::parameter(name) + &Symbolic::from(shift));
    let shifted = space.coordinates.iter().map(moved).collect();
    let exponents = |terms: &[(affinor_tensors::scalar::Variable, u32)]| {
        let of =
            |name: &String| terms.iter().find(|(v, _)| v.text() == name).map_or(0, |(_, e)| *e);
        space.coordinates.iter().map(of).collect::<Vec<u32>>()
    };
    let polynomial = |value: &Symbolic| {
        let terms = value.substitute(&shifted).unwrap().terms();
        terms.into_iter().map(|(powers, c)| (exponents(&powers), c)).collect::<Vec<_>>()
    };
    let g: BTreeMap<[usize; 2], _> =
        space.components.iter().map(|(at, value)| (*at, polynomial(value))).collect();
    let monomials: Vec<Vec<u32>> = (0..(degree + 1).pow(n as u32))
        .map(|code| (0..n).map(|k| code / (degree + 1).pow(k as u32) % (degree + 1)).collect())
        .filter(|e: &Vec<u32>| e.iter().sum::<u32>() <= degree)
        .collect();
    let unknown = |i: usize, e: usize| i * monomials.len() + e;
    // rows by the component (i, j) and the monomial of the equation
    let mut rows: BTreeMap<(usize, usize, Vec<u32>), Row<Rational>> = BTreeMap::new();
    let mut add = |i: usize, j: usize, e: Vec<u32>, column: usize, c: Rational| {
        if e.iter().sum::<u32>() < degree && i <= j && !c.vanishes() {
            rows.entry((i, j, e)).or_default().push((column, c));
        }
    };
    let sum = |a: &[u32], b: &[u32]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<u32>>();
    let lowered = |e: &[u32], k: usize| {
        let mut lower = e.to_vec();
        lower[k] = lower[k].checked_sub(1)?;
        Some((lower, Rational::from(i64::from(e[k]))))
    };
    for (at, terms) in &g {
        let [a, b] = *at;
        for (e, c) in terms {
            for (place, monomial) in monomials.iter().enumerate() {
                for m in 0..n {
                    // K^m d_m g_ab
                    if let Some((lower, factor)) = lowered(e, m) {
                        let total = sum(&lower, monomial);
                        add(a, b, total, unknown(m, place), c.clone() * &factor);
                    }
                    // g_ab d_m K^a in the components (m, b) and (b, m)
                    if let Some((lower, factor)) = lowered(monomial, m) {
                        let total = sum(e, &lower);
                        let value = c.clone() * &factor;
                        add(m, b, total.clone(), unknown(a, place), value.clone());
                        add(b, m, total, unknown(a, place), value);
                    }
                }
            }
        }
    }
    let columns = n * monomials.len();
    let kernel = Matrix::from_rows(columns, rows.into_values()).unwrap().nullspace().unwrap();
    let low = |e: &Vec<u32>| e.iter().sum::<u32>() <= 1;
    let mut span = Echelon::new();
    for row in 0..kernel.rows() {
        let jet = kernel.row(row).iter().filter(|(at, _)| low(&monomials[at % monomials.len()]));
        span.insert(jet.cloned()).unwrap();
    }
    span.rank()
}

/// The jets agree with the Killing equation for polynomials, on polynomial metrics.
#[test]
fn polynomial_fields_give_the_same_dimension() {
    let spaces = [
        OnChart::new("x y", &[("x", "1"), ("y", "1")]),
        OnChart::new("x y", &[("x", "1 + y^2"), ("y", "1")]),
        OnChart::new("x y", &[("x", "x + y^3"), ("y", "1 + x*y")]),
        OnChart::new("x y", &[("x", "4*x^2 + 4*y^2"), ("y", "4*x^2 + 4*y^2")]),
        OnChart::new("x y", &[("x", "x^2 + y^2 + 1"), ("y", "x^2 + y^2 + 1")]),
        OnChart::new("x y z", &[("x", "1"), ("y", "1 + x^2"), ("y z", "-x"), ("z", "1")]),
        OnChart::new("x y z", &[("x", "1"), ("y", "x^2"), ("z", "-1")]),
        OnChart::new("x y z", &[("x", "z"), ("y", "z"), ("z", "1")]),
        OnChart::new("x y z", &[("x", "z"), ("y", "z^2"), ("z", "1")]),
        OnChart::new("x y z", &[("x", "1"), ("y", "1"), ("x z", "y"), ("z", "-2")]),
        OnChart::new("x y z", &[("x y", "1"), ("z", "1"), ("x", "z^2")]),
        OnChart::new("x y z", &[("x y", "1"), ("z", "1"), ("x", "z^3 + x")]),
    ];
    for space in spaces {
        let degree = if space.coordinates.len() == 2 { 7 } else { 6 };
        let polynomial = by_polynomials(&space, degree, 2);
        assert_eq!(space.isometries().dimension(), polynomial, "{:?}", space.components);
    }
}

/// A metric whose root is irrational everywhere, and one whose root is rational at some points.
#[test]
fn roots_must_be_rational_at_the_point() {
    let error =
        OnChart::new("x y", &[("x", "1"), ("y", "sqrt(3)*x")]).symmetries(Symmetry::Killing);
    assert!(matches!(error, Err(Error::Unsupported(text)) if text.contains("irrational")));
    let frame = Tensor::from_components(
        2,
        &[Up, Down],
        [([0, 0], value("sqrt(1 - k*x)")), ([1, 1], value("1/x"))],
    );
    let chart = Chart::new(["x", "y"]).unwrap();
    let fields = chart.fields(["e1", "e2"], frame.unwrap()).unwrap();
    let metric = Metric::identity(2).unwrap();
    let found = IsometryAlgebra::on_chart(&fields, &metric, Symmetry::Killing).unwrap();
    // dx^2/(1 - k x) + x^2 dy^2 has the curvature k/2 of a sphere divided by x, which varies
    assert_eq!(found.dimension(), 1);
}
