//! The structure of a Lie algebra: one row a notion, with its answer and a witness.

mod basis;
mod forms;
mod roots;
mod rows;

pub use roots::dynkin_type;

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::Coefficient;
use crate::input::InputError;
use crate::space::Definition;
use affinor::algebra::structure::{
    Certified, GroundField, Identification, Indecomposable, Killing, MAX_BETTI, MAX_DECOMPOSED,
    MAX_DERIVATIONS, RealIdeal, StructureTheory, Subspace,
};
use affinor_tensors::linear::Row;
use affinor_tensors::text::combination;
use affinor_tensors::{Kind, Rational, Symbolic, Tolerance};
use basis::InBases;
use rows::Rows;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.info/1";
/// Bases of more vectors, or with more characters, are written in JSON only.
const SHOWN: usize = 12;
const LONGEST: usize = 240;

/// The structure of an algebra, ready to be printed.
#[derive(Clone, Debug)]
pub struct Info {
    grid: Grid,
    json: Map<String, Value>,
    /// The matrix that ends the object of a key.
    matrices: BTreeMap<&'static str, Rows>,
}

/// The values of a parameter at which the answers are compared with the generic ones.
const TRIED: [&str; 7] = ["-2", "-1", "-1/2", "0", "1/2", "1", "2"];
/// The answers that are compared.
const COMPARED: [&str; 15] = [
    "unimodular",
    "killing",
    "derived_series",
    "lower_central_series",
    "upper_central_series",
    "centre",
    "radical",
    "nilradical",
    "rank",
    "derivations",
    "betti",
    "index",
    "invariant_forms",
    "symplectic",
    "contact",
];

fn fraction(text: &str) -> Option<Rational> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    Rational::new(above.parse().ok()?, below.parse().ok()?)
}

/// The part of an answer that does not depend on a basis.
fn dimensions(answer: &Value) -> Value {
    let exists = |form: &Value| form["exists"].clone();
    match answer {
        Value::Object(form) if form.contains_key("exists") => {
            json!([exists(answer), form.get("exact").map(exists)])
        }
        _ => answer.get("dimension").or(answer.get("rank")).unwrap_or(answer).clone(),
    }
}

/// Whether two algebras have generators of their Casimir functions in the same degrees, as far as both were searched.
fn same_casimirs(a: &Value, b: &Value) -> bool {
    let [first, second] = [a, b].map(|found| found["degree"].as_u64().unwrap_or(0));
    let up_to = |found: &Value| -> Vec<u64> {
        let degrees = found["degrees"].as_array().into_iter().flatten().filter_map(Value::as_u64);
        degrees.filter(|degree| *degree <= first.min(second)).collect()
    };
    up_to(a) == up_to(b)
}

impl Info {
    /// The structure of the algebra of a definition; `stage` is called before each part.
    ///
    /// # Errors
    /// Brackets that define no Lie algebra; a chart; structure constants that no division of basis vectors by
    /// square roots makes rational.
    pub fn of(definition: &Definition, stage: &dyn Fn(&str)) -> Result<Self, InputError> {
        let definition = definition.algebra_alone();
        let tolerance = Tolerance::default();
        stage("jacobi");
        if definition.is_rational() {
            let algebra = definition.algebra::<Rational>(tolerance)?;
            return Self::new(&definition.name, &StructureTheory::new(algebra), &[], stage);
        }
        let (bases, parameters) = (InBases::of(&definition)?, definition.parameters());
        let numbers = bases.rational.over_the_rationals().filter(|_| parameters.is_empty());
        let mut info = match numbers {
            Some(algebra) => {
                Self::new(&definition.name, &StructureTheory::new(algebra), &[], stage)?
            }
            None => {
                let structure = StructureTheory::new(bases.rational.algebra().clone());
                Self::new(&definition.name, &structure, &parameters, stage)?
            }
        };
        info.describe(&bases);
        if let [parameter] = &parameters[..] {
            stage("exceptional values");
            info.exceptional_values(parameter, &definition);
        }
        Ok(info)
    }

