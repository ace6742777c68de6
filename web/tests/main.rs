//! Answers of the engine agree with the reports of the library.

mod cards;
mod copies;
mod drawn;
mod inputs;

use affinor_web::call;
use serde_json::{Value, json};

fn answer(request: Value) -> String {
    let answer =
        call(&request.to_string()).unwrap_or_else(|refusal| panic!("{request}: {refusal}"));
    let answer: Value = serde_json::from_str(&answer).unwrap();
    answer["text"].as_str().unwrap().to_string()
}

fn refused(request: &str) -> Value {
    serde_json::from_str(&call(request).unwrap_err()).unwrap()
}

#[test]
fn every_report_in_every_format() {
    for report in
        ["compare", "table", "check", "info", "properties", "equations", "list", "conventions"]
    {
        let (space, other) = match report {
            "compare" => ("so3@plus", "so3@zero"),
            "list" => ("so", ""),
            _ => ("so3@zero;metric=diag(1,2,3)", ""),
        };
        for format in ["html", "text", "markdown", "latex", "csv", "json"] {
            let text = answer(
                json!({ "report": report, "space": space, "other": other, "format": format }),
            );
            assert!(text.len() > 100, "{report} {format}: {text}");
            assert_eq!(text.starts_with("<!DOCTYPE html>"), format == "html", "{report} {format}");
        }
    }
}

#[test]
fn definitions_and_options_are_read() {
    let toml = "name = \"mine\"\nbasis = [\"x\", \"y\"]\nbrackets = \"[x, y] = y\"";
    let text = answer(
        json!({ "report": "table", "definition": toml, "metric": "identity", "show": "ricci, scalar_curvature", "format": "text" }),
    );
    assert!(text.contains("Ric_11 = Ric_22 = -1") && text.contains("S = -2"), "{text}");
    let json = r#"{"basis": ["x", "y"], "brackets": "[x, y] = a*y", "parameters": ["a"]}"#;
    let text = answer(
        json!({ "report": "table", "definition": json, "set": "a=3", "show": "killing", "format": "text" }),
    );
    assert!(text.contains("K_11 = 9"), "{text}");
    let text = answer(
        json!({ "report": "table", "space": "so3", "connection": "lambda=1/3", "show": "curvature", "format": "text" }),
    );
    assert!(text.contains("2/9"), "{text}");
    let request = json!({ "report": "table", "space": "so3@levi-civita;metric=diag(1,2,3)", "show": "derived", "format": "text" });
    assert!(answer(request).contains("Kretschmann"));
}

#[test]
fn refusals_have_a_message() {
    for request in [
        "",
        "[]",
        r#"{"report": 1}"#,
        r#"{"repport": "table"}"#,
        r#"{"report": "tabel"}"#,
        r#"{"report": "table"}"#,
        r#"{"report": "table", "space": "so33"}"#,
        r#"{"report": "table", "space": "/etc/passwd"}"#,
        r#"{"report": "table", "space": "so3", "metric": "diag(1,2)"}"#,
        r#"{"report": "table", "space": "so3", "show": "nothing"}"#,
        r#"{"report": "table", "space": "so3", "format": "pdf"}"#,
        r#"{"report": "table", "definition": "basis = ["}"#,
        r#"{"report": "equations", "space": "so3"}"#,
        r#"{"report": "equations", "space": "M3", "motion": "sideways"}"#,
        r#"{"report": "list", "space": "no such thing"}"#,
        r#"{"report": "table", "space": "E8", "metric": "identity", "show": "curvature", "format": "json"}"#,
    ] {
        let refusal = refused(request);
        assert!(
            refusal["message"].as_str().is_some_and(|message| message.len() > 5),
            "{request}: {refusal}"
        );
    }
    // the place, under the letters
    let request = json!({ "report": "table", "definition": "basis = [\"x\", \"y\"]\nbrackets = \"[x, q] = y\"" });
    let place = &refused(&request.to_string())["place"];
    assert_eq!((&place["source"], &place["line"]), (&json!("input"), &json!(2)), "{place}");
    let (text, from) = (place["text"].as_str().unwrap(), place["from"].as_u64().unwrap() as usize);
    assert!(text[from..].starts_with('q'), "{place}");
}
