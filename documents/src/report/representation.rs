//! Representations: properties of a highest weight, products, powers and branching rules.

mod matrices;

pub use matrices::MatrixReport;

use super::grid::{Cell, Grid};
use super::{Format, Report};
use crate::input::InputError;
use crate::space::vectors;
use affinor::representation::diagram::labelled;
use affinor::representation::names::{name, names};
use affinor::representation::{
    CasimirElement, Decomposition, HighestWeight, ReductiveAlgebra, RepresentationError, Subalgebra,
};
use affinor::{LieAlgebra, Rational};
use num_bigint::BigInt;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The kind of a power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Power {
    /// Symmetric powers.
    Symmetric,
    /// Exterior powers.
    Exterior,
}

/// The operations on a representation, in the order in which they are done.
#[derive(Clone, Debug, Default)]
pub struct Operations {
    /// A power, with its degree.
    pub power: Option<(Power, usize)>,
    /// Highest weights of further factors, as text.
    pub tensor: Vec<String>,
    /// A subalgebra, as text.
    pub branch: Option<String>,
    /// Whether to list the dominant weights of the result, and not its components.
    pub weights: bool,
    /// The brackets of the algebra in the basis of vectors that span a subalgebra; by default the
    /// brackets of its Chevalley basis.
    pub brackets: Option<LieAlgebra<Rational>>,
}

/// A representation and the result of operations on it. JSON has the schema `affinor.rep/1`.
#[derive(Clone, Debug)]
pub struct RepresentationReport {
    grid: Grid,
}

impl RepresentationReport {
    /// Computes the operations on the representation of a reductive algebra whose highest weight is
    /// given as text.
    ///
    /// # Errors
    /// An error of usage for a text that does not name a representation or a subalgebra; a
    /// mathematical error for results beyond the limits.
    ///
    /// ```
    /// use affinor_documents::report::{Format, Operations, Report, RepresentationReport};
    /// let operations = Operations { tensor: vec!["3".into()], ..Operations::default() };
    /// let report = RepresentationReport::new(&"SU(3)".parse()?, "3", &operations)?;
    /// let mut csv = vec![];
    /// report.write(Format::Csv, &mut csv)?;
    /// assert!(String::from_utf8(csv)?.contains("\n3bar,\"[0,1]\",3,1,1\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        algebra: &ReductiveAlgebra,
        weight: &str,
        operations: &Operations,
    ) -> Result<Self, InputError> {
        let weight = HighestWeight::parse(algebra, weight).map_err(failure)?;
        let mut state = State::new(&weight);
        if let Some((kind, degree)) = operations.power {
            state.power(kind, degree)?;
        }
        for factor in &operations.tensor {
            let factor = HighestWeight::parse(algebra, factor).map_err(failure)?;
            state.tensor(&factor)?;
        }
        if let Some(text) = &operations.branch {
            state.branch(text, operations.brackets.as_ref())?;
        }
        Ok(RepresentationReport { grid: state.finish(operations.weights)? })
    }
}

impl Report for RepresentationReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.grid.write(format, out)
    }
}

/// Errors of limits and of restrictions are mathematical; all others are errors of usage.
pub(super) fn failure(error: RepresentationError) -> InputError {
    match error {
        RepresentationError::TooLarge { .. } | RepresentationError::NotACharacter { .. } => {
            InputError::mathematics(error.to_string())
        }
        other => InputError::usage(other.to_string()),
    }
}

/// A representation on its way through the operations, with the expected dimension and index.
struct State {
    weight: HighestWeight,
    value: Decomposition,
    dimension: BigInt,
    index: Vec<BigInt>,
    /// Lines of the head.
    steps: Vec<(&'static str, String)>,
    json: Vec<Value>,
}

impl State {
    fn new(weight: &HighestWeight) -> Self {
        State {
            weight: weight.clone(),
            value: Decomposition::irreducible(weight),
            dimension: weight.dimension().into(),
            index: weight.index().into_iter().map(BigInt::from).collect(),
            steps: vec![],
            json: vec![],
        }
    }

