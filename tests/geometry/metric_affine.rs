//! Connections with given torsion and nonmetricity: contorsion and disformation. The Levi-Civita
//! connection by its defining properties, and its curvature.

use crate::common::algebras::{by_table, seeds};
use crate::common::charts::{Moved, affine, constant, heisenberg, special_linear};
use crate::common::{Space, fraction, integer, property::properties, spaces, stored, tensors};
use affinor::geometry::metric_affine::{contorsion, disformation};
use affinor::{Connection, Error, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};
use num_traits::{One, Zero};
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
        // and with each of the two alone
        let zero = Tensor::zero(space.dimension(), &[Up, Down, Down])?;
        let levi_civita = Connection::with_torsion(frame, g, &zero).unwrap();
        let koszul = space.levi_civita();
        prop_assert_eq!(levi_civita.affinities(), koszul.affinities());
        let k = contorsion(g, &torsion).unwrap();
        prop_assert_eq!(metric.affinities(), &sum(levi_civita.affinities(), &k));
        let l = disformation(g, &nonmetricity).unwrap();
        prop_assert_eq!(both.affinities(), &sum(metric.affinities(), &l));
    }

    /// Every connection is the sum of the three parts, so torsion and nonmetricity determine it.
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

/// In floats, an asymmetry within the tolerance counts as zero.
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

properties! {
    #![cases(64)]

    #[test]
    fn without_torsion_and_compatible(space in spaces(6)) {
        let levi_civita = space.levi_civita();
        prop_assert!(levi_civita.torsion().is_empty());
        prop_assert!(levi_civita.nonmetricity(&space.metric)?.is_empty());
        prop_assert!(levi_civita.nabla(space.metric.inverse())?.is_empty());
    }

    /// Koszul's formula, from the bracket and the metric as bilinear maps.
    #[test]
    fn koszul(space in spaces(4)) {
        let n = space.dimension();
        let (g, c) = (space.metric.components(), space.algebra.structure_constants());
        let lowered = contract("g_im L^m_jk -> _ijk", &[("g", g), ("L", space.levi_civita().affinities())])?;
        let product = |j: usize, k: usize, i: usize| {
            (0..n).fold(integer(0), |sum, m| sum + &(c.get(&[m, j, k]) * &g.get(&[m, i])))
        };
        for [i, j, k] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
            let koszul = product(j, k, i) - &product(k, i, j) + &product(i, j, k);
            prop_assert_eq!(lowered.get(&[i, j, k]) * &integer(2), koszul);
        }
    }

    /// Every change of the Levi-Civita connection adds torsion or nonmetricity.
    #[test]
    fn the_only_one(
        (space, added) in spaces(4).prop_flat_map(|space| {
            let n = space.dimension();
            (Just(space), tensors(n, [Up, Down, Down]))
        })
    ) {
        let levi_civita = space.levi_civita();
        let plus = |part: &Tensor<Rational>| {
            let gamma = contract("L^i_jk + s^i_jk -> ^i_jk", &[("L", levi_civita.affinities()), ("s", part)]);
            Connection::new(space.algebra.left_frame().clone(), gamma.unwrap()).unwrap()
        };
        let symmetric = added.symmetrise(&[1, 2])?;
        if !symmetric.is_empty() {
            prop_assert!(plus(&symmetric).torsion().is_empty());
            prop_assert!(!plus(&symmetric).nonmetricity(&space.metric)?.is_empty());
        }
        // a part that preserves the metric: antisymmetric in its first two slots, when lowered
        let lowered = added.lower(0, space.metric.components())?.antisymmetrise(&[0, 2])?;
        let skew = lowered.raise(0, space.metric.inverse())?;
        if !skew.is_empty() {
            prop_assert!(plus(&skew).nonmetricity(&space.metric)?.is_empty());
            prop_assert!(!plus(&skew).torsion().is_empty());
        }
    }

    #[test]
    fn symmetries_of_the_curvature(space in spaces(5)) {
        let levi_civita = space.levi_civita();
        let r = levi_civita.curvature().lower(0, space.metric.components())?;
        for (at, value) in stored(&r) {
            let [i, j, k, l] = [at[0], at[1], at[2], at[3]];
            prop_assert_eq!(&r.get(&[k, l, i, j]), &value);
            prop_assert_eq!(r.get(&[j, i, k, l]), -value);
        }
        let cyclic = contract("R_ijkl + R_iklj + R_iljk -> _ijkl", &[("R", &r)])?;
        prop_assert!(cyclic.is_empty());
        let ricci = levi_civita.ricci();
        prop_assert_eq!(ricci.permute(&[1, 0])?, ricci.clone());
        let scalar = contract("h^jl r_jl ->", &[("h", space.metric.inverse()), ("r", &ricci)])?;
        let computed = levi_civita.scalar_curvature(&space.metric).unwrap();
        prop_assert_eq!(Some(computed), scalar.to_scalar());
    }

    /// The contracted second identity: `nabla_l Ric^l_j = 1/2 nabla_j S`, and S is constant.
    #[test]
    fn the_einstein_tensor_has_no_divergence(space in spaces(5)) {
        let levi_civita = space.levi_civita();
        let mixed = levi_civita.ricci().raise(0, space.metric.inverse())?;
        let nabla = levi_civita.nabla(&mixed)?;
        prop_assert!(nabla.trace(0, 1)?.is_empty());
    }

    /// The sectional curvature depends on the plane only, and agrees with the curvature tensor.
    #[test]
    fn sectional_curvature(
        (space, v) in spaces(4).prop_flat_map(|space| {
            let n = space.dimension();
            (Just(space), tensors(n, [Up, Up]))
        })
    ) {
        let n = space.dimension();
        let row = |k: usize| (0..n).map(|i| v.get(&[k, i])).collect::<Vec<_>>();
        let [x, y] = [row(0), row(1)];
        let levi_civita = space.levi_civita();
        let r = levi_civita.curvature().lower(0, space.metric.components())?;
        let g = |x: &[Rational], y: &[Rational]| {
            stored(space.metric.components()).into_iter().fold(integer(0), |sum, (at, value)| {
                sum + &(value * &x[at[0]] * &y[at[1]])
            })
        };
        let area = g(&x, &x) * &g(&y, &y) - &(g(&x, &y) * &g(&x, &y));
        let numerator = stored(&r).into_iter().fold(integer(0), |sum, (at, value)| {
            sum + &(value * &x[at[0]] * &y[at[1]] * &x[at[2]] * &y[at[3]])
        });
        let sectional = levi_civita.sectional_curvature(&space.metric, &x, &y).unwrap();
        prop_assert_eq!(sectional.clone(), (!area.is_zero()).then(|| numerator / &area));
        // another basis of the same plane
        let z: Vec<_> = x.iter().zip(&y).map(|(x, y)| x.clone() + &(y.clone() * &integer(3))).collect();
        prop_assert_eq!(levi_civita.sectional_curvature(&space.metric, &z, &y).unwrap(), sectional);
    }
}

