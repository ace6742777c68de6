//! The structure constants of an algebra as input of other programs: GAP, Sage, Maple, SymPy.

use super::head::printable;
use super::identifiers::identifiers;
use crate::Coefficient;
use affinor_tensors::Tensor;
use affinor_tensors::expression::{is_name, is_name_character};
use affinor_tensors::text::combination;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// A computer algebra program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// GAP: a table of structure constants, and its Lie algebra.
    Gap,
    /// Sage: a Lie algebra given by its brackets.
    Sage,
    /// Maple, package DifferentialGeometry.
    Maple,
    /// SymPy: an array `c[i, j, k]` for `c^i_jk`, indices from 0.
    Sympy,
}

/// The terms `(i, c^i_jk)` of each bracket with `j < k`.
type Brackets<S> = BTreeMap<(usize, usize), Vec<(usize, S)>>;

impl Program {
    /// All programs.
    pub const ALL: [Program; 4] = [Program::Gap, Program::Sage, Program::Maple, Program::Sympy];

    /// The name by which options select the program.
    pub fn name(self) -> &'static str {
        match self {
            Program::Gap => "gap",
            Program::Sage => "sage",
            Program::Maple => "maple",
            Program::Sympy => "sympy",
        }
    }

    /// The program with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|program| program.name() == name)
    }

    /// Writes the structure constants of an algebra as input of the program. Labels that are not
    /// valid names are replaced by `e1`, `e2`, .... A parameter whose name is reserved by the
    /// program, such as `lambda`, gets a suffix: `lambda_`.
    pub fn structure<S: Coefficient>(
        self,
        name: &str,
        labels: &[String],
        structure: &Tensor<S>,
    ) -> String {
        let mut brackets: Brackets<S> = BTreeMap::new();
        let mut parameters = vec![];
        let mut numbers = BTreeSet::new();
        for (at, value) in structure.components() {
            parameters.extend(value.parameters());
            numbers.extend(irrational(value));
            if at[1] < at[2] {
                brackets.entry((at[1], at[2])).or_default().push((at[0], value.clone()));
            }
        }
        // replaces pi by an indeterminate: pi is transcendental, so the generated fields are
        // isomorphic
        if self == Program::Gap && numbers.remove("pi") {
            parameters.push("pi".into());
        }
        parameters.sort();
        parameters.dedup();
        let plain = labels.iter().all(|label| is_name(label));
        let labels: Vec<String> = match plain {
            true => identifiers(labels),
            false => (1..=labels.len()).map(|at| format!("e{at}")).collect(),
        };
        let name = printable(name);
        let variables = Variables::new(self, &parameters, numbers);
        let mut text = String::new();
        // ignores the result: writing to a string cannot fail
        let _ = match self {
            Program::Gap => gap(&mut text, &name, labels.len(), &brackets, &variables),
            Program::Sage => sage(&mut text, &name, &labels, &brackets, &variables),
            Program::Maple => maple(&mut text, &name, &labels, &brackets, &variables),
            Program::Sympy => sympy(&mut text, &name, labels.len(), &brackets, &variables),
        };
        text
    }

    /// Whether the program reserves this name, because it is a reserved word or occurs in the
    /// generated text.
    fn reserves(self, name: &str) -> bool {
        match self {
            // names in the library of GAP begin with a capital letter
            Program::Gap => name.starts_with(|c: char| c.is_ascii_uppercase()) || is_in(GAP, name),
            Program::Maple => is_in(MAPLE, name),
            Program::Sage => {
                is_in(PYTHON, name) || is_in("F L QQ FractionField LieAlgebra PolynomialRing", name)
            }
            Program::Sympy => {
                is_in(PYTHON, name) || is_in("c MutableDenseNDimArray Rational symbols", name)
            }
        }
    }
}

/// Reserved words of GAP, and names that already have a value.
const GAP: &str = "and atomic break continue do elif else end fail false fi for function if in infinity last last2 last3 local \
    memory_allocated mod not od or quit readonly readwrite rec repeat return then time true until while";

/// Reserved words of Maple, names that already have a value, and names that occur in the output.
const MAPLE: &str = "Alg Catalan Digits FAIL I L Order Pi and assuming break by catch description do done elif else end error \
    export false fi finally for from gamma global if implies in infinity intersect local minus mod module next not od \
    option options or printlevel proc quit read return save stop subset then to true try undefined union until use uses \
    while xor";

/// Reserved words of Python.
const PYTHON: &str = "False None True and as assert async await break class continue def del elif else except finally for from \
    global if import in is lambda nonlocal not or pass raise return try while with yield";

