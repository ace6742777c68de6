//! Properties with their constants and witnesses: symmetric spaces, Einstein metrics, solitons,
//! space forms, bi-invariant and naturally reductive metrics, Killing fields.

mod sectional;

use crate::common::algebras::by_table;
use crate::common::charts::{Chart, Moved, constant};
use crate::common::spaces::{named, rational, symbolic};
use crate::common::{Space, fraction, integer, property::properties, spaces};
use affinor::geometry::properties::{Property, Soliton};
use affinor::{CanonicalConnection, Connection, Error, Frame, Geometry, LieAlgebra, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Notation, Rational, Scalar, Symbolic, Tensor, contract};
use num_traits::Zero;
use proptest::prelude::*;

fn einstein<S: Notation + Scalar>(space: &Geometry<S>) -> Option<S> {
    space.connection().einstein_constant(space.metric().unwrap()).unwrap().holds()
}

fn symmetric<S: Notation + Scalar>(space: &Geometry<S>) -> bool {
    space.connection().locally_symmetric().holds().is_some()
}

fn curvature<S: Notation + Scalar>(space: &Geometry<S>) -> Option<S> {
    space.connection().constant_curvature(space.metric().unwrap()).unwrap().holds()
}

fn soliton<S: Notation + Scalar>(space: &Geometry<S>) -> Option<Soliton<S>> {
    space.metric().unwrap().ricci_soliton(space.algebra().unwrap()).unwrap().holds()
}

fn reductive<S: Notation + Scalar>(space: &Geometry<S>) -> Property<S, Tensor<S>> {
    space.metric().unwrap().naturally_reductive(space.algebra().unwrap()).unwrap()
}

fn metric(algebra: &LieAlgebra<Rational>, diagonal: &[i64]) -> Metric<Rational> {
    let entry = |[i, j]: [usize; 2]| integer(if i == j { diagonal[i] } else { 0 });
    let g = Tensor::from_fn(algebra.dimension(), [Down, Down], entry).unwrap();
    Metric::new(algebra.labels(), g).unwrap()
}

fn rotations() -> LieAlgebra<Rational> {
    by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)])
}

/// Bi-invariant metrics: symmetric, Einstein with `Ric = -K/4`.
#[test]
fn bi_invariant_metrics() {
    for name in ["so3", "sl2", "so4", "su3", "so(3,1)"] {
        let space = named(name, "killing");
        let metric = space.metric().unwrap();
        assert_eq!(
            metric.bi_invariant(space.algebra().unwrap()).unwrap(),
            Property::Holds(()),
            "{name}"
        );
        assert!(symmetric(&space), "{name}");
        assert_eq!(einstein(&space), Some(fraction(-1, 4)), "{name}");
        let fields = metric.killing_fields(space.algebra().unwrap()).unwrap();
        assert_eq!(fields.len(), space.algebra().unwrap().dimension(), "{name}");
        assert_eq!(soliton(&space).unwrap().constant, fraction(-1, 4), "{name}");
        assert!(soliton(&space).unwrap().derivation.is_empty(), "{name}");
        let zero = Property::Holds(
            Tensor::zero(metric.components().dimension(), &[affinor_tensors::Up, Down]).unwrap(),
        );
        assert_eq!(reductive(&space), zero, "{name}");
    }
    let space = named("so3", "diag(1,1,2)");
    let witness =
        space.metric().unwrap().bi_invariant(space.algebra().unwrap()).unwrap().witness().unwrap();
    // g([e1,e2],e3) + g(e2,[e1,e3]) = 2 - 1
    assert_eq!(witness.to_string(), "g_mj c^m_ki + g_im c^m_kj = 1 at k = 1, i = 2, j = 3");
    assert_eq!((witness.indices, witness.residual), (vec![0, 1, 2], integer(1)));
}

