//! Particles in potentials and electromagnetic fields.

use super::{Curve, near, refused};

const CYLINDER: Curve = Curve {
    coordinates: "\"r\", \"phi\", \"z\"",
    geometry: "metric = [1, \"r^2\", 1]",
    position: "r = 2, phi = 0.3, z = 0",
    velocity: "r = 0.4, phi = 0.2, z = 0.5",
    more: "",
    end: 9.0,
    every: 0.5,
};

/// In the field `B` along z, the charge moves on a helix with the frequency `-q B/m`.
#[test]
fn a_charge_in_a_magnetic_field_moves_on_a_helix() {
    let forms = [
        "[forces]\nmass = \"m\"\ncharge = \"q\"\nA = { phi = \"B*r^2/2\" }",
        "[forces]\nmass = \"m\"\ncharge = \"q\"\nF = [[0, \"B*r\", 0], [\"-B*r\", 0, 0], [0, 0, 0]]",
    ];
    for (forces, conserved) in forms.iter().zip([3, 2]) {
        let more = format!("{forces}\n[parameters]\nm = 2\nq = -3\nB = 0.5");
        let found = Curve { more: &more, ..CYLINDER }.rows();
        assert_eq!(found.conserved.len(), conserved, "{:?}", found.conserved);
        found.keeps_all(1e-10);
        let (m, q, b) = (2.0, -3.0, 0.5);
        let frequency: f64 = -q * b / m;
        let (s0, c0) = 0.3_f64.sin_cos();
        let (x, y) = (2.0 * c0, 2.0 * s0);
        let (vx, vy) = (0.4 * c0 - 0.4 * s0, 0.4 * s0 + 0.4 * c0);
        for k in 0..found.rows.len() {
            let [s, r, phi, z] = ["s", "r", "phi", "z"].map(|name| found.column(name)[k]);
            let (sine, cosine) = (frequency * s).sin_cos();
            near(r * phi.cos(), x + (vx * sine - vy * (1.0 - cosine)) / frequency, 1e-9);
            near(r * phi.sin(), y + (vy * sine + vx * (1.0 - cosine)) / frequency, 1e-9);
            near(z, 0.5 * s, 1e-10);
        }
        if conserved == 3 {
            let momentum = m * 4.0 * 0.2 + q * b * 4.0 / 2.0;
            near(found.last("p_phi"), momentum, 1e-9);
        }
    }
}

/// The problem of Kepler in polar coordinates: after a period, the planet is back.
#[test]
fn a_planet_in_a_potential_moves_on_an_ellipse() {
    let more = "[forces]\nmass = 3\npotential = \"-3*k/r\"\n[parameters]\nk = 2";
    let (radius, rate) = (1.5_f64, 0.6_f64);
    let energy = 0.5 * (radius * rate).powi(2) - 2.0 / radius;
    let axis: f64 = -1.0 / energy;
    let period = std::f64::consts::TAU * (axis.powi(3) / 2.0).sqrt();
    let plane = Curve {
        coordinates: "\"r\", \"phi\"",
        geometry: "metric = [1, \"r^2\"]",
        position: "r = 1.5, phi = 0",
        velocity: "phi = 0.6",
        more,
        end: 3.0 * period,
        every: period,
    };
    let found = plane.rows();
    assert_eq!(found.conserved, ["energy", "p_phi"]);
    found.keeps_all(1e-9);
    near(found.column("energy")[0], 3.0 * energy, 1e-12);
    for (k, phi) in found.column("phi").into_iter().enumerate() {
        near(phi, std::f64::consts::TAU * k as f64, 1e-8);
    }
    near(found.last("r"), radius, 1e-9);
    // the length is the circumference of the ellipse, by its series in ((a - b)/(a + b))^2
    let minor = (radius * radius * rate) * (axis / 2.0).sqrt();
    let h = ((axis - minor) / (axis + minor)).powi(2);
    let series = 1.0
        + h / 4.0
        + h * h / 64.0
        + h.powi(3) / 256.0
        + 25.0 * h.powi(4) / 16384.0
        + 49.0 * h.powi(5) / 65536.0;
    let whole = std::f64::consts::PI * (axis + minor) * series;
    near(found.last("length"), 3.0 * whole, 1e-8);
}

#[test]
fn a_field_strength_must_be_antisymmetric() {
    let more = "[forces]\nF = [[0, 1, 0], [1, 0, 0], [0, 0, 0]]";
    let message = refused(&Curve { more, ..CYLINDER }.text());
    assert!(message.contains("antisymmetric"), "{message}");
    let more = "[forces]\nF = [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]\nA = { r = 1 }";
    let message = refused(&Curve { more, ..CYLINDER }.text());
    assert!(message.contains("twice"), "{message}");
}
