//! Frames over charts: brackets of their fields, Lie derivatives, and the transformation laws of
//! connections, compared with the laws as written out in `common`.

mod at_point;
mod canonical;
mod invariant_fields;

use crate::common::charts::{
    Chart as Group, Moved, affine, constant, euclidean, euler_angles, heisenberg, special_linear,
    value, values,
};
use crate::common::{inverse, labels, transform};
use affinor::geometry::chart::Fields;
use affinor::{BasisChange, CanonicalConnection, Chart, Connection, Error, Frame, Law, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, Variance, contract};

fn groups() -> [Group; 5] {
    [heisenberg(), affine(), special_linear(), euclidean(), euler_angles()]
}

fn fields(group: &Group, components: &Tensor<Symbolic>) -> Fields<Symbolic> {
    let chart = Chart::new(group.names).unwrap();
    chart.fields(labels(group.dimension()), components.clone()).unwrap()
}

fn column(matrix: &Tensor<Symbolic>, j: usize) -> Vec<Symbolic> {
    (0..matrix.dimension()).map(|i| matrix.get(&[i, j])).collect()
}

/// The right-invariant fields of the same basis of the algebra.
fn right_fields(group: &Group) -> Tensor<Symbolic> {
    match group.names {
        ["x", "y", "z"] => values([["1", "0", "0"], ["0", "1", "0"], ["y", "0", "1"]]),
        ["a", "b"] => values([["a", "0"], ["b", "1"]]),
        // the dual forms are dg g^-1
        ["a", "v", "u"] => inverse(&values([
            ["1/a", "-u*a^2", "0"],
            ["0", "a^2", "0"],
            ["2*u/a", "-u^2*a^2", "1"],
        ])),
        ["theta", "x", "y"] => values([["1", "0", "0"], ["-y", "1", "0"], ["x", "0", "1"]]),
        _ => values([
            ["-sin(phi)*cot(theta)", "cos(phi)*cot(theta)", "1"],
            ["cos(phi)", "sin(phi)", "0"],
            ["sin(phi)/sin(theta)", "-cos(phi)/sin(theta)", "0"],
        ]),
    }
}

#[test]
fn invariant_fields_have_structure_constants() {
    for group in groups() {
        let left = fields(&group, &group.fields);
        let right = fields(&group, &right_fields(&group));
        let c = group.algebra.structure_constants();
        assert_eq!(left.frame().structure_functions(), c, "{:?}", group.names);
        assert_eq!(
            right.frame().structure_functions(),
            &c.map(|v| -v.clone()),
            "{:?}",
            group.names
        );
        let plane = left.chart().coordinate_frame::<Symbolic>().unwrap();
        assert!(plane.structure_functions().is_empty());
        for (i, j) in (0..group.dimension()).flat_map(|i| [(i, 0), (i, 1)]) {
            let (x, y) = (column(left.components(), i), column(right.components(), j));
            let bracket = plane.bracket(&x, &y).unwrap();
            assert!(bracket.iter().all(|v| *v == constant(0)), "[L{i}, R{j}] {:?}", group.names);
        }
    }
}

/// `e_j(R) = R spin(u_j)` for left-invariant fields, `spin(u_j) R` for right-invariant ones.
#[test]
fn the_fields_of_euler_angles_turn_the_matrix() {
    let group = euler_angles();
    let about_z = |angle: &str| {
        let [s, c] = ["sin", "cos"].map(|f| format!("{f}({angle})"));
        values([[&c, &format!("-{s}"), "0"], [&s, &c, "0"], ["0", "0", "1"]])
    };
    let about_x = values([
        ["1", "0", "0"],
        ["0", "cos(theta)", "-sin(theta)"],
        ["0", "sin(theta)", "cos(theta)"],
    ]);
    let product = |a: &Tensor<Symbolic>, b: &Tensor<Symbolic>| {
        contract("a^i_m b^m_j -> ^i_j", &[("a", a), ("b", b)]).unwrap()
    };
    let rotation = product(&product(&about_z("phi"), &about_x), &about_z("psi"));
    let (left, right) = (fields(&group, &group.fields), fields(&group, &right_fields(&group)));
    for (j, spin) in [
        values([["0", "0", "0"], ["0", "0", "-1"], ["0", "1", "0"]]),
        values([["0", "0", "1"], ["0", "0", "0"], ["-1", "0", "0"]]),
        values([["0", "-1", "0"], ["1", "0", "0"], ["0", "0", "0"]]),
    ]
    .iter()
    .enumerate()
    {
        let along = |frame: &Frame<Symbolic>| rotation.map(|v| frame.derive(j, v));
        assert_eq!(along(left.frame()), product(&rotation, spin));
        assert_eq!(along(right.frame()), product(spin, &rotation));
    }
}

