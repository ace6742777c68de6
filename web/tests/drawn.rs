//! Pictures of the page: transport and motions.

use super::{answer, refused};
use affinor::group::transport::ParallelTranslation;
use affinor::group::{LieGroup, So3};
use affinor::{CanonicalConnection, Connection};
use nalgebra::{DVector, Vector3};
use serde_json::{Value, json};

fn data(request: Value) -> Value {
    let mut request = request;
    request["format"] = json!("json");
    serde_json::from_str(&answer(request)).unwrap()
}

/// The vectors at the end of a path of one arc: `exp(-Lambda_x)`, (51) and (71).
#[test]
fn transport_is_that_of_the_library() {
    let x = Vector3::new(0.4, -0.9, 1.1);
    let path = "0,0,0; 0.4,-0.9,1.1";
    let table =
        answer(json!({ "report": "transport", "path": path, "vector": "1,2,-1", "format": "csv" }));
    for (name, which) in [
        ("plus", CanonicalConnection::Plus),
        ("zero", CanonicalConnection::Zero),
        ("minus", CanonicalConnection::Minus),
    ] {
        let connection = Connection::canonical(&So3.algebra().unwrap(), which);
        let carried =
            ParallelTranslation::new(So3, connection).unwrap().along_subgroup(&x).unwrap();
        let expected = carried * DVector::from_vec(vec![1.0, 2.0, -1.0]);
        let ending = format!("connection {name},12,");
        let line =
            table.lines().find(|line| line.contains(&ending)).unwrap_or_else(|| panic!("{table}"));
        let numbers: Vec<f64> = line.split(',').skip(2).map(|x| x.parse().unwrap()).collect();
        for i in 0..3 {
            assert!(
                (numbers[i] - x[i]).abs() < 1e-6 && (numbers[3 + i] - expected[i]).abs() < 1e-6,
                "{line}"
            );
        }
    }
}

