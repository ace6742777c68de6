//! The rows and the keys of a report, in the order in which they are computed.

use super::rows::Rows;
use super::{Cell, Grid, Info, LONGEST, SCHEMA, SHOWN, certainty};
use super::{printable, printable_list};
use affinor::algebra::structure::{
    Certified, GroundField, Killing, MAX_BETTI, MAX_DERIVATIONS, Subspace,
};
use affinor_tensors::Kind;
use affinor_tensors::linear::Row;
use affinor_tensors::text::combination;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The rows and the keys of a report.
pub(super) struct Notes {
    pub labels: Vec<String>,
    rows: Vec<Vec<Cell>>,
    pub json: Map<String, Value>,
    /// The reason for each key whose value is null.
    reasons: Map<String, Value>,
    matrices: BTreeMap<&'static str, Rows>,
}

impl Notes {
    pub(super) fn new(labels: &[String]) -> Self {
        let labels = labels.iter().map(|label| printable(label)).collect();
        Notes {
            labels,
            rows: vec![],
            json: Map::new(),
            reasons: Map::new(),
            matrices: BTreeMap::new(),
        }
    }

    pub(super) fn row(&mut self, notion: &str, answer: impl Into<Cell>, witness: &str) {
        let answer: Cell = answer.into();
        let is_prose = !answer.is_drawn;
        let answer = Cell { is_prose, ..answer };
        self.rows.push(vec![notion.into(), answer, Cell::prose(witness)]);
    }

    /// Adds a row for a missing answer. The answer is `-` if it is not computed.
    pub(super) fn absent(&mut self, notion: &str, key: &str, answer: &str, reason: &str) {
        self.row(notion, answer, reason);
        self.null(key, reason);
    }

    /// Adds a key whose value is null, with the reason.
    pub(super) fn null(&mut self, key: &str, reason: &str) {
        self.json.insert(key.into(), Value::Null);
        self.reason(key, reason);
    }

    /// Adds a number, or the reason why it is missing.
    pub(super) fn number(&mut self, key: &str, number: Option<usize>, reason: &str) {
        self.json.insert(key.into(), json!(number));
        if number.is_none() {
            self.reason(key, reason);
        }
    }

    /// Stores the reason why a key, or a part of its value, is null.
    pub(super) fn reason(&mut self, key: &str, reason: &str) {
        self.reasons.insert(key.into(), reason.into());
    }

    pub(super) fn flags(&mut self, flags: &[(&str, Option<bool>, Option<String>)]) {
        let of = |wanted: bool| {
            let named = flags.iter().filter(|(_, value, _)| *value == Some(wanted));
            let words = named.map(|(name, _, more)| match more {
                Some(more) => format!("{name} ({more})"),
                None => name.to_string(),
            });
            let words = words.collect::<Vec<_>>().join(", ");
            if words.is_empty() { "-".into() } else { words }
        };
        self.row("it is", of(true), "");
        self.row("it is not", of(false), "");
        let open: Vec<_> = flags.iter().filter(|(_, value, _)| value.is_none()).collect();
        if !open.is_empty() {
            let names: Vec<_> = open.iter().map(|(name, ..)| *name).collect();
            let why = open.iter().map(|(name, _, why)| {
                format!("{name}: {}", why.as_deref().unwrap_or("not computed"))
            });
            self.row("not decided", names.join(", "), &why.collect::<Vec<_>>().join(", "));
        }
        for (name, value, why) in flags {
            self.json.insert(name.to_string(), json!(value));
            if value.is_none() {
                self.reason(name, why.as_deref().unwrap_or("not computed"));
            }
        }
    }

    pub(super) fn series<S: GroundField>(
        &mut self,
        title: &str,
        key: &str,
        series: &[Subspace<S>],
    ) {
        let dimensions: Vec<usize> = series.iter().map(Subspace::dimension).collect();
        let text: Vec<String> = dimensions.iter().map(usize::to_string).collect();
        self.row(title, text.join(", "), "dimensions, until stable");
        self.json.insert(key.into(), json!(dimensions));
    }

    pub(super) fn subspace<S: GroundField>(
        &mut self,
        title: &str,
        key: &'static str,
        subspace: &Subspace<S>,
        why: &str,
    ) {
        let dimension = subspace.dimension();
        let basis: Vec<String> =
            subspace.basis().iter().take(SHOWN).map(|row| self.vector(row)).collect();
        let basis = basis.join(", ");
        let answer = match dimension {
            0 => "0".to_string(),
            all if all == subspace.ambient() => "the whole algebra".into(),
            1..=SHOWN if basis.len() <= LONGEST => format!("dimension {dimension}: {basis}"),
            _ => format!("dimension {dimension}; basis in --format json"),
        };
        let trivial = dimension == 0 || dimension == subspace.ambient();
        self.row(title, answer, if trivial { "" } else { why });
        let rows = subspace.basis().iter().map(Vec::as_slice);
        self.matrices.insert(key, Rows::new("basis", subspace.ambient(), rows));
        self.json.insert(key.into(), json!({ "dimension": dimension }));
    }

