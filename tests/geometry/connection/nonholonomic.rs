//! The nonholonomic connection: its defining properties, its torsion, and its geodesics.

use crate::common::{Space, property::properties, rationals, spaces};
use affinor::algebra::structure::Subspace;
use affinor::geometry::complement_projector;
use affinor::{Connection, ConnectionKind, Error, Geometry, Metric};
use affinor_tensors::linear::Row;
use affinor_tensors::{Down, Rational, Tensor, Up, contract};
use proptest::collection::vec;
use proptest::prelude::*;

/// A space with at most two random vectors.
fn with_vectors() -> impl Strategy<Value = (Space, Vec<Vec<Rational>>)> {
    spaces(5).prop_flat_map(|space| {
        let n = space.dimension();
        (Just(space), vec(vec(rationals(), n), 1..=2))
    })
}

fn formula(text: &str, operands: &[(&str, &Tensor<Rational>)]) -> Tensor<Rational> {
    contract(text, operands).unwrap()
}

/// The columns of a basis of a subspace, as a tensor with slots `[Up, Down]`.
fn columns(subspace: &Subspace<Rational>) -> Tensor<Rational> {
    let entries = subspace
        .basis()
        .iter()
        .enumerate()
        .flat_map(|(a, row)| row.iter().map(move |(i, value)| ([*i, a], value.clone())));
    Tensor::from_components(subspace.ambient(), &[Up, Down], entries).unwrap()
}

properties! {
    #![cases(60)]

    #[test]
    fn the_connection_of_a_distribution((space, vectors) in with_vectors()) {
        let n = space.dimension();
        let sparse = |row: Vec<Rational>| -> Row<Rational> { row.into_iter().enumerate().collect() };
        let subspace = Subspace::span(n, vectors.into_iter().map(sparse));
        let (g, c) = (space.metric.components(), space.algebra.structure_constants());
        // the metric may be degenerate on the subspace
        if let Ok(projector) = complement_projector(&space.metric, &subspace) {
            let (p, d) = (&projector, &columns(&subspace));
            // the projector is orthogonal, and its kernel is the distribution
            prop_assert_eq!(&formula("P^i_k P^k_j -> ^i_j", &[("P", p)]), p);
            prop_assert!(formula("g_ik P^k_j - g_jk P^k_i -> _ij", &[("g", g), ("P", p)]).is_empty());
            prop_assert!(formula("P^i_k D^k_a -> ^i_a", &[("P", p), ("D", d)]).is_empty());
            let trace = formula("P^i_i ->", &[("P", p)]).get(&[]);
            prop_assert_eq!(trace, Rational::from((n - subspace.dimension()) as i64));

            let free = Connection::levi_civita(space.algebra.left_frame(), &space.metric).unwrap();
            let connection = free.nonholonomic(p).unwrap();
            let gamma = connection.affinities();
            // nabla_X Y is in the distribution for Y in it, and is the projection of the free one
            let operands = [("L", gamma), ("F", free.affinities()), ("P", p), ("D", d)];
            prop_assert!(formula("P^i_m L^m_jk D^k_a -> ^i_ja", &operands).is_empty());
            let projected = "L^i_jk D^k_a - F^i_jk D^k_a + P^i_m F^m_jk D^k_a -> ^i_ja";
            prop_assert!(formula(projected, &operands).is_empty());
            // so the curvature maps the distribution to itself
            let curvature = connection.curvature();
            let operands = [("R", curvature), ("P", p), ("D", d)];
            prop_assert!(formula("P^i_m R^m_jkl D^j_a -> ^i_akl", &operands).is_empty());
            // the torsion is (nabla_X P') Y - (nabla_Y P') X for the free connection
            let change = free.nabla(p).unwrap();
            let expected = formula("N^i_jk - N^i_kj -> ^i_jk", &[("N", &change)]);
            prop_assert_eq!(connection.torsion(), expected);
            // the geodesics are the motions: g v' is the projection of the free covector ad*_v g v,
            // here polarized for two vectors of the distribution
            let operands = [("L", gamma), ("P", p), ("D", d), ("g", g), ("c", c)];
            let geodesic = formula("g_im L^m_jk D^j_a D^k_b + g_im L^m_jk D^j_b D^k_a -> _iab", &operands);
            let moved = formula("c^m_ki D^k_a g_mn D^n_b + c^m_ki D^k_b g_mn D^n_a -> _iab", &operands);
            let moved = formula("f_iab - P^m_i f_mab -> _iab", &[("f", &moved), ("P", p)]);
            prop_assert!(formula("x_iab + f_iab -> _iab", &[("x", &geodesic), ("f", &moved)]).is_empty());
        }
    }
}

/// Without constraints the connection is that of Levi-Civita. A projector that is none, a missing
/// metric and a degenerate restriction are errors.
#[test]
fn special_cases_and_errors() {
    let so3 = affinor::algebra::catalogue::algebra::<Rational>("so(3)").unwrap();
    let metric = Metric::diagonal([1, 2, 4].map(Rational::from)).unwrap();
    let free = Connection::levi_civita(so3.left_frame(), &metric).unwrap();
    let nothing = complement_projector(&metric, &Subspace::whole(3)).unwrap();
    assert!(nothing.is_empty());
    assert_eq!(free.nonholonomic(&nothing).unwrap(), free);
    let twice = Tensor::identity(3).scale(&Rational::from(2));
    let error = free.nonholonomic(&twice).unwrap_err();
    assert!(matches!(error, Error::Invalid { what: "projector", .. }), "{error}");
    let kind = ConnectionKind::Nonholonomic(nothing);
    let missing = Geometry::new("so(3)", so3, kind, None);
    assert!(matches!(missing, Err(Error::NoMetric)));
    let light = Metric::diagonal([1, -1, 1].map(Rational::from)).unwrap();
    let null = Subspace::span(3, [vec![(0, Rational::from(1)), (1, Rational::from(1))]]);
    let error = complement_projector(&light, &null).unwrap_err();
    assert!(matches!(error, Error::Invalid { what: "distribution", .. }), "{error}");
}
