//! Normal extremals: elementary functions on the Heisenberg group, k + p problems on SO(3) and SL(2),
//! elliptic functions on SE(2), series of other programs, invariance, and conserved quantities.
#![allow(clippy::excessive_precision, reason = "references have 25 digits")]

mod abnormal;
mod jacobi;
mod shooting;

use affinor::algebra::catalogue;
use affinor::geometry::SubRiemannian;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation, registry};
use affinor::mechanics::geodesics::SubRiemannianGroup;
use affinor::{Bracket, Error, LieAlgebra, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, DVector, dvector};

type Vectors<'v> = &'v [&'v [(usize, f64)]];

/// The structure on a group of the catalogue for which these vectors are orthonormal.
fn space(name: &str, vectors: Vectors) -> SubRiemannianGroup {
    let algebra = AnyGroup::named(name).unwrap().algebra().unwrap();
    let vectors = vectors.iter().map(|vector| vector.to_vec());
    let structure = SubRiemannian::orthonormal(&algebra, vectors).unwrap();
    SubRiemannianGroup::new(AnyGroup::named(name).unwrap(), &structure).unwrap()
}

/// The structure for which the first two basis vectors are orthonormal.
fn first_two(name: &str) -> SubRiemannianGroup {
    space(name, &[&[(0, 1.0)], &[(1, 1.0)]])
}

/// The sum of aff(1) and the line, with the contact structure that x and y + z span.
fn affine() -> SubRiemannianGroup {
    space("aff(1)+R^1", &[&[(0, 1.0)], &[(1, 1.0), (2, 1.0)]])
}

fn all() -> Vec<SubRiemannianGroup> {
    let sl2: Vectors = &[&[(0, 1.0), (1, 1.0)], &[(2, 1.0)]];
    let mut all = vec![space("sl(2)", sl2), affine()];
    all.extend(
        ["heisenberg(3)", "se(2)", "so(3)", "filiform(4)", "free_nilpotent(2,3)"].map(first_two),
    );
    all
}

/// A generic covector.
fn covector(n: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| [0.6, 0.8, 1.5, -2.0, 0.7][i])
}

fn end(space: &SubRiemannianGroup, p: &DVector<f64>, t: f64) -> DVector<f64> {
    let identity = space.group().identity();
    space.extremal(&identity, p, &[t]).unwrap().remove(0).element
}

fn matrix(space: &SubRiemannianGroup, element: &DVector<f64>) -> DMatrix<f64> {
    space.group().write(element)
}

fn assert_close(found: &DVector<f64>, expected: &DVector<f64>, tolerance: f64) {
    assert!((found - expected).amax() <= tolerance, "{found} is not {expected}");
}

/// The projection of an extremal of the Heisenberg group is a circle, and `z` is the area that it
/// encloses with its chord.
#[test]
fn circles_on_the_heisenberg_group() {
    let space = first_two("heisenberg(3)");
    for (a, b, w, t) in [(1.0, 0.0, 0.5, 3.0), (0.3, -0.7, -2.0, 4.0), (2.0, 1.0, 6.0, 1.0)] {
        let p = dvector![a, b, w];
        // u1' = -w u2, u2' = w u1
        let (s, c) = f64::sin_cos(w * t);
        let x = (a * s - b * (1.0 - c)) / w;
        let y = (b * s + a * (1.0 - c)) / w;
        let z = (a * a + b * b) * (w * t - s) / (2.0 * w * w);
        let found = space.group().log(&end(&space, &p, t)).unwrap();
        assert_close(&found, &dvector![x, y, z], 1e-11);
    }
}

