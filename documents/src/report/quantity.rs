//! The tensors that a table can show: names, symbols, slots, and computation.

use crate::Coefficient;
use affinor::conventions as is;
use affinor::{Error, Geometry};
use affinor_tensors::{Down, Tensor, Up, Variance};

/// The description of a quantity in tables.
struct Description {
    /// The name in options, JSON and CSV.
    key: &'static str,
    title: &'static str,
    /// The symbol in text and JSON.
    symbol: &'static str,
    latex: &'static str,
    /// The slots, with the index letters of the defining formula.
    slots: &'static str,
    /// The defining formula, in the conventions of `affinor conventions`.
    definition: &'static str,
}

/// Defines the quantities as an enum with their descriptions, in the order of a table.
macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident, $key:literal, $title:literal, $symbol:literal, $latex:literal, $slots:literal,
        $definition:expr;)*) => {
        /// A tensor that a table can show.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Quantity {
            $($(#[$doc])* $name,)*
        }

        impl Quantity {
            /// All quantities, in the order of a table: ten basic quantities, then the derived
            /// quantities.
            pub const ALL: [Quantity; [$($key),*].len()] = [$(Quantity::$name),*];

            fn description(self) -> Description {
                match self {
                    $(Quantity::$name => Description {
                        key: $key,
                        title: $title,
                        symbol: $symbol,
                        latex: $latex,
                        slots: $slots,
                        definition: $definition,
                    },)*
                }
            }
        }
    };
}

quantities! {
    /// Structure constants `c^i_jk`.
    Structure, "structure", "Structure constants", "c", "c", "^i_jk", is::BRACKET;
    /// Affinities `Lambda^i_jk`.
    Affinities, "affinities", "Affinities", "Lambda", "\\Lambda", "^i_jk", is::AFFINITIES;
    /// Torsion `tau^i_jk` (B10).
    Torsion, "torsion", "Torsion", "tau", "\\tau", "^i_jk", is::TORSION;
    /// Curvature `R^i_jkl` (B14).
    Curvature, "curvature", "Curvature", "R", "R", "^i_jkl", is::CURVATURE;
    /// Ricci tensor `Ric_jl`.
    Ricci, "ricci", "Ricci tensor", "Ric", "\\mathrm{Ric}", "_jl", is::RICCI;
    /// Scalar curvature `S`.
    ScalarCurvature, "scalar_curvature", "Scalar curvature", "S", "S", "", is::SCALAR_CURVATURE;
    /// Metric `g_ij`.
    Metric, "metric", "Metric", "g", "g", "_ij", is::METRIC;
    /// Inverse metric `g^ij`.
    InverseMetric, "inverse_metric", "Inverse metric", "g", "g", "^ij", is::INVERSE_METRIC;
    /// Nonmetricity `Q_kij`.
    Nonmetricity, "nonmetricity", "Nonmetricity", "Q", "Q", "_kij", is::NONMETRICITY;
    /// Killing form `K_ij`.
    Killing, "killing", "Killing form", "K", "K", "_ij", is::KILLING;
    /// Derivative of the torsion `(nabla_m tau)^i_jk`, slots `^i_mjk`.
    NablaTorsion, "nabla_torsion", "Derivative of the torsion", "(nabla tau)", "(\\nabla\\tau)", "^i_mjk", is::NABLA_TORSION;
    /// Derivative of the curvature `(nabla_m R)^i_jkl`, slots `^i_mjkl`.
    NablaCurvature, "nabla_curvature", "Derivative of the curvature", "(nabla R)", "(\\nabla R)", "^i_mjkl", is::NABLA_CURVATURE;
    /// Symmetric part of the Ricci tensor.
    RicciSymmetric, "ricci_symmetric", "Ricci tensor, symmetric part", "symRic", "\\mathrm{symRic}", "_jl", is::RICCI_SYMMETRIC;
    /// Antisymmetric part of the Ricci tensor.
    RicciAntisymmetric, "ricci_antisymmetric", "Ricci tensor, antisymmetric part", "altRic", "\\mathrm{altRic}", "_jl", is::RICCI_ANTISYMMETRIC;
    /// Trace-free part of the Ricci tensor.
    RicciTraceFree, "ricci_trace_free", "Ricci tensor, trace-free part", "tfRic", "\\mathrm{tfRic}", "_jl", is::RICCI_TRACE_FREE;
    /// Einstein tensor `G_jl`.
    Einstein, "einstein", "Einstein tensor", "G", "G", "_jl", is::EINSTEIN;
    /// Schouten tensor `P_jl` of a Levi-Civita connection.
    Schouten, "schouten", "Schouten tensor", "P", "P", "_jl", is::SCHOUTEN;
    /// Weyl tensor `W^i_jkl` of a Levi-Civita connection.
    Weyl, "weyl", "Weyl tensor", "W", "W", "^i_jkl", is::WEYL;
    /// Cotton tensor `C_jkl` of a Levi-Civita connection.
    Cotton, "cotton", "Cotton tensor", "C", "C", "_jkl", is::COTTON;
    /// Kretschmann scalar `R_ijkl R^ijkl`.
    Kretschmann, "kretschmann", "Kretschmann scalar", "Kr", "\\mathrm{Kr}", "", is::KRETSCHMANN;
}

