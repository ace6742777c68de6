//! Statements about a space, tested on its geometry: `torsion = 0`, `Ric_11 = (a - b)/2`, `locally
//! symmetric`.

mod law;

use super::components::{plain, scripts};
use super::grid::{Cell, Grid, head_of_grid};
use super::head::{conventions_in_json, printable};
use super::indexed::{Index, Indexed, Names, Parsed, Tensors, WHOLE};
use super::{Format, Report, text};
use crate::Coefficient;
use crate::input::{InputError, Source, file, shown};
use affinor::Geometry;
use affinor_tensors::expression::ExpressionError;
use affinor_tensors::{Kind, Symbolic, Variance};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Statements about a space, one per line. `#` begins a comment.
///
/// A statement compares expressions of tensors, parameters and numbers, or names a property:
///
/// | statement | holds if |
/// |---|---|
/// | `torsion = 0`, `torsion = structure` | all components are equal |
/// | `R^i_jkl = -1/4*c^m_kl c^i_mj` | all components are equal; a letter that occurs twice in a product is summed |
/// | `Ric_11 = Ric_22 = (a - b)/2` | the components are equal |
/// | `curvature != 0` | some components differ |
/// | `S > 0`, `<`, `>=`, `<=` | two numbers are in this order |
/// | `locally symmetric`, `not flat` | the geometry has the property, or does not have it |
///
/// ```
/// use affinor_documents::space::{Request, Space};
/// use affinor_documents::report::{Computation, Statements};
/// let space = Space::open(&Request { space: Some("so(3)@zero".into()), ..Request::default() })?;
/// let statements = Statements::parse("claims.txt", "torsion = 0\nRic_11 = 1/3\nlocally symmetric")?;
/// let verdicts = Computation::of(&space).test(&statements)?;
/// let held: Vec<bool> = verdicts.iter().map(|verdict| verdict.holds).collect();
/// assert_eq!(held, [true, false, true]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Statements {
    sources: Vec<Source>,
}

/// The outcome of a statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// The line of the statement in its text, from 1.
    pub line: usize,
    /// The statement.
    pub statement: String,
    /// Whether the statement holds.
    pub holds: bool,
    /// The first component that contradicts the statement, or the witness of a property.
    pub component: String,
    /// The values of both sides of an equation or an inequality that does not hold.
    pub sides: Option<[String; 2]>,
}

/// The outcomes of statements about a space.
#[derive(Clone, Debug)]
pub struct Verdicts {
    name: String,
    verdicts: Vec<Verdict>,
    /// The errors of statements that cannot be tested.
    errors: Vec<InputError>,
    /// The rule by which a float counts as zero.
    zero: Option<String>,
}

/// A comparison of two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// The signs of relations. `==` precedes `=`, so that the longer sign is found.
const RELATIONS: [(&str, Relation); 7] = [
    ("==", Relation::Equal),
    ("!=", Relation::Unequal),
    ("<=", Relation::LessOrEqual),
    (">=", Relation::GreaterOrEqual),
    ("=", Relation::Equal),
    ("<", Relation::Less),
    (">", Relation::Greater),
];

/// The allowed forms of statements, for messages.
const FORMS: &str = "write left = right, !=, <, >, <=, >=, or a property: ";