/// The solvable groups that are hyperbolic spaces.
#[test]
fn hyperbolic_spaces() {
    let real = rational("hyperbolic_space.toml", "");
    assert_eq!(curvature(&real), Some(integer(-1)));
    assert_eq!(einstein(&real), Some(integer(-3)));
    assert!(symmetric(&real));
    let complex = rational("complex_hyperbolic_plane.toml", "");
    assert_eq!(einstein(&complex), Some(fraction(-3, 2)));
    assert!(symmetric(&complex));
    assert_eq!(curvature(&complex), None);
    // holomorphic planes have curvature -1, totally real ones -1/4
    let metric = complex.metric().unwrap();
    let unit = |at: usize| (0..4).map(|k| integer(i64::from(k == at))).collect::<Vec<_>>();
    let sectional = |x: usize, y: usize| {
        complex.connection().sectional_curvature(metric, &unit(x), &unit(y)).unwrap().unwrap()
    };
    assert_eq!([sectional(0, 3), sectional(1, 2)], [integer(-1), integer(-1)]);
    assert_eq!([sectional(0, 1), sectional(0, 2)], [fraction(-1, 4), fraction(-1, 4)]);
    // flat: the motions of the plane
    let plane = by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)]);
    let unit = self::metric(&plane, &[1, 1, 1]);
    let flat = Connection::levi_civita(plane.left_frame(), &unit).unwrap();
    assert_eq!(flat.constant_curvature(&unit).unwrap(), Property::Holds(integer(0)));
}

/// E. Damek and F. Ricci 1992: `Ric = -(dim v/4 + dim z) g`, and not symmetric.
#[test]
fn damek_ricci_space() {
    let space = rational("damek_ricci.toml", "");
    assert_eq!(einstein(&space), Some(integer(-3)));
    let witness = space.connection().locally_symmetric().witness().unwrap();
    assert_eq!((witness.equation.as_str(), witness.letters), ("(nabla_m R)^i_jkl", "imjkl"));
    assert_eq!(space.connection().nabla_curvature().get(&witness.indices), witness.residual);
    assert!(!witness.residual.is_zero());
    // the group without a is a nilsoliton with the same constant: J. Lauret 2001
    let nil = by_table(6, &[(1, 2, 5, 1), (3, 4, 5, 1), (1, 3, 6, 1), (4, 2, 6, 1)]);
    let soliton = metric(&nil, &[1; 6]).ricci_soliton(&nil).unwrap().holds().unwrap();
    assert_eq!(soliton.constant, integer(-3));
    for (i, value) in [2, 2, 2, 2, 4, 4].into_iter().enumerate() {
        assert_eq!(soliton.derivation.get(&[i, i]), integer(value));
    }
}

/// J. Lauret, Math. Ann. 319 (2001).
#[test]
fn nilsolitons() {
    let heisenberg = soliton(&rational("heisenberg.toml", "")).unwrap();
    assert_eq!(heisenberg.constant, fraction(-3, 2));
    let diagonal = |d: &Tensor<Rational>| {
        assert!(d.components().all(|(at, _)| at[0] == at[1]));
        (0..d.dimension()).map(|i| d.get(&[i, i]).to_string()).collect::<Vec<_>>()
    };
    assert_eq!(diagonal(&heisenberg.derivation), ["1", "1", "2"]);
    let space = rational("filiform_nilsoliton.toml", "");
    let filiform = soliton(&space).unwrap();
    assert_eq!(filiform.constant, fraction(-3, 2));
    assert_eq!(diagonal(&filiform.derivation), ["1/2", "1", "3/2", "2"]);
    assert_eq!(einstein(&space), None, "no nilpotent group but the abelian one is Einstein");
    // another metric on the same group is not a nilsoliton
    let algebra = space.algebra().unwrap();
    let witness = metric(algebra, &[1, 1, 1, 2]).ricci_soliton(algebra).unwrap().witness().unwrap();
    assert_eq!(witness.letters, "ijk");
    assert!(!witness.residual.is_zero());
    // flat, though not abelian: Ric = 0
    let line = by_table(4, &[]);
    let abelian = metric(&line, &[1, -1, 2, 3]).ricci_soliton(&line).unwrap().holds().unwrap();
    assert_eq!((abelian.constant, abelian.derivation.len()), (integer(0), 0));
}

