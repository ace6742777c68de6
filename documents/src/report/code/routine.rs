//! A function to be written in a programming language: its arguments, its arrays, and its
//! statements.

use super::super::head::printable;
use super::super::identifiers::identifiers;
use crate::input::InputError;
use affinor_tensors::scalar::{Count, Function, Output, Step, StraightLine, Variable};
use affinor_tensors::{Notation, Rational, Recorded, Summable};
use num_traits::{One, Zero};

/// The largest width of a line in a long sum.
const WIDTH: usize = 96;

/// An array that the function computes.
pub struct Array {
    pub name: String,
    pub shape: Vec<usize>,
    /// The text that explains the indices.
    pub about: String,
    /// The components that do not vanish identically, each with its indices from 0.
    pub entries: Vec<(Vec<usize>, Recorded)>,
}

impl Array {
    /// Whether some components vanish identically. Such components are not assigned.
    pub fn has_zeros(&self) -> bool {
        self.entries.len() < self.shape.iter().product()
    }
}

/// A function that computes arrays from vectors and parameters.
pub struct Routine {
    pub function: String,
    /// The lines of the comment before the function.
    pub about: Vec<String>,
    /// The arguments that are vectors, each with its length.
    pub vectors: Vec<(String, usize)>,
    /// The names of the components of the vector `x`.
    coordinates: Vec<String>,
    /// The other arguments, sorted by name.
    parameters: Vec<(Variable, String)>,
    pub arrays: Vec<Array>,
    program: StraightLine,
}

/// The parts of a function that depend on the language.
pub trait Dialect {
    /// Writes a component of a vector.
    fn component(&self, vector: &str, at: usize) -> String;
    /// Writes the call of an elementary function.
    fn call(&self, function: Function, argument: &str) -> String;
    /// For the values `a, b, x, y`, writes an expression that is `x` if `|a| >= |b|`, and otherwise
    /// `y`.
    fn select(&self, values: [String; 4]) -> String;
    /// Writes the definition of a temporary value.
    fn definition(&self, name: &str, value: &str) -> String;
    /// Writes the assignment to a component of an array.
    fn assignment(&self, array: &Array, at: &[usize], value: &str) -> String;
}

impl Routine {
    /// Creates the function; `coordinates` are the names of the components of `x`.
    pub fn new(
        function: String,
        mut about: Vec<String>,
        vectors: Vec<(String, usize)>,
        coordinates: Vec<String>,
        arrays: Vec<Array>,
    ) -> Self {
        let values = arrays.iter().flat_map(|array| array.entries.iter().map(|(_, v)| v.clone()));
        let program = StraightLine::new(&values.collect::<Vec<_>>());
        let free = |input: &Variable| {
            let name = input.text();
            !name.contains('[') && !coordinates.iter().any(|own| own == name)
        };
        let inputs: Vec<Variable> = program.inputs().filter(free).collect();
        let head = |input: &Variable| input.free_function().unwrap_or_else(|| input.to_string());
        let names = identifiers(&inputs.iter().map(head).collect::<Vec<_>>());
        let names = names.into_iter().map(|name| format!("p_{name}"));
        let parameters: Vec<(Variable, String)> = inputs.into_iter().zip(names).collect();
        let explained = |of: &dyn Fn(&Variable) -> bool| {
            let named = parameters.iter().filter(|(input, _)| of(input));
            named.map(|(input, name)| format!("{name} is {input}")).collect::<Vec<_>>().join(", ")
        };
        for (title, names) in [
            ("Parameters", explained(&|own| own.is_parameter() && !own.text().is_ascii())),
            ("Values of functions", explained(&|own| !own.is_parameter())),
        ] {
            if !names.is_empty() {
                about.push(format!("{title}: {names}."));
            }
        }
        about.extend(arrays.iter().map(|array| format!("{}: {}.", array.name, array.about)));
        if arrays.iter().any(Array::has_zeros) {
            about.push("Components that are not assigned vanish identically.".into());
        }
        about.extend(remarks(program.count()));
        about.iter_mut().for_each(|line| *line = printable(line).to_string());
        Routine { function, about, vectors, coordinates, parameters, arrays, program }
    }

