//! Algebras, metrics, connections and geometries are serialized and read back by serde; invalid
//! data are errors.

use crate::common::{Space, property::properties, spaces};
use affinor::geometry::connection::CanonicalConnection;
use affinor::group::{AnyGroup, Coordinates, Se3, So3, TranslationSplit};
use affinor::mechanics::State;
use affinor::{Connection, ConnectionKind, Geometry, LieAlgebra, Metric, Rational};
use proptest::prelude::*;

fn algebra(name: &str) -> LieAlgebra<Rational> {
    affinor::algebra::catalogue::algebra(name).unwrap()
}

properties! {
    #![cases(32)]

    #[test]
    fn what_is_written_is_read_back(space in spaces(4)) {
        let Space { algebra, lambda, metric, affinities } = space;
        let kinds = [
            ConnectionKind::Canonical(CanonicalConnection::Zero),
            ConnectionKind::Family(lambda),
            ConnectionKind::LeviCivita,
            ConnectionKind::Affinities(affinities),
        ];
        for kind in kinds {
            let geometry = Geometry::new("a space", algebra.clone(), kind, Some(metric.clone()))?.over("an algebra");
            let text = serde_json::to_string(&geometry)?;
            let read: Geometry<Rational> = serde_json::from_str(&text)?;
            prop_assert_eq!(&read, &geometry);
            prop_assert_eq!(read.algebra_name(), "an algebra");
            let text = serde_json::to_string(geometry.connection())?;
            prop_assert_eq!(&serde_json::from_str::<Connection<Rational>>(&text)?, geometry.connection());
        }
        let text = serde_json::to_string(&metric)?;
        prop_assert_eq!(serde_json::from_str::<Metric<Rational>>(&text)?, metric);
    }
}

#[test]
fn the_written_form() {
    let geometry = Geometry::new(
        "aff",
        algebra("aff(1)"),
        ConnectionKind::Canonical(CanonicalConnection::Plus),
        None,
    )
    .unwrap();
    let structure = r#"{"schema":"affinor.tensor/1","dimension":2,"slots":["up","down","down"],"tolerance":1.4210854715202004e-14,"components":[[[2,1,2],"1"],[[2,2,1],"-1"]]}"#;
    let algebra =
        format!(r#"{{"schema":"affinor.algebra/1","basis":["x","y"],"structure":{structure}}}"#);
    let text = format!(
        r#"{{"schema":"affinor.geometry/1","name":"aff","algebra":{algebra},"connection":"plus"}}"#
    );
    assert_eq!(serde_json::to_string(&geometry).unwrap(), text);
}

#[test]
fn what_is_read_is_checked() {
    let text = serde_json::to_string(&algebra("so(3)")).unwrap();
    let read = |from: &str, to: &str| {
        assert!(text.contains(from), "{text}");
        serde_json::from_str::<LieAlgebra<Rational>>(&text.replace(from, to))
            .unwrap_err()
            .to_string()
    };
    for (from, to, message) in [
        (
            "affinor.algebra/1",
            "affinor.algebra/2",
            "expected schema affinor.algebra/1, got affinor.algebra/2",
        ),
        (r#"[[1,2,3],"1"]"#, r#"[[1,2,3],"2"]"#, "antisymmetric"),
        (r#""basis":["e1","#, r#""basis":["#, "dimension"),
    ] {
        let found = read(from, to);
        assert!(found.contains(message), "{found}");
    }
    let metric = serde_json::to_string(&Metric::<Rational>::identity(2).unwrap()).unwrap();
    let degenerate = metric.replace(r#",[[2,2],"1"]"#, "");
    let found = serde_json::from_str::<Metric<Rational>>(&degenerate).unwrap_err().to_string();
    assert!(found.contains("degenerate"), "{found}");
}

#[test]
fn other_frames_are_not_written() {
    let geometry = Geometry::new(
        "M",
        algebra("so(3)"),
        ConnectionKind::Canonical(CanonicalConnection::Plus),
        None,
    )
    .unwrap();
    let right = serde_json::to_string(&geometry.in_right_frame().unwrap()).unwrap_err();
    assert_eq!(right.to_string(), "a geometry in its right-invariant frame cannot be serialized");
}

/// States are equal to the last bit: rotations, poses, and elements of a named group.
#[test]
fn states_of_motions() {
    fn there_and_back<
        G: TranslationSplit<Element: PartialEq + serde::Serialize + serde::de::DeserializeOwned>,
    >(
        group: &G,
    ) where
        G::Vector: serde::Serialize + serde::de::DeserializeOwned,
    {
        let x = G::Vector::from_fn(group.dimension(), |i| 0.1 + 0.7 * i as f64);
        let state = State::<G>::with_momentum(group, 0.3, group.exp(&x), &(x * 1e-300));
        let text = serde_json::to_string(&state).unwrap();
        let read: State<G> = serde_json::from_str(&text).unwrap();
        assert!(read == state);
        assert!(read != State { time: 0.4, ..state.clone() });
        let more = text.replacen('{', r#"{"mass":1,"#, 1);
        assert!(serde_json::from_str::<State<G>>(&more).is_err());
    }
    there_and_back(&So3);
    there_and_back(&Se3);
    there_and_back(&AnyGroup::named("se3+heisenberg(3)").unwrap());
}
