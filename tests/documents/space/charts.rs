//! The charts of the catalogue: published curvature and isometry groups, and their names.

use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
use affinor::geometry::petrov::PetrovType;
use affinor_documents::input::InputError;
use affinor_documents::report::{Computation, Format, Statements, catalogue_where};
use affinor_documents::space::{NamedChart, Request, Space, typed};
use affinor_tensors::{Symbolic, Tolerance};
use std::collections::BTreeSet;

fn open(space: &str) -> Result<Space, InputError> {
    Space::open(&Request { space: Some(space.into()), ..Request::default() })
}

/// Published properties of a chart: the name, the dimension of the isometry group, the algebra of this group, and claims.
/// The dimension is `None` without a metric, and where no sample point is rational. An empty name is not compared.
type Published = (&'static str, Option<usize>, &'static str, &'static [&'static str]);

/// Curvature and groups: H. Stephani and others, *Exact Solutions of Einstein's Field Equations* (2003), chapters 8 and 11
/// to 24; J. B. Griffiths and J. Podolsky, *Exact Space-Times in Einstein's General Relativity* (2009), chapters 3 to 17.
/// Surfaces (`S = 2 K`): M. P. do Carmo, *Differential Geometry of Curves and Surfaces* (1976), sections 3.3, 3.5 and 5.10.
const PUBLISHED: &[Published] = &[
    ("minkowski", Some(10), "iso(3,1)", &["flat"]),
    ("rindler", Some(10), "iso(3,1)", &["flat"]),
    ("milne", Some(10), "iso(3,1)", &["flat"]),
    ("de-sitter", Some(10), "so(4,1)", &["Ric_jl = 3*H^2*g_jl", "constant curvature"]),
    ("de-sitter-static", Some(10), "so(4,1)", &["S = 12*H^2", "constant curvature"]),
    ("anti-de-sitter", Some(10), "so(3,2)", &["S = -12/L^2", "constant curvature"]),
    ("anti-de-sitter-static", Some(10), "so(3,2)", &["S = -12/L^2", "constant curvature"]),
    ("einstein-static", Some(7), "so(3) + so(3) + R^1", &["S = 6/R^2", "locally symmetric"]),
    ("friedmann", Some(6), "", &["S = 6*(a(t)*a_t_t(t) + a_t(t)^2 + k)/a(t)^2", "Weyl = 0"]),
    // for the density rho, S = 8 pi rho, and 6 pi rho t^2 = 1
    ("friedmann-dust", Some(6), "se(3)", &["S = 4/(3*t^2)", "Weyl = 0"]),
    ("schwarzschild", Some(4), "so(3) + R^1", &["Ric = 0", "Kr = 48*M^2/r^6"]),
    ("schwarzschild-isotropic", Some(4), "so(3) + R^1", &["Ric = 0"]),
    ("schwarzschild-observers", Some(4), "so(3) + R^1", &["Ric = 0", "Kr = 48*M^2/r^6"]),
    ("eddington-finkelstein", Some(4), "so(3) + R^1", &["Ric = 0", "Kr = 48*M^2/r^6"]),
    ("painleve-gullstrand", Some(4), "so(3) + R^1", &["Ric = 0", "Kr = 12*rs^2/r^6"]),
    ("lemaitre-tolman", Some(3), "so(3)", &["Ric_12 = 0"]),
    (
        "schwarzschild-de-sitter",
        Some(4),
        "so(3) + R^1",
        &["Ric_jl = 3*H^2*g_jl", "Kr = 48*M^2/r^6 + 24*H^4"],
    ),
    (
        "reissner-nordstrom",
        Some(4),
        "so(3) + R^1",
        &["S = 0", "Kr = 48*M^2/r^6 - 96*M*Q^2/r^7 + 56*Q^4/r^8"],
    ),
    ("bardeen", Some(4), "so(3) + R^1", &["S = 6*M*q^2*(4*q^2 - r^2)/sqrt(r^2 + q^2)^7"]),
    // the limit r -> 0 is de Sitter's spacetime of radius l
    ("hayward", Some(4), "so(3) + R^1", &["S = 24*M^2*l^2*(4*M*l^2 - r^3)/(r^3 + 2*M*l^2)^3"]),
    ("vaidya", Some(3), "so(3)", &["Ric_11 = -2*m_u(u)/r^2", "S = 0", "Kr = 48*m(u)^2/r^6"]),
    (
        "kerr",
        Some(2),
        "R^2",
        &[
            "Ric = 0",
            "Kr = 48*M^2*(r^2 - a^2*cos(theta)^2)*((r^2 + a^2*cos(theta)^2)^2 \
             - 16*r^2*a^2*cos(theta)^2)/(r^2 + a^2*cos(theta)^2)^6",
        ],
    ),
    ("kerr-newman", Some(2), "R^2", &["S = 0", "Ric != 0"]),
    ("taub-nut", Some(4), "so(3) + R^1", &["Ric = 0"]),
    ("kasner", Some(3), "R^3", &["Ric_11 = -2*(p^2 + p*q + q^2 - p - q)"]),
    ("bianchi-i", Some(3), "R^3", &["not flat"]),
    ("kantowski-sachs", Some(4), "so(3) + R^1", &["not flat"]),
    ("goedel", Some(5), "sl(2,R) + R^2", &["S = -1/a^2", "not locally symmetric"]),
    ("bertotti-robinson", Some(6), "so(3) + sl(2,R)", &["S = 0", "locally symmetric"]),
    ("nariai", Some(6), "so(3) + sl(2,R)", &["Ric_jl = g_jl/b^2", "locally symmetric"]),
    ("pp-wave", Some(1), "R^1", &["Ric_11 = -(H_x_x(u,x,y) + H_y_y(u,x,y))/2", "S = 0", "Kr = 0"]),
    ("plane-wave", Some(5), "heisenberg(5)", &["Ric = 0", "Kr = 0"]),
    ("cahen-wallach", Some(6), "", &["locally symmetric", "Ric_11 = -p - q"]),
    ("ellis-wormhole", Some(4), "so(3) + R^1", &["S = -2*b^2/(b^2 + l^2)^2"]),
    ("cosmic-string", Some(10), "iso(3,1)", &["flat"]),
    ("melvin", Some(4), "iso(1,1) + R^1", &["S = 0", "Ric != 0"]),
    // dust with 8 pi rho = S
    ("van-stockum", Some(3), "R^3", &["S = 4*a^2*exp(a^2*r^2)"]),
    (
        "levi-civita-cylinder",
        Some(3),
        "R^3",
        &["Ric = 0", "Kr = 64*s^2*(1 - 2*s)^2*(1 - 2*s + 4*s^2)*r^(8*s - 16*s^2 - 4)"],
    ),
    ("curzon-chazy", Some(2), "R^2", &["Ric = 0"]),
    ("weyl", Some(2), "R^2", &["not flat"]),
    ("c-metric", Some(2), "R^2", &["Ric = 0", "Kr = 48*m^2*A^6*(x - y)^6"]),
    ("petrov", None, "", &["Ric = 0", "not flat"]),
    ("btz", Some(6), "sl(2,R) + sl(2,R)", &["S = -6/L^2", "constant curvature"]),
    ("tangherlini", Some(7), "so(3) + so(3) + R^1", &["Ric = 0", "Kr = 72*mu^2/r^8"]),
    ("eguchi-hanson", Some(4), "so(3) + R^1", &["Ric = 0", "Kr = 384*a^8/r^12"]),
    ("sphere", Some(3), "so(3)", &["S = 2/R^2"]),
    ("ellipsoid", Some(1), "R^1", &["S = 2*c^2/(a^2*cos(theta)^2 + c^2*sin(theta)^2)^2"]),
    ("torus", Some(1), "R^1", &["S = 2*cos(theta)/(r*(R + r*cos(theta)))"]),
    ("cylinder", Some(3), "", &["flat"]),
    ("cone", Some(3), "", &["flat"]),
    ("catenoid", Some(1), "R^1", &["S = -2/(c^2*cosh(v)^4)"]),
    ("helicoid", Some(1), "R^1", &["S = -2*c^2/(u^2 + c^2)^2"]),
    ("enneper", Some(1), "R^1", &["S = -8/(1 + u^2 + v^2)^4"]),
    ("pseudosphere", Some(3), "sl(2,R)", &["S = -2/R^2"]),
    ("paraboloid", Some(1), "R^1", &["S = 2/(1 + x^2 + y^2)^2"]),
    ("hyperbolic-paraboloid", Some(0), "0", &["S = -2/(1 + x^2 + y^2)^2"]),
    (
        "graph",
        Some(0),
        "0",
        &["S = 2*(h_x_x(x,y)*h_y_y(x,y) - h_x_y(x,y)^2)/(1 + h_x(x,y)^2 + h_y(x,y)^2)^2"],
    ),
    ("surface-of-revolution", Some(1), "R^1", &["S = -2*f_s_s(s)/f(s)"]),
    ("hyperbolic-plane", Some(3), "sl(2,R)", &["S = -2/R^2"]),
    ("poincare-disk", Some(3), "sl(2,R)", &["S = -2"]),
    ("hyperbolic-space", Some(6), "so(3,1)", &["S = -6/R^2", "constant curvature"]),
    ("3-sphere", Some(6), "so(3) + so(3)", &["S = 6/R^2", "constant curvature"]),
    // P. Petersen, Riemannian Geometry (2006), section 4.4
    ("berger-sphere", Some(4), "so(3) + R^1", &["S = 8 - 2*t^2"]),
    // J. Milnor, Adv. Math. 21 (1976) 293-329
    ("nil-geometry", Some(4), "", &["S = -1/2"]),
    ("sol-geometry", Some(3), "iso(1,1)", &["S = -2"]),
    ("fubini-study", Some(8), "su(3)", &["Ric_jl = 6*g_jl", "locally symmetric", "Kr = 192"]),
    ("euler-angles", None, "", &["torsion = 0"]),
    ("gibbs-vector", None, "", &["not flat"]),
    ("rotation-vector", None, "", &["not flat"]),
];

