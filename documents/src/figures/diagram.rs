//! Diagrams: one or several graphs, one above the other.

/// One or several graphs, one above the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The title.
    pub title: String,
    /// The graphs, from top to bottom.
    pub graphs: Vec<Graph>,
}

/// A graph: lines in a plane with two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    /// The horizontal axis.
    pub x: Scale,
    /// The vertical axis.
    pub y: Scale,
    /// Whether a unit has the same length on both axes.
    pub equal: bool,
    /// The lines.
    pub lines: Vec<Line>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// The label of the axis, a quantity.
    pub label: String,
    /// Whether the axis is logarithmic.
    pub logarithmic: bool,
}

/// A line through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The caption in the legend.
    pub caption: String,
    /// The points, by their values on the two axes.
    pub points: Vec<[f64; 2]>,
    /// The style of the line.
    pub drawn: Drawn,
}

/// The styles of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// A line.
    Line,
    /// A line with its points.
    Marked,
    /// The points alone.
    Points,
    /// A curve with arrowheads along its direction and with marks at its start and end.
    Directed,
    /// An auxiliary line.
    Guide,
}

impl Scale {
    /// A linear axis.
    pub fn linear(label: &str) -> Self {
        Scale { label: label.into(), logarithmic: false }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: &str) -> Self {
        Scale { label: label.into(), logarithmic: true }
    }
}

/// The largest value that a linear axis can show.
pub const LARGEST: f64 = 1e300;

impl Diagram {
    /// Finds a finite value that is too large for its axis. Returns the label of the axis and the
    /// value.
    pub fn beyond(&self) -> Option<(&str, f64)> {
        self.graphs.iter().find_map(|graph| {
            let mut points = graph.lines.iter().flat_map(|line| &line.points);
            points.find_map(|point| {
                let axes = [&graph.x, &graph.y].into_iter().zip(point);
                let mut wild = axes.filter(|(scale, value)| {
                    !scale.logarithmic && value.is_finite() && value.abs() > LARGEST
                });
                wild.next().map(|(scale, value)| (scale.label.as_str(), *value))
            })
        })
    }
}