    /// Adds the values of a parameter, of a few, at which an answer differs from the generic one.
    fn exceptional_values(&mut self, parameter: &str, definition: &Definition) {
        let at = |value: &&'static str| {
            let number = Symbolic::constant(fraction(value)?);
            let mut special = definition.clone();
            special.set(&[(parameter.to_string(), number)].into()).ok()?;
            Some((*value, Info::of(&special, &|_| ()).ok()?.json))
        };
        let special: Vec<_> = TRIED.iter().filter_map(at).collect();
        let differs = |json: &Map<String, Value>| {
            COMPARED.iter().any(|key| dimensions(&json[*key]) != dimensions(&self.json[*key]))
        };
        let more =
            |json: &Map<String, Value>| !same_casimirs(&json["casimirs"], &self.json["casimirs"]);
        let values = |wanted: &dyn Fn(&Map<String, Value>) -> bool| -> Vec<&str> {
            special.iter().filter(|(_, json)| wanted(json)).map(|(value, _)| *value).collect()
        };
        let (found, casimirs) = (values(&differs), values(&more));
        let answer = |found: &[&str]| match found {
            [] => "none of those tried".to_string(),
            _ => format!("{parameter} = {}", found.join(", ")),
        };
        let tried = format!("tried: {}", TRIED.join(", "));
        let mut rows = vec![["exceptional values", &answer(&found), &tried].map(Cell::from)];
        if casimirs.iter().any(|value| !found.contains(value)) {
            let why = "generators of other degrees";
            rows.push(["Casimirs change at", &answer(&casimirs), why].map(Cell::from));
        }
        self.grid.rows.extend(rows.into_iter().map(|row| row.to_vec()));
        self.json.insert("exceptional_values".into(), json!(found));
        self.json.insert("exceptional_casimirs".into(), json!(casimirs));
    }

    /// The structure of an algebra of this name, whose structure constants depend on `parameters`.
    ///
    /// # Errors
    /// None for a Lie algebra.
    pub fn new<S: GroundField + Coefficient>(
        name: &str,
        structure: &StructureTheory<S>,
        parameters: &[String],
        stage: &dyn Fn(&str),
    ) -> Result<Self, InputError> {
        let mut notes = Notes::new(structure.algebra().labels());
        let n = structure.dimension();
        stage("series");
        let killing = structure.killing();
        let derived = structure.derived_series();
        let lower = structure.lower_central_series();
        let upper = structure.upper_central_series();
        let centre = structure.centre();
        stage("radical");
        let (radical, nilradical) = (structure.radical(), structure.nilradical());
        stage("levi");
        let levi = structure.levi()?;
        stage("cartan");
        let cartan = structure.cartan_subalgebra();
        stage("type");
        let types = structure.dynkin_type();
        let inside = rational_subalgebra(structure, levi)?;
        let ideals = match &inside {
            _ if levi.is_zero() => Some(vec![]),
            Some(inside) => inside.simple_ideals()?.map(|ideals| ideals.real),
            None => None,
        };
        stage("derivations");
        let (counted, inner) = (structure.derivation_dimension(), n - centre.dimension());
        let derivations = counted.map(|all| all.dimension);
        let forms = structure.invariant_form_dimension();
        stage("cohomology");
        let betti = structure.betti_numbers();
        let (index, unimodular) = (structure.index(), structure.is_unimodular());

        let last = |series: &[Subspace<S>]| series.last().is_some_and(Subspace::is_zero);
        let (solvable, nilpotent) = (last(derived), last(derived) && last(lower));
        let simple = match (&ideals, types.as_deref()) {
            _ if !radical.is_zero() => Some(false),
            (Some(ideals), _) => Some(ideals.len() == 1),
            // simple over the complex numbers, for generic values of the parameters
            (None, Some([_])) => Some(true),
            (None, _) => None,
        };
        let complete = match derivations {
            _ if !centre.is_zero() => Some(false),
            all => all.map(|all| all == inner),
        };
        let unproved = centre.is_zero() && counted.is_some_and(|all| !all.proved);
        let steps = |series: &[Subspace<S>], is: bool| is.then(|| series.len() - 1);
        let (class, length) = (steps(lower, nilpotent), steps(derived, solvable));
        let words = |value: Option<usize>, unit: &str| value.map(|v| format!("{unit} {v}"));
        notes.flags(&[
            ("abelian", Some(structure.is_abelian()), None),
            ("nilpotent", Some(nilpotent), words(class, "step")),
            ("solvable", Some(solvable), words(length, "length")),
            ("unimodular", Some(unimodular), None),
            ("perfect", Some(structure.is_perfect()), None),
            ("reductive", Some(structure.is_reductive()), None),
            ("semisimple", Some(structure.is_semisimple()), None),
            ("simple", simple, None),
            ("complete", complete, unproved.then(|| certainty(false).into())),
        ]);
        notes.json.insert("nilpotency_class".into(), json!(class));
        notes.json.insert("derived_length".into(), json!(length));
        notes.series("derived series", "derived_series", derived);
        notes.series("lower central series", "lower_central_series", lower);
        notes.series("upper central series", "upper_central_series", &upper);
        notes.subspace("centre", "centre", &centre, "commutes with the basis");
        notes.killing(killing);
        let why = "orthogonal to [L, L] for the Killing form";
        notes.subspace("solvable radical", "radical", radical, why);
        notes.subspace("nilradical", "nilradical", &nilradical, "largest nilpotent ideal");
        let why = "closed, Killing form not degenerate";
        notes.subspace("Levi subalgebra", "levi", levi, why);
        notes.json.insert("rank".into(), json!(cartan.dimension()));
        let why = "nilpotent, its own normalizer";
        notes.subspace("Cartan subalgebra", "cartan_subalgebra", &cartan, why);
        notes.types(types.as_deref(), levi.is_zero());
        stage("roots");
        let over_q = rational_subspace(levi);
        notes.roots(types.as_deref(), inside.as_ref().zip(over_q.as_ref()));
        notes.ideals(ideals.as_deref(), levi.is_zero());
        notes.derivations(counted, inner);
        notes.betti(betti.as_ref().map(|(numbers, proved)| (&numbers[..], *proved)));
        let why = "dimension minus the generic rank of f([x,y])";
        notes.count("index", "index", Some(index), why);
        let why = "dimension of B([x,y],z) = B(x,[y,z])";
        notes.count("invariant forms", "invariant_forms", forms, why);
        let rational = over_the_rationals(structure)?;
        stage("forms");
        notes.cocycles(structure);
        notes.complex_structure(rational.as_ref());
        notes.nondegenerate_forms(structure);
        stage("casimirs");
        notes.casimirs(structure);
        stage("decomposition");
        notes.decomposition(rational.as_ref())?;
        stage("identification");
        notes.identification(rational.as_ref().and_then(|all| all.identify()));
        Ok(notes.finish(name, n, S::KIND, parameters))
    }
}

