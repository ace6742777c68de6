//! How do I compute on a group: products, exponentials and logarithms?
//!
//! All groups have the same methods. Vectors are given by components in the basis of the algebra.

use affinor::Error;
use affinor::group::{AnyGroup, LieGroup, Sl2, So3, laws};
use nalgebra::{DVector, Matrix2, Vector3};

/// Computes with rotations, with a matrix group, and with a group chosen by its name.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // a quarter turn about z, followed by a quarter turn about the body axis x
    let quarter = std::f64::consts::FRAC_PI_2;
    let g = So3.exp(&Vector3::new(0.0, 0.0, quarter));
    let h = So3.exp(&Vector3::new(quarter, 0.0, 0.0));
    let x = So3.log(&So3.compose(&g, &h))?;
    println!("rotation vector of the product: {:.6} {:.6} {:.6}", x[0], x[1], x[2]);
    assert!((x - Vector3::repeat(quarter * 4.0 / 27_f64.sqrt())).norm() < 1e-15);

    // the other order gives another rotation, because g h g^-1 is exp(Ad_g y)
    let turned = So3.adjoint(&g, &Vector3::new(quarter, 0.0, 0.0));
    let there = So3.compose(&So3.compose(&g, &h), &So3.inverse(&g));
    assert!((So3.log(&there)? - turned).norm() < 1e-15);

    // in SL(2,R), some elements are not exponentials; the error states the reason
    let far = Matrix2::new(-2.0, 0.0, 0.0, -0.5);
    let refused = Sl2.log(&far).expect_err("its trace is below -2");
    println!("{refused}");
    assert!(matches!(refused, Error::Invalid { what: "logarithm", .. }));

    // the derivative of exp: exp(x + dx) = exp(x) exp(T_left(x) dx)
    let (x, dx) = (Vector3::new(0.4, -0.3, 0.2), Vector3::new(1e-6, 2e-6, -1e-6));
    let moved = Sl2.log(&(Sl2.inverse(&Sl2.exp(&x)) * Sl2.exp(&(x + dx))))?;
    assert!((moved - Sl2.tangent_left(&x, &dx)).norm() < 1e-10);

    // a group can be chosen at run time; `laws` can check any implementation of a group, including
    // your own
    let affine = AnyGroup::named("aff(1)")?;
    let [x, y, z] = [[0.5, 2.0], [-0.3, 1.0], [0.2, -0.4]].map(|x| DVector::from_column_slice(&x));
    laws::all(&affine, &x, &y, &z)?;
    println!("exp of (0.5, 2) in aff(1): {:.6}", affine.exp(&x).transpose());
    Ok(())
}