impl Statements {
    /// Reads statements from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// An error if the file cannot be read, or contains no statements.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::of(vec![file::read(path)?])
    }

    /// Reads statements from a text, which messages call `name`.
    ///
    /// # Errors
    /// An error if the text contains no statements.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::of(vec![Source::new(name.escape_debug().to_string(), text)])
    }

    /// Joins several lists of statements.
    #[must_use]
    pub fn join(lists: Vec<Self>) -> Self {
        Statements { sources: lists.into_iter().flat_map(|list| list.sources).collect() }
    }

    fn of(sources: Vec<Source>) -> Result<Self, InputError> {
        let statements = Statements { sources };
        let is_empty = statements.lines().next().is_none();
        if is_empty {
            let source = statements.sources.first().map(|source| source.name.clone());
            let message = format!("no statement in {}", source.unwrap_or_default());
            return Err(InputError::usage(message).help("write one per line, as in torsion = 0"));
        }
        Ok(statements)
    }

    /// The statements, each with its source and its line.
    fn lines(&self) -> impl Iterator<Item = (&Source, usize, &str)> {
        self.sources.iter().flat_map(|source| {
            let lines = (1..).zip(source.content().lines());
            lines.filter_map(move |(number, line)| {
                let statement = line.split('#').next().unwrap_or_default().trim();
                (!statement.is_empty()).then_some((source, number, statement))
            })
        })
    }

    /// Whether the statements may contain irrational values, such as `sqrt(2)` or `pi`.
    pub(super) fn may_be_irrational(&self) -> bool {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        self.lines().any(|(_, _, statement)| {
            let called = statement.split('(').rev().skip(1).any(|before| before.ends_with(is_name));
            called || statement.split(|c| !is_name(c)).any(|word| word == "pi")
        })
    }

    /// Tests the statements on a geometry. `scalars` are the names of scalars, and `values` are the
    /// values of parameters that were set.
    ///
    /// A statement cannot be tested if it has a syntax error or an unknown name, or if a tensor or
    /// a property is not defined for the geometry. The same holds if the indices of the sides
    /// differ, or if the order of two sides depends on parameters.
    pub(super) fn test<S: Coefficient>(
        &self,
        geometry: &Geometry<S>,
        scalars: &[String],
        values: &BTreeMap<String, Symbolic>,
    ) -> Verdicts {
        let mut names = Names::new(geometry, scalars.iter().chain(values.keys()).cloned());
        names.scalars.insert("pi".into());
        let scalar = |name: &str| scalar::<S>(name, &names, values);
        let tensors = Tensors::new(geometry, &scalar);
        let (mut verdicts, mut errors) = (vec![], vec![]);
        for (source, line, text) in self.lines() {
            let test = Test { source, names: &names, tensors: &tensors, geometry };
            let found = match test.statement(text) {
                Ok(found) => found,
                Err(error) => {
                    errors.push(error.or_at(&source.whole(text)));
                    continue;
                }
            };
            let (component, sides) = found.clone().unwrap_or_default();
            verdicts.push(Verdict {
                line,
                statement: text.into(),
                holds: found.is_none(),
                component,
                sides,
            });
        }
        let tolerance = geometry.frame().structure_functions().tolerance();
        let zero = (S::KIND == Kind::Float).then(|| super::head::zero(tolerance));
        Verdicts { name: geometry.name().into(), verdicts, errors, zero }
    }
}

/// The value of a parameter, a coordinate or `pi`.
pub(super) fn scalar<S: Coefficient>(
    name: &str,
    names: &Names,
    values: &BTreeMap<String, Symbolic>,
) -> Result<S, String> {
    let given = match (values.get(name), name) {
        (Some(value), _) => S::from_symbolic(value),
        (None, "pi") => S::from_symbolic(&Symbolic::pi()),
        (None, _) if names.scalars.contains(name) => S::parameter(name),
        _ => None,
    };
    given.ok_or_else(|| format!("the space has no parameter {}", shown(name)))
}

/// A contradiction to a statement: the component, and the values of both sides.
type Contradiction = (String, Option<[String; 2]>);

struct Test<'a, S> {
    source: &'a Source,
    names: &'a Names,
    tensors: &'a Tensors<'a, S>,
    geometry: &'a Geometry<S>,
}

