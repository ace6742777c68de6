//! `affinor plot`: figures of trajectories and of Paraskevopoulos and Natsiavas (2013), as SVG, and
//! with the feature `png` as PNG and GIF.

mod convergence;
mod drift;
#[cfg(feature = "png")]
mod raster;
mod run;

use super::color::ColorOption;
use super::columns::Expected;
use super::failure::Failure;
use super::note::{line, note};
use super::options::{Settings, SpaceOptions};
use super::output::deliver;
use super::rows::read;
use affinor::Error;
use affinor_documents::figures;
use affinor_documents::figures::diagram::Diagram;
use affinor_documents::figures::{Connected, Figure, Path};
use affinor_documents::input::InputError;
use affinor_documents::picture::{self, Picture, View};
use affinor_documents::report::dynkin_type;
use clap::{Args, Subcommand};
use convergence::Comparison;
use nalgebra::Vector3;
use run::{Columns, Trajectory};
use std::path::PathBuf;

/// The time at which the figures of the paper show the velocity.
pub const FIGURE_AT: f64 = 0.7;
/// The largest width of a picture, in pixels.
const MAX_WIDTH: u32 = 8000;
/// The shortest and the longest duration of an animation, in seconds.
const LEAST_SECONDS: f64 = 0.1;
const MOST_SECONDS: f64 = 90.0;
/// The largest rotation between two frames, in radians, at which an animation is still clear.
const MOST_TURN: f64 = 0.5;

#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    figure: Kind,
}

#[derive(Subcommand)]
enum Kind {
    /// Angular velocity w of a motion, and its images Omega (left) and omega (right) at the
    /// identity
    #[command(visible_alias = "figure2")]
    Images(OnMotion),
    /// Angular velocity of a motion, transported to the identity by several connections
    #[command(visible_alias = "figure3")]
    Transport(OnConnections),
    /// Autoparallels through the identity, in canonical coordinates
    #[command(visible_alias = "figure4")]
    Autoparallels {
        /// The highlighted autoparallel: its initial unit tangent times its length, as a rotation
        /// vector
        #[arg(long, value_name = "X", default_value = "0.9, 1.9, 1.3", allow_hyphen_values = true)]
        axis: String,
        #[command(flatten)]
        connections: Connections,
        #[command(flatten)]
        scene: Scene,
    },
    /// Motion as a curve in the rotation group, and as a rotating body
    #[command(visible_alias = "figure5")]
    Motion(OnMotion),
    /// Left-invariant frame along a motion, and the frames that several connections transport
    #[command(visible_alias = "figure6")]
    Frames(OnConnections),
    /// Problem of mechanics: paths of the body axes on the unit sphere in space
    Attitude(OnTrajectory),
    /// Problem of mechanics: path of the body momentum on its sphere, and the energy ellipsoid
    Momentum(OnTrajectory),
    /// Problem of mechanics: curve on a chart in space, by the three functions of its `embedding`
    Orbit(OnTrajectory),
    /// Problem of mechanics: animated SVG of the body, drawn as a box with its axes of inertia
    Animation {
        #[command(flatten)]
        on: OnTrajectory,
        /// The duration of the animation in seconds
        #[arg(long, value_name = "S", default_value_t = 10.0)]
        seconds: f64,
    },
    /// Problem of mechanics: columns over time
    Series(OnColumns),
    /// Problem of mechanics: one column against another, as a curve
    Phase(OnColumns),
    /// Problem of mechanics: one column against another, as points of the Poincare section that the
    /// problem defines (`section`)
    Section(OnColumns),
    /// Problem of mechanics: drift of the conserved quantities over time, for one or several
    /// methods
    Drift {
        #[command(flatten)]
        comparison: drift::Comparison,
        #[command(flatten)]
        image: Image,
    },
    /// Dynkin diagram of the Levi subalgebra of a Lie algebra, over the complex numbers
    Dynkin {
        /// The space, of which only the Lie algebra is used; see `affinor --help`
        space: String,
        /// Values of parameters, as in "h=-1"; may be repeated
        #[arg(long, value_name = "NAME=VALUE,...")]
        set: Vec<String>,
        #[command(flatten)]
        image: Image,
    },
    /// Problem of mechanics: errors of several methods against step size and computing time
    Convergence {
        #[command(flatten)]
        comparison: Comparison,
        #[command(flatten)]
        image: Image,
    },
}

#[derive(Args)]
struct OnMotion {
    #[command(flatten)]
    motion: PathOptions,
    #[command(flatten)]
    scene: Scene,
}

#[derive(Args)]
struct OnConnections {
    #[command(flatten)]
    connections: Connections,
    #[command(flatten)]
    on: OnMotion,
}

#[derive(Args)]
struct OnTrajectory {
    #[command(flatten)]
    trajectory: Trajectory,
    #[command(flatten)]
    scene: Scene,
}

