//! Weyl scalars of spacetimes in null tetrads (`affinor::geometry::null_tetrad`): published values,
//! the invariants, the electric and magnetic parts, and other coordinates.
//!
//! Values: S. Chandrasekhar, *The Mathematical Theory of Black Holes* (1983), sections 21 and 56;
//! J. B. Griffiths and J. Podolsky, *Exact Space-Times in Einstein's General Relativity* (2009),
//! chapters 8, 9, 11, 12 and 17; H. Stephani and others, *Exact Solutions* (2003), chapters 4, 13 and 24.

use affinor::geometry::isometry::signature_at_sample;
use affinor::geometry::null_tetrad::{NullTetrad, WeylScalars};
use affinor::geometry::petrov::PetrovType;
use affinor::{Connection, Geometry, Tensor, Up};
use affinor_documents::report::{Format, Report, Spacetime};
use affinor_documents::space::{Request, Space};
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::{Notation, Symbolic, Tolerance};
use num_traits::Zero;

fn geometry(space: &str) -> Geometry<Symbolic> {
    let request = Request { space: Some(space.into()), ..Request::default() };
    let space = Space::open(&request).unwrap();
    space.definition.geometry(Tolerance::default()).unwrap()
}

/// A formula in coordinates and parameters.
fn value(text: &str) -> Symbolic {
    let name = |name: &str| Ok::<_, String>(Symbolic::parameter(name));
    let call = |name: &str, arguments: &[Symbolic]| Notation::call(name, arguments);
    Expression::parse(text).unwrap().evaluate(&Scalars(name, call)).unwrap()
}

fn vector(components: [&str; 4]) -> Tensor<Symbolic> {
    Tensor::vector(&components.map(value), Up)
}

fn scalars(geometry: &Geometry<Symbolic>, given: &[Tensor<Symbolic>]) -> WeylScalars {
    let metric = geometry.metric().unwrap();
    let connection = Connection::levi_civita(geometry.frame(), metric).unwrap();
    let mut tetrad = NullTetrad::new(metric, given, PositiveFactors::default()).unwrap();
    tetrad.weyl_scalars(&connection, metric).unwrap()
}

/// The scalars as pairs of real and imaginary parts.
fn psi(scalars: &WeylScalars) -> [[Symbolic; 2]; 5] {
    scalars.psi.clone().map(|psi| [psi.re, psi.im])
}

fn zero() -> [Symbolic; 2] {
    [Symbolic::zero(), Symbolic::zero()]
}

fn times([a, b]: &[Symbolic; 2], [x, y]: &[Symbolic; 2]) -> [Symbolic; 2] {
    [a.clone() * x - &(b.clone() * y), a.clone() * y + &(b.clone() * x)]
}

fn by([a, b]: &[Symbolic; 2], factor: i64) -> [Symbolic; 2] {
    [a.clone() * &Symbolic::from(factor), b.clone() * &Symbolic::from(factor)]
}

/// Three orthonormal vectors of a boosted and rotated frame, in an orthonormal basis.
fn tilted() -> [Tensor<Symbolic>; 3] {
    [
        vector(["5/4", "3/4", "0", "0"]),
        vector(["9/20", "3/4", "4/5", "0"]),
        vector(["-9/25", "-3/5", "9/25", "4/5"]),
    ]
}

/// `[I, J]`.
fn invariants(scalars: &WeylScalars) -> [[Symbolic; 2]; 2] {
    [&scalars.quadratic, &scalars.cubic].map(|value| [value.re.clone(), value.im.clone()])
}

/// `Psi2` is the only scalar of type D in a frame whose null vectors are the principal ones. The
/// default frames are such frames, but the frame of Kerr must be given.
#[test]
fn black_holes_have_their_published_scalars() {
    let cases = [
        ("schwarzschild", "-M/r^3"),
        ("schwarzschild-observers", "-M/r^3"),
        ("eddington-finkelstein", "-M/r^3"),
        ("reissner-nordstrom", "-M/r^3 + Q^2/r^4"),
        ("schwarzschild-de-sitter", "-M/r^3"),
        ("vaidya", ""),
    ];
    for (name, expected) in cases {
        let geometry = geometry(name);
        let found = scalars(&geometry, &[]);
        let expected = match expected {
            "" => {
                let free = affinor_tensors::scalar::FreeFunction::read("m(u)").unwrap().value();
                -free * &value("1/r^3")
            }
            text => value(text),
        };
        let expected = [zero(), zero(), [expected, Symbolic::zero()], zero(), zero()];
        assert_eq!(psi(&found), expected, "{name}");
    }
}

