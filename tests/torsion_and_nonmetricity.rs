//! Connections with given torsion and nonmetricity: Levi-Civita, contorsion and disformation.

use crate::common::algebras::seeds;
use crate::common::charts::{Moved, affine, constant, heisenberg, special_linear};
use crate::common::{Space, fraction, integer, property::properties, spaces, tensors};
use affinor::geometry::metric_affine::{contorsion, disformation};
use affinor::{Connection, Error, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};
use proptest::prelude::*;

type Exact = Tensor<Rational>;

/// A space with a torsion `^i_jk` and a nonmetricity `_kij`.
fn with_both(most: usize) -> impl Strategy<Value = (Space, Exact, Exact)> {
    spaces(most).prop_flat_map(|space| {
        let n = space.dimension();
        let torsion = tensors(n, [Up, Down, Down]);
        let torsion = torsion.prop_map(|t| t.antisymmetrise(&[1, 2]).unwrap());
        let nonmetricity = tensors(n, [Down, Down, Down]);
        let nonmetricity = nonmetricity.prop_map(|q| q.symmetrise(&[1, 2]).unwrap());
        (Just(space), torsion, nonmetricity)
    })
}

fn sum(a: &Exact, b: &Exact) -> Exact {
    contract("a^i_jk + b^i_jk -> ^i_jk", &[("a", a), ("b", b)]).unwrap()
}

properties! {
    #![cases(48)]

    #[test]
    fn it_has_them((space, torsion, nonmetricity) in with_both(5)) {
        let (frame, g) = (space.algebra.left_frame(), &space.metric);
        let both =
            Connection::with_torsion_and_nonmetricity(frame, g, &torsion, &nonmetricity).unwrap();
        prop_assert_eq!(both.torsion(), torsion.clone());
        prop_assert_eq!(both.nonmetricity(g).unwrap(), nonmetricity.clone());
        let metric = Connection::with_torsion(frame, g, &torsion).unwrap();
        prop_assert_eq!(metric.torsion(), torsion.clone());
        prop_assert!(metric.nonmetricity(g).unwrap().is_empty());
        // and the pieces alone
        let zero = Tensor::zero(space.dimension(), &[Up, Down, Down])?;
        let levi_civita = Connection::with_torsion(frame, g, &zero).unwrap();
        let koszul = space.levi_civita();
        prop_assert_eq!(levi_civita.affinities(), koszul.affinities());
        let k = contorsion(g, &torsion).unwrap();
        prop_assert_eq!(metric.affinities(), &sum(levi_civita.affinities(), &k));
        let l = disformation(g, &nonmetricity).unwrap();
        prop_assert_eq!(both.affinities(), &sum(metric.affinities(), &l));
    }

    /// Every connection is the sum of the three, so nothing else can have the same two tensors.
    #[test]
    fn the_pieces_add_up(space in spaces(5)) {
        for connection in space.connections() {
            let k = connection.contorsion(&space.metric).unwrap();
            let l = connection.disformation(&space.metric).unwrap();
            let total = sum(&sum(space.levi_civita().affinities(), &k), &l);
            prop_assert_eq!(connection.affinities(), &total);
            let again = Connection::with_torsion_and_nonmetricity(
                connection.frame(),
                &space.metric,
                &connection.torsion(),
                &connection.nonmetricity(&space.metric).unwrap(),
            )
            .unwrap();
            prop_assert_eq!(again.affinities(), connection.affinities());
        }
    }

    /// The closed forms of J. Beltrán Jiménez, L. Heisenberg and T. Koivisto, *Universe* 5 (2019)
    /// 173, by plain sums.
    #[test]
    fn closed_forms((space, torsion, q) in with_both(4)) {
        let n = space.dimension();
        let g = space.metric.components();
        let k = contorsion(&space.metric, &torsion).unwrap().lower(0, g)?;
        let l = disformation(&space.metric, &q).unwrap().lower(0, g)?;
        let t = torsion.lower(0, g)?;
        let half = fraction(1, 2);
        for [i, j, m] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
            let value = t.get(&[i, j, m]) + &t.get(&[j, i, m]) + &t.get(&[m, i, j]);
            prop_assert_eq!(k.get(&[i, j, m]), value * &half);
            prop_assert_eq!(k.get(&[i, j, m]), -k.get(&[m, j, i]));
            let value = q.get(&[i, j, m]) - &q.get(&[j, i, m]) - &q.get(&[m, i, j]);
            prop_assert_eq!(l.get(&[i, j, m]), value * &half);
            prop_assert_eq!(l.get(&[i, j, m]), l.get(&[i, m, j]));
        }
    }

    /// Weyl: `nabla g = -2 w g` without torsion adds `w_j delta^i_k + w_k delta^i_j - w^i g_jk`.
    #[test]
    fn weyl((space, w) in spaces(5).prop_flat_map(|space| {
        let n = space.dimension();
        (Just(space), tensors(n, [Down]))
    })) {
        let (n, metric) = (space.dimension(), &space.metric);
        let g = metric.components();
        let q = contract("-2 w_k g_ij -> _kij", &[("w", &w), ("g", g)])?;
        let delta = Tensor::identity(n);
        let raised = w.raise(0, metric.inverse())?;
        let operands = [("w", &w), ("d", &delta), ("v", &raised), ("g", g)];
        let weyl = contract("w_j d^i_k + w_k d^i_j - v^i g_jk -> ^i_jk", &operands)?;
        prop_assert_eq!(disformation(metric, &q).unwrap(), weyl);
    }

    #[test]
    fn what_is_no_torsion_is_refused((space, t) in spaces(4).prop_flat_map(|space| {
        let n = space.dimension();
        (Just(space), tensors(n, [Up, Down, Down]))
    })) {
        let symmetric = t.symmetrise(&[1, 2])?;
        match contorsion(&space.metric, &t) {
            Ok(_) => prop_assert!(symmetric.is_empty()),
            Err(Error::Symmetry { at, residual, .. }) => {
                let at: Vec<_> = at.iter().map(|index| index - 1).collect();
                prop_assert_eq!(residual, (symmetric.get(&at) * &integer(2)).to_string());
            }
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        }
        let q = t.lower(0, space.metric.components())?;
        let skew = q.antisymmetrise(&[1, 2])?;
        prop_assert_eq!(disformation(&space.metric, &q).is_ok(), skew.is_empty());
    }
}

