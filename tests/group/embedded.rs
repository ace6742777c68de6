//! Embedding coordinates, projection to the group, and `Ad*`, on every group.

use affinor::group::{
    AnyGroup, Coordinates, Embedded, Heisenberg, LieGroup, MatrixGroup, Opposite, Product, Se2,
    Se3, Se23, Sl2, So2, So3, Translations,
};
use nalgebra::{
    Const, DMatrix, DVector, Isometry3, SVector, UnitQuaternion, Vector2, Vector3, Vector6,
};

/// The group's `Ad*` agrees with the transpose of `Ad`; elements off the group are projected back.
#[test]
fn coadjoint_and_restored() {
    fn check<G: LieGroup>(group: G, x: &G::Vector, grown: impl Fn(G::Element) -> G::Element) {
        let g = group.exp(x);
        for i in 0..group.dimension() {
            let h = group.basis_vector(i) * 2.0 + x.clone();
            let h = group.coadjoint(&g, &h).components().to_vec();
            let expected = group.operator_matrix(|v| group.adjoint(&g, v)).transpose()
                * DVector::from_column_slice(
                    (group.basis_vector(i) * 2.0 + x.clone()).components(),
                );
            assert!((DVector::from_vec(h) - expected).amax() < 1e-14);
        }
        // angles up to the end of the series for small angles, and beyond
        for size in [1e-3, 0.3, 1.0, 30.0] {
            let (x, h) = (x.clone() * size, group.basis_vector(0) * 2.0 + x.clone());
            let off = group.coadjoint_exp(&x, &h) - group.coadjoint(&group.exp(&x), &h);
            let scale = 1.0 + group.matrix(&group.exp(&x)).amax().powi(2);
            assert!(off.largest() < 1e-14 * scale, "{x:?}: {off:?}");
        }
        let restored = group.project(grown(g.clone()));
        assert!((group.matrix(&restored) - group.matrix(&g)).amax() < 1e-15);
    }
    let grown = |q: UnitQuaternion<f64>| UnitQuaternion::new_unchecked(q.into_inner() * 1.001);
    check(So3, &Vector3::new(0.3, -1.0, 2.0), grown);
    check(Se3, &Vector6::new(0.3, -1.0, 2.0, 0.5, 0.6, -0.7), |mut g| {
        g.rotation = grown(g.rotation);
        g
    });
    check(Se23, &SVector::from_fn(|i, _| 0.3 * i as f64 - 0.8), |mut g| {
        g.attitude = grown(g.attitude);
        g
    });
    check(Sl2, &Vector3::new(0.3, -0.5, 0.2), |g| g * 1.001);
    check(Opposite(Sl2), &Vector3::new(0.3, -0.5, 0.2), |g| g * 1.001);
    check(Opposite(So3), &Vector3::new(0.3, -1.0, 2.0), grown);
    let x = DVector::from_vec(vec![0.3, -1.0, 2.0, 0.5, -0.6]);
    check(Product(So3, Translations(Const::<2>)), &x, |(q, place)| (grown(q), place));
    let x = DVector::from_vec(vec![0.3, -0.5, 0.2, 0.3, -1.0, 2.0]);
    check(Product(Sl2, Opposite(So3)), &x, |(g, q)| (g * 1.001, grown(q)));
    check(Heisenberg::<Const<3>>::new(), &Vector3::new(0.3, -0.5, 0.2), |g| g);
    let x = Vector2::new(1.0, 2.0);
    check(Se2, &Vector3::new(0.3, x.x, x.y), |mut g| {
        g.rotation = nalgebra::UnitComplex::new_unchecked(g.rotation.into_inner() * 1.001);
        g
    });
}

/// `exp(ad_x)` of boosts has a closed form; for small vectors it is `Ad` of the exponential, on
/// every group of the registry.
#[test]
fn adjoint_of_an_exponential() {
    let lorentz = AnyGroup::named("so(2,1)+se3").unwrap();
    for boost in [1.0_f64, 12.0, 20.0, 300.0] {
        let mut x = DVector::zeros(9);
        x[0] = boost;
        let ad = lorentz.adjoint_exp(&x);
        let mut expected = DMatrix::identity(9, 9);
        let [c, s] = [boost.cosh(), boost.sinh()];
        expected.view_mut((1, 1), (2, 2)).copy_from_slice(&[c, -s, -s, c]);
        let off = ad.zip_map(&expected, |a, b| (a - b).abs() / (1.0 + b.abs())).amax();
        assert!(off < 1e-14 * boost, "{boost}: {off:e}");
    }
    for name in ["so3", "se3", "se_2(3)", "sl2", "heisenberg(5)", "gl(2)", "so(4)", "aff(1)+so3"] {
        let group = AnyGroup::named(name).unwrap();
        let x = DVector::from_fn(group.dimension(), |i, _| [0.3, -0.5, 0.2, 0.7][i % 4]);
        let g = group.exp(&x);
        let expected = group.operator_matrix(|v| group.adjoint(&g, v));
        assert!((group.adjoint_exp(&x) - expected).amax() < 1e-13, "{name}");
        let y = &x * 0.5 + DVector::repeat(x.len(), 0.1);
        let product = group.log(&group.compose(&g, &group.exp(&y))).unwrap();
        assert!((group.log_product(&x, &y).unwrap() - product).amax() < 1e-14, "{name}");
    }
}