/// The Killing metric of a semisimple algebra: `zero`, and Einstein with `Ric = -K/4`.
#[test]
fn bi_invariant_metrics() {
    for (name, algebra) in seeds().into_iter().take(3) {
        let killing = algebra.killing_form();
        let metric = Metric::new(algebra.labels(), killing.clone()).unwrap();
        let levi_civita = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        assert_eq!(
            levi_civita.affinities(),
            &algebra.structure_constants().scale(&fraction(1, 2)),
            "{name}"
        );
        assert_eq!(levi_civita.ricci(), killing.scale(&fraction(-1, 4)), "{name}");
        assert_eq!(levi_civita.scalar_curvature(&metric).unwrap(), fraction(-3, 4), "{name}");
    }
}

/// J. Milnor, Adv. Math. 21 (1976) 293-329: Ricci of `diag(J)` on so(3), and the hyperbolic spaces.
#[test]
fn levi_civita_of_closed_forms() {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let [a, b, c] = [integer(2), integer(3), fraction(7, 2)];
    let moments = [a.clone(), b.clone(), c.clone()];
    let g = Tensor::from_fn(3, [Down, Down], |[i, j]| match i == j {
        true => moments[i].clone(),
        false => Rational::zero(),
    });
    let metric = Metric::new(so3.labels(), g.unwrap()).unwrap();
    let ricci = Connection::levi_civita(so3.left_frame(), &metric).unwrap().ricci();
    // 4 J1 J2 J3 mu_j mu_k = (S - 2 J_j) (S - 2 J_k), S = J1 + J2 + J3
    let sum = a.clone() + &b + &c;
    let mu = |i: usize| sum.clone() - &(moments[i].clone() * &integer(2));
    for (i, moment) in moments.iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let expected = mu(j) * &mu(k) * moment / &(a.clone() * &b * &c * &integer(2));
        assert_eq!(ricci.get(&[i, i]), expected);
    }
    assert_eq!(ricci.len(), 3);
    // [e_n, e_j] = e_j with the unit metric is hyperbolic space: K = -1
    for n in 2..=5 {
        let table: Vec<_> = (1..n).map(|j| (n, j, j, 1)).collect();
        let algebra = by_table(n, &table);
        let unit = Tensor::from_fn(n, [Down, Down], |[i, j]| integer((i == j) as i64)).unwrap();
        let metric = Metric::new(algebra.labels(), unit.clone()).unwrap();
        let hyperbolic = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        let delta = [("d", &Tensor::identity(n)), ("g", &unit)];
        let constant = contract("d^i_l g_jk - d^i_k g_jl -> ^i_jkl", &delta).unwrap();
        assert_eq!(*hyperbolic.curvature(), constant);
        assert_eq!(hyperbolic.ricci(), unit.scale(&integer(1 - n as i64)));
        let (x, mut y) = (vec![Rational::one(); n], vec![Rational::zero(); n]);
        y[0] = integer(3);
        let sectional = hyperbolic.sectional_curvature(&metric, &x, &y).unwrap();
        assert_eq!(sectional, Some(integer(-1)));
    }
}
