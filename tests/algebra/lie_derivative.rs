//! The Lie derivative: brackets of fields, invariance, and independence of the frame.

use crate::common::charts::{Moved, affine, constant, heisenberg, special_linear};
use crate::common::{property::properties, spaces, tensors};
use affinor::{Connection, Frame};
use affinor_tensors::{Down, Symbolic, Tensor, Up, contract};
use proptest::prelude::*;

properties! {
    #![cases(32)]

    #[test]
    fn along_constant_fields((space, x, y, t) in spaces(4).prop_flat_map(|space| {
        let n = space.dimension();
        let vector = move || tensors(n, [Up]);
        (Just(space), vector(), vector(), tensors(n, [Up, Down, Down]))
    })) {
        let frame = space.algebra.left_frame();
        let bracket = space.algebra.bracket(&x.to_vector().unwrap(), &y.to_vector().unwrap());
        let bracket = Tensor::vector(&bracket.unwrap(), Up);
        let along = |x: &_, t: &_| frame.lie_derivative(x, t).unwrap();
        prop_assert_eq!(along(&x, &y), bracket.clone());
        // L_[x,y] = L_x L_y - L_y L_x
        let (xy, yx) = (along(&x, &along(&y, &t)), along(&y, &along(&x, &t)));
        let commutator = contract("a^i_jk - b^i_jk -> ^i_jk", &[("a", &xy), ("b", &yx)])?;
        prop_assert_eq!(along(&bracket, &t), commutator);
        // the structure is invariant by the Jacobi identity
        prop_assert!(along(&x, space.algebra.structure_constants()).is_empty());
        prop_assert!(along(&x, &space.algebra.killing_form()).is_empty());
        // L_x T = nabla_x T of plus
        let plus = Connection::cartan_schouten(&space.algebra, &crate::common::integer(1));
        let nabla = plus.nabla(&t)?;
        let operands = [("x", &x), ("D", &nabla)];
        prop_assert_eq!(along(&x, &t), contract("x^m D^i_mjk -> ^i_jk", &operands)?);
    }
}

/// Components that are functions, without symmetry.
fn functions<const RANK: usize>(
    names: &[&str],
    slots: [affinor_tensors::Variance; RANK],
) -> Tensor<Symbolic> {
    let parameter = |at: usize| Symbolic::parameter(names[at % names.len()]);
    Tensor::from_fn(names.len(), slots, |at| {
        let key = at.iter().fold(1, |key, index| 2 * key + index);
        parameter(key) * &parameter(key / 2) + &constant(key as i64 % 3)
    })
    .unwrap()
}

/// In coordinates `(L_X T)^a_b = X^c d_c T^a_b - d_c X^a T^c_b + d_b X^c T^a_c`, and the same
/// tensor in any other frame.
#[test]
fn any_frame() {
    for chart in [heisenberg(), affine(), special_linear()] {
        let frame = Frame::coordinates(chart.names).unwrap();
        let (x, t) = (functions(chart.names, [Up]), functions(chart.names, [Up, Down]));
        let here = frame.lie_derivative(&x, &t).unwrap();
        let (dx, dt) = (frame.derivative(&x).unwrap(), frame.derivative(&t).unwrap());
        let operands = [("x", &x), ("t", &t), ("X", &dx), ("T", &dt)];
        let along = contract("x^c T_c^a_b -> ^a_b", &operands).unwrap();
        let moved = contract("X_b^c t^a_c - X_c^a t^c_b -> ^a_b", &operands).unwrap();
        let sum = [("a", &along), ("m", &moved)];
        assert_eq!(here, contract("a^a_b + m^a_b -> ^a_b", &sum).unwrap());
        // the same field and tensor by their components in the left-invariant frame
        let left = Moved::new(&chart, Tensor::identity(chart.dimension()));
        let forms = crate::common::inverse(&chart.fields);
        let to_left = |t: &Tensor<Symbolic>| crate::common::transform(t, &chart.fields, &forms);
        let there = left.frame().lie_derivative(&to_left(&x), &to_left(&t)).unwrap();
        assert_eq!(there, to_left(&here));
        // L_X f = X(f), and L_X X = 0
        let f = Tensor::from_fn(chart.dimension(), [], |[]| Symbolic::parameter(chart.names[0]));
        let slope = frame.lie_derivative(&x, &f.unwrap()).unwrap();
        assert_eq!(slope.to_scalar(), Some(x.get(&[0])));
        assert!(left.frame().lie_derivative(&to_left(&x), &to_left(&x)).unwrap().is_empty());
    }
    let plane = Frame::coordinates(&["x", "y"]).unwrap();
    let wrong = Tensor::<Symbolic>::identity(2);
    assert!(plane.lie_derivative(&wrong, &wrong).is_err());
    let x = functions(&["x", "y"], [Down]);
    assert!(plane.lie_derivative(&x, &wrong).is_err());
}
