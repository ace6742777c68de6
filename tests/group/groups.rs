//! Every group satisfies the laws of a Lie group: axioms, exp and log, Ad and ad, tangent
//! operators.

mod matrix_group;
mod so3;

use crate::common::algebras::{by_table, catalogued};
use crate::common::{labels, property::properties};
use affinor::algebra::Complex;
use affinor::group::fields::{InvariantField, Side, right_translate};
use affinor::group::transport::ParallelTranslation;
use affinor::group::{
    AnyGroup, Coordinates, Embedded, Heisenberg, Homotheties, LieGroup, MatrixGroup,
    MatrixNotation, Nilpotent, Opposite, Product, Se2, Se3, Se23, Sl2, So2, So3, TranslationSplit,
    Translations, laws, registry,
};
use affinor::{CanonicalConnection, Connection, Error, Law, LieAlgebra, MatrixBasis};
use affinor_tensors::Tolerance;
use nalgebra::{Const, DMatrix, DVector, Matrix2, SVector, UnitQuaternion, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;

fn norm<V: Coordinates>(x: &V) -> f64 {
    DVector::from_column_slice(x.components()).norm()
}

/// Compares numbers relative to their own size, which may be as large as that of `exp(x) exp(y)`.
fn close<V: Coordinates>(x: &V, y: &V, tolerance: f64) {
    let (off, size) = (norm(&(x.clone() - y.clone())), 1.0 + norm(x) + norm(y));
    assert!(off <= tolerance * size, "{x:?} and {y:?} differ by {off:e}");
}

fn near(a: &DMatrix<f64>, b: &DMatrix<f64>, tolerance: f64) {
    let (off, size) = ((a - b).norm(), 1.0 + a.norm() + b.norm());
    assert!(off <= tolerance * size, "{a}and {b}differ by {off:e}");
}

fn ad<G: LieGroup>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    group.operator_matrix(|v| group.bracket(x, v))
}

/// The commutator of the flows of `X` and `Y` is `s^2 [X, Y] + O(s^3)`; the mean over `s` and `-s`
/// cancels the odd orders.
fn commutator_of_flows<G: LieGroup>(
    group: &G,
    g: &G::Element,
    [x, y]: [&InvariantField<G::Vector>; 2],
) -> G::Vector {
    let around = |s: f64| {
        let legs = [(x, s), (y, s), (x, -s), (y, -s)];
        let end = legs.iter().fold(g.clone(), |at, (field, s)| field.flow(group, &at, *s));
        group.log(&group.compose(&group.inverse(g), &end)).unwrap()
    };
    let s = 1e-3;
    (around(s) + around(-s)) * (0.5 / (s * s))
}

fn fields<G: LieGroup>(group: &G, [x, y, v]: [&G::Vector; 3]) {
    let g = group.exp(v);
    for (first, second) in
        [(Side::Left, Side::Left), (Side::Right, Side::Right), (Side::Left, Side::Right)]
    {
        let x = InvariantField { side: first, vector: x.clone() };
        let y = InvariantField { side: second, vector: y.clone() };
        let measured = commutator_of_flows(group, &g, [&x, &y]);
        close(&measured, &x.bracket(group, &y).at(group, &g), 1e-4);
        // a field is the velocity of its flow
        let s = 1e-4;
        let step = |s: f64| {
            let end = y.flow(group, &g, s);
            group.log(&group.compose(&group.inverse(&g), &end)).unwrap()
        };
        close(&((step(s) - step(-s)) * (0.5 / s)), &y.at(group, &g), 1e-6);
    }
    // right translation by h of a curve through g with the velocity v
    let (h, s) = (group.exp(x), 1e-4);
    let gh = group.compose(&g, &h);
    let curve = |s: f64| {
        let end = group.compose(&group.compose(&g, &group.exp(&(y.clone() * s))), &h);
        group.log(&group.compose(&group.inverse(&gh), &end)).unwrap()
    };
    close(&((curve(s) - curve(-s)) * (0.5 / s)), &right_translate(group, y, &h), 1e-6);
    let there = group.adjoint(&g, y);
    close(&InvariantField { side: Side::Right, vector: there }.at(group, &g), y, 1e-11);
}

