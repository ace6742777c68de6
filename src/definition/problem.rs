//! Problems of motion: what a file says, read into motions.
//!
//! A problem names a space with its metric, where the motion starts, which forces there are, how it is integrated and
//! what is written down. Its numbers may be formulas in its parameters; an ensemble varies these.

mod ensemble;
mod hamiltonian;
mod held;
mod inertia;
mod keys;
mod launch;
mod matrices;
mod output;
mod reader;
mod walk;

pub use walk::{Left, Walk};

use super::input::{InputError, Place, Source, shown};
use super::{Space, file, numbers};
use crate::dynamics::Magnus;
use crate::formula::Formula;
use crate::simulation::{Method, Motion, Side, Table};
use affinor_tensors::Tolerance;
use ensemble::Ensemble;
use inertia::Body;
use launch::Launch;
use matrices::Matrices;
use nalgebra::DMatrix;
use std::borrow::Cow;
use std::path::Path;
use std::sync::OnceLock;

/// A problem of motion.
#[derive(Clone, Debug)]
pub struct Problem {
    /// What it is called.
    pub name: String,
    source: Source,
    parameters: Vec<(String, f64)>,
    kind: Kind,
    /// The method, unless that of the class of the problem is taken.
    pub method: Option<Method>,
    step: Option<Value>,
    tolerance: Value,
    max_steps: usize,
    /// The times of the rows; the first is that of the start.
    pub times: Vec<f64>,
    columns: Vec<Written>,
    quantities: Vec<(String, Written)>,
    events: Vec<(String, Written)>,
    /// The event at which a motion ends.
    pub stop: Option<String>,
    /// The event that rows are taken at, in the place of times.
    pub section: Option<String>,
    ensemble: Option<Ensemble>,
}

#[derive(Clone, Debug)]
enum Kind {
    Group(Box<OnGroup>),
    Matrices(Matrices),
}

/// A system on a group.
#[derive(Clone, Debug)]
struct OnGroup {
    space: Space,
    /// The body that moves, in the place of a metric.
    inertia: Option<Body>,
    /// Whether the metric is right-invariant.
    right: bool,
    element: StartElement,
    course: Course,
    forces: Vec<Force>,
    potential: Option<Written>,
    table: Option<(Side, Table)>,
    /// A function of the momentum, in the place of a metric.
    hamiltonian: Option<Written>,
    /// What is zero.
    constraints: Vec<Written>,
    /// Polynomials in `mu1`, `mu2`, ...
    casimirs: Vec<String>,
    /// What all members of an ensemble share, where no parameter is in it.
    shared: OnceLock<launch::Ground>,
}

/// A text with its place.
#[derive(Clone, Debug)]
struct Written {
    text: String,
    place: Place,
}

/// A number as a formula in the parameters.
#[derive(Clone, Debug)]
struct Value {
    formula: Formula,
    written: Written,
}

/// A component of a force.
#[derive(Clone, Debug)]
struct Force {
    side: Side,
    index: usize,
    written: Written,
}

#[derive(Clone, Debug)]
enum StartElement {
    Identity,
    /// Canonical coordinates `x` of `exp(x)`.
    Coordinates(Vec<Value>),
    /// Rows as written.
    Rows(Vec<Vec<Value>>, Place),
    /// A quaternion `w, x, y, z`, and where the body is.
    Pose(Vec<Value>, Vec<Value>, Place),
}

/// What makes the element move.
#[derive(Clone, Debug)]
enum Course {
    /// Equations of motion, from this velocity,
    Velocity(Side, Vec<Value>),
    /// or from this momentum.
    Momentum(Side, Vec<Value>),
    /// A velocity over time.
    Given(Side, Vec<Written>),
}

/// A motion, ready to go.
pub struct Ready {
    /// The motion.
    pub motion: Box<dyn Motion>,
    /// The method that it goes by.
    pub method: Method,
    /// Names of the columns of its rows.
    pub columns: Vec<Column>,
    /// Events: their values stand behind those of the columns in a row.
    pub events: Vec<String>,
    /// The metric, of equations of motion on a group.
    pub inertia: Option<DMatrix<f64>>,
    /// What is allowed, but worth a word.
    pub notes: Vec<String>,
}

/// A column of the rows of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The formula of a quantity that was named, or of a Casimir.
    pub formula: Option<String>,
    /// Whether its change along the way is of interest.
    pub watched: bool,
}

impl Problem {
    /// Reads a problem from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// What cannot be read, parsed or understood, with its place.
    pub fn read(path: &str) -> Result<Self, InputError> {
        let folder = Path::new(path).parent().unwrap_or(Path::new("")).to_path_buf();
        Self::understand(&file::read(path)?, &folder)
    }

