//! The cards of the page.

use serde_json::{Value, json};

/// A card as JSON.
fn card(request: Value) -> Value {
    let mut request = request;
    request["report"] = "card".into();
    let answer = affinor_web::call(&request.to_string()).unwrap();
    let answer: Value = serde_json::from_str(&answer).unwrap();
    serde_json::from_str(answer["text"].as_str().unwrap()).unwrap()
}

/// The alternative texts of the formulas of a card.
fn formulas(card: &Value) -> Vec<String> {
    let html = card["html"].as_str().unwrap();
    html.split("alttext=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().to_string())
        .collect()
}

/// A tensor with symmetries is shown by its representatives.
#[test]
fn cards_show_one_representative_and_the_symmetry() {
    let torsion = card(json!({ "input": "so(3)", "connection": "plus", "card": "torsion" }));
    assert_eq!(formulas(&torsion), ["tau^1_23 = 1"]);
    assert!(torsion["html"].to_string().contains("Totally antisymmetric"));
    let curvature = card(json!({ "input": "so(3)", "connection": "zero", "card": "curvature" }));
    assert_eq!(formulas(&curvature)[0], "R^1_212 = R^1_313 = R^2_323 = 1/4");
    assert_eq!(curvature["count"], 12);
}

/// The Ricci tensor is a matrix, with the eigenvalues of its operator.
#[test]
fn ricci_is_a_matrix_with_eigenvalues() {
    // Milnor: Ric(e_i) = 2 mu_j mu_k for a diagonal metric on so(3); the identity gives 1/2
    let ricci = card(json!({ "input": "so(3)", "metric": "identity", "card": "ricci" }));
    let html = ricci["html"].as_str().unwrap();
    assert!(html.contains("<mtable") && html.contains("(3 times)"), "{html}");
    assert!(formulas(&ricci).contains(&"1/2".to_string()), "{html}");
    let letters = card(json!({ "input": "so(3)", "metric": "diag(a, b, c)", "card": "ricci" }));
    let html = letters["html"].as_str().unwrap();
    // three columns of long fractions would be wider than a card
    assert!(html.contains("Eigenvalues") && !html.contains("<mtable"), "{html}");
}

/// Large tensors are summarized, and listed for given indices.
#[test]
fn large_tensors_are_summarized_and_filtered() {
    let summary = card(json!({ "input": "so(8)", "connection": "zero", "card": "curvature" }));
    assert_eq!(summary["summarized"], true);
    assert!(summary["html"].as_str().unwrap().len() < 4000);
    let listed = card(
        json!({ "input": "so(8)", "connection": "zero", "card": "curvature", "filter": "1,2,," }),
    );
    assert_eq!(listed["summarized"], false);
    let listed = formulas(&listed).concat();
    assert!(listed.starts_with("R^1_{2, 1, 2} = "), "{listed}");
}

/// Every name of the catalogue up to dimension 30 has all its cards, without ASCII in place of mathematics.
#[test]
fn every_card_of_the_catalogue_is_short() {
    let names = affinor_web::call(r#"{"report": "names"}"#).unwrap();
    let names: Value = serde_json::from_str(&names).unwrap();
    let names: Value = serde_json::from_str(names["text"].as_str().unwrap()).unwrap();
    for entry in names["spaces"].as_array().unwrap() {
        let input = entry;
        let reading =
            affinor_web::call(&json!({ "report": "reading", "input": input }).to_string()).unwrap();
        let reading: Value = serde_json::from_str(&reading).unwrap();
        let reading: Value = serde_json::from_str(reading["text"].as_str().unwrap()).unwrap();
        if reading["dimension"].as_u64().unwrap() > 30 {
            continue;
        }
        for kind in ["brackets", "connection", "torsion", "curvature", "ricci", "killing"] {
            let card = card(json!({ "input": input, "connection": "zero", "card": kind }));
            let html = card["html"].as_str().unwrap();
            assert!(html.len() < 120_000, "{input} {kind}: {}", html.len());
            let visible: String = html
                .split('<')
                .filter_map(|part| part.split_once('>').map(|(_, text)| text))
                .collect();
            assert!(!visible.contains('^') && !visible.contains('_'), "{input} {kind}: {visible}");
        }
    }
}