    /// The symmetric power of degree `k` has the dimension `C(n+k-1, k)`, and its index is the index
    /// times `C(n+k, k-1)`; the exterior power has `C(n, k)` and `C(n-2, k-1)`.
    fn power(&mut self, kind: Power, degree: usize) -> Result<(), InputError> {
        let (n, k) = (self.dimension.clone(), degree);
        let (word, dimension, factor) = match kind {
            Power::Symmetric => {
                self.value = self.value.symmetric_power(k).map_err(failure)?;
                ("symmetric", binomial(&n + k, k, 1), binomial(&n + k, k.wrapping_sub(1), 0))
            }
            Power::Exterior => {
                self.value = self.value.exterior_power(k).map_err(failure)?;
                ("exterior", binomial(n.clone(), k, 0), binomial(&n - 2, k.wrapping_sub(1), 0))
            }
        };
        self.dimension = dimension;
        self.index.iter_mut().for_each(|index| *index *= &factor);
        self.steps.push(("power", format!("{word} power of degree {degree}")));
        self.json.push(json!({ "operation": "power", "kind": word, "degree": degree }));
        Ok(())
    }

    fn tensor(&mut self, factor: &HighestWeight) -> Result<(), InputError> {
        let other = Decomposition::irreducible(factor);
        self.value = self.value.tensor(&other).map_err(failure)?;
        let (dimension, index) = (BigInt::from(factor.dimension()), factor.index());
        for (own, index) in self.index.iter_mut().zip(index) {
            *own = &*own * &dimension + BigInt::from(index) * &self.dimension;
        }
        self.dimension *= dimension;
        self.steps.push(("product", format!("with {}", with_name(factor))));
        self.json.push(json!({ "operation": "tensor", "factor": in_json(factor) }));
        Ok(())
    }

    fn branch(
        &mut self,
        text: &str,
        brackets: Option<&LieAlgebra<Rational>>,
    ) -> Result<(), InputError> {
        let text = text.trim();
        let span =
            text.strip_prefix("span").filter(|rest| !rest.starts_with(char::is_alphanumeric));
        let subalgebra = match span.map(str::trim) {
            Some("") => {
                let error = InputError::usage("`span` is not followed by vectors");
                return Err(
                    error.help("write vectors of the basis, such as `span e1 - f1, e2 - f2`")
                );
            }
            Some(vectors) => spanned(self.value.algebra(), vectors, brackets)?,
            None => Subalgebra::parse(self.value.algebra(), text).map_err(failure)?,
        };
        self.value = subalgebra.restrict(&self.value).map_err(failure)?;
        let embedding = subalgebra.embedding_index();
        let products = embedding.iter().map(|row| {
            row.iter().zip(&self.index).map(|(e, index)| index * BigInt::from(*e)).sum()
        });
        self.index = products.collect();
        let rows: Vec<String> = subalgebra.projection().iter().map(|row| list(row)).collect();
        self.steps.push((
            "restriction",
            format!("to {}, {}", subalgebra.algebra(), subalgebra.description()),
        ));
        self.steps.push(("projection", format!("[{}]", rows.join(","))));
        self.json.push(json!({
            "operation": "branch",
            "algebra": subalgebra.algebra().to_string(),
            "subalgebra": subalgebra.description(),
            "projection": subalgebra.projection(),
            "embedding_index": embedding,
        }));
        Ok(())
    }

