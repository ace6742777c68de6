//! `affinor plot`: figures of the paper and of motions as SVG or PNG.

mod run;

use super::color::Color;
use super::failure::Failure;
use super::output::deliver;
use super::rows::{Expected, read};
use affinor::definition::{InputError, Request, Space};
use affinor::figures::diagram::Diagram;
use affinor::figures::{self, Connected, Figure, Path};
use affinor::group::So3;
use affinor::plot::{self, MAX_WIDTH, View};
use affinor::transport::ParallelTranslation;
use affinor::{ConnectionKind, Error};
use affinor_tensors::Tolerance;
use clap::{Args, Subcommand};
use nalgebra::Vector3;
use run::Run;
use std::path::PathBuf;
use std::process::ExitCode;

/// A figure of the rotation group, drawn in the ball of rotation vectors, or of a motion.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    figure: Kind,
}

#[derive(Subcommand)]
enum Kind {
    /// The angular velocity w of a motion, and its images Omega and omega at the identity
    #[command(visible_alias = "figure2")]
    Images {
        #[command(flatten)]
        motion: Moving,
        #[command(flatten)]
        paper: Paper,
    },
    /// The angular velocity carried to the identity: M(3) against SO(3), or the connections given
    #[command(visible_alias = "figure3")]
    Transport {
        #[command(flatten)]
        connections: Connections,
        #[command(flatten)]
        motion: Moving,
        #[command(flatten)]
        paper: Paper,
    },
    /// Autoparallels through the identity, straight in canonical coordinates
    #[command(visible_alias = "figure4")]
    Autoparallels {
        /// The rotation vector to whose point one autoparallel is singled out
        #[arg(long, value_name = "X", default_value = "0.9, 1.9, 1.3", allow_hyphen_values = true)]
        axis: String,
        #[command(flatten)]
        connections: Connections,
        #[command(flatten)]
        paper: Paper,
    },
    /// A motion as a curve of points, and as the body that it turns
    #[command(visible_alias = "figure5")]
    Motion {
        #[command(flatten)]
        motion: Moving,
        #[command(flatten)]
        paper: Paper,
    },
    /// The left-invariant frame along a motion; with connections, the frames that they carry
    #[command(visible_alias = "figure6")]
    Frames {
        #[command(flatten)]
        connections: Connections,
        #[command(flatten)]
        motion: Moving,
        #[command(flatten)]
        paper: Paper,
    },
    /// A problem of motion: the axes of the body on the unit sphere in space
    Attitude(Run),
    /// A problem of motion: the momentum in the body, on its sphere and the ellipsoid of its energy
    Momentum(Run),
    /// A problem of motion: how far what it keeps goes from its start
    Drift(Run),
    /// A problem of motion: the error at the end over the step, and over the cost, of several methods
    Convergence {
        #[command(flatten)]
        run: Run,
        /// The methods, as in "rkmk4,cf4"
        #[arg(long, value_name = "NAMES", default_value = "rkmk4,cf4,cg3")]
        methods: String,
        /// The longest step; otherwise a sixteenth of the whole time
        #[arg(long, value_name = "H")]
        step: Option<f64>,
        /// How often it is halved
        #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=30))]
        halvings: u32,
    },
}

/// A motion of the body, and a time.
#[derive(Args)]
struct Moving {
    /// A factor of the motion exp(t X1) exp(t X2) ..., 0 <= t <= 1, as a rotation vector; repeat it
    #[arg(long = "factor", value_name = "X", allow_hyphen_values = true)]
    factors: Vec<String>,
    /// The time of the point that is looked at
    #[arg(long, value_name = "T", default_value_t = 0.7, allow_negative_numbers = true)]
    at: f64,
}

/// Connections on the rotation group, a panel each.
#[derive(Args)]
struct Connections {
    /// plus, zero, minus, lambda=1/3, or levi-civita; repeat it for panels side by side
    #[arg(long = "connection", value_name = "NAME", allow_hyphen_values = true)]
    names: Vec<String>,
    /// The metric of levi-civita: identity, "diag(1,2,3)", or rows "[[1,0,0],..]"
    #[arg(long, value_name = "METRIC", allow_hyphen_values = true)]
    metric: Option<String>,
}

/// What it is drawn on.
#[derive(Args)]
struct Paper {
    /// Write to this file, .svg or .png; without it, SVG on standard output
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
    /// The width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 800)]
    width: u32,
    /// Azimuth and elevation of the eye, in degrees
    #[arg(long, value_name = "A,E", default_value = "28, 20", allow_hyphen_values = true)]
    view: String,
    /// Colours in messages
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    color: Color,
}

