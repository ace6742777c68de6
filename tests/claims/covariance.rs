//! Every tensor follows a change of basis `e'_a = A^i_a e_i`: upper indices by the inverse of
//! `A`, lower ones by `A`.
//!
//! Guards `change_basis` of algebras, connections and metrics; `Connection::{torsion, curvature}`, the Ricci tensors.

use crate::common::{Space, inverse, invertible, property::properties, spaces, tensors, transform};
use affinor::{BasisChange, Connection, Error, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Tensor, Up};
use proptest::prelude::*;

/// A space before and after a change of basis.
#[derive(Clone, Debug)]
struct Change {
    a: Tensor<Rational>,
    inverse: Tensor<Rational>,
    old: Space,
    new: Space,
}

impl Change {
    fn moved(&self, tensor: &Tensor<Rational>) -> Tensor<Rational> {
        transform(tensor, &self.a, &self.inverse)
    }
}

fn changes() -> impl Strategy<Value = Change> {
    spaces(4).prop_flat_map(|old| {
        invertible(old.dimension()).prop_map(move |a| {
            let old = old.clone();
            let change = BasisChange::new(a.clone()).unwrap();
            let algebra = old.algebra.change_basis(&change).unwrap();
            let inverse = inverse(&a);
            let metric = transform(old.metric.components(), &a, &inverse);
            let metric = Metric::new(algebra.labels(), metric).unwrap();
            let affinities = transform(&old.affinities, &a, &inverse);
            let lambda = old.lambda.clone();
            let new = Space { algebra, lambda, metric, affinities };
            Change { a, inverse, old, new }
        })
    })
}

properties! {
    #![cases(64)]

    #[test]
    fn the_algebra(change in changes()) {
        let (old, new) = (&change.old.algebra, &change.new.algebra);
        prop_assert_eq!(new.structure_constants(), &change.moved(old.structure_constants()));
        prop_assert_eq!(new.killing_form(), change.moved(&old.killing_form()));
        // the result is an algebra, and the inverse change of basis gives the original
        let bracket = affinor::Bracket::new(new.labels(), new.structure_constants().clone());
        prop_assert!(LieAlgebra::try_from(bracket.unwrap()).is_ok());
        let back = BasisChange::new(change.inverse.clone()).unwrap();
        let returned = new.change_basis(&back).unwrap();
        prop_assert_eq!(returned.structure_constants(), old.structure_constants());
    }

    #[test]
    fn torsion_and_curvature(change in changes()) {
        for (old, new) in change.old.connections().iter().zip(&change.new.connections()) {
            prop_assert_eq!(new.affinities(), &change.moved(old.affinities()));
            prop_assert_eq!(new.torsion(), change.moved(&old.torsion()));
            prop_assert_eq!(new.curvature(), &change.moved(old.curvature()));
            prop_assert_eq!(new.ricci(), change.moved(&old.ricci()));
        }
    }

    #[test]
    fn what_the_metric_brings(change in changes()) {
        let (old, new) = (&change.old, &change.new);
        prop_assert_eq!(new.metric.inverse(), &change.moved(old.metric.inverse()));
        for (of_old, of_new) in old.connections().iter().zip(&new.connections()) {
            let q = of_old.nonmetricity(&old.metric)?;
            prop_assert_eq!(of_new.nonmetricity(&new.metric)?, change.moved(&q));
            let scalar = of_old.scalar_curvature(&old.metric).unwrap();
            prop_assert_eq!(of_new.scalar_curvature(&new.metric).unwrap(), scalar);
        }
    }

    #[test]
    fn derivatives_vectors_and_planes(
        (change, t, v) in changes().prop_flat_map(|change| {
            let n = change.a.dimension();
            (Just(change), tensors(n, [Down, Up, Down]), tensors(n, [Up, Up]))
        })
    ) {
        let n = change.a.dimension();
        let row = |k: usize| (0..n).map(|i| v.get(&[k, i])).collect::<Vec<_>>();
        let [x, y] = [row(0), row(1)];
        let moved = |v: &[Rational]| change.moved(&Tensor::vector(v, Up)).to_vector().unwrap();
        let (old, new) = (&change.old, &change.new);
        for (of_old, of_new) in old.connections().iter().zip(&new.connections()) {
            let nabla = of_old.nabla(&t)?;
            prop_assert_eq!(of_new.nabla(&change.moved(&t))?, change.moved(&nabla));
            prop_assert_eq!(
                of_new.sectional_curvature(&new.metric, &moved(&x), &moved(&y)).unwrap(),
                of_old.sectional_curvature(&old.metric, &x, &y).unwrap()
            );
            match of_old.transport_generator(&x) {
                Ok(generator) => {
                    let expected = change.moved(&generator);
                    prop_assert_eq!(of_new.transport_generator(&moved(&x)).unwrap(), expected);
                }
                Err(_) => prop_assert!(of_new.transport_generator(&moved(&x)).is_err()),
            }
        }
        let ad = old.algebra.ad(&x).unwrap();
        prop_assert_eq!(new.algebra.ad(&moved(&x)).unwrap(), change.moved(&ad));
        let bracket = moved(&old.algebra.bracket(&x, &y).unwrap());
        prop_assert_eq!(new.algebra.bracket(&moved(&x), &moved(&y)).unwrap(), bracket);
    }

    /// The library's change of basis agrees with explicit sums, for slots in any order.
    #[test]
    fn by_hand_and_by_the_program(
        (a, t, s) in (1usize..4).prop_flat_map(|n| {
            (invertible(n), tensors(n, [Down, Up, Up, Down]), tensors(n, [Up, Down, Down]))
        })
    ) {
        let change = BasisChange::new(a.clone()).unwrap();
        let inverse = inverse(&a);
        prop_assert_eq!(change.apply(&t).unwrap(), transform(&t, &a, &inverse));
        prop_assert_eq!(change.apply(&s).unwrap(), transform(&s, &a, &inverse));
        prop_assert_eq!(change.apply(&a).unwrap(), a);
    }
}

#[test]
fn a_dependent_basis_is_refused() {
    let singular = Tensor::from_fn(3, [Up, Down], |[i, j]| Rational::from((3 * i + j) as i64));
    assert_eq!(BasisChange::new(singular.unwrap()).unwrap_err(), Error::SingularBasis);
    let wrong = Tensor::<Rational>::from_fn(3, [Down, Down], |_| Rational::from(1)).unwrap();
    assert!(matches!(BasisChange::new(wrong), Err(Error::Shape { .. })));
}

/// Connections of different frames cannot be combined.
#[test]
fn dimensions_must_agree() {
    let algebra = |n| crate::common::algebras::by_table(n, &[]);
    let metric = Metric::new(
        crate::common::labels(2),
        Tensor::from_fn(2, [Down, Down], |[i, j]| Rational::from((i == j) as i64)).unwrap(),
    );
    let metric = metric.unwrap();
    let refused = Connection::levi_civita(algebra(3).left_frame(), &metric);
    assert!(matches!(refused, Err(Error::Shape { .. })));
    let flat = Connection::cartan_schouten(&algebra(3), &Rational::from(1));
    assert!(matches!(flat.nonmetricity(&metric), Err(Error::Shape { .. })));
    assert!(matches!(flat.scalar_curvature(&metric), Err(Error::Shape { .. })));
    assert!(matches!(flat.transport_generator(&[Rational::from(1)]), Err(Error::Shape { .. })));
}
