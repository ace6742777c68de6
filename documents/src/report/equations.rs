//! Equations of motion in every format.

use super::components::plain;
use super::grid::{Cell, Grid, pretty};
use super::head::{kind_name, printable, printable_list};
use super::latex::WIDTH;
use super::text::fill;
use super::{Format, Report, html};
use crate::Coefficient;
use crate::formula::lines::{chain, pieces, width};
use crate::formula::mathml::{self, WIDE, escaped};
use crate::formula::{self, Accent, Brackets, Node, Row, sum, tex, value};
use crate::page::page;
use affinor::geometry::equations::{self, EquationKind, Equations, Variable};
use affinor::{Connection, Error, Geometry};
use affinor_tensors::Tensor;
use affinor_tensors::text::combination;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Equations of motion, with their space, connection and frame.
#[derive(Clone, Debug)]
pub struct EquationReport<S> {
    /// The equations.
    pub equations: Equations<S>,
    /// The name of the space.
    pub name: String,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    /// The connection: its short name, and its description.
    pub connection: [String; 2],
    /// The parameters of the coefficients, sorted.
    pub parameters: Vec<String>,
    /// The name of the frame of the components ([`Geometry::frame_name`]).
    pub frame: &'static str,
    /// The coordinates of the chart, and the components `e^a_i` of the fields; `None` without a
    /// chart.
    pub position: Option<(Vec<String>, Tensor<S>)>,
    /// For equations `DH/Dt = M`, whether they are the Euler-Poincare equations, which belong to
    /// the connection `Lambda = c`.
    pub genuine: Option<bool>,
}

