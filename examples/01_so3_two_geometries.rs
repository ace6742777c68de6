//! How can one rotation group carry two geometries?
//!
//! Both geometries have the same bracket, but different connections. The connection `plus` has
//! torsion and no curvature; Paraskevopoulos and Natsiavas (2013) call this geometry M(3). The
//! connection `zero` has curvature and no torsion; they call this geometry SO(3).

use affinor::tensors::{Rational, Tensor};
use affinor::{Bracket, CanonicalConnection, Connection, LieAlgebra};
use std::error::Error;

/// Computes both geometries and prints the tensors that do not vanish.
pub fn main() -> Result<(), Box<dyn Error>> {
    // [e1, e2] = e3 and cyclic permutations; indices count from 0, and only pairs with j < k are
    // needed
    let bracket = Bracket::from_fn(&["e1", "e2", "e3"], |j, k| match (j, k) {
        (0, 1) => vec![(2, Rational::from(1))],
        (0, 2) => vec![(1, Rational::from(-1))],
        _ => vec![(0, Rational::from(1))],
    })?;
    let so3 = LieAlgebra::try_from(bracket)?; // this conversion checks the Jacobi identity

    for which in [CanonicalConnection::Plus, CanonicalConnection::Zero] {
        let connection = Connection::canonical(&so3, which);
        println!("{}: {}", which.name(), which.paper());
        show("torsion tau", &connection.torsion());
        show("curvature R", connection.curvature());
        show("Ricci tensor", &connection.ricci());
    }

    assert!(Connection::canonical(&so3, CanonicalConnection::Plus).curvature().is_empty());
    assert!(Connection::canonical(&so3, CanonicalConnection::Zero).torsion().is_empty());
    Ok(())
}

/// Prints the number of nonzero components and the first of them, with indices from 1.
fn show(name: &str, tensor: &Tensor<Rational>) {
    match tensor.components().next() {
        None => println!("  {name} = 0"),
        Some((at, value)) => {
            let indices: Vec<usize> = at.iter().map(|i| i + 1).collect();
            println!("  {name}: {} components, the first {value} at {indices:?}", tensor.len());
        }
    }
}
