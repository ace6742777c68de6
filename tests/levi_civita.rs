//! The Levi-Civita connection of any left-invariant metric: what defines it, and its curvature.

use crate::common::algebras::{by_table, seeds};
use crate::common::{fraction, integer, property::properties, spaces, stored, tensors};
use affinor::{Connection, Metric};
use affinor_tensors::{Down, Rational, Tensor, Up, contract};
use num_traits::{One, Zero};
use proptest::prelude::*;

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

    /// Whatever is added brings torsion or nonmetricity.
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
        // a part that keeps the metric: antisymmetric in its first two slots, when lowered
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

    /// The sectional curvature is that of the plane, and comes from the curvature tensor.
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
fn closed_forms() {
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