/// The Levi subalgebra in the basis of its echelon form, where its constants are rational.
fn rational_subalgebra<S: GroundField>(
    structure: &StructureTheory<S>,
    levi: &Subspace<S>,
) -> Result<Option<StructureTheory<Rational>>, InputError> {
    if levi.is_zero() {
        return Ok(None);
    }
    Ok(structure.subalgebra(levi)?.over_the_rationals())
}

/// How sure a dimension is that was found by ranks modulo primes.
fn certainty(proved: bool) -> &'static str {
    if proved { "proved" } else { "modulo two primes" }
}

/// A subspace whose basis is rational.
fn rational_subspace<S: GroundField>(subspace: &Subspace<S>) -> Option<Subspace<Rational>> {
    let rows = subspace.basis().iter().map(|row| {
        row.iter().map(|(at, value)| Some((*at, value.rational()?))).collect::<Option<Row<_>>>()
    });
    Some(Subspace::span(subspace.ambient(), rows.collect::<Option<Vec<_>>>()?))
}

/// The algebra with rational constants, if it has such and its dimension is low.
fn over_the_rationals<S: GroundField>(
    structure: &StructureTheory<S>,
) -> Result<Option<StructureTheory<Rational>>, InputError> {
    let low = structure.dimension() <= MAX_DECOMPOSED;
    Ok(low.then(|| structure.over_the_rationals()).flatten())
}