impl<S: Coefficient> EquationReport<S> {
    /// The equations of a geometry.
    pub fn new(equations: Equations<S>, geometry: &Geometry<S>) -> Self {
        let metric = geometry.metric().filter(|_| equations.kind() == EquationKind::EulerPoincare);
        let genuine = metric.map(|metric| {
            let plus = Connection::in_frame(geometry.frame(), &S::one());
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
            connection: [geometry.connection_name().into(), geometry.describe_connection()],
            parameters: parameters.into_iter().collect(),
            frame: geometry.frame_name(),
            position,
            genuine,
        }
    }

    /// The equations of the position, `dx^a/dt = e^a_i w^i`: for every coordinate, its name and the
    /// right-hand side.
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
    /// [`Error::Overflow`] with the first coefficient that is infinite or NaN.
    pub fn finite(&self) -> Result<(), Error> {
        for (at, row) in self.equations.rows().iter().enumerate() {
            if let Some(value) = coefficients(row).find(|value| !value.is_number()) {
                let component = format!("a coefficient of equation {}", at + 1);
                return Err(Error::Overflow { component, value: value.to_string() });
            }
        }
        Ok(())
    }

    /// Chooses names of the variables that differ from the names of the parameters.
    fn names(&self) -> Names {
        let [state, other] = letters(self.equations.kind());
        let coordinates = self.position.iter().flat_map(|(coordinates, _)| coordinates);
        let taken: Vec<&String> = self.parameters.iter().chain(coordinates).collect();
        let free = |name: &str| {
            let mut name = name.to_string();
            let is_taken = |name: &str| {
                let index = |p: &&String| p.strip_prefix(name).map(str::to_string);
                let digits = |rest: String| rest.bytes().all(|b| b.is_ascii_digit());
                taken.iter().filter_map(index).any(digits)
            };
            while is_taken(&name) {
                name.push('_');
            }
            name
        };
        let is_free = |name: &&str| !taken.iter().any(|other| other == name);
        let time = TIMES.into_iter().find(is_free).map_or_else(|| free(TIMES[0]), String::from);
        Names { state: free(state), other: free(other), time }
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

    /// The left-hand and right-hand sides of each equation.
    fn sides(&self, names: &Names) -> Vec<[String; 2]> {
        let positions = self.positions().into_iter().map(|(name, right)| {
            let right = right.iter().map(|(value, v)| (plain(value), names.variable(*v)));
            [format!("d{name}/d{}", names.time), combination(right)]
        });
        let rows = self.equations.rows();
        positions.chain(rows.iter().map(|row| names.row(row))).collect()
    }

    fn html(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        page(&self.title(), out, |out| {
            writeln!(out, "<main>\n<h1>{}</h1>", escaped(&self.title()))?;
            let lines = self.head(&names).into_iter().map(|(title, line)| match title {
                "statement" => {
                    let inline = |text: &String| mathml::inline(&formula::formula(text));
                    (title, self.statement(&names).each_ref().map(inline).join(": "))
                }
                _ => (title, escaped(&line)),
            });
            html::head(lines, out)?;
            let formulas: Vec<Row> = self.formulas().into_iter().map(chain).collect();
            writeln!(out, "{}\n</main>", html::list(&formulas, WIDE))
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
        writeln!(out, "\\subsection*{{{}}}", tex::escaped(&self.title()))?;
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
            "statement": self.statement(&names).join(": "),
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
        let Names { state, other, time } = names;
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
        let time = match time.as_str() {
            "t" => String::new(),
            other => format!("; {other} the parameter of the curve"),
        };
        vec![
            ("basis", printable_list(&self.labels)),
            ("connection", self.connection[1].clone()),
            ("statement", self.statement(names).join(": ")),
            ("unknowns", format!("{state} {what}{beside}{time}; in {frame}")),
        ]
    }

    /// The law of the equations, and the law in components, with the chosen name of the curve
    /// parameter.
    fn statement(&self, names: &Names) -> [String; 2] {
        let named = |text: &str| {
            ["/d", "/D"].iter().fold(text.to_string(), |text, rate| {
                text.replace(&format!("{rate}t"), &format!("{rate}{}", names.time))
            })
        };
        self.equations.kind().statement().map(named)
    }

    /// The left-hand and right-hand sides of each equation, as formulas.
    fn formulas(&self) -> Vec<[Row; 2]> {
        let names = self.names();
        let coefficient = |v: &S| value(&plain(v));
        let positions = self.positions().into_iter().map(|(name, right)| {
            let rate = Node::Accent(Accent::Dot, Box::new(formula::name(name)));
            let right = right.iter().map(|(v, along)| (coefficient(v), vec![names.node(*along)]));
            [vec![rate], sum(right)]
        });
        let rows = self.equations.rows().into_iter().map(|row| {
            let left = row.left.iter().map(|(v, j)| (coefficient(v), vec![names.rate_node(*j)]));
            let right = row.right.iter().map(|(v, product)| {
                let factors: Row = match product[..] {
                    [a, b] if a == b => {
                        let base = Node::Group(Brackets::Round, vec![names.node(a)]);
                        vec![Node::Scripts(Box::new(base), vec![(true, value("2"))])]
                    }
                    _ => product.iter().map(|variable| names.node(*variable)).collect(),
                };
                (coefficient(v), factors)
            });
            [sum(left), sum(right)]
        });
        positions.chain(rows).collect()
    }

    /// The lines of an `aligned` environment. A long right-hand side is broken into several lines.
    fn aligned(&self) -> String {
        let equation = |[left, right]: [Row; 2]| {
            let mut text = format!("{} &= ", tex::formula(&left));
            let mut column = width(&left) + 4;
            for (position, term) in pieces(&right).into_iter().enumerate() {
                // counts the gap around a sign between terms
                let width = width(term) + usize::from(position > 0);
                if position > 0 && column + width > WIDTH {
                    text.push_str("\\\\\n&\\quad ");
                    column = 8;
                } else if position > 0 {
                    text.push(' ');
                }
                column += width + 1;
                text.push_str(&tex::term(term, position == 0));
            }
            text
        };
        self.formulas().into_iter().map(equation).collect::<Vec<_>>().join(" \\\\\n")
    }
}

impl<S: Coefficient> Report for EquationReport<S> {
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

/// The letters of the unknown variable and of the known variable.
pub(super) fn letters(motion: EquationKind) -> [&'static str; 2] {
    match motion {
        EquationKind::EulerPoincare => ["Omega", "M"],
        EquationKind::Autoparallel => ["v", ""],
        EquationKind::Transport => ["u", "w"],
    }
}

/// The coefficients of both sides of an equation.
fn coefficients<S>(row: &equations::Row<S>) -> impl Iterator<Item = &S> {
    row.left.iter().map(|(v, _)| v).chain(row.right.iter().map(|(v, _)| v))
}

/// Names for the curve parameter. The first name that is not a parameter or a coordinate is used.
const TIMES: [&str; 4] = ["t", "s", "tau", "lambda"];

/// The names of the variables and of the curve parameter.
struct Names {
    state: String,
    other: String,
    time: String,
}

impl Names {
    fn rate(&self, j: usize) -> String {
        format!("d{}{}/d{}", self.state, j + 1, self.time)
    }

    fn rate_node(&self, j: usize) -> Node {
        let state = Node::Accent(Accent::Dot, Box::new(formula::name(&self.state)));
        indexed(state, true, j)
    }

    fn variable(&self, variable: Variable) -> String {
        let (name, _, j) = self.parts(variable);
        format!("{name}{}", j + 1)
    }

    fn node(&self, variable: Variable) -> Node {
        let (name, above, j) = self.parts(variable);
        indexed(formula::name(name), above, j)
    }

    /// The parts of a variable: its name, whether its index is upper, and its index from 0.
    fn parts(&self, variable: Variable) -> (&str, bool, usize) {
        match variable {
            Variable::State(j) => (&self.state, true, j),
            Variable::Along(j) => (&self.other, true, j),
            Variable::Force(j) => (&self.other, false, j),
        }
    }

    fn product(&self, product: &[Variable]) -> String {
        let names: Vec<String> = product.iter().map(|v| self.variable(*v)).collect();
        match product {
            [a, b] if a == b => format!("{}^2", names[0]),
            _ => names.join("*"),
        }
    }

    /// Both sides of an equation as text.
    fn row<S: Coefficient>(&self, row: &equations::Row<S>) -> [String; 2] {
        let left = row.left.iter().map(|(value, j)| (plain(value), self.rate(*j)));
        let right = row.right.iter().map(|(value, factors)| (plain(value), self.product(factors)));
        [combination(left), combination(right)]
    }
}

/// A letter with a single index, which counts from 0.
fn indexed(base: Node, above: bool, j: usize) -> Node {
    Node::Scripts(Box::new(base), vec![(above, vec![Node::Number((j + 1).to_string())])])
}