impl<S: Coefficient> Test<'_, S> {
    /// Tests one statement. Returns `None` if it holds, otherwise the contradiction.
    fn statement(&self, text: &str) -> Result<Option<Contradiction>, InputError> {
        let (sides, relations) = split(text);
        if relations.is_empty() {
            return self.law(text);
        }
        if relations.len() > 1 && relations.iter().any(|relation| *relation != Relation::Equal) {
            return Err(InputError::usage("only `=` may occur more than once in a statement"));
        }
        let parsed = sides.iter().map(|side| self.side(side)).collect::<Result<Vec<_>, _>>()?;
        for (pair, relation) in parsed.windows(2).zip(relations) {
            let [(left, a), (_, b)] = pair else { continue };
            let found = match relation {
                Relation::Equal => self.unequal(left, a, b),
                Relation::Unequal => self.unequal(left, a, b).map(|found| match found {
                    Some(_) => None,
                    None => Some((String::new(), self.equal_sides(a, b))),
                }),
                order => in_order(order, a, b),
            };
            if let Some(found) = found.map_err(InputError::usage)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    fn side(&self, text: &str) -> Result<(Parsed, Indexed<S>), InputError> {
        let refused = |ExpressionError { span, reason }: ExpressionError| {
            InputError::usage(reason).at(&self.source.find(text, span))
        };
        let parsed = self.names.parse(text).map_err(refused)?;
        let value = self.tensors.value(&parsed).map_err(refused)?;
        Ok((parsed, value))
    }

    /// Finds the first component in which two sides differ.
    fn unequal(
        &self,
        left: &Parsed,
        a: &Indexed<S>,
        b: &Indexed<S>,
    ) -> Result<Option<Contradiction>, String> {
        let difference = a.minus(b)?;
        let Some((at, _)) = difference.tensor.components().next() else { return Ok(None) };
        let at: Vec<_> = difference.letters.iter().copied().zip(at.iter().copied()).collect();
        let value = |side: &Indexed<S>| match side.letters.len() == at.len() {
            true => {
                let index = |letter: &char| at.iter().find(|(other, _)| other == letter);
                let indices = side.letters.iter().filter_map(index).map(|(_, at)| *at);
                plain(&side.tensor.get(&indices.collect::<Vec<_>>()))
            }
            false => "0".into(),
        };
        Ok(Some((component(left, &at, self.names.dimension), Some([value(a), value(b)]))))
    }

    /// The values of both sides, if both are numbers, and equal.
    fn equal_sides(&self, a: &Indexed<S>, b: &Indexed<S>) -> Option<[String; 2]> {
        let values = [a, b].map(|side| side.tensor.to_scalar());
        let [Some(a), Some(b)] = values else { return None };
        Some([plain(&a), plain(&b)])
    }

    fn law(&self, text: &str) -> Result<Option<Contradiction>, InputError> {
        let positive = text.strip_prefix("not ").map(str::trim);
        let Some(name) = law::named(positive.unwrap_or(text)) else {
            let message = format!("unknown property `{}`", shown(text));
            let help = FORMS.to_string() + &law::NAMES.join(", ");
            return Err(InputError::usage(message).help(help));
        };
        let Some(holds) = law::holds(name, self.geometry)? else {
            let message = format!("`{name}` is not defined for this space");
            return Err(InputError::usage(message).help("give a metric, as in --metric identity"));
        };
        Ok(match (holds, positive) {
            (Ok(()), None) | (Err(_), Some(_)) => None,
            (Err(witness), None) => Some((witness, None)),
            (Ok(()), Some(_)) => Some((format!("the space is {name}"), None)),
        })
    }
}

/// Splits a statement into its sides and the relations between them.
fn split(text: &str) -> (Vec<&str>, Vec<Relation>) {
    let (mut sides, mut relations, mut rest) = (vec![], vec![], text);
    while let Some(at) = rest.find(['=', '!', '<', '>']) {
        let found = RELATIONS.iter().find(|(sign, _)| rest[at..].starts_with(sign));
        let Some((sign, relation)) = found else { break };
        sides.push(rest[..at].trim());
        relations.push(*relation);
        rest = &rest[at + sign.len()..];
    }
    sides.push(rest.trim());
    (sides, relations)
}

/// Writes the component of an expression at given values of its free letters: `Ric_12 - g_12`.
fn component(parsed: &Parsed, at: &[(char, usize)], dimension: usize) -> String {
    let number = |letter: char| match at.iter().find(|(other, _)| *other == letter) {
        Some((_, index)) => (index + 1).to_string(),
        None => letter.to_string(),
    };
    let (mut written, mut end) = (String::new(), 0);
    for occurrence in &parsed.occurrences {
        written += &parsed.text[end..occurrence.span.start];
        let (name, indices) = match &occurrence.indices {
            None => {
                let slots = occurrence.quantity.slots();
                (
                    occurrence.quantity.symbol(),
                    WHOLE.map(Index::Letter).into_iter().zip(slots).collect(),
                )
            }
            Some(indices) => (&*occurrence.name, indices.clone()),
        };
        let slots: Vec<Variance> = indices.iter().map(|(_, slot)| *slot).collect();
        let names = indices.iter().map(|(index, _)| match index {
            Index::Letter(letter) => number(*letter),
            Index::Number(at) => (at + 1).to_string(),
        });
        written += &text::join(name, scripts(dimension, &slots, names));
        end = occurrence.span.end;
    }
    written + &parsed.text[end..]
}

/// Compares two numbers. Returns the values of both sides if they violate the inequality.
fn in_order<S: Coefficient>(
    order: Relation,
    a: &Indexed<S>,
    b: &Indexed<S>,
) -> Result<Option<Contradiction>, String> {
    let difference = a.minus(b)?;
    let values = (difference.tensor.to_scalar(), a.tensor.to_scalar(), b.tensor.to_scalar());
    let (Some(difference), Some(a), Some(b)) = values else {
        return Err("an inequality compares two numbers, not tensors".into());
    };
    let parameters = difference.parameters();
    if !parameters.is_empty() {
        let names = parameters.join(", ");
        return Err(format!("the sign of {difference} depends on {names}: set numbers with --set"));
    }
    let positive = match S::KIND {
        // an exact difference has an exact sign, but its nearest float may be 0
        Kind::Exact => !difference.is_negative(),
        _ => difference.to_f64().is_some_and(|x| x > 0.0),
    };
    let holds = match (order, difference.vanishes()) {
        (Relation::LessOrEqual | Relation::GreaterOrEqual, true) => true,
        (_, true) => false,
        (Relation::Less | Relation::LessOrEqual, _) => !positive,
        _ => positive,
    };
    Ok((!holds).then(|| (String::new(), Some([plain(&a), plain(&b)]))))
}

impl Verdicts {
    /// Whether all statements could be tested, and hold.
    pub fn all_hold(&self) -> bool {
        self.errors.is_empty() && self.verdicts.iter().all(|verdict| verdict.holds)
    }

    /// The errors of the statements that cannot be tested, in their order.
    pub fn errors(&self) -> &[InputError] {
        &self.errors
    }

    /// The verdicts in the order of the statements.
    pub fn iter(&self) -> impl Iterator<Item = &Verdict> {
        self.verdicts.iter()
    }
}

impl Report for Verdicts {
    /// Writes the verdicts. JSON has the schema `affinor.claims/1`.
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        let entry = |verdict: &Verdict| {
            let Verdict { line, statement, holds, component, sides } = verdict;
            let mut entry = json!({ "claim": statement, "line": line, "holds": holds });
            if !component.is_empty() {
                entry["component"] = Value::from(component.as_str());
            }
            if let Some([left, right]) = sides {
                entry["left"] = Value::from(left.as_str());
                entry["right"] = Value::from(right.as_str());
            }
            entry
        };
        let json = json!({
            "schema": "affinor.claims/1",
            "name": self.name,
            "ok": self.all_hold(),
            "conventions": conventions_in_json(self.zero.as_deref()),
            "claims": self.iter().map(entry).collect::<Vec<_>>(),
        });
        let row = |verdict: &Verdict| -> Vec<Cell> {
            let [left, right] = verdict.sides.clone().unwrap_or_default();
            let answer = if verdict.holds { "yes" } else { "NO" };
            let [statement, component] =
                [&verdict.statement, &verdict.component].map(|text| printable(text));
            [statement, answer.into(), component, left, right].map(Into::into).to_vec()
        };
        let holding = self.iter().filter(|verdict| verdict.holds).count();
        let (name, all) = (printable(&self.name), self.verdicts.len());
        let title = format!("Claims about {name}: {holding} of {all} hold");
        let header = ["claim", "holds", "component", "left", "right"];
        Grid::new(title, &header, self.iter().map(row).collect(), json)
            .with_head(head_of_grid(self.zero.as_deref()))
            .write(format, out)
    }
}
