//! The exceptional values of a parameter: values at which an answer differs from the generic
//! answer.

use super::{Cell, Info};
use crate::space::Definition;
use affinor::algebra::structure::exceptional::{Candidates, MAX_DIMENSION};
use affinor_tensors::{Rational, Symbolic};
use serde_json::{Map, Value, json};

/// The largest number of parameter values at which answers are compared with the generic answers.
const MOST: usize = 60;
/// The answers that are compared with the generic answers.
const COMPARED: [&str; 15] = [
    "unimodular",
    "killing",
    "derived_series",
    "lower_central_series",
    "upper_central_series",
    "centre",
    "radical",
    "nilradical",
    "rank",
    "derivations",
    "betti",
    "index",
    "invariant_forms",
    "symplectic",
    "contact",
];

/// The part of an answer that does not depend on the basis.
fn dimensions(answer: &Value) -> Value {
    let exists = |form: &Value| form["exists"].clone();
    match answer {
        Value::Object(form) if form.contains_key("exists") => {
            json!([exists(answer), form.get("exact").map(exists)])
        }
        _ => answer.get("dimension").or(answer.get("rank")).unwrap_or(answer).clone(),
    }
}

/// Whether two algebras have Casimir generators of the same degrees, up to the lower degree of the
/// two searches.
fn same_casimirs(a: &Value, b: &Value) -> bool {
    let [first, second] = [a, b].map(|found| found["degree"].as_u64().unwrap_or(0));
    let up_to = |found: &Value| -> Vec<u64> {
        let degrees = found["degrees"].as_array().into_iter().flatten().filter_map(Value::as_u64);
        degrees.filter(|degree| *degree <= first.min(second)).collect()
    };
    up_to(a) == up_to(b)
}

impl Info {
    /// Adds the parameter values at which an answer differs from the generic answer. The candidates
    /// are the roots of the polynomials that occurred in the computation.
    pub(super) fn exceptional_values(
        &mut self,
        parameters: &[String],
        divisors: &[Symbolic],
        definition: &Definition,
    ) {
        let [parameter] = parameters else {
            let reason = "not computed with several parameters";
            self.grid.rows.push(["exceptional values", "-", reason].map(Cell::from).to_vec());
            for key in ["exceptional_values", "exceptional_casimirs", "exceptional_open"] {
                self.json.insert(key.into(), Value::Null);
                self.json["reasons"][key] = reason.into();
            }
            return;
        };
        let Candidates { values, open } = Candidates::new(parameter, divisors);
        let left = values.len().saturating_sub(MOST);
        let at = |value: &Rational| {
            let mut special = definition.clone();
            special.set(&[(parameter.clone(), Symbolic::constant(value.clone()))].into()).ok()?;
            Some((value.to_string(), Info::of(&special, &|_| ()).ok()?.json))
        };
        let special: Vec<_> = values.iter().take(MOST).filter_map(at).collect();
        let differs = |json: &Map<String, Value>| {
            COMPARED.iter().any(|key| dimensions(&json[*key]) != dimensions(&self.json[*key]))
        };
        let more =
            |json: &Map<String, Value>| !same_casimirs(&json["casimirs"], &self.json["casimirs"]);
        let chosen = |wanted: &dyn Fn(&Map<String, Value>) -> bool| -> Vec<&str> {
            let wanted = special.iter().filter(|(_, json)| wanted(json));
            wanted.map(|(value, _)| value.as_str()).collect()
        };
        let (found, casimirs) = (chosen(&differs), chosen(&more));
        let answer = |found: &[&str]| match found {
            [] => "none".to_string(),
            _ => format!("{parameter} = {}", found.join(", ")),
        };
        let mut why = "of the roots of the polynomials that the computation met".to_string();
        if !open.is_empty() {
            why += &format!("; not decided where {} = 0", open.join(" = 0, "));
        }
        if left > 0 {
            why += &format!("; {left} roots are not tried");
        }
        if self.json["dimension"].as_u64() > Some(MAX_DIMENSION as u64) {
            why += &format!(
                "; only of those over rational functions beyond dimension {MAX_DIMENSION}"
            );
        }
        let mut rows = vec![["exceptional values", &answer(&found), &why].map(Cell::from)];
        if casimirs.iter().any(|value| !found.contains(value)) {
            let why = "generators of other degrees";
            rows.push(["Casimirs change at", &answer(&casimirs), why].map(Cell::from));
        }
        self.grid.rows.extend(rows.into_iter().map(|row| row.to_vec()));
        self.json.insert("exceptional_values".into(), json!(found));
        self.json.insert("exceptional_casimirs".into(), json!(casimirs));
        self.json.insert("exceptional_open".into(), json!(open));
    }
}
