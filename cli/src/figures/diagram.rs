//! Diagrams: graphs above each other.

/// Graphs above each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The title.
    pub title: String,
    /// The graphs, from top to bottom.
    pub graphs: Vec<Graph>,
}

/// Lines in a plane with two axes.
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
    /// The quantity.
    pub label: String,
    /// Whether it is logarithmic.
    pub logarithmic: bool,
}

/// A line through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The caption in the legend.
    pub caption: String,
    /// The values on the two axes.
    pub points: Vec<[f64; 2]>,
    /// The way in which it is drawn.
    pub drawn: Drawn,
}

/// The ways in which a line is drawn.
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
