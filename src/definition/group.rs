//! The group of a definition.

use super::{Definition, InputError, Origin, Reading};
use crate::any_group::AnyGroup;
use crate::catalogue;
use crate::group::{MatrixGroup, Nilpotent, Se2, Se3, Sl2, So2, So3};
use crate::{Error, LieAlgebra, MatrixBasis};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use nalgebra::DMatrix;

impl Definition {
    /// A group with this algebra, in its basis: in closed form where there is one, of matrices where they are
    /// given, simply connected where it is nilpotent, else by the adjoint representation.
    ///
    /// # Errors
    /// What the algebra refuses; an algebra with a centre of which only brackets are known.
    pub fn group(&self, reading: &Reading<f64>) -> Result<Box<dyn AnyGroup>, InputError> {
        let name = self.algebra_name.as_deref().unwrap_or(&self.name);
        let entry = if self.source.is_none() { catalogue::find(name).ok() } else { None };
        if let Some(entry) = entry {
            match entry.name.as_str() {
                "so(2)" => return Ok(Box::new(So2)),
                "so(3)" => return Ok(Box::new(So3)),
                "se(2)" => return Ok(Box::new(Se2)),
                "se(3)" => return Ok(Box::new(Se3)),
                "sl(2)" => return Ok(Box::new(Sl2)),
                _ => {}
            }
            if let Some(matrices) = &entry.matrices {
                return Ok(Box::new(MatrixGroup::new(&floats(matrices))?));
            }
        }
        if matches!(self.origin, Origin::Matrices(..)) {
            return Ok(Box::new(MatrixGroup::from_basis(&self.matrix_basis(reading)?)?));
        }
        let algebra: LieAlgebra<f64> = self.algebra(reading)?;
        match Nilpotent::new(algebra.clone()) {
            Ok(nilpotent) => return Ok(Box::new(nilpotent)),
            Err(Error::NotNilpotent { .. }) => {}
            Err(error) => return Err(error.into()),
        }
        let group = MatrixGroup::of_algebra(&algebra).map_err(|error| {
            InputError::from(error).help("give the algebra by matrices: they name its group")
        })?;
        Ok(Box::new(group))
    }
}

/// The same matrices in floats.
fn floats(basis: &MatrixBasis<Rational>) -> Vec<DMatrix<f64>> {
    let entry = |value: Rational| value.to_f64();
    let dense =
        |m: &Matrix<Rational>| DMatrix::from_fn(m.rows(), m.columns(), |i, j| entry(m.get(i, j)));
    basis.matrices().iter().map(dense).collect()
}
