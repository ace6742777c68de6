//! Copies that recompute a report: the space as a definition file, and the lines that load the
//! file.

use super::Refusal;
use affinor::geometry::ConnectionKind;
use affinor_documents::input::InputError;
use affinor_documents::space::{Definition, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::text::combination;
use affinor_tensors::{Tensor, Tolerance};
use std::fmt::Write;

/// A kind of copy that recomputes the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Copy {
    /// The definition, or the problem of a motion, as a file.
    Toml,
    /// The command of the program `affinor` on the file.
    Command,
    /// Two lines of Python that load the file and print the report.
    Python,
}

impl Copy {
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "toml" => Some(Copy::Toml),
            "command" => Some(Copy::Command),
            "python" => Some(Copy::Python),
            _ => None,
        }
    }

    /// The copy of a report; `toml` is the text of the file, `show` a list of tensors, and `kind` a kind of equations.
    pub fn write(self, report: &str, toml: String, show: &str, kind: &str) -> String {
        match self {
            Copy::Toml => toml,
            Copy::Command => match (report, show) {
                ("motion", _) => "affinor simulate problem.toml\n".into(),
                ("equations", _) => format!("affinor equations equations.toml --kind {kind}\n"),
                ("table", show) if !show.is_empty() => {
                    format!("affinor table table.toml --show \"{show}\"\n")
                }
                _ => format!("affinor {report} {report}.toml\n"),
            },
            Copy::Python => {
                let geometry = format!("affinor.Geometry(\"{report}.toml\")");
                let line = match (report, show) {
                    ("motion", _) => "motion = affinor.simulate(\"problem.toml\"); \
                                      print({name: float(motion[name][-1]) for name in motion})"
                        .into(),
                    ("check", _) => format!("print(*{geometry}.check(), sep=\"\\n\")"),
                    ("info", _) => "print(affinor.LieAlgebra(\"info.toml\").info())".into(),
                    ("properties", _) => format!("print({geometry}.properties())"),
                    ("equations", _) => format!("print({geometry}.equations(\"{kind}\"))"),
                    (_, "") => format!("print({geometry}.table())"),
                    (_, show) => format!("print({geometry}.table(\"{show}\"))"),
                };
                format!("import affinor\n{line}\n")
            }
        }
    }
}

/// A space with its connection and metric as a definition file.
pub(super) fn definition(space: &Space, with_connection: bool) -> Result<String, Refusal> {
    if space.definition.is_on_chart() {
        return Err(Refusal::new("a chart is copied from its own definition"));
    }
    let (definition, kind) = (&space.definition, space.kind(ScalarChoice::Exact)?);
    Ok(over_kind!(kind, S => file::<S>(definition, with_connection))?)
}

fn file<S: Coefficient>(
    definition: &Definition,
    with_connection: bool,
) -> Result<String, InputError> {
    let algebra = definition.algebra::<S>(Tolerance::default())?;
    let quoted = |text: &str| toml_string(text);
    let list =
        |words: &[String]| words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(", ");
    let mut text =
        format!("name  = {}\nbasis = [{}]\n", quoted(&definition.name), list(algebra.labels()));
    let parameters = definition.parameters();
    if !parameters.is_empty() {
        let _ = writeln!(text, "parameters = [{}]", list(&parameters));
    }
    text += "# [i, j, k, v]: [e_i, e_j] = v e_k + ..\nstructure_constants = [\n";
    for (at, value) in algebra.structure_constants().components().filter(|(at, _)| at[1] < at[2]) {
        let value = quoted(&value.to_string());
        let _ = writeln!(text, "  [{}, {}, {}, {value}],", at[1] + 1, at[2] + 1, at[0] + 1);
    }
    text += "]\n";
    if !with_connection {
        return Ok(text);
    }
    let geometry = definition.geometry::<S>(Tolerance::default())?;
    if let Some(metric) = geometry.metric() {
        text += "metric = [\n";
        let n = algebra.labels().len();
        for i in 0..n {
            let row: Vec<String> =
                (0..n).map(|j| quoted(&metric.components().get(&[i, j]).to_string())).collect();
            let _ = writeln!(text, "  [{}],", row.join(", "));
        }
        text += "]\n";
    }
    match geometry.kind() {
        ConnectionKind::Canonical(which) => text += &format!("connection = \"{}\"\n", which.name()),
        ConnectionKind::LeviCivita => text += "connection = \"levi-civita\"\n",
        ConnectionKind::Family(lambda) => {
            text += &format!("connection = {}\n", quoted(&format!("lambda = {lambda}")))
        }
        _ => affinities(&mut text, algebra.labels(), geometry.connection().affinities()),
    }
    Ok(text)
}

/// Statements such as `nabla[x, y] = 1/2*z`.
fn affinities<S: Coefficient>(text: &mut String, labels: &[String], gamma: &Tensor<S>) {
    *text += "affinities = \"\"\"\n";
    for (j, first) in labels.iter().enumerate() {
        for (k, second) in labels.iter().enumerate() {
            let terms = (0..labels.len()).map(|i| (i, gamma.get(&[i, j, k])));
            let terms: Vec<_> = terms.filter(|(_, value)| !value.is_zero()).collect();
            if !terms.is_empty() {
                let sum =
                    combination(terms.into_iter().map(|(i, value)| (value, labels[i].clone())));
                let _ = writeln!(text, "nabla[{first}, {second}] = {sum}");
            }
        }
    }
    *text += "\"\"\"\n";
}

/// A string of TOML, in which control characters are escaped.
fn toml_string(text: &str) -> String {
    // JSON escapes are valid in TOML, but JSON does not escape the last control character
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}