/// Petrov types of spacetimes of dimension 4: H. Stephani and others (2003), chapters 12 to 24 and 31; types of metrics with
/// free functions are those of generic functions.
const TYPES: &[(PetrovType, &[&str])] = &[
    (
        PetrovType::O,
        &[
            "minkowski",
            "rindler",
            "milne",
            "de-sitter",
            "de-sitter-static",
            "anti-de-sitter",
            "anti-de-sitter-static",
            "einstein-static",
            "friedmann",
            "friedmann-dust",
            "bertotti-robinson",
            "cosmic-string",
        ],
    ),
    (PetrovType::N, &["pp-wave", "plane-wave", "cahen-wallach"]),
    (
        PetrovType::D,
        &[
            "schwarzschild",
            "schwarzschild-isotropic",
            "schwarzschild-observers",
            "eddington-finkelstein",
            "painleve-gullstrand",
            "lemaitre-tolman",
            "schwarzschild-de-sitter",
            "reissner-nordstrom",
            "bardeen",
            "hayward",
            "vaidya",
            "kerr",
            "kerr-newman",
            "taub-nut",
            "kantowski-sachs",
            "goedel",
            "nariai",
            "ellis-wormhole",
            "melvin",
            "c-metric",
        ],
    ),
    (
        PetrovType::I,
        &[
            "kasner",
            "bianchi-i",
            "van-stockum",
            "levi-civita-cylinder",
            "curzon-chazy",
            "weyl",
            "petrov",
        ],
    ),
];

