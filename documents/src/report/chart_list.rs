//! The charts of the catalogue that have the properties in a condition.

use super::Report;
use super::grid::{Cell, Grid};
use super::head::printable;
use crate::input::InputError;
use crate::space::NamedChart;
use affinor::Error;
use affinor::geometry::Geometry;
use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
use affinor::geometry::petrov::PetrovType;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Symbolic, Tolerance};
use serde_json::json;
use std::cell::OnceCell;

/// The properties of charts that a condition may name.
pub(super) const PROPERTIES: [&str; 12] = [
    "chart",
    "spacetime",
    "flat",
    "Ricci-flat",
    "Einstein",
    "homogeneous",
    "Petrov O",
    "Petrov N",
    "Petrov III",
    "Petrov D",
    "Petrov II",
    "Petrov I",
];

/// The properties of a chart that a condition requires.
pub(super) struct Wanted<'a> {
    pub dimension: &'a dyn Fn(usize) -> bool,
    /// The dimension of the algebra of Killing fields.
    pub isometries: Option<usize>,
    /// Each property, and whether it is required or excluded.
    pub properties: &'a [(String, bool)],
}

/// A chart of the catalogue. Its properties are computed when they are asked for.
struct Facts {
    geometry: Geometry<Symbolic>,
    spacetime: bool,
    /// `None` without a metric, and where no sample point is rational.
    isometries: OnceCell<Option<IsometryAlgebra>>,
    /// `None` except for spacetimes of dimension 4.
    petrov: OnceCell<Option<PetrovType>>,
}

impl Facts {
    fn new(geometry: Geometry<Symbolic>, spacetime: bool) -> Self {
        Facts { geometry, spacetime, isometries: OnceCell::new(), petrov: OnceCell::new() }
    }

    fn isometries(&self) -> Option<&IsometryAlgebra> {
        let found = || IsometryAlgebra::of(&self.geometry, Symmetry::Killing).ok();
        self.isometries.get_or_init(found).as_ref()
    }

    fn petrov(&self) -> Option<PetrovType> {
        *self.petrov.get_or_init(|| {
            let metric = self.geometry.metric().filter(|_| self.spacetime)?;
            Some(self.geometry.connection().petrov(metric).ok()??.kind)
        })
    }

    fn holds(&self, property: &str) -> Result<bool, Error> {
        let connection = self.geometry.connection();
        Ok(match property {
            "spacetime" => self.spacetime,
            "flat" => connection.flat().holds().is_some(),
            "Ricci-flat" => connection.ricci().is_empty(),
            "Einstein" => match self.geometry.metric() {
                Some(metric) => connection.einstein_constant(metric)?.holds().is_some(),
                None => false,
            },
            "homogeneous" => self.isometries().is_some_and(IsometryAlgebra::is_transitive),
            _ => match property.strip_prefix("Petrov ") {
                Some(name) => self.petrov().is_some_and(|kind| kind.to_string() == name),
                None => true,
            },
        })
    }

    /// Whether the chart has all properties that a condition requires.
    fn fit(&self, wanted: &Wanted) -> Result<bool, Error> {
        for (property, required) in wanted.properties {
            if self.holds(property)? != *required {
                return Ok(false);
            }
        }
        let dimension = || self.isometries().map(IsometryAlgebra::dimension);
        Ok(wanted.isometries.is_none_or(|n| dimension() == Some(n)))
    }
}

/// The charts that satisfy a condition, which the title repeats; `None` if there are none. JSON has
/// the schema `affinor.list/1`.
pub(super) fn charts_where(
    condition: &str,
    wanted: &Wanted,
) -> Result<Option<impl Report + use<>>, InputError> {
    let (mut rows, mut entries) = (vec![], vec![]);
    for chart in NamedChart::all() {
        checkpoint();
        let definition = chart.definition()?;
        if !(wanted.dimension)(definition.dimension()) {
            continue;
        }
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let facts = Facts::new(geometry, chart.is_spacetime());
        if !facts.fit(wanted)? {
            continue;
        }
        let isometries = facts.isometries().map(IsometryAlgebra::dimension);
        let mut words = vec![];
        for property in &PROPERTIES[1..] {
            if facts.holds(property)? {
                words.push(*property);
            }
        }
        entries.push(json!({
            "name": chart.name(),
            "dimension": definition.dimension(),
            "properties": words,
            "isometries": isometries,
        }));
        let number = |n: Option<usize>| n.map_or("-".into(), |n| n.to_string());
        let words = if words.is_empty() { "-".into() } else { words.join(", ") };
        let dimension = definition.dimension().to_string();
        rows.push(
            [chart.name().into(), dimension, number(isometries), words].map(Cell::from).to_vec(),
        );
    }
    let json = json!({ "schema": "affinor.list/1", "where": condition, "spaces": entries });
    let header = ["name", "dimension", "isometries", "properties"];
    let title = format!("Catalogue: {}", printable(condition));
    Ok((!rows.is_empty()).then(|| Grid::new(title, &header, rows, json)))
}

/// The rows of all charts in a list: name, coordinates, example. JSON entries as those of algebras.
pub(super) fn rows() -> Vec<[String; 3]> {
    let row = |chart: &NamedChart| {
        let definition = chart.definition().ok()?;
        let coordinates = definition.coordinates().join(", ");
        let summary = format!("{} in {coordinates}", definition.name);
        Some([chart.name().to_string(), summary, chart.name().to_string()])
    };
    NamedChart::all().filter_map(row).collect()
}
