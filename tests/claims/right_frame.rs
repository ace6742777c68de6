//! The two invariant frames: the components of a connection in the right one, and when they are
//! constant.
//!
//! Guards `Connection::in_right_frame`, `Geometry::in_right_frame`, and reports about the right frame.

use crate::common::algebras::by_table;
use crate::common::{Space, fraction, integer, property::properties, spaces};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{
    Bracket, CanonicalConnection, Connection, ConnectionKind, Error, Geometry, Law, LieAlgebra,
};
use affinor_documents::report::{EquationReport, Format, Quantity, Report, Table};
use affinor_tensors::{Rational, Tensor, contract};
use num_traits::Zero;
use proptest::prelude::*;

/// The algebra of the right-invariant fields: `g -> g^-1` turns `c` into `-c`.
fn inverted(algebra: &LieAlgebra<Rational>) -> LieAlgebra<Rational> {
    let opposite = algebra.structure_constants().map(|value| -value.clone());
    Bracket::new(algebra.labels(), opposite).unwrap().try_into().unwrap()
}

/// Torsion and curvature are the same in both frames: the tensors of an ad-invariant connection
/// have equal components in the two.
fn same_tensors(
    left: &Connection<Rational>,
    right: &Connection<Rational>,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(left.torsion(), right.torsion());
    prop_assert_eq!(left.curvature(), right.curvature());
    prop_assert_eq!(left.ricci(), right.ricci());
    Ok(())
}

/// `(L_m Lambda)^i_jk` for `[i, m, j, k]`, by plain sums.
fn variation(space: &Space, gamma: &Tensor<Rational>, [i, m, j, k]: [usize; 4]) -> Rational {
    let c = space.algebra.structure_constants();
    (0..space.dimension()).fold(integer(0), |sum, p| {
        sum + &(c.get(&[i, m, p]) * &gamma.get(&[p, j, k]))
            - &(c.get(&[p, m, j]) * &gamma.get(&[i, p, k]))
            - &(c.get(&[p, m, k]) * &gamma.get(&[i, j, p]))
    })
}

/// Either the components are constant in the right-invariant frame, or the error names a component
/// that is not.
fn constant_or_refused(space: &Space, left: &Connection<Rational>) -> Result<bool, TestCaseError> {
    let n = space.dimension();
    let places = (0..n.pow(4)).map(|key| [3, 2, 1, 0].map(|place| key / n.pow(place) % n));
    match left.in_right_frame(&space.algebra) {
        Ok(right) => {
            for at in places {
                prop_assert!(variation(space, left.affinities(), at).is_zero());
            }
            same_tensors(left, &right)?;
            Ok(true)
        }
        Err(Error::Broken { law: Law::AdInvariance, at, residual }) => {
            let m = space.algebra.labels().iter().position(|label| *label == at[0]).unwrap();
            let [i, j, k] = [1, 2, 3].map(|place| at[place].parse::<usize>().unwrap());
            let value = variation(space, left.affinities(), [i - 1, m, j - 1, k - 1]);
            prop_assert!(!value.is_zero());
            prop_assert_eq!(residual, value.to_string());
            Ok(false)
        }
        Err(other) => Err(TestCaseError::fail(other.to_string())),
    }
}

properties! {
    #![cases(40)]

    /// `Lambda_right = Lambda - c` over `-c`, which is the member `1 - lambda` of the family of
    /// the inverted group.
    #[test]
    fn inversion_exchanges_lambda_and_one_minus_lambda(space in spaces(5)) {
        let left = space.family();
        let right = left.in_right_frame(&space.algebra).unwrap();
        let c = space.algebra.structure_constants();
        prop_assert_eq!(right.frame().structure_functions(), &c.scale(&integer(-1)));
        let shifted = contract("L^i_jk - c^i_jk -> ^i_jk", &[("L", left.affinities()), ("c", c)])?;
        prop_assert_eq!(right.affinities(), &shifted);
        let group = inverted(&space.algebra);
        let mirrored = Connection::cartan_schouten(&group, &(integer(1) - &space.lambda));
        prop_assert_eq!(right.affinities(), mirrored.affinities());
        prop_assert_eq!(right.frame().structure_functions(), mirrored.frame().structure_functions());
        same_tensors(&left, &right)?;
        // and back again to the left-invariant frame
        let back = right.in_right_frame(&group).unwrap();
        prop_assert_eq!(back.affinities(), left.affinities());
        prop_assert_eq!(back.frame().structure_functions(), left.frame().structure_functions());
    }

    #[test]
    fn other_connections_are_constant_or_refused(space in spaces(4)) {
        constant_or_refused(&space, &space.connection())?;
        constant_or_refused(&space, &space.levi_civita())?;
    }

    /// A frame of another algebra is an error.
    #[test]
    fn another_algebra_is_refused(space in spaces(4)) {
        let group = inverted(&space.algebra);
        let refused = space.family().in_right_frame(&group).is_err();
        prop_assert_eq!(refused, !space.algebra.structure_constants().is_empty());
    }
}

