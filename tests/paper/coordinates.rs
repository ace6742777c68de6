//! Section 4.3 on groups: the representation `Phi` and canonical coordinates, (72)-(90).
//!
//! `Phi` takes canonical coordinates to matrices: the matrix of `exp`. (75) is shown beside the
//! coordinate affinities of any algebra, in `tests/canonical_at_point.rs`.

use crate::common::labels;
use crate::paper::matrices::{self, Basis};
use crate::paper::on_groups::{
    self, column, commutator, differ, distance, equal, hat, on_every_group, rate, same, vectors,
};
use crate::paper::{assert_tensors, epsilons};
use affinor::algebra::Complex;
use affinor::group::fields::{InvariantField, Side};
use affinor::group::{AnyGroup, Coordinates, LieGroup, MatrixGroup, Sl2, So3, Velocity};
use affinor::{Error, MatrixBasis};
use affinor_tensors::{Rational, Tensor, Tolerance};
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};

fn phi<G: LieGroup>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    group.matrix(&group.exp(x))
}

/// The product (73) of canonical coordinates.
fn product<G: LieGroup>(group: &G, p: &G::Vector, q: &G::Vector) -> Result<G::Vector, Error> {
    group.log(&group.compose(&group.exp(p), &group.exp(q)))
}

#[test]
fn eq_72_phi_takes_products_to_products() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [p, q, _] = vectors(group);
        let (p, q) = (p * 0.8, q * 0.7);
        let together = phi(group, &product(group, &p, &q).unwrap());
        same(&together, &(phi(group, &p) * phi(group, &q)), name);
        same(&together, &(hat(basis, &p).exp() * hat(basis, &q).exp()), name);
        let wrong = phi(group, &q) * phi(group, &p);
        assert!(distance(&together, &wrong) > 1e-2, "{name}");
        // coordinates do not add
        assert!(distance(&together, &phi(group, &(p + q))) > 1e-3, "{name}");
    }
    on_every_group!(law);
}

/// One to one holds of the points; of rotation vectors only inside the ball of radius pi.
#[test]
fn claim_at_72_phi_is_one_to_one_only_within_half_a_turn() {
    let n = Vector3::new(-1.0, 2.0, 2.0) / 3.0;
    let there_and_back = |length: f64| So3.log(&So3.exp(&(n * length))).unwrap();
    for length in [0.0, 1e-8, 1.0, 3.0, PI - 1e-6] {
        assert!((there_and_back(length) - n * length).norm() < 1e-14, "{length}");
    }
    // beyond, the same point has nearer coordinates: modulo 2 pi along the axis
    for (length, nearer) in [(4.0, 4.0 - TAU), (7.0, 7.0 - TAU), (10.0, 10.0 - 2.0 * TAU)] {
        assert!((there_and_back(length) - n * nearer).norm() < 1e-13, "{length}");
        let again = So3.log_near(&So3.exp(&(n * length)), &(n * (length - 0.3))).unwrap();
        assert!((again - n * length).norm() < 1e-13, "{length}");
    }
    // at pi antipodes are one rotation
    assert!(distance(&phi(&So3, &(n * PI)), &phi(&So3, &(n * -PI))) < 1e-15);
    // at 2 pi k the exponential is singular: all directions across the axis are lost
    for turns in [1.0, 2.0] {
        let across = So3.tangent_left(&(n * (TAU * turns)), &Vector3::new(2.0, 1.0, 0.0));
        assert!(across.norm() < 1e-15, "{across}");
    }
    // and on SL(2,R) it is neither one to one nor onto
    let rotation = Vector3::new(TAU, -TAU, 0.0);
    assert!(distance(&phi(&Sl2, &rotation), &DMatrix::identity(2, 2)) < 1e-15);
}

