//! The canonical connections over the algebra, (38)-(40), and their table in both frames.

use crate::common::labels;
use crate::paper::matrices::{self, represented};
use crate::paper::{
    affine, algebras, assert_tensors, epsilons, float, heisenberg, minus_quarter_c_c, se2, sl2,
    so3, tensor,
};
use affinor::{Canonical, Connection, Frame, LieAlgebra};
use affinor_tensors::{Down, Rational, Tensor, Up};
use nalgebra::DMatrix;

#[test]
fn eq_38_affinities_are_structure() {
    let plus = |algebra: &LieAlgebra<Rational>| Connection::canonical(algebra, Canonical::Plus);
    assert_tensors(plus(&so3()).gamma(), &epsilons("1"), "so(3)");
    let expected = tensor(2, [Up, Down, Down], &[([2, 1, 2], "1"), ([2, 2, 1], "-1")]);
    assert_tensors(plus(&affine()).gamma(), &expected, "aff(1)");
    let expected = tensor(
        3,
        [Up, Down, Down],
        &[([3, 1, 2], "1"), ([3, 2, 1], "-1"), ([2, 1, 3], "-1"), ([2, 3, 1], "1")],
    );
    assert_tensors(plus(&se2()).gamma(), &expected, "se(2)");
    for (name, algebra) in algebras() {
        assert_tensors(plus(&algebra).gamma(), algebra.structure(), name);
        // in the right frame the same connection has none
        assert!(plus(&algebra).in_right_frame(&algebra).unwrap().gamma().is_empty(), "{name}");
    }
}

#[test]
fn after_38_torsion_is_structure() {
    assert_tensors(
        &Connection::canonical(&so3(), Canonical::Plus).torsion(),
        &epsilons("1"),
        "so(3)",
    );
    for (name, algebra) in algebras() {
        let plus = Connection::canonical(&algebra, Canonical::Plus);
        assert_tensors(&plus.torsion(), algebra.structure(), name);
        // tau^i_jk = -Lambda^i_kj
        let transposed = plus.gamma().permute(&[0, 2, 1]).unwrap().map(|v| -v.clone());
        assert_tensors(&plus.torsion(), &transposed, name);
    }
}

#[test]
fn after_38_plus_is_flat_because_of_jacobi() {
    for (name, algebra) in algebras() {
        assert!(Connection::canonical(&algebra, Canonical::Plus).curvature().is_empty(), "{name}");
    }
    // [e1,e2] = e3, [e1,e3] = e1 violates Jacobi: [[e1,e2],e3] + [[e2,e3],e1] + [[e3,e1],e2] = -e3
    let c = tensor::<Rational, 3>(
        3,
        [Up, Down, Down],
        &[([3, 1, 2], "1"), ([3, 2, 1], "-1"), ([1, 1, 3], "1"), ([1, 3, 1], "-1")],
    );
    let frame = Frame::invariant(labels(3), c.clone()).unwrap();
    let connection = Connection::new(frame, c).unwrap();
    let curvature = connection.curvature();
    // R(e1,e3) e2 = [e1,[e3,e2]] - [e3,[e1,e2]] - [[e1,e3],e2] = 0 - 0 - [e1,e2]
    assert_eq!(curvature.get(&[2, 1, 0, 2]), Rational::from(-1));
}

#[test]
fn eq_39_structure_is_twice_the_affinities_of_zero() {
    let zero = |algebra: &LieAlgebra<Rational>| Connection::canonical(algebra, Canonical::Zero);
    assert_tensors(zero(&so3()).gamma(), &epsilons("1/2"), "so(3)");
    let expected = tensor(
        3,
        [Up, Down, Down],
        &[
            ([2, 1, 2], "1"),
            ([2, 2, 1], "-1"),
            ([3, 1, 3], "-1"),
            ([3, 3, 1], "1"),
            ([1, 2, 3], "1/2"),
            ([1, 3, 2], "-1/2"),
        ],
    );
    assert_tensors(zero(&sl2()).gamma(), &expected, "sl(2)");
    for (name, algebra) in algebras() {
        assert_tensors(
            &zero(&algebra).gamma().scale(&Rational::from(2)),
            algebra.structure(),
            name,
        );
    }
}

#[test]
fn after_39_zero_has_no_torsion() {
    for (name, algebra) in algebras() {
        assert!(Connection::canonical(&algebra, Canonical::Zero).torsion().is_empty(), "{name}");
        // the others have
        assert!(!Connection::canonical(&algebra, Canonical::Minus).torsion().is_empty(), "{name}");
    }
}