/// A metric that is neither diagonal nor definite.
fn metric(n: usize) -> Tensor<Symbolic> {
    let rows = [[1, 1, 0], [1, -2, 1], [0, 1, 1]];
    Tensor::from_fn(n, [Down, Down], |[i, j]| constant(rows[i][j])).unwrap()
}

/// The constants of a left-invariant frame and the computation in coordinates give the same
/// geometry.
#[test]
fn two_ways_agree() {
    for group in groups() {
        let n = group.dimension();
        let left = fields(&group, &group.fields);
        let back = BasisChange::new(inverse(&group.fields)).unwrap();
        let by_hand = group.coordinates();
        let frame = Frame::coordinates(group.names).unwrap();
        let g = Metric::new(labels(n), metric(n)).unwrap();
        let here = Metric::new(frame.labels(), back.apply(g.components()).unwrap()).unwrap();
        let levi_civita = Connection::levi_civita(group.algebra.left_frame(), &g).unwrap();
        let canonical =
            [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
                .map(|which| Connection::canonical(&group.algebra, which));
        for (at, constants) in canonical.into_iter().chain([levi_civita]).enumerate() {
            // the derivatives along the fields of constants are zero
            let moving =
                Connection::new(left.frame().clone(), constants.affinities().clone()).unwrap();
            assert_eq!(moving.curvature(), constants.curvature());
            let moved = moving.moved(frame.labels(), &back).unwrap();
            assert!(moved.frame().structure_functions().is_empty());
            assert_eq!(moved.affinities(), &by_hand.inhomogeneous(constants.affinities()));
            let computed = Connection::new(frame.clone(), moved.affinities().clone()).unwrap();
            assert_eq!(computed.torsion(), back.apply(&constants.torsion()).unwrap());
            assert_eq!(*computed.curvature(), back.apply(constants.curvature()).unwrap());
            assert_eq!(moved.curvature(), computed.curvature());
            let q = constants.nonmetricity(&g).unwrap();
            assert_eq!(computed.nonmetricity(&here).unwrap(), back.apply(&q).unwrap());
            if at == 3 {
                assert_eq!(
                    Connection::levi_civita(&frame, &here).unwrap().affinities(),
                    moved.affinities()
                );
            }
        }
    }
}

/// Random functions in a frame, transformed there and back, agree with the explicit law.
#[test]
fn frames_of_functions_move_there_and_back() {
    let group = euclidean();
    let functions = ["x*sin(theta) + 2", "exp(y)", "1 + x^2"].map(value);
    let by_hand = Moved::scaled(&group, &functions, value("cos(theta - 2*theta)*y"));
    let start = fields(&group, &group.fields).frame().clone();
    let change = BasisChange::new(by_hand.a.clone()).unwrap();
    let gamma = Tensor::from_fn(3, [Up, Down, Down], |[i, j, k]| {
        value(["x", "sin(theta)", "0", "y*exp(y)"][(i + 2 * j + 5 * k) % 4])
    });
    let connection = Connection::new(start.clone(), gamma.unwrap()).unwrap();
    let moved = connection.moved(labels(3), &change).unwrap();
    assert_eq!(moved.frame().structure_functions(), &by_hand.structure_functions());
    assert_eq!(moved.affinities(), &by_hand.inhomogeneous(connection.affinities()));
    assert_eq!(moved.torsion(), by_hand.tensor(&connection.torsion()));
    assert!(moved.frame().jacobi().is_empty());
    assert!(moved.bianchi_first().is_empty());
    let back = BasisChange::new(by_hand.inverse.clone()).unwrap();
    let back = moved.moved(labels(3), &back).unwrap();
    assert_eq!(back.affinities(), connection.affinities());
    assert_eq!(back.frame().structure_functions(), start.structure_functions());
    let f = value("x*y*sin(theta)");
    assert!((0..3).all(|k| back.frame().derive(k, &f) == start.derive(k, &f)));
}

/// A tensor and two fields whose components are functions.
fn samples<const RANK: usize>(slots: [Variance; RANK]) -> Tensor<Symbolic> {
    let functions = ["x", "sin(theta)*y", "0", "cos(theta)", "x*y + 1", "exp(y)", "2"];
    Tensor::from_fn(3, slots, |at| {
        value(functions[at.iter().fold(1, |key, i| key * 3 + i) % functions.len()])
    })
    .unwrap()
}

#[test]
fn lie_derivatives_keep_their_laws() {
    let group = euclidean();
    let frame = fields(&group, &group.fields).frame().clone();
    let x = ["y", "cos(theta)", "x^2"].map(value);
    let y = ["1", "exp(y)*x", "sin(theta)"].map(value);
    let z = frame.bracket(&x, &y).unwrap();
    let lie = |x: &[Symbolic], t: &Tensor<Symbolic>| {
        frame.lie_derivative(&Tensor::vector(x, Up), t).unwrap()
    };
    let less = |a: &Tensor<Symbolic>, b: &Tensor<Symbolic>| {
        let mine = a.components().map(|(at, v)| (at, v.clone()));
        let both = mine.chain(b.components().map(|(at, v)| (at, -v.clone())));
        Tensor::from_components(3, a.slots(), both).unwrap()
    };
    for t in [samples([Up, Down]), samples([Down, Down]), samples([Up, Down, Down])] {
        // [L_X, L_Y] = L_[X, Y]
        let commutator = less(&lie(&x, &lie(&y, &t)), &lie(&y, &lie(&x, &t)));
        assert_eq!(commutator, lie(&z, &t));
    }
    let negative = frame.bracket(&y, &x).unwrap();
    assert!(z.iter().zip(negative).all(|(a, b)| *a == -b));
    // the same field and tensor in coordinates
    let coordinates = Frame::coordinates(group.names).unwrap();
    let back = |t: &Tensor<Symbolic>| transform(t, &inverse(&group.fields), &group.fields);
    let there = back(&Tensor::vector(&x, Up)).to_vector().unwrap();
    let t = samples([Up, Down]);
    assert_eq!(
        coordinates.lie_derivative(&Tensor::vector(&there, Up), &back(&t)).unwrap(),
        back(&lie(&x, &t))
    );
    assert!(matches!(frame.bracket(&x[..2], &y), Err(Error::Shape { .. })));
    assert!(matches!(frame.bracket(&x, &y[..2]), Err(Error::Shape { .. })));
}

/// The rotations of the sphere keep its metric: M. P. do Carmo, *Riemannian Geometry* (1992), 3.5.
#[test]
fn rotations_are_killing_fields_of_the_sphere() {
    let frame = Frame::coordinates(&["theta", "phi"]).unwrap();
    let g = [([0, 0], constant(1)), ([1, 1], value("sin(theta)^2"))];
    let g = Tensor::from_components(2, &[Down, Down], g).unwrap();
    let killing = [["-sin(phi)", "-cot(theta)*cos(phi)"], ["cos(phi)", "-cot(theta)*sin(phi)"]];
    for field in killing.into_iter().chain([["0", "1"]]) {
        assert!(
            frame.lie_derivative(&Tensor::vector(&field.map(value), Up), &g).unwrap().is_empty()
        );
    }
    let other = frame.lie_derivative(&Tensor::vector(&["1", "0"].map(value), Up), &g).unwrap();
    assert_eq!(other.get(&[1, 1]), value("2*sin(theta)*cos(theta)"));
}

#[test]
fn frames_that_are_none_are_refused() {
    let chart = Chart::new(&["theta", "phi"]).unwrap();
    let dependent = values([["1", "sin(theta)"], ["cos(phi)", "sin(theta)*cos(phi)"]]);
    let error = chart.fields(labels(2), dependent).unwrap_err();
    assert!(matches!(error, Error::Broken { law: Law::IndependentFields, .. }));
    let text = error.to_string();
    assert!(text.contains("its determinant is zero, for -sin(theta)*e1 + e2 = 0"), "{text}");
    let wide = Tensor::<Symbolic>::identity(3);
    assert!(matches!(chart.fields(labels(3), wide), Err(Error::Shape { .. })));
    for names in [["x", "x"], ["x", "2"], ["x", ""]] {
        assert!(matches!(Chart::new(&names), Err(Error::Name(_))));
    }
}

/// Numbers have zero derivatives: over numbers every chart is flat, and nothing fails.
#[test]
fn charts_over_numbers() {
    let chart = Chart::new(&["x", "y"]).unwrap();
    let rows = Tensor::from_fn(2, [Up, Down], |[i, j]| Rational::from(i as i64 + 2 * j as i64 + 1));
    let fields = chart.fields(labels(2), rows.unwrap()).unwrap();
    assert!(fields.frame().structure_functions().is_empty());
    assert_eq!(fields.written(), ["d_x + 2*d_y", "3*d_x + 4*d_y"]);
}

/// The textbook formula of Christoffel symbols, and the curvature (B12) in a coordinate basis.
#[test]
fn the_classical_formulas_of_coordinates() {
    let names = ["x", "y", "z"];
    let frame = Frame::coordinates(&names).unwrap();
    let entries = ["x^2 + 2", "sin(y)", "1", "exp(z)*x", "0", "cos(x)^2"].map(value);
    let g = Tensor::from_fn(3, [Down, Down], |[i, j]| {
        entries[i.min(j) * (5 - i.min(j)) / 2 + i.max(j)].clone()
    });
    let metric = Metric::new(labels(3), g.unwrap()).unwrap();
    let g = |i: usize, j: usize, k: usize| metric.components().get(&[i, j]).derivative(names[k]);
    let half = value("1/2");
    let christoffel = Tensor::from_fn(3, [Up, Down, Down], |[i, j, k]| {
        let term = |m: usize| {
            metric.inverse().get(&[i, m]) * &(g(k, m, j) + &g(j, m, k) - &g(j, k, m)) * &half
        };
        term(0) + &term(1) + &term(2)
    });
    let christoffel = christoffel.unwrap();
    let connection = Connection::levi_civita(&frame, &metric).unwrap();
    assert_eq!(connection.affinities(), &christoffel);
    let gamma = |i: usize, j: usize, k: usize| christoffel.get(&[i, j, k]);
    let curvature = connection.curvature();
    for [i, j, k, l] in [[0, 1, 0, 1], [2, 0, 1, 2], [1, 1, 0, 2], [0, 2, 2, 0], [1, 0, 0, 0]] {
        let derivatives =
            gamma(i, l, j).derivative(names[k]) - &gamma(i, k, j).derivative(names[l]);
        let products =
            (0..3).map(|m| gamma(i, k, m) * &gamma(m, l, j) - &(gamma(i, l, m) * &gamma(m, k, j)));
        let expected = products.fold(derivatives, |sum, term| sum + &term);
        assert_eq!(curvature.get(&[i, j, k, l]), expected);
    }
}

/// The Cartesian components `q^a = theta n^a` of the rotation vector, over the polar chart
/// `(theta, alpha, beta)`: left-invariant fields, and the fields `d/dq^a`.
fn rotation_vectors() -> (Fields<Symbolic>, BasisChange<Symbolic>) {
    let n = ["sin(alpha)*cos(beta)", "sin(alpha)*sin(beta)", "cos(alpha)"];
    let along = ["cos(alpha)*cos(beta)", "cos(alpha)*sin(beta)", "-sin(alpha)"];
    let around = ["-sin(beta)", "cos(beta)", "0"];
    let half = "sin(theta)/(1 - cos(theta))";
    let row = |f: &dyn Fn(usize) -> String| [0, 1, 2].map(f);
    let table = |rows: [[String; 3]; 3]| {
        let components = Tensor::from_fn(3, [Up, Down], |[a, i]| value(&rows[a][i]));
        components.unwrap()
    };
    let left = table([
        row(&|i| n[i].into()),
        row(&|i| format!("1/2*({half}*({}) - ({}))", along[i], around[i])),
        row(&|i| format!("1/2*({half}*({}) + ({}))/sin(alpha)", around[i], along[i])),
    ]);
    let cartesian = table([
        row(&|a| n[a].into()),
        row(&|a| format!("({})/theta", along[a])),
        row(&|a| format!("({})/(theta*sin(alpha))", around[a])),
    ]);
    let chart = Chart::new(&["theta", "alpha", "beta"]).unwrap();
    let fields = chart.fields(labels(3), left).unwrap();
    let change =
        contract("B^i_a q^a_j -> ^i_j", &[("B", fields.change().inverse()), ("q", &cartesian)]);
    let change = BasisChange::new(change.unwrap()).unwrap();
    (fields, change)
}

/// (75): in canonical coordinates the symmetric part of the affinities vanishes at the pole, and
/// the antisymmetric part is half the torsion. After (75): elsewhere the symmetric part does not
/// vanish, but its contraction with `q^j q^k` does, because rays are autoparallel.
#[test]
fn eq_75_affinities_in_canonical_coordinates() {
    let (fields, change) = rotation_vectors();
    let frame = fields.frame();
    let ray = Tensor::vector(
        &["sin(alpha)*cos(beta)", "sin(alpha)*sin(beta)", "cos(alpha)"].map(value),
        Up,
    );
    let mut symmetric_parts = Vec::new();
    for lambda in ["1", "1/2", "0"] {
        let gamma = frame.structure_functions().scale(&value(lambda));
        let left = Connection::new(frame.clone(), gamma).unwrap();
        let here = left.moved(labels(3), &change).unwrap();
        assert!(here.frame().structure_functions().is_empty(), "d/dq^a commute (A9)");
        let gamma = here.affinities();
        let operands = [("G", gamma), ("n", &ray)];
        let turned = contract("G^i_jk n^j -> ^i_k", &operands).unwrap();
        let turned = contract("G^i_k n^k -> ^i", &[("G", &turned), ("n", &ray)]).unwrap();
        assert!(turned.is_empty(), "{turned:?}");
        let part = |sign: i64| {
            let text = format!("G^i_jk + {sign} G^i_kj -> ^i_jk");
            contract(&text, &[("G", gamma)]).unwrap()
        };
        assert_eq!(part(-1), here.torsion());
        let symmetric = part(1);
        assert!(!symmetric.is_empty(), "off the pole");
        // linear in the distance from the pole, along any ray
        let size = |theta: f64| {
            let at = |name: &str| match name {
                "theta" => Some(theta),
                "alpha" => Some(0.8),
                _ => Some(2.3),
            };
            let values = symmetric.components().map(|(_, v)| v.evaluate(at).unwrap().abs());
            values.fold(0.0, f64::max)
        };
        assert!(size(1e-2) < 1e-2 && size(1e-3) < 1e-3, "{} {}", size(1e-2), size(1e-3));
        assert!(size(1.0) > 1e-2);
        symmetric_parts.push(symmetric);
    }
    // up to torsion, the three canonical connections are equal
    assert!(symmetric_parts.windows(2).all(|pair| pair[0] == pair[1]));
}
