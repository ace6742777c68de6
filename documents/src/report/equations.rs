//! Equations of motion in every format.

use super::components::plain;
use super::grid::{Cell, Grid, pretty};
use super::head::{kind_name, printable, printable_list};
use super::latex::{WIDTH, escape, width};
use super::text::fill;
use super::{Format, Report, html};
use crate::formula::mathml::{escaped, value};
use crate::page::page;
use affinor::geometry::equations::{EquationKind, Equations, Row, Variable};
use affinor::{Connection, Error, Geometry};
use affinor_tensors::text::{combination, is_sum};
use affinor_tensors::{Notation, Symbolic, Tensor};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Equations of motion with the space, the connection and the frame that they belong to.
#[derive(Clone, Debug)]
pub struct EquationReport<S> {
    /// The equations.
    pub equations: Equations<S>,
    /// The name of the space.
    pub name: String,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    /// The connection: its short name, and in words.
    pub connection: [String; 2],
    /// The parameters that the coefficients depend on, sorted.
    pub parameters: Vec<String>,
    /// The frame of the components, as [`Geometry::frame_name`] says.
    pub frame: &'static str,
    /// The coordinates of the chart, and the components `e^a_i` of the fields; none without a chart.
    pub position: Option<(Vec<String>, Tensor<S>)>,
    /// Whether the equations `DH/Dt = M` are the Euler-Poincare equations, which have `Lambda = c`.
    pub genuine: Option<bool>,
}

impl<S: Notation> EquationReport<S> {
    /// The equations of a geometry.
    pub fn new(equations: Equations<S>, geometry: &Geometry<S>) -> Self {
        let metric = geometry.metric().filter(|_| equations.kind() == EquationKind::EulerPoincare);
        let genuine = metric.map(|metric| {
            let plus = Connection::over(geometry.frame(), &S::one());
            let theirs = Equations::euler_poincare(&plus, metric);
            theirs.and_then(|theirs| theirs.agree_with(&equations)).unwrap_or(false)
        });
        let position = geometry
            .frame_origin()
            .fields()
            .map(|fields| (fields.chart().coordinates().to_vec(), fields.components().clone()));
        let rows = equations.rows();
        let parameters = {
            let fields = position.iter().flat_map(|(_, fields)| fields.nonzero());
            S::parameters_of(&mut rows.iter().flat_map(coefficients).chain(fields))
        };
        EquationReport {
            equations,
            name: geometry.name().into(),
            labels: geometry.frame().labels().to_vec(),
            connection: [geometry.kind().name().into(), geometry.kind().describe()],
            parameters: parameters.into_iter().collect(),
            frame: geometry.frame_name(),
            position,
            genuine,
        }
    }

    /// The motion of the position, `dx^a/dt = e^a_i w^i`: for every coordinate its name, and the
    /// right side.
    pub(super) fn positions(&self) -> Vec<(&str, Vec<(S, Variable)>)> {
        let Some((coordinates, fields)) = &self.position else { return vec![] };
        let along = match self.equations.kind() {
            EquationKind::Transport => Variable::Along,
            EquationKind::EulerPoincare | EquationKind::Autoparallel => Variable::State,
        };
        let right = |a: usize| {
            let terms = fields.components().filter(|(at, _)| at[0] == a);
            terms.map(|(at, value)| (value.clone(), along(at[1]))).collect()
        };
        coordinates.iter().enumerate().map(|(a, name)| (name.as_str(), right(a))).collect()
    }

    /// Checks that floats have stayed within their range.
    ///
    /// # Errors
    /// [`Error::Overflow`] with the first coefficient that is infinite or not a number.
    pub fn finite(&self) -> Result<(), Error> {
        for (at, row) in self.equations.rows().iter().enumerate() {
            if let Some(value) = coefficients(row).find(|value| !value.is_number()) {
                let component = format!("a coefficient of equation {}", at + 1);
                return Err(Error::Overflow { component, value: value.to_string() });
            }
        }
        Ok(())
    }

    /// The names of the variables, distinct from those of the parameters.
    fn names(&self) -> Names {
        let [state, other] = letters(self.equations.kind());
        let free = |name: &str| {
            let mut name = name.to_string();
            let taken = |name: &str| {
                let index = |p: &String| p.strip_prefix(name).map(str::to_string);
                let digits = |rest: String| rest.bytes().all(|b| b.is_ascii_digit());
                self.parameters.iter().filter_map(index).any(digits)
            };
            while taken(&name) {
                name.push('_');
            }
            name
        };
        Names { state: free(state), other: free(other), latex: false }
    }

    fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        fill(out, "", &[self.title()])?;
        for (title, line) in self.head(&names) {
            fill(out, &format!("  {title:13}"), &[line])?;
        }
        writeln!(out)?;
        for [left, right] in self.sides(&names) {
            fill(out, "  ", &[left, "=".into(), right])?;
        }
        Ok(())
    }

    /// The left and the right side of each equation.
    fn sides(&self, names: &Names) -> Vec<[String; 2]> {
        let positions = self.positions().into_iter().map(|(name, right)| {
            let right = right.iter().map(|(value, v)| (plain(value), names.variable(*v)));
            [format!("d{name}/dt"), combination(right)]
        });
        let rows = self.equations.rows();
        positions.chain(rows.iter().map(|row| names.row(row))).collect()
    }

    fn html(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        page(&self.title(), out, |out| {
            writeln!(out, "<main>\n<h1>{}</h1>", escaped(&self.title()))?;
            let lines = self.head(&names).into_iter();
            html::head(lines.map(|(title, line)| (title, escaped(&line))), out)?;
            writeln!(out, "<ul class=\"components\">")?;
            for [left, right] in self.sides(&names) {
                writeln!(out, "<li>{}</li>", value(&format!("{left} = {right}")))?;
            }
            writeln!(out, "</ul>\n</main>")
        })
    }

    fn markdown(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "## {}\n", self.title())?;
        for (title, line) in self.head(&self.names()) {
            writeln!(out, "- {title}: `{line}`")?;
        }
        writeln!(out, "\n```math\n\\begin{{aligned}}\n{}\n\\end{{aligned}}\n```", self.aligned())
    }

    fn latex(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "% A fragment: it needs \\usepackage{{amsmath}}.")?;
        writeln!(out, "\\subsection*{{{}}}", escape(&self.title()))?;
        writeln!(out, "{{\\allowdisplaybreaks\n\\begin{{align*}}\n{}", self.aligned())?;
        writeln!(out, "\\end{{align*}}}}")
    }

    fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        let mut rows = Vec::new();
        for (name, right) in self.positions() {
            for (value, variable) in right {
                let cells = [name.into(), "right".into(), plain(&value), names.variable(variable)];
                rows.push(cells.map(Cell::from).to_vec());
            }
        }
        for (at, row) in self.equations.rows().into_iter().enumerate() {
            let left = row.left.iter().map(|(v, j)| ("left", plain(v), names.rate(*j)));
            let right = row.right.iter().map(|(v, p)| ("right", plain(v), names.product(p)));
            for (side, coefficient, product) in left.chain(right) {
                let cells = [(at + 1).to_string(), side.into(), coefficient, product];
                rows.push(cells.map(Cell::from).to_vec());
            }
        }
        let header = ["equation", "side", "coefficient", "product"];
        Grid::new("", &header, rows, Value::Null).write(Format::Csv, out)
    }

    fn json(&self) -> Value {
        let names = self.names();
        let value = |v: &S| Value::from(plain(v));
        let equations = self.equations.rows();
        let equations = equations.iter().map(|row| {
            let left = row.left.iter().map(|(v, j)| json!([value(v), names.rate(*j)]));
            let right = row.right.iter().map(|(v, product)| {
                let factors = product.iter().map(|variable| names.variable(*variable));
                json!([value(v), factors.collect::<Vec<_>>()])
            });
            json!({ "left": left.collect::<Vec<_>>(), "right": right.collect::<Vec<_>>() })
        });
        let positions = self.positions().into_iter().map(|(name, right)| {
            let right = right.iter().map(|(v, along)| json!([value(v), [names.variable(*along)]]));
            json!({ "coordinate": name, "right": right.collect::<Vec<_>>() })
        });
        json!({
            "schema": "affinor.equations/1",
            "name": self.name,
            "motion": self.equations.kind().name(),
            "statement": self.equations.kind().statement(),
            "connection": { "name": self.connection[0] },
            "scalar": kind_name(S::KIND),
            "basis": self.labels,
            "parameters": self.parameters,
            "genuine": self.genuine,
            "positions": positions.collect::<Vec<_>>(),
            "equations": equations.collect::<Vec<_>>(),
        })
    }

    pub(super) fn title(&self) -> String {
        let kind = match self.equations.kind() {
            EquationKind::EulerPoincare if self.genuine == Some(false) => {
                "DH/Dt = M (not the Euler-Poincare equations)"
            }
            EquationKind::EulerPoincare => "Euler-Poincare equations",
            EquationKind::Autoparallel => "Autoparallels",
            EquationKind::Transport => "Parallel transport",
        };
        format!("{kind} of {}", printable(&self.name))
    }

    fn head(&self, names: &Names) -> Vec<(&'static str, String)> {
        let Names { state, other, .. } = names;
        let (what, beside) = match self.equations.kind() {
            EquationKind::EulerPoincare => ("the velocity", Some("the external covector")),
            EquationKind::Autoparallel => ("the velocity", None),
            EquationKind::Transport => {
                ("the transported vector", Some("the velocity of the curve"))
            }
        };
        let frame = match &self.position {
            None => format!("the {} frame", self.frame),
            Some((coordinates, _)) => format!("the frame over {}", coordinates.join(", ")),
        };
        let beside = beside.map_or(String::new(), |beside| format!("; {other} {beside}"));
        vec![
            ("basis", printable_list(&self.labels)),
            ("connection", self.connection[1].clone()),
            ("statement", self.equations.kind().statement().into()),
            ("unknowns", format!("{state} {what}{beside}; in {frame}")),
        ]
    }

    /// The lines of an `aligned` environment.
    fn aligned(&self) -> String {
        let Names { state, other, .. } = self.names();
        let [state, other] = [state, other].map(|name| Symbolic::parameter(&name).latex());
        let names = Names { state, other, latex: true };
        let positions = self.positions().into_iter().map(|(name, right)| {
            let right = right.iter().map(|(value, v)| (value, names.variable(*v)));
            let name = Symbolic::parameter(name).latex();
            latex_equation(&[format!("\\dot{{{name}}}")], &latex_terms(right))
        });
        let rows = self.equations.rows().into_iter().map(|row| {
            let rates = row.left.iter().map(|(value, j)| (value, names.rate(*j)));
            let right = row.right.iter().map(|(value, factors)| (value, names.product(factors)));
            latex_equation(&latex_terms(rates), &latex_terms(right))
        });
        positions.chain(rows).collect::<Vec<_>>().join(" \\\\\n")
    }
}