/// For a bi-invariant form and `g = k + p`, the extremals in `p` are `exp(t (a + k)) exp(-t k)`.
#[test]
fn products_of_two_exponentials() {
    let (so3, t) = (first_two("so(3)"), 2.5);
    let p = dvector![0.6, -0.8, 1.3];
    let group = so3.group();
    let (first, second) = (group.exp(&(&p * t)), group.exp(&dvector![0.0, 0.0, -1.3 * t]));
    let expected = matrix(&so3, &group.compose(&first, &second));
    assert!((matrix(&so3, &end(&so3, &p, t)) - expected).amax() < 1e-12);
    // on SL(2), with half of the trace form, the generator of rotations e - f has the square -1
    let sl2 = space("sl(2)", &[&[(0, 1.0), (1, 1.0)], &[(2, 1.0)]]);
    let group = sl2.group();
    for [x, h, k] in [[0.6, 0.8, 1.5], [1.0, -0.5, -0.3]] {
        // values on e + f, h and e - f
        let p = dvector![0.5 * (x + k), 0.5 * (x - k), h];
        let first = group.exp(&(dvector![x - k, x + k, h] * t));
        let expected = group.compose(&first, &group.exp(&(dvector![k, -k, 0.0] * t)));
        let (found, expected) = (matrix(&sl2, &end(&sl2, &p, t)), matrix(&sl2, &expected));
        assert!((&found - &expected).amax() < 1e-11 * expected.amax(), "{found} is not {expected}");
    }
}

/// Series and elliptic functions in many digits; see tests/references/sub_riemannian.py.
#[test]
fn references_in_many_digits() {
    let se2 = first_two("se(2)");
    for (p, t, [angle, x, y], expected) in [
        (
            [
                0.972174183501504011548567,
                -0.2342591661668418159649647,
                -0.7649330971181832674932879,
            ],
            2.0,
            [
                1.458239316267900908769869_f64,
                -0.7553456076904720174823624,
                -0.953330650036567457384708,
            ],
            [0.6177117715750746007572256, -0.786404582424074420199476, 0.1468599085605637353327452],
        ),
        (
            [0.900262861131486571399117, -0.435346736369241345299385, -0.2459130316446248745220972],
            5.0,
            [4.593734350132235044798861, -1.285266792082603323923974, -0.8523689548254558893474237],
            [
                0.9552750504840153717791915,
                0.2957187480088869423463442,
                -0.4031754234539081093523275,
            ],
        ),
        (
            [
                0.9324889607607620411335152,
                -0.3611984746082325170110724,
                -1.196676924629486623772584,
            ],
            2.0,
            [
                0.4459351817233661923348349,
                -1.479073492828159252050473,
                -0.8250709582812825084472262,
            ],
            [
                -0.5394697863630807220221156,
                -0.8420049581809907875954706,
                -0.9238656019133020816507808,
            ],
        ),
        (
            [0.7957882308235568883838431, 0.6055750091299287940747076, -1.552757768003452763753485],
            5.0,
            [0.7422703467501407647073037, 0.507319540695963578968874, -1.298015720298295456992904],
            [
                0.7974867068287267451128858,
                -0.6033365167395990121853088,
                -1.553628921379331602822624,
            ],
        ),
    ] {
        let (start, p) = (se2.group().identity(), DVector::from_row_slice(&p));
        let point = se2.extremal(&start, &p, &[t]).unwrap().remove(0);
        let (s, c) = angle.sin_cos();
        let pose = DMatrix::from_row_slice(3, 3, &[c, -s, x, s, c, y, 0.0, 0.0, 1.0]);
        assert!((matrix(&se2, &point.element) - pose).amax() < 1e-11, "{p}");
        assert_close(&point.covector, &DVector::from_row_slice(&expected), 1e-11);
    }
    let engel = [
        [
            -0.7843992111715716932946886,
            0.8511184555057928966414049,
            0.60856217703334950792322,
            0.08554957673592559049948278,
        ],
        [
            -0.1271699743043007177760788,
            -0.9918809392439414626720451,
            3.068798422343143386589377,
            -2.0,
        ],
    ];
    let cartan = [
        [
            0.3947137237503409576641507,
            0.2518115153431686806357386,
            0.421780105168306311823869,
            0.1442374793915054595497736,
            0.04475408282850777319074807,
        ],
        [
            -0.7052748448644588574620742,
            -0.7089339836694341256614607,
            2.417144720515434936281909,
            2.0,
            -1.5,
        ],
    ];
    for (space, p, expected) in [
        (first_two("filiform(4)"), dvector![0.6, 0.8, 1.5, -2.0], engel.map(|row| row.to_vec())),
        (
            first_two("free_nilpotent(2,3)"),
            dvector![0.6, -0.8, 1.25, 2.0, -1.5],
            cartan.map(|row| row.to_vec()),
        ),
    ] {
        let start = space.group().identity();
        let point = space.extremal(&start, &p, &[2.0]).unwrap().remove(0);
        let [x, h] = expected.map(DVector::from_vec);
        assert_close(&space.group().log(&point.element).unwrap(), &x, 1e-11);
        assert_close(&point.covector, &h, 1e-11);
    }
    let affine = affine();
    let (start, p) = (affine.group().identity(), dvector![0.6, 1.5, -0.7]);
    let point = affine.extremal(&start, &p, &[2.0]).unwrap().remove(0);
    let entries = matrix(&affine, &point.element);
    for expected in
        [0.3293682200764941178673885, 1.052375337523093357818426, 1.021729474445803427328737]
    {
        assert!(entries.iter().any(|entry| (entry - expected).abs() < 1e-11), "{entries}");
    }
    let h = dvector![-0.9785630062846400367276385, 0.4940523301147411768010828, -0.7];
    assert_close(&point.covector, &h, 1e-11);
}

