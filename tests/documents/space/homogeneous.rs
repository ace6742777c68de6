//! Homogeneous spaces as definitions: typed texts, parameters, and agreement of the scalar types.

use affinor::Geometry;
use affinor_documents::Coefficient;
use affinor_documents::space::{Definition, Request, Space, Typed, typed};
use affinor_tensors::{Notation, Rational, Symbolic, Tolerance, TrackedFloat};
use std::collections::BTreeMap;

fn geometry<S: Coefficient>(definition: &Definition) -> Geometry<S> {
    definition.geometry(Tolerance::default()).unwrap()
}

fn open(space: &str) -> Definition {
    Space::open(&Request { space: Some(space.into()), ..Request::default() }).unwrap().definition
}

/// The field of the page accepts names of homogeneous spaces in every spelling, with a connection and
/// a metric.
#[test]
fn names_are_typed() {
    for (text, name) in [
        ("SU(3)/U(2)", "SU(3)/U(2)"),
        ("S^7 = Sp(2)/Sp(1)", "Sp(2)/Sp(1)"),
        ("V(2,ℝ⁵)", "SO(5)/SO(3)"),
        ("\\mathbb{CP}^{2}", "SU(3)/S(U(2)xU(1))"),
        ("SU(2)\\times SU(2)/SU(2)", "SU(2)xSU(2)/SU(2)"),
        ("G2/SU(3)", "G2/SU(3)"),
    ] {
        let (definition, kind) = typed(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((definition.name.as_str(), kind), (name, Typed::Name), "{text}");
        assert!(definition.is_homogeneous());
    }
    let keys = "homogeneous = { of = 'so(4)', by = ['e1'] }";
    let (definition, kind) = typed(keys).unwrap();
    assert_eq!((definition.dimension(), kind), (5, Typed::Keys));
    let request = Request { typed: Some("CP^2@natural".into()), ..Request::default() };
    assert!(Space::open(&request).unwrap().definition.is_homogeneous());
}

/// All scalar types have the same Ricci tensor.
#[test]
fn scalar_types_agree() {
    for space in ["CP^2", "S^7 = Sp(2)/Sp(1)", "SU(3)/U(1)_{1,2}", "SO(3,1)/SO(3)"] {
        let definition = open(&format!("{space}@levi-civita;metric=killing"));
        let exact = geometry::<Rational>(&definition).connection().ricci();
        let symbolic = geometry::<Symbolic>(&definition).connection().ricci();
        assert_eq!(exact.map(|value| Symbolic::constant(value.clone())), symbolic, "{space}");
        let floats = geometry::<TrackedFloat>(&definition).connection().ricci();
        assert_eq!(floats.len(), exact.len(), "{space}");
        for ((at, value), (place, float)) in exact.components().zip(floats.components()) {
            assert_eq!(at, place);
            assert!((value.to_f64() - Notation::to_f64(float).unwrap()).abs() < 1e-12, "{space}");
        }
    }
}

/// A parameter in the subalgebra, or in the algebra, is replaced by a value as in a file with that
/// value.
#[test]
fn parameters_are_replaced() {
    let file = |h: &str, parameters: &str| {
        let text = format!(
            "{parameters}\nhomogeneous = {{ of = 'so(4)', by = ['{h}'] }}\nmetric = 'killing'\n"
        );
        Definition::parse("a.toml", &text).unwrap()
    };
    let mut family = file("e1 + a*e6", "parameters = ['a']");
    assert_eq!(family.parameters(), ["a"]);
    let scalar = |definition: &Definition| {
        let geometry = geometry::<Symbolic>(definition);
        let metric = geometry.metric().unwrap();
        geometry.connection().scalar_curvature(metric).unwrap()
    };
    let general = scalar(&family);
    let half = BTreeMap::from([("a".to_string(), "1/2".parse::<Symbolic>().unwrap())]);
    family.set(&half).unwrap();
    let fixed = file("e1 + 1/2*e6", "");
    assert_eq!(scalar(&family), scalar(&fixed));
    assert_eq!(general.substitute(&half), Some(scalar(&fixed)));
}

/// A metric in letters is invariant, and its determinant does not vanish.
#[test]
fn general_metrics_are_metrics() {
    for space in ["V(2,R^5)", "SU(3)/U(1)_{1,2}", "S^5 = SU(3)/SU(2)", "so(3)"] {
        let definition = open(&format!("{space}@levi-civita;metric=invariant"));
        let geometry = geometry::<Symbolic>(&definition);
        assert!(geometry.is_levi_civita().unwrap(), "{space}");
        assert!(!definition.parameters().is_empty());
    }
}
