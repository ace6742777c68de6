//! Products and logarithms of matrix groups are as accurate as their input determines, compared
//! with 60-digit arithmetic and closed forms; and the element of the algebra nearest to a matrix.

use crate::common::algebras::{by_table, catalogued};
use affinor::algebra::catalogue;
use affinor::group::{AnyGroup, LieGroup, MatrixGroup, MatrixNotation, TranslationSplit, registry};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

const EPS: f64 = f64::EPSILON;

/// The largest difference of a component, relative to the largest component.
fn relative(found: &DVector<f64>, exact: &DVector<f64>) -> f64 {
    (found - exact).amax() / exact.amax()
}

/// The groups and numbers of the stored lines of one kind.
fn stored(kind: &str) -> impl Iterator<Item = (AnyGroup, Vec<f64>, &'static str)> {
    include_str!("../../data/logarithms.txt").lines().filter_map(move |line| {
        let mut words = line.split(' ');
        let group = AnyGroup::named(words.next()?).expect("a group of the catalogue");
        let of_kind = words.next()? == kind;
        let numbers = words.map(|word| word.parse().expect("a number")).collect();
        of_kind.then_some((group, numbers, line))
    })
}

/// `log(exp(x) exp(y))` is accurate to rounding errors for vectors of all sizes, also if the
/// product is small, a large boost or near a half turn.
#[test]
fn products_have_all_digits() {
    let mut count = 0;
    for (group, numbers, line) in stored("product") {
        let n = group.dimension();
        let [x, y, z] = [0, 1, 2].map(|at| DVector::from_column_slice(&numbers[at * n..][..n]));
        let found = group.log_product(&x, &y).expect(line);
        assert!(relative(&found, &z) < 32.0 * EPS, "{line}: {found}");
        count += 1;
    }
    assert!(count > 100, "{count}");
}

/// The logarithm of a rounded matrix is as accurate as the rounded entries allow.
#[test]
fn logarithms_have_the_digits_of_their_entries() {
    let (mut count, mut sharp) = (0, 0);
    for (group, numbers, line) in stored("log") {
        let size = group.write(&group.identity()).nrows();
        let (g, x) = numbers.split_at(size * size);
        let g = group.read(&DMatrix::from_row_slice(size, size, g)).expect(line);
        let x = DVector::from_column_slice(x);
        let found = group.log(&g).expect(line);
        // nilpotent groups have closed forms, and do not estimate errors
        let bound = group.log_rounding(&g, &x).unwrap_or(0.0) / x.amax();
        let off = relative(&found, &x);
        assert!(off < 32.0 * EPS + bound, "{line}: {off:e}, {bound:e}");
        count += 1;
        sharp += usize::from(bound < 64.0 * EPS);
    }
    assert!(count > 50 && sharp > 30, "{count} {sharp}");
}

/// Rapidities add for boosts along an axis, and along any direction of the algebra whose elements
/// are hyperbolic.
#[test]
fn boosts_add() {
    let cases: [(&str, &[f64]); 6] = [
        ("so(2,1)", &[1.0, 0.0, 0.0]),
        ("so(2,1)", &[0.75, -0.625, 0.25]),
        ("so(3,1)", &[0.0, 1.0, 0.125, 0.0, 0.0, 0.0625]),
        ("so(2,2)", &[0.0, 0.625, 0.0, 0.0, -0.75, 0.0]),
        ("sl(3)", &[0.25, 0.125, -0.25, 0.25, 0.125, -0.25, 0.75, -0.25]),
        ("iso(2,1)", &[1.0, 0.0, 0.0, 0.25, -2.0, 0.5]),
    ];
    for (name, axis) in cases {
        let group = AnyGroup::named(name).unwrap();
        let axis = DVector::from_column_slice(axis);
        // multiples without rounding errors
        for s in [-14.0, -7.5, 0.5_f64.powi(20), 0.0625, 0.5, 3.0, 8.0, 14.0] {
            for t in [-8.0, -7.0, 0.0625, 0.25, 0.5, 3.0, 6.0] {
                let found = group.log_product(&(&axis * s), &(&axis * t)).unwrap();
                let sum = &axis * (s + t);
                // opposite vectors cancel to the rounding error of double-double numbers
                let bound = 128.0 * EPS * sum.amax() + 1e-24;
                assert!((&found - &sum).amax() <= bound, "{name} {s} {t}: {found}");
            }
        }
    }
}