#[derive(Args)]
struct OnColumns {
    #[command(flatten)]
    columns: Columns,
    #[command(flatten)]
    image: Image,
}

/// A motion of the body, and a point of time.
#[derive(Args)]
struct PathOptions {
    /// One rotation vector X1, X2, ... of the motion exp(t X1) exp(t X2) ..., 0 <= t <= 1; repeat
    /// the option for each factor [default: two factors, a steady precession]
    #[arg(long = "factor", value_name = "X", allow_hyphen_values = true)]
    factors: Vec<String>,
    /// The time t of the motion, from 0 to 1, at which the velocity and the frame are drawn
    #[arg(long, value_name = "T", default_value_t = FIGURE_AT, allow_negative_numbers = true)]
    fraction: f64,
}

/// Connections on the rotation group, one panel each.
#[derive(Args)]
struct Connections {
    /// A connection, drawn in its own panel: plus, zero, minus, lambda=1/3, or levi-civita; may be
    /// repeated
    #[arg(long = "connection", value_name = "NAME", allow_hyphen_values = true)]
    names: Vec<String>,
    /// The metric whose connection is levi-civita: identity, "diag(1,2,3)", or rows "[[1,0,0],...]"
    #[arg(long, value_name = "METRIC", allow_hyphen_values = true)]
    metric: Option<String>,
}

/// The direction of view, and the image.
#[derive(Args)]
struct Scene {
    /// The direction of view: azimuth and elevation in degrees
    #[arg(long, value_name = "A,E", default_value = "28, 20", allow_hyphen_values = true)]
    view: String,
    #[command(flatten)]
    image: Image,
}

/// The file and width of an image, and the colours of messages.
#[derive(Args)]
struct Image {
    #[cfg_attr(
        feature = "png",
        doc = "Write to this file, .svg, .png or .gif, instead of SVG on standard output"
    )]
    #[cfg_attr(not(feature = "png"), doc = "Write to this file, .svg, instead of standard output")]
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
    /// The width of the picture in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 800)]
    width: u32,
    #[command(flatten)]
    color: ColorOption,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.figure {
            Kind::Images(on) => on.print(figures::images),
            Kind::Motion(on) => on.print(figures::motion),
            Kind::Transport(OnConnections { connections, on }) => {
                let both = connections.or(&["plus", "zero"])?;
                on.print(|path, t| figures::transport(&both, path, t))
            }
            Kind::Frames(OnConnections { connections, on }) => {
                let all = connections.or(&[])?;
                on.print(|path, t| figures::frames(&all, path, t))
            }
            Kind::Autoparallels { axis, connections, scene } => {
                let axis = vector("--axis", &axis)?;
                scene.print(&figures::autoparallels(&connections.or(&["plus"])?, &axis)?)
            }
            Kind::Attitude(on) => on.scene.print(&on.trajectory.attitude()?),
            Kind::Momentum(on) => on.scene.print(&on.trajectory.momentum()?),
            Kind::Orbit(on) => on.scene.print(&on.trajectory.orbit()?),
            Kind::Animation { on, seconds } => {
                if !(LEAST_SECONDS..=MOST_SECONDS).contains(&seconds) {
                    let message = format!(
                        "--seconds {seconds} is not between {LEAST_SECONDS} and {MOST_SECONDS}"
                    );
                    return Err(InputError::usage(message).into());
                }
                let figure = on.trajectory.animation(seconds)?;
                let bodies = figure.panels.iter().flat_map(|panel| &panel.bodies);
                for turn in bodies.map(|body| body.turn).filter(|turn| *turn > MOST_TURN) {
                    note(&format!(
                        "the body rotates by {turn:.2} radians between frames: a shorter motion is clearer"
                    ));
                }
                on.scene.print(&figure)
            }
            Kind::Series(OnColumns { columns, image }) => image.print_diagram(&columns.series()?),
            Kind::Phase(OnColumns { columns, image }) => image.print_diagram(&columns.phase()?),
            Kind::Section(OnColumns { columns, image }) => image.print_diagram(&columns.section()?),
            Kind::Dynkin { space, set, image } => {
                let settings = Settings { set, tolerance: None, threads: None };
                let space = settings.open(Some(&space), &SpaceOptions::default())?;
                let types = dynkin_type(&space.definition)?;
                if types.is_empty() {
                    let message = format!("{} is solvable: it has no roots", space.definition.name);
                    return Err(InputError::mathematics(message).into());
                }
                image.print(&picture::dynkin(&space.definition.name, &types))
            }
            Kind::Drift { comparison, image } => image.print_diagram(&comparison.drift()?),
            Kind::Convergence { comparison, image } => {
                let (name, trials) = comparison.trials()?;
                for trials in &trials {
                    let orders = trials.orders().map(|order| format!(" {order:.2}"));
                    let orders: String = orders.collect();
                    let none = if orders.is_empty() { " none" } else { "" };
                    line(&format!("{}: observed orders:{none}{orders}", trials.method));
                }
                image.print_diagram(&convergence::diagram(&name, &trials))
            }
        }
    }
}

