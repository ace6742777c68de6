//! The two geometries of Paraskevopoulos and Natsiavas (2013) on the rotation group: M(3) and
//! "SO(3)".
//!
//! E. Paraskevopoulos and S. Natsiavas, *Int. J. Solids and Structures* 50 (2013) 57-72.

use affinor::algebra::catalogue::{self, Entry};
use affinor::{CanonicalConnection, ConnectionKind, Error, Geometry, LieAlgebra, Metric};
use affinor_tensors::{Down, Notation, Rational, Scalar, Symbolic, Tensor};

/// M(3): the connection `plus` (29), and as metric (99) the inertia, whose entries `J11`, `J12`,
/// ..., `J33` are symbolic. See equations (41)-(61) and section 5.
///
/// # Errors
/// No errors occur, because the catalogue contains so(3).
pub fn m3() -> Result<Geometry<Symbolic>, Error> {
    let entry =
        |[i, j]: [usize; 2]| Symbolic::parameter(&format!("J{}{}", i.min(j) + 1, i.max(j) + 1));
    let inertia = Tensor::from_fn(3, [Down, Down], entry)?;
    rotations("M(3)", CanonicalConnection::Plus, |_| inertia, Clone::clone)
}

/// "SO(3)": the connection `zero` (31), and the bi-invariant metric `tr(A^T B)` (102). See
/// equations (62)-(71).
///
/// # Errors
/// No errors occur, because the catalogue contains so(3).
pub fn so3() -> Result<Geometry<Rational>, Error> {
    let product =
        |entry: &Entry| entry.matrices.as_ref().expect("the entry so(3) has matrices").frobenius();
    let constant = |value: &Symbolic| value.as_constant().expect("so(3) has no parameters").clone();
    rotations("SO(3)", CanonicalConnection::Zero, product, constant)
}

fn rotations<S: Notation + Scalar>(
    name: &str,
    connection: CanonicalConnection,
    metric: impl FnOnce(&Entry) -> Tensor<S>,
    value_of: impl Fn(&Symbolic) -> S,
) -> Result<Geometry<S>, Error> {
    let entry = catalogue::find("so(3)").expect("the catalogue has so(3)");
    let bracket = entry.bracket(|value| Ok::<_, Error>(value_of(value)))?;
    let metric = Metric::new(bracket.labels(), metric(&entry))?;
    let kind = ConnectionKind::Canonical(connection);
    let geometry = Geometry::new(name, LieAlgebra::try_from(bracket)?, kind, Some(metric))?;
    Ok(geometry.over(entry.name))
}
