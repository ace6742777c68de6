//! The rows of a distribution in the structure of an algebra, and the connection of a distribution.

use affinor_documents::report::{Format, Info, Report};
use affinor_documents::space::{Request, Space};
use affinor_tensors::{Rational, Tolerance};
use serde_json::{Value, json};

fn open(space: &str, connection: Option<&str>, metric: Option<&str>) -> Space {
    let [connection, metric] = [connection, metric].map(|text| text.map(String::from));
    let request = Request { space: Some(space.into()), connection, metric, ..Request::default() };
    Space::open(&request).unwrap()
}

fn distribution(space: &str, vectors: &str) -> Result<Value, String> {
    let definition = open(space, None, None).definition;
    let mut info = Info::of(&definition, &|_| ()).unwrap();
    info.add_distribution(&definition, vectors).map_err(|error| error.to_string())?;
    let mut out = vec![];
    info.write(Format::Json, &mut out).unwrap();
    let mut report: Value = serde_json::from_slice(&out).unwrap();
    Ok(report["distribution"].take())
}

#[test]
fn distributions_have_witnesses() {
    let knife = json!({
        "basis": ["e1", "p1"],
        "involutive": false,
        "leaving_bracket": "[e1, p1] = p2",
        "growth_vector": [2, 3],
        "bracket_generating": true,
        "generating_brackets": ["[e1, p1] = p2"],
    });
    assert_eq!(distribution("se2", "p1, e1").unwrap(), knife);
    let translations = distribution("se2", "p1 + p2, p2").unwrap();
    assert_eq!(translations["involutive"], json!(true));
    assert_eq!(translations["growth_vector"], json!([2]));
    assert_eq!(translations["bracket_generating"], json!(false));
    let refused = |vectors: &str| distribution("se2", vectors).unwrap_err();
    assert!(refused("e1, 2*e1").contains("span only dimension 1"));
    assert!(refused("e1, q").contains('q'));
}

/// The name of the connection contains the vectors of the distribution. On SO(3) with the metric
/// `diag(1, 2, 4)`, the vectors e1 and e2 span a distribution whose connection is zero on it:
/// `P nabla_1 e_2 = 0`, because `nabla_1 e_2` is a multiple of e3.
#[test]
fn the_connection_of_a_distribution_has_a_name() {
    let metric = Some("diag(1, 2, 4)");
    let space = open("so3", Some("nonholonomic(e1, e2)"), metric);
    let geometry = space.definition.geometry::<Rational>(Tolerance::default()).unwrap();
    assert_eq!(geometry.kind().name(), "nonholonomic");
    let affinities = geometry.connection().affinities();
    assert!(affinities.components().all(|(at, _)| at[2] == 2 || at[0] != 2));
    assert_eq!(affinities.get(&[2, 0, 1]), 0.into());
    let missing = open("so3", Some("nonholonomic(e1, e2)"), None);
    let error = missing.definition.geometry::<Rational>(Tolerance::default()).unwrap_err();
    assert!(error.to_string().contains("metric"), "{error}");
    let twice = open("so3", Some("nonholonomic(e1, 2*e1)"), metric);
    let error = twice.definition.geometry::<Rational>(Tolerance::default()).unwrap_err();
    assert!(error.to_string().contains("linearly dependent"), "{error}");
}
