//! Cartan decompositions, restricted roots, Satake and Vogan diagrams of simple ideals.

use super::Notes;
use affinor::algebra::structure::dynkin::diagram;
use affinor::algebra::structure::{RealForm, RealIdeal};
use serde_json::{Value, json};

const NOTIONS: [&str; 4] =
    ["Cartan decomposition", "restricted roots", "Satake diagram", "Vogan diagram"];

impl Notes {
    /// Adds rows without a Cartan decomposition, with the reason.
    pub(super) fn no_real_forms(&mut self, answer: &str, reason: &str, json: Value) {
        NOTIONS.iter().for_each(|notion| self.row(notion, answer, reason));
        if json.is_null() {
            self.null("real_forms", reason);
        } else {
            self.json.insert("real_forms".into(), json);
        }
    }

    /// Adds the Cartan decomposition of each simple ideal, with its restricted roots, its Satake
    /// diagram and its Vogan diagram.
    pub(super) fn real_forms(&mut self, ideals: &[RealIdeal]) {
        let form = |ideal: &RealIdeal| match &ideal.names[..] {
            [name] if !ideal.is_complex => RealForm::named(ideal.cartan_type, name),
            _ => None,
        };
        let forms: Vec<(&RealIdeal, Option<RealForm>)> =
            ideals.iter().map(|ideal| (ideal, form(ideal))).collect();
        let entries: Vec<Value> = forms.iter().map(|(ideal, form)| json(ideal, form)).collect();
        self.json.insert("real_forms".into(), json!(entries));
        let lines = |line: &dyn Fn(&RealIdeal, &Option<RealForm>) -> String| {
            let lines: Vec<String> = forms
                .iter()
                .map(|(ideal, form)| format!("{}: {}", ideal.names.join(" or "), line(ideal, form)))
                .collect();
            lines.join("\n")
        };
        self.row(
            NOTIONS[0],
            lines(&decomposition),
            "g = k + p, where k is the maximal compact subalgebra; character dim p - dim k",
        );
        self.row(
            NOTIONS[1],
            lines(&restricted),
            "of a maximal abelian subspace of p; multiplicities by increasing length",
        );
        self.row(NOTIONS[2], lines(&satake), "nodes numbered as in Bourbaki");
        self.row(
            NOTIONS[3],
            lines(&vogan),
            "of a maximally compact Cartan subalgebra; painted: noncompact imaginary root, arrows: \
             complex roots",
        );
    }
}

/// The dimension of `k` and of a maximal abelian subspace of `p`.
fn decomposition(ideal: &RealIdeal, form: &Option<RealForm>) -> String {
    let [plus, minus] = ideal.signature;
    let compact = match form {
        Some(form) => format!("{}, ", form.compact_type()),
        None if ideal.is_complex => format!("{}, ", ideal.cartan_type),
        None => String::new(),
    };
    let rank = match form {
        Some(form) => format!(", real rank {}", form.real_rank),
        None if ideal.is_complex => format!(", real rank {}", ideal.cartan_type.rank()),
        None => String::new(),
    };
    format!("k = {compact}dimension {minus}, character {}{rank}", plus as i64 - minus as i64)
}

fn restricted(ideal: &RealIdeal, form: &Option<RealForm>) -> String {
    match form {
        None if ideal.is_complex => format!("{}, multiplicity 2", ideal.cartan_type),
        None => "not determined".into(),
        Some(RealForm { restricted_type: Some(restricted), multiplicities, .. }) => {
            let many: Vec<String> = multiplicities.iter().map(|(_, m)| m.to_string()).collect();
            let word = if many.len() == 1 { "multiplicity" } else { "multiplicities" };
            format!("{restricted}, {word} {}", many.join(", "))
        }
        Some(_) => "none".into(),
    }
}

fn satake(ideal: &RealIdeal, form: &Option<RealForm>) -> String {
    match form {
        None if ideal.is_complex => {
            format!("two copies of {}, joined by arrows", one_line(ideal))
        }
        None => "not determined".into(),
        Some(form) => decorated(ideal, "black", &form.black, &form.arrows),
    }
}

fn vogan(ideal: &RealIdeal, form: &Option<RealForm>) -> String {
    match form {
        None if ideal.is_complex => {
            format!("two copies of {}, joined by arrows", one_line(ideal))
        }
        None => "not determined".into(),
        Some(RealForm { vogan, .. }) => {
            let painted: Vec<usize> = vogan.painted().into_iter().collect();
            decorated(ideal, "painted", &painted, &vogan.arrows())
        }
    }
}

/// A Dynkin diagram with marked nodes and arrows.
fn decorated(ideal: &RealIdeal, mark: &str, nodes: &[usize], arrows: &[(usize, usize)]) -> String {
    let mut parts = vec![one_line(ideal)];
    if !nodes.is_empty() {
        let nodes: Vec<String> = nodes.iter().map(ToString::to_string).collect();
        parts.push(format!("{mark} {}", nodes.join(", ")));
    }
    if !arrows.is_empty() {
        let arrows = arrows.iter().map(|(a, b)| format!("{a}<->{b}"));
        parts.push(format!("arrows {}", arrows.collect::<Vec<_>>().join(", ")));
    }
    if parts.len() == 1 {
        parts.push("all nodes white".into());
    }
    parts.join("; ")
}

/// The Dynkin diagram if it is one line, else the type.
fn one_line(ideal: &RealIdeal) -> String {
    let drawn = diagram(ideal.cartan_type);
    let long = drawn.contains('\n') || ideal.cartan_type.rank() == 1;
    if long { ideal.cartan_type.to_string() } else { drawn }
}

fn json(ideal: &RealIdeal, form: &Option<RealForm>) -> Value {
    let Some(form) = form else { return Value::Null };
    json!({
        "name": ideal.names.join(" or "),
        "compact_type": form.compact_type(),
        "compact_dimension": form.compact_dimension,
        "character": form.character(),
        "real_rank": form.real_rank,
        "restricted_type": form.restricted_type.map(|one| one.to_string()),
        "multiplicities": form.multiplicities.iter().map(|(_, m)| *m).collect::<Vec<_>>(),
        "black": form.black,
        "arrows": form.arrows,
        "vogan": {
            "painted": form.vogan.painted().into_iter().collect::<Vec<_>>(),
            "arrows": form.vogan.arrows(),
        },
    })
}