/// The rows and the keys, as they are found.
struct Notes {
    labels: Vec<String>,
    rows: Vec<Vec<Cell>>,
    json: Map<String, Value>,
    matrices: BTreeMap<&'static str, Rows>,
}

impl Notes {
    fn new(labels: &[String]) -> Self {
        let labels = labels.iter().map(|label| printable(label)).collect();
        Notes { labels, rows: vec![], json: Map::new(), matrices: BTreeMap::new() }
    }

    fn row(&mut self, notion: &str, answer: impl Into<Cell>, witness: &str) {
        self.rows.push(vec![notion.into(), answer.into(), witness.into()]);
    }

    fn flags(&mut self, flags: &[(&str, Option<bool>, Option<String>)]) {
        let of = |wanted: bool| {
            let named = flags.iter().filter(|(_, value, _)| *value == Some(wanted));
            let words = named.map(|(name, _, more)| match more {
                Some(more) => format!("{name} ({more})"),
                None => name.to_string(),
            });
            let words = words.collect::<Vec<_>>().join(", ");
            if words.is_empty() { "-".into() } else { words }
        };
        self.row("it is", of(true), "");
        self.row("it is not", of(false), "");
        for (name, value, _) in flags {
            self.json.insert(name.to_string(), json!(value));
        }
    }

    fn series<S: GroundField>(&mut self, title: &str, key: &str, series: &[Subspace<S>]) {
        let dimensions: Vec<usize> = series.iter().map(Subspace::dimension).collect();
        let text: Vec<String> = dimensions.iter().map(usize::to_string).collect();
        self.row(title, text.join(", "), "dimensions, until stable");
        self.json.insert(key.into(), json!(dimensions));
    }

    fn subspace<S: GroundField>(
        &mut self,
        title: &str,
        key: &'static str,
        subspace: &Subspace<S>,
        why: &str,
    ) {
        let dimension = subspace.dimension();
        let basis: Vec<String> =
            subspace.basis().iter().take(SHOWN).map(|row| self.vector(row)).collect();
        let basis = basis.join(", ");
        let answer = match dimension {
            0 => "0".to_string(),
            all if all == subspace.ambient() => "the whole algebra".into(),
            1..=SHOWN if basis.len() <= LONGEST => format!("dimension {dimension}: {basis}"),
            _ => format!("dimension {dimension}; basis in --format json"),
        };
        let trivial = dimension == 0 || dimension == subspace.ambient();
        self.row(title, answer, if trivial { "" } else { why });
        let rows = subspace.basis().iter().map(Vec::as_slice);
        self.matrices.insert(key, Rows::new("basis", subspace.ambient(), rows));
        self.json.insert(key.into(), json!({ "dimension": dimension }));
    }

    fn vector<S: GroundField>(&self, row: &Row<S>) -> String {
        combination(row.iter().map(|(at, value)| (value.to_string(), self.labels[*at].clone())))
    }

    fn killing<S: GroundField>(&mut self, killing: &Killing<S>) {
        let (rank, signature) = (killing.rank(), killing.signature());
        let determinant = killing.determinant().to_string();
        let signs = match signature {
            Some([plus, minus, zero]) => format!("signature ({plus}, {minus}, {zero})"),
            None => "signature not known for all parameters".into(),
        };
        let size = determinant.len();
        let shown =
            if size > 40 { format!("a number of {size} characters") } else { determinant.clone() };
        let values: Vec<String> = killing.values.iter().take(SHOWN).map(S::to_string).collect();
        let short = killing.values.len() <= SHOWN && values.concat().len() <= 80;
        let witness = if short { format!("diagonal {}", values.join(", ")) } else { String::new() };
        let answer = format!("rank {rank}, {signs}, determinant {shown}");
        self.row("Killing form", answer, &witness);
        let matrix = &killing.matrix;
        let rows =
            Rows::new("matrix", matrix.columns(), (0..matrix.rows()).map(|at| matrix.row(at)));
        self.matrices.insert("killing", rows);
        let killing = json!({ "rank": rank, "signature": signature, "determinant": determinant });
        self.json.insert("killing".into(), killing);
    }