#[test]
fn eq_73_product_of_canonical_coordinates() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [p, q, r] = vectors(group);
        let factors = [p * 0.5, q * 0.6, r * -0.3];
        let elements = factors.iter().map(|x| group.exp(x));
        let product = elements.reduce(|g, h| group.compose(&g, &h)).unwrap();
        let found = group.log(&product).unwrap();
        let ones = DMatrix::identity(basis.0[0].nrows(), basis.0[0].nrows());
        let expected = factors.iter().fold(ones, |g, x| g * hat(basis, x).exp());
        same(&basis.combine(found.components()).exp(), &expected, name);
        // the group chosen by its name, and near the identity the series, to 0.2^14
        let [x, y] = [&factors[0], &factors[1]].map(|x| column(x) * 0.1);
        let expected = (basis.combine(x.as_slice()).exp()) * basis.combine(y.as_slice()).exp();
        let chosen = AnyGroup::named(name).unwrap();
        let found = chosen.log(&chosen.compose(&chosen.exp(&x), &chosen.exp(&y))).unwrap();
        same(&basis.combine(found.as_slice()).exp(), &expected, name);
        let parts = group.algebra().unwrap().bch(x.as_slice(), y.as_slice(), 14).unwrap();
        let sum = |i: usize| parts.iter().map(|part| part[i]).sum::<f64>();
        let series = DVector::from_fn(group.dimension(), |i, _| sum(i));
        same(&basis.combine(series.as_slice()).exp(), &expected, name);
    }
    use affinor::group::{Se2, Se3};
    law("so(3)", &So3, &matrices::so3());
    law("se(2)", &Se2, &matrices::se2());
    law("se(3)", &Se3, &matrices::se3());
    law("sl(2)", &Sl2, &on_groups::sl2());
    law("aff(1)", &on_groups::affine(), &matrices::affine());

    // rotations, to length 8: half angles as in the product of quaternions
    let half = |x: Vector3<f64>| {
        let angle = x.norm() / 2.0;
        (angle.cos(), x * (angle.sin() / x.norm()))
    };
    let axes = [Vector3::new(1.0, 2.0, 2.0) / 3.0, Vector3::new(0.6, 0.0, -0.8)];
    for (a, b) in [(0.3, 0.5), (3.0, 2.0), (5.0, 8.0), (7.5, -6.4)] {
        let ((v, x), (w, y)) = (half(axes[0] * a), half(axes[1] * b));
        let (real, vector) = (v * w - x.dot(&y), y * v + x * w + x.cross(&y));
        let expected = vector.normalize() * (2.0 * (vector.norm() / real).atan());
        let found = product(&So3, &(axes[0] * a), &(axes[1] * b)).unwrap();
        assert!((found - expected).norm() < 1e-13, "{a} {b}: {found}");
        assert!(found.norm() <= PI);
    }
    // the branch at exactly pi: the first component that is not zero is positive
    for (quaternion, expected) in [
        ([-1.0, 0.0, 0.0], Vector3::x() * PI),
        ([0.0, -0.6, 0.8], Vector3::new(0.0, 0.6, -0.8) * PI),
        ([0.0, 0.0, -1.0], Vector3::z() * PI),
    ] {
        let half_turn =
            UnitQuaternion::new_unchecked(Quaternion::from_parts(0.0, Vector3::from(quaternion)));
        assert!((So3.log(&half_turn).unwrap() - expected).norm() < 1e-15);
    }
    // on SL(2,R) a product of exponentials need not be one
    let (p, q) = (Vector3::new(3.0, 0.0, 0.0), Vector3::new(0.0, -3.0, 0.0));
    assert!(matches!(product(&Sl2, &p, &q), Err(Error::Invalid { what: "logarithm", .. })));
}