fn vectors<G: LieGroup>(group: &G, numbers: &[f64]) -> [G::Vector; 3] {
    let n = group.dimension();
    [0, 1, 2].map(|at| G::Vector::from_components(&numbers[at * n..(at + 1) * n]))
}

fn obeys<G: TranslationSplit>(group: &G, numbers: &[f64]) {
    let [x, y, z] = vectors(group, numbers);
    laws::all(group, &x, &y, &z).unwrap();
    laws::translations(group, &x, &y, &z).unwrap();
    fields(group, [&x, &y, &z]);
}

fn represented<G: LieGroup>(group: &G, numbers: &[f64]) {
    let [x, y, _] = vectors(group, numbers);
    laws::represented(group, &x, &y).unwrap();
}

/// A test of all laws for each group, and for its opposite.
macro_rules! laws {
    ($($name:ident: $group:expr;)*) => {
        properties! {
            #![cases(48)]
            $(
                #[test]
                fn $name(numbers in vec(-1.0..1.0f64, 36)) {
                    let group = $group;
                    obeys(&group, &numbers);
                    represented(&group, &numbers);
                    // the opposite group, whose matrices reverse products, and its opposite
                    let opposite = Opposite(group);
                    obeys(&opposite, &numbers);
                    represented(&Opposite(opposite), &numbers);
                }
            )*
        }
    };
}

laws! {
    so2: So2;
    so3: So3;
    se2: Se2;
    se3: Se3;
    se23: Se23;
    sl2: Sl2;
    heisenberg_3: Heisenberg::<Const<3>>::new();
    heisenberg_5: Heisenberg::<Const<5>>::new();
    homotheties_2: Homotheties::<Const<2>>::new();
    homotheties_4: Homotheties::<Const<4>>::new();
    translations: Translations(Const::<3>);
    position_and_attitude: Product(Translations(Const::<3>), So3);
    product_of_products: Product(Product(Sl2, So2), Heisenberg::<Const<3>>::new());
    filiform: Nilpotent::new(floats("filiform")).unwrap();
    unitriangular: Nilpotent::new(floats("unitriangular")).unwrap();
    matrices_of_so3: matrices(&spins());
    matrices_of_gl2: matrices(&units(2));
    matrices_of_the_affine_line: matrices(&units(2)[..2]);
    su2: MatrixGroup::from_basis(&pauli()).unwrap();
    erased_extended_poses: AnyGroup::new(Se23);
    erased_product: AnyGroup::new(Product(Se3, Translations(Const::<2>)));
    adjoint_so3: MatrixGroup::adjoint(&floats("so(3)")).unwrap();
    adjoint_sl2: MatrixGroup::adjoint(&floats("sl(2)")).unwrap();
    with_centre: MatrixGroup::of_algebra(&floats("so(3)+R^2")).unwrap();
    with_central_brackets: MatrixGroup::of_algebra(&floats("so(3)+heisenberg(3)")).unwrap();
    adjoint_affine: MatrixGroup::adjoint(&floats("aff(1)+aff(1)")).unwrap();
    by_name_se23: AnyGroup::named("se_2(3)").unwrap();
    by_name_sum: AnyGroup::named("so3 + R^3 + so2").unwrap();
    by_name_nilpotent: AnyGroup::named("heisenberg(5) + R^2").unwrap();
    by_name_homotheties: AnyGroup::named("hom(3)").unwrap();
    by_name_rigid_bodies: AnyGroup::named("se3+se3").unwrap();
    by_name_matrices: AnyGroup::named("sl2+su(2)").unwrap();
}

fn floats(name: &str) -> LieAlgebra<f64> {
    let algebra = match name {
        "filiform" => by_table(5, &[(1, 2, 3, 1), (1, 3, 4, 1), (1, 4, 5, 1)]),
        "unitriangular" => by_table(6, &[(1, 2, 4, 1), (2, 3, 5, 1), (1, 5, 6, 1), (4, 3, 6, 1)]),
        _ => catalogued(name),
    };
    algebra.map(|v| v.to_f64()).unwrap()
}

fn matrices(basis: &[DMatrix<f64>]) -> MatrixGroup {
    MatrixGroup::new(basis).unwrap()
}

/// The matrices `E_ij`, row by row.
fn units(n: usize) -> Vec<DMatrix<f64>> {
    let unit = |at: usize| DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i * n + j == at)));
    (0..n * n).map(unit).collect()
}