/// G. R. Jensen, J. Differential Geom. 8 (1973): over SO(n+1)/SO(n) the fibres scaled by `t` give
/// Einstein metrics for `t = 1` and `t = (n-2)/n`. By J. E. D'Atri and W. Ziller 1979 all of the
/// family is naturally reductive.
#[test]
fn second_einstein_metrics() {
    let family = symbolic("jensen_so4.toml");
    let t = Symbolic::parameter("t");
    let (ricci, one) = (family.connection().ricci(), constant(1));
    let (fibre, base) = (ricci.get(&[0, 0]) / &t, ricci.get(&[3, 3]));
    let difference = fibre - &base;
    for (at, solves) in [("1", true), ("1/3", true), ("1/2", false), ("2", false)] {
        let space = rational("jensen_so4.toml", &format!("t={at}"));
        assert_eq!(einstein(&space).is_some(), solves, "{at}");
        assert_eq!(symmetric(&space), at == "1", "{at}");
        naturally_reductive(&space);
    }
    // no other root: the difference is a multiple of (t - 1)(3t - 1)/t
    let product = (t.clone() - &one) * &(constant(3) * &t - &one) / &t;
    assert!((difference / &product).as_constant().is_some());
    assert_eq!(einstein(&family), None);
    naturally_reductive(&family);

    // so(5), whose basis of rotations (i,j) has the pairs without 1 first
    let scaled = |t: &str| named("so5", &format!("diag({t},{t},{t},{t},{t},{t},1,1,1,1)"));
    let of_so4 = |i: usize| i < 6;
    let c = scaled("1").algebra().unwrap().structure_constants().clone();
    for (at, _) in c.components() {
        let inside = at.iter().filter(|&&i| of_so4(i)).count();
        assert!(inside == 3 || inside == 1, "a symmetric pair");
    }
    for (t, solves) in [("1", true), ("1/2", true), ("2", false)] {
        let space = scaled(t);
        assert_eq!(einstein(&space).is_some(), solves, "{t}");
        naturally_reductive(&space);
    }
}

/// The conditions on `phi`, by brackets of vectors.
fn naturally_reductive<S: Notation + Scalar>(space: &Geometry<S>) {
    let (algebra, metric) = (space.algebra().unwrap(), space.metric().unwrap());
    let phi = reductive(space).holds().unwrap();
    let n = algebra.dimension();
    let unit =
        |i: usize| (0..n).map(|k| if k == i { S::one() } else { S::zero() }).collect::<Vec<_>>();
    let basis: Vec<Vec<S>> = (0..n).map(unit).collect();
    let image = |i: usize| (0..n).map(|k| phi.get(&[k, i])).collect::<Vec<_>>();
    let apply = |x: &[S]| {
        let component =
            |k: usize| (0..n).fold(S::zero(), |sum, i| sum + &(phi.get(&[k, i]) * &x[i]));
        (0..n).map(component).collect::<Vec<_>>()
    };
    let product = |x: &[S], y: &[S]| {
        let lowered = metric.lower(x).unwrap();
        lowered.iter().zip(y).fold(S::zero(), |sum, (a, b)| sum + &(a.clone() * b))
    };
    let bracket = |x: &[S], y: &[S]| algebra.bracket(x, y).unwrap();
    let add = |x: Vec<S>, y: Vec<S>| x.into_iter().zip(&y).map(|(x, y)| x + y).collect::<Vec<_>>();
    // on the complement {(x + phi x, phi x)} the bracket, along the diagonal of k, is
    // [x + phi x, y + phi y] - [phi x, phi y]
    let projected = |i: usize, j: usize| {
        let (x, y) = (add(basis[i].clone(), image(i)), add(basis[j].clone(), image(j)));
        let minus = bracket(&image(j), &image(i));
        add(bracket(&x, &y), minus)
    };
    for [i, j, k] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
        let sum = product(&projected(i, j), &basis[k]) + &product(&basis[j], &projected(i, k));
        assert!(sum.vanishes(), "{i} {j} {k}: {sum}");
    }
    let fields = metric.killing_fields(algebra).unwrap();
    for (a, x) in fields.iter().flat_map(|a| basis.iter().map(move |x| (a, x))) {
        assert_eq!(apply(&bracket(a, x)), bracket(a, &apply(x)));
    }
    // a consequence (D'Atri and Ziller): (nabla_x Ric)(x, x) = 0
    let nabla = space.connection().nabla(&space.connection().ricci()).unwrap();
    assert!(nabla.symmetrise(&[0, 1, 2]).unwrap().is_empty());
    // phi has its values in k: ad of them is skew
    for [i, j, k] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
        let image = image(i);
        let sum = product(&bracket(&image, &basis[j]), &basis[k])
            + &product(&basis[j], &bracket(&image, &basis[k]));
        assert!(sum.vanishes());
    }
}

