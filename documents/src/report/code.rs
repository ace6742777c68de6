//! Equations of motion as source code: a function that returns the rates.

use super::equations::{EquationReport, letters};
use affinor::geometry::equations::Variable;
use affinor_tensors::expression::{Expression, ExpressionError, Meaning};
use affinor_tensors::{Notation, Rational};
use std::cell::Cell;
use std::collections::BTreeSet;

/// A programming language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Rust, without any crate.
    Rust,
    /// C99.
    C,
    /// Python 3, without any package.
    Python,
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 3] = [Language::Rust, Language::C, Language::Python];

    /// The name in options.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::C => "c",
            Language::Python => "python",
        }
    }

    /// The language of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|language| language.name() == name)
    }
}

impl<S: Notation> EquationReport<S> {
    /// Source code of a function in double precision that returns the rates.
    ///
    /// Its arguments are the state, the external covector or the velocity of the curve, and the parameters. The name of a
    /// parameter begins with `p_`, so that it is no reserved word. Over a chart the position is the first argument, and
    /// its rates come first.
    ///
    /// # Errors
    /// A coefficient beyond the limits of [expressions](affinor_tensors::expression), or beyond the range of floats.
    pub fn code(&self, language: Language) -> Result<String, ExpressionError> {
        let motion = self.equations.kind();
        let coordinates = self.position.as_ref().map_or(&[][..], |(names, _)| names);
        let meaning = Code { language, coordinates, calls: Cell::new(false) };
        let [state, other] = letters(motion).map(str::to_lowercase);
        let variable = |variable: &Variable| match variable {
            Variable::State(j) => format!("{state}[{j}]"),
            Variable::Along(j) | Variable::Force(j) => format!("{other}[{j}]"),
        };
        let mut used = BTreeSet::new();
        let mut term = |value: &S, factors: &[String]| {
            used.extend(value.parameters());
            meaning.written(value, factors)
        };
        let mut positions = Vec::new();
        for (_, terms) in self.positions() {
            let mut written = Vec::new();
            for (value, along) in &terms {
                written.push(term(value, &[variable(along)])?);
            }
            positions.push(sum(&written));
        }
        let mut right = Vec::new();
        for row in self.equations.rows() {
            let mut terms = Vec::new();
            for (value, factors) in &row.right {
                terms.push(term(value, &factors.iter().map(variable).collect::<Vec<_>>())?);
            }
            right.push(sum(&terms));
        }
        // the matrix of the rates is inverted symbolically
        let n = right.len();
        let inverse = self.equations.inverse();
        let mut solved = vec![vec![]; n];
        for (at, value) in inverse.components() {
            solved[at[0]].push(term(value, &[format!("r[{}]", at[1])])?);
        }
        let solved: Vec<String> =
            positions.into_iter().chain(solved.iter().map(|terms| sum(terms))).collect();
        let position = if self.position.is_some() { "x" } else { "" };
        let arguments = [position, &state, &other].into_iter().filter(|name| !name.is_empty());
        let parameters = used.iter().filter(|name| !coordinates.contains(name));
        let parameters: Vec<String> = parameters.map(|name| format!("p_{name}")).collect();
        let about = [
            format!("{}, connection {}.", self.title(), self.connection[0]),
            motion.statement().to_string(),
        ];
        let source = Source {
            function: motion.name().replace('-', "_"),
            arguments: arguments.map(str::to_string).collect(),
            parameters,
            about,
            right,
            solved,
            calls: meaning.calls.get(),
        };
        Ok(match language {
            Language::Rust => source.rust(),
            Language::C => source.c(),
            Language::Python => source.python(),
        })
    }
}

/// The parts of a function that all languages share.
struct Source {
    function: String,
    arguments: Vec<String>,
    parameters: Vec<String>,
    about: [String; 2],
    /// The right sides.
    right: Vec<String>,
    /// The rates, in terms of the right sides `r`; before them those of the position.
    solved: Vec<String>,
    /// Whether functions like the sine are called.
    calls: bool,
}