/// The logarithm of the rounded `exp(x)` is `x`: accurate for boosts up to rapidity 14, whose
/// entries exceed a million.
#[test]
fn logarithms_of_boosts() {
    for (name, axis) in [("so(2,1)", 0), ("so(3,1)", 1), ("so(2,2)", 1), ("iso(3,1)", 1)] {
        let group = AnyGroup::named(name).unwrap();
        for size in (1..=28).map(|k| 0.5 * f64::from(k)) {
            let mut x = DVector::from_element(group.dimension(), 0.01);
            x[axis] = size;
            let g = group.exp(&x);
            let found = group.log(&g).unwrap();
            let bound = 64.0 * EPS + 4.0 * group.log_rounding(&g, &x).unwrap() / size;
            let off = relative(&found, &x);
            assert!(off < bound, "{name} {size}: {off:e}, {bound:e}");
        }
    }
}

/// `Ad_g log(exp(x) exp(y)) = log(exp(Ad_g x) exp(Ad_g y))`, and the product agrees with the
/// product in another basis of the column vectors.
#[test]
fn products_do_not_depend_on_bases() {
    for name in ["so(2,1)", "so(3,1)", "sl(3)", "sp(4)", "iso(2,1)", "gl(3)"] {
        let group = AnyGroup::named(name).unwrap();
        let vector = |size: f64, numbers: [f64; 5]| {
            DVector::from_fn(group.dimension(), |i, _| size * numbers[i % 5])
        };
        for size in [0.1, 1.0, 3.0] {
            let x = vector(size, [0.6, -0.5, 0.2, 0.7, 0.1]);
            let y = vector(size, [-0.2, 0.6, 0.1, -0.3, 0.4]);
            let Ok(product) = group.log_product(&x, &y) else { continue };
            let ad = group.adjoint_exp(&vector(0.5, [0.3, 0.7, -0.4, 0.2, 0.5]));
            let found = group.log_product(&(&ad * &x), &(&ad * &y)).unwrap();
            let expected = &ad * &product;
            // the images have rounding errors
            let bound = 64.0 * EPS * ad.norm().powi(2) * (4.0 * size).exp();
            assert!(relative(&found, &expected) < bound, "{name} {size}: {found} {expected}");

            let generators = group.generators();
            let m = generators[0].nrows();
            // unimodular, with integer entries: the generators have no rounding error
            let base = DMatrix::from_fn(m, m, |i, j| if i <= j { 1.0 } else { 0.0 });
            let back = DMatrix::from_fn(m, m, |i, j| match j.checked_sub(i) {
                Some(0) => 1.0,
                Some(1) => -1.0,
                _ => 0.0,
            });
            let images: Vec<_> = generators.iter().map(|b| &back * b * &base).collect();
            let image = MatrixGroup::new(&images).unwrap();
            let found = image.log_product(&x, &y).unwrap();
            assert!(relative(&found, &product) < 64.0 * EPS, "{name} {size}: {found} {product}");
        }
    }
}

/// Products are computed up to rapidities of 25, and are errors with a reason if double-double
/// numbers lose accuracy as well.
#[test]
fn products_of_any_size() {
    let group = AnyGroup::named("so(3,1)").unwrap();
    let mut rejected = 0;
    for size in [15.0, 20.0, 25.0, 60.0, 100.0, 500.0, 1e4] {
        let mut x = DVector::from_element(6, 0.0);
        x[1] = size;
        let mut y = &x * 1e-3;
        y[2] = 1e-3;
        match group.log_product(&x, &y) {
            Ok(z) => {
                let back = group.log_product(&z, &-&y).unwrap();
                assert!(relative(&back, &x) < 1e-13 * size, "{size}: {back}");
                assert!(size < 40.0);
            }
            Err(error) => {
                assert!(size > 25.0, "{size}: {error}");
                rejected += 1;
            }
        }
    }
    assert_eq!(rejected, 4);
}

/// Random numbers between -1 and 1.
fn number(at: usize) -> f64 {
    (at as f64 * 1.7 + 0.3).sin()
}

