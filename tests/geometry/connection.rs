//! The covariant derivative is a derivation for products and contractions, and has the right value
//! on tensors.

mod canonical;
mod nonholonomic;

use crate::common::{Space, integer, labels, property::properties, spaces, tensors};
use affinor::{Connection, Error, Frame};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};
use proptest::prelude::*;

type Mixed = Tensor<Rational>;

/// A space with random tensors `s^i_j` and `t^i_jk`.
fn with_tensors(most: usize) -> impl Strategy<Value = (Space, Mixed, Mixed)> {
    spaces(most).prop_flat_map(|space| {
        let n = space.dimension();
        (Just(space), tensors(n, [Up, Down]), tensors(n, [Up, Down, Down]))
    })
}

properties! {
    #![cases(64)]

    /// The covariant derivative by components, as in the conventions.
    #[test]
    fn by_components((space, s, _) in with_tensors(4)) {
        let n = space.dimension();
        let nabla = space.connection().nabla(&s)?;
        prop_assert_eq!(nabla.slots(), [Up, Down, Down]);
        let gamma = &space.affinities;
        for [i, m, j] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
            let terms = (0..n).map(|p| {
                gamma.get(&[i, m, p]) * &s.get(&[p, j]) - &(gamma.get(&[p, m, j]) * &s.get(&[i, p]))
            });
            let value = terms.fold(integer(0), |sum, term| sum + &term);
            prop_assert_eq!(nabla.get(&[i, m, j]), value);
        }
    }

    #[test]
    fn the_identity_is_parallel(space in spaces(6)) {
        let delta = Tensor::identity(space.dimension());
        prop_assert!(space.connection().nabla(&delta)?.is_empty());
    }

    #[test]
    fn scalars_have_no_derivative_here(space in spaces(4)) {
        let scalar = Tensor::from_fn(space.dimension(), [], |[]| integer(5))?;
        let nabla = space.connection().nabla(&scalar)?;
        prop_assert_eq!(nabla.slots(), [Down]);
        prop_assert!(nabla.is_empty());
    }

    #[test]
    fn the_product_rule((space, s, t) in with_tensors(3)) {
        let connection = space.connection();
        let product = contract("s^a_b t^i_jk -> ^ai_bjk", &[("s", &s), ("t", &t)])?;
        let (ds, dt) = (connection.nabla(&s)?, connection.nabla(&t)?);
        let rule = contract(
            "D^a_mb t^i_jk + s^a_b E^i_mjk -> ^ai_mbjk",
            &[("D", &ds), ("E", &dt), ("s", &s), ("t", &t)],
        )?;
        prop_assert_eq!(connection.nabla(&product)?, rule);
    }

    #[test]
    fn contractions_commute((space, s, t) in with_tensors(4)) {
        let connection = space.connection();
        for slot in [1, 2] {
            let before = connection.nabla(&t.trace(0, slot)?)?;
            prop_assert_eq!(before, connection.nabla(&t)?.trace(0, slot + 1)?);
        }
        prop_assert!(connection.nabla(&s.trace(0, 1)?)?.is_empty());
    }

    /// With lower slots first and upper slots between, the direction is the first lower index.
    #[test]
    fn any_order_of_slots((space, _, t) in with_tensors(3)) {
        let connection = space.connection();
        let nabla = connection.nabla(&t)?;
        for order in [[1, 0, 2], [1, 2, 0], [2, 1, 0]] {
            let moved = connection.nabla(&t.permute(&order)?)?;
            // here the direction is before all of them, there after the upper slot
            let places = order.map(|slot| if slot == 0 { 0 } else { slot + 1 });
            prop_assert_eq!(moved, nabla.permute(&[&[1], &places[..]].concat())?);
        }
    }
}

/// The largest ranks give a result or an error.
#[test]
fn ranks_have_a_limit() {
    let frame = Frame::invariant(labels(2), Tensor::zero(2, &[Up, Down, Down]).unwrap()).unwrap();
    let gamma = Tensor::from_fn(2, [Up, Down, Down], |_| integer(1)).unwrap();
    let connection = Connection::new(frame, gamma).unwrap();
    let seven = Tensor::<Rational>::from_fn(2, [Down; 7], |_| integer(1)).unwrap();
    assert_eq!(connection.nabla(&seven).unwrap().get(&[0; 8]), integer(-14));
    let eight = Tensor::<Rational>::from_fn(2, [Down; 8], |_| integer(1)).unwrap();
    assert!(matches!(connection.nabla(&eight), Err(Error::Tensor(_))));
    // and in a frame with derivations
    let plane = Frame::coordinates(&["x", "y"]).unwrap();
    let flat = Connection::new(plane, Tensor::zero(2, &[Up, Down, Down]).unwrap()).unwrap();
    let eight = Tensor::<Symbolic>::from_fn(2, [Up; 8], |_| Symbolic::parameter("x")).unwrap();
    assert!(matches!(flat.nabla(&eight), Err(Error::Tensor(_))));
    let other = Tensor::<Symbolic>::identity(3);
    assert!(matches!(flat.nabla(&other), Err(Error::Shape { .. })));
}