fn is_in(words: &str, name: &str) -> bool {
    words.split_ascii_whitespace().any(|word| word == name)
}

/// The irrational numbers in a value: pi, and square roots such as `sqrt(2)`.
fn irrational(value: &impl Coefficient) -> BTreeSet<&'static str> {
    let terms = value.numerator_terms();
    let powers = terms.iter().flat_map(|(powers, _)| powers);
    powers.filter(|(own, _)| !own.is_parameter()).map(|(own, _)| own.text()).collect()
}

/// The parameters, and the variables of a program that represent them.
struct Variables<'p> {
    parameters: &'p [String],
    names: Vec<String>,
    /// The irrational numbers that occur in the structure constants.
    numbers: BTreeSet<&'static str>,
    /// Functions and constants of the program, each with its name in affinor.
    words: &'static [(&'static str, &'static str)],
}

impl<'p> Variables<'p> {
    fn new(program: Program, parameters: &'p [String], numbers: BTreeSet<&'static str>) -> Self {
        let mut names: Vec<String> = vec![];
        let identifiers = identifiers(parameters);
        for identifier in &identifiers {
            let mut name = identifier.clone();
            if program.reserves(&name) {
                name.push('_');
                while identifiers.contains(&name) || names.contains(&name) {
                    name.push('_');
                }
            }
            names.push(name);
        }
        let words: &[_] = match program {
            Program::Gap => &[("sqrt", "Sqrt")],
            Program::Maple => &[("pi", "Pi")],
            Program::Sage | Program::Sympy => &[],
        };
        Variables { parameters, names, numbers, words }
    }

    /// The variables, as the left-hand side of a Python assignment.
    fn targets(&self) -> String {
        self.names.join(", ") + if self.names.len() == 1 { "," } else { "" }
    }

    /// Writes a value in these variables.
    fn written(&self, value: &impl Coefficient) -> String {
        self.replaced(value.to_string())
    }

    /// Replaces the names of parameters, functions and constants in a text by the names in the
    /// program.
    fn replaced(&self, text: String) -> String {
        if self.names == self.parameters && self.numbers.is_empty() {
            return text;
        }
        let (mut rest, mut written) = (&*text, String::new());
        while let Some(first) = rest.chars().next() {
            let end = match is_name_character(first) {
                true => rest.find(|c| !is_name_character(c)).unwrap_or(rest.len()),
                false => first.len_utf8(),
            };
            let (word, behind) = rest.split_at(end);
            let at = self.parameters.iter().position(|parameter| parameter == word);
            let mut words = self.words.iter().filter(|_| !self.numbers.is_empty());
            let known = words.find(|(ours, _)| *ours == word).map(|(_, theirs)| *theirs);
            written.push_str(at.map_or(known.unwrap_or(word), |at| &self.names[at]));
            rest = behind;
        }
        written
    }
}

fn gap<S: Coefficient>(
    text: &mut String,
    name: &str,
    n: usize,
    brackets: &Brackets<S>,
    variables: &Variables<'_>,
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    let roots: Vec<String> =
        variables.numbers.iter().map(|root| variables.replaced(root.to_string())).collect();
    let numbers = match &roots[..] {
        [] => "Rationals".to_string(),
        roots => format!("Field( [ {} ] )", roots.join(", ")),
    };
    let field = match &variables.names[..] {
        [] => numbers,
        names => {
            let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            writeln!(text, "F := FunctionField( {numbers}, [ {} ] );", quoted.join(", "))?;
            for (at, name) in names.iter().enumerate() {
                writeln!(text, "{name} := IndeterminatesOfFunctionField( F )[{}];", at + 1)?;
            }
            "F".into()
        }
    };
    let zero = if variables.names.is_empty() { "0" } else { "Zero( F )" };
    writeln!(text, "T := EmptySCTable( {n}, {zero}, \"antisymmetric\" );")?;
    for ((j, k), terms) in brackets {
        let term = |(i, v): &(usize, S)| format!("{}, {}", variables.written(v), i + 1);
        let terms: Vec<String> = terms.iter().map(term).collect();
        writeln!(text, "SetEntrySCTable( T, {}, {}, [ {} ] );", j + 1, k + 1, terms.join(", "))?;
    }
    writeln!(text, "L := LieAlgebraByStructureConstants( {field}, T );")
}

