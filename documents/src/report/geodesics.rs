//! Geodesics between two points, as a report.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use affinor::mechanics::geodesics::Geodesic;
use affinor_tensors::text::written;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.geodesic/1";

/// The geodesics between two points, ready for output.
#[derive(Clone, Debug)]
pub struct Geodesics(Grid);

impl Geodesics {
    /// The report of geodesics on a space. `names` are the names of the components of velocities,
    /// `points` the numbers of both points, `connection` the connection in words and its name, and
    /// `measure` says how residuals are measured.
    pub fn new(
        space: &str,
        connection: &[String; 2],
        names: &[String],
        points: &[Vec<f64>; 2],
        measure: &str,
        geodesics: &[Geodesic],
    ) -> Self {
        let rows = geodesics.iter().map(|geodesic| {
            let velocity = names.iter().zip(geodesic.velocity.iter());
            let velocity =
                velocity.map(|(name, v)| format!("v_{} = {}", printable(name), number(*v)));
            let velocity: Vec<String> = velocity.collect();
            let length = geodesic.length.map_or("-".into(), number);
            let residual = format!("{:.1e}", geodesic.residual);
            let velocity = Cell::from(velocity.join("\n").as_str());
            vec![
                length.as_str().into(),
                velocity,
                residual.as_str().into(),
                remark(geodesic).into(),
            ]
        });
        let title = format!("Geodesics of {} between two points", printable(space));
        let list =
            |numbers: &Vec<f64>| numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ");
        let head: Vec<(&'static str, Cell)> = vec![
            ("connection", printable(&connection[0]).into()),
            ("components", printable_list(names).into()),
            ("from", list(&points[0]).into()),
            ("to", list(&points[1]).into()),
            ("velocity", "at the start, for a parameter from 0 to 1".into()),
            ("residual", measure.into()),
        ];
        let header = ["length", "velocity", "residual", "remark"];
        let document = document(space, &connection[1], names, points, geodesics);
        let grid = Grid::new(title, &header, rows.collect(), document);
        Geodesics(grid.with_head(head))
    }
}

/// The text of a number. A very large or very small number has an exponent.
pub(super) fn number(x: f64) -> String {
    if x.abs() >= 1e16 { format!("{x:e}") } else { written(&x) }
}

/// The causal type, if the square of the velocity is not positive, and whether the points are
/// conjugate.
fn remark(geodesic: &Geodesic) -> String {
    let mut remarks = vec![];
    let size = geodesic.velocity.norm_squared();
    match geodesic.square {
        Some(square) if square.abs() <= 1e-10 * size => remarks.push("g(v, v) = 0"),
        Some(square) if square < 0.0 => remarks.push("g(v, v) < 0"),
        _ => {}
    }
    if geodesic.is_conjugate() {
        remarks.push("the points are conjugate: the geodesic may not be isolated");
    }
    remarks.join("; ")
}

/// The report in JSON.
fn document(
    space: &str,
    connection: &str,
    names: &[String],
    points: &[Vec<f64>; 2],
    geodesics: &[Geodesic],
) -> Value {
    let geodesics = geodesics.iter().map(|geodesic| {
        json!({
            "length": geodesic.length,
            "square": geodesic.square,
            "velocity": geodesic.velocity.as_slice(),
            "end_velocity": geodesic.end_velocity.as_slice(),
            "residual": geodesic.residual,
            "regularity": geodesic.regularity,
            "conjugate": geodesic.is_conjugate(),
        })
    });
    json!({
        "schema": SCHEMA,
        "name": space,
        "connection": connection,
        "components": names,
        "from": points[0],
        "to": points[1],
        "geodesics": geodesics.collect::<Vec<_>>(),
    })
}

impl Report for Geodesics {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