    /// Reads a problem from the text of a file; paths in it are taken from the present folder.
    ///
    /// ```
    /// use affinor::definition::Problem;
    /// let text = r#"
    /// space = "so3"
    /// metric = "diag(0.6, 0.8, 1)"
    /// initial.momentum = [1.8, 0.4, -0.9]
    /// output = { end = 1, every = 0.5 }
    /// "#;
    /// let problem = Problem::parse("body.toml", text)?;
    /// let mut ready = problem.motion(0)?;
    /// while !ready.motion.step(1.0)? {}
    /// assert_eq!(ready.method.name(), "exact");
    /// let energy = ready.columns.iter().position(|column| column.name == "energy").unwrap();
    /// assert!((ready.motion.row()[energy] - 3.205).abs() < 1e-14);
    /// # Ok::<(), affinor::definition::InputError>(())
    /// ```
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::understand(&Source::new(name.escape_debug().to_string(), text), Path::new(""))
    }

    /// Gives parameters other values, `name=value,...`.
    ///
    /// # Errors
    /// A name that is no parameter; what is no number.
    pub fn set(&mut self, text: &str) -> Result<(), InputError> {
        let source = Source::new("--set", text);
        for part in source.text.split(',').filter(|part| !part.trim().is_empty()) {
            let Some((name, value)) = part.split_once('=') else {
                let error = InputError::usage("a setting is name=value");
                return Err(error.at(&source.whole(part)));
            };
            let known = self.parameters.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
            let parameter = self.parameters.iter_mut().find(|(other, _)| *other == name.trim());
            let Some((_, parameter)) = parameter else {
                let message = format!("`{}` is no parameter here", shown(name.trim()));
                let help = match known.as_slice() {
                    [] => "there are none".into(),
                    known => format!("the parameters are {}", known.join(", ")),
                };
                return Err(InputError::usage(message).at(&source.whole(name)).help(help));
            };
            let [value] = numbers(&Source::new("--set", value))?[..] else {
                let error = InputError::usage("a parameter has one value");
                return Err(error.at(&source.whole(part)));
            };
            *parameter = value;
        }
        Ok(())
    }

    /// The same problem with another method, with steps of this length, or to this tolerance.
    #[must_use]
    pub fn with_method(&self, method: Method, step: Option<f64>, tolerance: f64) -> Self {
        let value = |number: f64| Value {
            formula: Formula::number(number),
            written: Written {
                text: number.to_string(),
                place: Place::within(self.source.clone()),
            },
        };
        Problem {
            method: Some(method),
            step: step.map(value),
            tolerance: value(tolerance),
            ..self.clone()
        }
    }

    /// The best method with steps, of problems that have no tolerance.
    pub fn own_class(&self) -> Option<Method> {
        match &self.kind {
            Kind::Matrices(_) => Some(Method::ComposedIsospectral),
            Kind::Group(on_group) => {
                matches!(on_group.course, Course::Given(..)).then_some(Method::Magnus(Magnus::Six))
            }
        }
    }

    /// The same problem with rows at the end only.
    #[must_use]
    pub fn to_the_end(&self) -> Self {
        let times = [self.times[0], self.times[self.times.len() - 1]];
        Problem { times: times.to_vec(), ..self.clone() }
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// How many members the ensemble has; none without one.
    pub fn members(&self) -> Option<u64> {
        self.ensemble.as_ref().and_then(Ensemble::checked_size)
    }

    /// The names of the parameters that an ensemble varies.
    pub fn varied(&self) -> Vec<&str> {
        self.ensemble.iter().flat_map(|ensemble| ensemble.names()).collect()
    }

    /// The values of the parameters that the ensemble varies, for a member from 0.
    pub fn variation(&self, member: u64) -> Vec<f64> {
        self.ensemble.as_ref().map_or(vec![], |ensemble| ensemble.values(member))
    }

    /// The length of steps, where there is one.
    fn step_at(&self, parameters: &[f64]) -> Result<Option<f64>, InputError> {
        let step = self.step.as_ref().map(|step| step.positive(parameters)).transpose();
        step.map_err(|error| error.or_near(&self.source.key("step")))
    }

    fn tolerance_at(&self, parameters: &[f64]) -> Result<f64, InputError> {
        let tolerance = self.tolerance.positive(parameters);
        tolerance.map_err(|error| error.or_near(&self.source.key("tolerance")))
    }

    /// The motion; of an ensemble that of a member, from 0.
    ///
    /// # Errors
    /// What the mathematics refuses: the algebra, a degenerate metric, a method that is not for this problem.
    pub fn motion(&self, member: u64) -> Result<Ready, InputError> {
        let mut parameters = self.parameters.clone();
        for (name, value) in self.varied().into_iter().zip(self.variation(member)) {
            match parameters.iter_mut().find(|(other, _)| other == name) {
                Some((_, old)) => *old = value,
                None => parameters.push((name.into(), value)),
            }
        }
        let on_group = match &self.kind {
            Kind::Matrices(matrices) => {
                let values: Vec<f64> = parameters.iter().map(|(_, value)| *value).collect();
                return matrices.motion(self, &values);
            }
            Kind::Group(on_group) => on_group,
        };
        let of_space = on_group.space.definition.parameters();
        let set = parameters.iter().filter(|(name, _)| of_space.contains(name));
        let set: Vec<String> = set.map(|(name, value)| format!("{name}={value:?}")).collect();
        let mut space = Cow::Borrowed(&on_group.space);
        if !set.is_empty() {
            space.to_mut().set(&set.join(","), &[])?;
        }
        space.in_floats(Tolerance::default(), |definition, reading| {
            let launch = Launch { problem: self, on_group, parameters, definition, reading };
            definition.on_group(reading, launch)
        })
    }
}

impl Value {
    /// The number at these values of the parameters.
    fn at(&self, parameters: &[f64]) -> Result<f64, InputError> {
        let value = self.formula.value(parameters);
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("`{}` is {value}", shown(&self.written.text));
        Err(InputError::mathematics(message).at(&self.written.place))
    }

    /// The number, which has to be above zero.
    fn positive(&self, parameters: &[f64]) -> Result<f64, InputError> {
        let value = self.at(parameters)?;
        if value > 0.0 {
            return Ok(value);
        }
        let message = format!("{value} is not above zero");
        Err(InputError::usage(message).at(&self.written.place))
    }

    /// The numbers of a list.
    fn all(list: &[Value], parameters: &[f64]) -> Result<Vec<f64>, InputError> {
        list.iter().map(|value| value.at(parameters)).collect()
    }
}

/// The name of a file without its folder and ending.
fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| name.into())
}
