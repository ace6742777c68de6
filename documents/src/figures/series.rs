//! Diagrams of columns of a trajectory, plotted over time or against each other.

use super::diagram::{Diagram, Drawn, Graph, Line, Scale};
use crate::rows::RunRows;
use affinor::Error;

/// The largest ratio of the ranges of two columns that still get equal units.
const SIMILAR: f64 = 4.0;

/// The diagram of columns over time, or over another parameter of a curve.
///
/// # Errors
/// [`Error::Name`] for an unknown column.
pub fn over_time(run: &RunRows, names: &[String], parameter: &str) -> Result<Diagram, Error> {
    let times = run.column(parameter)?;
    let line = |name: &String| {
        let points = times.iter().copied().zip(run.column(name)?).map(|(t, value)| [t, value]);
        Ok(Line { caption: name.clone(), points: points.collect(), drawn: Drawn::Line })
    };
    let mut lines = names.iter().map(line).collect::<Result<Vec<_>, Error>>()?;
    let label = names.join(", ");
    if let [line] = &mut lines[..] {
        line.caption.clear();
    }
    let is_time = parameter == "t";
    let axis = if is_time { "time t".to_string() } else { format!("parameter {parameter}") };
    let (x, y) = (Scale::linear(&axis), Scale::linear(if names.len() > 4 { "" } else { &label }));
    let over = if is_time { "time" } else { "the parameter" };
    Ok(Diagram {
        title: format!("{}: over {over}", run.name),
        graphs: vec![Graph { x, y, equal: false, lines }],
    })
}

/// The curve of a motion in the plane of two columns.
///
/// # Errors
/// [`Error::Name`] for an unknown column.
pub fn phase(run: &RunRows, names: &[String; 2]) -> Result<Diagram, Error> {
    plane(run, names, Drawn::Directed, format!("{}: phase plot", run.name))
}

/// The points of a motion at the occurrences of an event, in the plane of two columns.
///
/// # Errors
/// [`Error::Name`] for an unknown column.
pub fn section(run: &RunRows, names: &[String; 2], event: &str) -> Result<Diagram, Error> {
    let points = if run.rows.len() == 1 { "point" } else { "points" };
    let title = format!("{}: section at {event}, {} {points}", run.name, run.rows.len());
    plane(run, names, Drawn::Points, title)
}

/// Draws the plane of two columns. Components of one quantity, such as `x1` and `x2`, get axes with
/// equal units, unless one of the columns hardly changes.
fn plane(
    run: &RunRows,
    [x, y]: &[String; 2],
    drawn: Drawn,
    title: String,
) -> Result<Diagram, Error> {
    let columns = [run.column(x)?, run.column(y)?];
    let widths = columns.each_ref().map(|values| {
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        high - values.iter().copied().fold(f64::INFINITY, f64::min)
    });
    let stem =
        |name: &str| name.trim_end_matches(|letter: char| letter.is_ascii_digit()).to_owned();
    let similar = widths[0] <= SIMILAR * widths[1] && widths[1] <= SIMILAR * widths[0];
    let equal = stem(x) == stem(y) && similar;
    let points = columns[0].iter().zip(&columns[1]).map(|(x, y)| [*x, *y]).collect();
    let lines = vec![Line { caption: String::new(), points, drawn }];
    let (x, y) = (Scale::linear(x), Scale::linear(y));
    Ok(Diagram { title, graphs: vec![Graph { x, y, equal, lines }] })
}
