//! The isometry algebra of a metric: its dimension, its orbits, its name and its brackets.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::input::InputError;
use crate::space::Definition;
use affinor::Geometry;
use affinor::geometry::chart::field_of;
use affinor::geometry::isometry::{Certainty, IsometryAlgebra, Symmetry};
use affinor_tensors::text::combination;
use affinor_tensors::{Rational, Symbolic, Tensor, Tolerance};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.isometries/1";
/// The number of characters above which brackets are written in JSON only.
const LONGEST: usize = 400;

/// The isometry algebra of a space, ready for output.
#[derive(Clone, Debug)]
pub struct Isometries(Grid);

impl Isometries {
    /// The algebra of the Killing fields, or of the homothetic or conformal Killing fields, of the
    /// metric of a definition.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`] and [`IsometryAlgebra::of`].
    pub fn of(definition: &Definition, symmetry: Symmetry) -> Result<Self, InputError> {
        let tolerance = Tolerance::default();
        match definition.is_rational() {
            true => Self::of_rational(&definition.geometry(tolerance)?, symmetry),
            false => Self::of_symbolic(&definition.geometry(tolerance)?, symmetry),
        }
    }

    /// The algebra for an invariant metric of rational numbers.
    ///
    /// # Errors
    /// [`affinor::Error::NoMetric`], and those of [`IsometryAlgebra::invariant`].
    pub fn of_rational(
        geometry: &Geometry<Rational>,
        symmetry: Symmetry,
    ) -> Result<Self, InputError> {
        let metric = geometry.metric().ok_or(affinor::Error::NoMetric)?;
        let found = IsometryAlgebra::invariant(geometry.frame(), metric, symmetry)?;
        Ok(Self::new(geometry.name(), geometry.frame().labels(), &found, None))
    }

    /// The algebra for a metric with letters, or on a chart.
    ///
    /// # Errors
    /// Those of [`IsometryAlgebra::of`].
    pub fn of_symbolic(
        geometry: &Geometry<Symbolic>,
        symmetry: Symmetry,
    ) -> Result<Self, InputError> {
        let found = IsometryAlgebra::of(geometry, symmetry)?;
        Ok(Self::new(geometry.name(), geometry.frame().labels(), &found, None))
    }

    /// The algebra, and its fields in the functions of the chart, as far as they are found.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`] and [`IsometryAlgebra::with_fields`]; an error without a
    /// chart.
    pub fn with_fields(definition: &Definition, symmetry: Symmetry) -> Result<Self, InputError> {
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let metric = geometry.metric().ok_or_else(|| definition.without_metric())?;
        let Some(fields) = geometry.frame_origin().fields() else {
            let message = format!("the fields of {} have no components", definition.name);
            let error = InputError::usage(format!("{message}: it is not a chart"));
            return Err(error.help("leave --fields out, or give a chart"));
        };
        let (found, fields) = IsometryAlgebra::with_fields(fields, metric, symmetry)?;
        let components = Components { coordinates: definition.coordinates(), fields: &fields };
        Ok(Self::new(&definition.name, &definition.labels, &found, Some(components)))
    }