/// On SO(3): `diag(a, a, b)` is naturally reductive, `diag(1, 2, 3)` is not.
#[test]
fn metrics_on_the_rotations() {
    let so3 = rotations();
    for (diagonal, fields, holds) in [
        ([1, 1, 1], 3, true),
        ([1, 1, 2], 1, true),
        ([3, 1, 3], 1, true),
        ([1, 1, -1], 1, true),
        ([1, 2, 3], 0, false),
    ] {
        let metric = metric(&so3, &diagonal);
        assert_eq!(metric.killing_fields(&so3).unwrap().len(), fields, "{diagonal:?}");
        let found = metric.naturally_reductive(&so3).unwrap();
        assert_eq!(found.clone().holds().is_some(), holds, "{diagonal:?}");
        if let Some(witness) = found.witness() {
            assert!(!witness.residual.is_zero());
            assert_eq!(witness.letters, "kij");
        }
    }
    naturally_reductive(&named("so3", "diag(1,1,2)"));
    // right translations by the centre are the only additional isometries here, and do not suffice
    let nil = rational("heisenberg.toml", "");
    let fields = nil.metric().unwrap().killing_fields(nil.algebra().unwrap()).unwrap();
    assert_eq!(fields, [[0, 0, 1].map(integer)]);
    assert!(reductive(&nil).witness().is_some());
}

/// `Ric = K g` on every surface, but `K` must be a constant.
#[test]
fn in_moving_frames() {
    let [x, y, one] = [Symbolic::parameter("x"), Symbolic::parameter("y"), constant(1)];
    let radius = x.clone() * &x + &(y.clone() * &y) + &one;
    let sphere = constant(4) / &(radius.clone() * &radius);
    let names = &["x", "y"];
    let coordinates = Frame::coordinates(names).unwrap();
    let flat = by_table(2, &[]).map(|v| Symbolic::constant(v.clone())).unwrap();
    let chart = Chart { names, algebra: flat, fields: Tensor::identity(2) };
    let moving = Moved::scaled(&chart, &[x.clone() + &one, one.clone()], y.clone());
    for (factor, constant_curvature) in [(sphere, true), (radius, false)] {
        let entry = |[i, j]: [usize; 2]| if i == j { factor.clone() } else { constant(0) };
        let g = Tensor::from_fn(2, [Down, Down], entry).unwrap();
        for (frame, g) in [(&coordinates, g.clone()), (&moving.frame(), moving.tensor(&g))] {
            let metric = Metric::new(frame.labels(), g).unwrap();
            let connection = Connection::levi_civita(frame, &metric).unwrap();
            let found = [
                connection.einstein_constant(&metric).unwrap(),
                connection.constant_curvature(&metric).unwrap(),
            ];
            for found in found {
                match constant_curvature {
                    true => assert_eq!(found, Property::Holds(one.clone())),
                    false => {
                        let witness = found.witness().unwrap();
                        assert!(witness.equation.starts_with("e_k("), "{witness}");
                        // of the factor itself, not of the scalar curvature alone
                        assert_ne!(witness.equation, "e_k(S)");
                        assert!(!witness.residual.is_zero());
                    }
                }
            }
            assert_eq!(connection.locally_symmetric().holds().is_some(), constant_curvature);
        }
    }
}

