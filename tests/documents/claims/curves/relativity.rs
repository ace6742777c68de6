//! Geodesics of Schwarzschild and Kerr.

#![allow(clippy::excessive_precision, reason = "reference values have 25 digits")]

use super::{Curve, Rows, near, rows};

const METRIC: &str = "metric = [\"-(1 - 2*M/r)\", \"1/(1 - 2*M/r)\", \"r^2\", \"r^2*sin(theta)^2\"]\nparameters = [\"M\"]";

fn schwarzschild(velocity: &str, more: &str, radius: f64, end: f64) -> String {
    Curve {
        coordinates: "\"t\", \"r\", \"theta\", \"phi\"",
        geometry: METRIC,
        position: &format!("t = 0, r = {radius}, theta = \"pi/2\", phi = 0"),
        velocity,
        more: &format!("{more}\n[parameters]\nM = 1"),
        end,
        every: end / 10.0,
    }
    .text()
}

/// The angle of a revolution from pericentre to pericentre, `4 K(m)/sqrt(2 M (u3 - u1))`, where
/// `u1 < u2 < u3` are the zeros of `(du/dphi)^2`, and the angular momentum `1/sqrt(u1 u2 + u1 u3 +
/// u2 u3)`; mpmath, 40 digits.
#[test]
fn the_pericentre_advances_as_elliptic_integrals_tell() {
    let orbits = [
        (10.0, 8.48543349432828232266731144, 4.17028828114149525356299),
        (8.0, 8.72203221329794749180088913, 4.142860078558352047531686),
    ];
    for (radius, angle, momentum) in orbits {
        let velocity = format!("r = 0, theta = 0, phi = {}", momentum / (radius * radius));
        let more = "normalize = \"timelike\"\n[events]\nturn = \"v_r\"";
        let text = schwarzschild(&velocity, more, radius, 1500.0);
        let text = text.replace("[output]\n", "[output]\nsection = \"turn\"\n");
        let found = rows(&text);
        let phi = found.column("phi");
        assert!(phi.len() >= 4, "{found:?}");
        for (k, phi) in phi.iter().enumerate() {
            near(*phi, 0.5 * angle * (k + 1) as f64, 1e-8);
        }
        near(found.column("r")[1], radius, 1e-8);
        found.keeps_all(1e-9);
    }
}

/// The angle from the closest point to a radius `R`: `2/sqrt(2 M (u3 - u1)) (K(m) - F(z, m))` with
/// `sin(z)^2 = (1/R - u1)/(u2 - u1)`; mpmath, 40 digits.
#[test]
fn light_is_bent_as_elliptic_integrals_tell() {
    let paths =
        [(10.0, 1000.0, 1.8097335826238721900164778), (4.0, 50.0, 2.54947390859266715900723857)];
    for (closest, radius, angle) in paths {
        let velocity = "r = 0, theta = 0, phi = 0.01";
        let more = format!("normalize = \"null\"\n[events]\nfar = \"r - {radius}\"");
        let text = schwarzschild(velocity, &more, closest, 1e7);
        let text = text.replace("[output]\n", "[output]\nstop = \"far\"\n");
        let found = rows(&text);
        near(found.last("phi"), angle, 1e-9);
        near(found.last("r"), radius, 1e-7);
        near(found.last("norm"), 0.0, 1e-10);
        found.keeps_all(1e-9);
    }
}

#[test]
fn circular_orbits_have_the_frequency_of_kepler() {
    for radius in [4.0_f64, 6.0, 30.0] {
        let factor = 1.0 / (1.0 - 3.0 / radius).sqrt();
        let rate = radius.powf(-1.5) * factor;
        let velocity = format!("r = 0, theta = 0, phi = {rate}");
        let text = schwarzschild(&velocity, "normalize = \"timelike\"", radius, 50.0);
        let found = rows(&text);
        near(found.last("phi"), 50.0 * rate, 1e-9);
        near(found.last("t"), 50.0 * factor, 1e-8);
        near(found.last("proper_time"), 50.0, 1e-11);
        near(found.last("p_t"), -(1.0 - 2.0 / radius) * factor, 1e-11);
    }
}