#[test]
fn spacetimes_have_their_published_petrov_types() {
    let spacetimes = NamedChart::all().filter(|chart| chart.is_spacetime());
    for chart in spacetimes {
        let geometry = chart.definition().unwrap().geometry::<Symbolic>(Tolerance::default());
        let geometry = geometry.unwrap();
        let found = geometry.connection().petrov(geometry.metric().unwrap()).unwrap();
        let published = TYPES.iter().find(|(_, names)| names.contains(&chart.name()));
        let (found, published) = (found.map(|petrov| petrov.kind), published.map(|row| row.0));
        assert_eq!(found, published, "{}", chart.name());
    }
}

fn sorted(sum: &str) -> Vec<&str> {
    let mut parts: Vec<_> = sum.split(" + ").collect();
    parts.sort_unstable();
    parts
}

#[test]
fn charts_have_their_published_curvature_and_isometries() {
    let all: BTreeSet<_> = NamedChart::all().map(NamedChart::name).collect();
    assert_eq!(all, PUBLISHED.iter().map(|row| row.0).collect());
    for (name, isometries, algebra, claims) in PUBLISHED {
        let space = open(name).unwrap();
        let geometry = space.definition.geometry::<Symbolic>(Tolerance::default()).unwrap();
        let found = IsometryAlgebra::of(&geometry, Symmetry::Killing).ok();
        assert_eq!(found.as_ref().map(IsometryAlgebra::dimension), *isometries, "{name}");
        if let Some(found) = found {
            let chart = NamedChart::find(name).unwrap();
            let n = space.definition.dimension();
            // the sample point of the C-metric is in a region where the signs of the metric are reversed
            let one_time = [[n - 1, 1], [1, n - 1]].contains(&found.signature());
            assert_eq!(one_time, chart.is_spacetime(), "{name}");
            assert!(one_time || found.signature() == [n, 0], "{name}");
            if !algebra.is_empty() {
                assert_eq!(sorted(&found.name().unwrap()), sorted(algebra), "{name}");
            }
        }
        let statements = Statements::parse("claims.txt", &claims.join("\n")).unwrap();
        for verdict in Computation::of(&space).test(&statements).unwrap().iter() {
            assert!(verdict.holds, "{name}: {verdict:?}");
        }
    }
}