/// The Pauli matrices times `-i/2`.
fn pauli() -> MatrixBasis<f64> {
    let real = |re| Complex { re, im: 0.0 };
    let imaginary = |im| Complex { re: 0.0, im };
    let matrices = vec![
        vec![(0, 1, imaginary(-0.5)), (1, 0, imaginary(-0.5))],
        vec![(0, 1, real(-0.5)), (1, 0, real(0.5))],
        vec![(0, 0, imaginary(-0.5)), (1, 1, imaginary(0.5))],
    ];
    MatrixBasis::new(labels(3), 2, matrices, Tolerance::default()).unwrap()
}

fn spins() -> Vec<DMatrix<f64>> {
    let spin = |e: Vector3<f64>| DMatrix::from_column_slice(3, 3, e.cross_matrix().as_slice());
    [Vector3::x(), Vector3::y(), Vector3::z()].map(spin).to_vec()
}

#[test]
fn brackets_are_those_of_the_catalogue() {
    fn agree<G: LieGroup>(group: &G, algebra: &LieAlgebra<f64>) {
        let basis = group.basis();
        assert_eq!(basis.len(), algebra.dimension());
        for (j, x) in basis.iter().enumerate() {
            for (k, y) in basis.iter().enumerate() {
                let bracket = group.bracket(x, y);
                for (i, value) in bracket.components().iter().enumerate() {
                    let expected = algebra.structure_constants().get(&[i, j, k]);
                    assert!((value - expected).abs() < 1e-14, "c^{i}_{j}{k} = {value}");
                }
            }
        }
    }
    agree(&So2, &floats("R^1"));
    agree(&So3, &floats("so(3)"));
    agree(&Translations(Const::<2>), &floats("R^2"));
    agree(&Product(So3, Sl2), &floats("so(3)+sl(2)"));
    agree(&Se2, &floats("se(2)"));
    agree(&Se3, &floats("se(3)"));
    agree(&Sl2, &floats("sl(2)"));
    agree(&Heisenberg::<Const<3>>::new(), &floats("heisenberg(3)"));
    agree(&Heisenberg::<Const<7>>::new(), &floats("heisenberg(7)"));
    agree(&Homotheties::<Const<2>>::new(), &floats("hom(1)"));
    agree(&Homotheties::<Const<4>>::new(), &floats("hom(3)"));
    agree(&matrices(&spins()), &floats("so(3)"));
    agree(&matrices(&units(3)), &floats("gl(3)"));
    agree(&MatrixGroup::from_basis(&pauli()).unwrap(), &floats("so(3)"));
    for name in ["so(3)", "sl(2)", "se(2)", "so(2,1)"] {
        agree(&MatrixGroup::adjoint(&floats(name)).unwrap(), &floats(name));
    }
    // SE_2(3): SE(3) in rotation and velocity, and in rotation and position
    let se3 = |at: usize| {
        move |x: &SVector<f64, 9>| -> SVector<f64, 6> {
            SVector::from_fn(|i, _| if i < 3 { x[i] } else { x[i + at] })
        }
    };
    for x in Se23.basis() {
        for y in Se23.basis() {
            for part in [se3(0), se3(3)] {
                assert_eq!(part(&Se23.bracket(&x, &y)), Se3.bracket(&part(&x), &part(&y)));
            }
        }
    }
}

/// A group of matrices in any basis has the structure constants of its algebra, including zeros.
#[test]
fn matrix_groups_know_their_algebra() {
    assert_eq!(matrices(&spins()).algebra().unwrap().structure_constants().len(), 6);
    // 27 products E_ij E_jl, in both orders, without the squares E_ii E_ii
    assert_eq!(matrices(&units(3)).algebra().unwrap().structure_constants().len(), 2 * 27 - 2 * 3);
    let mixed: Vec<_> = (0..3)
        .map(|a| {
            let terms = spins().into_iter().enumerate();
            terms.map(|(i, m)| m * (1.0 + 0.7 * (3.0 * i as f64 + a as f64).sin())).sum()
        })
        .collect();
    let group = matrices(&mixed);
    let algebra = group.algebra().unwrap();
    for (j, k) in (0..3).flat_map(|j| (0..3).map(move |k| (j, k))) {
        let bracket = group.bracket(&group.basis()[j], &group.basis()[k]);
        for i in 0..3 {
            assert!((algebra.structure_constants().get(&[i, j, k]) - bracket[i]).abs() < 1e-13);
        }
    }
}