    fn finish(self, weights: bool) -> Result<Grid, InputError> {
        let components = Component::all(&self.value);
        let dimension: BigInt =
            components.iter().map(|one| &one.dimension * one.multiplicity).sum();
        let index: Vec<BigInt> = (0..self.index.len())
            .map(|at| components.iter().map(|one| &one.index[at] * one.multiplicity).sum())
            .collect();
        let ok = dimension == self.dimension && index == self.index;
        let algebra = self.value.algebra().clone();
        let mut json = Map::new();
        json.insert("schema".into(), json!("affinor.rep/1"));
        json.insert("algebra".into(), algebra_in_json(self.weight.algebra()));
        json.insert("conventions".into(), json!({ "roots": ROOTS, "casimir": LENGTHS }));
        json.insert("representation".into(), described(&self.weight));
        json.insert("operations".into(), Value::from(self.json));
        let rows_in_json: Vec<Value> = components.iter().map(Component::json).collect();
        json.insert(
            "result".into(),
            json!({
                "algebra": algebra_in_json(&algebra),
                "dimension": dimension.to_string(),
                "index": texts(&index),
                "components": rows_in_json,
            }),
        );
        json.insert(
            "certificate".into(),
            json!({
                "dimension": self.dimension.to_string(),
                "index": texts(&self.index),
                "ok": ok,
            }),
        );
        let certificate = format!(
            "{}: the components have dimension {dimension} and index {}",
            if ok { "ok" } else { "FAILS" },
            numbers(&index)
        );
        let (title, plain) = (title(&self.weight, &self.steps), self.steps.is_empty());
        let mut head: Vec<(&'static str, Cell)> = vec![];
        if !plain || weights {
            head.push(("weight", with_name(&self.weight).into()));
            for (at, line) in labelled(&self.weight).lines().enumerate() {
                head.push((if at == 0 { "diagram" } else { "" }, Cell::drawn(line)));
            }
            head.push(("dimension", self.weight.dimension().to_string().into()));
            head.extend(self.steps.into_iter().map(|(key, text)| (key, text.into())));
            head.push(("certificate", certificate.into()));
            let (header, rows) = if weights {
                let character = self.value.character().map_err(failure)?;
                let rows = character.dominant_weights().map(|(weight, multiplicity)| {
                    let orbit = algebra.orbit_size(weight).to_string();
                    [list(weight), multiplicity.to_string(), orbit]
                });
                let rows: Vec<[String; 3]> = rows.collect();
                let objects = character.dominant_weights().map(|(weight, multiplicity)| {
                    let orbit = algebra.orbit_size(weight).to_string();
                    json!({ "labels": weight, "multiplicity": multiplicity.to_string(), "orbit": orbit })
                });
                json.insert("weights".into(), objects.collect());
                let cells = rows.into_iter().map(|row| row.map(Cell::from).to_vec()).collect();
                (&["dominant weight", "multiplicity", "weights in the orbit"][..], cells)
            } else {
                let cells = components.into_iter().map(|one| {
                    let dimension = one.dimension.to_string();
                    vec![
                        one.name.unwrap_or_else(|| dimension.clone()).into(),
                        list(one.weight.labels()).into(),
                        dimension.into(),
                        one.multiplicity.to_string().into(),
                        numbers(&one.index).into(),
                    ]
                });
                let header = &["component", "labels", "dimension", "multiplicity", "index"][..];
                (header, cells.collect())
            };
            return Ok(Grid::new(title, header, rows, Value::Object(json)).with_head(head));
        }
        let rows = properties(&self.weight)
            .into_iter()
            .map(|(key, cell)| vec![key.into(), cell])
            .collect();
        Ok(Grid::new(title, &["property", "value"], rows, Value::Object(json)))
    }
}

/// An irreducible component of a result.
struct Component<'v> {
    weight: &'v HighestWeight,
    multiplicity: i128,
    name: Option<String>,
    dimension: BigInt,
    index: Vec<BigInt>,
}

impl<'v> Component<'v> {
    /// The components of a representation by dimension.
    fn all(value: &'v Decomposition) -> Vec<Self> {
        let names = names(value.components().map(|(weight, _)| weight));
        let components = value.components().zip(names).map(|((weight, multiplicity), name)| {
            let dimension = weight.dimension();
            let index = weight.index_for_dimension(&dimension);
            let index = index.into_iter().map(BigInt::from).collect();
            Component { weight, multiplicity, name, dimension: dimension.into(), index }
        });
        let mut components: Vec<Self> = components.collect();
        components.sort_by(|a, b| a.dimension.cmp(&b.dimension));
        components
    }