fn nearest(group: &MatrixGroup, name: &str) {
    let (n, generators) = (group.dimension(), group.generators());
    let x = DVector::from_fn(n, |i, _| number(i));
    let size = generators[0].nrows();
    let sum = generators.iter().zip(x.iter()).map(|(b, x)| b * *x);
    let sum = sum.fold(DMatrix::zeros(size, size), |sum: DMatrix<f64>, term| sum + term);
    assert!((group.generator(&x) - &sum).amax() < 1e-13, "{name}");
    assert!((group.components(&sum) - &x).amax() < 1e-11, "{name}");
    let any = DMatrix::from_fn(size, size, |i, j| number(i * size + j));
    let rest = &any - group.generator(&group.components(&any));
    for b in &generators {
        assert!(rest.dot(b).abs() < 1e-10 * b.norm() * any.norm(), "{name}: {}", rest.dot(b));
    }
    let small = &x * (0.1 / sum.norm());
    let g = group.exp(&small);
    group.expect_element(&g, 1e-9).unwrap();
    assert!(group.expect_element(&(&g + &any * 0.1), 1e-9).is_err(), "{name}");
}

/// Root vectors share no nonzero entry with others; in a dense basis all matrices overlap.
#[test]
fn nearest_in_sparse_and_dense_bases() {
    for name in ["so(3)", "sl(3)", "G2", "heisenberg(3)", "bianchi(IV)", "sl(2)+heisenberg(3)"] {
        let algebra = catalogued(name).map(|value| value.to_f64()).unwrap();
        nearest(&MatrixGroup::of_algebra(&algebra).unwrap(), name);
    }
    // t E_ij + s E_kl for many pairs of entries
    let dense: Vec<DMatrix<f64>> = {
        let turns = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| {
            let mut m = DMatrix::zeros(3, 3);
            (m[(i, j)], m[(j, i)]) = (1.0, -1.0);
            m
        });
        vec![&turns[0] + &turns[1], &turns[1] * 2.0 - &turns[2], &turns[0] + &turns[2] * 3.0]
    };
    nearest(&MatrixGroup::new(&dense).unwrap(), "so(3), dense");
}

/// The matrices of a group of the catalogue.
fn of_catalogue(name: &str) -> MatrixGroup {
    let entry = catalogue::find(name).unwrap();
    let dense =
        |m: &Matrix<Rational>| DMatrix::from_fn(m.rows(), m.columns(), |i, j| m.get(i, j).to_f64());
    let matrices: Vec<_> = entry.matrices.unwrap().matrices().iter().map(dense).collect();
    MatrixGroup::new(&matrices).unwrap()
}

/// Numbers between -1 and 1, the same in every run.
fn generic(n: usize, seed: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| (12.9898 * (i + 7 * seed + 1) as f64).sin())
}

/// The complex classical groups consist of their complex matrices `A + iB`, written as `[[A, -B],
/// [B, A]]`. The exponential is the exponential of complex matrices, and preserves the determinant
/// or the form.
#[test]
fn complex_classical_groups_act_by_their_matrices() {
    type Complex = nalgebra::Complex<f64>;
    for (name, n) in
        [("sl(2,C)", 2), ("sl(3,C)", 3), ("so(3,C)", 3), ("so(4,C)", 4), ("sp(4,C)", 4)]
    {
        let group = registry::find(name).unwrap();
        let real = of_catalogue(&name.replace(",C", ""));
        let dimension = real.dimension();
        assert_eq!(group.dimension(), 2 * dimension, "{name}");
        for seed in 0..5 {
            let x = generic(2 * dimension, seed) * 0.4;
            let g = group.write(&group.exp(&x));
            assert_eq!(g.shape(), (2 * n, 2 * n), "{name}");
            let complex = DMatrix::from_fn(n, n, |i, j| Complex::new(g[(i, j)], g[(n + i, j)]));
            let [re, im] =
                [0, dimension].map(|at| real.generator(&x.rows(at, dimension).into_owned()));
            let generator = DMatrix::from_fn(n, n, |i, j| Complex::new(re[(i, j)], im[(i, j)]));
            let (mut sum, mut term) = (DMatrix::identity(n, n), DMatrix::identity(n, n));
            for k in 1..60 {
                term = &term * &generator / Complex::new(f64::from(k), 0.0);
                sum += &term;
            }
            assert!((&complex - &sum).norm() < 1e-13 * sum.norm(), "{name}");
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let [a, b] = [g[(i, j)] - g[(n + i, n + j)], g[(n + i, j)] + g[(i, n + j)]];
                assert!(a.abs().max(b.abs()) < 1e-13, "{name}");
            }
            assert!((complex.determinant() - Complex::new(1.0, 0.0)).norm() < 1e-12, "{name}");
            let form = DMatrix::from_fn(n, n, |i, j| match &name[..2] {
                "so" if i == j => 1.0,
                "sp" if i + n / 2 == j => 1.0,
                "sp" if j + n / 2 == i => -1.0,
                _ => 0.0,
            });
            let form = form.map(|value| Complex::new(value, 0.0));
            let defect = complex.transpose() * &form * &complex - form;
            assert!(defect.norm() < 1e-12, "{name}");
            let back = group.log(&group.exp(&x)).unwrap();
            assert!((back - &x).norm() < 1e-11, "{name}");
        }
    }
}

