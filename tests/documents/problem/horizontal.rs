//! Curves of distributions from texts: extremals, geodesics between two points, and messages.

use affinor_documents::problem::{
    Horizontal, HorizontalCurve, HorizontalCurves, HorizontalRequest, horizontal,
};
use affinor_documents::report::{Format, HorizontalReport, Report};
use affinor_documents::space::{Request, Space};
use std::f64::consts::{PI, TAU};

fn curves(
    name: &str,
    metric: Option<&str>,
    request: &HorizontalRequest,
) -> Result<Horizontal, String> {
    let (space, metric) = (Some(name.to_string()), metric.map(str::to_string));
    let space = Space::open(&Request { space, metric, ..Request::default() });
    space.and_then(|space| horizontal(&space, request)).map_err(|error| error.to_string())
}

fn extremal<'t>(distribution: &'t str, covector: &'t str, times: &'t str) -> HorizontalRequest<'t> {
    let curve = HorizontalCurve::Extremal { covector, times, is_abnormal: false };
    HorizontalRequest { distribution, from: None, curve }
}

fn text(found: &Horizontal, format: Format) -> String {
    let mut out = vec![];
    HorizontalReport::new(found).write(format, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

/// A half circle of radius 1 on the Heisenberg group, in JSON and as text.
#[test]
fn the_exponential_map_of_the_heisenberg_group() {
    let found = curves("heisenberg(3)", None, &extremal("x1, y1", "1, 0, 1", "pi, 7")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text(&found, Format::Json)).unwrap();
    let point = report["points"][0]["coordinates"].as_array().unwrap();
    for (found, expected) in point.iter().zip([0.0, 2.0, PI / 2.0]) {
        assert!((found.as_f64().unwrap() - expected).abs() < 1e-11, "{found} is not {expected}");
    }
    assert!((report["conjugate_time"].as_f64().unwrap() - TAU).abs() < 1e-10);
    assert_eq!(report["growth_vector"], serde_json::json!([2, 3]));
    let text = text(&found, Format::Text);
    for part in ["Normal extremal of heisenberg(3)", "first at 6.283185307", "orthonormal"] {
        assert!(text.contains(part), "{text}");
    }
}

/// With a metric, the inner product is its restriction.
#[test]
fn the_restriction_of_a_metric() {
    let request = extremal("x1, y1", "z=0, x1=1, y1=0", "1");
    let found = curves("heisenberg(3)", Some("diag(4,1,1)"), &request).unwrap();
    let HorizontalCurves::Normal { speed, .. } = found.curves else { panic!("{found:?}") };
    assert!(found.is_restricted && speed == 0.5);
}

#[test]
fn geodesics_between_two_points() {
    let curve = HorizontalCurve::Between { to: "0, 0, 0.5", starts: None };
    let request = HorizontalRequest { distribution: "x1, y1", from: Some("0, 0, 0"), curve };
    let found = curves("heisenberg(3)", None, &request).unwrap();
    let text = text(&found, Format::Text);
    assert!(text.contains("not proved: a shorter geodesic may exist"), "{text}");
    let HorizontalCurves::Geodesics { geodesics, .. } = found.curves else { panic!("{found:?}") };
    assert!((geodesics[0].0.length - 2.0 * f64::sqrt(PI / 2.0)).abs() < 1e-6);
}

#[test]
fn messages() {
    let (plane, engel) = (("heisenberg(3)", "x1, y1"), ("filiform(4)", "e1, e2"));
    for ((space, distribution), covector, times, is_abnormal, message) in [
        (plane, "0,0,1", "1", false, "annihilates the distribution"),
        (plane, "1,0", "1", false, "a covector has 3"),
        (plane, "1,0,0", "0", false, "the time 0 is not positive"),
        (plane, "1,0,0", "2,1", false, "the time 1 is not after 2"),
        (("so3", "e1, e9"), "1,0,0", "1", false, "e9"),
        (("so3", "e1, 2*e1"), "1,0,0", "1", false, "span only"),
        (("S^2", "m1"), "1,0", "1", false, "needs a Lie algebra"),
        (engel, "1,0,0,1", "1", true, "h_1 = 1"),
        (("filiform(4)", "e1, e2, e3"), "0,0,0,1", "1", true, "rank 2 only"),
    ] {
        let curve = HorizontalCurve::Extremal { covector, times, is_abnormal };
        let request = HorizontalRequest { distribution, from: None, curve };
        let error = curves(space, None, &request).unwrap_err();
        assert!(error.contains(message), "{space} {covector}: {error}");
    }
}