/// The speed, Casimir functions and the momentum in spatial axes are conserved.
#[test]
fn conserved_quantities() {
    for space in all() {
        let (group, p) = (space.group(), covector(space.group().dimension()));
        let times: Vec<f64> = (1..=8).map(|k| 0.15 * f64::from(k)).collect();
        for point in space.extremal(&group.identity(), &p, &times).unwrap() {
            let h = &point.covector;
            assert!((space.speed(h) - space.speed(&p)).abs() < 1e-11, "{space:?}");
            let spatial = group.coadjoint(&group.inverse(&point.element), h);
            assert!((&spatial - &p).amax() < 1e-9 * h.amax().max(p.amax()), "{spatial} is not {p}");
        }
    }
    // on SE(2), the Casimir function is the square of the linear momentum
    let (se2, p) = (first_two("se(2)"), covector(3));
    let last = se2.extremal(&se2.group().identity(), &p, &[10.0]).unwrap().remove(0).covector;
    let casimir = |h: &DVector<f64>| h[1] * h[1] + h[2] * h[2];
    assert!((casimir(&last) - casimir(&p)).abs() < 1e-12);
    // the Engel group: h4 and h3^2/2 - h2 h4
    let (engel, p) = (first_two("filiform(4)"), covector(4));
    let last = engel.extremal(&engel.group().identity(), &p, &[5.0]).unwrap().remove(0).covector;
    let casimir = |h: &DVector<f64>| 0.5 * h[2] * h[2] - h[1] * h[3];
    assert!((last[3] - p[3]).abs() < 1e-13 && (casimir(&last) - casimir(&p)).abs() < 1e-11);
}

/// A left translation moves extremals, and a change of the orthonormal basis changes nothing.
#[test]
fn invariance() {
    for space in all() {
        let (group, p) = (space.group(), covector(space.group().dimension()));
        let start = group.exp(&(&p * 0.3));
        let moved = space.extremal(&start, &p, &[1.5]).unwrap().remove(0).element;
        let expected = group.compose(&start, &end(&space, &p, 1.5));
        assert!((group.write(&moved) - group.write(&expected)).amax() < 1e-10);
    }
    let (s, c) = f64::sin_cos(0.7);
    for name in ["heisenberg(3)", "se(2)", "so(3)", "filiform(4)", "free_nilpotent(2,3)"] {
        let (space, p) = (first_two(name), covector(first_two(name).group().dimension()));
        let turned = self::space(name, &[&[(0, c), (1, s)], &[(0, -s), (1, c)]]);
        assert_close(&end(&turned, &p, 1.5), &end(&space, &p, 1.5), 1e-12);
        let conjugate = |space: &SubRiemannianGroup| space.differential(&p, 1.5).unwrap();
        assert!((conjugate(&turned) - conjugate(&space)).amax() < 1e-9);
    }
}

