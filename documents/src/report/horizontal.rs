//! Curves of left-invariant distributions, as a report.

use super::geodesics::number;
use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::problem::{Horizontal, HorizontalCurves, WrittenPoint};
use affinor::mechanics::geodesics::HorizontalGeodesic;
use affinor::mechanics::geodesics::sub_riemannian::Conjugacy;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.horizontal/1";

/// Curves of a left-invariant distribution, ready for output.
#[derive(Clone, Debug)]
pub struct HorizontalReport(Grid);

impl HorizontalReport {
    /// The report of curves.
    pub fn new(found: &Horizontal) -> Self {
        let list =
            |numbers: &[f64]| numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ");
        let growth: Vec<String> = found.growth.iter().map(usize::to_string).collect();
        let product = match found.is_restricted {
            true => "the restriction of the metric",
            false => "these vectors are orthonormal",
        };
        let mut head: Vec<(&'static str, Cell)> = vec![
            ("distribution", printable_list(&found.distribution).into()),
            ("product", product.into()),
            ("growth", growth.join(", ").into()),
            ("components", printable_list(&found.names).into()),
            ("from", list(&found.from).into()),
        ];
        let name = printable(&found.space);
        let points = |points: &[WrittenPoint]| points.iter().map(|p| row(found, p)).collect();
        let of_points = ["time", "element", "covector"];
        let (title, header, rows): (_, &[&str], Vec<Vec<Cell>>) = match &found.curves {
            HorizontalCurves::Normal { covector, speed, points: all, conjugacy } => {
                head.extend([
                    ("covector", list(covector).into()),
                    ("speed", number(*speed).into()),
                    ("conjugate", conjugate(*conjugacy).into()),
                    ("element", "coordinates x of exp(x), or the matrix".into()),
                ]);
                (format!("Normal extremal of {name}"), &of_points, points(all))
            }
            HorizontalCurves::Abnormal { covector, points: all, vanishes } => {
                head.push(("covector", list(covector).into()));
                head.push(("speed", "1".into()));
                if let Some(time) = vanishes {
                    let text = format!(
                        "at the time {}, h_112 and h_122 vanish: the direction is open",
                        number(*time)
                    );
                    head.push(("end", text.into()));
                }
                head.push(("element", "coordinates x of exp(x), or the matrix".into()));
                (format!("Abnormal extremal of {name}"), &of_points, points(all))
            }
            HorizontalCurves::Geodesics { to, geodesics } => {
                head.extend([
                    ("to", list(to).into()),
                    ("covector", "at the start, for a parameter from 0 to 1".into()),
                    ("residual", "logarithm of the difference of the ends, for length 1".into()),
                    ("shortest", "not proved: a shorter geodesic may exist".into()),
                ]);
                let rows = geodesics.iter().map(|(geodesic, conjugacy)| {
                    let residual = format!("{:.1e}", geodesic.residual);
                    vec![
                        number(geodesic.length).into(),
                        components("p", &found.names, geodesic.covector.as_slice()),
                        residual.into(),
                        conjugate(*conjugacy).into(),
                    ]
                });
                let title = format!("Normal geodesics of {name} between two points");
                (title, &["length", "covector", "residual", "conjugate"], rows.collect())
            }
        };
        let grid = Grid::new(title, header, rows, document(found));
        HorizontalReport(grid.with_head(head))
    }
}

/// The row of a point of an extremal.
fn row(found: &Horizontal, point: &WrittenPoint) -> Vec<Cell> {
    let element = match &point.coordinates {
        Some(x) => components("x", &found.names, x.as_slice()),
        None => {
            let rows = point
                .matrix
                .row_iter()
                .map(|row| row.iter().map(|entry| number(*entry)).collect::<Vec<_>>().join(", "));
            rows.collect::<Vec<_>>().join("\n").into()
        }
    };
    let covector = components("p", &found.names, point.covector.as_slice());
    vec![number(point.time).into(), element, covector]
}

