//! The holonomy algebra of left-invariant connections.

use crate::common::algebras::{by_table, seeds};
use crate::common::charts::{constant, heisenberg};
use crate::common::spaces::{named, rational, symbolic};
use crate::common::{fraction, integer, invertible, property::properties, spaces};
use affinor::{BasisChange, CanonicalConnection, Connection, LieAlgebra, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Rational, Tensor, contract};
use proptest::prelude::*;

fn rank(connection: &Connection<Rational>) -> usize {
    connection.holonomy().unwrap().dimension()
}

fn diagonal(algebra: &LieAlgebra<Rational>, values: &[i64]) -> Connection<Rational> {
    let n = algebra.dimension();
    let entry = |[i, j]: [usize; 2]| integer(if i == j { values[i] } else { 0 });
    let g = Tensor::from_fn(n, [Down, Down], entry).unwrap();
    let metric = Metric::new(algebra.labels(), g).unwrap();
    Connection::levi_civita(algebra.left_frame(), &metric).unwrap()
}

/// `R = lambda (lambda - 1) ad [.,.]`: the span of `ad` of the derived algebra.
#[test]
fn canonical_connections() {
    for (name, algebra) in seeds() {
        for flat in [CanonicalConnection::Plus, CanonicalConnection::Minus] {
            assert_eq!(rank(&Connection::canonical(&algebra, flat)), 0, "{name}");
        }
        let n = algebra.dimension();
        let unit = |i: usize| (0..n).map(|k| integer(i64::from(k == i))).collect::<Vec<_>>();
        let brackets = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k)));
        let rows = brackets.map(|(j, k)| {
            let ad = algebra.ad(&algebra.bracket(&unit(j), &unit(k)).unwrap()).unwrap();
            (0..n * n).map(|at| ad.get(&[at / n, at % n])).collect::<Vec<_>>()
        });
        let expected = Matrix::from_dense(&rows.collect::<Vec<_>>()).unwrap().rank().unwrap();
        for lambda in [fraction(1, 2), fraction(1, 3), integer(-2)] {
            assert_eq!(rank(&Connection::cartan_schouten(&algebra, &lambda)), expected, "{name}");
        }
    }
    for (n, name) in [(3, "so3"), (6, "so4"), (10, "so5")] {
        let zero = named(name, "killing");
        assert_eq!(
            rank(&Connection::canonical(zero.algebra().unwrap(), CanonicalConnection::Zero)),
            n
        );
        // the Levi-Civita connection of a bi-invariant metric is `zero`
        assert_eq!(rank(zero.connection()), n);
    }
}

#[test]
fn metrics_on_small_groups() {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let nil = by_table(3, &[(1, 2, 3, 1)]);
    let motions = by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)]);
    assert_eq!(rank(&diagonal(&so3, &[1, 2, 5])), 3);
    assert_eq!(rank(&diagonal(&nil, &[1, 1, 1])), 3);
    assert_eq!(rank(&diagonal(&motions, &[1, 1, 1])), 0, "flat");
    assert_eq!(rank(&diagonal(&motions, &[1, 1, 2])), 3);
    // a product: the sum of the algebras, in blocks
    let sum = so3.direct_sum(&nil).unwrap().direct_sum(&motions).unwrap();
    let product = diagonal(&sum, &[1, 2, 5, 1, 1, 1, 1, 1, 1]).holonomy().unwrap();
    assert_eq!(product.dimension(), 6);
    for matrix in product.basis().unwrap() {
        assert!(product.contains(&matrix));
        assert!(matrix.components().all(|(at, _)| at[0] / 3 == at[1] / 3 && at[0] < 6));
    }
    assert!(!product.contains(&Tensor::identity(9)));
    assert!(!product.contains(&Tensor::zero(3, &[affinor_tensors::Up, Down]).unwrap()));
}

/// M. Berger's list: SO(n) unless the space is symmetric, a product, or special; U(2) for the
/// complex hyperbolic plane.
#[test]
fn known_spaces() {
    assert_eq!(rank(rational("hyperbolic_space.toml", "").connection()), 6);
    assert_eq!(rank(rational("complex_hyperbolic_plane.toml", "").connection()), 4);
    assert_eq!(rank(rational("damek_ricci.toml", "").connection()), 21);
    assert_eq!(rank(named("su3", "killing").connection()), 8);
    assert_eq!(rank(rational("jensen_so4.toml", "t=1").connection()), 6);
    assert_eq!(rank(rational("jensen_so4.toml", "t=1/3").connection()), 15);
    // generic parameters
    let generic = symbolic("milnor_unimodular.toml");
    assert_eq!(generic.connection().holonomy().unwrap().dimension(), 3);
}