/// The restriction of a metric, in a basis of the distribution that is not orthonormal, is the
/// structure of an orthonormal basis.
#[test]
fn restrictions_of_metrics() {
    let (group, algebra) =
        (AnyGroup::named("se(2)").unwrap(), catalogue::algebra("se(2)").unwrap());
    let entries = [([0, 0], 4.0), ([1, 1], 1.0), ([2, 2], 9.0)];
    let metric = Tensor::from_components(3, &[Down, Down], entries).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let skew = [vec![(0, 1.0), (1, 1.0)], vec![(0, 1.0), (1, -2.0)]];
    let restricted = SubRiemannian::restricted(&algebra, skew, &metric).unwrap();
    let restricted = SubRiemannianGroup::new(group, &restricted).unwrap();
    let orthonormal = space("se(2)", &[&[(0, 0.5)], &[(1, 1.0)]]);
    let p = covector(3);
    assert_close(&restricted.velocity(&p), &orthonormal.velocity(&p), 1e-15);
    assert_close(&end(&restricted, &p, 2.0), &end(&orthonormal, &p, 2.0), 1e-12);
}

/// Invalid structures and covectors are errors.
#[test]
fn errors() {
    let algebra: LieAlgebra<f64> = catalogue::algebra("se(2)").unwrap();
    let group = AnyGroup::named("se(2)").unwrap();
    let plane = [0, 1].map(|at| vec![(at, 1.0)]);
    let entries = [([0, 0], -1.0), ([1, 1], 1.0), ([2, 2], 1.0)];
    let metric = Tensor::from_components(3, &[Down, Down], entries).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let indefinite = SubRiemannian::restricted(&algebra, plane.clone(), &metric).unwrap();
    let message = SubRiemannianGroup::new(group.clone(), &indefinite).unwrap_err().to_string();
    assert!(message.contains("not positive definite"), "{message}");
    let se2 = SubRiemannian::orthonormal(&algebra, plane.clone()).unwrap();
    for (name, expected) in [("so(3)", "structure constant"), ("se(3)", "dimension 3")] {
        let error = SubRiemannianGroup::new(AnyGroup::named(name).unwrap(), &se2).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    let space = SubRiemannianGroup::new(group.clone(), &se2).unwrap();
    let identity = group.identity();
    let constant = space.extremal(&identity, &dvector![0.0, 0.0, 1.0], &[1.0]).unwrap_err();
    assert!(constant.to_string().contains("annihilates the distribution"), "{constant}");
    let short = space.extremal(&identity, &dvector![1.0], &[1.0]).unwrap_err();
    assert!(matches!(short, Error::Shape { .. }), "{short}");
    let null =
        Tensor::from_components(3, &[Down, Down], [([0, 1], 1.0), ([1, 0], 1.0), ([2, 2], 1.0)]);
    let null = Metric::new(algebra.labels(), null.unwrap()).unwrap();
    let line = [vec![(0, 1.0)]];
    let degenerate = SubRiemannian::restricted(&algebra, line, &null).unwrap_err();
    assert!(degenerate.to_string().contains("degenerate"), "{degenerate}");
}

/// A group that is given by brackets only has the extremals of the named group.
#[test]
fn groups_of_brackets() {
    let bracket = Bracket::from_fn(&["a", "b", "c", "d"], |j, k| match (j, k) {
        (0, 1) => vec![(2, 1.0)],
        (0, 2) => vec![(3, 1.0)],
        _ => vec![],
    });
    let algebra = LieAlgebra::try_from(bracket.unwrap()).unwrap();
    let group = registry::of_algebra(&algebra).unwrap();
    let plane = [0, 1].map(|at| vec![(at, 1.0)]);
    let structure = SubRiemannian::orthonormal(&algebra, plane).unwrap();
    let found = SubRiemannianGroup::new(group, &structure).unwrap();
    let p = covector(4);
    assert_close(&end(&found, &p, 1.0), &end(&first_two("filiform(4)"), &p, 1.0), 1e-12);
}
