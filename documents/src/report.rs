//! Tables of tensors, comparisons and equations, written in several formats.
//!
//! In reading order: [`Quantity`] names the tensors, [`Table`] computes them, and one module for
//! each format writes them. [`tensors_as_code`] writes the tensors as a program, and a
//! [`TensorProgram`] computes them from numbers. [`Comparison`] compares two geometries, and tests
//! the [`Claim`]s of Paraskevopoulos and Natsiavas (2013) about them. [`EquationReport`] writes
//! equations of motion, also as source code. [`StoredTable`] compares a table with a stored table.
//! [`Statements`] are claims about a geometry, each of which is tested. [`Info`] is the structure
//! of an algebra, [`Properties`] are the properties of a geometry, [`Isometries`] are its
//! Killing fields, and [`Geodesics`] join two points. A [`RepresentationReport`] is about a
//! representation of a reductive algebra, and a [`MatrixReport`] contains its matrices. A
//! [`CouplingReport`] lists coupling coefficients.
//!
//! Each of these types is a [`Report`]. Short lists are [`conventions`], the [`catalogue`], a
//! [`certificate`] and any other [`listing`]. A [`Computation`] creates the reports of a space,
//! with the kind of scalars that the space needs.

mod card;
mod chart_list;
mod claims;
mod code;
mod comparison;
mod components;
mod computation;
mod coupling;
mod csv;
mod equations;
mod factors;
mod forms;
mod geodesics;
mod grid;
mod head;
#[cfg(feature = "curves")]
mod horizontal;
mod html;
mod hypersurface;
mod identifiers;
mod indexed;
mod info;
mod isometries;
mod json;
mod latex;
#[cfg(feature = "mechanisms")]
mod linearization;
mod lists;
mod markdown;
#[cfg(feature = "mechanisms")]
mod mobility;
mod points;
mod program;
mod properties;
mod quantity;
mod representation;
mod solve;
mod spacetime;
mod statements;
mod stored;
mod text;
mod typeset;

pub use card::{Card, CardKind};
pub use claims::Claim;
pub use code::{Language, Programmed, tensors_as_code};
pub use comparison::{ComparedSide, Comparison};
pub use components::{GROUPED, Group, groups, independent};
pub use computation::{Compared, Computation, SIMPLIFIED_AT_POINTS, Selection, TableReport};
pub use coupling::{CouplingCoefficient, CouplingKind, CouplingReport, MAX_COEFFICIENTS};
pub use equations::EquationReport;
pub use forms::FormReport;
pub use geodesics::Geodesics;
#[cfg(feature = "curves")]
pub use horizontal::HorizontalReport;
pub use hypersurface::HypersurfaceReport;
pub use info::{Coefficients, Info, dynkin_type};
pub use isometries::Isometries;
pub use latex::{components_in_latex, labelled_in_latex};
#[cfg(feature = "mechanisms")]
pub use linearization::LinearizationReport;
pub use lists::{catalogue, catalogue_where, certificate, conventions, listing};
#[cfg(feature = "mechanisms")]
pub use mobility::MobilityReport;
pub use points::TensorProgram;
pub use program::Program;
pub use properties::Properties;
pub use quantity::Quantity;
pub use representation::{MatrixReport, Operations, Power, RepresentationReport};
pub use solve::Solutions;
pub use spacetime::Spacetime;
pub use statements::{Statements, Verdict, Verdicts};
pub use stored::{Convention, Differences, StoredTable, Verification};
pub use text::{components_in_text, grouped_in_text, labelled_in_text};

use crate::Coefficient;
use affinor::{Error, Geometry};
use affinor_tensors::{Kind, Tensor, Tolerance};
use std::borrow::Cow;
use std::io::{self, BufWriter, Write};

