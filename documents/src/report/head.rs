//! The header of a table: the space, its connection and its scalar.

use super::{OnChart, OnHomogeneousSpace, Table};
use crate::Coefficient;
use affinor::conventions;
use affinor_tensors::{Kind, Tolerance};
use serde_json::{Value, json};

/// A summary of the conventions.
pub(super) fn conventions() -> String {
    [conventions::BRACKET, conventions::AFFINITIES, conventions::CURVATURE].join("; ")
}

/// The meaning of brackets and curvature on a homogeneous space.
pub(super) const ISOTROPY: &str =
    "c^i_jk e_i is the part of [e_j, e_k] in m; R(e_k, e_l) e_j contains -[[e_k, e_l]_h, e_j]";

/// The rule by which a float counts as zero.
pub(super) fn zero(tolerance: Tolerance) -> String {
    let tolerance = tolerance.relative();
    format!("|v| <= {tolerance:.3e} times the sum of the absolute values of its terms")
}

/// The description of the scalar type float, with the rule by which a float counts as zero.
pub(super) fn float(zero: &str) -> String {
    format!("float; a component v is zero when {zero}")
}

/// The conventions in JSON, and the rule by which a float counts as zero.
pub(super) fn conventions_in_json(zero: Option<&str>) -> Value {
    let mut json = json!({
        "indices": "from 1",
        "structure": conventions::BRACKET,
        "affinities": conventions::AFFINITIES,
        "curvature": conventions::CURVATURE,
    });
    if let Some(zero) = zero {
        json["zero"] = zero.into();
    }
    json
}

impl<S: Coefficient> Table<S> {
    /// The lines of the header except the conventions, each with its label. The second line is the
    /// basis.
    pub(super) fn head(&self) -> Vec<(&'static str, String)> {
        let mut lines = vec![
            ("dimension", self.labels.len().to_string()),
            ("basis", printable_list(&self.labels)),
            ("frame", self.frame.into()),
            ("connection", printable(&self.connection_line())),
            ("scalar", self.scalar_line()),
        ];
        if let Some(OnChart { coordinates, fields }) = &self.chart {
            let equal = self.labels.iter().zip(fields).map(|(e, field)| format!("{e} = {field}"));
            lines.insert(2, ("coordinates", coordinates.join(", ")));
            if self.frame == "moving" {
                lines.insert(4, ("fields", equal.collect::<Vec<_>>().join(", ")));
            }
        }
        if let Some(OnHomogeneousSpace { embedding, complement }) = &self.homogeneous {
            let equal = self.labels.iter().zip(complement).map(|(e, x)| format!("{e} = {x}"));
            let complement = equal.collect::<Vec<_>>().join(", ");
            lines.insert(2, ("embedding", printable(embedding)));
            lines.insert(3, ("complement", printable(&complement)));
            lines.insert(4, ("isotropy", ISOTROPY.into()));
        }
        if !self.point.is_empty() {
            let point = self.point.iter().map(|(name, value)| format!("{name} = {value}"));
            lines.push(("point", printable(&point.collect::<Vec<_>>().join(", "))));
        }
        if self.independent {
            lines.push(("components", "one of each set that is equal by symmetry".into()));
        }
        lines
    }

    /// The rule by which a float counts as zero, if the scalar type is float.
    pub(super) fn zero_line(&self) -> Option<String> {
        (S::KIND == Kind::Float).then(|| zero(self.tolerance))
    }

    fn connection_line(&self) -> String {
        match &self.lambda {
            Some(lambda) if self.connection != "lambda" => {
                format!("{}, lambda = {lambda}", self.connection_words)
            }
            _ => self.connection_words.clone(),
        }
    }

    /// Whether some component is an irrational number.
    fn is_irrational(&self) -> bool {
        let mut values = self.tensors.iter().flat_map(|entry| entry.tensor.nonzero());
        values.any(|value| value.numerator_terms().iter().any(|(powers, _)| !powers.is_empty()))
    }

    fn scalar_line(&self) -> String {
        match (S::KIND, self.zero_line()) {
            (_, Some(zero)) => float(&zero),
            (Kind::Symbolic, _) if !self.parameters.is_empty() => {
                format!("symbolic in {}", printable_list(&self.parameters))
            }
            (Kind::Symbolic, _) if self.is_irrational() => {
                "symbolic: exact numbers with roots or pi".into()
            }
            (Kind::Symbolic, _) => "symbolic, though no parameter is left in it".into(),
            (kind, _) => kind_name(kind).into(),
        }
    }
}

/// The name of a scalar type in JSON and in headers.
pub(super) fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Exact => "exact",
        Kind::Symbolic => "symbolic",
        Kind::Float => "float",
    }
}

/// Names, separated by commas, with their control characters escaped.
pub(super) fn printable_list(names: &[String]) -> String {
    printable(&names.join(", "))
}

/// A name with its control characters escaped.
pub(super) fn printable(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for c in name.chars() {
        if c.is_control() { text.extend(c.escape_default()) } else { text.push(c) }
    }
    text
}
