//! Cohomology with coefficients in a module.

use super::{Notes, certainty};
use crate::input::{InputError, Source};
use crate::space::tables::matrices::square_matrices;
use affinor::algebra::structure::{GroundField, MAX_BETTI, StructureTheory};
use affinor::algebra::{LieAlgebra, Module};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Rational, Ring};
use serde_json::json;
use std::str::FromStr;

/// The coefficients of cohomology: a module of the algebra.
///
/// ```
/// use affinor_documents::report::Coefficients;
/// assert_eq!("adjoint".parse::<Coefficients>()?, Coefficients::Adjoint);
/// assert!("[[0,1],[0,0]]".parse::<Coefficients>().is_ok());
/// assert!("[[0,1]]".parse::<Coefficients>().is_err());
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Coefficients {
    /// The numbers, on which the algebra acts by zero.
    #[default]
    Trivial,
    /// The algebra, on which it acts by `ad`.
    Adjoint,
    /// The dual of the algebra.
    Coadjoint,
    /// A module by the matrices of the basis vectors, with rational entries.
    Matrices(Vec<Matrix<Rational>>),
}

impl FromStr for Coefficients {
    type Err = InputError;

    /// Reads `trivial`, `adjoint`, `coadjoint`, or matrices in one of the forms of an algebra by
    /// matrices, such as `[[0,1],[0,0]], [[1,0],[0,-1]]`.
    fn from_str(text: &str) -> Result<Self, InputError> {
        match text.trim() {
            "trivial" => Ok(Coefficients::Trivial),
            "adjoint" => Ok(Coefficients::Adjoint),
            "coadjoint" => Ok(Coefficients::Coadjoint),
            matrices if matrices.starts_with(['[', '(', '{']) => {
                let (size, all) = square_matrices(&Source::new("the coefficients", matrices))?;
                let matrices = all.into_iter().map(|entries| {
                    let mut rows = vec![vec![]; size];
                    for (i, j, value) in entries {
                        let number = value.re.as_constant().filter(|_| value.im.vanishes())?;
                        rows[i].push((j, number.clone()));
                    }
                    Matrix::from_rows(size, rows).ok()
                });
                let matrices = matrices.collect::<Option<Vec<_>>>().ok_or_else(|| {
                    InputError::usage(
                        "a matrix of the coefficients has an entry that is not rational",
                    )
                })?;
                Ok(Coefficients::Matrices(matrices))
            }
            other => {
                let message = format!("unknown coefficients `{}`", other.escape_debug());
                let help = "write trivial, adjoint, coadjoint, or a matrix for each basis vector";
                Err(InputError::usage(message).help(help))
            }
        }
    }
}

impl Coefficients {
    /// The name in reports.
    #[cfg(any(feature = "modules", feature = "homogeneous"))]
    pub(super) fn name(&self) -> &'static str {
        match self {
            Coefficients::Trivial => "trivial",
            Coefficients::Adjoint => "adjoint",
            Coefficients::Coadjoint => "coadjoint",
            Coefficients::Matrices(_) => "matrices",
        }
    }

    /// The module.
    #[cfg(any(feature = "modules", feature = "homogeneous"))]
    pub(super) fn module<S: GroundField>(
        &self,
        algebra: &LieAlgebra<S>,
    ) -> Result<Module<S>, InputError> {
        match self {
            Coefficients::Trivial => Ok(Module::trivial(algebra, 1)),
            Coefficients::Adjoint => Ok(Module::adjoint(algebra)),
            Coefficients::Coadjoint => Ok(Module::coadjoint(algebra)),
            Coefficients::Matrices(matrices) => {
                let size = matrices.first().map_or(0, Matrix::rows);
                let labels: Vec<String> = (1..=size).map(|a| format!("v{a}")).collect();
                let convert =
                    |matrix: &Matrix<Rational>| matrix.map(|value| S::from_rational(value.clone()));
                Ok(Module::new(algebra, labels, matrices.iter().map(convert).collect())?)
            }
        }
    }
}

#[cfg(feature = "modules")]
impl Notes {
    /// Adds the dimensions of the cohomology, unless the coefficients are trivial.
    pub(super) fn cohomology<S: GroundField>(
        &mut self,
        structure: &StructureTheory<S>,
        coefficients: &Coefficients,
    ) -> Result<(), InputError> {
        if *coefficients == Coefficients::Trivial {
            return Ok(());
        }
        let module = coefficients.module(structure.algebra())?;
        let title = format!("cohomology, {} coefficients", coefficients.name());
        let Some((numbers, proved)) = structure.cohomology(&module)? else {
            let why = format!(
                "not computed beyond dimension {MAX_BETTI}, nor for too many cochains, unless semisimple"
            );
            self.absent(&title, "cohomology", "-", &why);
            return Ok(());
        };
        let text: Vec<String> = numbers.iter().map(u64::to_string).collect();
        let why = format!(
            "dimensions of H^0, H^1, ... with a module of dimension {}; {}",
            module.dimension(),
            certainty(proved)
        );
        self.row(&title, text.join(", "), &why);
        let value = json!({
            "coefficients": coefficients.name(),
            "dimension": module.dimension(),
            "numbers": numbers,
            "proved": proved,
        });
        self.json.insert("cohomology".into(), value);
        Ok(())
    }
}