#[test]
fn eq_74_rays_are_straight_in_canonical_coordinates() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let n = vectors(group)[2].clone();
        for s in [-1.2, 0.0, 0.4, 1.5] {
            let expected = column(&n) * s;
            let on_ray = group.log(&group.exp(&(n.clone() * s))).unwrap();
            equal(&column(&on_ray), &expected, name);
            // the one-parameter group by its matrix
            same(&phi(group, &on_ray), &(hat(basis, &n) * s).exp(), name);
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_76_to_79_phi_is_the_exponential_of_matrices() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [q, n, _] = vectors(group);
        // (77), (78)
        same(&phi(group, &q), &hat(basis, &q).exp(), name);
        same(&phi(group, &(n.clone() * 1.3)), &(hat(basis, &n) * 1.3).exp(), name);
        // (79)
        let ones = DMatrix::identity(basis.0[0].nrows(), basis.0[0].nrows());
        same(&phi(group, &(q.clone() * 0.0)), &ones, name);
        // (76): q e_i(e) means the left translate
        for (e, unit) in basis.0.iter().zip(group.basis()) {
            let field = InvariantField { side: Side::Left, vector: unit };
            let flow = |t: f64| group.matrix(&field.flow(group, &group.exp(&q), t));
            same(&rate(flow, 0.0), &(phi(group, &q) * e), name);
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_80_to_83_the_derivative_at_the_identity() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [x, bend, _] = vectors(group);
        // (80): any curve of coordinates with the velocity X at q = 0
        let q = |t: f64| x.clone() * t + bend.clone() * (t * t);
        let y = rate(|t| phi(group, &q(t)), 0.0);
        // (81)-(83): Y = X~
        same(&y, &hat(basis, &x), name);
        let velocity = Velocity::in_coordinates(group, &(x.clone() * 0.0), &x);
        equal(&column(&velocity.body), &column(&x), name);
        equal(&column(&velocity.spatial), &column(&x), name);
    }
    on_every_group!(law);
    // on so(3) X~ is spin(X): X~ b = X x b
    let (x, b) = (Vector3::new(1.0, -2.0, 3.0), Vector3::new(-4.0, 5.0, 6.0));
    let spin = rate(|t| phi(&So3, &(x * t)), 0.0);
    equal(&(spin * column(&b)), &column(&x.cross(&b)), "spin");
}

#[test]
fn eq_84_and_85_phi_takes_brackets_to_commutators() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [x, y, _] = vectors(group);
        let left = |v: &G::Vector| InvariantField { side: Side::Left, vector: v.clone() };
        let bracket = left(&x).bracket(group, &left(&y));
        // of left-invariant extensions, at any point
        let at = bracket.at(group, &group.exp(&y));
        equal(&column(&at), &commutator(basis, &x, &y), name);
        let (x_hat, y_hat) = (hat(basis, &x), hat(basis, &y));
        same(&hat(basis, &at), &(&x_hat * &y_hat - &y_hat * &x_hat), name);
        differ(&column(&at), &commutator(basis, &y, &x), name);
    }
    on_every_group!(law);
    let (x, y) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, 5.0, 6.0));
    assert_eq!(So3.bracket(&x, &y), Vector3::new(-3.0, 6.0, -3.0));
}

#[test]
fn after_86_the_derivative_elsewhere_takes_the_tangent_operator() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [q, dq, bend] = vectors(group);
        let (q, t) = (q * 1.4, 0.3);
        let at = |t: f64| q.clone() + dq.clone() * t + bend.clone() * (t * t);
        let (here, there) = (at(t), dq.clone() + bend.clone() * (2.0 * t));
        let (matrix, derivative) = (phi(group, &here), rate(|t| phi(group, &at(t)), t));
        // Q^-1 dQ = hat(T_left dq), dQ Q^-1 = hat(T_right dq)
        let left = group.tangent_left(&here, &there);
        let right = group.tangent_right(&here, &there);
        same(&(&matrix * hat(basis, &left)), &derivative, name);
        same(&(hat(basis, &right) * &matrix), &derivative, name);
        assert!(distance(&(&matrix * hat(basis, &right)), &derivative) > 1e-2, "{name}");
        // Y(Q) = Q X~(e) holds of left components X, not of dq
        let wrong = &matrix * hat(basis, &there);
        assert!(distance(&wrong, &derivative) > 1e-2, "{name}: Q spin(dq)");
        // Phi_*q = L_Q* Phi_*e L_{q^-1}*: T_left takes dq to the identity
        let velocity = Velocity::in_coordinates(group, &here, &there);
        assert_eq!((&velocity.body, &velocity.spatial), (&left, &right));
        let back = group.tangent_left_inverse(&here, &left).unwrap();
        equal(&column(&back), &column(&there), name);
        // T_right = Ad_Q T_left
        let moved = group.adjoint(&group.exp(&here), &left);
        equal(&column(&right), &column(&moved), name);
    }
    on_every_group!(law);
}

