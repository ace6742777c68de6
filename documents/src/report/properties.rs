//! The properties of a geometry. For each property, its constant or a witness of its failure.

use super::grid::{Cell, Grid};
use super::head::{kind_name, printable, printable_list};
use super::solve::alternatives;
use super::{Format, Report};
use crate::Coefficient;
use crate::input::InputError;
use crate::space::Definition;
use affinor::algebra::Complex;
use affinor::algebra::structure::{GroundField, StructureTheory};
use affinor::geometry::conditions::{Condition, ParametricGeometry};
use affinor::geometry::homogeneous::HomogeneousSpace;
use affinor::geometry::petrov::Petrov;
use affinor::geometry::properties::{Extreme, MAX_SEARCHED, Property};
use affinor::{
    Connection, ConnectionKind, Geometry, LieAlgebra, MatrixBasis, Metric, ReductivePair,
};
use affinor_tensors::text::{combination, exact_decimal, rounded};
use affinor_tensors::{Down, Rational, Ring, Symbolic, Tensor, Tolerance, Up};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

/// The largest dimension at which bi-invariant connections are computed.
const CONNECTIONS: usize = 8;
/// The largest dimension at which invariant metrics are computed.
const METRICS: usize = 16;
/// The largest number of characters of a family in the report. Longer families are written only in
/// JSON.
const LONGEST: usize = 240;

/// The extremes of the sectional curvature, if they are searched for.
type Found = Result<Option<[Extreme; 2]>, affinor::Error>;

/// A plane: its text, and the two vectors that span it.
type Plane<S> = (String, [Vec<S>; 2]);

/// The properties of a geometry, ready for output.
#[derive(Clone, Debug)]
pub struct Properties(Grid);

impl Properties {
    /// The properties of the connection and the metric of a definition.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`].
    pub fn of(definition: &Definition) -> Result<Self, InputError> {
        Self::with_planes(definition, &[])
    }

    /// The properties, and the sectional curvatures of planes. Each plane is given by two vectors,
    /// in the form that [`Definition::plane`] parses.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`] and [`Definition::plane`]; an error for planes without a
    /// metric.
    pub fn with_planes(definition: &Definition, planes: &[String]) -> Result<Self, InputError> {
        if definition.is_rational() {
            let geometry = definition.geometry::<Rational>(Tolerance::default())?;
            return Self::new(&geometry, None, &read(definition, planes)?);
        }
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        Self::new(&geometry, with_letters(&geometry), &read(definition, planes)?)
    }

    /// The properties of a geometry.
    ///
    /// # Errors
    /// Those of the properties of [`Geometry`], such as a missing metric.
    pub fn of_rational(geometry: &Geometry<Rational>) -> Result<Self, InputError> {
        Self::new(geometry, None, &[])
    }

    /// The properties of a geometry, with the values of letters for which a property that fails
    /// would hold.
    ///
    /// # Errors
    /// Those of the properties of [`Geometry`], such as a missing metric.
    pub fn of_symbolic(geometry: &Geometry<Symbolic>) -> Result<Self, InputError> {
        Self::new(geometry, with_letters(geometry), &[])
    }