/// The tensors of one geometry, ready for output.
///
/// ```
/// use affinor_documents::report::{Format, Quantity, Report, Table};
/// use affinor::{Bracket, CanonicalConnection, ConnectionKind, Geometry, LieAlgebra};
/// use affinor::tensors::Rational;
/// let rotations = Bracket::from_fn(&["e1", "e2", "e3"], |j, k| match (j, k) {
///     (0, 1) => vec![(2, Rational::from(1))],
///     (0, 2) => vec![(1, Rational::from(-1))],
///     _ => vec![(0, Rational::from(1))],
/// })?;
/// let algebra = LieAlgebra::try_from(rotations)?;
/// let zero = ConnectionKind::Canonical(CanonicalConnection::Zero);
/// let geometry = Geometry::new("so(3)", algebra, zero, None)?;
/// let table = Table::new(&geometry, &[Quantity::Ricci])?;
/// let mut csv = Vec::new();
/// table.write(Format::Csv, &mut csv)?;
/// assert!(csv.starts_with(b"tensor,i,j,k,l,value\nricci,1,1,,,1/2\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Table<S> {
    /// The name of the space.
    pub name: String,
    /// The name of the algebra. It is the name of the space, unless the algebra has another known
    /// name.
    pub algebra: String,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    /// The parameters that the components depend on, sorted.
    pub parameters: Vec<String>,
    /// The short name of the connection.
    pub connection: String,
    /// A description of the connection, for the header.
    pub connection_words: String,
    /// The factor `lambda` of a connection `Lambda = lambda c`.
    pub lambda: Option<S>,
    /// The frame of the components: `left-invariant`, `right-invariant`, `coordinate`,
    /// `moving` or `reductive`.
    pub frame: &'static str,
    /// The chart, if the components are functions on a chart.
    pub chart: Option<OnChart>,
    /// The embedding of the isotropy algebra, on a homogeneous space.
    pub homogeneous: Option<OnHomogeneousSpace>,
    /// The tolerance below which a float counts as zero.
    pub tolerance: Tolerance,
    /// Whether the table lists only one of the components that are equal up to sign by symmetry.
    pub independent: bool,
    /// Whether JSON names common factors of denominators, like the formats text, Markdown, LaTeX
    /// and HTML. Otherwise each value in JSON is complete.
    pub common_factors: bool,
    /// The names that are written as indices of components; `None` for numbers from 1. CSV and JSON
    /// always use numbers.
    pub index_names: Option<Vec<String>>,
    /// The components of the metric, if there is one: the determinant of the metric may be a common
    /// factor.
    pub metric: Option<Tensor<S>>,
    /// The point at which the components are computed, as values of coordinates and parameters by
    /// name; empty if the components are functions.
    pub point: Vec<(String, f64)>,
    /// The tensors, in the order in which they are shown.
    pub tensors: Vec<TableEntry<S>>,
}

/// The embedding of the isotropy algebra of a homogeneous space, and the basis of the complement in
/// the algebra of the group, as text.
#[derive(Clone, Debug)]
pub struct OnHomogeneousSpace {
    /// A sentence about the embedding.
    pub embedding: String,
    /// The basis vectors, such as `e1 - e2`, in the order of the labels.
    pub complement: Vec<String>,
}

/// The coordinates of a chart, and the vector fields of its frame as text.
#[derive(Clone, Debug)]
pub struct OnChart {
    /// The names of the coordinates.
    pub coordinates: Vec<String>,
    /// The fields, such as `1/sin(theta)*d_phi`, in the order of the labels.
    pub fields: Vec<String>,
}

/// A tensor with its name.
#[derive(Clone, Debug)]
pub struct TableEntry<S> {
    /// The quantity that the tensor represents.
    pub quantity: Quantity,
    /// The nonzero components of the tensor.
    pub tensor: Tensor<S>,
}

impl<S: Coefficient> Table<S> {
    /// Computes the tensors of a geometry in its frame, for those quantities that apply to it.
    ///
    /// # Errors
    /// Those of [`Quantity::of`].
    pub fn new(geometry: &Geometry<S>, quantities: &[Quantity]) -> Result<Self, Error> {
        Self::in_stages(geometry, quantities, &|_| ())
    }

    /// Like [`new`](Self::new); `stage` is called with the name of each tensor before it is
    /// computed.
    ///
    /// # Errors
    /// Those of [`Quantity::of`].
    pub fn in_stages(
        geometry: &Geometry<S>,
        quantities: &[Quantity],
        stage: &dyn Fn(&str),
    ) -> Result<Self, Error> {
        let mut tensors = Vec::new();
        for &quantity in quantities {
            stage(quantity.key());
            if let Some(tensor) = quantity.of(geometry)? {
                tensors.push(TableEntry { quantity, tensor });
            }
        }
        let parameters =
            S::parameters_of(&mut tensors.iter().flat_map(|entry| entry.tensor.nonzero()));
        Ok(Table {
            name: geometry.name().into(),
            algebra: geometry.algebra_name().into(),
            labels: geometry.frame().labels().to_vec(),
            parameters: parameters.into_iter().collect(),
            connection: geometry.connection_name().into(),
            connection_words: geometry.describe_connection(),
            lambda: geometry.kind().lambda(),
            frame: geometry.frame_name(),
            chart: geometry.frame_origin().fields().map(|fields| OnChart {
                coordinates: fields.chart().coordinates().to_vec(),
                fields: fields.written(),
            }),
            homogeneous: geometry.frame_origin().homogeneous().map(|space| OnHomogeneousSpace {
                embedding: space.embedding().into(),
                complement: space.complement().to_vec(),
            }),
            tolerance: geometry.frame().structure_functions().tolerance(),
            independent: false,
            common_factors: false,
            index_names: None,
            metric: geometry.metric().map(|metric| metric.components().clone()),
            point: vec![],
            tensors,
        })
    }