/// Rotations by the largest angles below a half turn have logarithms if their entries determine the
/// direction: in SU(2) in all directions, in SO(4) in coordinate planes. Otherwise the error names
/// the distance from pi.
#[test]
fn the_largest_angles_below_a_half_turn() {
    let below = |ulps: f64| PI - ulps * 2.0 * f64::EPSILON;
    let su2 = of_catalogue("su(2)");
    for (seed, ulps) in [0.0, 1.0, 2.0, 9.0, 1e3, 1e6].into_iter().enumerate() {
        let (n, angle) = (generic(3, seed).normalize(), below(ulps));
        // N^2 = -1 for a unit vector
        let turn = su2.generator(&n) * 2.0;
        let g = DMatrix::identity(4, 4) * angle.cos() + turn * angle.sin();
        let x = su2.log(&g).unwrap();
        assert!((x - n * (2.0 * angle)).norm() < 1e-14, "{ulps}");
    }
    let so4 = of_catalogue("so(4)");
    let planes = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    for (at, (i, j)) in planes.into_iter().enumerate() {
        let (k, l) = planes[5 - at];
        for (first, second) in [(0.0, 1e15), (1.0, 3.0), (2.0, 5e14), (0.0, 0.0)] {
            for sign in [1.0, -1.0] {
                let mut g = DMatrix::zeros(4, 4);
                let mut expected = DMatrix::zeros(4, 4);
                for ((i, j), angle) in [((i, j), below(first)), ((k, l), sign * below(second))] {
                    g[(i, i)] = angle.cos();
                    g[(j, j)] = angle.cos();
                    g[(i, j)] = -angle.sin();
                    g[(j, i)] = angle.sin();
                    expected[(i, j)] = -angle;
                    expected[(j, i)] = angle;
                }
                let x = so4.log(&g).unwrap();
                assert!((so4.generator(&x) - expected).norm() < 1e-14, "{i}{j} {first} {second}");
            }
        }
    }
    // in other planes the rounding errors of entries determine the direction
    let basis = so4.exp(&generic(6, 1));
    let mut g = DMatrix::identity(4, 4);
    (g[(0, 0)], g[(1, 1)]) = (-1.0, -1.0);
    (g[(0, 1)], g[(1, 0)]) = (-below(0.0).sin(), below(0.0).sin());
    assert!(so4.log(&(&basis * g * basis.transpose())).is_err());
    // the direction of a half turn is not determined
    let mut g = DMatrix::identity(4, 4);
    (g[(0, 0)], g[(1, 1)]) = (-1.0, -1.0);
    let half_turn = so4.log(&g).unwrap_err().to_string();
    assert!(half_turn.contains("closed negative axis"), "{half_turn}");
}

/// Eigenvalues `3/2 exp(+-i (pi - gap))` and `1/2`: the logarithm is `ln(3/2) + (pi - gap) J` and `ln(1/2)` in the basis of
/// eigenvectors, at every distance from the negative axis. The distance and the skew of the basis multiply rounding errors.
#[test]
fn logarithms_up_to_the_negative_axis() {
    let gl3 = of_catalogue("gl(3)");
    for skew in [0.5, 2.0, 8.0] {
        let upper =
            DMatrix::from_row_slice(3, 3, &[1.0, skew, skew, 0.0, 1.0, skew, 0.0, 0.0, 1.0]);
        let lower =
            DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, 0.5, 1.0, 0.0, -0.25, 0.75, 1.0]);
        let basis = upper * lower;
        let back = basis.clone().try_inverse().unwrap();
        let condition = basis.norm() * back.norm();
        let matrix = |re: f64, im: f64, rest: f64| {
            let plane = [re, -im, 0.0, im, re, 0.0, 0.0, 0.0, rest];
            &basis * DMatrix::from_row_slice(3, 3, &plane) * &back
        };
        for gap in (0..8).map(|power| 0.1_f64.powi(power)) {
            let (sin, cos) = gap.sin_cos();
            let exact = matrix(1.5_f64.ln(), PI - gap, 0.5_f64.ln());
            let x = gl3.log(&matrix(-1.5 * cos, 1.5 * sin, 0.5)).unwrap();
            let off = (gl3.generator(&x) - &exact).norm() / exact.norm();
            assert!(off <= 16.0 * EPS * condition.powi(2) / gap, "{skew} {gap:e}: {off:e}");
        }
    }
}