#[test]
fn only_invariant_frames() {
    let chart = heisenberg();
    let moved = chart.coordinates();
    let frame = affinor::Frame::coordinates(chart.names).unwrap();
    let plus = Connection::cartan_schouten(&chart.algebra, &constant(1));
    let here = Connection::new(frame, moved.inhomogeneous(plus.affinities())).unwrap();
    assert!(matches!(here.holonomy(), Err(affinor::Error::Unsupported(_))));
}

/// The span of all `(nabla .. nabla R)(e_k, e_l)` with up to `order` derivatives, by its rank.
fn span_of_derivatives(connection: &Connection<Rational>, order: usize) -> usize {
    let n = connection.frame().dimension();
    let mut rows = vec![];
    let mut tensor = connection.curvature().clone();
    for step in 0..=order {
        // slots ^i_{m..}jkl: the matrix is (i, j), the other indices enumerate the rows
        let j = 1 + step;
        let mut matrices = std::collections::BTreeMap::<_, Vec<_>>::new();
        for (at, value) in tensor.components() {
            let mut key = at.to_vec();
            let entry = key[0] * n + key[j];
            (key[0], key[j]) = (0, 0);
            matrices.entry(key).or_default().push((entry, value.clone()));
        }
        rows.extend(matrices.into_values());
        if step < order {
            tensor = connection.nabla(&tensor).unwrap();
        }
    }
    Matrix::from_rows(n * n, rows).unwrap().rank().unwrap()
}

properties! {
    #![cases(24)]

    /// The algebra is closed under the commutator and under every `Lambda_m`, and within so(g) for
    /// Levi-Civita.
    #[test]
    fn a_subalgebra(space in spaces(4)) {
        for connection in space.connections() {
            let holonomy = connection.holonomy().unwrap();
            let basis = holonomy.basis().unwrap();
            prop_assert_eq!(basis.len(), holonomy.dimension());
            for (a, b) in basis.iter().flat_map(|a| basis.iter().map(move |b| (a, b))) {
                let operands = [("a", a), ("b", b)];
                let commutator = contract("a^i_m b^m_j - b^i_m a^m_j -> ^i_j", &operands)?;
                prop_assert!(holonomy.contains(&commutator));
            }
            // the search that ends early with all skew matrices finds the same algebra
            let beside = connection.holonomy_beside(&space.metric).unwrap();
            prop_assert_eq!(beside.basis().unwrap(), basis);
        }
        for matrix in space.levi_civita().holonomy().unwrap().basis().unwrap() {
            let skew = contract(
                "g_im a^m_j + g_jm a^m_i -> _ij",
                &[("g", space.metric.components()), ("a", &matrix)],
            )?;
            prop_assert!(skew.is_empty());
        }
    }

    /// K. Nomizu: the holonomy of an analytic connection is spanned by the derivatives of the
    /// curvature.
    #[test]
    fn the_span_of_all_derivatives_of_the_curvature(space in spaces(3)) {
        for connection in space.connections() {
            let ranks = [1, 2, 3].map(|order| span_of_derivatives(&connection, order));
            let rank = rank(&connection);
            prop_assert!(ranks[2] <= rank);
            // once the span stops growing, it does not grow again
            if ranks[0] == ranks[1] {
                prop_assert_eq!(ranks[1], rank);
            }
        }
    }

    #[test]
    fn of_no_basis(
        (space, a) in spaces(4).prop_flat_map(|space| {
            let n = space.dimension();
            (Just(space), invertible(n))
        })
    ) {
        let change = BasisChange::new(a).unwrap();
        let algebra = space.algebra.change_basis(&change).unwrap();
        let g = change.apply(space.metric.components()).unwrap();
        let metric = Metric::new(algebra.labels(), g).unwrap();
        let moved = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        let (here, there) = (space.levi_civita().holonomy().unwrap(), moved.holonomy().unwrap());
        prop_assert_eq!(here.dimension(), there.dimension());
        for matrix in here.basis().unwrap() {
            prop_assert!(there.contains(&change.apply(&matrix).unwrap()));
        }
    }
}
