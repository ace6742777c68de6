//! Is my bracket table a Lie algebra?
//!
//! A [`Bracket`] is antisymmetric, but need not satisfy the Jacobi identity. Its conversion to a
//! [`LieAlgebra`] checks this identity. The error states where the identity fails and by how much.

use affinor::tensors::Rational;
use affinor::{Bracket, LieAlgebra};
use std::error::Error;

/// Checks a correct table, and a table with one bracket too many.
pub fn main() -> Result<(), Box<dyn Error>> {
    // rotations and translations of the plane: [r, p] = q, [r, q] = -p
    let plane = LieAlgebra::try_from(table(1, -1)?)?;
    let [r, p] = [[1, 0, 0], [0, 1, 0]].map(|v| v.map(Rational::from));
    println!("[r, p] = {:?} in the basis r, p, q", plane.bracket(&r, &p)?);
    println!("Killing form: {} nonzero component", plane.killing_form().len());

    // adds the bracket [p, q] = q, which violates the Jacobi identity
    let mut constants = vec![(0, 1, 2, 1), (0, 2, 1, -1)];
    constants.push((1, 2, 2, 1));
    let wrong = constants.into_iter().map(|(j, k, i, v)| (j, k, i, Rational::from(v)));
    let labels = ["r", "p", "q"].map(String::from);
    let wrong = Bracket::from_constants(labels, wrong)?;
    let witness = LieAlgebra::try_from(wrong).expect_err("[p, q] = q does not fit");
    println!("{witness}");
    assert!(matches!(witness, affinor::Error::Broken { law: affinor::Law::Jacobi, .. }));
    Ok(())
}

/// The table of the brackets `[r, p] = a q`, `[r, q] = b p`.
fn table(a: i64, b: i64) -> Result<Bracket<Rational>, affinor::Error> {
    Bracket::from_fn(&["r", "p", "q"], |j, k| match (j, k) {
        (0, 1) => vec![(2, Rational::from(a))],
        (0, 2) => vec![(1, Rational::from(b))],
        _ => vec![],
    })
}