    /// Checks that floats have stayed within their range.
    ///
    /// # Errors
    /// [`Error::Overflow`] with the first component that is infinite or not a number.
    pub fn finite(&self) -> Result<(), Error> {
        for TableEntry { quantity, tensor } in &self.tensors {
            let wild = |value: &S| value.to_f64().is_some_and(|x| !x.is_finite());
            // tests values first: computing indices takes long for millions of components, but few
            // tensors have such a component
            if S::KIND == Kind::Float
                && tensor.nonzero().any(wild)
                && let Some((at, value)) = tensor.components().find(|(_, value)| wild(value))
            {
                let component = text::component(*quantity, tensor, &at);
                return Err(Error::Overflow { component, value: value.to_string() });
            }
        }
        Ok(())
    }

    /// The names of the indices: the coordinates in a coordinate frame, otherwise the basis
    /// vectors.
    pub fn frame_names(&self) -> &[String] {
        match &self.chart {
            Some(OnChart { coordinates, .. }) if self.frame == "coordinate" => coordinates,
            _ => &self.labels,
        }
    }

    /// The title of a tensor. On a chart, structure constants are called structure functions.
    fn title(&self, quantity: Quantity) -> &'static str {
        match quantity {
            Quantity::Structure if self.chart.is_some() => "Structure functions",
            _ => quantity.title(),
        }
    }

    /// The components of an entry that are written: all components, or only the independent ones.
    fn shown<'a>(&self, entry: &'a TableEntry<S>) -> Cow<'a, Tensor<S>> {
        match self.independent {
            true => Cow::Owned(independent(&entry.tensor)),
            false => Cow::Borrowed(&entry.tensor),
        }
    }
}

/// A report that can be written in one of the formats.
pub trait Report {
    /// Writes the report.
    ///
    /// # Errors
    /// Errors of `out`; for JSON also [`io::ErrorKind::InvalidData`] if a float is infinite or NaN.
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()>;
}

impl<S: Coefficient> Report for Table<S> {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        let mut out = BufWriter::with_capacity(1 << 16, out);
        match format {
            Format::Text => text::write(self, &mut out),
            Format::Markdown => markdown::write(self, &mut out),
            Format::Latex => latex::write(self, &mut out),
            Format::Csv => csv::write(self, &mut out),
            Format::Json => json::write(self, &mut out),
            Format::Html => html::write(self, &mut out),
        }?;
        out.flush()
    }
}

/// The format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Plain text of at most 80 columns.
    Text,
    /// Markdown with headings and tables, as rendered by GitHub.
    Markdown,
    /// A LaTeX fragment that needs amsmath.
    Latex,
    /// One row for every component.
    Csv,
    /// One object with the schema `affinor.table/1` (`docs/schemas/table.schema.json`).
    Json,
    /// One page without scripts, with formulas in MathML.
    Html,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 6] =
        [Format::Text, Format::Markdown, Format::Latex, Format::Csv, Format::Json, Format::Html];

    /// The name by which options select the format.
    pub fn name(self) -> &'static str {
        match self {
            Format::Text => "text",
            Format::Markdown => "markdown",
            Format::Latex => "latex",
            Format::Csv => "csv",
            Format::Json => "json",
            Format::Html => "html",
        }
    }

    /// The format of files with this ending in lower case, such as `tex` or `md`.
    pub fn from_ending(ending: &str) -> Option<Self> {
        Some(match ending {
            "txt" => Format::Text,
            "md" => Format::Markdown,
            "tex" => Format::Latex,
            "htm" => Format::Html,
            ending => return Self::from_name(ending),
        })
    }

    /// The format with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}