    /// The names of the parameters, as arguments.
    pub fn arguments(&self) -> Vec<String> {
        self.parameters.iter().map(|(_, name)| name.clone()).collect()
    }

    /// Whether the function calls elementary functions such as the sine, or compares absolute
    /// values.
    pub fn calls(&self) -> bool {
        self.program.count().functions + self.program.count().comparisons > 0
    }

    /// Writes the statements: first the temporary values, then the components of all arrays.
    ///
    /// # Errors
    /// An error for a constant beyond the range of floats.
    pub fn statements(&self, dialect: &dyn Dialect) -> Result<Vec<String>, InputError> {
        let mut lines = Vec::new();
        let mut texts: Vec<Text> = Vec::new();
        let mut temporaries = 0;
        for (step, uses) in self.program.steps().iter().zip(self.program.uses()) {
            let text = match step {
                Step::Input(input) => Text::atom(self.argument(*input, dialect)),
                Step::Function(function, a) => Text::atom(dialect.call(*function, &texts[*a].text)),
                Step::Sum(constant, terms) => sum(constant, terms, &texts)?,
                Step::Product(a, b) => product(&texts[*a], &texts[*b]),
                Step::Reciprocal(a) => {
                    let text = format!("1.0/{}", texts[*a].within(Binds::Atom));
                    Text { text, binds: Binds::Product }
                }
                Step::Select(values) => {
                    let [a, b, x, y] = values.each_ref().map(|value| written(value, &texts));
                    Text { text: dialect.select([a?, b?, x?, y?]), binds: Binds::Sum }
                }
            };
            let inline = match step {
                Step::Input(_) => true,
                Step::Product(..) => uses == 1 && text.text.len() < 60,
                _ => false,
            };
            texts.push(if inline {
                text
            } else {
                let name = format!("t{temporaries}");
                temporaries += 1;
                lines.push(dialect.definition(&name, &text.text));
                Text::atom(name)
            });
        }
        let mut outputs = self.program.outputs().iter();
        for array in &self.arrays {
            for ((at, _), output) in array.entries.iter().zip(outputs.by_ref()) {
                lines.push(dialect.assignment(array, at, &written(output, &texts)?));
            }
        }
        Ok(lines)
    }

    /// Writes an input as a component of a vector, or as a parameter.
    fn argument(&self, input: Variable, dialect: &dyn Dialect) -> String {
        let name = input.text();
        let component = name.strip_suffix(']').and_then(|name| name.split_once('['));
        let component = component.and_then(|(vector, at)| Some((vector, at.parse().ok()?)));
        match (component, self.coordinates.iter().position(|own| own == name)) {
            (Some((vector, at)), _) => dialect.component(vector, at),
            (_, Some(at)) => dialect.component("x", at),
            _ => {
                let known = self.parameters.iter().find(|(own, _)| *own == input);
                known.map_or_else(String::new, |(_, name)| name.clone())
            }
        }
    }
}

/// Remarks on the number of operations, and on divisors that must not be zero.
fn remarks(count: Count) -> Vec<String> {
    let Count { additions, multiplications, divisions, functions, comparisons } = count;
    let counted = |n: usize, name: &str| match n {
        0 => None,
        1 => Some(format!("1 {name}")),
        n => Some(format!("{n} {name}s")),
    };
    let counts = [
        counted(additions, "addition"),
        counted(multiplications, "multiplication"),
        counted(divisions, "division"),
        counted(functions, "call"),
        counted(comparisons, "comparison"),
    ];
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    let mut lines = Vec::new();
    if !counts.is_empty() {
        lines.push(format!("{}.", counts.join(", ")));
    }
    if divisions > 0 {
        lines.push(
            "Divisors are not checked: where one is 0, results are infinite or not numbers.".into(),
        );
    }
    if comparisons > 0 {
        lines.push(
            "A metric is eliminated with exchanges of rows, which comparisons choose.".into(),
        );
    }
    lines
}