    /// Computes the properties of a geometry, and the sectional curvatures of planes. `symbolic` is
    /// the geometry if it contains letters.
    fn new<S: GroundField + Coefficient>(
        geometry: &Geometry<S>,
        symbolic: Option<&Geometry<Symbolic>>,
        planes: &[Plane<S>],
    ) -> Result<Self, InputError> {
        let connection = geometry.connection();
        let names = names(geometry);
        let constant = |name: &str, value: &S| match names.contains(name) {
            true => format!("the constant is {value}"),
            false => format!("{name} = {value}"),
        };
        let mut list = List { symbolic, ..List::default() };
        list.plain("torsion-free", connection.torsion_free());
        list.only_if(Condition::TorsionFree);
        list.plain("flat", connection.flat());
        list.only_if(Condition::Flat);
        list.plain("parallel torsion", connection.parallel_torsion());
        list.only_if(Condition::ParallelTorsion);
        list.plain("parallel curvature", connection.parallel_curvature());
        list.only_if(Condition::ParallelCurvature);
        list.plain("locally symmetric", connection.locally_symmetric());
        list.only_if(Condition::LocallySymmetric);
        if let Some(metric) = geometry.metric() {
            list.plain("metric-compatible", connection.metric_compatible(metric)?);
            list.only_if(Condition::MetricCompatible);
            let einstein = connection.einstein_constant(metric)?;
            list.valued("Einstein (Ric = c g)", einstein, |c| constant("c", &c));
            list.only_if(Condition::Einstein);
            let curvature = connection.constant_curvature(metric)?;
            list.valued("constant curvature K", curvature, |k| constant("K", &k));
            list.only_if(Condition::ConstantCurvature);
            list.petrov(connection, metric)?;
        } else if !planes.is_empty() {
            let message = "the sectional curvature of a plane needs a metric";
            return Err(InputError::usage(message).help("give a metric, as in --metric identity"));
        }
        // on a chart, the structure functions may be constant although no metric is invariant
        let algebra = geometry.algebra().filter(|_| geometry.frame_origin().fields().is_none());
        if let (Some(metric), Some(algebra)) = (geometry.metric(), algebra) {
            list.plain("bi-invariant metric", metric.bi_invariant(algebra)?);
            list.only_if(Condition::BiInvariant);
            let reductive = metric.naturally_reductive(algebra)?;
            list.valued("naturally reductive", reductive, |_| "by translations".into());
            let soliton = metric.ricci_soliton(algebra)?;
            list.valued("algebraic Ricci soliton", soliton, |soliton| {
                constant("c", &soliton.constant)
            });
            list.only_if(Condition::RicciSoliton);
            let fields = metric.killing_fields(algebra)?;
            list.fact("left-invariant Killing fields", &format!("dimension {}", fields.len()));
            list.extremes(connection, metric, algebra.structure_constants(), |metric, value| {
                metric.sectional_extremes(&algebra.map(value)?)
            })?;
        }
        let pair = geometry.frame_origin().homogeneous().map(HomogeneousSpace::pair);
        if let (Some(metric), Some(pair)) = (geometry.metric(), pair) {
            let reductive = pair.naturally_reductive(metric)?;
            list.valued("naturally reductive", reductive, |()| "with respect to G".into());
            let constants = pair.algebra().structure_constants();
            list.extremes(connection, metric, constants, |metric, value| {
                let pair = ReductivePair::adapted(pair.algebra().map(value)?, pair.dimension())?;
                metric.sectional_extremes_in(pair.frame())
            })?;
        }
        if let Some(metric) = geometry.metric() {
            for (text, [x, y]) in planes {
                let value = connection.sectional_curvature(metric, x, y)?;
                let value = value.map_or("the plane is degenerate".into(), |k| constant("K", &k));
                list.fact(&format!("sectional curvature of {text}"), &value);
            }
        }
        let labels = geometry.frame().labels();
        let is_free = |letter: &&str| !names.iter().any(|name| is_numbered(letter, name));
        let letter = ["a", "b", "p", "q", "s"].into_iter().find(is_free).unwrap_or("a_");
        let family = Family { labels, letter, limit: METRICS, write: form };
        if let Some(pair) = pair {
            list.family("invariant symmetric forms", &family, || pair.invariant_forms())?;
            let family =
                Family { labels, letter, limit: CONNECTIONS, write: covariant_derivatives };
            list.family("invariant connections", &family, || {
                pair.invariant_tensors(&[Up, Down, Down])
            })?;
        }
        if let Some(algebra) = algebra {
            list.family("bi-invariant symmetric forms", &family, || {
                Metric::bi_invariant_forms(algebra)
            })?;
            list.family("parallel symmetric forms", &family, || connection.parallel_forms())?;
            let family =
                Family { labels, letter, limit: CONNECTIONS, write: covariant_derivatives };
            list.family("bi-invariant connections", &family, || Connection::bi_invariant(algebra))?;
        }
        if algebra.is_some() || pair.is_some() {
            let holonomy = match geometry.metric() {
                Some(metric) => connection.holonomy_beside(metric)?,
                None => connection.holonomy()?,
            };
            let name = name_of(geometry.frame().dimension(), holonomy.basis()?)?;
            list.fact("holonomy algebra", &format!("dimension {}{name}", holonomy.dimension()));
        }
        Ok(list.finish(geometry))
    }
}