/// Lines such as `p_e1 = 0.5`.
fn components(letter: &str, names: &[String], values: &[f64]) -> Cell {
    let line = |(name, value): (&String, &f64)| {
        format!("{letter}_{} = {}", printable(name), number(*value))
    };
    names.iter().zip(values).map(line).collect::<Vec<_>>().join("\n").into()
}

/// The first conjugate time in words.
fn conjugate(conjugacy: Conjugacy) -> String {
    match conjugacy {
        Conjugacy::None { until } => format!("no time up to {}", number(until)),
        Conjugacy::At { time, multiplicity: 1 } => format!("first at {}", number(time)),
        Conjugacy::At { time, multiplicity } => {
            format!("first at {}, of multiplicity {multiplicity}", number(time))
        }
        Conjugacy::Abnormal => "all times: the extremal is also abnormal".into(),
    }
}

/// The keys of a conjugate time in JSON.
fn conjugate_keys(conjugacy: Conjugacy) -> [(&'static str, Value); 4] {
    let (time, multiplicity) = match conjugacy {
        Conjugacy::At { time, multiplicity } => (json!(time), json!(multiplicity)),
        _ => (Value::Null, Value::Null),
    };
    let until = match conjugacy {
        Conjugacy::None { until } => json!(until),
        _ => Value::Null,
    };
    [
        ("no_conjugate_until", until),
        ("conjugate_time", time),
        ("multiplicity", multiplicity),
        ("also_abnormal", json!(conjugacy == Conjugacy::Abnormal)),
    ]
}

fn point_document(point: &WrittenPoint) -> Value {
    let matrix: Vec<Vec<f64>> =
        point.matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    json!({
        "time": point.time,
        "matrix": matrix,
        "coordinates": point.coordinates.as_ref().map(|x| x.as_slice().to_vec()),
        "covector": point.covector.as_slice(),
    })
}

fn geodesic_document((geodesic, conjugacy): &(HorizontalGeodesic, Conjugacy)) -> Value {
    let mut keys = Map::new();
    keys.insert("length".into(), json!(geodesic.length));
    keys.insert("covector".into(), json!(geodesic.covector.as_slice()));
    keys.insert("end_covector".into(), json!(geodesic.end_covector.as_slice()));
    keys.insert("velocity".into(), json!(geodesic.velocity.as_slice()));
    keys.insert("residual".into(), json!(geodesic.residual));
    keys.insert("regularity".into(), json!(geodesic.regularity));
    keys.extend(conjugate_keys(*conjugacy).map(|(key, value)| (key.to_string(), value)));
    Value::Object(keys)
}

/// The report in JSON.
fn document(found: &Horizontal) -> Value {
    let mut keys = Map::new();
    let mut add = |key: &str, value: Value| keys.insert(key.into(), value);
    add("schema", json!(SCHEMA));
    add("name", json!(found.space));
    add("distribution", json!(found.distribution));
    add("orthonormal", json!(!found.is_restricted));
    add("growth_vector", json!(found.growth));
    add("components", json!(found.names));
    add("from", json!(found.from));
    let points = |points: &[WrittenPoint]| points.iter().map(point_document).collect::<Vec<_>>();
    match &found.curves {
        HorizontalCurves::Normal { covector, speed, points: all, conjugacy } => {
            add("kind", json!("normal"));
            add("covector", json!(covector));
            add("speed", json!(speed));
            add("points", json!(points(all)));
            for (key, value) in conjugate_keys(*conjugacy) {
                add(key, value);
            }
        }
        HorizontalCurves::Abnormal { covector, points: all, vanishes } => {
            add("kind", json!("abnormal"));
            add("covector", json!(covector));
            add("speed", json!(1.0));
            add("points", json!(points(all)));
            add("vanishes", json!(vanishes));
        }
        HorizontalCurves::Geodesics { to, geodesics } => {
            add("kind", json!("geodesics"));
            add("to", json!(to));
            let all: Vec<Value> = geodesics.iter().map(geodesic_document).collect();
            add("geodesics", json!(all));
        }
    }
    Value::Object(keys)
}

impl Report for HorizontalReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
