//! The space of a report as a definition file, and programs in Python and Rust that print the report anew.

use super::Refusal;
use affinor::geometry::ConnectionKind;
use affinor_documents::definition::{Definition, InputError, Reading, ScalarChoice, Space, Work};
use affinor_tensors::text::combination;
use affinor_tensors::{Notation, Tensor, Tolerance};
use std::fmt::Write;

/// A language of copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Language {
    /// A file for the program `affinor`.
    Toml,
    Python,
    Rust,
}

impl Language {
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "toml" => Some(Language::Toml),
            "python" => Some(Language::Python),
            "rust" => Some(Language::Rust),
            _ => None,
        }
    }

    /// The report of a file: a problem for `motion`, else a definition.
    pub fn write(
        self,
        report: &str,
        text: &str,
        show: &str,
        kind: &str,
    ) -> Result<String, Refusal> {
        let known = ["table", "check", "info", "properties", "equations", "motion"];
        if !known.contains(&report) {
            return Err(Refusal::new(format!(
                "`{report}` is copied as text, not as a file or program"
            )));
        }
        Ok(match self {
            Language::Toml => text.into(),
            Language::Python => python(report, text, show, kind),
            Language::Rust => rust(report, text, show, kind),
        })
    }
}

/// A space with its connection and metric as a definition file.
pub(super) fn definition(space: &Space, with_connection: bool) -> Result<String, Refusal> {
    if space.definition.is_on_chart() {
        return Err(Refusal::new("a chart is copied from its own definition"));
    }
    Ok(space.run(ScalarChoice::Exact, Tolerance::default(), File { with_connection })?)
}

struct File {
    with_connection: bool,
}

impl Work for File {
    type Output = String;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<String, InputError> {
        let algebra = definition.algebra(reading)?;
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
        for (at, value) in algebra.structure().components().filter(|(at, _)| at[1] < at[2]) {
            let value = quoted(&value.to_string());
            let _ = writeln!(text, "  [{}, {}, {}, {value}],", at[1] + 1, at[2] + 1, at[0] + 1);
        }
        text += "]\n";
        if !self.with_connection {
            return Ok(text);
        }
        let geometry = definition.geometry(reading)?;
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
            ConnectionKind::Canonical(which) => {
                text += &format!("connection = \"{}\"\n", which.name())
            }
            ConnectionKind::LeviCivita => text += "connection = \"levi-civita\"\n",
            ConnectionKind::Family(lambda) => {
                text += &format!("connection = {}\n", quoted(&format!("lambda = {lambda}")))
            }
            _ => affinities(&mut text, algebra.labels(), geometry.connection().gamma()),
        }
        Ok(text)
    }
}

/// Statements such as `nabla[x, y] = 1/2*z`.
fn affinities<S: Notation>(text: &mut String, labels: &[String], gamma: &Tensor<S>) {
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
    // JSON escapes a part of what TOML does, in the same way, but not the last control character
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}

fn python(report: &str, text: &str, show: &str, kind: &str) -> String {
    let print = match report {
        "motion" => "motion = affinor.simulate(tomllib.loads(TEXT))\nfor name in motion:\n    print(name, motion[name][-1])".into(),
        "check" => "for check in affinor.Geometry(tomllib.loads(TEXT)).check():\n    print(check)".into(),
        "info" => "print(affinor.LieAlgebra(tomllib.loads(TEXT)).info())".into(),
        "properties" => "print(affinor.Geometry(tomllib.loads(TEXT)).properties())".into(),
        "equations" => format!("print(affinor.Geometry(tomllib.loads(TEXT)).equations({kind:?}))"),
        _ if show.trim().is_empty() => "print(affinor.Geometry(tomllib.loads(TEXT)).table())".into(),
        _ => format!("print(affinor.Geometry(tomllib.loads(TEXT)).table({show:?}))"),
    };
    let literal = match text.contains("'''") || text.ends_with(['\'', '\\']) {
        true => serde_json::Value::from(text).to_string(),
        false => format!("r'''\n{text}'''"),
    };
    format!("import tomllib\n\nimport affinor\n\nTEXT = {literal}\n\n{print}\n")
}

fn rust(report: &str, text: &str, show: &str, kind: &str) -> String {
    // more signs than any run of them in the text
    let fence = "#".repeat(
        1 + text
            .split('"')
            .map(|part| part.len() - part.trim_start_matches('#').len())
            .max()
            .unwrap_or(0),
    );
    let head = format!("const TEXT: &str = r{fence}\"\n{text}\"{fence};\n");
    if report == "motion" {
        return format!(
            "use affinor_documents::problem::Problem;\n\n{head}\nfn main() -> Result<(), Box<dyn std::error::Error>> {{\n    \
             let problem = Problem::parse(\"problem.toml\", TEXT)?;\n    let ready = problem.motion(0)?;\n    \
             let columns = ready.columns.clone();\n    let (mut integration, mut last) = (problem.integrate(ready), vec![]);\n    \
             loop {{\n        let step = integration.step()?;\n        last = step.rows.last().cloned().unwrap_or(last);\n        \
             if step.done {{\n            break;\n        }}\n    }}\n    \
             for (column, value) in columns.iter().zip(last) {{\n        println!(\"{{}} {{value}}\", column.name);\n    }}\n    Ok(())\n}}\n"
        );
    }
    let (names, work) = match report {
        "check" => ("certificate", "let checks = affinor_documents::certificate::certify(&definition, &reading, &|_| ())?;\n    let report = certificate(&definition.name, &checks, None);".to_string()),
        "info" => ("Info", "let report = Info::of(&definition, &|_| ())?;".into()),
        "properties" => ("Properties", "let report = Properties::of(&definition)?;".into()),
        "equations" => ("EquationReport", format!(
            "let geometry = definition.geometry(&reading)?;\n    let kind = EquationKind::from_name({kind:?}).ok_or(\"no such equations\")?;\n    \
             let equations = Equations::new(kind, geometry.connection(), geometry.metric())?;\n    let report = EquationReport::new(equations, &geometry);")),
        _ => ("Quantity, Table", {
            let shown = if show.trim().is_empty() { "Quantity::shown()".to_string() } else { format!("Quantity::list({show:?})?") };
            format!("let report = Table::new(&definition.geometry(&reading)?, &{shown})?;")
        }),
    };
    let (reading, imports) = match report {
        "info" | "properties" => (String::new(), "use affinor_documents::definition::Definition;\n".to_string()),
        _ => (
            "    let exact = |value: &Symbolic| Some(value.clone());\n    let reading = Reading { convert: &exact, tolerance: Tolerance::default() };\n".into(),
            "use affinor_documents::definition::{Definition, Reading};\n".into(),
        ),
    };
    let tensors =
        if reading.is_empty() { "" } else { "use affinor_tensors::{Symbolic, Tolerance};\n" };
    let equations = if report == "equations" {
        "use affinor::geometry::equations::{EquationKind, Equations};\n"
    } else {
        ""
    };
    format!(
        "{equations}{imports}use affinor_documents::report::{{Format, Report, {names}}};\n{tensors}\n{head}\n\
         fn main() -> Result<(), Box<dyn std::error::Error>> {{\n    let definition = Definition::parse(\"space.toml\", TEXT)?;\n{reading}    {work}\n    \
         report.write(Format::Text, &mut std::io::stdout())?;\n    Ok(())\n}}\n"
    )
}