/// Closed forms agree with the independent code for matrices.
#[test]
fn closed_forms_agree_with_matrix_groups() {
    fn agree<G: LieGroup>(group: &G, numbers: &[f64]) {
        let x = G::Vector::from_components(numbers);
        let basis: Vec<DMatrix<f64>> = group
            .basis()
            .iter()
            .map(|e| {
                let part = |t: f64| group.matrix(&group.exp(&(e.clone() * t)));
                let difference = |h: f64| (part(h) - part(-h)) / (2.0 * h);
                let h = 1e-2;
                // accurate to h^4/480, then rounded to integers
                ((difference(h) * 4.0 - difference(2.0 * h)) / 3.0).map(f64::round)
            })
            .collect();
        let matrices = matrices(&basis);
        let vector = DVector::from_column_slice(x.components());
        let g = matrices.exp(&vector);
        near(&group.matrix(&group.exp(&x)), &g, 1e-13);
        let log = matrices.log(&g).unwrap();
        close(&log, &vector, 1e-12);
        let v = vector.map(|v| 1.0 - v);
        let closed = group.tangent_left(&x, &G::Vector::from_components(v.as_slice()));
        let closed = DVector::from_column_slice(closed.components());
        close(&matrices.tangent_left(&vector, &v), &closed, 1e-12);
    }
    let numbers = [0.7, -1.1, 0.4, 2.0, -3.0, 0.5, 1.5, 0.25, -0.75];
    agree(&So2, &numbers);
    agree(&So3, &numbers);
    agree(&Se2, &numbers);
    agree(&Se3, &numbers);
    agree(&Se23, &numbers);
    agree(&Sl2, &numbers);
    agree(&Heisenberg::<Const<5>>::new(), &numbers);
    agree(&Homotheties::<Const<4>>::new(), &numbers);
}

properties! {
    #![cases(256)]

    /// Principal logarithms of matrices are found; for other matrices the result is a logarithm or
    /// an error.
    #[test]
    fn logarithms_of_matrices(numbers in vec(-0.75..0.75f64, 16), entries in vec(-3.0..3.0f64, 16)) {
        let group = matrices(&units(4));
        let x = DVector::from_vec(numbers);
        close(&group.log(&group.exp(&x)).unwrap(), &x, 1e-11);
        let any = DMatrix::from_vec(4, 4, entries);
        match group.log(&any) {
            Ok(log) => near(&group.exp(&log), &any, 1e-9),
            Err(error) => {
                let roots = any.complex_eigenvalues();
                let negative = roots.iter().any(|root| root.re < 0.0 && root.im.abs() < 1e-8);
                prop_assert!(negative, "{error} for {roots}");
            }
        }
    }

    /// Elements of SL(2,R) without a logarithm have a trace of -2 or less. Near -2 a rounding error
    /// of the logarithm changes its exponential a lot.
    #[test]
    fn logarithms_in_sl2(x in vec(-3.0..3.0f64, 3), y in vec(-3.0..3.0f64, 3)) {
        let [x, y] = [x, y].map(|x| Sl2.exp(&Vector3::from_vec(x)));
        // a small product of large factors is off the group by their rounding errors
        let g = Sl2.project(Sl2.compose(&x, &y));
        match Sl2.log(&g) {
            Ok(log) => {
                // the differential of exp along e is g T_left(log) e
                let moved = |e: &Vector3<f64>| Sl2.rate(&g, &Sl2.tangent_left(&log, e)).norm();
                let moved = Sl2.basis().iter().map(moved).fold(0.0, f64::hypot);
                let condition = moved * log.norm() / g.norm();
                let bound = 64.0 * f64::EPSILON * (1.0 + condition) * (1.0 + g.norm());
                prop_assert!((Sl2.exp(&log) - g).norm() <= bound);
            }
            // the determinant of the trace-free part has the size of the squares of the entries
            Err(_) => prop_assert!(g.trace() <= -2.0 + 8.0 * f64::EPSILON * g.norm_squared()),
        }
    }
}

