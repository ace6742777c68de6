//! Autoparallels and parallel transport of a vector in the ball of rotation vectors, by several connections.

use super::Refusal;
use affinor::Error;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{LieGroup, So3};
use affinor_documents::figures::ball;
use affinor_documents::input::{InputError, Place, Source, numbers};
use affinor_documents::report::{Report, listing};
use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};
use serde_json::{Value, json};

/// The largest number of points of a path.
const POINTS: usize = 400;
/// The number of intervals of an arc and of an autoparallel in a picture.
const SAMPLES: u32 = 24;
const RAY: u32 = 72;
/// The number of transported vectors in a picture, unless the path has more points.
const STOPS: usize = 12;
const TOLERANCE: f64 = 1e-9;
/// The default path and vector.
const PATH: &str = "0, 0, 0; 1.5, 0, 0; 0, 1.5, 0.6; 0, 0, 0";
const VECTOR: &str = "0, 0, 1";

type Pieces = Vec<Vec<Vector3<f64>>>;

/// A path of arcs `g exp(s x)`, and a vector at its start.
struct Journey {
    points: Vec<Vector3<f64>>,
    elements: Vec<UnitQuaternion<f64>>,
    vector: Vector3<f64>,
}

/// A position on the path: its point, and the left components of the transported vector.
struct Stop {
    at: Vector3<f64>,
    left: Vector3<f64>,
}

/// The report for a path, given by points separated by semicolons, and a vector; with a metric, its
/// Levi-Civita connection is added.
pub(super) fn transport(
    path: &str,
    vector: &str,
    metric: &str,
) -> Result<Box<dyn Report>, Refusal> {
    let journey = Journey::read(path, vector)?;
    let metric = Some(metric.trim()).filter(|metric| !metric.is_empty());
    let mut names = vec!["plus", "zero", "minus"];
    names.extend(metric.map(|_| "levi-civita"));
    let (mut panels, mut rows) = (vec![], vec![]);
    for name in names {
        let of_metric = metric.filter(|_| name == "levi-civita");
        let (title, translation) = ball::connected(name, of_metric)?;
        let stops = journey.carried(&translation)?;
        let words = journey.words(&title, &stops);
        let scale = if journey.vector.norm() > 0.0 { 0.8 / journey.vector.norm() } else { 1.0 };
        let arrows = stops.iter().map(|Stop { at, left }| ball::arrow(at, left, scale));
        let arrows = arrows.collect::<Result<Vec<_>, _>>()?;
        let rays = [Vector3::x(), Vector3::y(), Vector3::z()];
        let rays = rays.into_iter().flat_map(|axis| [axis, -axis]);
        let rays = rays.map(|n| journey.ray(&translation, &n)).collect::<Result<Vec<_>, _>>()?;
        let own = journey.vector.try_normalize(0.0).map(|n| journey.ray(&translation, &n));
        panels.push(json!({
            "title": title,
            "about": words,
            "rays": rays.iter().map(drawn).collect::<Vec<_>>(),
            "own": own.transpose()?.as_ref().map(drawn),
            "arrows": arrows.iter().map(|ends| [short(&ends[0]), short(&ends[1])]).collect::<Vec<_>>(),
        }));
        rows.extend(stops.iter().enumerate().map(|(number, Stop { at, left })| {
            let numbers = at.iter().chain(left).map(|x| format!("{:.6}", x + 0.0));
            [vec![title.clone(), number.to_string()], numbers.collect()].concat()
        }));
    }
    let json = json!({
        "schema": "affinor.transport/1",
        "radius": ball::RADIUS,
        "points": journey.points.iter().map(|x| x.as_slice()).collect::<Vec<_>>(),
        "path": drawn(&journey.curve()?),
        "panels": panels,
    });
    let header = ["connection", "stop", "x1", "x2", "x3", "u1", "u2", "u3"];
    let title = "Parallel transport along a path of rotations";
    Ok(Box::new(listing(title, &header, rows, json)))
}

