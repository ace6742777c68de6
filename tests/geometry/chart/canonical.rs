//! Invariant fields of any algebra in canonical coordinates: their brackets are the constants.

use crate::common::algebras::{by_table, catalogued, seeds, symbolic};
use crate::common::integer;
use crate::common::{charts::value, property::properties};
use affinor::geometry::chart::{CanonicalCoordinates, Chart, Fields, Side};
use affinor::{BasisChange, Connection, Error, Law, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up};
use proptest::prelude::*;

fn chart(n: usize) -> Chart {
    Chart::new((1..=n).map(|a| format!("x{a}"))).unwrap()
}

fn fields(
    algebra: &LieAlgebra<Symbolic>,
    kind: CanonicalCoordinates,
    side: Side,
) -> Result<Fields<Symbolic>, Error> {
    chart(algebra.dimension()).invariant_fields(algebra, kind, side)
}

/// The fields have the structure constants `c` and `-c`; left and right fields commute, and agree
/// at the identity.
fn invariant(name: &str, algebra: &LieAlgebra<Symbolic>, kind: CanonicalCoordinates) {
    let [left, right] = [Side::Left, Side::Right].map(|side| fields(algebra, kind, side).unwrap());
    let c = algebra.structure_constants();
    assert_eq!(left.frame().structure_functions(), c, "{name}");
    assert_eq!(right.frame().structure_functions(), &c.map(|v| -v.clone()), "{name}");
    let n = algebra.dimension();
    let coordinates = left.chart().coordinate_frame::<Symbolic>().unwrap();
    let field = |fields: &Fields<Symbolic>, i: usize| -> Vec<Symbolic> {
        (0..n).map(|a| fields.components().get(&[a, i])).collect()
    };
    for (i, j) in (0..n).map(|i| (i, (2 * i + 1) % n)) {
        let bracket = coordinates.bracket(&field(&left, i), &field(&right, j)).unwrap();
        assert!(bracket.iter().all(|v| v == &value("0")), "{name}: [L{i}, R{j}]");
    }
    // the limit of quotients such as (exp(x) - 1)/x
    let near = |name: &str| name.strip_prefix('x')?.parse::<f64>().ok().map(|a| 1e-3 / (1.0 + a));
    for (a, i) in (0..n).flat_map(|a| (0..n).map(move |i| (a, i))) {
        for fields in [&left, &right] {
            let here = fields.components().get(&[a, i]).evaluate(near).unwrap();
            assert!((here - f64::from(a == i)).abs() < 1e-2, "{name}: {here}");
        }
    }
}

/// Solvable algebras in bases where the eigenvalues of `ad_x` are linear forms of `x`.
fn linear_forms() -> Vec<(&'static str, LieAlgebra<Rational>)> {
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let plane = by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)]);
    let both = affine.direct_sum(&affine).unwrap();
    let mixed = [[1, 1, 0, 0], [0, 1, 0, 0], [1, -2, 1, 0], [0, 0, 0, 1]];
    let mixed = Tensor::from_fn(4, [Up, Down], |[i, j]| integer(mixed[i][j])).unwrap();
    vec![
        ("aff(1)", affine.clone()),
        ("sol, Bianchi VI_-1", by_table(3, &[(3, 1, 1, 1), (3, 2, 2, -1)])),
        ("e(1,1)", by_table(3, &[(1, 2, 3, 1), (1, 3, 2, 1)])),
        ("se(2), Bianchi VII_0", plane.clone()),
        ("Bianchi VII_1", by_table(3, &[(1, 2, 2, 1), (1, 2, 3, 1), (1, 3, 2, -1), (1, 3, 3, 1)])),
        ("Bianchi IV", by_table(3, &[(1, 3, 1, 1), (2, 3, 1, 1), (2, 3, 2, 1)])),
        ("Bianchi V", by_table(3, &[(1, 3, 1, 1), (2, 3, 2, 1)])),
        // the complex hyperbolic plane, with the roots doubled
        ("Damek-Ricci", by_table(4, &[(1, 2, 2, 1), (1, 3, 3, 1), (1, 4, 4, 2), (2, 3, 4, 1)])),
        ("oscillator", by_table(4, &[(1, 2, 3, 1), (1, 3, 2, -1), (2, 3, 4, 1)])),
        ("aff(1) + se(2)", affine.direct_sum(&plane).unwrap()),
        ("aff(1) + aff(1), mixed", both.change_basis(&BasisChange::new(mixed).unwrap()).unwrap()),
    ]
}

#[test]
fn the_first_kind_in_closed_form() {
    for (name, algebra) in linear_forms() {
        invariant(name, &symbolic(&algebra), CanonicalCoordinates::First);
    }
}

