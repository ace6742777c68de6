//! The tensors that a table can show: names, symbols, slots, and how each is computed.

use crate::Coefficient;
use affinor::conventions as is;
use affinor::{Error, Geometry};
use affinor_tensors::{Down, Tensor, Up, Variance};

/// A tensor that a table can show.
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
    /// Derivative of the torsion `(nabla_m tau)^i_jk`, slots `^i_mjk`.
    NablaTorsion,
    /// Derivative of the curvature `(nabla_m R)^i_jkl`, slots `^i_mjkl`.
    NablaCurvature,
    /// Symmetric part of the Ricci tensor.
    RicciSymmetric,
    /// Antisymmetric part of the Ricci tensor.
    RicciAntisymmetric,
    /// Einstein tensor `G_jl`.
    Einstein,
    /// Schouten tensor `P_jl` of a Levi-Civita connection.
    Schouten,
    /// Weyl tensor `W^i_jkl` of a Levi-Civita connection.
    Weyl,
    /// Cotton tensor `C_jkl` of a Levi-Civita connection.
    Cotton,
    /// Kretschmann scalar `R_ijkl R^ijkl`.
    Kretschmann,
}

/// Name, heading, symbol, slots with the letters of the definition, and definition.
type Description = (&'static str, &'static str, &'static str, &'static str, &'static str);

/// The quantities, in the order of a table.
const DESCRIPTIONS: [Description; 19] = [
    ("structure", "Structure constants", "c", "^i_jk", is::BRACKET),
    ("affinities", "Affinities", "Lambda", "^i_jk", is::AFFINITIES),
    ("torsion", "Torsion (B10)", "tau", "^i_jk", is::TORSION),
    ("curvature", "Curvature (B14)", "R", "^i_jkl", is::CURVATURE),
    ("ricci", "Ricci tensor", "Ric", "_jl", is::RICCI),
    ("scalar_curvature", "Scalar curvature", "S", "", is::SCALAR_CURVATURE),
    ("metric", "Metric", "g", "_ij", is::METRIC),
    ("inverse_metric", "Inverse metric", "g", "^ij", is::INVERSE_METRIC),
    ("nonmetricity", "Nonmetricity", "Q", "_kij", is::NONMETRICITY),
    ("killing", "Killing form", "K", "_ij", is::KILLING),
    ("nabla_torsion", "Derivative of the torsion", "(nabla tau)", "^i_mjk", is::NABLA_TORSION),
    ("nabla_curvature", "Derivative of the curvature", "(nabla R)", "^i_mjkl", is::NABLA_CURVATURE),
    ("ricci_symmetric", "Ricci tensor, symmetric part", "symRic", "_jl", is::RICCI_SYMMETRIC),
    (
        "ricci_antisymmetric",
        "Ricci tensor, antisymmetric part",
        "altRic",
        "_jl",
        is::RICCI_ANTISYMMETRIC,
    ),
    ("einstein", "Einstein tensor", "G", "_jl", is::EINSTEIN),
    ("schouten", "Schouten tensor", "P", "_jl", is::SCHOUTEN),
    ("weyl", "Weyl tensor", "W", "^i_jkl", is::WEYL),
    ("cotton", "Cotton tensor", "C", "_jkl", is::COTTON),
    ("kretschmann", "Kretschmann scalar", "Kr", "", is::KRETSCHMANN),
];

impl Quantity {
    /// All quantities, in the order of a table.
    pub const ALL: [Quantity; 19] = {
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
            NablaTorsion,
            NablaCurvature,
            RicciSymmetric,
            RicciAntisymmetric,
            Einstein,
            Schouten,
            Weyl,
            Cotton,
            Kretschmann,
        ]
    };
    /// The basic quantities.
    pub const BASIC: &[Quantity] = Self::ALL.split_at(10).0;
    /// The quantities derived from these, which are shown on request.
    pub const DERIVED: &[Quantity] = Self::ALL.split_at(10).1;

    /// The quantities that a table shows unless others are chosen: the basic ones but the inverse metric and the Killing form.
    pub fn shown() -> Vec<Self> {
        let kept = |quantity: &Self| !matches!(quantity, Self::InverseMetric | Self::Killing);
        Self::BASIC.iter().copied().filter(kept).collect()
    }

    /// The different quantities of a list: names separated by commas, `all` for the basic and `derived` for the derived ones.
    ///
    /// ```
    /// use affinor_documents::report::Quantity;
    /// assert_eq!(Quantity::list("ricci, ricci").unwrap(), [Quantity::Ricci]);
    /// assert!(Quantity::list("derived").unwrap().contains(&Quantity::Weyl));
    /// ```
    ///
    /// # Errors
    /// The first name that is unknown, with the known ones.
    pub fn list(text: &str) -> Result<Vec<Self>, String> {
        let mut chosen = Vec::new();
        for key in text.split(',').map(str::trim) {
            match (key, Self::from_key(key)) {
                ("all", _) => chosen.extend(Self::BASIC),
                ("derived", _) => chosen.extend(Self::DERIVED),
                (_, Some(quantity)) => chosen.push(quantity),
                (_, None) => {
                    let keys: Vec<&str> = Self::ALL.into_iter().map(Self::key).collect();
                    let known = format!("{}, all, derived", keys.join(", "));
                    return Err(format!("`{}` is not one of {known}", key.escape_debug()));
                }
            }
        }
        let mut distinct = Vec::new();
        for quantity in chosen {
            if !distinct.contains(&quantity) {
                distinct.push(quantity);
            }
        }
        Ok(distinct)
    }

    fn description(self) -> Description {
        DESCRIPTIONS[self as usize]
    }

    /// The name in options, JSON and CSV.
    pub fn key(self) -> &'static str {
        self.description().0
    }

    /// The quantity of that name.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.key() == key)
    }

    /// The heading in text.
    pub fn title(self) -> &'static str {
        self.description().1
    }

    /// The symbol in text and JSON.
    pub fn symbol(self) -> &'static str {
        self.description().2
    }

    /// The symbol in LaTeX.
    pub fn latex(self) -> String {
        match self.symbol() {
            "(nabla tau)" => "(\\nabla\\tau)".into(),
            "(nabla R)" => "(\\nabla R)".into(),
            greek @ ("Lambda" | "tau") => format!("\\{greek}"),
            word if word.len() > 1 => format!("\\mathrm{{{word}}}"),
            letter => letter.into(),
        }
    }

    /// The defining formula, in the conventions of the paper.
    pub fn definition(self) -> String {
        let definition = self.description().4;
        match self {
            Quantity::Curvature => format!("{definition}, {}", is::CURVATURE_COMPONENTS),
            _ => definition.into(),
        }
    }

    /// The letters of the indices in the definition, slot by slot.
    pub fn letters(self) -> String {
        self.description().3.replace(['^', '_'], "")
    }

    /// The slots.
    pub fn slots(self) -> Vec<Variance> {
        let mut slots = Vec::new();
        let mut level = Down;
        for mark in self.description().3.chars() {
            match mark {
                '^' => level = Up,
                '_' => level = Down,
                _ => slots.push(level),
            }
        }
        slots
    }

    /// The tensor of a geometry; `None` where it does not apply. Some quantities need a metric, the Killing form needs an
    /// algebra, and Schouten, Weyl and Cotton need a Levi-Civita connection in dimension 3 or more.
    ///
    /// # Errors
    /// [`Error::Shape`], which a valid geometry does not cause.
    pub fn of<S: Coefficient>(self, geometry: &Geometry<S>) -> Result<Option<Tensor<S>>, Error> {
        let connection = geometry.connection();
        let n = geometry.frame().dimension();
        let scalar = |value: S| Tensor::from_components(n, &[], [([], value)]);
        Ok(Some(match (self, geometry.metric()) {
            (Quantity::Structure, _) => geometry.frame().structure().clone(),
            (Quantity::Affinities, _) => connection.gamma().clone(),
            (Quantity::Torsion, _) => connection.torsion(),
            (Quantity::Curvature, _) => connection.curvature().clone(),
            (Quantity::Ricci, _) => connection.ricci(),
            (Quantity::Killing, _) => match geometry.algebra() {
                Some(algebra) => algebra.killing_form(),
                None => return Ok(None),
            },
            (Quantity::NablaTorsion, _) => connection.nabla_torsion(),
            (Quantity::NablaCurvature, _) => connection.nabla_curvature(),
            (Quantity::RicciSymmetric, _) => connection.ricci_symmetric()?,
            (Quantity::RicciAntisymmetric, _) => connection.ricci_antisymmetric()?,
            (_, None) => return Ok(None),
            (Quantity::ScalarCurvature, Some(metric)) => {
                scalar(connection.scalar_curvature(metric)?)?
            }
            (Quantity::Metric, Some(metric)) => metric.components().clone(),
            (Quantity::InverseMetric, Some(metric)) => metric.inverse().clone(),
            (Quantity::Nonmetricity, Some(metric)) => connection.nonmetricity(metric)?,
            (Quantity::Einstein, Some(metric)) => connection.einstein(metric)?,
            (Quantity::Kretschmann, Some(metric)) => scalar(connection.kretschmann(metric)?)?,
            (Quantity::Schouten | Quantity::Weyl | Quantity::Cotton, _)
                if n < 3 || !geometry.is_levi_civita()? =>
            {
                return Ok(None);
            }
            (Quantity::Schouten, Some(metric)) => connection.schouten(metric)?,
            (Quantity::Weyl, Some(metric)) => connection.weyl(metric)?,
            (Quantity::Cotton, Some(metric)) => connection.cotton(metric)?,
        }))
    }
}
