//! Diagrams: quantities over one another, in panels side by side.

/// Panels side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// What it shows, in a line.
    pub title: String,
    /// From left to right.
    pub graphs: Vec<Graph>,
}

/// Lines over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    /// To the right.
    pub x: Scale,
    /// Upwards.
    pub y: Scale,
    /// The lines.
    pub lines: Vec<Line>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// What it measures.
    pub label: String,
    /// Whether it is logarithmic.
    pub logarithmic: bool,
}

/// Points joined by a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What it is.
    pub caption: String,
    /// Right and up.
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