/// Each file states its source, and each name and title is used once.
#[test]
fn charts_have_a_source_and_a_name_of_their_own() {
    let folder = crate::common::root().join("documents/charts");
    let mut titles = BTreeSet::new();
    for chart in NamedChart::all() {
        let text = std::fs::read_to_string(folder.join(chart.name()).with_extension("toml"));
        let text = text.unwrap();
        let comments = text.lines().filter(|line| line.starts_with('#')).count();
        assert!(comments > 1 || chart.name() == "minkowski", "{}", chart.name());
        let title = chart.definition().unwrap().name;
        assert_eq!(NamedChart::find(chart.name()).unwrap().name(), chart.name());
        assert!(titles.insert(title.clone()), "{title}");
    }
    assert_eq!(titles.len(), std::fs::read_dir(folder).unwrap().count());
}

/// Spellings that people use, at the command line and in a field.
#[test]
fn names_are_read_in_any_spelling() {
    for (spelling, title) in [
        ("Schwarzschild", "Schwarzschild"),
        ("Kerr metric", "Kerr"),
        ("Gödel spacetime", "Goedel"),
        ("de Sitter", "de Sitter"),
        ("FLRW", "Friedmann-Lemaitre-Robertson-Walker"),
        ("Reissner-Nordström", "Reissner-Nordstrom"),
        ("Poincaré disk", "Poincare's disk"),
        ("kottler", "Schwarzschild-de Sitter (Kottler)"),
    ] {
        assert_eq!(open(spelling).unwrap().definition.name, title);
        assert_eq!(typed(spelling).unwrap().0.name, title);
    }
    let error = open("schwarzschld").unwrap_err();
    assert!(error.message.contains("the nearest is schwarzschild"), "{error:?}");
    assert_eq!(error.suggestions, ["schwarzschild"]);
    // a name of an algebra remains one
    assert_eq!(open("heisenberg(3)").unwrap().definition.name, "heisenberg(3)");
}

#[test]
fn conditions_choose_charts() {
    let names = |condition: &str| {
        let list = catalogue_where(condition).unwrap_or_else(|e| panic!("{condition}: {e:?}"));
        let mut out = vec![];
        list.unwrap().write(Format::Json, &mut out).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&out).unwrap();
        let spaces = json["spaces"].as_array().unwrap().iter();
        spaces.map(|space| space["name"].as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(names("spacetime, flat"), ["minkowski", "rindler", "milne", "cosmic-string"]);
    let flat_surfaces = names("chart, dimension=2, flat");
    assert_eq!(flat_surfaces, ["cylinder", "cone"]);
    assert_eq!(names("isometries=8"), ["fubini-study"]);
    assert_eq!(names("Petrov N"), ["pp-wave", "plane-wave", "cahen-wallach"]);
    assert_eq!(names("Petrov D, Einstein, not Ricci-flat"), ["schwarzschild-de-sitter", "nariai"]);
    assert_eq!(names("dimension=5, Ricci-flat"), ["tangherlini"]);
    let mixed = catalogue_where("nilpotent, flat").err().unwrap();
    assert!(mixed.message.contains("property of algebras"), "{mixed:?}");
}
