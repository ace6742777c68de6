//! The tensors that a table can show: names, symbols, slots, and how each is computed.

use crate::{Error, Geometry, conventions};
use affinor_tensors::{Down, Notation, Tensor, Up, Variance};

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

    /// The defining formula, in the conventions of the paper.
    pub fn definition(self) -> String {
        match self {
            Quantity::Structure => conventions::BRACKET.into(),
            Quantity::Affinities => conventions::AFFINITIES.into(),
            Quantity::Torsion => conventions::TORSION.into(),
            Quantity::Curvature => {
                format!("{}, {}", conventions::CURVATURE, conventions::CURVATURE_COMPONENTS)
            }
            Quantity::Ricci => conventions::RICCI.into(),
            Quantity::ScalarCurvature => conventions::SCALAR_CURVATURE.into(),
            Quantity::Metric => "g_ij = g(e_i, e_j)".into(),
            Quantity::InverseMetric => "g^ij g_jk = delta^i_k".into(),
            Quantity::Nonmetricity => conventions::NONMETRICITY.into(),
            Quantity::Killing => conventions::KILLING.into(),
        }
    }

    /// The letters of the indices in the definition, slot by slot.
    pub fn letters(self) -> &'static str {
        match self {
            Quantity::Structure | Quantity::Affinities | Quantity::Torsion => "ijk",
            Quantity::Curvature => "ijkl",
            Quantity::Ricci => "jl",
            Quantity::Metric | Quantity::InverseMetric | Quantity::Killing => "ij",
            Quantity::Nonmetricity => "kij",
            Quantity::ScalarCurvature => "",
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

    /// The tensor of a geometry; `None` where it does not apply: no metric, or no algebra for a
    /// Killing form.
    ///
    /// # Errors
    /// [`Error::Shape`], which a valid geometry does not cause.
    pub fn of<S: Notation>(self, geometry: &Geometry<S>) -> Result<Option<Tensor<S>>, Error> {
        let connection = geometry.connection();
        let n = geometry.frame().dimension();
        Ok(Some(match (self, geometry.metric()) {
            (Quantity::Structure, _) => geometry.frame().structure().clone(),
            (Quantity::Affinities, _) => connection.gamma().clone(),
            (Quantity::Torsion, _) => connection.torsion(),
            (Quantity::Curvature, _) => connection.curvature(),
            (Quantity::Ricci, _) => connection.ricci(),
            (Quantity::Killing, _) => match geometry.algebra() {
                Some(algebra) => algebra.killing_form(),
                None => return Ok(None),
            },
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