impl<S: Notation> Report for EquationReport<S> {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Text => self.text(out),
            Format::Markdown => self.markdown(out),
            Format::Latex => self.latex(out),
            Format::Csv => self.csv(out),
            Format::Json => pretty(&self.json(), out),
            Format::Html => self.html(out),
        }
    }
}

/// The letters of the unknown and of the given variable.
pub(super) fn letters(motion: EquationKind) -> [&'static str; 2] {
    match motion {
        EquationKind::EulerPoincare => ["Omega", "M"],
        EquationKind::Autoparallel => ["v", ""],
        EquationKind::Transport => ["u", "w"],
    }
}

/// The coefficients of both sides.
fn coefficients<S>(row: &Row<S>) -> impl Iterator<Item = &S> {
    row.left.iter().map(|(v, _)| v).chain(row.right.iter().map(|(v, _)| v))
}

/// The names of the variables, in text or in LaTeX.
struct Names {
    state: String,
    other: String,
    latex: bool,
}

impl Names {
    fn rate(&self, j: usize) -> String {
        match self.latex {
            true => format!("\\dot{{{}}}^{{{}}}", self.state, j + 1),
            false => format!("d{}{}/dt", self.state, j + 1),
        }
    }

    fn variable(&self, variable: Variable) -> String {
        let (name, mark, j) = match variable {
            Variable::State(j) => (&self.state, '^', j + 1),
            Variable::Along(j) => (&self.other, '^', j + 1),
            Variable::Force(j) => (&self.other, '_', j + 1),
        };
        if self.latex { format!("{name}{mark}{{{j}}}") } else { format!("{name}{j}") }
    }

    fn product(&self, product: &[Variable]) -> String {
        let names: Vec<String> = product.iter().map(|v| self.variable(*v)).collect();
        match product {
            [a, b] if a == b && self.latex => format!("({})^2", names[0]),
            [a, b] if a == b => format!("{}^2", names[0]),
            _ => names.join(if self.latex { " " } else { "*" }),
        }
    }

    /// Both sides of an equation.
    fn row<S: Notation>(&self, row: &Row<S>) -> [String; 2] {
        let left = row.left.iter().map(|(value, j)| (plain(value), self.rate(*j)));
        let right = row.right.iter().map(|(value, factors)| (plain(value), self.product(factors)));
        [combination(left), combination(right)]
    }
}

/// `left = right` in LaTeX; a long right side takes several lines.
fn latex_equation(left: &[String], right: &[String]) -> String {
    let mut text = format!("{} &= ", if left.is_empty() { "0".into() } else { left.join(" ") });
    let mut column = width(&text);
    for (position, term) in right.iter().enumerate() {
        if position > 0 && column + width(term) > WIDTH {
            text.push_str("\\\\\n&\\quad ");
            column = 8;
        } else if position > 0 {
            text.push(' ');
        }
        column += width(term) + 1;
        text.push_str(term);
    }
    if right.is_empty() { text + "0" } else { text }
}

/// The terms `coefficient factor` in LaTeX, each with its sign; the first has no plus sign.
fn latex_terms<'v, S: Notation + 'v>(
    terms: impl IntoIterator<Item = (&'v S, String)>,
) -> Vec<String> {
    let mut written: Vec<String> = Vec::new();
    for (value, factor) in terms {
        let sum = is_sum(&value.to_string());
        let fraction = value.latex().trim_start_matches('-').starts_with("\\frac");
        let (sign, size) = match value.is_negative() && (!sum || fraction) {
            true => ("-", (-value.clone()).latex()),
            false => ("+", value.latex()),
        };
        let size = match size.as_str() {
            "1" => String::new(),
            size if sum && !fraction => format!("\\left({size}\\right) "),
            // the space ends the argument of the function
            size if size.contains("\\sin") || size.contains("\\cos") => format!("{size} \\, "),
            size => format!("{size} "),
        };
        written.push(match (written.is_empty(), sign) {
            (true, "+") => format!("{size}{factor}"),
            (true, _) => format!("-{size}{factor}"),
            (false, sign) => format!("{sign} {size}{factor}"),
        });
    }
    written
}