/// Different factors on different ideals: the connection is invariant under ad, but not a multiple
/// of `c`.
#[test]
fn ideals_may_have_their_own_lambda() {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let algebra = so3.direct_sum(&affine).unwrap();
    let gamma = algebra.structure_constants().filter_map(|at, value| {
        let lambda = if at[0] < 3 { fraction(1, 3) } else { fraction(-5, 2) };
        Some(value.clone() * &lambda)
    });
    let left = Connection::new(algebra.left_frame().clone(), gamma).unwrap();
    let right = left.in_right_frame(&algebra).unwrap();
    assert_eq!(right.affinities().get(&[2, 0, 1]), fraction(-2, 3));
    assert_eq!(right.affinities().get(&[4, 3, 4]), fraction(-7, 2));
    same_tensors(&left, &right).unwrap();
}

/// Levi-Civita is constant in the right-invariant frame for a bi-invariant metric; other metrics
/// are an error.
#[test]
fn levi_civita_of_an_inertia() {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let levi_civita = |diagonal: [i64; 3]| {
        let g = Tensor::from_components(
            3,
            &[affinor_tensors::Down; 2],
            (0..3).map(|i| ([i, i], integer(diagonal[i]))),
        );
        let metric = affinor::Metric::new(so3.labels(), g.unwrap()).unwrap();
        Connection::levi_civita(so3.left_frame(), &metric).unwrap()
    };
    let round = levi_civita([2, 2, 2]).in_right_frame(&so3).unwrap();
    assert_eq!(round.affinities(), &so3.structure_constants().scale(&fraction(-1, 2)));
    let refused = levi_civita([1, 2, 3]).in_right_frame(&so3).unwrap_err();
    assert!(matches!(refused, Error::Broken { law: Law::AdInvariance, .. }), "{refused}");
    assert!(refused.to_string().contains("no constant components in the right-invariant frame"));
}

/// All output of a geometry names the frame of its components, however the connection was chosen.
#[test]
fn the_frame_is_named_as_it_is() {
    let algebra = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let given = algebra.structure_constants().scale(&fraction(1, 3));
    let kinds = [
        ConnectionKind::Canonical(CanonicalConnection::Plus),
        ConnectionKind::Family(fraction(1, 3)),
        ConnectionKind::Affinities(given),
    ];
    for kind in kinds {
        let left = Geometry::new("rotations", algebra.clone(), kind.clone(), None).unwrap();
        let right = left.in_right_frame().unwrap();
        let back = right.in_right_frame().unwrap();
        let names = [(&left, "left-invariant"), (&right, "right-invariant")];
        for (geometry, name) in names.into_iter().chain([(&back, "left-invariant")]) {
            let other = if name.starts_with('l') { "right-invariant" } else { "left-invariant" };
            let table = Table::new(geometry, &[Quantity::Structure, Quantity::Affinities]).unwrap();
            assert_eq!((geometry.frame_name(), table.frame), (name, name));
            let transport =
                Equations::new(EquationKind::Transport, geometry.connection(), None).unwrap();
            let system = EquationReport::new(transport, geometry);
            for format in Format::ALL {
                let [mut of_table, mut of_system] = [vec![], vec![]];
                table.write(format, &mut of_table).unwrap();
                system.write(format, &mut of_system).unwrap();
                for written in [of_table, of_system] {
                    let written = String::from_utf8(written).unwrap();
                    let written = written.split_whitespace().collect::<Vec<_>>().join(" ");
                    let frames = [format!("{other} frame"), format!("\"{other}\"")];
                    assert!(!frames.iter().any(|frame| written.contains(frame)), "{written}");
                }
            }
            let mut text = vec![];
            system.write(Format::Text, &mut text).unwrap();
            let text = String::from_utf8(text).unwrap();
            // line breaks depend on the width
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(words.contains(&format!("in the {name} frame")), "{text}");
        }
        if let ConnectionKind::Affinities(gamma) = right.kind() {
            assert_eq!(gamma, right.connection().affinities());
        }
        assert_eq!(back.connection().affinities(), left.connection().affinities());
        assert_eq!(back.kind(), &kind);
    }
}