/// Upper triangular matrices: roots `2x1 - x2`, `2x2 - x1` and `x1 + x2`.
#[test]
fn roots_of_several_coordinates() {
    let table = [
        (1, 3, 3, 2),
        (1, 4, 4, -1),
        (1, 5, 5, 1),
        (2, 3, 3, -1),
        (2, 4, 4, 2),
        (2, 5, 5, 1),
        (3, 4, 5, 1),
    ];
    let algebra = symbolic(&by_table(5, &table));
    let left = fields(&algebra, CanonicalCoordinates::First, Side::Left).unwrap();
    assert_eq!(left.frame().structure_functions(), algebra.structure_constants());
}

/// `x -> a x + b` with `g = exp(x1 e1 + x2 e2)`: `a = exp(x1)`, `b = x2 (exp(x1) - 1)/x1`, and the
/// left-invariant fields are `a d_a` and `a d_b`. A wrong sign would exchange left and right.
#[test]
fn the_fields_of_the_affine_group() {
    let algebra = symbolic(&by_table(2, &[(1, 2, 2, 1)]));
    let [left, right] = [Side::Left, Side::Right].map(|side| {
        let fields = fields(&algebra, CanonicalCoordinates::First, side).unwrap();
        (0..2).map(|i| [0, 1].map(|a| fields.components().get(&[a, i]))).collect::<Vec<_>>()
    });
    let b = value("x2*(exp(x1) - 1)/x1");
    let on_b = |field: &[Symbolic; 2]| {
        field[0].clone() * &b.derivative("x1") + &(field[1].clone() * &b.derivative("x2"))
    };
    assert_eq!([left[0][0].clone(), on_b(&left[0])], ["1", "0"].map(value));
    assert_eq!([left[1][0].clone(), on_b(&left[1])], ["0", "exp(x1)"].map(value));
    // a d_a + b d_b and d_b
    assert_eq!([right[0][0].clone(), on_b(&right[0])], [value("1"), b.clone()]);
    assert_eq!([right[1][0].clone(), on_b(&right[1])], ["0", "1"].map(value));
}

#[test]
fn the_second_kind_serves_any_algebra() {
    for (name, algebra) in seeds() {
        invariant(name, &symbolic(&algebra), CanonicalCoordinates::Second);
    }
}

#[test]
fn the_first_kind_serves_solvable_seeds() {
    let refused =
        ["so(3)", "sl(2)", "so(2,1)", "se(3)", "sl(2) x R^2", "so(3) + R", "so(3) + aff(1)"];
    for (name, algebra) in seeds() {
        let algebra = symbolic(&algebra);
        if refused.contains(&name) || name == "sl(2) + heisenberg(3)" {
            let refused = fields(&algebra, CanonicalCoordinates::First, Side::Left);
            assert!(matches!(refused, Err(Error::Broken { law: Law::Eigenvalues, .. })), "{name}");
        } else {
            invariant(name, &algebra, CanonicalCoordinates::First);
        }
    }
}

/// The Heisenberg group: R. S. Strichartz, *J. Funct. Anal.* 96 (1991), (1.8), with `[x, y] = z`.
#[test]
fn the_fields_of_the_heisenberg_group() {
    let algebra = symbolic(&by_table(3, &[(1, 2, 3, 1)]));
    let left = fields(&algebra, CanonicalCoordinates::First, Side::Left).unwrap();
    assert_eq!(left.written(), ["d_x1 - 1/2*x2*d_x3", "d_x2 + 1/2*x1*d_x3", "d_x3"]);
    let left = fields(&algebra, CanonicalCoordinates::Second, Side::Left).unwrap();
    assert_eq!(left.written(), ["d_x1 - x2*d_x3", "d_x2", "d_x3"]);
}