/// The name of a matrix algebra, derived from its real simple ideals and the dimension of its
/// centre.
fn name_of<S: GroundField + Coefficient>(
    size: usize,
    basis: Vec<Tensor<S>>,
) -> Result<String, InputError> {
    if basis.is_empty() {
        return Ok(String::new());
    }
    let entries = |matrix: &Tensor<S>| {
        let entries = matrix.components();
        entries.map(|(at, value)| (at[0], at[1], Complex::real(value.clone()))).collect()
    };
    let labels = (1..=basis.len()).map(|at| format!("e{at}"));
    let matrices = basis.iter().map(entries).collect();
    let bracket = MatrixBasis::new(labels, size, matrices, Tolerance::default())?.bracket()?;
    let algebra = LieAlgebra::try_from(bracket)?;
    if algebra.structure_constants().is_empty() {
        return Ok(", abelian".into());
    }
    let structure = algebra.structure_constants();
    if structure.components().any(|(_, value)| value.rational().is_none()) {
        return Ok(String::new());
    }
    let rational = StructureTheory::new(algebra.map(|value| value.rational().unwrap_or_default())?);
    let levi = rational.levi()?;
    if levi.is_zero() {
        return Ok(", solvable".into());
    }
    let Some(ideals) = rational.subalgebra(levi)?.simple_ideals()? else {
        return Ok(String::new());
    };
    let mut names: Vec<String> = ideals.real.iter().map(|ideal| ideal.names.join(" or ")).collect();
    if !rational.radical().is_zero() {
        names.push(format!("a radical of dimension {}", rational.radical().dimension()));
    }
    Ok(format!(": {}", names.join(" + ")))
}

/// How a vector space of tensors is written in the report.
struct Family<'a> {
    labels: &'a [String],
    /// The letter with which the names of the parameters begin.
    letter: &'static str,
    /// The largest dimension of the algebra at which the vector space is computed.
    limit: usize,
    /// Writes the general element, from its components with parameters.
    write: fn(&[String], &BTreeMap<Vec<usize>, String>) -> String,
}

/// Writes a symmetric form: `g(x1, x1) = a1`.
fn form(labels: &[String], components: &BTreeMap<Vec<usize>, String>) -> String {
    let upper = components.iter().filter(|(at, _)| at[0] <= at[1]);
    let entry = |(at, value): (&Vec<usize>, &String)| {
        format!("g({}, {}) = {value}", printable(&labels[at[0]]), printable(&labels[at[1]]))
    };
    upper.map(entry).collect::<Vec<_>>().join(", ")
}

/// Writes affinities whose first index is upper: `nabla[e1, e2] = a1*e3`.
fn covariant_derivatives(labels: &[String], components: &BTreeMap<Vec<usize>, String>) -> String {
    let mut by_pair: BTreeMap<(usize, usize), Vec<(String, String)>> = BTreeMap::new();
    for (at, value) in components {
        let bracketed = if value.contains(' ') { format!("({value})") } else { value.clone() };
        by_pair.entry((at[1], at[2])).or_default().push((bracketed, printable(&labels[at[0]])));
    }
    let line = |((j, k), terms): ((usize, usize), Vec<(String, String)>)| {
        let (x, y) = (printable(&labels[j]), printable(&labels[k]));
        format!("nabla[{x}, {y}] = {}", combination(terms))
    };
    by_pair.into_iter().map(line).collect::<Vec<_>>().join(", ")
}

/// The planes that texts describe.
fn read<S: Coefficient>(
    definition: &Definition,
    planes: &[String],
) -> Result<Vec<Plane<S>>, InputError> {
    planes.iter().map(|text| Ok((text.clone(), definition.plane(text)?))).collect()
}

/// The geometry, if its components contain letters. On a chart, they are functions.
fn with_letters(geometry: &Geometry<Symbolic>) -> Option<&Geometry<Symbolic>> {
    let letters = ParametricGeometry::of(geometry).ok()?.letters();
    (!letters.is_empty()).then_some(geometry)
}

#[derive(Default)]
struct List<'a> {
    rows: Vec<Vec<Cell>>,
    json: Vec<Value>,
    /// The geometry, if it contains letters.
    symbolic: Option<&'a Geometry<Symbolic>>,
}