    fn new(
        space: &str,
        basis: &[String],
        found: &IsometryAlgebra,
        components: Option<Components<'_>>,
    ) -> Self {
        let fields = match found.symmetry() {
            Symmetry::Killing => "Killing fields",
            Symmetry::Homothetic => "homothetic fields",
            Symmetry::Conformal => "conformal Killing fields",
        };
        let (name, description) = (found.name(), found.description());
        let brackets = found.structure().map(|structure| structure.algebra().to_string());
        let mut rows: Vec<Vec<Cell>> = vec![];
        let mut row = |notion: &str, answer: &str, witness: &str| {
            rows.push(vec![notion.into(), answer.into(), witness.into()]);
        };
        row("dimension", &found.dimension().to_string(), certainty(found.certainty()));
        let transitive = match found.is_transitive() {
            true => "locally homogeneous",
            false => "not homogeneous",
        };
        row("orbit of a generic point", &found.orbit().to_string(), transitive);
        row("isotropy", &found.isotropy().to_string(), "the fields that vanish at the point");
        match (&name, &description, found.structure()) {
            (Some(name), ..) => row("algebra", name, ""),
            (None, Some(description), _) => row("algebra", "not named", description),
            (None, None, Some(_)) => row("algebra", "not named", ""),
            (None, None, None) if found.certainty() == Certainty::UpperBound => {
                row("algebra", "-", "the dimension is not stable");
            }
            (None, None, None) => row("algebra", "-", "the structure constants are too long"),
        }
        if let Some(brackets) = brackets.filter(|text| !text.is_empty()) {
            let long = brackets.chars().count() > LONGEST;
            row("brackets", "", if long { "in --format json" } else { &brackets });
        }
        let dimensions: Vec<String> = found.dimensions().iter().map(usize::to_string).collect();
        let orders = match found.symmetry() {
            Symmetry::Conformal => "jets that preserve the conformal curvature, to each order",
            _ => "jets that preserve R, nabla R, ...",
        };
        row("dimensions by order", &dimensions.join(", "), orders);
        if let Some(components) = &components {
            let all = found.dimension();
            let remark = match components.fields.len() == all {
                true => "a basis; each satisfies the equation identically",
                false => "the others are not in the span of the functions that were tried",
            };
            row("fields", &format!("{} of {all}", components.fields.len()), remark);
            for (at, field) in components.fields.iter().enumerate() {
                row(&format!("X{}", at + 1), &components.written(field), "");
            }
        }
        let [plus, minus] = found.signature();
        row("signature", &format!("({plus}, {minus})"), "positive and negative squares");
        if !found.values().is_empty() {
            let values = found.values().iter();
            let values: Vec<_> =
                values.map(|(name, v)| format!("{} = {v}", printable(name))).collect();
            row("sample values", "", &values.join(", "));
        }
        let title = format!("Algebra of {fields} of {}", printable(space));
        let head = vec![("basis", printable_list(basis).into())];
        let grid = Grid::new(
            title,
            &["notion", "answer", "remark"],
            rows,
            document(space, found, components.map(|components| components.fields)),
        );
        Isometries(grid.with_head(head))
    }
}

/// Fields in the functions of a chart.
struct Components<'a> {
    coordinates: &'a [String],
    fields: &'a [Tensor<Symbolic>],
}

impl Components<'_> {
    /// A field as a sum of multiples of the coordinate fields.
    fn written(&self, field: &Tensor<Symbolic>) -> String {
        let label = |at: usize| field_of(&self.coordinates[at]);
        combination(field.components().map(|(at, value)| (value.to_string(), label(at[0]))))
    }
}

/// The certainty in words.
fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Proved => "proved",
        Certainty::Generic => {
            "proved as an upper bound; exact unless the sample values are special"
        }
        Certainty::UpperBound => "proved as an upper bound, which higher orders may lower",
    }
}

/// The report in JSON.
fn document(space: &str, found: &IsometryAlgebra, fields: Option<&[Tensor<Symbolic>]>) -> Value {
    let algebra = found.structure().map(|structure| {
        let constants = structure.algebra().structure_constants().components();
        let constants = constants
            .filter(|(at, _)| at[1] < at[2])
            .map(|(at, value)| json!([at[1] + 1, at[2] + 1, at[0] + 1, value.to_string()]));
        json!({
            "name": found.name(),
            "description": found.description(),
            "basis": structure.algebra().labels(),
            "structure_constants": constants.collect::<Vec<_>>(),
        })
    });
    let values = found.values().iter().map(|(name, value)| json!([name, value.to_string()]));
    json!({
        "schema": SCHEMA,
        "name": space,
        "symmetry": found.symmetry().name(),
        "dimension": found.dimension(),
        "certainty": match found.certainty() {
            Certainty::Proved => "proved",
            Certainty::Generic => "generic",
            Certainty::UpperBound => "upper bound",
        },
        "orbit": found.orbit(),
        "isotropy": found.isotropy(),
        "homogeneous": found.is_transitive(),
        "orders": found.dimensions(),
        "signature": found.signature(),
        "sample": values.collect::<Vec<_>>(),
        "algebra": algebra,
        "fields": fields.map(|fields| {
            let field = |field: &Tensor<Symbolic>| {
                (0..found.space()).map(|i| field.get(&[i]).to_string()).collect::<Vec<_>>()
            };
            fields.iter().map(field).collect::<Vec<_>>()
        }),
    })
}

impl Report for Isometries {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