impl Source {
    fn rust(&self) -> String {
        let n = self.right.len();
        let vectors = self.arguments.iter().map(|name| format!("{name}: &[f64; {n}]"));
        let numbers = self.parameters.iter().map(|name| format!("{name}: f64"));
        let arguments = vectors.chain(numbers).collect::<Vec<_>>().join(", ");
        let about = self.about.each_ref().map(|line| format!("/// {line}\n")).concat();
        let list = |values: &[String], indent: &str| {
            values.iter().map(|value| format!("{indent}    {value},\n")).collect::<String>()
        };
        format!(
            "{about}#[allow(non_snake_case, unused_variables, clippy::all)]\n\
             pub fn {}({arguments}) -> [f64; {}] {{\n    let r: [f64; {n}] = [\n{}    ];\n    \
             [\n{}    ]\n}}\n",
            self.function,
            self.solved.len(),
            list(&self.right, "    "),
            list(&self.solved, "    ")
        )
    }

    fn c(&self) -> String {
        let n = self.right.len();
        let vectors = self.arguments.iter().map(|name| format!("const double {name}[{n}]"));
        let numbers = self.parameters.iter().map(|name| format!("double {name}"));
        let rates = std::iter::once(format!("double rate[{}]", self.solved.len()));
        let arguments = vectors.chain(numbers).chain(rates).collect::<Vec<_>>().join(", ");
        let about = self.about.join("\n   ");
        let needs = if self.calls { "#include <math.h>\n\n" } else { "" };
        let lines = |name: &str, values: &[String]| {
            let line = |(at, value): (usize, &String)| format!("    {name}[{at}] = {value};\n");
            values.iter().enumerate().map(line).collect::<String>()
        };
        format!(
            "{needs}/* {about} */\nvoid {}({arguments})\n{{\n    double r[{n}];\n{}{}}}\n",
            self.function,
            lines("r", &self.right),
            lines("rate", &self.solved)
        )
    }

    fn python(&self) -> String {
        let arguments = [&self.arguments[..], &self.parameters].concat();
        let about = self.about.join("\n    ");
        let list = |values: &[String]| {
            values.iter().map(|value| format!("        {value},\n")).collect::<String>()
        };
        let needs = if self.calls { "import math\n\n\n" } else { "" };
        format!(
            "{needs}def {}({}):\n    \"\"\"{about}\"\"\"\n    r = [\n{}    ]\n    return [\n{}    ]\n",
            self.function,
            arguments.join(", "),
            list(&self.right),
            list(&self.solved)
        )
    }
}

/// The sum of terms.
fn sum(terms: &[String]) -> String {
    let join = |sum: String, term: &String| match term.strip_prefix('-') {
        Some(rest) => format!("{sum} - {rest}"),
        None => format!("{sum} + {term}"),
    };
    let (first, rest) = terms.split_first().map_or(("0.0", &[][..]), |(f, rest)| (f, rest));
    rest.iter().fold(first.to_string(), join)
}

/// Expressions as source code.
struct Code<'c> {
    language: Language,
    /// The names that stand for components of the position.
    coordinates: &'c [String],
    /// Whether some expression calls a function.
    calls: Cell<bool>,
}

/// Source code and how tightly it binds.
#[derive(Clone)]
struct Text {
    text: String,
    binds: Binds,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Product,
    Atom,
}

/// A factor of a product, or a divisor.
#[derive(Clone)]
enum Factor {
    Value(Text),
    Divisor(Text),
}

impl Factor {
    fn text(self) -> Text {
        match self {
            Factor::Value(text) => text,
            Factor::Divisor(text) => Code::quotient(Code::number("1.0"), text),
        }
    }
}

impl Text {
    fn within(&self, binds: Binds) -> String {
        if self.binds >= binds { self.text.clone() } else { format!("({})", self.text) }
    }
}