#[test]
fn eigenvalues_that_are_no_integers_are_refused() {
    // [e1, e2] = e3, [e1, e3] = 2 e2: the eigenvalues are the square roots of 2
    let algebra = symbolic(&by_table(3, &[(1, 2, 3, 1), (1, 3, 2, 2)]));
    let refused = fields(&algebra, CanonicalCoordinates::Second, Side::Left).unwrap_err();
    assert!(matches!(refused, Error::Broken { law: Law::Eigenvalues, .. }));
    let text = refused.to_string();
    assert!(text.contains("ad_e1 has an eigenvalue") && text.contains("z^3 - 2*z^1"), "{text}");
    let refused =
        fields(&algebra, CanonicalCoordinates::First, Side::Right).unwrap_err().to_string();
    assert!(refused.contains("ad_e1 has an eigenvalue"), "{refused}");
    // so(3): i|x|, and |e1 + 102 e2|^2 = 10405
    let rotations = symbolic(&catalogued("so(3)"));
    let refused =
        fields(&rotations, CanonicalCoordinates::First, Side::Left).unwrap_err().to_string();
    assert!(
        refused.contains("ad_(e1 + 102*e2)") && refused.contains("z^3 + 10405*z^1"),
        "{refused}"
    );
    // a parameter as an eigenvalue is not an integer, but elsewhere it is allowed
    let scaled =
        |table| symbolic(&by_table(3, table)).map(|v| v.clone() * &Symbolic::parameter("a"));
    let refused =
        fields(&scaled(&[(1, 2, 2, 1)]).unwrap(), CanonicalCoordinates::First, Side::Left);
    assert!(matches!(refused, Err(Error::Broken { law: Law::Eigenvalues, .. })));
    let served =
        fields(&scaled(&[(1, 2, 3, 1)]).unwrap(), CanonicalCoordinates::First, Side::Left).unwrap();
    assert_eq!(served.written()[0], "d_x1 - 1/2*a*x2*d_x3");
    let large = fields(&symbolic(&catalogued("E6")), CanonicalCoordinates::First, Side::Left);
    assert!(matches!(large, Err(Error::Size { .. })));
    let wrong = chart(2).invariant_fields(&algebra, CanonicalCoordinates::First, Side::Left);
    assert!(matches!(wrong, Err(Error::Shape { .. })));
    let named = algebra.map(|v| v.clone() * &Symbolic::parameter("x2")).unwrap();
    let wrong = fields(&named, CanonicalCoordinates::Second, Side::Left);
    assert!(matches!(wrong, Err(Error::Name(_))));
}

properties! {
    #![cases(6)]

    /// The curvature of a left-invariant metric and of the canonical connections: from the
    /// structure constants and from the coordinates.
    #[test]
    fn curvature_by_constants_and_by_coordinates(
        which in 0usize..6,
        entries in proptest::collection::vec(-2i64..3, 6),
    ) {
        let tables: [(&[_], _); 6] = [
            (&[(1, 2, 3, 1)], CanonicalCoordinates::First),
            (&[(1, 2, 3, 1), (1, 3, 2, -1)], CanonicalCoordinates::Second),
            (&[(1, 3, 1, 1), (2, 3, 1, 1), (2, 3, 2, 1)], CanonicalCoordinates::Second),
            (&[(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1)], CanonicalCoordinates::Second),
            (&[(1, 2, 2, 1)], CanonicalCoordinates::First),
            (&[(3, 1, 1, 1), (3, 2, 2, -1)], CanonicalCoordinates::First),
        ];
        let (table, kind) = tables[which];
        let algebra = symbolic(&by_table(3, table));
        let g = Tensor::from_fn(3, [Down, Down], |[i, j]| {
            let (i, j) = (i.min(j), i.max(j));
            value(&(entries[i * (5 - i) / 2 + j] + if i == j { 5 } else { 0 }).to_string())
        }).unwrap();
        let metric = Metric::new(algebra.labels(), g);
        prop_assume!(metric.is_ok());
        let metric = metric.unwrap();
        let constants = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        let left = fields(&algebra, kind, Side::Left).unwrap();
        let back = BasisChange::new(left.change().inverse().clone()).unwrap();
        let frame = left.chart().coordinate_frame::<Symbolic>().unwrap();
        let here = Metric::new(frame.labels(), back.apply(metric.components()).unwrap()).unwrap();
        let computed = Connection::levi_civita(&frame, &here).unwrap();
        prop_assert_eq!(computed.curvature(), &back.apply(constants.curvature()).unwrap());
        prop_assert_eq!(
            computed.scalar_curvature(&here).unwrap(),
            constants.scalar_curvature(&metric).unwrap()
        );
        let right = fields(&algebra, kind, Side::Right).unwrap();
        let back_right = BasisChange::new(right.change().inverse().clone()).unwrap();
        for lambda in ["0", "1/2", "1"].map(value) {
            let constants = Connection::cartan_schouten(&algebra, &lambda);
            // nabla_{e_j} e_k = lambda [e_j, e_k]: the same from either frame
            let [of_left, of_right] =
                [(&left, &back, lambda.clone()), (&right, &back_right, value("1") - &lambda)]
                    .map(|(fields, back, share)| {
                        let gamma = fields.frame().structure_functions().scale(&share);
                        let invariant = Connection::new(fields.frame().clone(), gamma).unwrap();
                        invariant.moved(frame.labels(), back).unwrap()
                    });
            prop_assert_eq!(of_left.affinities(), of_right.affinities());
            prop_assert_eq!(of_left.torsion(), back.apply(&constants.torsion()).unwrap());
            prop_assert_eq!(of_left.curvature(), &back.apply(constants.curvature()).unwrap());
        }
    }
}