    fn ideals(&mut self, ideals: Option<&[RealIdeal]>, solvable: bool) {
        let entry = |ideal: &RealIdeal| {
            json!({
                "type": ideal.type_name(),
                "dimension": ideal.dimension(),
                "real_form": ideal.names.join(" or "),
                "signature": ideal.signature,
                "ideal_over_q": ideal.within + 1,
            })
        };
        let all = ideals.map(|ideals| ideals.iter().map(entry).collect::<Vec<_>>());
        self.json.insert("simple_ideals".into(), json!(all));
        let Some(ideals) = ideals.filter(|_| !solvable) else { return };
        let line = |ideal: &RealIdeal| {
            let [plus, minus] = ideal.signature;
            let name = ideal.names.join(" or ");
            let dimension = ideal.dimension();
            format!(
                "{name}: type {}, dimension {dimension}, signature ({plus}, {minus})",
                ideal.type_name()
            )
        };
        let lines: Vec<String> = ideals.iter().map(line).collect();
        let over_q = ideals.iter().map(|ideal| ideal.within + 1).max().unwrap_or(0);
        let witness = match over_q == ideals.len() {
            true => "of the Levi subalgebra, over the reals".to_string(),
            false => format!("of the Levi subalgebra, over the reals; {over_q} over the rationals"),
        };
        self.row("simple ideals", lines.join("\n"), &witness);
    }

    fn derivations(&mut self, counted: Option<Certified>, inner: usize) {
        let Some(Certified { dimension: all, proved }) = counted else {
            let why = format!("not counted beyond dimension {MAX_DERIVATIONS}");
            self.row("derivations", "-", &why);
            self.json.insert("derivations".into(), Value::Null);
            return;
        };
        let outer = all - inner;
        let text = format!("dimension {all}: {inner} inner, {outer} outer");
        let why = format!("the dimension of the automorphism group; {}", certainty(proved));
        self.row("derivations", text, &why);
        let json = json!({ "dimension": all, "inner": inner, "outer": outer });
        self.json.insert("derivations".into(), json);
    }

    fn betti(&mut self, betti: Option<(&[u64], bool)>) {
        match betti {
            Some((numbers, proved)) => {
                let text: Vec<String> = numbers.iter().map(u64::to_string).collect();
                let how = match numbers.len() <= MAX_BETTI + 1 {
                    true => certainty(proved),
                    false => "by the exponents",
                };
                let why = format!("Chevalley-Eilenberg, trivial coefficients; {how}");
                self.row("Betti numbers", text.join(", "), &why);
            }
            None => {
                let why = format!(
                    "not computed beyond dimension {MAX_BETTI} unless reductive, nor beyond 2^53"
                );
                self.row("Betti numbers", "-", &why);
            }
        }
        self.json.insert("betti".into(), json!(betti.map(|(numbers, _)| numbers)));
    }

    fn count(&mut self, title: &str, key: &str, count: Option<Certified>, meaning: &str) {
        let witness = match count {
            Some(count) => format!("{meaning}; {}", certainty(count.proved)),
            None => meaning.to_string(),
        };
        let count = count.map(|count| count.dimension);
        let text = count.map_or_else(|| "-".into(), |count| count.to_string());
        self.row(title, text, &witness);
        self.json.insert(key.into(), json!(count));
    }

    fn decomposition(
        &mut self,
        structure: Option<&StructureTheory<Rational>>,
    ) -> Result<(), InputError> {
        let ideals = structure.map(|all| all.indecomposable_ideals()).transpose()?.flatten();
        let entry = |part: &Indecomposable| {
            let rows = part.ideal.dense();
            let rows: Vec<Vec<String>> =
                rows.iter().map(|row| row.iter().map(Rational::to_string).collect()).collect();
            json!({ "dimension": part.ideal.dimension(), "basis": rows, "real_parts": part.real_parts })
        };
        let json = ideals.as_ref().map(|ideals| ideals.iter().map(entry).collect::<Vec<_>>());
        self.json.insert("indecomposable_ideals".into(), json!(json));
        let Some(ideals) = ideals else { return Ok(()) };
        let text: Vec<String> = ideals.iter().map(|p| p.ideal.dimension().to_string()).collect();
        let real: usize = ideals.iter().map(|part| part.real_parts).sum();
        let witness = match real == ideals.len() {
            true => "dimensions; idempotents of the centroid".to_string(),
            false => format!("dimensions over the rationals; {real} ideals over the reals"),
        };
        self.row("indecomposable ideals", text.join(" + "), &witness);
        Ok(())
    }