/// Each condition of an element alone rejects a matrix that satisfies the others, far below the distances of other matrices.
#[test]
fn each_condition_of_an_element_rejects() {
    let diagonal = |entries: &[f64]| DMatrix::from_diagonal(&DVector::from_column_slice(entries));
    let group = |generators: &[DMatrix<f64>]| MatrixGroup::new(generators).unwrap();
    let refused = |group: &MatrixGroup, g: &DMatrix<f64>| {
        group.expect_element(g, 1e-6).unwrap_err().to_string()
    };
    let stretch = diagonal(&[1.0, -1.0, 0.0]);
    let line = group(std::slice::from_ref(&stretch));
    let g = affinor::numerics::exponential::exp(&stretch);
    assert!(line.expect_element(&g, 1e-6).is_ok());
    // traceless generators have the determinant 1, others a positive one
    assert!(refused(&line, &(&g * 1.0001)).contains("its determinant is 1.0003"));
    let any = group(&[diagonal(&[1.0, 0.0]), diagonal(&[0.0, 1.0])]);
    assert!(refused(&any, &diagonal(&[-2.0, 3.0])).contains("its determinant is -6"));
    assert!(any.expect_element(&diagonal(&[2.0, 3.0]), 1e-6).is_ok());
    // unimodular, and not orthogonal
    let shear = DMatrix::from_row_slice(3, 3, &[1.0, 1e-4, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let rotations = of_catalogue("so(3)");
    assert!(refused(&rotations, &shear).contains("Ad maps basis vector"));
    // commutes with the generator, whose multiples are all logarithms
    let beside = affinor::numerics::exponential::exp(&(diagonal(&[1.0, 1.0, -2.0]) * 1e-4));
    assert!(refused(&line, &(&g * beside)).contains("its logarithm has the distance 2.4"));
    // the centre of SU(3): only the third power has a logarithm in the algebra
    let su3 = of_catalogue("su(3)");
    let (sin, cos) = (2.0 * PI / 3.0).sin_cos();
    let third = DMatrix::from_fn(6, 6, |i, j| match (i % 3 == j % 3, i / 3, j / 3) {
        (false, ..) => 0.0,
        (true, 0, 1) => -sin,
        (true, 1, 0) => sin,
        _ => cos,
    });
    assert!(su3.expect_element(&third, 1e-6).is_ok());
}

/// The logarithm of a matrix that rounding took off the group is that of the nearest element. Matrices farther away have no logarithm.
#[test]
fn logarithms_beside_the_group() {
    let exp = affinor::numerics::exponential::exp;
    let diagonal = |entries: &[f64]| DMatrix::from_diagonal(&DVector::from_column_slice(entries));
    let stretch = diagonal(&[1.0, -1.0, 0.0]);
    let line = MatrixGroup::new(std::slice::from_ref(&stretch)).unwrap();
    let beside = |off: f64| line.log(&exp(&(&stretch * 0.5 + diagonal(&[0.1, 0.1, -0.2]) * off)));
    for off in [0.0, 1e-12, 1e-9, 1e-7] {
        let x = beside(off).unwrap();
        assert!((x[0] - 0.5).abs() <= 4.0 * off + 4.0 * EPS, "{off}: {x}");
    }
    for off in [1e-4, 1e-3, 1e-2] {
        let error = beside(off).unwrap_err().to_string();
        assert!(error.contains("from the algebra"), "{off}: {error}");
    }
}

/// A generator turns by an angle if its square is a negative multiple of a projection: of one frequency, not of two.
#[test]
fn angles_are_generators_of_one_frequency() {
    let generator = |entries: &[(usize, usize, f64)]| {
        let mut matrix = DMatrix::zeros(4, 4);
        entries.iter().for_each(|(i, j, value)| matrix[(*i, *j)] = *value);
        MatrixGroup::new(&[matrix]).unwrap().is_angle(0)
    };
    let plane = [(0, 1, -1.0), (1, 0, 1.0)];
    let other = |w: f64| [(2, 3, -w), (3, 2, w)];
    assert!(generator(&plane));
    assert!(generator(&[plane, other(1.0)].concat()));
    assert!(!generator(&[plane, other(2.0)].concat()));
    // a boost, a shear, and a turn that stretches
    assert!(!generator(&[(0, 1, 1.0), (1, 0, 1.0)]));
    assert!(!generator(&[(0, 1, 1.0)]));
    assert!(!generator(&[plane.to_vec(), vec![(0, 0, 0.5), (1, 1, 0.5)]].concat()));
}

/// Rotations of an ellipse with half axes 1 and `1/2` preserve the form `diag(1, 4)`, which gives the inverse.
#[test]
fn inverses_by_a_form() {
    let turn = DMatrix::from_row_slice(2, 2, &[0.0, -4.0, 1.0, 0.0]);
    let ellipse = MatrixGroup::new(&[turn]).unwrap();
    for angle in [0.1, 0.7, 2.0] {
        let x = DVector::from_element(1, angle);
        let (g, back) = (ellipse.exp(&x), ellipse.exp(&-x));
        assert!((ellipse.inverse(&g) - back).amax() < 16.0 * EPS, "{angle}");
    }
}

/// A rotation about a distant point: the angle has its digits beside translations of any length.
#[test]
fn components_of_distant_rotations() {
    for length in [1.0, 1e3, 1e6] {
        let entries = [[0.0, -1.0, length], [1.0, 0.0, -0.3 * length], [0.0, 0.0, 0.0]];
        let about = DMatrix::from_fn(3, 3, |i, j| entries[i][j]);
        let along = |row: usize| DMatrix::from_fn(3, 3, |i, j| f64::from((i, j) == (row, 2)));
        let plane = MatrixGroup::new(&[about, along(0), along(1)]).unwrap();
        for angle in [0.3, 0.7, 1.1, -2.3] {
            let x = DVector::from_vec(vec![angle, 0.7 * length, -0.2 * length]);
            let found = plane.components(&plane.generator(&x));
            assert!((found[0] - angle).abs() <= 4.0 * EPS, "{length}: {found}");
            assert!((found - &x).amax() <= 16.0 * EPS * length, "{length}");
        }
    }
}

/// The translations are the kernel of the Killing form, if it is abelian and has a complementary subalgebra.
#[test]
fn translations_need_a_complement() {
    // T and S act on a line each
    let unit = |i: usize, j: usize| DMatrix::from_fn(7, 7, |row, k| f64::from((row, k) == (i, j)));
    let lines = [unit(0, 0), unit(2, 2), unit(0, 1), unit(2, 3)];
    assert!(MatrixGroup::new(&lines).unwrap().has_translations());
    // [T, S] = Z is not a bracket of others, so T and S are in no complement
    let mut extended = lines.to_vec();
    extended[0] += unit(4, 5);
    extended[1] += unit(5, 6);
    extended.push(unit(4, 6));
    assert!(!MatrixGroup::new(&extended).unwrap().has_translations());
    // the kernel of the oscillator algebra is a Heisenberg algebra
    let oscillator = by_table(4, &[(1, 2, 3, 1), (1, 3, 2, -1), (2, 3, 4, 1)]);
    let oscillator = MatrixGroup::of_algebra(&oscillator.map(Rational::to_f64).unwrap());
    assert!(!oscillator.unwrap().has_translations());
    // screws J_i + e_i and translations e_i: J_i has the translational part 0, without rounding errors
    let mut basis = vec![];
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let mut screw = DMatrix::zeros(4, 4);
        (screw[(k, j)], screw[(j, k)], screw[(i, 3)]) = (1.0, -1.0, 1.0);
        basis.push(screw);
    }
    basis.extend((0..3).map(|i| DMatrix::from_fn(4, 4, |row, k| f64::from((row, k) == (i, 3)))));
    let motions = MatrixGroup::new(&basis).unwrap();
    for i in 0..3 {
        let unit = |at: usize| DVector::from_fn(6, |k, _| f64::from(k == at));
        let part = |x: &DVector<f64>| motions.translational_part(x).unwrap();
        assert_eq!([part(&unit(i)), part(&unit(3 + i))], [unit(3 + i), unit(3 + i)], "{i}");
    }
}
