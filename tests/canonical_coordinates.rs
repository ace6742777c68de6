//! Invariant fields of any algebra in canonical coordinates: their brackets are the constants.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use affinor::chart::{Canonical, Chart, Fields, Side};
use affinor::{BasisChange, Connection, Error, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor};
use common::algebras::{by_table, seeds};
use common::charts::value;
use proptest::prelude::*;

fn symbolic(algebra: &LieAlgebra<Rational>) -> LieAlgebra<Symbolic> {
    algebra.map(|v| Symbolic::constant(v.clone())).unwrap()
}

fn chart(n: usize) -> Chart {
    Chart::new(&(1..=n).map(|a| format!("x{a}")).collect::<Vec<_>>()).unwrap()
}

fn fields(
    algebra: &LieAlgebra<Symbolic>,
    kind: Canonical,
    side: Side,
) -> Result<Fields<Symbolic>, Error> {
    chart(algebra.dimension()).invariant_fields(algebra, kind, side)
}

/// Structure constants `c` and `-c`; left and right fields commute, and agree at the identity.
fn invariant(name: &str, algebra: &LieAlgebra<Symbolic>, kind: Canonical) {
    let [left, right] = [Side::Left, Side::Right].map(|side| fields(algebra, kind, side).unwrap());
    let c = algebra.structure();
    assert_eq!(left.frame().structure(), c, "{name}");
    assert_eq!(right.frame().structure(), &c.map(|v| -v.clone()), "{name}");
    let n = algebra.dimension();
    let coordinates = left.chart().coordinate_frame::<Symbolic>().unwrap();
    let field = |fields: &Fields<Symbolic>, i: usize| -> Vec<Symbolic> {
        (0..n).map(|a| fields.components().get(&[a, i])).collect()
    };
    for (i, j) in (0..n).map(|i| (i, (2 * i + 1) % n)) {
        let bracket = coordinates.bracket(&field(&left, i), &field(&right, j)).unwrap();
        assert!(bracket.iter().all(|v| v == &value("0")), "{name}: [L{i}, R{j}]");
    }
    let origin =
        (1..=n).flat_map(|a| [format!("x{a}"), format!("tan(x{a}/2)"), format!("exp(x{a})")]);
    let origin = origin.map(|name| match name.starts_with("exp") {
        true => (name, value("1")),
        false => (name, value("0")),
    });
    let origin = origin.collect();
    for fields in [left, right] {
        let here = fields.components().map(|v| v.substitute(&origin).unwrap());
        assert_eq!(here, Tensor::identity(n), "{name}");
    }
}

#[test]
fn the_second_kind_serves_any_algebra() {
    for (name, algebra) in seeds() {
        invariant(name, &symbolic(&algebra), Canonical::Second);
    }
}

#[test]
fn the_first_kind_serves_nilpotent_algebras() {
    let names = ["heisenberg(3)", "heisenberg(5)", "filiform(4)"];
    let mut served = 0;
    for (name, algebra) in seeds() {
        let algebra = symbolic(&algebra);
        if names.contains(&name) {
            invariant(name, &algebra, Canonical::First);
            served += 1;
        } else {
            let refused = fields(&algebra, Canonical::First, Side::Left);
            assert!(matches!(refused, Err(Error::NotNilpotent { .. })), "{name}");
        }
    }
    assert_eq!(served, 3);
}

/// The Heisenberg group: R. S. Strichartz, *J. Funct. Anal.* 96 (1991), (1.8), with `[x, y] = z`.
#[test]
fn the_fields_of_the_heisenberg_group() {
    let algebra = symbolic(&by_table(3, &[(1, 2, 3, 1)]));
    let left = fields(&algebra, Canonical::First, Side::Left).unwrap();
    assert_eq!(left.written(), ["d_x1 - 1/2*x2*d_x3", "d_x2 + 1/2*x1*d_x3", "d_x3"]);
    let left = fields(&algebra, Canonical::Second, Side::Left).unwrap();
    assert_eq!(left.written(), ["d_x1 - x2*d_x3", "d_x2", "d_x3"]);
}

#[test]
fn eigenvalues_that_are_no_integers_are_refused() {
    // [e1, e2] = e3, [e1, e3] = 2 e2: the eigenvalues are the square roots of 2
    let algebra = symbolic(&by_table(3, &[(1, 2, 3, 1), (1, 3, 2, 2)]));
    let refused = fields(&algebra, Canonical::Second, Side::Left).unwrap_err();
    assert!(matches!(refused, Error::Eigenvalue { .. }));
    let text = refused.to_string();
    assert!(text.contains("ad_e1 has an eigenvalue") && text.contains("z^3 - 2*z^1"), "{text}");
    let wrong = chart(2).invariant_fields(&algebra, Canonical::First, Side::Left);
    assert!(matches!(wrong, Err(Error::Shape { .. })));
    let named = algebra.map(|v| v.clone() * &Symbolic::parameter("x2")).unwrap();
    let wrong = fields(&named, Canonical::Second, Side::Left);
    assert!(matches!(wrong, Err(Error::Coordinate { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// The curvature of a left-invariant metric, by constants and by coordinates.
    #[test]
    fn levi_civita_by_constants_and_by_coordinates(
        which in 0usize..4,
        entries in proptest::collection::vec(-2i64..3, 6),
    ) {
        let tables: [&[_]; 4] = [
            &[(1, 2, 3, 1)],
            &[(1, 2, 3, 1), (1, 3, 2, -1)],
            &[(1, 3, 1, 1), (2, 3, 1, 1), (2, 3, 2, 1)],
            &[(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1)],
        ];
        let algebra = symbolic(&by_table(3, tables[which]));
        let g = Tensor::from_fn(3, [Down, Down], |[i, j]| {
            let (i, j) = (i.min(j), i.max(j));
            value(&(entries[i * (5 - i) / 2 + j] + if i == j { 5 } else { 0 }).to_string())
        }).unwrap();
        let metric = Metric::new(algebra.labels(), g);
        prop_assume!(metric.is_ok());
        let metric = metric.unwrap();
        let constants = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        let left = fields(&algebra, Canonical::Second, Side::Left).unwrap();
        let back = BasisChange::new(left.change().inverse().clone()).unwrap();
        let frame = left.chart().coordinate_frame::<Symbolic>().unwrap();
        let here = Metric::new(frame.labels(), back.apply(metric.components()).unwrap()).unwrap();
        let computed = Connection::levi_civita(&frame, &here).unwrap();
        prop_assert_eq!(computed.curvature(), back.apply(&constants.curvature()).unwrap());
        prop_assert_eq!(
            computed.scalar_curvature(&here).unwrap(),
            constants.scalar_curvature(&metric).unwrap()
        );
    }
}