/// The canonical connections of a bi-invariant metric are metric, with the torsion
/// `(2 lambda - 1) c` (E. Cartan and J. A. Schouten, *Proc. Amsterdam* 29 (1926) 803-815).
#[test]
fn cartan_and_schouten() {
    for (name, algebra) in seeds().into_iter().take(3) {
        let metric = Metric::new(algebra.labels(), algebra.killing_form()).unwrap();
        for lambda in [integer(0), fraction(1, 3), integer(1)] {
            let factor = lambda.clone() * &integer(2) - &integer(1);
            let torsion = algebra.structure_constants().scale(&factor);
            let connection = Connection::with_torsion(algebra.left_frame(), &metric, &torsion);
            let family = Connection::cartan_schouten(&algebra, &lambda);
            assert_eq!(connection.unwrap().affinities(), family.affinities(), "{name}");
        }
    }
}

/// In coordinates and in a moving frame, derivatives of the metric included.
#[test]
fn any_frame() {
    let entry = |at: usize| constant([0, 2, -1, 0, 1][at % 5]);
    for chart in [heisenberg(), affine(), special_linear()] {
        let n = chart.dimension();
        let g = Tensor::from_fn(n, [Down, Down], |[i, j]| entry(i * j + i + j + 1)).unwrap();
        let torsion = Tensor::from_fn(n, [Up, Down, Down], |[i, j, k]| entry(i + 2 * j + 5 * k));
        let torsion = torsion.unwrap().antisymmetrise(&[1, 2]).unwrap();
        let q = Tensor::from_fn(n, [Down; 3], |[k, i, j]| entry(k * 3 + i * j + i + j)).unwrap();
        assert!(!torsion.is_empty() && !q.is_empty());
        let left = chart.algebra.left_frame();
        let metric = Metric::new(left.labels(), g.clone()).unwrap();
        let at_home = Connection::with_torsion_and_nonmetricity(left, &metric, &torsion, &q);
        let at_home = at_home.unwrap();
        let b = Symbolic::parameter(chart.names[0]);
        let scales: Vec<_> = (0..n).map(|i| b.clone() * &b + &constant(i as i64 + 1)).collect();
        for moved in [chart.coordinates(), Moved::scaled(&chart, &scales, b)] {
            let frame = moved.frame();
            let metric = Metric::new(frame.labels(), moved.tensor(&g)).unwrap();
            let (torsion, q) = (moved.tensor(&torsion), moved.tensor(&q));
            let here = Connection::with_torsion_and_nonmetricity(&frame, &metric, &torsion, &q);
            let here = here.unwrap();
            assert_eq!(here.affinities(), &moved.inhomogeneous(at_home.affinities()));
            assert_eq!(here.torsion(), torsion);
            assert_eq!(here.nonmetricity(&metric).unwrap(), q);
        }
    }
}

/// In floats, an asymmetry within the tolerance is none.
#[test]
fn floats() {
    let third = 1.0 / 3.0;
    let torsion = [([0, 0, 1], third), ([0, 1, 0], -(0.1 + 0.7 / 3.0))];
    let torsion = Tensor::from_components(2, &[Up, Down, Down], torsion).unwrap();
    let g = Tensor::from_components(2, &[Down, Down], [([0, 0], 1.0), ([1, 1], 2.0)]).unwrap();
    let metric = Metric::new(crate::common::labels(2), g).unwrap();
    assert!(contorsion(&metric, &torsion).is_ok());
    let off = torsion.filter_map(|at, v| Some(if at[1] == 0 { *v } else { v * 1.001 }));
    let refused = contorsion(&metric, &off).unwrap_err().to_string();
    assert!(refused.contains("not antisymmetric in the slots 2 and 3"), "{refused}");
    let other = Tensor::<f64>::zero(3, &[Up, Down, Down]).unwrap();
    assert!(matches!(contorsion(&metric, &other), Err(Error::Shape { .. })));
}