/// Groups that preserve a form, also in a basis of other lengths, invert elements by the form. So
/// `Ad` of a large element has the rounding error of its terms, `eps |g|^2`.
#[test]
fn inverses_by_a_form() {
    let stretched = |lengths: [f64; 3]| {
        let generator = |i: usize, j: usize, sign: f64| {
            let mut matrix = DMatrix::zeros(3, 3);
            matrix[(i, j)] = lengths[j] / lengths[i];
            matrix[(j, i)] = sign * lengths[i] / lengths[j];
            matrix
        };
        MatrixGroup::new(&[generator(0, 1, -1.0), generator(0, 2, 1.0), generator(1, 2, 1.0)])
            .unwrap()
    };
    for lengths in [[1.0, 1.0, 1.0], [1.0, 3.0, 1.0], [0.5, 7.0, 0.3]] {
        let group = stretched(lengths);
        for size in [1e-3, 1.0, 5.0, 10.0, 15.0] {
            let x = DVector::from_vec(vec![0.4 * size, size, -0.3 * size]);
            let g = group.exp(&x);
            let one = group.compose(&g, &group.inverse(&g));
            let rounding = 64.0 * f64::EPSILON * (1.0 + size) * g.norm() * group.inverse(&g).norm();
            assert!((one - DMatrix::identity(3, 3)).amax() < rounding, "{lengths:?} {size}");
            let off = group.operator_matrix(|v| group.adjoint(&g, v)) - group.adjoint_exp(&x);
            assert!(off.amax() < 16.0 * rounding, "{lengths:?} {size}: {:e}", off.amax());
        }
    }
}

/// `exp(x) exp(-x) = 1` for every size of `x`, or the product is an error.
#[test]
fn products_that_lose_their_digits() {
    let x = DVector::from_vec(vec![6.0, 16.0, 8.0, -4.0]);
    let group = AnyGroup::named("gl(2)").unwrap();
    let mut refused = 0;
    for k in 1..=40 {
        let x = &x * (0.1 * f64::from(k));
        match group.log_product(&x, &-&x) {
            Ok(product) => assert!(product.amax() < 1e-6, "{k}: {product}"),
            Err(error) => {
                assert!(error.to_string().contains("are too large"), "{k}: {error}");
                refused += 1;
            }
        }
    }
    assert!((20..30).contains(&refused), "{refused}");
}

/// Products of small vectors are accurate: compared with the Baker-Campbell-Hausdorff series up to
/// third order.
#[test]
fn products_of_small_vectors() {
    for name in ["so3", "se3", "sl2", "gl(2)", "so(4)", "so(2,1)", "sim(2)", "hom(2)", "aff(1)+sl2"]
    {
        let group = AnyGroup::named(name).unwrap();
        for size in [1e-150, 1e-12, 1e-8, 1e-5] {
            let vector = |numbers: [f64; 5]| {
                DVector::from_fn(group.dimension(), |i, _| size * numbers[i % 5])
            };
            let (x, y) = (vector([0.3, -0.5, 0.2, 0.7, 0.0]), vector([-0.2, 0.6, 0.1, -0.9, 0.4]));
            let xy = group.bracket(&x, &y);
            let third = group.bracket(&x, &xy) - group.bracket(&y, &xy);
            let expected = &x + &y + xy * 0.5 + third / 12.0;
            let off = (group.log_product(&x, &y).unwrap() - expected).amax() / size;
            assert!(off < 8.0 * f64::EPSILON + 4.0 * size.powi(3), "{name}, {size:e}: {off:e}");
        }
    }
    // near the size up to which factors are computed minus 1
    let group = AnyGroup::named("gl(2)").unwrap();
    for norm in [0.1, 0.499, 0.501, 0.9] {
        let [x, y] = [[0.5, 0.1, -0.7, 0.5], [0.1, 0.7, 0.5, -0.5]]
            .map(|numbers| DVector::from_column_slice(&numbers) * norm);
        let product = group.compose(&group.exp(&x), &group.exp(&y));
        let off = group.log_product(&x, &y).unwrap() - group.log(&product).unwrap();
        assert!(off.amax() < 1e-14, "{norm}: {off}");
    }
}