/// A pair of eigenvalues within 0.7 degrees of the negative axis: square roots lose accuracy, which
/// a correction restores.
#[test]
fn a_logarithm_near_the_negative_axis() {
    let a = DMatrix::from_column_slice(
        4,
        4,
        &[
            -0.97873585491915,
            -1.0588249680393318,
            -0.37032561533100683,
            2.2233259169122954,
            -2.074453393041017,
            -1.616251309520307,
            0.046707287792221566,
            -1.2537441238583105,
            -1.7073325404088726,
            -1.5878475813480606,
            0.46740706398363496,
            1.1284112112579439,
            0.617527607109056,
            -1.3274549079534022,
            -2.0664679034374056,
            1.2674671461030729,
        ],
    );
    let group = matrices(&units(4));
    near(&group.exp(&group.log(&a).unwrap()), &a, 1e-9);
}

/// Ill-conditioned: rounding the exact logarithm already changes its exponential by a relative
/// 1.3e-11.
#[test]
fn a_logarithm_near_the_trace_minus_2() {
    let x = Sl2.exp(&Vector3::new(-1.9349925814404887, 0.9088266813485224, -2.727862405312867));
    let y = Sl2.exp(&Vector3::new(2.324467052592795, -2.67600688487578, 2.859412346957492));
    let g = Sl2.compose(&x, &y);
    let log = Sl2.log(&g).unwrap();
    // of the entries as given, in 60 digits
    let exact = Vector3::new(122.80288518851135, -676.483023261402, 288.2100236673953);
    assert!((log - exact).norm() <= 1e-11 * exact.norm(), "{log}");
    assert!((Sl2.exp(&log) - g).norm() <= 1e-10 * g.norm());
}

#[test]
fn elements_without_a_logarithm_are_refused() {
    let reason = |result: Result<Vector3<f64>, Error>| match result {
        Err(Error::Invalid { what: "logarithm", reason }) => reason,
        other => panic!("{other:?}"),
    };
    // hyperbolic and parabolic with a negative trace
    assert!(reason(Sl2.log(&Matrix2::new(-2.0, 0.0, 0.0, -0.5))).contains("-2.5"));
    assert!(reason(Sl2.log(&Matrix2::new(-1.0, 1.0, 0.0, -1.0))).contains("trace is -2,"));
    // -1 has many logarithms
    let half_turn = Sl2.log(&-Matrix2::identity()).unwrap();
    assert!((Sl2.exp(&half_turn) + Matrix2::identity()).norm() < 1e-15);

    let gl2 = matrices(&units(2));
    let refused = |g: [f64; 4]| match gl2.log(&DMatrix::from_row_slice(2, 2, &g)) {
        Err(Error::Invalid { what: "logarithm", reason }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(refused([-2.0, 0.0, 0.0, -0.5]).contains("closed negative axis"));
    assert!(refused([1.0, 1.0, 0.0, -1.0]).contains("the eigenvalue -1"));
    assert!(!refused([1.0, 1.0, 1.0, 1.0]).is_empty());
    // a half turn has real logarithms, but not a principal one
    assert!(!refused([-1.0, 0.0, 0.0, -1.0]).is_empty());
    let small = gl2.log(&DMatrix::from_row_slice(2, 2, &[1e-20, 0.0, 0.0, 1.0])).unwrap();
    assert!((small[0] - 1e-20_f64.ln()).abs() < 1e-12, "{small}");
    assert!(matches!(gl2.log(&DMatrix::zeros(2, 3)), Err(Error::Shape { .. })));
    assert!(refused([f64::NAN, 0.0, 0.0, 1.0]).contains("NaN"));
    assert!(refused([f64::INFINITY, 0.0, 0.0, 1.0]).contains("inf"));
    // a matrix of GL(3) near SO(3) that is not a rotation
    let stretched = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, 2.0]));
    let outside = matrices(&spins()).log(&stretched).unwrap_err().to_string();
    assert!(outside.contains("has the distance 6.93"), "{outside}");
}

/// The determinant is 1 to a millionth of the squares of the entries.
#[test]
fn unimodular_matrices_are_read_to_a_tolerance() {
    let read = |factor: f64, off: f64| {
        let matrix = DMatrix::from_row_slice(2, 2, &[factor * (1.0 + off), 0.0, 0.0, 1.0 / factor]);
        Sl2.read(&matrix).is_ok()
    };
    for factor in [1.0, 10.0] {
        let size = factor * factor;
        assert!(read(factor, 0.0) && read(factor, 1e-7 * size) && read(factor, -1e-7 * size));
        assert!(!read(factor, 1e-5 * size) && !read(factor, -1e-5 * size), "{factor}");
    }
}

