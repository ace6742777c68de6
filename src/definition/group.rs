//! The group of a definition.

use super::{Definition, InputError, Origin, Reading};
use crate::any_group::AnyGroup;
use crate::catalogue;
use crate::group::{MatrixGroup, Nilpotent, Se2, Se3, Sl2, So2, So3};
use crate::simulation::Simulated;
use crate::{Error, LieAlgebra, MatrixBasis};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use nalgebra::DMatrix;

/// Work on a group that is known when the program runs.
pub trait GroupWork {
    /// What it yields.
    type Output;
    /// Does it.
    ///
    /// # Errors
    /// Whatever the work refuses.
    fn run<G: Simulated>(self, group: G) -> Result<Self::Output, InputError>;
}

struct Boxed;

impl GroupWork for Boxed {
    type Output = Box<dyn AnyGroup>;

    fn run<G: Simulated>(self, group: G) -> Result<Self::Output, InputError> {
        Ok(Box::new(group))
    }
}

impl Definition {
    /// A group with this algebra, in its basis: in closed form where there is one, of matrices where they are
    /// given, simply connected where it is nilpotent, else by the adjoint representation.
    ///
    /// # Errors
    /// What the algebra refuses; an algebra with a centre of which only brackets are known.
    pub fn group(&self, reading: &Reading<f64>) -> Result<Box<dyn AnyGroup>, InputError> {
        self.on_group(reading, Boxed)
    }

    /// Does work on the [`group`](Self::group), which then has its type.
    ///
    /// # Errors
    /// As [`group`](Self::group); whatever the work refuses.
    pub fn on_group<W: GroupWork>(
        &self,
        reading: &Reading<f64>,
        work: W,
    ) -> Result<W::Output, InputError> {
        let name = self.algebra_name.as_deref().unwrap_or(&self.name);
        let entry = if self.source.is_none() { catalogue::find(name).ok() } else { None };
        if let Some(entry) = entry {
            match entry.name.as_str() {
                "so(2)" => return work.run(So2),
                "so(3)" => return work.run(So3),
                "se(2)" => return work.run(Se2),
                "se(3)" => return work.run(Se3),
                "sl(2)" => return work.run(Sl2),
                _ => {}
            }
            if let Some(matrices) = &entry.matrices {
                return work.run(MatrixGroup::new(&floats(matrices))?);
            }
        }
        if matches!(self.origin, Origin::Matrices(..)) {
            return work.run(MatrixGroup::from_basis(&self.matrix_basis(reading)?)?);
        }
        let algebra: LieAlgebra<f64> = self.algebra(reading)?;
        match Nilpotent::new(algebra.clone()) {
            Ok(nilpotent) => return work.run(nilpotent),
            Err(Error::NotNilpotent { .. }) => {}
            Err(error) => return Err(error.into()),
        }
        let group = MatrixGroup::of_algebra(&algebra).map_err(|error| {
            InputError::from(error).help("give the algebra by matrices: they name its group")
        })?;
        work.run(group)
    }
}

/// The same matrices in floats.
fn floats(basis: &MatrixBasis<Rational>) -> Vec<DMatrix<f64>> {
    let entry = |value: Rational| value.to_f64();
    let dense =
        |m: &Matrix<Rational>| DMatrix::from_fn(m.rows(), m.columns(), |i, j| entry(m.get(i, j)));
    basis.matrices().iter().map(dense).collect()
}