/// Fall from rest: `r = R (1 + cos(eta))/2`, `tau = sqrt(R^3/8 M) (eta + sin(eta))`.
#[test]
fn a_fall_ends_at_the_horizon_and_says_why() {
    let radius = 10.0_f64;
    let text = schwarzschild("r = 0, theta = 0, phi = 0", "normalize = \"timelike\"", radius, 60.0);
    let Rows { rows, end, .. } = rows(&text);
    let end = end.unwrap();
    let eta = (4.0 / radius - 1.0).acos();
    let tau = (radius.powi(3) / 8.0).sqrt() * (eta + eta.sin());
    let found: f64 =
        end.split("parameter ").nth(1).unwrap().split(':').next().unwrap().parse().unwrap();
    near(found, tau, 1e-6);
    for part in ["the metric is singular there: g_t,t = -", "g_r,r = ", "r = 2.0000"] {
        assert!(end.contains(part), "{part}: {end}");
    }
    // the rows before the end are kept
    assert_eq!(rows.len(), 1 + (tau / 6.0).floor() as usize);
}

/// The same fall in the coordinates of Painleve and Gullstrand, which reach the singularity: from
/// rest at infinity, `r^(3/2) = R^(3/2) - 3/2 sqrt(2 M) tau`.
#[test]
fn a_fall_passes_the_horizon_in_regular_coordinates() {
    let text = Curve {
        coordinates: "\"t\", \"r\", \"theta\", \"phi\"], positive = [\"r\", \"M\"",
        geometry: "parameters = [\"M\"]\nmetric = [[\"-(1 - 2*M/r)\", \"sqrt(2*M/r)\", 0, 0], \
                   [\"sqrt(2*M/r)\", 1, 0, 0], [0, 0, \"r^2\", 0], [0, 0, 0, \"r^2*sin(theta)^2\"]]",
        position: "t = 0, r = 9, theta = \"pi/2\", phi = 0",
        velocity: "t = 1, r = \"-sqrt(2/9)\"",
        more: "[parameters]\nM = 1",
        end: 12.0,
        every: 1.0,
    };
    let found = rows(&text.text());
    for (s, r) in found.column("s").into_iter().zip(found.column("r")) {
        near(r, (27.0 - 1.5 * 2.0_f64.sqrt() * s).powf(2.0 / 3.0), 1e-9);
    }
    near(found.last("norm"), -1.0, 1e-9);
    let end = found.end;
    assert_eq!(end, None);
    let beyond = rows(&Curve { end: 20.0, ..text }.text());
    let end = beyond.end.unwrap();
    assert!(end.contains("r is positive on the chart") || end.contains("singular"), "{end}");
}

/// Orbits in Schwarzschild coordinates and in the coordinates of Painleve and Gullstrand.
#[test]
fn geodesics_do_not_depend_on_the_coordinates() {
    let more = "normalize = \"timelike\"\nsolve = \"t\"";
    let one = rows(&schwarzschild("r = 0.05, theta = 0.01, phi = 0.06", more, 9.0, 100.0));
    let two = Curve {
        coordinates: "\"t\", \"r\", \"theta\", \"phi\"], positive = [\"r\", \"M\"",
        geometry: "parameters = [\"M\"]\nmetric = [[\"-(1 - 2*M/r)\", \"sqrt(2*M/r)\", 0, 0], \
                   [\"sqrt(2*M/r)\", 1, 0, 0], [0, 0, \"r^2\", 0], [0, 0, 0, \"r^2*sin(theta)^2\"]]",
        position: "t = 0, r = 9, theta = \"pi/2\", phi = 0",
        velocity: "r = 0.05, theta = 0.01, phi = 0.06",
        more: &format!("{more}\n[parameters]\nM = 1"),
        end: 100.0,
        every: 10.0,
    }
    .rows();
    for name in ["r", "theta", "phi"] {
        for (a, b) in one.column(name).iter().zip(two.column(name)) {
            near(*a, b, 1e-8);
        }
    }
    near(one.last("p_t"), two.last("p_t"), 1e-9);
}

/// Lengths in another unit give the same steps, up to the last bits.
#[test]
fn steps_do_not_depend_on_units() {
    let scale = 1024.0;
    let velocity = "r = 0.05, theta = 0.01, phi = 0.06";
    let one = rows(&schwarzschild(velocity, "normalize = \"timelike\"", 9.0, 200.0));
    let small = "r = 0.05, theta = \"0.01/1024\", phi = \"0.06/1024\"";
    let text = schwarzschild(small, "normalize = \"timelike\"", 9.0 * scale, 200.0 * scale);
    let two = rows(&text.replace("M = 1\n", "M = 1024\n"));
    for (name, unit) in [("t", scale), ("r", scale), ("theta", 1.0), ("phi", 1.0)] {
        near(two.last(name) / unit, one.last(name), 1e-11 * one.last(name).abs());
    }
}

