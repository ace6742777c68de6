//! Which Lie algebra do my matrices span?
//!
//! Commutators give the structure constants. Matrices may be complex, but their span is over the
//! real numbers. If the span is not closed, the error names a commutator outside it.

use affinor::algebra::{Complex, LieAlgebra, MatrixBasis};
use affinor::tensors::{Rational, Ring, Tolerance};
use std::error::Error;

type Entries = Vec<(usize, usize, Complex<Rational>)>;

/// Finds sl(2,R) and su(2), and tries two matrices whose span is not closed.
pub fn main() -> Result<(), Box<dyn Error>> {
    let e = vec![real(0, 1, 1)];
    let f = vec![real(1, 0, 1)];
    let h = vec![real(0, 0, 1), real(1, 1, -1)];
    let sl2 =
        LieAlgebra::try_from(basis(["e", "f", "h"], vec![e.clone(), f.clone(), h])?.bracket()?)?;
    println!(
        "sl(2): c^h_ef = {}, c^e_he = {}",
        sl2.structure_constants().get(&[2, 0, 1]),
        sl2.structure_constants().get(&[0, 2, 0])
    );
    assert_eq!(sl2.structure_constants().get(&[0, 2, 0]), Rational::from(2)); // [h, e] = 2 e

    // -i/2 times the Pauli matrices: [u1, u2] = u3
    let half = Rational::new(-1, 2).ok_or("no half")?;
    let imaginary = |i, j, im: &Rational| (i, j, Complex { re: Rational::from(0), im: im.clone() });
    let u1 = vec![imaginary(0, 1, &half), imaginary(1, 0, &half)];
    let u2 = vec![(0, 1, Complex::real(half.clone())), (1, 0, Complex::real(-half.clone()))];
    let u3 = vec![imaginary(0, 0, &half), imaginary(1, 1, &-half)];
    let su2 = basis(["u1", "u2", "u3"], vec![u1, u2, u3])?;
    let algebra = LieAlgebra::try_from(su2.bracket()?)?;
    println!("su(2): [u1, u2] = {} u3", algebra.structure_constants().get(&[2, 0, 1]));
    assert!(algebra.structure_constants().get(&[2, 0, 1]) == Rational::from_i64(1));

    // without h, the span does not contain the commutator [e, f]
    let open = basis(["e", "f"], vec![e, f])?;
    let witness = open.bracket().expect_err("e and f do not close");
    println!("{witness}");
    assert!(matches!(witness, affinor::Error::Broken { law: affinor::Law::Closure, .. }));
    Ok(())
}

/// An entry of a real matrix: the row, the column and the value.
fn real(i: usize, j: usize, value: i64) -> (usize, usize, Complex<Rational>) {
    (i, j, Complex::real(Rational::from(value)))
}

/// The algebra that 2 x 2 matrices span.
fn basis<const N: usize>(
    labels: [&str; N],
    matrices: Vec<Entries>,
) -> Result<MatrixBasis<Rational>, affinor::Error> {
    MatrixBasis::new(labels, 2, matrices, Tolerance::default())
}