#[test]
fn eq_40_affinities_are_antisymmetric() {
    for (name, algebra) in algebras() {
        for which in [Canonical::Plus, Canonical::Zero] {
            let gamma = Connection::canonical(&algebra, which).gamma().clone();
            for (at, value) in gamma.components() {
                let mirror = gamma.get(&[at[0], at[2], at[1]]);
                assert_eq!(mirror, -value.clone(), "{name} {which:?} {at:?}");
            }
            assert!(!gamma.is_empty());
        }
    }
    // those of Levi-Civita are not: (J1 - J2 + J3)/(2 J1) and (-J1 - J2 + J3)/(2 J1), J = (1,1,2)
    let g = crate::paper::metric(&[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "2"]]);
    let gamma = Connection::levi_civita(so3().left_frame(), &g).unwrap().gamma().clone();
    assert_eq!(gamma.get(&[0, 1, 2]), Rational::from(1));
    assert_eq!(gamma.get(&[0, 2, 1]), Rational::from(0));
}

#[test]
fn after_40_curvature_of_zero_is_minus_a_quarter_c_c() {
    for (name, algebra) in algebras() {
        let zero = Connection::canonical(&algebra, Canonical::Zero);
        let found = zero.curvature();
        assert_tensors(found, &minus_quarter_c_c(algebra.structure()), name);
    }
    // two-step nilpotent: [[X,Y],Z] = 0
    let zero = |algebra: &LieAlgebra<Rational>| Connection::canonical(algebra, Canonical::Zero);
    assert!(zero(&heisenberg()).curvature().is_empty());
    assert_eq!(zero(&so3()).curvature().len(), 12);
    // sl(2) by hand: R(H,E)H = -1/4 [2E,H] = E, R(H,E)F = -1/4 [2E,F] = -1/2 H,
    // R(H,F)H = -1/4 [-2F,H] = F, R(H,F)E = -1/2 H, R(E,F)E = -1/4 [H,E] = -1/2 E, R(E,F)F = 1/2 F
    let half = [
        ([2, 1, 1, 2], ["1", "-1"]),
        ([1, 3, 1, 2], ["-1/2", "1/2"]),
        ([3, 1, 1, 3], ["1", "-1"]),
        ([1, 2, 1, 3], ["-1/2", "1/2"]),
        ([2, 2, 2, 3], ["-1/2", "1/2"]),
        ([3, 3, 2, 3], ["1/2", "-1/2"]),
    ];
    let both = half.iter().flat_map(|([i, j, k, l], [value, minus])| {
        [([*i, *j, *k, *l], *value), ([*i, *j, *l, *k], *minus)]
    });
    let expected = tensor(3, [Up, Down, Down, Down], &both.collect::<Vec<_>>());
    assert_tensors(zero(&sl2()).curvature(), &expected, "sl(2)");
}

#[test]
fn canonical_connections_in_both_frames() {
    // name, affinities in the left and in the right frame, torsion, all as multiples of c
    let table = [
        (Canonical::Plus, "1", "0", "1"),
        (Canonical::Zero, "1/2", "-1/2", "0"),
        (Canonical::Minus, "0", "-1", "-1"),
    ];
    for (name, algebra) in algebras() {
        let c = algebra.structure();
        let times_c = |share: &str| c.scale(&crate::paper::value(share));
        for (which, left, right, torsion) in table {
            let what = format!("{name} {which:?}");
            let in_left = Connection::canonical(&algebra, which);
            let in_right = in_left.in_right_frame(&algebra).unwrap();
            assert_tensors(in_left.gamma(), &times_c(left), &what);
            assert_tensors(in_right.gamma(), &times_c(right), &what);
            assert_tensors(in_right.frame().structure(), &times_c("-1"), &what);
            assert_tensors(&in_left.torsion(), &times_c(torsion), &what);
            // the same tensors: torsion and curvature of bi-invariant connections are invariant
            assert_tensors(&in_right.torsion(), &times_c(torsion), &what);
            let curvature = match which {
                Canonical::Zero => minus_quarter_c_c(c),
                _ => Tensor::zero(c.dimension(), &[Up, Down, Down, Down]).unwrap(),
            };
            assert_tensors(in_left.curvature(), &curvature, &what);
            assert_tensors(in_right.curvature(), &curvature, &what);
        }
    }
}

#[test]
fn canonical_transports_from_1_to_exp_are_right_left_and_half_translations() {
    let n = [0.3, -0.7, 0.5];
    for (name, algebra, basis) in represented() {
        let n = &n[..algebra.dimension()];
        let transport = |which| {
            let connection = Connection::canonical(&float(&algebra), which);
            connection.transport_generator(n).unwrap().to_dmatrix().unwrap().exp()
        };
        // left components at p of what right translation makes of u: p^-1 (u p)
        let p = basis.combine(n).exp();
        let right = basis.conjugation(&matrices::inverse(&p), &p);
        matrices::assert_close(&transport(Canonical::Plus), &right, name);
        let root = basis.combine(&n.iter().map(|x| x / 2.0).collect::<Vec<_>>()).exp();
        let half = basis.conjugation(&matrices::inverse(&root), &root);
        matrices::assert_close(&transport(Canonical::Zero), &half, name);
        let size = algebra.dimension();
        matrices::assert_close(&transport(Canonical::Minus), &DMatrix::identity(size, size), name);
    }
}
