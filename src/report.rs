//! Tables of tensors, and their renderings: one file a format.

mod components;
pub mod csv;
pub mod json;
pub mod latex;
pub mod markdown;
pub mod text;

pub use components::{Group, groups, independent};

use crate::{Error, Geometry};
use affinor_tensors::{Down, Notation, Tensor, Tolerance, Up, Variance};

/// The tensors of one geometry, ready to be printed.
#[derive(Clone, Debug)]
pub struct Table<S> {
    /// What the space is called.
    pub name: String,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    /// The parameters that the components depend on, sorted.
    pub parameters: Vec<String>,
    /// The short name of the connection.
    pub connection: String,
    /// The connection in words, for a head line.
    pub connection_words: String,
    /// The factor of a connection `Lambda = lambda c`.
    pub lambda: Option<S>,
    /// The frame of the components: `left` or `right`.
    pub frame: &'static str,
    /// When a float counted as zero.
    pub tolerance: Tolerance,
    /// Whether one component stands for each set that is equal by symmetry.
    pub independent: bool,
    /// The tensors, in the order in which they are shown.
    pub tensors: Vec<Entry<S>>,
}

/// A tensor with its name.
#[derive(Clone, Debug)]
pub struct Entry<S> {
    /// Which tensor.
    pub quantity: Quantity,
    /// Its nonzero components.
    pub tensor: Tensor<S>,
}

/// What a tensor of a table is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Structure constants `c^i_jk`.
    Structure,
    /// Affinities `Lambda^i_jk`.
    Affinities,
    /// Torsion `tau^i_jk` (B10).
    Torsion,
    /// Curvature `R^i_jkl` (B14).
    Curvature,
    /// Ricci tensor `Ric_jl`.
    Ricci,
    /// Scalar curvature `S`.
    ScalarCurvature,
    /// Metric `g_ij`.
    Metric,
    /// Inverse metric `g^ij`.
    InverseMetric,
    /// Nonmetricity `Q_kij`.
    Nonmetricity,
    /// Killing form `K_ij`.
    Killing,
}

impl Quantity {
    /// All quantities, in the order of a table.
    pub const ALL: [Quantity; 10] = {
        use Quantity::*;
        [
            Structure,
            Affinities,
            Torsion,
            Curvature,
            Ricci,
            ScalarCurvature,
            Metric,
            InverseMetric,
            Nonmetricity,
            Killing,
        ]
    };

    /// The name in options, JSON and CSV.
    pub fn key(self) -> &'static str {
        match self {
            Quantity::Structure => "structure",
            Quantity::Affinities => "affinities",
            Quantity::Torsion => "torsion",
            Quantity::Curvature => "curvature",
            Quantity::Ricci => "ricci",
            Quantity::ScalarCurvature => "scalar_curvature",
            Quantity::Metric => "metric",
            Quantity::InverseMetric => "inverse_metric",
            Quantity::Nonmetricity => "nonmetricity",
            Quantity::Killing => "killing",
        }
    }

    /// The quantity of that name.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.key() == key)
    }

    /// The heading in text.
    pub fn title(self) -> &'static str {
        match self {
            Quantity::Structure => "Structure constants",
            Quantity::Affinities => "Affinities",
            Quantity::Torsion => "Torsion (B10)",
            Quantity::Curvature => "Curvature (B14)",
            Quantity::Ricci => "Ricci tensor",
            Quantity::ScalarCurvature => "Scalar curvature",
            Quantity::Metric => "Metric",
            Quantity::InverseMetric => "Inverse metric",
            Quantity::Nonmetricity => "Nonmetricity",
            Quantity::Killing => "Killing form",
        }
    }

    /// The symbol in text and JSON.
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::Structure => "c",
            Quantity::Affinities => "Lambda",
            Quantity::Torsion => "tau",
            Quantity::Curvature => "R",
            Quantity::Ricci => "Ric",
            Quantity::ScalarCurvature => "S",
            Quantity::Metric | Quantity::InverseMetric => "g",
            Quantity::Nonmetricity => "Q",
            Quantity::Killing => "K",
        }
    }

    /// The symbol in LaTeX.
    pub fn latex(self) -> &'static str {
        match self {
            Quantity::Affinities => "\\Lambda",
            Quantity::Torsion => "\\tau",
            Quantity::Ricci => "\\mathrm{Ric}",
            other => other.symbol(),
        }
    }

    /// The slots.
    pub fn slots(self) -> &'static [Variance] {
        match self {
            Quantity::Structure | Quantity::Affinities | Quantity::Torsion => &[Up, Down, Down],
            Quantity::Curvature => &[Up, Down, Down, Down],
            Quantity::Ricci | Quantity::Metric | Quantity::Killing => &[Down, Down],
            Quantity::InverseMetric => &[Up, Up],
            Quantity::Nonmetricity => &[Down, Down, Down],
            Quantity::ScalarCurvature => &[],
        }
    }

    /// The tensor of a geometry; `None` where it does not apply (no metric).
    ///
    /// # Errors
    /// [`Error::Shape`], which a valid geometry does not cause.
    pub fn of<S: Notation>(self, geometry: &Geometry<S>) -> Result<Option<Tensor<S>>, Error> {
        let connection = geometry.connection();
        let n = geometry.algebra().dimension();
        Ok(Some(match (self, geometry.metric()) {
            (Quantity::Structure, _) => geometry.algebra().structure().clone(),
            (Quantity::Affinities, _) => connection.gamma().clone(),
            (Quantity::Torsion, _) => connection.torsion(),
            (Quantity::Curvature, _) => connection.curvature(),
            (Quantity::Ricci, _) => connection.ricci(),
            (Quantity::Killing, _) => geometry.algebra().killing_form(),
            (_, None) => return Ok(None),
            (Quantity::ScalarCurvature, Some(metric)) => {
                let scalar = connection.scalar_curvature(metric)?;
                Tensor::from_components(n, &[], [([], scalar)])?
            }
            (Quantity::Metric, Some(metric)) => metric.components().clone(),
            (Quantity::InverseMetric, Some(metric)) => metric.inverse().clone(),
            (Quantity::Nonmetricity, Some(metric)) => connection.nonmetricity(metric)?,
        }))
    }
}

impl<S: Notation> Table<S> {
    /// The table of a geometry in its left-invariant frame, with the quantities that apply.
    ///
    /// # Errors
    /// As [`Quantity::of`].
    pub fn new(geometry: &Geometry<S>, quantities: &[Quantity]) -> Result<Self, Error> {
        let mut tensors = Vec::new();
        for &quantity in quantities {
            if let Some(tensor) = quantity.of(geometry)? {
                tensors.push(Entry { quantity, tensor });
            }
        }
        let shown = tensors.iter().flat_map(|entry| entry.tensor.components());
        let mut parameters: Vec<String> = shown.flat_map(|(_, value)| value.parameters()).collect();
        parameters.sort();
        parameters.dedup();
        Ok(Table {
            name: geometry.name().into(),
            labels: geometry.algebra().labels().to_vec(),
            parameters,
            connection: geometry.kind().name().into(),
            connection_words: geometry.kind().describe(),
            lambda: geometry.kind().lambda(),
            frame: "left",
            tolerance: geometry.algebra().structure().tolerance(),
            independent: false,
            tensors,
        })
    }
}
