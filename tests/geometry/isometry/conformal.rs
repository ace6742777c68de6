//! Conformal Killing fields: published dimensions and algebras, conformal factors, and the Killing
//! fields of an invariant metric of the conformal class.

use super::{KERR, OnChart, spacetimes, spherical, value};
use affinor::algebra::catalogue;
use affinor::geometry::isometry::{Certainty, IsometryAlgebra, Symmetry};
use affinor::{Metric, Rational};

fn conformal(space: &OnChart) -> IsometryAlgebra {
    space.symmetries(Symmetry::Conformal).unwrap()
}

/// The space with its metric multiplied by a function.
fn rescaled(space: &OnChart, factor: &str) -> OnChart {
    let factor = value(factor);
    let components = space.components.iter().map(|(at, v)| (*at, v.clone() * &factor)).collect();
    OnChart { components, ..space.clone() }
}

/// Conformal algebras: H. Stephani and others, *Exact Solutions* (2003), chapter 35; R. Maartens and
/// S. D. Maharaj, *Class. Quantum Grav.* 3 (1986) 1005 (Friedmann: 15) and 8 (1991) 503 (pp-waves).
#[test]
fn spacetimes_have_their_published_conformal_algebras() {
    let flat = [
        "Minkowski",
        "de Sitter",
        "anti-de Sitter",
        "flat Friedmann",
        "flat Friedmann with dust, t = s^3",
        "closed Friedmann",
        "open Friedmann",
        "Einstein static",
        "conformally flat plane wave",
        "electromagnetic plane wave",
        "Bertotti-Robinson",
    ];
    let mut count = 0;
    for (name, space, [_, homothetic, _], _) in spacetimes() {
        if ["Taub-NUT", "open Friedmann", "closed Friedmann"].contains(&name) {
            continue;
        }
        let found = conformal(&space);
        let expected = match name {
            "BTZ" => 10,
            name if flat.contains(&name) => 15,
            _ => homothetic,
        };
        assert_eq!(found.dimension(), expected, "{name}: {found:?}");
        assert_ne!(found.certainty(), Certainty::UpperBound, "{name}");
        if name == "Minkowski" {
            assert_eq!(found.name().as_deref(), Some("so(4,2)"));
            assert_eq!((found.isotropy(), found.dimensions()[0]), (11, 15));
        }
        count += 1;
    }
    assert!(count > 20);
}

#[test]
fn riemannian_spaces_have_their_conformal_algebras() {
    let cases = [
        (
            "S^3",
            OnChart::new("x y z", &[("x", "1"), ("y", "sin(x)^2"), ("z", "sin(x)^2*sin(y)^2")]),
            10,
            "so(4,1)",
        ),
        (
            "S^2 x R",
            OnChart::new("x y z", &[("x", "1"), ("y", "sin(x)^2"), ("z", "1")]),
            10,
            "so(4,1)",
        ),
        (
            "H^2 x R",
            OnChart::new("x y z", &[("x", "1/y^2"), ("y", "1/y^2"), ("z", "1")]),
            10,
            "so(4,1)",
        ),
        ("Sol", OnChart::new("x y z", &[("x", "exp(2*z)"), ("y", "exp(-2*z)"), ("z", "1")]), 3, ""),
        (
            "Nil",
            OnChart::new("x y z", &[("x", "1"), ("y", "1 + x^2"), ("y z", "-x"), ("z", "1")]),
            4,
            "",
        ),
        (
            "S^2 x S^2",
            OnChart::new(
                "x y z w",
                &[("x", "1"), ("y", "sin(x)^2"), ("z", "1"), ("w", "sin(z)^2")],
            ),
            6,
            "so(3) + so(3)",
        ),
        (
            "S^2 x H^2",
            OnChart::new(
                "x y z w",
                &[("x", "1"), ("y", "sin(x)^2"), ("z", "1/w^2"), ("w", "1/w^2")],
            ),
            15,
            "so(5,1)",
        ),
    ];
    for (name, space, dimension, algebra) in cases {
        let found = conformal(&space);
        assert_eq!(found.dimension(), dimension, "{name}: {found:?}");
        if !algebra.is_empty() {
            assert_eq!(found.name().as_deref(), Some(algebra), "{name}");
        }
    }
}

/// A conformal factor does not change the algebra; its dimension is proved for invariant metrics.
#[test]
fn the_algebra_belongs_to_the_conformal_class() {
    let plane_wave =
        OnChart::new("u v x y", &[("u v", "1"), ("u", "x^2 - y^2"), ("x", "1"), ("y", "1")]);
    let spaces = [
        (spherical("1 - 2*M/r"), "exp(t)*(1 + cos(theta)^2)", 4),
        (plane_wave, "exp(x)*(1 + u^2)", 7),
        (OnChart::new("x y z", &[("x", "1"), ("y", "1"), ("z", "1")]), "exp(x*y) + z^2", 10),
    ];
    for (space, factor, dimension) in spaces {
        assert_eq!(conformal(&rescaled(&space, factor)).dimension(), dimension);
    }
    let cases: [(&str, &[i64], usize); 5] = [
        ("R^3", &[1, 2, 3], 10),
        ("so(3)", &[1, 1, 1], 10),
        ("so(3)", &[1, 1, 2], 4),
        ("heisenberg(3)", &[1, 2, 3], 4),
        ("bianchi(V)", &[1, 2, 3], 10),
    ];
    for (name, diagonal, dimension) in cases {
        let algebra = catalogue::algebra::<Rational>(name).unwrap();
        let metric = Metric::diagonal(diagonal.iter().map(|v| Rational::from(*v))).unwrap();
        let found = IsometryAlgebra::invariant(algebra.left_frame(), &metric, Symmetry::Conformal);
        let found = found.unwrap();
        assert_eq!(
            (found.dimension(), found.certainty()),
            (dimension, Certainty::Proved),
            "{name}"
        );
    }
}

/// A power of the square of the Weyl tensor makes the metric invariant, unless the square vanishes:
/// conformal Killing fields are the Killing fields of the invariant metric.
#[test]
fn conformal_fields_are_killing_fields_of_the_invariant_metric() {
    let kasner =
        OnChart::new("s x y z", &[("s", "-9*s^4"), ("x", "s^-2"), ("y", "s^4"), ("z", "s^4")]);
    let cases = [
        (spherical("1 - 2*M/r"), "1/r^3", 4),
        (kasner, "1/s^6", 5),
        // Psi2 Psi2* of Kerr
        (OnChart::new("t r theta phi", KERR), "1/(r^2 + a^2*cos(theta)^2)", 2),
    ];
    for (space, factor, dimension) in cases {
        assert_eq!(rescaled(&space, factor).isometries().dimension(), dimension);
        assert_eq!(conformal(&space).dimension(), dimension);
    }
}

#[test]
fn surfaces_are_refused() {
    let plane = OnChart::new("x y", &[("x", "1"), ("y", "1")]);
    let error = plane.symmetries(Symmetry::Conformal).unwrap_err();
    assert!(error.to_string().contains("infinite dimension"));
}
