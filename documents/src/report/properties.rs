//! The properties of a geometry: each with its constant, or a witness of its failure.

use super::grid::{Cell, Grid};
use super::head::{kind_name, printable, printable_list};
use super::{Format, Report};
use crate::definition::{Definition, InputError, Reading};
use affinor::algebra::Complex;
use affinor::algebra::structure::{Ground, Structure};
use affinor::geometry::properties::Property;
use affinor::{Connection, Geometry, LieAlgebra, MatrixBasis};
use affinor_tensors::{Notation, Rational, Symbolic, Tensor, Tolerance};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest dimension at which bi-invariant connections are counted.
const SEARCHED: usize = 6;

/// The properties of a geometry, ready to be printed.
#[derive(Clone, Debug)]
pub struct Properties(Grid);

impl Properties {
    /// The properties of the connection and the metric of a definition.
    ///
    /// # Errors
    /// As [`Definition::geometry`].
    pub fn of(definition: &Definition) -> Result<Self, InputError> {
        let tolerance = Tolerance::default();
        if definition.parameters().is_empty() && !definition.is_on_chart() {
            let convert = |value: &Symbolic| value.as_constant().cloned();
            let reading = Reading::<Rational> { convert: &convert, tolerance };
            return Self::new(&definition.geometry(&reading)?);
        }
        let convert = |value: &Symbolic| Some(value.clone());
        let reading = Reading::<Symbolic> { convert: &convert, tolerance };
        Self::new(&definition.geometry(&reading)?)
    }

    /// The properties of a geometry.
    ///
    /// # Errors
    /// The first error of the library.
    pub fn new<S: Ground + Notation>(geometry: &Geometry<S>) -> Result<Self, InputError> {
        let connection = geometry.connection();
        let mut list = List::default();
        list.plain("torsion-free", connection.torsion_free());
        list.plain("flat", connection.flat());
        list.plain("parallel torsion", connection.parallel_torsion());
        list.plain("parallel curvature", connection.parallel_curvature());
        list.plain("locally symmetric", connection.locally_symmetric());
        if let Some(metric) = geometry.metric() {
            list.plain("metric-compatible", connection.metric_compatible(metric)?);
            list.valued("Einstein (Ric = c g)", connection.einstein_constant(metric)?, |c| {
                format!("c = {c}")
            });
            let curvature = connection.constant_curvature(metric)?;
            list.valued("constant curvature K", curvature, |k| format!("K = {k}"));
        }
        // the frame of a chart may have constant structure functions, but no invariant metric
        let algebra = geometry.algebra().filter(|_| geometry.frame_origin().fields().is_none());
        if let (Some(metric), Some(algebra)) = (geometry.metric(), algebra) {
            list.plain("bi-invariant metric", metric.bi_invariant(algebra)?);
            let reductive = metric.naturally_reductive(algebra)?;
            list.valued("naturally reductive", reductive, |_| "by translations".into());
            let soliton = metric.ricci_soliton(algebra)?;
            list.valued("algebraic Ricci soliton", soliton, |soliton| {
                format!("c = {}", soliton.constant)
            });
            let fields = metric.killing_fields(algebra)?;
            list.fact("left-invariant Killing fields", &format!("dimension {}", fields.len()));
        }
        if let Some(algebra) = algebra {
            if let Some(forms) = Structure::new(algebra.clone()).invariant_forms() {
                list.fact("bi-invariant symmetric forms", &format!("dimension {forms}"));
            }
            if algebra.dimension() <= SEARCHED {
                let all = Connection::bi_invariant(algebra)?.len();
                list.fact("bi-invariant connections", &format!("dimension {all}"));
            }
            let holonomy = connection.holonomy()?;
            let name = name_of(geometry.frame().dimension(), holonomy.basis()?)?;
            list.fact("holonomy algebra", &format!("dimension {}{name}", holonomy.rank()));
        }
        Ok(list.finish(geometry))
    }
}

/// What is known of a matrix algebra: its real simple ideals and the dimension of its centre.
fn name_of<S: Ground + Notation>(size: usize, basis: Vec<Tensor<S>>) -> Result<String, InputError> {
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
    if algebra.structure().is_empty() {
        return Ok(", abelian".into());
    }
    let structure = algebra.structure();
    if structure.components().any(|(_, value)| value.rational().is_none()) {
        return Ok(String::new());
    }
    let rational = Structure::new(algebra.map(|value| value.rational().unwrap_or_default())?);
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

#[derive(Default)]
struct List {
    rows: Vec<Vec<Cell>>,
    json: Vec<Value>,
}

impl List {
    fn plain<S: Notation>(&mut self, name: &str, property: Property<S>) {
        self.valued(name, property, |()| String::new());
    }

    fn valued<S: Notation, T>(
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
        self.rows.push(vec![name.into(), answer.into(), detail.as_str().into()]);
        let key = if holds { "value" } else { "witness" };
        let mut entry = json!({ "name": name, "holds": holds });
        if !detail.is_empty() {
            entry[key] = detail.into();
        }
        self.json.push(entry);
    }

    fn fact(&mut self, name: &str, value: &str) {
        self.rows.push(vec![name.into(), "".into(), value.into()]);
        self.json.push(json!({ "name": name, "value": value }));
    }

    fn finish<S: Notation>(self, geometry: &Geometry<S>) -> Properties {
        let json = json!({
            "schema": "affinor.properties/1",
            "name": geometry.name(),
            "connection": geometry.kind().name(),
            "has_metric": geometry.metric().is_some(),
            "scalar": kind_name(S::KIND),
            "properties": self.json,
        });
        let head: Vec<(&str, Cell)> = vec![
            ("basis", printable_list(geometry.frame().labels()).into()),
            ("connection", printable(&geometry.kind().describe()).into()),
            ("metric", if geometry.metric().is_some() { "given" } else { "none" }.into()),
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