/// Geodesics of the round metric are those of zero: one-parameter groups, straight lines from the identity.
#[test]
fn rays_from_the_identity_are_straight() {
    let found = data(json!({ "report": "transport", "metric": "diag(2,2,2)", "vector": "1,1,0" }));
    let panels = found["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 4);
    for panel in panels {
        let own = panel["own"][0].as_array().unwrap();
        for point in own {
            let x: Vec<f64> =
                point.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            assert!((x[0] - x[1]).abs() < 2e-5 && x[2].abs() < 2e-5, "{point}");
        }
        assert!(panel["about"].as_str().unwrap().contains("The path is closed"));
    }
}

#[test]
fn a_motion_keeps_what_it_should() {
    let problem = "space = \"so3\"\nmetric = \"diag(0.6, 0.8, 1)\"\n[initial]\nmomentum = [1.8, 0.4, -0.9]\n[output]\nend = 6.86261617805811641\nevery = 0.1\n";
    let found = data(
        json!({ "report": "motion", "problem": problem, "methods": "rkmk4, dmv10, generalised-alpha" }),
    );
    let columns: Vec<&str> =
        found["columns"].as_array().unwrap().iter().map(|c| c.as_str().unwrap()).collect();
    let rows = found["rows"].as_array().unwrap();
    let value = |row: &Value, name: &str| {
        row[columns.iter().position(|c| *c == name).unwrap()].as_f64().unwrap()
    };
    // the period of Hairer and Vilmart (2006)
    for name in ["Omega1", "Omega2", "Omega3"] {
        assert!(
            (value(&rows[0], name) - value(rows.last().unwrap(), name)).abs() < 1e-13,
            "{name}"
        );
    }
    assert_eq!(found["poses"].as_array().unwrap().len(), rows.len());
    let drift = |method: &str| {
        let all = found["drifts"].as_array().unwrap();
        let one = all.iter().find(|d| d["method"] == method && d["quantity"] == "energy").unwrap();
        one["changes"].as_array().unwrap().last().unwrap().as_f64().unwrap()
    };
    assert!(drift("exact") < 1e-13);
    let refused = found["drifts"]
        .as_array()
        .unwrap()
        .iter()
        .find(|d| d["method"] == "generalised-alpha")
        .unwrap();
    assert!(refused["refused"].as_str().unwrap().len() > 10);
}

#[test]
fn wrong_paths_and_problems_are_refused() {
    for request in [
        json!({ "report": "transport", "path": "0,0,0" }),
        json!({ "report": "transport", "path": "0,0; 1,1" }),
        json!({ "report": "transport", "path": "0,0,0; 4,0,0" }),
        json!({ "report": "transport", "path": "0,0,0; x,0,0" }),
        json!({ "report": "transport", "path": "0,0,0; 1,0,0;".repeat(400) }),
        json!({ "report": "transport", "vector": "1e300,0,0" }),
        json!({ "report": "transport", "metric": "diag(1,1)" }),
        json!({ "report": "transport", "metric": "diag(a,1,1)" }),
        json!({ "report": "motion", "problem": "" }),
        json!({ "report": "motion", "problem": "space = \"so3\"" }),
        json!({ "report": "motion", "problem": "space = \"so3\"\nmetric = \"identity\"\ninitial.velocity = [0,0,1]\noutput = { end = 1e6, every = 1 }" }),
        json!({ "report": "motion", "problem": "space = \"so3\"\nmetric = \"identity\"\ninitial.velocity = [0,0,1]\noutput = { end = 1, every = 1 }", "methods": "euler" }),
    ] {
        let message = refused(&request.to_string())["message"].to_string();
        assert!(message.len() > 10, "{request}: {message}");
    }
}

/// Diagrams of an algebra with roots, heat maps of a table; each with its words.
#[test]
fn reports_have_pictures() {
    let pictures = |request: Value| -> Vec<Value> {
        let answer: Value =
            serde_json::from_str(&affinor_web::call(&request.to_string()).unwrap()).unwrap();
        answer["pictures"].as_array().unwrap().clone()
    };
    let of_g2 = pictures(json!({ "report": "info", "space": "G2" }));
    assert_eq!(of_g2.len(), 2);
    assert!(of_g2[1]["title"].as_str().unwrap().contains("12 roots"));
    assert!(pictures(json!({ "report": "info", "space": "heisenberg(3)" })).is_empty());
    let maps = pictures(
        json!({ "report": "table", "space": "so3@zero", "show": "curvature, ricci, structure" }),
    );
    assert_eq!(maps.len(), 3);
    for picture in of_g2.iter().chain(&maps) {
        let svg = picture["svg"].as_str().unwrap();
        assert!(svg.contains("<title>") && svg.contains("role=\"img\""), "{svg}");
    }
    assert!(maps.iter().any(|map| {
        map["title"].as_str().unwrap().contains("12 nonzero components of 81 in 9 slices")
    }));
    // JSON is for programs
    assert!(
        pictures(json!({ "report": "table", "space": "so3@zero", "format": "json" })).is_empty()
    );
}

/// The octet of SU(3): a product with its components, and the diagram of the octet. Six weights have
/// multiplicity 1, and one has multiplicity 2. The weights of the 7 of G2 are a hexagon and its
/// centre.
#[test]
fn representations_have_weight_diagrams() {
    let answer = |request: Value| -> Value {
        serde_json::from_str(&affinor_web::call(&request.to_string()).unwrap()).unwrap()
    };
    let circles =
        |answer: &Value| answer["pictures"][0]["svg"].as_str().unwrap().matches("<circle").count();
    let octets =
        answer(json!({ "report": "rep", "space": "A2", "weight": "8", "factors": "8; 3" }));
    assert!(octets["text"].as_str().unwrap().contains("192"), "8 x 8 x 3 has dimension 192");
    assert_eq!(circles(&octets), 7);
    assert_eq!(circles(&answer(json!({ "report": "rep", "space": "G2", "weight": "7" }))), 7);
    // the vectors of so(7) are six axes and the centre, in three dimensions
    assert_eq!(circles(&answer(json!({ "report": "rep", "space": "B3", "weight": "7" }))), 7);
    let line = answer(json!({ "report": "rep", "space": "A1", "weight": "3" }));
    assert_eq!(line["pictures"], json!([]));
    let restricted = json!({ "report": "rep", "space": "G2", "weight": "7", "subalgebra": "SU(3)", "format": "csv" });
    assert!(answer(restricted)["text"].as_str().unwrap().contains("3bar"));
    for (space, weight) in [("A2", "9"), ("A2", "[1]"), ("", "8"), ("so3", "")] {
        let request = json!({ "report": "rep", "space": space, "weight": weight });
        let refused = affinor_web::call(&request.to_string()).unwrap_err();
        assert!(refused.len() > 40, "{refused}");
    }
}