#[test]
fn torsion() {
    let so3 = rotations();
    let plus = Connection::cartan_schouten(&so3, &integer(1));
    assert_eq!(plus.parallel_torsion(), Property::Holds(()));
    assert_eq!(plus.parallel_curvature(), Property::Holds(()));
    let witness = plus.locally_symmetric().witness().unwrap();
    assert_eq!(witness.to_string(), "tau^i_jk = 1 at i = 1, j = 2, k = 3");
    assert_eq!(
        Connection::cartan_schouten(&so3, &fraction(1, 2)).locally_symmetric(),
        Property::Holds(())
    );
}

#[test]
fn shapes() {
    let (so3, four) = (rotations(), by_table(4, &[]));
    let wrong = metric(&four, &[1; 4]);
    let connection = Connection::cartan_schouten(&so3, &fraction(1, 2));
    let shape = |error: Error| matches!(error, Error::Shape { .. });
    assert!(shape(connection.einstein_constant(&wrong).unwrap_err()));
    assert!(shape(connection.constant_curvature(&wrong).unwrap_err()));
    assert!(shape(wrong.ricci_soliton(&so3).unwrap_err()));
    assert!(shape(wrong.bi_invariant(&so3).unwrap_err()));
    assert!(shape(wrong.killing_fields(&so3).unwrap_err()));
    assert!(shape(wrong.naturally_reductive(&so3).unwrap_err()));
    // in dimension 0 and 1 the curvature is zero
    for n in [0, 1] {
        let line = by_table(n, &[]);
        let unit = metric(&line, &vec![1; n]);
        let flat = Connection::levi_civita(line.left_frame(), &unit).unwrap();
        assert_eq!(flat.constant_curvature(&unit).unwrap(), Property::Holds(integer(0)));
        assert_eq!(flat.einstein_constant(&unit).unwrap(), Property::Holds(integer(0)));
        assert_eq!(unit.killing_fields(&line).unwrap().len(), n);
        assert!(unit.naturally_reductive(&line).unwrap().holds().is_some());
    }
}

/// Floats give the same answers as exact scalars for well-scaled values.
#[test]
fn floats() {
    let so3 = rotations().map(Rational::to_f64).unwrap();
    let unit = Tensor::from_fn(3, [Down, Down], |[i, j]| f64::from(u8::from(i == j))).unwrap();
    let metric = Metric::new(so3.labels(), unit).unwrap();
    let sphere = Connection::levi_civita(so3.left_frame(), &metric).unwrap();
    assert_eq!(sphere.constant_curvature(&metric).unwrap(), Property::Holds(0.25));
    assert_eq!(sphere.locally_symmetric(), Property::Holds(()));
    assert_eq!(sphere.holonomy().unwrap().dimension(), 3);
    assert_eq!(metric.killing_fields(&so3).unwrap().len(), 3);
}

/// The factor if `a` is a multiple of `b`, by a linear system.
fn multiple(a: &Tensor<Rational>, b: &Tensor<Rational>) -> Option<Rational> {
    let n = a.dimension();
    let places = (0..n.pow(a.rank() as u32)).map(|mut key| {
        let mut at = vec![0; a.rank()];
        for slot in at.iter_mut().rev() {
            (*slot, key) = (key % n, key / n);
        }
        at
    });
    let places: Vec<_> = places.collect();
    let column: Vec<_> = places.iter().map(|at| vec![b.get(at)]).collect();
    let right: Vec<_> = places.iter().map(|at| a.get(at)).collect();
    let solution = Matrix::from_dense(&column).unwrap().solve(&right).unwrap();
    solution.map(|x| x[0].clone())
}

/// The fields `x` for which `nabla x`, lowered, is antisymmetric.
fn killing_by_nabla(space: &Space) -> usize {
    let n = space.dimension();
    let levi_civita = space.levi_civita();
    let rows = (0..n).map(|k| {
        let x: Vec<_> = (0..n).map(|i| integer(i64::from(i == k))).collect();
        let lowered = Tensor::vector(&space.metric.lower(&x).unwrap(), Down);
        let nabla = levi_civita.nabla(&lowered).unwrap();
        let sum = contract("D_ij + D_ji -> _ij", &[("D", &nabla)]).unwrap();
        (0..n * n).map(|at| sum.get(&[at / n, at % n])).collect::<Vec<_>>()
    });
    let rows: Vec<_> = rows.collect();
    n - Matrix::from_dense(&rows).unwrap().rank().unwrap()
}

