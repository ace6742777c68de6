//! Cohomology with coefficients in a module.

use super::{Coefficients, Notes, certainty};
use crate::input::InputError;
use affinor::algebra::structure::{GroundField, MAX_BETTI, StructureTheory};
use affinor::algebra::{LieAlgebra, Module};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use serde_json::json;

impl Coefficients {
    /// The name in reports.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Coefficients::Trivial => "trivial",
            Coefficients::Adjoint => "adjoint",
            Coefficients::Coadjoint => "coadjoint",
            Coefficients::Matrices(_) => "matrices",
        }
    }

    /// The module.
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