impl OnMotion {
    fn print(&self, figure: impl Fn(&Path, f64) -> Result<Figure, Error>) -> Result<(), Failure> {
        let PathOptions { factors, fraction } = &self.motion;
        if !(0.0..=1.0).contains(fraction) {
            return Err(
                InputError::usage(format!("--fraction {fraction} is not in 0 <= T <= 1")).into()
            );
        }
        let factors = factors.iter().map(|factor| vector("--factor", factor));
        let factors = factors.collect::<Result<Vec<_>, _>>()?;
        let path = if factors.is_empty() { precession() } else { Path { factors } };
        self.scene.print(&figure(&path, *fraction)?)
    }
}

/// The motion of the figures: a steady precession.
pub fn precession() -> Path {
    Path { factors: vec![Vector3::new(0.7, -2.2, 2.8), Vector3::new(2.3, 2.6, -0.2)] }
}

impl Connections {
    /// The given connections; the default ones if none are given.
    fn or(&self, default: &[&str]) -> Result<Vec<Connected>, Failure> {
        let names: Vec<&str> = match self.names.as_slice() {
            [] => default.to_vec(),
            given => given.iter().map(String::as_str).collect(),
        };
        connected(&names, self.metric.as_deref())
    }
}

/// Connections on the rotation group, given by their names. `metric` is the metric of
/// `levi-civita`.
pub fn connected(names: &[&str], metric: Option<&str>) -> Result<Vec<Connected>, Failure> {
    let open = |name: &&str| {
        let (name, translation) = figures::ball::connected(name, metric)?;
        Ok(Connected { name, translation })
    };
    names.iter().map(open).collect()
}

impl Scene {
    fn print(&self, figure: &Figure) -> Result<(), Failure> {
        let expected = Expected::vector(2, "azimuth and elevation");
        let [azimuth, elevation] = read("--view", &self.view, &expected)?[..] else {
            return Err(InputError::usage("--view: azimuth and elevation are two numbers").into());
        };
        self.image.print(&picture::draw(figure, &View { azimuth, elevation }))
    }
}

impl Image {
    fn print_diagram(&self, diagram: &Diagram) -> Result<(), Failure> {
        if let Some((axis, value)) = diagram.beyond() {
            let message = format!("{axis} reaches {value:e}, which is too large for a plot");
            return Err(InputError::mathematics(message).into());
        }
        self.print(&picture::diagram(diagram))
    }

    fn print(&self, picture: &Picture) -> Result<(), Failure> {
        if !picture.is_finite() {
            let message = format!("{}: the numbers are too large to be drawn", picture.title);
            let help = "choose units in which lengths and momenta are below 1e150";
            return Err(InputError::mathematics(message).help(help).into());
        }
        let bytes = self.encoded(picture)?;
        deliver(self.file.as_deref(), &[], |out| out.write_all(&bytes))
    }

    /// The picture in the format that the extension of the file name selects.
    fn encoded(&self, picture: &Picture) -> Result<Vec<u8>, Failure> {
        if !(1..=MAX_WIDTH).contains(&self.width) {
            let message = format!("--width {} is not between 1 and {MAX_WIDTH}", self.width);
            return Err(InputError::usage(message).into());
        }
        let svg = || picture::svg(picture, self.width).into_bytes();
        let Some(file) = &self.file else { return Ok(svg()) };
        let ending = file.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        #[cfg(feature = "png")]
        let raster = |bytes: Result<Vec<u8>, Box<dyn std::error::Error>>| {
            bytes.map_err(|reason| InputError::usage(reason.to_string()).into())
        };
        match ending.as_deref() {
            Some("svg") => Ok(svg()),
            #[cfg(feature = "png")]
            Some("png") => raster(raster::png(picture, self.width)),
            #[cfg(feature = "png")]
            Some("gif") => raster(raster::gif(picture, self.width)),
            #[cfg(not(feature = "png"))]
            Some("png" | "gif") => {
                let message = "this program was built without the feature `png`";
                let help = "write .svg, or build it with `cargo install --path cli --features png`";
                Err(InputError::usage(message).help(help).into())
            }
            _ => {
                let message = format!("{} ends in neither .svg, .png nor .gif", file.display());
                Err(InputError::usage(message).help("the ending selects the format").into())
            }
        }
    }
}

fn vector(option: &str, text: &str) -> Result<Vector3<f64>, Failure> {
    let expected = Expected::vector(3, "a rotation vector");
    Ok(Vector3::from_column_slice(&read(option, text, &expected)?))
}