#[test]
fn what_is_no_matrix_group_is_refused() {
    let units = units(2);
    let open = MatrixGroup::new(&units[1..3]).unwrap_err();
    assert!(matches!(open, Error::Broken { law: Law::Closure, .. }), "{open}");
    let twice = [units[0].clone(), &units[0] * 2.0];
    let dependent = MatrixGroup::new(&twice).unwrap_err();
    assert!(matches!(dependent, Error::Broken { law: Law::Independent, .. }), "{dependent}");
    let shapes = [units[0].clone(), DMatrix::zeros(2, 3)];
    assert!(matches!(MatrixGroup::new(&shapes), Err(Error::Shape { .. })));
    assert!(matches!(MatrixGroup::new(&[]), Err(Error::Shape { .. })));
    let infinite = [&units[0] * f64::INFINITY];
    assert!(MatrixGroup::new(&infinite).is_err());
    let centre = MatrixGroup::adjoint(&floats("so(3)+heisenberg(3)")).unwrap_err();
    assert_eq!(centre, Law::FaithfulAdjoint.broken(["z".to_string()], "0"));
    let class = Nilpotent::new(catalogued("aff(1)")).unwrap_err().to_string();
    assert!(class.contains("the vector y"), "{class}");
}

/// Rotations by any angle, and translations of any size.
#[test]
fn huge_and_tiny_vectors_give_no_nan() {
    fn finite<G: LieGroup>(group: &G, x: &G::Vector) {
        let g = group.exp(x);
        let all = |x: &[f64]| assert!(x.iter().all(|x| x.is_finite()), "{x:?}");
        all(group.matrix(&g).as_slice());
        all(group.log(&g).unwrap().components());
        let v = G::Vector::from_components(&[1.0; 9][..group.dimension()]);
        all(group.tangent_left(x, &v).components());
        all(group.tangent_right(x, &v).components());
        match group.tangent_left_inverse(x, &v) {
            Ok(image) => all(image.components()),
            Err(error) => assert!(matches!(error, Error::Broken { law: Law::RegularTangent, .. })),
        }
    }
    let sizes = [0.0, 5e-324, 1e-300, 1e-160, 1e-100, 1e-20, 1e-8, 1e3, 1e8, 1e17, 1e60, 1e120];
    for turn in sizes.iter().chain(&[1e154, 1e200, 1e300, 1.7e308]) {
        finite(&So2, &SVector::from([*turn]));
        finite(&So3, &Vector3::new(*turn, -turn, turn * 0.3));
        // along E - F, which generates rotations
        finite(&Sl2, &Vector3::new(*turn, -turn * 0.9, turn * 0.1));
        for shift in &sizes {
            finite(&Se2, &Vector3::new(*turn, *shift, -shift));
            let x = [*turn, -turn, turn * 0.3, *shift, -shift, 0.0, 0.0, *shift, *shift];
            finite(&Se3, &SVector::from_row_slice(&x[..6]));
            finite(&Se23, &SVector::from(x));
        }
    }
    for shift in sizes {
        finite(&Sl2, &Vector3::new(shift, 0.0, 0.0));
        finite(&Heisenberg::<Const<3>>::new(), &Vector3::repeat(shift));
    }
    for size in [0.0, 5e-324, 1e-300, 1e-160, 1e-8, 1.0, 100.0] {
        finite(&matrices(&spins()), &DVector::from_vec(vec![size, 0.5 * size, 0.0]));
    }
}

/// The tangent operator of SE(3) is accurate after many turns.
#[test]
fn many_turns_of_a_screw() {
    for turn in [3.0, 3.2, 10.0, 50.0, 300.0] {
        let x = SVector::from([0.6 * turn, 0.0, 0.8 * turn, 1.0, -2.0, 0.5]);
        let closed = Se3.operator_matrix(|v| Se3.tangent_left(&x, v));
        let by_series = affinor::numerics::exponential::phi1(&-ad(&Se3, &x));
        assert!((closed - by_series).norm() < 1e-13 * turn, "{turn}");
    }
}