fn sage<S: Coefficient>(
    text: &mut String,
    name: &str,
    labels: &[String],
    brackets: &Brackets<S>,
    variables: &Variables<'_>,
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    let field = match &variables.names[..] {
        names if !variables.numbers.is_empty() => {
            let symbols = names.iter().map(|name| format!("SR.var('{name}'),"));
            let symbols = symbols.collect::<Vec<_>>().join(" ");
            if !names.is_empty() {
                writeln!(text, "{} = ({symbols})", variables.targets())?;
            }
            "SR".into()
        }
        [] => "QQ".to_string(),
        names => {
            writeln!(text, "F = FractionField(PolynomialRing(QQ, '{}'))", names.join(","))?;
            writeln!(text, "{} = F.gens()", variables.targets())?;
            "F".into()
        }
    };
    writeln!(text, "L = LieAlgebra({field}, {{")?;
    for ((j, k), terms) in brackets {
        let value = |v: &S| match v.parameters().is_empty() {
            true if irrational(v).is_empty() && v.to_string().contains('/') => {
                format!("QQ('{v}')")
            }
            _ => variables.written(v),
        };
        let terms: Vec<String> =
            terms.iter().map(|(i, v)| format!("'{}': {}", labels[*i], value(v))).collect();
        writeln!(text, "    ('{}', '{}'): {{{}}},", labels[*j], labels[*k], terms.join(", "))?;
    }
    writeln!(text, "}}, names='{}')", labels.join(","))
}

fn maple<S: Coefficient>(
    text: &mut String,
    name: &str,
    labels: &[String],
    brackets: &Brackets<S>,
    variables: &Variables<'_>,
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    writeln!(text, "with(DifferentialGeometry): with(LieAlgebras):")?;
    let lines: Vec<String> = brackets
        .iter()
        .map(|((j, k), terms)| {
            let terms = terms.iter().map(|(i, v)| (variables.written(v), labels[*i].clone()));
            let right = combination(terms.collect::<Vec<_>>());
            format!("  [{}, {}] = {right}", labels[*j], labels[*k])
        })
        .collect();
    let (lines, labels) = (lines.join(",\n"), labels.join(", "));
    writeln!(text, "L := LieAlgebraData([\n{lines}\n], [{labels}], Alg):\nDGsetup(L):")
}

fn sympy<S: Coefficient>(
    text: &mut String,
    name: &str,
    n: usize,
    brackets: &Brackets<S>,
    variables: &Variables<'_>,
) -> std::fmt::Result {
    writeln!(text, "# {name}: c[i, j, k] is the component i of [e_j, e_k], indices from 0")?;
    let used = |name: &str| variables.numbers.iter().any(|number| number.starts_with(name));
    let numbers: String = ["pi", "sqrt"]
        .into_iter()
        .filter(|name| used(name))
        .map(|name| format!("{name}, "))
        .collect();
    writeln!(text, "from sympy import MutableDenseNDimArray, Rational, {numbers}symbols")?;
    if !variables.names.is_empty() {
        let symbols = variables.parameters.join(" ");
        writeln!(text, "{} = symbols('{symbols}', seq=True)", variables.targets())?;
    }
    writeln!(text, "c = MutableDenseNDimArray.zeros({n}, {n}, {n})")?;
    for ((j, k), terms) in brackets {
        for (i, v) in terms {
            let value = match v.parameters().is_empty() && irrational(v).is_empty() {
                true => format!("Rational('{v}')"),
                false => exact_quotients(&variables.written(v)).replace('^', "**"),
            };
            writeln!(text, "c[{i}, {j}, {k}] = {value}\nc[{i}, {k}, {j}] = -c[{i}, {j}, {k}]")?;
        }
    }
    Ok(())
}

/// Writes `Rational('1/3')` for `1/3`, because Python would compute the quotient in floats.
fn exact_quotients(text: &str) -> String {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (mut rest, mut written, mut before) = (text, String::new(), ' ');
    while let Some(first) = rest.chars().next() {
        let above = digits(rest);
        let below = rest[above..].strip_prefix('/').map_or(0, digits);
        let whole = !is_name_character(before) && !matches!(before, '^' | '/' | '.');
        let end = match above {
            0 => first.len_utf8(),
            _ if below > 0 && whole => above + 1 + below,
            _ => above,
        };
        let (piece, behind) = rest.split_at(end);
        match above > 0 && end > above {
            true => written.push_str(&format!("Rational('{piece}')")),
            false => written.push_str(piece),
        }
        before = piece.chars().next_back().unwrap_or(' ');
        rest = behind;
    }
    written
}