impl Journey {
    fn read(path: &str, vector: &str) -> Result<Self, Refusal> {
        let given = |text: &str, default: &str| {
            if text.trim().is_empty() { default.to_string() } else { text.to_string() }
        };
        // parses three numbers from a position in the text on
        let three = |name: &str, text: &str, from: usize, part: &str| {
            let moved = |mut error: InputError| {
                if let Some(Place { source, span: Some(span) }) = error.at.as_deref_mut() {
                    *source = Source::new(name, text);
                    *span = span.start + from..span.end + from;
                }
                error
            };
            let [x, y, z] = numbers(&Source::new(name, part)).map_err(moved)?[..] else {
                return Err(Refusal::new(format!("`{}` has not three components", part.trim())));
            };
            Ok(Vector3::new(x, y, z))
        };
        let path = given(path, PATH);
        let mut end = 0;
        let parts = path.split(';').map(|part| {
            let from = end;
            end += part.len() + 1;
            (from, part)
        });
        let points = parts.filter(|(_, part)| !part.trim().is_empty());
        let points = points.map(|(from, part)| three("path", &path, from, part));
        let points = points.collect::<Result<Vec<_>, _>>()?;
        if points.len() < 2 || points.len() > POINTS {
            let message = format!("a path has 2 to {POINTS} points, not {}", points.len());
            return Err(Refusal::new(message));
        }
        if let Some(far) = points.iter().find(|point| point.norm() > ball::RADIUS * (1.0 + 1e-9)) {
            let message = format!("the point {} is outside the ball of radius pi", written(far));
            return Err(Refusal::new(message));
        }
        let vector = given(vector, VECTOR);
        let vector = three("vector", &vector, 0, &vector)?;
        if vector.norm() > 1e6 {
            return Err(Refusal::new("the vector is longer than a million"));
        }
        let elements = points.iter().map(|x| So3.exp(x)).collect();
        Ok(Journey { points, elements, vector })
    }

    /// The arcs between neighbours, as rotation vectors.
    fn arcs(&self) -> Result<Vec<Vector3<f64>>, Error> {
        self.elements.windows(2).map(|pair| So3.log(&So3.between(&pair[0], &pair[1]))).collect()
    }

    fn curve(&self) -> Result<Pieces, Error> {
        let mut elements = vec![self.elements[0]];
        for (g, x) in self.elements.iter().zip(self.arcs()?) {
            let share = |k: u32| f64::from(k) / f64::from(SAMPLES);
            elements.extend((1..=SAMPLES).map(|k| So3.compose(g, &So3.exp(&(x * share(k))))));
        }
        ball::curve(&elements)
    }

    /// The transported vector at the points of the path and, on long arcs, between them.
    fn carried(&self, translation: &ParallelTranslation<So3>) -> Result<Vec<Stop>, Error> {
        let arcs = self.arcs()?;
        let parts = STOPS.div_ceil(arcs.len());
        let mut along = DMatrix::identity(3, 3);
        let mut stops = vec![Stop { at: self.points[0], left: self.vector }];
        for (i, x) in arcs.iter().enumerate() {
            for part in 1..=parts {
                let share = part as f64 / parts as f64;
                let carried = translation.along_subgroup(&(x * share))? * &along;
                let left = &carried * DVector::from_column_slice(self.vector.as_slice());
                let at = if part == parts {
                    along = carried;
                    self.points[i + 1]
                } else {
                    So3.log(&So3.compose(&self.elements[i], &So3.exp(&(x * share))))?
                };
                stops.push(Stop { at, left: Vector3::from_column_slice(left.as_slice()) });
            }
        }
        Ok(stops)
    }

    /// The autoparallel from the start along a unit vector, over a half turn.
    fn ray(&self, by: &ParallelTranslation<So3>, n: &Vector3<f64>) -> Result<Pieces, Error> {
        let times: Vec<f64> =
            (0..=RAY).map(|k| ball::RADIUS * f64::from(k) / f64::from(RAY)).collect();
        let curve = by.autoparallel(&self.elements[0], n, &times, TOLERANCE)?;
        ball::curve(&curve.into_iter().map(|tangent| tangent.base).collect::<Vec<_>>())
    }

    /// A description of the picture in words.
    fn words(&self, title: &str, stops: &[Stop]) -> String {
        let [start, end] = [0, stops.len() - 1].map(|at| &stops[at]);
        let closed = (end.at - start.at).norm() < 1e-9;
        let (from, to) = (start.left, end.left);
        // a connection that preserves lengths rotates the vector
        let kept = (from.norm() - to.norm()).abs() <= 1e-9 * from.norm();
        let turn = from.angle(&to).to_degrees();
        let turned = if kept { format!(", turned by {turn:.2} degrees") } else { String::new() };
        let round = if closed { "The path is closed. " } else { "" };
        format!(
            "{title}. {round}The vector {} at {} arrives at {} as {}{turned}, in the left-invariant frame.",
            written(&from),
            written(&start.at),
            written(&end.at),
            written(&to)
        )
    }
}

fn written(x: &Vector3<f64>) -> String {
    let numbers = x.iter().map(|x| format!("{}", (x * 1e4).round() / 1e4 + 0.0));
    format!("({})", numbers.collect::<Vec<_>>().join(", "))
}

/// A vector rounded for a picture.
pub(super) fn short(x: &Vector3<f64>) -> Value {
    json!([x.x, x.y, x.z].map(|x| (x * 1e5).round() / 1e5))
}

fn drawn(pieces: &Pieces) -> Value {
    let piece = |points: &Vec<Vector3<f64>>| points.iter().map(short).collect::<Vec<_>>();
    pieces.iter().map(piece).collect::<Vec<_>>().into()
}