/// The frame of Carter, and the tetrad of Kinnersley with `r - i a cos(theta)` in its denominators:
/// `Psi2 = -M/(r - i a cos(theta))^3`, and with a charge `(Q^2/(r + i a cos(theta)) - M) / (...)^3`.
#[test]
fn kerr_and_kerr_newman_have_their_published_scalars() {
    let carter = [
        vector(["r^2 + a^2", "0", "0", "a"]),
        vector(["0", "1", "0", "0"]),
        vector(["0", "0", "1", "0"]),
    ];
    let horizon = "(r^2 - 2*M*r + a^2)";
    let kinnersley = [
        vector([&format!("(r^2 + a^2)/{horizon}"), "1", "0", &format!("a/{horizon}")]),
        vector(["r^2 + a^2", &format!("-{horizon}"), "0", "a"]),
        vector(["a^2*sin(theta)*cos(theta)", "0", "r", "a*cos(theta)/sin(theta)"]),
    ];
    // 1/(r - i a cos) = (r + i a cos)/Sigma
    let [re, im] = ["r", "a*cos(theta)"].map(|text| value(text) / &value("r^2 + a^2*cos(theta)^2"));
    let inverse = [re.clone(), im.clone()];
    let conjugate = [re, -im];
    let cube = times(&inverse, &times(&inverse, &inverse));
    let mass = [-value("M"), Symbolic::zero()];
    let kerr = geometry("kerr");
    for frame in [&carter, &kinnersley] {
        let found = scalars(&kerr, frame);
        let expected = times(&mass, &cube);
        assert_eq!(psi(&found), [zero(), zero(), expected.clone(), zero(), zero()]);
        let square = times(&expected, &expected);
        let [i, j] = invariants(&found);
        assert_eq!(i, by(&square, 3));
        assert_eq!(j, by(&times(&square, &expected), -1));
    }
    let charged = geometry("kerr-newman");
    let found = psi(&scalars(&charged, &carter));
    let names = charged.metric().unwrap().components().components();
    let charge =
        names.flat_map(|(_, v)| v.parameters()).find(|name| ["Q", "q", "e"].contains(&&**name));
    let square = num_traits::pow(Symbolic::parameter(&charge.unwrap()), 2);
    let sum = [mass[0].clone() + &(conjugate[0].clone() * &square), conjugate[1].clone() * &square];
    assert_eq!(found, [zero(), zero(), times(&sum, &cube), zero(), zero()]);
}

/// `I` and `J` do not depend on the frame. In a boosted and rotated frame, no scalar
/// is zero.
#[test]
fn invariants_do_not_depend_on_the_frame() {
    let schwarzschild = geometry("schwarzschild-observers");
    let tilted = tilted();
    let found = scalars(&schwarzschild, &tilted);
    assert!(psi(&found).iter().all(|psi| *psi != zero()));
    assert_eq!(invariants(&found), invariants(&scalars(&schwarzschild, &[])));
}

/// Conformally flat spaces have no scalars; `Psi4` alone remains of a pp-wave, whose `l` is `d_v`:
/// `|Psi4|` is `|H_xx - H_yy - 2 i H_xy|/4` up to the rotation of `m`.
#[test]
fn waves_and_conformally_flat_spacetimes_have_their_published_scalars() {
    for name in ["minkowski", "de-sitter", "anti-de-sitter", "friedmann", "einstein-static"] {
        let found = scalars(&geometry(name), &[]);
        assert_eq!(psi(&found), [zero(), zero(), zero(), zero(), zero()], "{name}");
        assert_eq!(invariants(&found), [zero(), zero()]);
    }
    let wave = psi(&scalars(&geometry("pp-wave"), &[]));
    assert_eq!(wave[..4], [zero(), zero(), zero(), zero()]);
    let second = |name: &str| {
        let profile = affinor_tensors::scalar::FreeFunction::read("H(u,x,y)").unwrap();
        profile.named(name).unwrap().value()
    };
    let quarter = value("1/4");
    let real = (second("H_y_y") - &second("H_x_x")) * &quarter;
    let imaginary = -second("H_x_y") * &value("1/2");
    assert_eq!(wave[4], [real, imaginary]);
}

/// The Weyl tensor of Kasner's metric is purely electric: `E_ii = p (1 - p)/T^2` along an axis with the
/// scale `T^p`. Here the proper time is `T = t^3`, and the exponents are -1/3, 2/3, 2/3.
#[test]
fn kasner_is_electric() {
    let kasner = geometry("kasner;metric=diag(-9*t^4,t^-2,t^4,t^4)");
    let found = scalars(&kasner, &[]);
    let [electric, magnetic] = found.parts.clone().unwrap();
    assert!(magnetic.iter().flatten().all(Zero::is_zero));
    for (i, expected) in ["-4/(9*t^6)", "2/(9*t^6)", "2/(9*t^6)"].into_iter().enumerate() {
        assert_eq!(electric[i][i], value(expected), "{i}");
    }
    assert!((0..3).all(|i| (0..3).all(|j| i == j || electric[i][j].is_zero())));
}

