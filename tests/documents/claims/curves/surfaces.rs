//! Geodesics of surfaces and of flat space, and autoparallels of other connections.

#![allow(clippy::excessive_precision, reason = "reference values have 20 to 25 digits")]

use super::{Curve, SPHERE, near};

/// The point of the unit sphere, and the derivatives along the coordinates.
fn sphere(theta: f64, phi: f64) -> [[f64; 3]; 3] {
    let ((s, c), (sp, cp)) = (theta.sin_cos(), phi.sin_cos());
    [[s * cp, s * sp, c], [c * cp, c * sp, -s], [-s * sp, s * cp, 0.0]]
}

#[test]
fn geodesics_of_the_sphere_are_great_circles() {
    for (theta, phi, a, b) in [(1.1, 0.4, -0.5, 0.9), (0.05, 2.0, 0.3, 4.0), (3.0, -1.0, -1.0, 0.2)]
    {
        let position = format!("theta = {theta}, phi = {phi}");
        let velocity = format!("theta = {a}, phi = {b}");
        let rows = Curve { position: &position, velocity: &velocity, ..SPHERE }.rows();
        assert_eq!(rows.conserved, ["norm", "p_phi"]);
        rows.keeps_all(1e-10);
        let [x, along, around] = sphere(theta, phi);
        let v: Vec<f64> = (0..3).map(|i| a * along[i] + b * around[i]).collect();
        let speed = v.iter().map(|v| v * v).sum::<f64>().sqrt();
        for (k, s) in rows.column("s").into_iter().enumerate() {
            let [point, ..] = sphere(rows.column("theta")[k], rows.column("phi")[k]);
            let (sine, cosine) = (speed * s).sin_cos();
            for i in 0..3 {
                near(point[i], cosine * x[i] + sine * v[i] / speed, 1e-9);
            }
            near(rows.column("length")[k], speed * s, 1e-12);
        }
    }
}

#[test]
fn geodesics_of_the_half_plane_are_half_circles() {
    let plane = Curve {
        coordinates: "\"x\", \"y\"",
        geometry: "metric = [\"1/y^2\", \"1/y^2\"]",
        position: "x = 0.3, y = 2",
        velocity: "x = 1.5, y = 1",
        more: "normalize = \"unit\"",
        end: 5.0,
        every: 1.0,
    };
    let rows = plane.rows();
    // the centre on the axis is where the normal meets it
    let centre = 0.3 + 2.0 * 1.0 / 1.5;
    let square = (0.3_f64 - centre).powi(2) + 4.0;
    let (x, y) = (rows.column("x"), rows.column("y"));
    for k in 0..x.len() {
        near((x[k] - centre).powi(2) + y[k] * y[k], square, 1e-9);
        let apart = ((x[k] - 0.3).powi(2) + (y[k] - 2.0).powi(2)) / (2.0 * 2.0 * y[k]);
        near((1.0 + apart).acosh(), rows.column("s")[k], 1e-8);
    }
    rows.keeps_all(1e-10);
}

/// phi and the length of half a turn about the tube of a torus, as integrals by mpmath with 40
/// digits: `int L b/(rho sqrt(rho^2 - L^2))` and `int b rho/sqrt(rho^2 - L^2)` over theta, with
/// `rho = 2 + cos(theta)`, `L = 1/2`.
#[test]
fn a_geodesic_of_the_torus_has_the_integral_of_clairaut() {
    let torus = Curve {
        coordinates: "\"theta\", \"phi\"",
        geometry: "metric = [1, \"(2 + cos(theta))^2\"]",
        position: "theta = 0, phi = 0",
        velocity: "phi = \"0.5/9\"",
        more: "normalize = \"unit\"",
        end: 6.62691547111213525882817882,
        every: 1.0,
    };
    let rows = torus.rows();
    near(rows.last("theta"), std::f64::consts::TAU, 1e-10);
    near(rows.last("phi"), 1.31770533734813612076117717, 1e-10);
    assert_eq!(rows.conserved, ["norm", "p_phi"]);
    near(rows.last("p_phi"), 0.5, 1e-11);
    assert!(rows.notes[0].starts_with("v_theta = 0.98"), "{:?}", rows.notes);
}

#[test]
fn geodesics_of_flat_space_are_straight_lines() {
    let polar = Curve {
        coordinates: "\"r\", \"theta\", \"phi\"",
        geometry: "metric = [1, \"r^2\", \"r^2*sin(theta)^2\"]",
        position: "r = 2, theta = 1, phi = 0.5",
        velocity: "r = -0.7, theta = 0.2, phi = 0.3",
        more: "",
        end: 20.0,
        every: 2.0,
    };
    let rows = polar.rows();
    let [x, along, around] = sphere(1.0, 0.5);
    for k in 0..rows.rows.len() {
        let [s, r, theta, phi] = ["s", "r", "theta", "phi"].map(|name| rows.column(name)[k]);
        let [unit, ..] = sphere(theta, phi);
        for i in 0..3 {
            let v = -0.7 * x[i] + 2.0 * (0.2 * along[i] + 0.3 * around[i]);
            near(r * unit[i], 2.0 * x[i] + s * v, 1e-9);
        }
    }
}

