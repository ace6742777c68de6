//! Scenes of the rotation group, computed: what the figures of the paper show, in numbers.
//!
//! A point is drawn at its canonical coordinates (61), (74), the rotation vector in the ball of radius
//! `pi`, where opposite points of the sphere are one rotation. How a scene looks on paper is no matter
//! of this module: `plot` does that.

mod autoparallels;
pub mod ball;
pub mod diagram;
mod frames;
mod images;
mod motion;
mod path;
pub mod run;
mod transport;

pub use autoparallels::autoparallels;
pub use frames::frames;
pub use images::images;
pub use motion::motion;
pub use path::Path;
pub use transport::transport;

use crate::group::So3;
use crate::transport::ParallelTranslation;
use nalgebra::Vector3;

/// A connection on the rotation group, and what a panel calls it.
pub struct Connected {
    /// For the head of the panel.
    pub name: String,
    /// The group with the connection.
    pub translation: ParallelTranslation<So3>,
}

/// Panels side by side.
#[derive(Clone, Debug)]
pub struct Figure {
    /// What it shows, in a line.
    pub title: String,
    /// From left to right.
    pub panels: Vec<Panel>,
}

/// What is seen in one ball.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The head; may be empty.
    pub title: String,
    /// The radius of the sphere around it.
    pub radius: f64,
    /// Symbols of the three axes.
    pub axes: [&'static str; 3],
    /// Lines.
    pub curves: Vec<Curve>,
    /// Vectors.
    pub arrows: Vec<Arrow>,
    /// Points.
    pub marks: Vec<Mark>,
}

/// A line through points.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What it is.
    pub role: Role,
    /// Its symbol; may be empty.
    pub label: String,
    /// For the legend; may be empty.
    pub caption: String,
    /// One behind the other.
    pub points: Vec<Vector3<f64>>,
}

/// A vector from a point.
#[derive(Clone, Debug)]
pub struct Arrow {
    /// What it is.
    pub role: Role,
    /// Its symbol; may be empty.
    pub label: String,
    /// For the legend; may be empty.
    pub caption: String,
    /// Its foot and its tip.
    pub ends: [Vector3<f64>; 2],
}

/// A point.
#[derive(Clone, Debug)]
pub struct Mark {
    /// Its symbol; may be empty.
    pub label: String,
    /// For the legend; may be empty.
    pub caption: String,
    /// Where it is.
    pub at: Vector3<f64>,
}

/// What a line or a vector is: one look for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The curve of a motion.
    Motion,
    /// The autoparallel that is spoken of.
    Autoparallel,
    /// One autoparallel among many.
    Ray,
    /// An auxiliary line.
    Guide,
    /// A curve dropped onto the plane of the first two axes.
    Shadow,
    /// The tangent of an autoparallel.
    Direction,
    /// The tangent of a motion.
    Velocity,
    /// Its left translate to the identity.
    Left,
    /// Its right translate to the identity.
    Right,
    /// What a connection carries.
    Carried,
    /// What it carries, on the way.
    Trace,
    /// One of the three vectors of a frame.
    Frame(usize),
}

impl Panel {
    /// The ball of rotation vectors with nothing in it but the identity.
    fn ball(title: impl Into<String>) -> Self {
        let e = Mark::new("e", "e, the identity", Vector3::zeros());
        let axes = ["Ψ¹", "Ψ²", "Ψ³"];
        let title = title.into();
        Panel { title, radius: ball::RADIUS, axes, curves: vec![], arrows: vec![], marks: vec![e] }
    }

    fn curve(&mut self, role: Role, [label, caption]: [&str; 2], pieces: Vec<Vec<Vector3<f64>>>) {
        // the symbol stands once, at the first piece
        for (i, points) in pieces.into_iter().enumerate() {
            let label = if i == 0 { label.into() } else { String::new() };
            self.curves.push(Curve { role, label, caption: caption.into(), points });
        }
    }

    fn arrow(&mut self, role: Role, [label, caption]: [&str; 2], ends: [Vector3<f64>; 2]) {
        self.arrows.push(Arrow { role, label: label.into(), caption: caption.into(), ends });
    }
}

impl Mark {
    fn new(label: &str, caption: &str, at: Vector3<f64>) -> Self {
        Mark { label: label.into(), caption: caption.into(), at }
    }
}