impl Arguments {
    /// The outcome, and how messages are coloured.
    pub fn run(self) -> (Result<ExitCode, Failure>, Color) {
        let (figure, paper) = match self.figure {
            Kind::Images { motion, paper } => (motion.show(figures::images), paper),
            Kind::Motion { motion, paper } => (motion.show(figures::motion), paper),
            Kind::Transport { connections, motion, paper } => {
                let both = connections.or(&["plus", "zero"]);
                (
                    both.and_then(|both| motion.show(|path, t| figures::transport(&both, path, t))),
                    paper,
                )
            }
            Kind::Frames { connections, motion, paper } => {
                let all = connections.or(&[]);
                (all.and_then(|all| motion.show(|path, t| figures::frames(&all, path, t))), paper)
            }
            Kind::Attitude(run) => (run.attitude(), run.paper),
            Kind::Momentum(run) => (run.momentum(), run.paper),
            Kind::Drift(run) => {
                let color = run.paper.color;
                let diagram = run.rows().and_then(|(rows, ready)| {
                    let watched = ready.columns.into_iter().filter(|column| column.watched);
                    let watched: Vec<String> = watched.map(|column| column.name).collect();
                    Ok(figures::run::drift(&rows, &watched)?)
                });
                return (diagram.and_then(|diagram| run.paper.print_diagram(&diagram)), color);
            }
            Kind::Convergence { run, methods, step, halvings } => {
                let color = run.paper.color;
                let diagram = run.convergence(&methods, step, halvings);
                return (diagram.and_then(|diagram| run.paper.print_diagram(&diagram)), color);
            }
            Kind::Autoparallels { axis, connections, paper } => {
                let figure = || {
                    let axis = vector("--axis", &axis)?;
                    Ok(figures::autoparallels(&connections.or(&["plus"])?, &axis)?)
                };
                (figure(), paper)
            }
        };
        let color = paper.color;
        (figure.and_then(|figure| paper.print(&figure)), color)
    }
}

impl Moving {
    fn show(
        &self,
        figure: impl Fn(&Path, f64) -> Result<Figure, Error>,
    ) -> Result<Figure, Failure> {
        if !(0.0..=1.0).contains(&self.at) {
            let message = format!("--at {} is not in 0 <= T <= 1", self.at);
            return Err(InputError::usage(message).into());
        }
        let given = self.factors.iter().map(|factor| vector("--factor", factor));
        let mut factors = given.collect::<Result<Vec<_>, _>>()?;
        if factors.is_empty() {
            // a steady precession
            factors = vec![Vector3::new(0.7, -2.2, 2.8), Vector3::new(2.3, 2.6, -0.2)];
        }
        Ok(figure(&Path { factors }, self.at)?)
    }
}

impl Connections {
    /// The connections given, or else these.
    fn or(&self, default: &[&str]) -> Result<Vec<Connected>, Failure> {
        let names: Vec<&str> = match self.names.as_slice() {
            [] => default.to_vec(),
            given => given.iter().map(String::as_str).collect(),
        };
        names.into_iter().map(|name| self.open(name)).collect()
    }

    fn open(&self, name: &str) -> Result<Connected, Failure> {
        let space = Space::open(&Request {
            space: Some("so3".into()),
            connection: Some(name.into()),
            metric: self.metric.clone(),
            ..Request::default()
        })?;
        let geometry = space
            .in_floats(Tolerance::default(), |definition, reading| definition.geometry(reading))?;
        let of_paper = match geometry.kind().name() {
            "plus" => "M(3): ",
            "zero" => "SO(3): ",
            _ => "",
        };
        let kind = match geometry.kind() {
            ConnectionKind::Family(lambda) => format!("lambda = {lambda}"),
            kind => kind.name().into(),
        };
        let name = format!("{of_paper}connection {kind}");
        let translation = ParallelTranslation::new(So3, geometry.connection().clone())?;
        Ok(Connected { name, translation })
    }
}

/// How pictures are written.
#[derive(Clone, Copy)]
enum Ending {
    Svg,
    Png,
}

impl Paper {
    fn print(&self, figure: &Figure) -> Result<ExitCode, Failure> {
        let expected = Expected { numbers: 2, what: "azimuth and elevation".into() };
        let [azimuth, elevation] = read("--view", &self.view, &expected)?[..] else {
            return Err(InputError::usage("--view: azimuth and elevation are two numbers").into());
        };
        let picture = plot::draw(figure, &View { azimuth, elevation });
        self.deliver(|width| plot::svg(&picture, width))
    }

    fn print_diagram(&self, diagram: &Diagram) -> Result<ExitCode, Failure> {
        self.deliver(|width| plot::diagram(diagram, width))
    }

    fn deliver(&self, svg: impl FnOnce(u32) -> String) -> Result<ExitCode, Failure> {
        let ending = self.ending()?;
        if !(1..=MAX_WIDTH).contains(&self.width) {
            let message = format!("--width {} is not between 1 and {MAX_WIDTH}", self.width);
            return Err(InputError::usage(message).into());
        }
        let text = svg(self.width);
        let bytes = match ending {
            Ending::Svg => text.into_bytes(),
            Ending::Png => plot::rendered(&text, self.width)
                .map_err(|error| InputError::usage(error.to_string()))?,
        };
        deliver(self.file.as_deref(), &[], |out| out.write_all(&bytes))?;
        Ok(ExitCode::SUCCESS)
    }

    fn ending(&self) -> Result<Ending, Failure> {
        let Some(file) = &self.file else { return Ok(Ending::Svg) };
        let ending = file.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Ending::Svg),
            Some("png") => Ok(Ending::Png),
            _ => {
                let message = format!("{} ends in neither .svg nor .png", file.display());
                Err(InputError::usage(message).help("the ending says how it is written").into())
            }
        }
    }
}

fn vector(option: &str, text: &str) -> Result<Vector3<f64>, Failure> {
    let expected = Expected { numbers: 3, what: "a rotation vector".into() };
    Ok(Vector3::from_column_slice(&read(option, text, &expected)?))
}
