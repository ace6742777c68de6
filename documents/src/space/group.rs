//! The group of a definition.

use crate::input::InputError;
use crate::space::{Definition, Origin};
use affinor::LieAlgebra;
use affinor::group::{AnyGroup, MatrixGroup, registry};
use affinor::tensors::Tolerance;

impl Definition {
    /// A group whose Lie algebra is this algebra, in its basis. The group comes from the
    /// [`registry`] if the algebra has a name, from the matrices if they are given, and otherwise
    /// from the brackets ([`registry::of_algebra`]).
    ///
    /// # Errors
    /// Errors of the algebra, and an error if only brackets are given and the algebra has a centre.
    pub fn group(&self, tolerance: Tolerance) -> Result<AnyGroup, InputError> {
        let name = self.algebra_name.as_deref().unwrap_or(&self.name);
        if self.source.is_none()
            && let Ok(group) = registry::find(name)
        {
            return Ok(group);
        }
        if matches!(self.origin, Origin::Matrices(..)) {
            return Ok(AnyGroup::new(MatrixGroup::from_basis(&self.matrix_basis(tolerance)?)?));
        }
        let algebra: LieAlgebra<f64> = self.algebra(tolerance)?;
        registry::of_algebra(&algebra).map_err(|error| {
            InputError::from(error).help("give the algebra by matrices: they name its group")
        })
    }
}