/// The source code of an expression, and the precedence of its outermost operator.
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

impl Text {
    fn atom(text: String) -> Self {
        Text { text, binds: Binds::Atom }
    }

    fn within(&self, binds: Binds) -> String {
        if self.binds >= binds { self.text.clone() } else { format!("({})", self.text) }
    }
}

fn product(a: &Text, b: &Text) -> Text {
    let text = format!("{}*{}", a.within(Binds::Product), b.within(Binds::Atom));
    Text { text, binds: Binds::Product }
}

/// Writes a multiple of an expression, without the sign of the factor.
fn multiple(factor: &Rational, text: &Text) -> Result<String, InputError> {
    let size = factor.clone().abs();
    if size.is_one() {
        return Ok(text.within(Binds::Product));
    }
    Ok(format!("{}*{}", number(&size)?, text.within(Binds::Atom)))
}

/// Writes a sum in parentheses, on several lines if it is long.
fn sum(
    constant: &Rational,
    terms: &[(Rational, usize)],
    texts: &[Text],
) -> Result<Text, InputError> {
    let mut parts = Vec::new();
    for (factor, at) in terms {
        parts.push((factor.is_negative(), multiple(factor, &texts[*at])?));
    }
    if !constant.is_zero() {
        parts.push((constant.is_negative(), number(&constant.clone().abs())?));
    }
    // puts a positive term first, if there is one, to avoid a leading minus sign
    if let Some(at) = parts.iter().position(|(negative, _)| !negative) {
        parts.swap(0, at);
    }
    let (mut text, mut column) = (String::new(), 0);
    let mut broken = false;
    for (at, (negative, part)) in parts.into_iter().enumerate() {
        let sign = match (at, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        if at > 0 && column + part.len() > WIDTH {
            text.push_str(sign.trim_end());
            text.push_str("\n        ");
            (broken, column) = (true, 0);
        } else {
            text.push_str(sign);
        }
        column += part.len() + 3;
        text.push_str(&part);
    }
    Ok(match broken {
        true => Text::atom(format!("({text})")),
        false => Text { text, binds: Binds::Sum },
    })
}

/// Writes an output as source code.
fn written(output: &Output, texts: &[Text]) -> Result<String, InputError> {
    let text = match output.step {
        None => number(&output.factor.clone().abs())?,
        Some(at) => multiple(&output.factor, &texts[at])?,
    };
    Ok(if output.factor.is_negative() { format!("-{text}") } else { text })
}

/// Writes a nonnegative number: in decimal digits if they are exact, otherwise as a quotient of
/// integers. If the integers are not exact as floats, the number is rounded.
fn number(value: &Rational) -> Result<String, InputError> {
    if let Some((above, below)) = Rational::clear_denominators(std::iter::once(value)) {
        let above = above.first().copied().unwrap_or_default();
        if above.max(below) <= 1 << 53 {
            return Ok(match below.count_ones() == 1 {
                true => format!("{:?}", above as f64 / below as f64),
                false => format!("{:?}/{:?}", above as f64, below as f64),
            });
        }
    }
    let float = f64::from_rational(value).map(|float| format!("{float:?}"));
    float.ok_or_else(|| {
        let digits = value.to_string();
        let shown = if digits.len() > 40 { "a constant".to_string() } else { digits };
        InputError::usage(format!(
            "{shown} is beyond the range of floats, in which programs compute"
        ))
    })
}

/// Writes the lengths of a shape, each between `open` and `close`, from the first to the last.
pub fn lengths(shape: &[usize], open: &str, close: &str) -> String {
    shape.iter().map(|n| format!("{open}{n}{close}")).collect()
}

/// A list of numbers separated by commas.
pub fn list<T: ToString>(values: impl IntoIterator<Item = T>) -> String {
    values.into_iter().map(|value| value.to_string()).collect::<Vec<_>>().join(", ")
}