    pub(super) fn vector<S: GroundField>(&self, row: &Row<S>) -> String {
        combination(row.iter().map(|(at, value)| (value.to_string(), self.labels[*at].clone())))
    }

    pub(super) fn killing<S: GroundField>(&mut self, killing: &Killing<S>) {
        let (rank, signature) = (killing.rank(), killing.signature());
        let determinant = killing.determinant().to_string();
        let signs = match signature {
            Some([plus, minus, zero]) => format!("signature ({plus}, {minus}, {zero})"),
            None => "signature not known for all parameters".into(),
        };
        let size = determinant.len();
        let shown =
            if size > 40 { format!("a number of {size} characters") } else { determinant.clone() };
        let values: Vec<String> = killing.values.iter().take(SHOWN).map(S::to_string).collect();
        let short = killing.values.len() <= SHOWN && values.concat().len() <= 80;
        let witness = if short { format!("diagonal {}", values.join(", ")) } else { String::new() };
        let answer = format!("rank {rank}, {signs}, determinant {shown}");
        self.row("Killing form", answer, &witness);
        let matrix = &killing.matrix;
        let rows =
            Rows::new("matrix", matrix.columns(), (0..matrix.rows()).map(|at| matrix.row(at)));
        self.matrices.insert("killing", rows);
        let killing = json!({ "rank": rank, "signature": signature, "determinant": determinant });
        self.json.insert("killing".into(), killing);
    }

    pub(super) fn derivations(&mut self, counted: Option<Certified>, inner: usize) {
        let Some(Certified { dimension: all, proved }) = counted else {
            let why = format!("not counted beyond dimension {MAX_DERIVATIONS} unless reductive");
            self.absent("derivations", "derivations", "-", &why);
            return;
        };
        let outer = all - inner;
        let text = format!("dimension {all}: {inner} inner, {outer} outer");
        let why = format!("the dimension of the automorphism group; {}", certainty(proved));
        self.row("derivations", text, &why);
        let json = json!({ "dimension": all, "inner": inner, "outer": outer });
        self.json.insert("derivations".into(), json);
    }

    pub(super) fn betti(&mut self, betti: Option<(&[u64], bool)>, reductive: bool) {
        let Some((numbers, proved)) = betti else {
            let why = match reductive {
                true => "one is beyond 2^53".into(),
                false => format!(
                    "not computed beyond dimension {MAX_BETTI}, nor for too many forms, unless reductive"
                ),
            };
            self.absent("Betti numbers", "betti", "-", &why);
            return;
        };
        let text: Vec<String> = numbers.iter().map(u64::to_string).collect();
        let how = match numbers.len() > SHOWN && reductive {
            true => "by the exponents",
            false => certainty(proved),
        };
        let why = format!("Chevalley-Eilenberg, trivial coefficients; {how}");
        self.row("Betti numbers", text.join(", "), &why);
        self.json.insert("betti".into(), json!(numbers));
    }

    pub(super) fn count(
        &mut self,
        title: &str,
        key: &str,
        count: Option<Certified>,
        meaning: &str,
    ) {
        let Some(Certified { dimension, proved }) = count else {
            let why = format!("not counted beyond dimension {MAX_DERIVATIONS} unless reductive");
            self.absent(title, key, "-", &why);
            return;
        };
        self.row(title, dimension.to_string(), &format!("{meaning}; {}", certainty(proved)));
        self.json.insert(key.into(), json!(dimension));
    }

    pub(super) fn finish(
        self,
        name: &str,
        dimension: usize,
        kind: Kind,
        parameters: &[String],
    ) -> Info {
        let mut json = Map::new();
        let generic = !parameters.is_empty();
        json.insert("schema".into(), SCHEMA.into());
        json.insert("name".into(), name.into());
        json.insert("basis".into(), json!(self.labels));
        json.insert("parameters".into(), json!(parameters));
        json.insert("generic".into(), json!(generic));
        json.insert("dimension".into(), json!(dimension));
        json.extend(self.json);
        json.insert("reasons".into(), self.reasons.into());
        let field = match (kind, generic) {
            (Kind::Symbolic, true) => format!(
                "rational functions of {}; every answer holds for generic values",
                printable_list(parameters)
            ),
            _ => "rational numbers; the answers hold over the real numbers".into(),
        };
        let head: Vec<(&str, Cell)> = vec![
            ("dimension", dimension.to_string().into()),
            ("basis", Cell::prose(&self.labels.join(", "))),
            ("field", field.into()),
        ];
        let title = format!("Structure of {}", printable(name));
        let header = ["notion", "answer", "witness"];
        let grid = Grid::new(title, &header, self.rows, Value::Null).with_head(head);
        Info { grid, json, matrices: self.matrices }
    }
}