/// The connection for which the frame `d_r`, `d_phi/r` is parallel has logarithmic spirals as
/// autoparallels, and torsion. Its curves differ from geodesics.
#[test]
fn autoparallels_of_a_parallel_frame_have_constant_components() {
    let frame = "[definition.frame]\ne1 = \"d_r\"\ne2 = \"1/r*d_phi\"";
    let given = "affinities = \"nabla[e1, e1] = 0\"\nmetric = \"identity\"\n";
    let spiral = Curve {
        coordinates: "\"r\", \"phi\"",
        geometry: &format!("{given}{frame}"),
        position: "r = 2, phi = 0.3",
        velocity: "r = 0.5, phi = 0.4",
        more: "",
        end: 8.0,
        every: 1.0,
    };
    let rows = spiral.rows();
    for k in 0..rows.rows.len() {
        let [s, r, phi, v] = ["s", "r", "phi", "v_phi"].map(|name| rows.column(name)[k]);
        near(r, 2.0 + 0.5 * s, 1e-10);
        near(phi, 0.3 + 0.8 / 0.5 * (r / 2.0).ln(), 1e-10);
        near(r * v, 0.8, 1e-10);
    }
    // a rotation is an isometry, but this connection does not conserve its momentum
    assert_eq!(rows.conserved, ["norm", "p_r"]);
    rows.keeps_all(1e-11);
}

/// The left-invariant frame of SO(3) in Euler angles, parallel by the connection `minus`. The
/// components of the velocity are constant. The curves are those of the connection `zero`,
/// because the torsion does not matter.
#[test]
fn autoparallels_do_not_depend_on_torsion() {
    let frame = "[definition.frame]\n\
        e1 = \"sin(psi)/sin(theta)*d_phi + cos(psi)*d_theta - cos(theta)/sin(theta)*sin(psi)*d_psi\"\n\
        e2 = \"cos(psi)/sin(theta)*d_phi - sin(psi)*d_theta - cos(theta)/sin(theta)*cos(psi)*d_psi\"\n\
        e3 = \"d_psi\"";
    let run = |connection: &str| {
        let curve = Curve {
            coordinates: "\"phi\", \"theta\", \"psi\"",
            geometry: &format!("connection = \"{connection}\"\n{frame}"),
            position: "phi = 0.2, theta = 1.3, psi = -0.4",
            velocity: "phi = 0.7, theta = 0.3, psi = 0.2",
            more: "",
            end: 3.0,
            every: 0.5,
        };
        curve.rows()
    };
    let all = ["minus", "zero", "plus", "lambda = 1/3"].map(run);
    for rows in &all {
        for name in ["phi", "theta", "psi"] {
            near(rows.last(name), all[0].last(name), 1e-10);
        }
        for k in 0..rows.rows.len() {
            let of = |name: &str| rows.column(name)[k];
            let ((s, c), (sp, cp)) = (of("theta").sin_cos(), of("psi").sin_cos());
            // Goldstein (4-125)
            let omega = [
                of("v_phi") * s * sp + of("v_theta") * cp,
                of("v_phi") * s * cp - of("v_theta") * sp,
                of("v_phi") * c + of("v_psi"),
            ];
            let ((s, c), (sp, cp)) = (1.3_f64.sin_cos(), (-0.4_f64).sin_cos());
            let start = [0.7 * s * sp + 0.3 * cp, 0.7 * s * cp - 0.3 * sp, 0.7 * c + 0.2];
            for i in 0..3 {
                near(omega[i], start[i], 1e-10);
            }
        }
    }
}

#[test]
fn a_curve_is_an_affine_function_of_its_parameter() {
    let one = SPHERE.rows();
    let two = Curve { velocity: "theta = -1, phi = 1.8", end: 3.0, every: 0.25, ..SPHERE }.rows();
    let back = Curve { end: -6.0, ..SPHERE }.rows();
    let turned = Curve { velocity: "theta = 0.5, phi = -0.9", ..SPHERE }.rows();
    assert_eq!(one.rows.len(), two.rows.len());
    for name in ["theta", "phi"] {
        for (a, b) in one.column(name).iter().zip(two.column(name)) {
            near(*a, b, 1e-12);
        }
        for (a, b) in back.column(name).iter().zip(turned.column(name)) {
            near(*a, b, 1e-12);
        }
    }
}
