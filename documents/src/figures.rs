//! Figures of trajectories and of Paraskevopoulos and Natsiavas (2013): curves, arrows and points
//! in space, and diagrams. [`picture`](crate::picture) draws them.
//!
//! A rotation is drawn as the point of its canonical coordinates (61), (74): its rotation vector,
//! in the ball of radius `pi`. Opposite points of the sphere represent the same rotation.

mod animation;
mod autoparallels;
pub mod ball;
pub mod diagram;
pub mod drift;
mod frames;
mod images;
mod motion;
mod path;
pub mod run;
pub mod series;
mod transport;

pub use animation::{Moving, animation};
pub use autoparallels::autoparallels;
pub use frames::frames;
pub use images::images;
pub use motion::motion;
pub use path::Path;
pub use transport::transport;

use crate::problem::Solid;
use affinor::group::So3;
use affinor::group::transport::ParallelTranslation;
use nalgebra::{Matrix3, Vector3};

/// A connection on the rotation group, and its name.
pub struct Connected {
    /// The name of the connection, which is the title of its panel.
    pub name: String,
    /// Parallel transport by the connection.
    pub translation: ParallelTranslation<So3>,
}

/// A figure: panels next to each other.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The title.
    pub title: String,
    /// The panels, from left to right.
    pub panels: Vec<Panel>,
}

/// The contents of one ball.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The title; may be empty.
    pub title: String,
    /// The radius of the ball.
    pub radius: f64,
    /// Whether the sphere of the ball is drawn.
    pub sphere: bool,
    /// The symbols of the three axes.
    pub axes: [&'static str; 3],
    /// Curves in the ball.
    pub curves: Vec<Curve>,
    /// Arrows in the ball.
    pub arrows: Vec<Arrow>,
    /// Marked points in the ball.
    pub marks: Vec<Mark>,
    /// Bodies in motion.
    pub bodies: Vec<Body>,
}

/// The appearance of a body in its own frame.
#[derive(Clone, Debug)]
pub enum Look {
    /// A box with its axes of inertia, which are the coordinate axes.
    Box {
        /// Half the lengths of the edges of the box, along the axes.
        half: [f64; 3],
        /// The length with which the axes are drawn, from the centre of the box.
        reach: f64,
        /// The captions of the axes.
        captions: [String; 3],
    },
    /// The body itself, as the list of its parts.
    Parts {
        /// The surfaces of the parts.
        solids: Vec<Solid>,
        /// The role of the body, which determines its colour.
        role: Role,
        /// The caption of the body.
        caption: String,
    },
}

/// A body in motion.
#[derive(Clone, Debug)]
pub struct Body {
    /// The picture of the body.
    pub look: Look,
    /// The poses of the body at equal intervals of time: the axes of its frame, as columns, and its
    /// origin.
    pub poses: Vec<(Matrix3<f64>, Vector3<f64>)>,
    /// The times of the first and the last pose.
    pub times: [f64; 2],
    /// The mean angle of rotation between two poses, in radians.
    pub turn: f64,
    /// The duration of the animation in seconds.
    pub seconds: f64,
}

/// A line through points.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The role of the curve, which determines the stroke.
    pub role: Role,
    /// The symbol at the curve; may be empty.
    pub label: String,
    /// The caption of the curve in the legend; may be empty.
    pub caption: String,
    /// The vertices, in order.
    pub points: Vec<Vector3<f64>>,
    /// Whether the curve is a path in time. Such a path has arrowheads and marks at its ends, and
    /// its far side is paler.
    pub directed: bool,
}

/// A vector from a point.
#[derive(Clone, Debug)]
pub struct Arrow {
    /// The role of the arrow, which determines the stroke.
    pub role: Role,
    /// The symbol at the arrow; may be empty.
    pub label: String,
    /// The caption of the arrow in the legend; may be empty.
    pub caption: String,
    /// The start and the tip of the arrow.
    pub ends: [Vector3<f64>; 2],
}

/// A point.
#[derive(Clone, Debug)]
pub struct Mark {
    /// The symbol at the point; may be empty.
    pub label: String,
    /// The caption of the point in the legend; may be empty.
    pub caption: String,
    /// The position of the point.
    pub at: Vector3<f64>,
}

/// The role of a curve or an arrow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A motion.
    Motion,
    /// The highlighted autoparallel.
    Autoparallel,
    /// One of several autoparallels that are not highlighted.
    Ray,
    /// An auxiliary line.
    Guide,
    /// The projection of a curve to the plane of the first two axes.
    Shadow,
    /// The tangent of an autoparallel.
    Direction,
    /// The tangent of a motion.
    Velocity,
    /// The left translate of the velocity to the identity.
    Left,
    /// The right translate of the velocity to the identity.
    Right,
    /// The velocity, transported to the identity by a connection.
    Carried,
    /// The transported velocity at points between the start and the identity.
    Trace,
    /// One of the three vectors of a frame.
    Frame(usize),
}

impl Panel {
    /// The panel of the ball of rotation vectors, with a mark at the identity.
    fn ball(title: impl Into<String>) -> Self {
        let mut panel = Panel::new(title, ball::RADIUS, ["Ψ¹", "Ψ²", "Ψ³"]);
        panel.mark("e", "e, the identity", Vector3::zeros());
        panel
    }

    fn new(title: impl Into<String>, radius: f64, axes: [&'static str; 3]) -> Self {
        let title = title.into();
        let (curves, arrows, marks) = (vec![], vec![], vec![]);
        Panel { title, radius, sphere: true, axes, curves, arrows, marks, bodies: vec![] }
    }

    fn mark(&mut self, label: &str, caption: &str, at: Vector3<f64>) {
        self.marks.push(Mark { label: label.into(), caption: caption.into(), at });
    }

    fn curve(&mut self, role: Role, [label, caption]: [&str; 2], pieces: Vec<Vec<Vector3<f64>>>) {
        // only the first piece of the curve gets the symbol
        for (i, points) in pieces.into_iter().enumerate() {
            let label = if i == 0 { label.into() } else { String::new() };
            let caption = caption.into();
            self.curves.push(Curve { role, label, caption, points, directed: false });
        }
    }

    /// Adds a path in time.
    fn path(&mut self, role: Role, caption: &str, points: Vec<Vector3<f64>>) {
        let (label, caption) = (String::new(), caption.into());
        self.curves.push(Curve { role, label, caption, points, directed: true });
    }

    fn arrow(&mut self, role: Role, [label, caption]: [&str; 2], ends: [Vector3<f64>; 2]) {
        self.arrows.push(Arrow { role, label: label.into(), caption: caption.into(), ends });
    }
}