properties! {
    #![cases(32)]

    /// On random metrics the answers agree with a linear system, and witnesses are right.
    #[test]
    fn answers(space in spaces(4)) {
        let (connection, metric) = (space.levi_civita(), &space.metric);
        let ricci = connection.ricci();
        let found = connection.einstein_constant(metric)?;
        prop_assert_eq!(found.clone().holds(), multiple(&ricci, metric.components()));
        if let Some(witness) = found.witness() {
            prop_assert!(!witness.residual.is_zero());
        }
        let c = space.algebra.structure_constants();
        let mixed = ricci.raise(0, metric.inverse())?;
        match metric.ricci_soliton(&space.algebra)? {
            Property::Holds(Soliton { constant, derivation }) => {
                let one = Tensor::identity(space.dimension()).scale(&constant);
                let sum = contract("D^i_j + s^i_j -> ^i_j", &[("D", &derivation), ("s", &one)])?;
                prop_assert_eq!(sum, mixed);
                // D [x,y] = [Dx,y] + [x,Dy]
                let n = space.dimension();
                let at = |i: usize| (0..n).map(|k| integer(i64::from(k == i))).collect::<Vec<_>>();
                let d = |x: &[Rational]| (0..n).map(|i| (0..n).fold(integer(0), |sum, j| {
                    sum + &(derivation.get(&[i, j]) * &x[j])
                })).collect::<Vec<_>>();
                for (x, y) in (0..n * n).map(|key| (at(key / n), at(key % n))) {
                    let bracket = |x: &[Rational], y: &[Rational]| {
                        space.algebra.bracket(x, y).unwrap()
                    };
                    let (left, right) = (bracket(&d(&x), &y), bracket(&x, &d(&y)));
                    let sum: Vec<_> = left.into_iter().zip(&right).map(|(a, b)| a + b).collect();
                    prop_assert_eq!(d(&bracket(&x, &y)), sum);
                }
            }
            Property::Fails(_) => {
                let defect = contract(
                    "r^i_m c^m_jk - c^i_mk r^m_j - c^i_jm r^m_k -> ^i_jk",
                    &[("r", &mixed), ("c", c)],
                )?;
                prop_assert_eq!(multiple(&defect, c), None);
            }
        }
        let fields = metric.killing_fields(&space.algebra)?;
        prop_assert_eq!(fields.len(), killing_by_nabla(&space));
        let held = connection.locally_symmetric().holds().is_some();
        prop_assert_eq!(held, connection.nabla_curvature().is_empty());
        if let Property::Holds(k) = connection.constant_curvature(metric)? {
            let n = space.dimension() as i64;
            let constant = connection.einstein_constant(metric)?;
            prop_assert_eq!(constant, Property::Holds(k * &integer(n - 1)));
        }
        let bi_invariant = metric.bi_invariant(&space.algebra)?.holds().is_some();
        prop_assert_eq!(bi_invariant, fields.len() == space.dimension());
    }
}

/// Of `plus`, `Lambda = c`: `(nabla_1 g)_23 = -c^3_12 g_33 - c^2_13 g_22 = -3 + 2`.
#[test]
fn a_metric_that_is_not_parallel() {
    let space = named("so3", "diag(1,2,3)");
    let plus = Connection::canonical(space.algebra().unwrap(), CanonicalConnection::Plus);
    let witness = plus.metric_compatible(space.metric().unwrap()).unwrap().witness().unwrap();
    assert_eq!(witness.to_string(), "(nabla_k g)_ij = -1 at k = 1, i = 2, j = 3");
    let levi_civita = space.connection().metric_compatible(space.metric().unwrap()).unwrap();
    assert_eq!(levi_civita, Property::Holds(()));
}
