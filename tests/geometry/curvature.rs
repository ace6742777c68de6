//! Torsion and curvature of any connection: their definitions, symmetries, and the identities of
//! Bianchi and Ricci.

mod ricci;

use crate::common::{Space, integer, labels, property::properties, spaces, stored, tensors};
use affinor::{Bracket, Connection, Error, Frame, Law, LieAlgebra};
use affinor_tensors::{Down, Rational, Ring, Symbolic, Tensor, Up, contract};
use num_traits::Zero;
use proptest::prelude::*;

/// `nabla_x y` on constant components, from its definition (B1).
fn along(connection: &Connection<Rational>, x: &[Rational], y: &[Rational]) -> Vec<Rational> {
    let mut result = vec![integer(0); x.len()];
    for (at, value) in connection.affinities().components() {
        result[at[0]] = result[at[0]].clone() + &(value.clone() * &x[at[1]] * &y[at[2]]);
    }
    result
}

fn minus(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    a.iter().zip(b).map(|(a, b)| a.clone() - b).collect()
}

/// (B9) and (B13), with operators and with explicit brackets and derivatives.
fn agrees_with_operators(
    space: &Space,
    connection: &Connection<Rational>,
    [x, y, z]: [&[Rational]; 3],
) -> Result<(), TestCaseError> {
    let nabla = |x: &[Rational], y: &[Rational]| along(connection, x, y);
    let bracket = space.algebra.bracket(x, y).unwrap();
    let torsion = minus(&minus(&nabla(x, y), &nabla(y, x)), &bracket);
    let twice = minus(&nabla(x, &nabla(y, z)), &nabla(y, &nabla(x, z)));
    let curvature = minus(&twice, &nabla(&bracket, z));
    let (torsion_tensor, curvature_tensor) = (connection.torsion(), connection.curvature());
    let vectors = [x, y, z].map(|v| Tensor::vector(v, Up));
    let operands = [
        ("t", &torsion_tensor),
        ("R", curvature_tensor),
        ("x", &vectors[0]),
        ("y", &vectors[1]),
        ("z", &vectors[2]),
    ];
    let ty = contract("t^i_jk y^k -> ^i_j", &operands)?;
    let txy = contract("m^i_j x^j -> ^i", &[("m", &ty), operands[2]])?;
    prop_assert_eq!(txy.to_vector().unwrap(), torsion);
    let rz = contract("R^i_jkl z^j -> ^i_kl", &operands)?;
    let rzx = contract("m^i_kl x^k -> ^i_l", &[("m", &rz), operands[2]])?;
    let rzxy = contract("m^i_l y^l -> ^i", &[("m", &rzx), operands[3]])?;
    prop_assert_eq!(rzxy.to_vector().unwrap(), curvature);
    let trace = (0..x.len()).fold(integer(0), |sum, i| sum + &curvature_tensor.get(&[i, 1, i, 2]));
    prop_assert_eq!(connection.ricci().get(&[1, 2]), trace);
    Ok(())
}

/// `[nabla_k, nabla_l]` on a vector and on a covector with constant components.
fn ricci_identity(
    connection: &Connection<Rational>,
    v: &Tensor<Rational>,
    w: &Tensor<Rational>,
) -> Result<(), TestCaseError> {
    let (curvature, torsion) = (connection.curvature(), connection.torsion());
    let (dv, dw) = (connection.nabla(v)?, connection.nabla(w)?);
    let (ddv, ddw) = (connection.nabla(&dv)?, connection.nabla(&dw)?);
    let fixed = [("R", curvature), ("t", &torsion)];
    let on_vector = contract(
        "D^i_kl - D^i_lk - R^i_mkl v^m + t^m_kl d^i_m -> ^i_kl",
        &[&fixed[..], &[("D", &ddv), ("d", &dv), ("v", v)]].concat(),
    )?;
    prop_assert!(on_vector.is_empty(), "{on_vector:?}");
    let on_covector = contract(
        "D_klj - D_lkj + R^m_jkl w_m + t^m_kl d_mj -> _jkl",
        &[&fixed[..], &[("D", &ddw), ("d", &dw), ("w", w)]].concat(),
    )?;
    prop_assert!(on_covector.is_empty(), "{on_covector:?}");
    Ok(())
}

properties! {
    #![cases(64)]

    #[test]
    fn definitions(
        (space, v) in spaces(5).prop_flat_map(|space| {
            let n = space.dimension();
            (Just(space), tensors(n, [Up, Up]))
        })
    ) {
        let n = space.dimension();
        let row = |k: usize| (0..n).map(|i| v.get(&[k % n, i])).collect::<Vec<_>>();
        let [x, y, z] = [row(0), row(1), row(2)];
        for connection in space.connections() {
            agrees_with_operators(&space, &connection, [&x, &y, &z])?;
        }
    }

    #[test]
    fn antisymmetries(space in spaces(5)) {
        for connection in space.connections() {
            for (at, value) in stored(&connection.torsion()) {
                prop_assert_ne!(at[1], at[2]);
                prop_assert_eq!(connection.torsion().get(&[at[0], at[2], at[1]]), -value);
            }
            let curvature = connection.curvature();
            for (at, value) in stored(curvature) {
                prop_assert_ne!(at[2], at[3]);
                prop_assert_eq!(curvature.get(&[at[0], at[1], at[3], at[2]]), -value);
            }
        }
    }

    #[test]
    fn bianchi_residuals_vanish(space in spaces(5)) {
        for connection in space.connections() {
            prop_assert!(connection.bianchi_first().is_empty());
            prop_assert!(connection.bianchi_second().is_empty());
        }
    }

    #[test]
    fn covariant_derivatives_commute_up_to_curvature_and_torsion(
        (space, v, w) in spaces(5).prop_flat_map(|space| {
            let n = space.dimension();
            (Just(space), tensors(n, [Up]), tensors(n, [Down]))
        })
    ) {
        for connection in space.connections() {
            ricci_identity(&connection, &v, &w)?;
        }
    }
}