impl List<'_> {
    /// If the last property fails, adds the values of the letters for which it holds.
    fn only_if(&mut self, condition: Condition) {
        if cfg!(not(feature = "conditions")) {
            return;
        }
        let fails = self.json.last().is_some_and(|entry| entry["holds"] == false);
        let Some(geometry) = self.symbolic.filter(|_| fails) else { return };
        let Some(alternatives) = alternatives(geometry, condition) else { return };
        let text = match &alternatives[..] {
            [] => "for no real values of the letters".into(),
            all => format!("only if {}", all.join(", or ")),
        };
        let text = match text.chars().count() {
            0..=LONGEST => text,
            _ => format!("only if: see `affinor solve --for {}`", condition.name()),
        };
        if let Some(cell) = self.rows.last_mut().and_then(|row| row.last_mut()) {
            cell.text.push(printable(&text));
        }
        if let Some(entry) = self.json.last_mut() {
            entry["only_if"] = alternatives.into();
        }
    }

    fn plain<S: Coefficient>(&mut self, name: &str, property: Property<S>) {
        self.valued(name, property, |()| String::new());
    }

    fn valued<S: Coefficient, T>(
        &mut self,
        name: &str,
        property: Property<S, T>,
        write: impl Fn(T) -> String,
    ) {
        let (holds, detail) = match property {
            Property::Holds(value) => (true, write(value)),
            Property::Fails(witness) => (false, witness.to_string()),
        };
        let answer = if holds { "yes" } else { "no" };
        self.rows.push(vec![Cell::prose(name), answer.into(), Cell::prose(&detail)]);
        let key = if holds { "value" } else { "witness" };
        let mut entry = json!({ "name": name, "holds": holds });
        if !detail.is_empty() {
            entry[key] = detail.into();
        }
        self.json.push(entry);
    }

    fn fact(&mut self, name: &str, value: &str) {
        self.rows.push(vec![Cell::prose(name), "".into(), Cell::prose(value)]);
        self.json.push(json!({ "name": name, "value": value }));
    }

    /// Adds a vector space of tensors: its basis, and its general element with parameters `a1, a2,
    /// ...`.
    fn family<S: GroundField + Coefficient>(
        &mut self,
        name: &str,
        family: &Family,
        find: impl FnOnce() -> Result<Vec<Tensor<S>>, affinor::Error>,
    ) -> Result<(), InputError> {
        if family.labels.len() > family.limit {
            self.fact(name, &format!("not computed beyond dimension {}", family.limit));
            return Ok(());
        }
        let basis = find()?;
        let mut terms: BTreeMap<Vec<usize>, Vec<(String, String)>> = BTreeMap::new();
        for (at, tensor) in basis.iter().enumerate() {
            for (place, value) in tensor.components() {
                let term = (value.to_string(), format!("{}{}", family.letter, at + 1));
                terms.entry(place.to_vec()).or_default().push(term);
            }
        }
        let general = terms.into_iter().map(|(at, terms)| (at, combination(terms))).collect();
        let general = (family.write)(family.labels, &general);
        let detail = match general.chars().count() {
            0 => String::new(),
            1..=LONGEST => format!(": {general}"),
            _ => "; basis in --format json".into(),
        };
        self.fact(name, &format!("dimension {}{detail}", basis.len()));
        let components = |tensor: &Tensor<S>| {
            let entry = |(at, value): (affinor_tensors::Indices, &S)| {
                json!([at.iter().map(|i| i + 1).collect::<Vec<_>>(), value.to_string()])
            };
            tensor.components().map(entry).collect::<Vec<_>>()
        };
        if let Some(entry) = self.json.last_mut() {
            entry["dimension"] = basis.len().into();
            entry["basis"] = basis.iter().map(components).collect();
        }
        Ok(())
    }

    /// Adds the Petrov type of a spacetime, with the invariant `I` where it is real and short.
    fn petrov<S: GroundField + Coefficient>(
        &mut self,
        connection: &Connection<S>,
        metric: &Metric<S>,
    ) -> Result<(), InputError> {
        let levi_civita = connection.torsion_free().holds().is_some()
            && connection.metric_compatible(metric)?.holds().is_some();
        let found = if levi_civita { connection.petrov(metric)? } else { None };
        if let Some(Petrov { kind, quadratic: [real, imaginary], .. }) = found {
            let invariant = format!("; I = {real}");
            let shown = !real.vanishes() && imaginary.vanishes() && invariant.len() < LONGEST;
            self.fact("Petrov type", &format!("{kind}{}", if shown { &invariant } else { "" }));
        }
        Ok(())
    }

    /// Adds the extremes of the sectional curvature, if the connection and the metric are rational
    /// and compatible.
    fn extremes<S: GroundField + Coefficient>(
        &mut self,
        connection: &Connection<S>,
        metric: &Metric<S>,
        constants: &Tensor<S>,
        find: impl FnOnce(&Metric<Rational>, fn(&S) -> Rational) -> Found,
    ) -> Result<(), InputError> {
        let fits = connection.torsion_free().holds().is_some()
            && connection.metric_compatible(metric)?.holds().is_some();
        let rational =
            |tensor: &Tensor<S>| tensor.components().all(|(_, value)| value.rational().is_some());
        if !fits || !rational(metric.components()) || !rational(constants) {
            return Ok(());
        }
        let value = |value: &S| value.rational().unwrap_or_default();
        let labels = connection.frame().labels();
        let metric = Metric::new(labels, metric.components().map(value))?;
        let Some(extremes) = find(&metric, value)? else {
            let limit = "not searched: the metric is indefinite, or the dimension not 2 to";
            self.fact("extremes of K", &format!("{limit} {MAX_SEARCHED}"));
            return Ok(());
        };
        let names = [("smallest K", "at most"), ("largest K", "at least")];
        for (((name, bound), up), extreme) in names.into_iter().zip([true, false]).zip(extremes) {
            let vector = |x: &Vec<Rational>| {
                let terms = x.iter().zip(labels).filter(|(v, _)| !v.vanishes());
                let terms = terms.map(|(v, label)| (component(v), printable(label)));
                combination(terms.collect::<Vec<_>>())
            };
            let [x, y] = &extreme.plane;
            let (k, plane) = (&extreme.curvature, format!("plane {}, {}", vector(x), vector(y)));
            let text = match extreme.proved {
                true => format!("K = {k}, {plane}"),
                false => {
                    let k = shortened(k, up);
                    format!("{bound} {k}, {plane}; found by a search, not proved")
                }
            };
            self.fact(name, &text);
            let rows: Vec<Vec<String>> =
                extreme.plane.iter().map(|x| x.iter().map(Rational::to_string).collect()).collect();
            if let Some(entry) = self.json.last_mut() {
                entry["curvature"] = k.to_string().into();
                entry["plane"] = json!(rows);
                entry["proved"] = extreme.proved.into();
            }
        }
        Ok(())
    }

    fn finish<S: Coefficient>(self, geometry: &Geometry<S>) -> Properties {
        let json = json!({
            "schema": "affinor.properties/1",
            "name": geometry.name(),
            "connection": geometry.connection_name(),
            "has_metric": geometry.metric().is_some(),
            "scalar": kind_name(S::KIND),
            "properties": self.json,
        });
        let metric = match (geometry.metric(), geometry.kind()) {
            (None, _) => "none",
            (Some(_), ConnectionKind::LeviCivita) => "given",
            (Some(_), _) => {
                "given; Einstein and K are of the connection above, the Ricci soliton is of Levi-Civita"
            }
        };
        let head: Vec<(&str, Cell)> = vec![
            ("basis", Cell::prose(&printable_list(geometry.frame().labels()))),
            ("connection", printable(&geometry.describe_connection()).into()),
            ("metric", metric.into()),
        ];
        let title = format!("Properties of {}", printable(geometry.name()));
        let grid = Grid::new(title, &["property", "holds", "constant or witness"], self.rows, json);
        Properties(grid.with_head(head))
    }
}