impl Quantity {
    /// The basic quantities.
    pub const BASIC: &[Quantity] = Self::ALL.split_at(10).0;
    /// The derived quantities, which a table shows only on request.
    pub const DERIVED: &[Quantity] = Self::ALL.split_at(10).1;

    /// The names of the basic and of the derived quantities, separated by commas.
    pub fn names() -> [String; 2] {
        [Self::BASIC, Self::DERIVED].map(|list| {
            let keys: Vec<&str> = list.iter().map(|quantity| quantity.key()).collect();
            keys.join(", ")
        })
    }

    /// The quantities that a table shows by default: all basic quantities except the inverse metric
    /// and the Killing form.
    pub fn shown() -> Vec<Self> {
        let kept = |quantity: &Self| !matches!(quantity, Self::InverseMetric | Self::Killing);
        Self::BASIC.iter().copied().filter(kept).collect()
    }

    /// Parses a list of quantities: names separated by commas, `all` for the basic quantities, and
    /// `derived` for the derived quantities. Duplicates are removed.
    ///
    /// ```
    /// use affinor_documents::report::Quantity;
    /// assert_eq!(Quantity::list("ricci, ricci").unwrap(), [Quantity::Ricci]);
    /// assert!(Quantity::list("derived").unwrap().contains(&Quantity::Weyl));
    /// ```
    ///
    /// # Errors
    /// A message with the first unknown name, and the list of known names.
    pub fn list(text: &str) -> Result<Vec<Self>, String> {
        let mut chosen = Vec::new();
        for key in text.split(',').map(str::trim) {
            match (key, Self::from_key(key)) {
                ("all", _) => chosen.extend(Self::BASIC),
                ("derived", _) => chosen.extend(Self::DERIVED),
                (_, Some(quantity)) => chosen.push(quantity),
                (_, None) => {
                    let [basic, derived] = Self::names();
                    let lower = key.to_lowercase();
                    let distance = |known: &&str| strsim::damerau_levenshtein(known, &lower);
                    let nearest = Self::ALL.iter().map(|quantity| quantity.key());
                    let nearest = nearest.filter(|known| lower.len() < 32 && distance(known) < 3);
                    let shown = key.escape_debug();
                    return Err(match nearest.min_by_key(distance) {
                        Some(known) => format!("`{shown}` is not a tensor; did you mean {known}?"),
                        None => format!("`{shown}` is not one of {basic}, {derived}, all, derived"),
                    });
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

    /// The name in options, JSON and CSV.
    pub fn key(self) -> &'static str {
        self.description().key
    }

    /// The quantity with this name.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.key() == key)
    }

    /// The heading in text.
    pub fn title(self) -> &'static str {
        self.description().title
    }

    /// The symbol in text and JSON.
    pub fn symbol(self) -> &'static str {
        self.description().symbol
    }

    /// The symbol in LaTeX.
    pub fn latex(self) -> &'static str {
        self.description().latex
    }

    /// The defining formula, in the conventions of `affinor conventions`.
    pub fn definition(self) -> String {
        let definition = self.description().definition;
        match self {
            Quantity::Curvature => format!("{definition}, {}", is::CURVATURE_COMPONENTS),
            _ => definition.into(),
        }
    }

    /// The index letters of the defining formula, slot by slot.
    pub fn letters(self) -> String {
        self.description().slots.replace(['^', '_'], "")
    }

    /// The slots.
    pub fn slots(self) -> Vec<Variance> {
        let mut slots = Vec::new();
        let mut level = Down;
        for mark in self.description().slots.chars() {
            match mark {
                '^' => level = Up,
                '_' => level = Down,
                _ => slots.push(level),
            }
        }
        slots
    }

    /// The tensor of a geometry; `None` if the tensor does not apply to the geometry. Some
    /// quantities need a metric. The Killing form needs an algebra. Schouten, Weyl and Cotton
    /// tensors need a Levi-Civita connection in dimension 3 or more.
    ///
    /// # Errors
    /// [`Error::Shape`], which cannot occur for a valid geometry.
    pub fn of<S: Coefficient>(self, geometry: &Geometry<S>) -> Result<Option<Tensor<S>>, Error> {
        let connection = geometry.connection();
        let n = geometry.frame().dimension();
        let scalar = |value: S| Tensor::from_components(n, &[], [([], value)]);
        Ok(Some(match (self, geometry.metric()) {
            (Quantity::Structure, _) => geometry.frame().structure_functions().clone(),
            (Quantity::Affinities, _) => connection.affinities().clone(),
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
            (Quantity::RicciTraceFree, Some(metric)) => connection.ricci_trace_free(metric)?,
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