impl Code<'_> {
    /// A coefficient times its factors.
    fn written<S: Notation>(
        &self,
        value: &S,
        factors: &[String],
    ) -> Result<String, ExpressionError> {
        let mut product = match constant(value) {
            Some(constant) => constant,
            None => Expression::parse(&value.to_string())?.evaluate(self)?.text(),
        };
        for factor in factors {
            product = Self::product(product, Self::number(factor));
        }
        Ok(product.text)
    }

    fn float(x: f64) -> Text {
        Self::number(&format!("{x:?}"))
    }

    fn number(text: &str) -> Text {
        Text { text: text.into(), binds: Binds::Atom }
    }

    fn product(a: Text, b: Text) -> Text {
        match (a.text.as_str(), b.text.as_str()) {
            ("1.0", _) => b,
            (_, "1.0") => a,
            ("-1.0", _) => {
                Text { text: format!("-{}", b.within(Binds::Product)), binds: Binds::Product }
            }
            _ => {
                let text = format!("{}*{}", a.within(Binds::Product), b.within(Binds::Atom));
                Text { text, binds: Binds::Product }
            }
        }
    }

    fn quotient(a: Text, b: Text) -> Text {
        let text = format!("{}/{}", a.within(Binds::Product), b.within(Binds::Atom));
        Text { text, binds: Binds::Product }
    }
}

/// A value without parameters; none for other values, and for those beyond the range of floats.
fn constant<S: Notation>(value: &S) -> Option<Text> {
    let fraction = S::clear_denominators(std::iter::once(value));
    let (above, below) = match &fraction {
        Some((above, below)) => (*above.first()? as f64, *below as f64),
        None => (value.to_f64().filter(|x| x.is_finite())?, 1.0),
    };
    let mut size = Code::float(above.abs());
    if below != 1.0 {
        size = Code::quotient(size, Code::float(below));
    }
    Some(if above < 0.0 { negated(size) } else { size })
}

fn negated(Text { text, binds }: Text) -> Text {
    let closed = binds == Binds::Sum || text.starts_with('-');
    let text = if closed { format!("-({text})") } else { format!("-{text}") };
    Text { text, binds: Binds::Product }
}

impl Meaning for Code<'_> {
    type Value = Factor;

    fn number(&self, number: &Rational) -> Result<Factor, String> {
        let float = f64::from_rational(number);
        let float =
            float.ok_or("this number is beyond the range of floats, in which code computes")?;
        Ok(Factor::Value(Code::float(float)))
    }
    fn name(&self, name: &str) -> Result<Factor, String> {
        let text = match self.coordinates.iter().position(|coordinate| coordinate == name) {
            Some(at) => format!("x[{at}]"),
            None => format!("p_{name}"),
        };
        Ok(Factor::Value(Code::number(&text)))
    }
    fn function(&self, name: &str, argument: Factor) -> Result<Factor, String> {
        if !["sin", "cos", "tan", "exp"].contains(&name) {
            return Err(format!("`{name}` has no counterpart in source code"));
        }
        self.calls.set(true);
        let argument = argument.text();
        let text = match self.language {
            Language::Rust => format!("{}.{name}()", argument.within(Binds::Atom)),
            Language::C => format!("{name}({})", argument.text),
            Language::Python => format!("math.{name}({})", argument.text),
        };
        Ok(Factor::Value(Code::number(&text)))
    }
    fn add(&self, a: Factor, b: Factor) -> Result<Factor, String> {
        let text = sum(&[a.text().text, b.text().text]);
        Ok(Factor::Value(Text { text, binds: Binds::Sum }))
    }
    fn multiply(&self, a: Factor, b: Factor) -> Result<Factor, String> {
        Ok(match (a, b) {
            (Factor::Value(a), Factor::Value(b)) => Factor::Value(Code::product(a, b)),
            (Factor::Value(a), Factor::Divisor(b)) | (Factor::Divisor(b), Factor::Value(a)) => {
                Factor::Value(Code::quotient(a, b))
            }
            (Factor::Divisor(a), Factor::Divisor(b)) => Factor::Divisor(Code::product(a, b)),
        })
    }
    fn negate(&self, a: Factor) -> Factor {
        Factor::Value(negated(a.text()))
    }
    fn reciprocal(&self, a: Factor) -> Result<Factor, String> {
        Ok(match a {
            Factor::Value(a) => Factor::Divisor(a),
            Factor::Divisor(a) => Factor::Value(a),
        })
    }
}