impl Report for Properties {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}

/// The largest number of characters of a fraction; longer fractions are written as decimal numbers.
const LONG: usize = 20;
/// The number of significant digits of these decimal numbers. The search is accurate to more
/// digits.
const DIGITS: u32 = 10;

/// Writes a number. A long fraction is rounded up or down to ten significant digits.
fn shortened(value: &Rational, up: bool) -> String {
    let text = value.to_string();
    match text.len() > LONG {
        true => rounded(value, DIGITS, up).unwrap_or(text),
        false => text,
    }
}

/// Writes a component of a plane: a long fraction as an exact decimal number, a short fraction
/// unchanged.
fn component(value: &Rational) -> String {
    let text = value.to_string();
    // only the last denominator of the search makes fractions this long
    let long = text.len() > 8 && text.contains('/');
    long.then(|| exact_decimal(value, 8)).flatten().unwrap_or(text)
}

/// The names of the basis vectors and of the parameters. New parameters must have other names.
fn names<S: Coefficient>(geometry: &Geometry<S>) -> BTreeSet<String> {
    let tensors = [geometry.connection().affinities(), geometry.frame().structure_functions()];
    let tensors = tensors.into_iter().chain(geometry.metric().map(Metric::components));
    let mut values = tensors.flat_map(|tensor| tensor.components().map(|(_, value)| value));
    let mut names = S::parameters_of(&mut values);
    names.extend(geometry.frame().labels().iter().cloned());
    names
}

/// Whether `name` is `letter` followed by a number.
fn is_numbered(letter: &str, name: &str) -> bool {
    name.strip_prefix(letter).is_some_and(|number| number.parse::<usize>().is_ok())
}
