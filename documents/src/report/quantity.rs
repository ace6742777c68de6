//! The tensors that a table can show: names, symbols, slots, and how each is computed.

use affinor::{Error, Geometry, conventions};
use affinor_tensors::{Down, Notation, Tensor, Up, Variance};

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

/// The names, slots and definition of a quantity.
struct Description {
    key: &'static str,
    title: &'static str,
    symbol: &'static str,
    latex: &'static str,
    /// The slots with the letters of the definition.
    slots: &'static str,
    definition: &'static str,
}

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
    /// The quantities that a table shows by default.
    pub const BASIC: &[Quantity] = Self::ALL.split_at(10).0;
    /// The quantities derived from these, which are shown on request.
    pub const DERIVED: &[Quantity] = Self::ALL.split_at(10).1;

    fn entry(self) -> Description {
        use conventions as is;
        let entry = |key, title, [symbol, latex]: [&'static str; 2], slots, definition| {
            Description { key, title, symbol, latex, slots, definition }
        };
        let ricci = "\\mathrm{Ric}";
        match self {
            Quantity::Structure => {
                entry("structure", "Structure constants", ["c"; 2], "^i_jk", is::BRACKET)
            }
            Quantity::Affinities => {
                let symbol = ["Lambda", "\\Lambda"];
                entry("affinities", "Affinities", symbol, "^i_jk", is::AFFINITIES)
            }
            Quantity::Torsion => {
                entry("torsion", "Torsion (B10)", ["tau", "\\tau"], "^i_jk", is::TORSION)
            }
            Quantity::Curvature => {
                entry("curvature", "Curvature (B14)", ["R"; 2], "^i_jkl", is::CURVATURE)
            }
            Quantity::Ricci => entry("ricci", "Ricci tensor", ["Ric", ricci], "_jl", is::RICCI),
            Quantity::ScalarCurvature => {
                entry("scalar_curvature", "Scalar curvature", ["S"; 2], "", is::SCALAR_CURVATURE)
            }
            Quantity::Metric => entry("metric", "Metric", ["g"; 2], "_ij", is::METRIC),
            Quantity::InverseMetric => {
                entry("inverse_metric", "Inverse metric", ["g"; 2], "^ij", is::INVERSE_METRIC)
            }
            Quantity::Nonmetricity => {
                entry("nonmetricity", "Nonmetricity", ["Q"; 2], "_kij", is::NONMETRICITY)
            }
            Quantity::Killing => entry("killing", "Killing form", ["K"; 2], "_ij", is::KILLING),
            Quantity::NablaTorsion => {
                let symbol = ["(nabla tau)", "(\\nabla\\tau)"];
                let title = "Derivative of the torsion";
                entry("nabla_torsion", title, symbol, "^i_mjk", is::NABLA_TORSION)
            }
            Quantity::NablaCurvature => {
                let symbol = ["(nabla R)", "(\\nabla R)"];
                let title = "Derivative of the curvature";
                entry("nabla_curvature", title, symbol, "^i_mjkl", is::NABLA_CURVATURE)
            }
            Quantity::RicciSymmetric => {
                let symbol = ["symRic", "\\mathrm{symRic}"];
                let title = "Ricci tensor, symmetric part";
                entry("ricci_symmetric", title, symbol, "_jl", is::RICCI_SYMMETRIC)
            }
            Quantity::RicciAntisymmetric => {
                let symbol = ["altRic", "\\mathrm{altRic}"];
                let title = "Ricci tensor, antisymmetric part";
                entry("ricci_antisymmetric", title, symbol, "_jl", is::RICCI_ANTISYMMETRIC)
            }
            Quantity::Einstein => {
                entry("einstein", "Einstein tensor", ["G"; 2], "_jl", is::EINSTEIN)
            }
            Quantity::Schouten => {
                entry("schouten", "Schouten tensor", ["P"; 2], "_jl", is::SCHOUTEN)
            }
            Quantity::Weyl => entry("weyl", "Weyl tensor", ["W"; 2], "^i_jkl", is::WEYL),
            Quantity::Cotton => entry("cotton", "Cotton tensor", ["C"; 2], "_jkl", is::COTTON),
            Quantity::Kretschmann => {
                let symbol = ["Kr", "\\mathrm{Kr}"];
                entry("kretschmann", "Kretschmann scalar", symbol, "", is::KRETSCHMANN)
            }
        }
    }

    /// The name in options, JSON and CSV.
    pub fn key(self) -> &'static str {
        self.entry().key
    }

    /// The quantity of that name.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.key() == key)
    }

    /// The heading in text.
    pub fn title(self) -> &'static str {
        self.entry().title
    }

    /// The symbol in text and JSON.
    pub fn symbol(self) -> &'static str {
        self.entry().symbol
    }

    /// The symbol in LaTeX.
    pub fn latex(self) -> &'static str {
        self.entry().latex
    }

    /// The defining formula, in the conventions of the paper.
    pub fn definition(self) -> String {
        let definition = self.entry().definition;
        match self {
            Quantity::Curvature => {
                format!("{definition}, {}", conventions::CURVATURE_COMPONENTS)
            }
            _ => definition.into(),
        }
    }

    /// The letters of the indices in the definition, slot by slot.
    pub fn letters(self) -> String {
        self.entry().slots.replace(['^', '_'], "")
    }

    /// The slots.
    pub fn slots(self) -> Vec<Variance> {
        let mut slots = Vec::new();
        let mut level = Down;
        for mark in self.entry().slots.chars() {
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
    pub fn of<S: Notation>(self, geometry: &Geometry<S>) -> Result<Option<Tensor<S>>, Error> {
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