#[test]
fn eq_86_the_tangent_operator_of_rotations() {
    let q = Vector3::new(0.7, -1.9, 1.1);
    let (angle, spin) = (q.norm(), matrices::so3().combine(q.as_slice()));
    let [left, right] = [
        So3.operator_matrix(|v| So3.tangent_left(&q, v)),
        So3.operator_matrix(|v| So3.tangent_right(&q, v)),
    ];
    // 1 - (1 - cos)/th^2 q~ + (th - sin)/th^3 q~^2
    let closed = DMatrix::identity(3, 3) - &spin * ((1.0 - angle.cos()) / angle.powi(2))
        + &spin * &spin * ((angle - angle.sin()) / angle.powi(3));
    same(&left, &closed, "T_left");
    same(&right, &left.transpose(), "T_right = T_left^T");
    same(&right, &(phi(&So3, &q) * &left), "T_right = Q T_left");
    assert!(distance(&left, &right) > 0.1);
    // det T = 2 (1 - cos)/th^2: zero at 2 pi k alone
    let n = q / angle;
    for angle in [1e-4_f64, 0.5, 3.0, PI, 5.0, 9.0, TAU, 2.0 * TAU] {
        let t = So3.operator_matrix(|v| So3.tangent_left(&(n * angle), v));
        let expected = (2.0 * (angle / 2.0).sin() / angle).powi(2);
        assert!((t.determinant() - expected).abs() < 1e-14, "{angle}");
    }
}

#[test]
fn eq_87_to_90_both_algebras_have_the_same_constants() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let of_group = group.algebra().unwrap();
        // (87), (89): of the vectors by the library, of the matrices by their commutators
        let size = basis.0[0].nrows();
        let entries = basis.0.iter().map(|m| {
            let places = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
            let entry = |(i, j)| (i, j, Complex { re: m[(i, j)], im: 0.0 });
            places.map(entry).collect::<Vec<_>>()
        });
        let n = basis.0.len();
        let of_matrices =
            MatrixBasis::new(labels(n), size, entries.collect(), Tolerance::default()).unwrap();
        let of_matrices = of_matrices.bracket().unwrap();
        for at in (0..n * n * n).map(|at| [at / (n * n), at / n % n, at % n]) {
            let [here, there] = [of_group.structure(), of_matrices.structure()].map(|c| c.get(&at));
            assert!((here - there).abs() < 1e-14, "{name} {at:?}: {here}, {there}");
        }
        assert!(!of_group.structure().is_empty(), "{name}");
    }
    on_every_group!(law);
    // (88): spin matrices make the same group
    let spins = MatrixGroup::new(&matrices::so3().0).unwrap();
    let expected: Tensor<f64> = epsilons::<Rational>("1").map(Rational::to_f64);
    assert_tensors(So3.algebra().unwrap().structure(), &expected, "rotation vectors");
    for (at, value) in expected.components() {
        let found = spins.algebra().unwrap().structure().get(at.as_ref());
        assert!((found - value).abs() < 1e-14, "{at:?}");
    }
}