    fn json(&self) -> Value {
        json!({
            "name": self.name,
            "labels": self.weight.labels(),
            "dimension": self.dimension.to_string(),
            "index": texts(&self.index),
            "multiplicity": self.multiplicity.to_string(),
        })
    }
}

/// The subalgebra that vectors span, such as `e1 - f1, e2 - f2, e3 - f3`.
fn spanned(
    algebra: &ReductiveAlgebra,
    text: &str,
    brackets: Option<&LieAlgebra<Rational>>,
) -> Result<Subalgebra, InputError> {
    let chevalley = match brackets {
        Some(_) => None,
        None => algebra.chevalley_algebra(),
    };
    let Some(basis) = brackets.or(chevalley.as_ref()) else {
        let message = format!("vectors cannot span a subalgebra of {algebra}, which has a centre");
        return Err(InputError::usage(message));
    };
    let vectors = vectors(basis.labels(), text)?;
    let found = match brackets {
        Some(brackets) => Subalgebra::spanned_in_basis(algebra, brackets, vectors),
        None => Subalgebra::spanned(algebra, vectors),
    };
    found.map_err(failure)
}

/// The numbering of the nodes.
const ROOTS: &str = "numbered as in Bourbaki";
/// The normalization of the Casimir eigenvalue.
const LENGTHS: &str = "(w, w + 2 rho), where long roots have squared length 2";

/// The normalization of the Casimir elements of higher degree.
const TRACES: &str = "traces of powers in the defining representation";
/// The largest degree of a Casimir element in the rows; JSON contains all.
const SHOWN_DEGREE: usize = 6;

/// The properties of an irreducible representation.
fn properties(weight: &HighestWeight) -> Vec<(&'static str, Cell)> {
    let algebra = weight.algebra();
    let index: Vec<BigInt> = weight.index().into_iter().map(BigInt::from).collect();
    let casimir: Vec<String> = weight.casimir().iter().map(ToString::to_string).collect();
    let mut rows: Vec<(&'static str, Cell)> = vec![
        ("highest weight", with_name(weight).into()),
        ("diagram", Cell::drawn(&labelled(weight))),
        ("dimension", weight.dimension().to_string().into()),
        ("algebra", format!("{algebra}, of dimension {}, {ROOTS}", algebra.dimension()).into()),
        ("dual", with_name(&weight.dual()).into()),
        ("reality", weight.indicator().to_string().into()),
        ("congruency class", class(weight).into()),
        ("Dynkin index", numbers(&index).into()),
        ("Casimir eigenvalue", format!("{}: {LENGTHS}", casimir.join(", ")).into()),
    ];
    let higher = higher_casimirs(weight).unwrap_or_default().into_iter().flatten();
    let shown = higher.filter(|(element, degree, _)| {
        *degree <= SHOWN_DEGREE || *element == CasimirElement::Pfaffian
    });
    let shown: Vec<String> = shown
        .map(|(element, degree, value)| match element {
            CasimirElement::Trace { .. } => format!("degree {degree}: {value}"),
            CasimirElement::Pfaffian => format!("Pfaffian: {value}"),
        })
        .collect();
    if !shown.is_empty() {
        rows.push(("higher Casimirs", format!("{}; {TRACES}", shown.join(", ")).into()));
    }
    rows
}

/// The Casimir elements of degree 3 and more of each simple factor, with their degrees and
/// eigenvalues; `None` if they are too large to compute.
fn higher_casimirs(weight: &HighestWeight) -> Option<Vec<Vec<(CasimirElement, usize, Rational)>>> {
    let ranks = weight.algebra().simple_factors().iter().map(|factor| factor.rank());
    let of_factor = |(rank, all): (usize, Vec<(CasimirElement, Rational)>)| {
        let with_degree = all.into_iter().map(|(element, value)| match element {
            CasimirElement::Trace { degree } => (element, degree as usize, value),
            CasimirElement::Pfaffian => (element, rank, value),
        });
        with_degree.filter(|(_, degree, _)| *degree > 2).collect()
    };
    Some(ranks.zip(weight.casimirs().ok()?).map(of_factor).collect())
}

fn class(weight: &HighestWeight) -> String {
    let factors = weight.congruency_class().into_iter().map(|residues| {
        let residues =
            residues.into_iter().map(|(value, modulus)| format!("{value} mod {modulus}"));
        let residues: Vec<String> = residues.collect();
        if residues.is_empty() { "0".into() } else { residues.join(" and ") }
    });
    factors.collect::<Vec<_>>().join(", ")
}

fn title(weight: &HighestWeight, steps: &[(&'static str, String)]) -> String {
    let algebra = weight.algebra();
    let start = format!("Representation {} of {algebra}", short(weight));
    match steps.iter().filter(|(key, _)| *key != "projection").count() {
        0 => start,
        _ => format!("{start}: {}", {
            let words: Vec<&str> =
                steps.iter().map(|(key, _)| *key).filter(|key| *key != "projection").collect();
            words.join(", ")
        }),
    }
}

/// The name, or the labels.
fn short(weight: &HighestWeight) -> String {
    name(weight).unwrap_or_else(|| weight.to_string())
}

fn with_name(weight: &HighestWeight) -> String {
    match name(weight) {
        Some(name) => format!("{weight} = {name}"),
        None => weight.to_string(),
    }
}

fn list(labels: &[i64]) -> String {
    let labels: Vec<String> = labels.iter().map(ToString::to_string).collect();
    format!("[{}]", labels.join(","))
}

fn texts(values: &[BigInt]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

fn numbers(values: &[BigInt]) -> String {
    if values.is_empty() { "none".into() } else { texts(values).join(", ") }
}

fn algebra_in_json(algebra: &ReductiveAlgebra) -> Value {
    let simple: Vec<String> = algebra.simple_factors().iter().map(ToString::to_string).collect();
    json!({
        "name": algebra.to_string(),
        "simple_factors": simple,
        "abelian_dimension": algebra.abelian_dimension(),
        "dimension": algebra.dimension(),
    })
}

fn in_json(weight: &HighestWeight) -> Value {
    let index: Vec<BigInt> = weight.index().into_iter().map(BigInt::from).collect();
    json!({
        "name": name(weight),
        "labels": weight.labels(),
        "dimension": weight.dimension().to_string(),
        "index": texts(&index),
    })
}

/// An irreducible representation with all its properties.
fn described(weight: &HighestWeight) -> Value {
    let mut object = in_json(weight);
    let casimir: Vec<String> = weight.casimir().iter().map(ToString::to_string).collect();
    object["dual"] = json!({ "name": name(&weight.dual()), "labels": weight.dual().labels() });
    object["reality"] = json!(weight.indicator().to_string());
    object["frobenius_schur"] = json!(weight.indicator().value());
    object["congruency_class"] = json!(weight.congruency_class());
    object["casimir"] = json!(casimir);
    let higher = higher_casimirs(weight).map(|factors| {
        let entry = |(element, degree, value): &(CasimirElement, usize, Rational)| {
            let element = match element {
                CasimirElement::Trace { .. } => "trace",
                CasimirElement::Pfaffian => "pfaffian",
            };
            json!({ "element": element, "degree": degree, "value": value.to_string() })
        };
        factors.iter().map(|all| all.iter().map(entry).collect::<Vec<_>>()).collect::<Vec<_>>()
    });
    object["higher_casimirs"] = json!(higher);
    object["diagram"] = json!(labelled(weight));
    object
}

/// The binomial coefficient `C(n - less, k)`; 0 for the degree -1, which wraps around.
fn binomial(n: BigInt, k: usize, less: i64) -> BigInt {
    if k == usize::MAX {
        return BigInt::from(0);
    }
    let n = n - less;
    (0..k).fold(BigInt::from(1), |value, i| value * (&n - BigInt::from(i)) / BigInt::from(i + 1))
}
