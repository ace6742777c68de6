//! The structure constants of an algebra as input of other programs: GAP, Sage, Maple, SymPy.

use super::head::printable;
use affinor_tensors::expression::is_name;
use affinor_tensors::text::combination;
use affinor_tensors::{Notation, Tensor};
use std::collections::BTreeMap;
use std::fmt::Write;

/// A computer algebra program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// GAP: a table of structure constants and its Lie algebra.
    Gap,
    /// Sage: a Lie algebra by its brackets.
    Sage,
    /// Maple, package DifferentialGeometry.
    Maple,
    /// SymPy: an array `c[i, j, k]` for `c^i_jk`, indices from 0.
    Sympy,
}

/// The terms `(i, c^i_jk)` of the brackets with `j < k`.
type Brackets<S> = BTreeMap<(usize, usize), Vec<(usize, S)>>;

impl Program {
    /// All programs.
    pub const ALL: [Program; 4] = [Program::Gap, Program::Sage, Program::Maple, Program::Sympy];

    /// The name in options.
    pub fn name(self) -> &'static str {
        match self {
            Program::Gap => "gap",
            Program::Sage => "sage",
            Program::Maple => "maple",
            Program::Sympy => "sympy",
        }
    }

    /// The program of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|program| program.name() == name)
    }

    /// The structure constants of an algebra as input of the program. Labels that are no names are replaced by
    /// `e1`, `e2`, ...
    pub fn structure<S: Notation>(
        self,
        name: &str,
        labels: &[String],
        structure: &Tensor<S>,
    ) -> String {
        let mut brackets: Brackets<S> = BTreeMap::new();
        let mut parameters = vec![];
        for (at, value) in structure.components() {
            parameters.extend(value.parameters());
            if at[1] < at[2] {
                brackets.entry((at[1], at[2])).or_default().push((at[0], value.clone()));
            }
        }
        parameters.sort();
        parameters.dedup();
        let plain = labels.iter().all(|label| is_name(label));
        let labels: Vec<String> = match plain {
            true => labels.to_vec(),
            false => (1..=labels.len()).map(|at| format!("e{at}")).collect(),
        };
        let name = printable(name);
        let mut text = String::new();
        // writing to a string does not fail
        let _ = match self {
            Program::Gap => gap(&mut text, &name, labels.len(), &brackets, &parameters),
            Program::Sage => sage(&mut text, &name, &labels, &brackets, &parameters),
            Program::Maple => maple(&mut text, &name, &labels, &brackets),
            Program::Sympy => sympy(&mut text, &name, labels.len(), &brackets, &parameters),
        };
        text
    }
}

fn gap<S: Notation>(
    text: &mut String,
    name: &str,
    n: usize,
    brackets: &Brackets<S>,
    parameters: &[String],
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    let field = match parameters {
        [] => "Rationals".to_string(),
        _ => {
            let quoted: Vec<String> = parameters.iter().map(|p| format!("\"{p}\"")).collect();
            writeln!(text, "F := FunctionField( Rationals, [ {} ] );", quoted.join(", "))?;
            for (at, parameter) in parameters.iter().enumerate() {
                writeln!(text, "{parameter} := IndeterminatesOfFunctionField( F )[{}];", at + 1)?;
            }
            "F".into()
        }
    };
    let zero = if parameters.is_empty() { "0" } else { "Zero( F )" };
    writeln!(text, "T := EmptySCTable( {n}, {zero}, \"antisymmetric\" );")?;
    for ((j, k), terms) in brackets {
        let terms: Vec<String> = terms.iter().map(|(i, v)| format!("{v}, {}", i + 1)).collect();
        writeln!(text, "SetEntrySCTable( T, {}, {}, [ {} ] );", j + 1, k + 1, terms.join(", "))?;
    }
    writeln!(text, "L := LieAlgebraByStructureConstants( {field}, T );")
}

fn sage<S: Notation>(
    text: &mut String,
    name: &str,
    labels: &[String],
    brackets: &Brackets<S>,
    parameters: &[String],
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    let field = match parameters {
        [] => "QQ".to_string(),
        _ => {
            let names = parameters.join(", ");
            writeln!(text, "F = FractionField(PolynomialRing(QQ, '{}'))", names.replace(' ', ""))?;
            writeln!(text, "{names}{} = F.gens()", if parameters.len() == 1 { "," } else { "" })?;
            "F".into()
        }
    };
    writeln!(text, "L = LieAlgebra({field}, {{")?;
    for ((j, k), terms) in brackets {
        let value = |v: &S| match v.parameters().is_empty() {
            true if v.to_string().contains('/') => format!("QQ('{v}')"),
            _ => v.to_string(),
        };
        let terms: Vec<String> =
            terms.iter().map(|(i, v)| format!("'{}': {}", labels[*i], value(v))).collect();
        writeln!(text, "    ('{}', '{}'): {{{}}},", labels[*j], labels[*k], terms.join(", "))?;
    }
    writeln!(text, "}}, names='{}')", labels.join(","))
}

fn maple<S: Notation>(
    text: &mut String,
    name: &str,
    labels: &[String],
    brackets: &Brackets<S>,
) -> std::fmt::Result {
    writeln!(text, "# {name}")?;
    writeln!(text, "with(DifferentialGeometry): with(LieAlgebras):")?;
    let lines: Vec<String> = brackets
        .iter()
        .map(|((j, k), terms)| {
            let terms = terms.iter().map(|(i, v)| (v.to_string(), labels[*i].clone()));
            let right = combination(terms.collect::<Vec<_>>());
            format!("  [{}, {}] = {right}", labels[*j], labels[*k])
        })
        .collect();
    let (lines, labels) = (lines.join(",\n"), labels.join(", "));
    writeln!(text, "L := LieAlgebraData([\n{lines}\n], [{labels}], Alg):\nDGsetup(L):")
}

fn sympy<S: Notation>(
    text: &mut String,
    name: &str,
    n: usize,
    brackets: &Brackets<S>,
    parameters: &[String],
) -> std::fmt::Result {
    writeln!(text, "# {name}: c[i, j, k] is the component i of [e_j, e_k], indices from 0")?;
    writeln!(text, "from sympy import MutableDenseNDimArray, Rational, symbols")?;
    if !parameters.is_empty() {
        let comma = if parameters.len() == 1 { "," } else { "" };
        writeln!(
            text,
            "{}{comma} = symbols('{}', seq=True)",
            parameters.join(", "),
            parameters.join(" ")
        )?;
    }
    writeln!(text, "c = MutableDenseNDimArray.zeros({n}, {n}, {n})")?;
    for ((j, k), terms) in brackets {
        for (i, v) in terms {
            let value = match v.parameters().is_empty() {
                true => format!("Rational('{v}')"),
                false => v.to_string().replace('^', "**"),
            };
            writeln!(text, "c[{i}, {j}, {k}] = {value}\nc[{i}, {k}, {j}] = -c[{i}, {j}, {k}]")?;
        }
    }
    Ok(())
}
