//! Curves that leave their chart end there, with the reason.

use super::{Curve, near, refused};
use std::f64::consts::FRAC_PI_2;

/// The parameter at which a curve ends, as its message tells.
fn parameter(end: &str) -> f64 {
    end.split("parameter ").nth(1).unwrap().split(':').next().unwrap().parse().unwrap()
}

#[test]
fn a_meridian_ends_at_the_pole() {
    let sphere = Curve {
        coordinates: "\"theta\", \"phi\"",
        geometry: "metric = [1, \"sin(theta)^2\"]",
        position: "theta = \"pi/2\", phi = 0",
        velocity: "theta = -1, phi = 0",
        more: "",
        end: 5.0,
        every: 0.5,
    };
    let found = sphere.rows();
    let end = found.end.as_ref().unwrap();
    near(parameter(end), FRAC_PI_2, 1e-9);
    assert!(end.contains("the metric degenerates where sin(theta) = 0"), "{end}");
    assert_eq!(found.rows.len(), 4);
}

#[test]
fn a_line_ends_at_the_declared_edge() {
    let plane = Curve {
        coordinates: "\"x\", \"y\"], positive = [\"2 - x\"",
        geometry: "metric = [1, 1]",
        position: "x = 0, y = 0",
        velocity: "x = 0.5, y = 1",
        more: "",
        end: 10.0,
        every: 1.0,
    };
    let found = plane.rows();
    let end = found.end.as_ref().unwrap();
    near(parameter(end), 4.0, 1e-12);
    assert!(end.contains("is positive on the chart, but reaches 0 there"), "{end}");
    assert!(end.contains("x = 1.99999"), "{end}");
    let outside = Curve { position: "x = 3, y = 0", ..plane };
    let message = refused(&outside.text());
    assert!(message.contains("positive on the chart"), "{message}");
}

#[test]
fn a_start_at_a_singularity_is_an_error() {
    let polar = Curve {
        coordinates: "\"r\", \"phi\"",
        geometry: "metric = [1, \"r^2\"]",
        position: "r = 0, phi = 0",
        velocity: "r = 1, phi = 1",
        more: "",
        end: 1.0,
        every: 1.0,
    };
    let message = refused(&polar.text());
    assert!(message.contains("the metric degenerates where r = 0"), "{message}");
}

/// Along the axis of a coordinate without a velocity, an event stops the curve.
#[test]
fn events_stop_a_curve() {
    let polar = Curve {
        coordinates: "\"r\", \"phi\"",
        geometry: "metric = [1, \"r^2\"]",
        position: "r = 1, phi = 0",
        velocity: "phi = 1",
        more: "[events]\neighth = \"phi - pi/4\"",
        end: 10.0,
        every: 1.0,
    };
    let text = polar.text().replace("[output]\n", "[output]\nstop = \"eighth\"\n");
    let found = super::rows(&text);
    // the line x = 1
    near(found.last("s"), 1.0, 1e-10);
    near(found.last("r"), 2.0_f64.sqrt(), 1e-10);
}