properties! {
    #![cases(12)]

    #[test]
    fn in_dimensions_up_to_seven(space in spaces(7)) {
        let connection = space.connection();
        prop_assert!(connection.bianchi_first().is_empty());
        prop_assert!(connection.bianchi_second().is_empty());
    }
}

/// The connection `plus` over a bracket that may violate the Jacobi identity.
fn plus(c: &Tensor<Rational>) -> Connection<Rational> {
    let frame = Frame::invariant(labels(c.dimension()), c.clone()).unwrap();
    Connection::new(frame, c.clone()).unwrap()
}

/// `[[e_j,e_k],e_l]` and cyclic, by plain sums.
fn jacobiator(c: &Tensor<Rational>, [i, j, k, l]: [usize; 4]) -> Rational {
    let double = |j, k, l| {
        let terms = (0..c.dimension()).map(|m| c.get(&[m, j, k]) * &c.get(&[i, m, l]));
        terms.fold(integer(0), |sum, term| sum + &term)
    };
    double(j, k, l) + &double(k, l, j) + &double(l, j, k)
}

properties! {
    #![cases(48)]

    /// If the Jacobi identity fails, the curvature of `plus` is the Jacobiator, and the Bianchi
    /// identities fail too. The algebra is rejected with the first triple and its Jacobiator.
    #[test]
    fn a_false_bracket_shows(b in (3usize..=4).prop_flat_map(|n| tensors(n, [Up, Down, Down]))) {
        let n = b.dimension();
        let c = contract("b^i_jk - b^i_kj -> ^i_jk", &[("b", &b)])?;
        let residual = |at| jacobiator(&c, at);
        let plus = plus(&c);
        let curvature = plus.curvature();
        let mut triples = vec![];
        for at in (0..n.pow(4)).map(|key| [3, 2, 1, 0].map(|place| key / n.pow(place) % n)) {
            let [i, j, k, l] = at;
            prop_assert_eq!(curvature.get(&[i, j, k, l]), -residual(at));
            if !residual(at).is_zero() {
                triples.push([j, k, l]);
            }
        }
        let bracket = Bracket::new(labels(n), c.clone())?;
        let jacobi = bracket.jacobi();
        for at in jacobi.components().map(|(at, _)| at) {
            prop_assert_eq!(jacobi.get(&at), residual([at[0], at[1], at[2], at[3]]));
        }
        let Some(&[j, k, l]) = triples.iter().min() else {
            prop_assert!(LieAlgebra::try_from(bracket).is_ok());
            return Ok(());
        };
        prop_assert!(!jacobi.is_empty());
        prop_assert!(!plus.bianchi_first().is_empty());
        let Err(Error::Broken { law: Law::Jacobi, at, residual: text }) = LieAlgebra::try_from(bracket) else {
            return Err(TestCaseError::fail("taken for a Lie algebra"));
        };
        prop_assert_eq!(at, [j, k, l].map(|at| format!("e{}", at + 1)));
        for i in 0..n {
            prop_assert_eq!(text.contains(&format!("e{}", i + 1)), !residual([i, j, k, l]).is_zero());
        }
    }
}

properties! {
    #![cases(24)]

    /// The residual equals the left side of the identity, also where it does not vanish: over a
    /// bracket that violates the Jacobi identity.
    #[test]
    fn the_second_identity_is_the_cyclic_sum_of_nabla_r_and_torsion(
        (b, gamma) in (3usize..=4).prop_flat_map(|n| {
            let slots = [Up, Down, Down];
            (tensors(n, slots), tensors(n, slots))
        })
    ) {
        let c = contract("b^i_jk - b^i_kj -> ^i_jk", &[("b", &b)])?;
        let connection = Connection::new(Frame::invariant(labels(b.dimension()), c)?, gamma)?;
        let (nabla, torsion) = (connection.nabla_curvature(), connection.torsion());
        let stated = contract(
            "D^i_mjkl + D^i_kjlm + D^i_ljmk \
             + t^p_mk R^i_jpl + t^p_kl R^i_jpm + t^p_lm R^i_jpk -> ^i_jmkl",
            &[("D", &nabla), ("t", &torsion), ("R", connection.curvature())],
        )?;
        prop_assert_eq!(connection.bianchi_second(), stated);
    }
}

#[test]
fn the_witness_of_a_false_bracket_reads_well() {
    // [x,y] = 2x + y, [y,z] = z: [[x,y],z] + [[y,z],x] + [[z,x],y] = z
    let bracket = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
        (0, 1) => vec![(0, integer(2)), (1, integer(1))],
        (1, 2) => vec![(2, integer(1))],
        _ => vec![],
    });
    let error = LieAlgebra::try_from(bracket.unwrap()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the Jacobi identity fails: [[x,y],z] + [[y,z],x] + [[z,x],y] = z"
    );
    // labels and parameters need not be ASCII
    let parameter = Symbolic::parameter("\u{3bb}");
    let bracket = Bracket::from_fn(&["\u{3be}", "\u{3b7}", "\u{3b6}"], |j, k| match (j, k) {
        (0, 1) => vec![(1, Symbolic::from_i64(1))],
        (1, 2) => vec![(2, parameter.clone())],
        _ => vec![],
    });
    let error = LieAlgebra::try_from(bracket.unwrap()).unwrap_err();
    let Error::Broken { law: Law::Jacobi, residual, .. } = error else { panic!("{error}") };
    assert_eq!(residual, "\u{3bb}*\u{3b6}");
}