#[test]
fn a_quaternion_and_its_negative_are_one_motion() {
    let g = Se3.exp(&SVector::from([0.3, 0.2, 0.1, 1.0, 2.0, 3.0]));
    let other = UnitQuaternion::new_unchecked(-g.rotation.into_inner());
    let negative = nalgebra::Isometry3::from_parts(g.translation, other);
    assert!((Se3.log(&g).unwrap() - Se3.log(&negative).unwrap()).norm() < 1e-15);
}

/// A group for every family of the catalogue, with the brackets of its algebra.
#[test]
fn every_named_algebra_has_a_group() {
    let sums = ["so3+R^3", "se3+se3", "R^1+heisenberg(5)+A1", "bianchi(VI,h=-1/2)+so(2)"];
    let families = affinor::algebra::catalogue::families().iter().map(|family| family.example);
    for name in families.filter(|name| !name.starts_with(['E', 'F'])).chain(sums) {
        let group = AnyGroup::named(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        let flat = Connection::canonical(&floats(name), CanonicalConnection::Minus);
        // it compares the structure constants
        let transport = ParallelTranslation::new(group, flat);
        assert!(transport.is_ok(), "{name}: {}", transport.unwrap_err());
    }
    for family in registry::families() {
        let name = family.pattern.replace("(n)", "(3)").replace("^n", "^3");
        let group = AnyGroup::named(&name).unwrap();
        let blocks = group.blocks();
        let found = group.read(&group.write(&group.identity())).unwrap();
        assert_eq!((blocks.len(), group.project(found)), (1, group.identity()), "{name}");
    }
    for name in ["so9+", "so(3)+spin(7)", "bianchi(VI,h=h)", ""] {
        assert!(matches!(AnyGroup::named(name), Err(Error::Name(_))), "{name}");
    }
}

#[test]
fn means_commute_with_translations() {
    fn check<G: LieGroup>(group: &G, size: f64) {
        let n = group.dimension();
        let x = |k: usize| G::Vector::from_fn(n, |i| size * (1.0 + 3.0 * (i + n * k) as f64).sin());
        let elements: Vec<_> = (0..5).map(|k| group.exp(&x(k))).collect();
        let mean = group.mean(&elements).unwrap();
        let logs = elements.iter().map(|g| group.log(&group.between(&mean, g)).unwrap());
        let sum = logs.reduce(|sum, log| sum + log).unwrap();
        assert!(sum.largest() < 1e-12, "{sum:?}");
        let h = group.exp(&(x(7) * 3.0));
        let moved: Vec<_> = elements.iter().map(|g| group.compose(&h, g)).collect();
        let moved = group.between(&group.compose(&h, &mean), &group.mean(&moved).unwrap());
        assert!(group.log(&moved).unwrap().largest() < 1e-11);
    }
    check(&So3, 0.7);
    check(&Se3, 0.5);
    check(&Sl2, 0.2);
    check(&Heisenberg::<Const<3>>::new(), 2.0);
    check(&AnyGroup::named("se2+so3+R^2").unwrap(), 0.5);
    assert!(matches!(So3.mean(&[]), Err(Error::Shape { .. })));
    let lost = Translations(Const::<2>).mean(&[SVector::from([0.0, f64::NAN])]).unwrap_err();
    let Error::Invalid { what: "mean", reason } = lost else { panic!("{lost}") };
    assert!(reason.starts_with("after 1 iterations"), "{reason}");
}

/// Jacobians of rotations, on both sides; their type has a fixed size.
#[test]
fn jacobians_are_derivatives_of_exp() {
    let (x, v) = (Vector3::new(0.4, -1.0, 0.3), Vector3::new(1.0, 0.2, -0.5) * 1e-6);
    let (g, moved) = (So3.exp(&x), So3.exp(&(x + v)));
    let right: nalgebra::Matrix3<f64> = So3.jacobian_right(&x);
    assert!((So3.log(&So3.between(&g, &moved)).unwrap() - right * v).norm() < 1e-12);
    let left = So3.log(&So3.compose(&moved, &So3.inverse(&g))).unwrap();
    assert!((left - So3.jacobian_left(&x) * v).norm() < 1e-12);
    let dynamic: DMatrix<f64> =
        AnyGroup::new(So3).jacobian_right(&DVector::from_row_slice(x.as_slice()));
    assert_eq!(dynamic.as_slice(), right.as_slice());
}
