//! The family `Lambda = lambda c`: its torsion, curvature and transport in closed form.

use crate::common::{
    Space, algebras::seeds, fraction, integer, property::properties, spaces, tensors,
};
use affinor::{CanonicalConnection, Connection, Error, Law};
use affinor_tensors::{Rational, Tensor, Up, contract};
use num_traits::Zero;
use proptest::prelude::*;

fn vectors(count: usize) -> impl Strategy<Value = (Space, Vec<Vec<Rational>>)> {
    spaces(6).prop_flat_map(move |space| {
        let n = space.dimension();
        let vector = tensors(n, [Up]).prop_map(|v| v.to_vector().unwrap());
        (Just(space), proptest::collection::vec(vector, count))
    })
}

/// `factor [[e_k, e_l], e_j]^i`, by two brackets.
fn double_brackets(space: &Space, factor: &Rational) -> Tensor<Rational> {
    let n = space.dimension();
    let unit = |k: usize| (0..n).map(|i| integer((i == k) as i64)).collect::<Vec<_>>();
    let bracket = |x: &[Rational], y: &[Rational]| space.algebra.bracket(x, y).unwrap();
    let mut components = vec![];
    for [j, k, l] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
        let value = bracket(&bracket(&unit(k), &unit(l)), &unit(j));
        let value = value.into_iter().map(|v| v * factor);
        components.extend(value.enumerate().map(|(i, v)| ([i, j, k, l], v)));
    }
    let slots = space.family().curvature().slots().to_vec();
    Tensor::from_components(n, &slots, components).unwrap()
}

