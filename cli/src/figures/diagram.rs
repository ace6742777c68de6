//! Diagrams: graphs side by side.

/// Graphs side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The title.
    pub title: String,
    /// The graphs, from left to right.
    pub graphs: Vec<Graph>,
}

/// Lines in a plane with two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    /// The horizontal axis.
    pub x: Scale,
    /// The vertical axis.
    pub y: Scale,
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
    /// Whether its points are marked.
    pub marked: bool,
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