    fn identification(&mut self, found: Option<Identification>) {
        let Some(Identification { names, parameter, isomorphism, under_root, root, proved }) =
            found
        else {
            self.json.insert("identification".into(), Value::Null);
            return;
        };
        let name = names.join(" or ");
        let images = isomorphism.map(|rows| {
            rows.iter()
                .map(|row| row.iter().map(Rational::to_string).collect())
                .collect::<Vec<Vec<_>>>()
        });
        let written = images.as_ref().map(|rows| {
            let vector = |row: &Vec<String>| {
                let terms = row.iter().cloned().zip(self.labels.iter().cloned());
                combination(terms.filter(|(value, _)| value != "0"))
            };
            rows.iter().map(vector).collect::<Vec<_>>().join(", ")
        });
        let witness = match written {
            Some(images) => match &under_root {
                Some(numbers) => {
                    let roots = numbers.iter().map(|v| format!("sqrt({v})")).collect::<Vec<_>>();
                    format!("its basis is {images}, times {}", roots.join(", "))
                }
                None => format!("its basis is {images}"),
            },
            None => match &root {
                _ if !proved => format!("by invariants; {}", certainty(proved)),
                Some(number) => format!("isomorphic over the reals; sqrt({number}) is needed"),
                None => "by invariants".into(),
            },
        };
        let text = match &parameter {
            Some(equation) => format!("{name}, {equation}"),
            None => name.clone(),
        };
        self.row("identification", text, &witness);
        let roots = under_root.map(|all| all.iter().map(Rational::to_string).collect::<Vec<_>>());
        let mut json = json!({
            "name": name, "parameter": parameter, "isomorphism": images, "under_root": roots,
        });
        if let Some(number) = root {
            json["root"] = json!(number.to_string());
        }
        self.json.insert("identification".into(), json);
    }

    fn finish(self, name: &str, dimension: usize, kind: Kind, parameters: &[String]) -> Info {
        let mut json = Map::new();
        let generic = !parameters.is_empty();
        json.insert("schema".into(), SCHEMA.into());
        json.insert("name".into(), name.into());
        json.insert("basis".into(), json!(self.labels));
        json.insert("parameters".into(), json!(parameters));
        json.insert("generic".into(), json!(generic));
        json.insert("dimension".into(), json!(dimension));
        json.extend(self.json);
        let field = match (kind, generic) {
            (Kind::Symbolic, true) => format!(
                "rational functions of {}; every answer holds for generic values",
                printable_list(parameters)
            ),
            _ => "rational numbers; the answers hold over the real numbers".into(),
        };
        let head: Vec<(&str, Cell)> = vec![
            ("dimension", dimension.to_string().into()),
            ("basis", self.labels.join(", ").into()),
            ("field", field.into()),
        ];
        let title = format!("Structure of {}", printable(name));
        let header = ["notion", "answer", "witness"];
        let grid = Grid::new(title, &header, self.rows, Value::Null).with_head(head);
        Info { grid, json, matrices: self.matrices }
    }
}

impl Report for Info {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        if format != Format::Json {
            return self.grid.write(format, out);
        }
        // one key a line: bases are long
        for (at, (key, value)) in self.json.iter().enumerate() {
            out.write_all(if at == 0 { b"{\n" } else { b",\n" })?;
            write!(out, "  {}: ", Value::from(key.as_str()))?;
            match self.matrices.get(key.as_str()) {
                Some(rows) => rows.write_into(value, out)?,
                None => write!(out, "{value}")?,
            }
        }
        writeln!(out, "\n}}")
    }
}