properties! {
    #![cases(40)]

    #[test]
    fn torsion_and_curvature(space in spaces(5)) {
        let family = space.family();
        let c = space.algebra.structure_constants();
        let lambda = &space.lambda;
        prop_assert_eq!(family.affinities(), &c.scale(lambda));
        let twice = lambda.clone() + lambda - &integer(1);
        prop_assert_eq!(family.torsion(), c.scale(&twice));
        let factor = lambda.clone() * lambda - lambda;
        prop_assert_eq!(family.curvature(), &double_brackets(&space, &factor));
        // Ric = (lambda^2 - lambda) K, and the Killing form is parallel for every lambda
        let killing = space.algebra.killing_form();
        prop_assert_eq!(family.ricci(), killing.scale(&factor));
        prop_assert!(family.nabla(&killing)?.is_empty());
        // for a bi-invariant metric torsion and curvature are parallel too
        prop_assert!(family.nabla(&family.torsion())?.is_empty());
        prop_assert!(family.nabla(family.curvature())?.is_empty());
    }

    #[test]
    fn the_three_canonical_connections(space in spaces(6)) {
        let c = space.algebra.structure_constants();
        let [plus, zero, minus] = [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
            .map(|which| Connection::canonical(&space.algebra, which));
        prop_assert_eq!(plus.affinities(), c);
        prop_assert_eq!(zero.affinities(), &c.scale(&fraction(1, 2)));
        prop_assert!(minus.affinities().is_empty());
        prop_assert_eq!(&plus.torsion(), c);
        prop_assert!(zero.torsion().is_empty());
        prop_assert_eq!(minus.torsion(), c.scale(&integer(-1)));
        prop_assert!(plus.curvature().is_empty());
        prop_assert!(minus.curvature().is_empty());
        prop_assert_eq!(zero.curvature(), &double_brackets(&space, &fraction(-1, 4)));
        // (40): antisymmetric in the left-invariant frame
        if !c.is_empty() {
            prop_assert_eq!(zero.affinities().pair_symmetry(1, 2), Some(-1));
        }
    }

    #[test]
    fn the_killing_form_is_symmetric_and_invariant((space, xyz) in vectors(3)) {
        let killing = space.algebra.killing_form();
        let ad = |x: &[Rational]| space.algebra.ad(x).unwrap();
        let form = |x: &[Rational], y: &[Rational]| {
            let trace = contract("a^i_j b^j_i ->", &[("a", &ad(x)), ("b", &ad(y))]);
            trace.unwrap().to_scalar().unwrap()
        };
        let bracket = |x: &[Rational], y: &[Rational]| space.algebra.bracket(x, y).unwrap();
        let [x, y, z] = [0, 1, 2].map(|at| xyz[at].as_slice());
        let [u, v] = [x, y].map(|v| Tensor::vector(v, Up));
        let ku = contract("K_ij u^i -> _j", &[("K", &killing), ("u", &u)])?;
        let kuv = contract("k_j v^j ->", &[("k", &ku), ("v", &v)])?.to_scalar().unwrap();
        prop_assert_eq!(kuv, form(x, y));
        prop_assert_eq!(form(x, y), form(y, x));
        prop_assert_eq!(form(&bracket(x, y), z), form(x, &bracket(y, z)));
    }

    /// Transport in left-invariant components is `exp(-s ad_n)`, `exp(-s ad_n/2)`, and the
    /// identity.
    #[test]
    fn transport_along_autoparallels((space, n) in vectors(1)) {
        let n = &n[0];
        let ad = space.algebra.ad(n).unwrap();
        for (which, factor) in [
            (CanonicalConnection::Plus, integer(-1)),
            (CanonicalConnection::Zero, fraction(-1, 2)),
            (CanonicalConnection::Minus, integer(0)),
        ] {
            let connection = Connection::canonical(&space.algebra, which);
            prop_assert_eq!(connection.transport_generator(n).unwrap(), ad.scale(&factor));
        }
        prop_assert_eq!(
            space.family().transport_generator(n).unwrap(),
            ad.scale(&-space.lambda.clone())
        );
        // for other connections only along vectors with nabla_n n = 0
        let other = space.connection();
        let at = |i: usize, k: usize| {
            let terms = (0..n.len()).map(|j| other.affinities().get(&[i, j, k]) * &n[j]);
            terms.fold(integer(0), |sum, term| sum - &term)
        };
        let size = n.len();
        let drift = (0..size).map(|i| {
            let terms = (0..size).map(|k| at(i, k) * &n[k]);
            terms.fold(integer(0), |sum, term| sum - &term)
        });
        let drifts = drift.into_iter().any(|value| !value.is_zero());
        match other.transport_generator(n) {
            Ok(generator) => {
                prop_assert!(!drifts);
                for (i, k) in (0..size).flat_map(|i| (0..size).map(move |k| (i, k))) {
                    prop_assert_eq!(generator.get(&[i, k]), at(i, k));
                }
            }
            Err(error) => {
                prop_assert!(drifts);
                let named = matches!(error, Error::Broken { law: Law::ConstantTangent, .. });
                prop_assert!(named, "{}", error);
            }
        }
    }
}

/// The seeds have the properties of their names, so that the laws are tested on algebras that are
/// not semisimple too.
#[test]
fn the_seeds_are_of_every_kind() {
    let semisimple = |name: &str| ["so(3)", "sl(2)", "so(2,1)"].contains(&name);
    let unimodular = |name: &str| !name.contains("aff") && name != "bianchi(IV)";
    for (name, algebra) in seeds() {
        let killing = affinor::Metric::new(algebra.labels(), algebra.killing_form());
        assert_eq!(killing.is_ok(), semisimple(name), "{name}");
        let traces = contract("c^i_ji -> _j", &[("c", algebra.structure_constants())]).unwrap();
        assert_eq!(traces.is_empty(), unimodular(name), "{name}");
        let flat =
            Connection::canonical(&algebra, CanonicalConnection::Zero).curvature().is_empty();
        let two_step = name.starts_with("heisenberg");
        assert_eq!(flat, two_step, "{name}");
    }
}

/// The paper's table after (65) and the canonical so(3), component by component.
#[test]
fn the_rotation_group() {
    let (_, so3) = seeds().remove(0);
    let zero = Connection::canonical(&so3, CanonicalConnection::Zero);
    let delta = |a, b| integer((a == b) as i64);
    let quarter = fraction(1, 4);
    for [i, j, k, l] in (0..81).map(|key| [key / 27, key / 9 % 3, key / 3 % 3, key % 3]) {
        let closed = (delta(i, k) * &delta(j, l) - &(delta(i, l) * &delta(j, k))) * &quarter;
        assert_eq!(zero.curvature().get(&[i, j, k, l]), closed);
    }
    assert_eq!(zero.curvature().get(&[0, 1, 0, 1]), quarter);
}