const KERR: &str = r#"
[definition]
parameters = ["M", "a"]
chart = { coordinates = ["t", "r", "theta", "phi"] }
metric = [
  ["-(1 - 2*M*r/(r^2 + a^2*cos(theta)^2))", "0", "0", "-2*M*a*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2)"],
  ["0", "(r^2 + a^2*cos(theta)^2)/(r^2 - 2*M*r + a^2)", "0", "0"],
  ["0", "0", "r^2 + a^2*cos(theta)^2", "0"],
  ["-2*M*a*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2)", "0", "0", "(r^2 + a^2 + 2*M*a^2*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2))*sin(theta)^2"],
]
[parameters]
M = 1
a = 0.9
[initial]
position = { t = 0, r = 8, theta = "pi/3", phi = 0 }
velocity = { r = 0.02, theta = 0.03, phi = 0.055 }
normalize = "timelike"
[killing.tensors]
carter = [
  ["a^2*sin(theta)^2 + a^2*cos(theta)^2*(1 - 2*M*r/(r^2 + a^2*cos(theta)^2))", 0, 0,
   "-a*sin(theta)^2*(r^2 + a^2) + a^2*cos(theta)^2*2*M*a*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2)"],
  [0, "-a^2*cos(theta)^2*(r^2 + a^2*cos(theta)^2)/(r^2 - 2*M*r + a^2)", 0, 0],
  [0, 0, "r^2*(r^2 + a^2*cos(theta)^2)", 0],
  ["-a*sin(theta)^2*(r^2 + a^2) + a^2*cos(theta)^2*2*M*a*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2)", 0, 0,
   "sin(theta)^2*(r^2 + a^2)^2 - a^2*cos(theta)^2*(r^2 + a^2 + 2*M*a^2*r*sin(theta)^2/(r^2 + a^2*cos(theta)^2))*sin(theta)^2"],
]
[integrator]
tolerance = 1e-12
[output]
end = 500
every = 50
"#;

/// The constant of Carter, from its Killing tensor, is `v_theta^2 Sigma^2 + (a E sin - L/sin)^2 +
/// a^2 cos^2` (B. Carter, *Phys. Rev.* 174 (1968) 1559).
#[test]
fn the_constant_of_carter_is_conserved() {
    let found = rows(KERR);
    assert_eq!(found.end, None);
    assert_eq!(found.conserved, ["norm", "p_t", "p_phi", "carter"]);
    found.keeps_all(1e-9);
    for k in 0..found.rows.len() {
        let of = |name: &str| found.column(name)[k];
        let (sine, cosine) = of("theta").sin_cos();
        let sigma = of("r").powi(2) + 0.81 * cosine * cosine;
        let along = -0.9 * of("p_t") * sine - of("p_phi") / sine;
        let carter = (sigma * of("v_theta")).powi(2) + along * along + 0.81 * cosine * cosine;
        near(of("carter"), carter, 1e-8);
    }
    // a tensor with another sign is an error that names a term
    let wrong = KERR.replace("[0, 0, \"r^2*(", "[0, 0, \"-r^2*(");
    let message = super::refused(&wrong);
    assert!(
        message.starts_with("carter is not conserved: its derivative along a curve has the term ("),
        "{message}"
    );
    assert!(message.contains("*v_"), "{message}");
}

/// The line `(1, s/10^4, s)` of flat spacetime.
#[test]
fn a_line_along_the_axis_is_resolved() {
    let flat = Curve {
        coordinates: "\"t\", \"r\", \"theta\", \"phi\"",
        geometry: "metric = [-1, 1, \"r^2\", \"r^2*sin(theta)^2\"]",
        position: "t = 0, r = 1, theta = \"pi/2\", phi = 0",
        velocity: "r = 0, theta = -1, phi = 1e-4",
        more: "normalize = \"timelike\"\nsolve = \"t\"",
        end: 1e6,
        every: 1e6,
    };
    let found = flat.rows();
    near(found.last("theta"), 1.0_f64.hypot(100.0).atan2(1e6), 1e-12);
    near(found.last("phi"), 100.0_f64.atan(), 1e-9);
    found.keeps_all(1e-9);
}