/// `Q = E - i B` of an orthonormal frame is a linear function of the five scalars (Stephani and others
/// (2003), section 4.3): its trace vanishes, and `Q_22 = 2 Psi2`.
#[test]
fn parts_agree_with_the_scalars() {
    let carter = [vector(["r^2 + a^2", "0", "0", "a"]), vector(["0", "1", "0", "0"])];
    let tilted = tilted();
    for (name, frame) in [("kerr", &carter[..]), ("schwarzschild-observers", &tilted[..])] {
        let found = scalars(&geometry(name), frame);
        let [p0, p1, p2, p3, p4] = psi(&found);
        let [e, b] = found.parts.unwrap();
        let q = |i: usize, j: usize| [e[i][j].clone(), -b[i][j].clone()];
        let add =
            |a: &[Symbolic; 2], b: &[Symbolic; 2]| [a[0].clone() + &b[0], a[1].clone() + &b[1]];
        let trace = add(&add(&q(0, 0), &q(1, 1)), &q(2, 2));
        assert_eq!(trace, zero());
        assert_eq!(q(0, 0), by(&p2, 2));
        assert_eq!(by(&add(&q(1, 1), &by(&q(2, 2), -1)), 1), add(&p0, &p4));
        assert_eq!(q(0, 1), add(&p3, &by(&p1, -1)));
        let rotated = add(&p1, &p3);
        assert_eq!(by(&q(0, 2), 1), times(&rotated, &[Symbolic::zero(), Symbolic::from(1)]));
        for i in 0..3 {
            assert!((0..3).all(|j| q(i, j) == q(j, i)), "{name}");
        }
    }
}

/// `I^3 = 27 J^2` exactly for the special types, and `I` and `J` are those of `Petrov` up to the
/// orientation.
#[test]
fn invariants_agree_with_the_petrov_type() {
    for name in [
        "taub-nut",
        "goedel",
        "nariai",
        "c-metric",
        "plane-wave",
        "kasner",
        "van-stockum",
        "melvin",
    ] {
        let geometry = geometry(name);
        let metric = geometry.metric().unwrap();
        let connection = Connection::levi_civita(geometry.frame(), metric).unwrap();
        let petrov = connection.petrov(metric).unwrap().unwrap();
        let found = scalars(&geometry, &[]);
        let [i, j] = invariants(&found);
        let cube = times(&i, &times(&i, &i));
        let is_special = cube == by(&times(&j, &j), 27);
        assert_eq!(is_special, petrov.kind != PetrovType::I, "{name}");
        // the map of bivectors changes its sign with the metric, the scalars do not
        let [_, minus] = signature_at_sample(metric.components(), &[]).unwrap();
        let sign = Symbolic::from(if minus == 3 { -1 } else { 1 });
        let cubic = petrov.cubic[0].clone() * &sign;
        assert_eq!([&i[0], &j[0]], [&petrov.quadratic[0], &cubic], "{name}");
        let square = |x: &Symbolic| x.clone() * x;
        assert_eq!(square(&i[1]), square(&petrov.quadratic[1]) * &petrov.volume_squared, "{name}");
    }
}

/// The C-metric has `Psi2 = -m A^3 (x - y)^3` in the frame of the region that its chart declares. There
/// its signature is `(3,1)`. The sign is the same with values of the parameters.
#[test]
fn signs_are_those_of_the_declared_region() {
    for set in [None, Some("m=1/10,A=1/2".to_string())] {
        let request = Request { space: Some("c-metric".into()), set, ..Request::default() };
        let space = Space::open(&request).unwrap();
        let mut text = vec![];
        let report = Spacetime::of(&space.definition, None).unwrap();
        report.write(Format::Json, &mut text).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(json["signature"], serde_json::json!([3, 1]));
        let found = value(json["psi"][2][0].as_str().unwrap());
        let at = |name: &str| match name {
            "m" => Some(0.1),
            "A" => Some(0.5),
            "x" => Some(1.0 / 3.0),
            "y" => Some(-1.5),
            _ => None,
        };
        let expected = -(11.0_f64 / 6.0).powi(3) / 80.0;
        assert!((found.evaluate(at).unwrap() - expected).abs() < 1e-14, "{found}");
    }
}

/// The metric with the opposite sign has the same scalars.
#[test]
fn the_sign_of_the_metric_changes_nothing() {
    let geometry = geometry("taub-nut");
    let metric = geometry.metric().unwrap();
    let opposite = affinor::Metric::new(
        geometry.frame().labels(),
        metric.components().scale(&-Symbolic::from(1)),
    );
    let opposite = opposite.unwrap();
    let connection = Connection::levi_civita(geometry.frame(), &opposite).unwrap();
    let mut tetrad = NullTetrad::new(&opposite, &[], PositiveFactors::default()).unwrap();
    let found = tetrad.weyl_scalars(&connection, &opposite).unwrap();
    assert_eq!(found, scalars(&geometry, &[]));
}

/// Frames that do not exist are rejected.
#[test]
fn frames_are_refused_with_a_reason() {
    let refused = |space: &str, given: &[Tensor<Symbolic>]| {
        let geometry = geometry(space);
        let metric = geometry.metric().unwrap();
        NullTetrad::new(metric, given, PositiveFactors::default()).unwrap_err().to_string()
    };
    let spacelike = vector(["0", "1", "0", "0"]);
    let time = vector(["1", "0", "0", "0"]);
    assert!(refused("minkowski", &[spacelike]).contains("not timelike or null: its norm is 1"));
    assert!(refused("minkowski", &[time.clone(), time]).contains("linearly dependent"));
    assert!(refused("3-sphere", &[]).contains("dimension 4"));
    assert!(refused("eguchi-hanson", &[]).contains("Lorentzian"));
}
