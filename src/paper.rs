//! The two geometries of the paper: the same rotation group, M(3) and "SO(3)".
//!
//! I. Paraskevopoulos and S. Natsiavas, *Int. J. Solids and Structures* 50 (2013) 57-72.

use crate::Geometry;
use crate::definition::{Definition, InputError, Reading};
use affinor_tensors::{Notation, Rational, Symbolic, Tolerance};

/// M(3): connection `plus` (29) and the inertia `J` with entries `J11..J33` as metric (99).
///
/// # Errors
/// None that a valid catalogue causes.
pub fn m3() -> Result<Geometry<Symbolic>, InputError> {
    geometry(&Definition::m3()?, &|value| Some(value.clone()))
}

/// "SO(3)": connection `zero` (31) and the bi-invariant metric `tr(A^T B)` (102).
///
/// # Errors
/// None that a valid catalogue causes.
pub fn so3() -> Result<Geometry<Rational>, InputError> {
    geometry(&Definition::so3()?, &|value| value.as_constant().cloned())
}

fn geometry<S: Notation>(
    definition: &Definition,
    convert: &dyn Fn(&Symbolic) -> Option<S>,
) -> Result<Geometry<S>, InputError> {
    definition.geometry(&Reading { convert, tolerance: Tolerance::default() })
}