/// `exp(s x) exp(t x) = exp((s + t) x)` on SL(2), or the product is an error.
#[test]
fn products_along_subgroups() {
    let directions = [
        Vector3::new(1.0, 1.0, 0.5),
        Vector3::new(1.0, -1.0, 0.2),
        Vector3::new(1.0, -0.04, 0.2),
        Vector3::new(3.0, 0.0, 0.2),
        Vector3::new(1e3, 1e-3, 0.3),
    ];
    let (mut refused, mut right) = (0, 0);
    for x in directions {
        // with angles of at most pi
        let angle = f64::max(-x[2] * x[2] - x[0] * x[1], 0.0).sqrt();
        for s in [-30.0, -17.0, -3.0, -1e-9, 0.5, 2.9, 3.0, 16.0, 31.0] {
            for t in [-31.0, -16.0, -2.9, 0.3, 1e-7, 17.0, 29.0] {
                if f64::abs(s + t) * angle >= 3.0 {
                    continue;
                }
                let sum = x * (s + t);
                match Sl2.log_product(&(x * s), &(x * t)) {
                    Ok(product) => {
                        let off = (product - sum).amax() / (1.0 + sum.amax());
                        assert!(off < 1e-6, "{x:?} {s} {t}: {off:e}");
                        right += 1;
                    }
                    Err(error) => {
                        let reason = error.to_string();
                        assert!(reason.contains("too large") || angle > 0.0, "{x:?}: {reason}");
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(refused > 20 && right > 150, "{refused} {right}");
    // the error for a sum of large vectors is not larger than the rounding error of the sum
    for size in [1e9, 1e11, 1e200] {
        let x = Vector3::new(size, 0.0, 0.0);
        assert_eq!(Sl2.log_product(&x, &-x).unwrap(), Vector3::zeros(), "{size:e}");
    }
}

/// Embedding coordinates round-trip, and `rate` agrees with finite differences, on left- and
/// right-invariant groups.
#[test]
fn numbers_of_elements() {
    fn check<G: Embedded>(group: G) {
        let x = G::Vector::from_fn(group.dimension(), |i| [0.3, -0.5, 0.2, 0.7][i % 4]);
        let v = G::Vector::from_fn(group.dimension(), |i| [0.4, 0.1, -0.6][i % 3]);
        let g = group.exp(&x);
        let again = group.from_coordinates(&group.coordinates(&g));
        assert_eq!(group.matrix(&again), group.matrix(&g));
        let at = |t: f64| group.coordinates(&group.compose(&g, &group.exp(&(v.clone() * t))));
        let step = 1e-4;
        // Richardson's extrapolation of central differences
        let difference = |h: f64| (at(h) - at(-h)) * (0.5 / h);
        let slope = difference(step) * (4.0 / 3.0) - difference(2.0 * step) * (1.0 / 3.0);
        let off = slope - group.rate(&g, &v);
        assert!(off.largest() < 1e-11, "{off:?}");
    }
    check(So2);
    check(So3);
    check(Se2);
    check(Se3);
    check(Se23);
    check(Sl2);
    check(Heisenberg::<Const<5>>::new());
    check(Opposite(So3));
    check(Opposite(Se3));
    check(Opposite(Sl2));
}

/// In a basis that mixes rotations with translations, the coordinates of a matrix are accurate for
/// rotations, in any unit of length.
#[test]
fn rotations_beside_long_translations() {
    for length in [1e-6, 1.0, 1e3, 1e6] {
        let mut basis = vec![DMatrix::zeros(4, 4); 6];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            (basis[i][(k, j)], basis[i][(j, k)]) = (1.0, -1.0);
            basis[i + 3][(i, 3)] = 1.0;
        }
        basis[0] = &basis[0] + &basis[3] * (0.5 * length);
        basis[2] = &basis[2] + &basis[4] * (-0.25 * length) + &basis[0];
        let group = MatrixGroup::new(&basis).unwrap();
        let x = DVector::from_vec(vec![1.2, -0.7, 0.4, -0.6 * length, 0.3 * length, 0.1 * length]);
        let again = group.components(&group.generator(&x));
        for i in 0..6 {
            let off = (again[i] - x[i]).abs();
            let terms = if i < 3 { 1.0 } else { 1.0 + length };
            assert!(off <= 4.0 * f64::EPSILON * terms, "{length}: {again}");
        }
    }
}

/// Elements that nearly coincide have a mean, near the identity and far from it.
#[test]
fn means_of_close_elements() {
    let g = So3.exp(&Vector3::new(0.3, -0.7, 0.4));
    assert!(So3.mean(&[g, g, g]).unwrap().angle_to(&g) < 1e-15);
    for place in [0.0, 1.0, 1e3, 6.4e6] {
        for scatter in [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.1] {
            for turn in 0..20 {
                let angle = |k: usize| (f64::from(turn) + 0.7 * k as f64).sin();
                let pose = |k: usize| {
                    let [position, rotation] =
                        [3, 6].map(|from| Vector3::from_fn(|i, _| angle(20 + k * 9 + i + from)));
                    let origin = Vector3::from_fn(|i, _| place * angle(i));
                    let attitude = Vector3::from_fn(|i, _| angle(i + 3));
                    Isometry3::new(origin + position * scatter, attitude + rotation * scatter)
                };
                let poses: Vec<_> = (0..10).map(pose).collect();
                let mean = Se3.mean(&poses).unwrap_or_else(|e| panic!("{place} {scatter}: {e}"));
                let off = Se3.log(&Se3.between(&poses[0], &mean)).unwrap().amax();
                assert!(off < 10.0 * scatter + 1e-14 * (1.0 + place), "{place} {scatter}: {off}");
            }
        }
    }
}
