//! Problems of motion: what a file says, read into motions.
//!
//! A problem names a space with its metric, where the motion starts, which forces there are, how it is integrated and
//! what is written down. Its numbers may be formulas in its parameters; an ensemble varies these.

mod control;
mod ensemble;
mod folder;
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
use crate::dynamics::{Adaptive, Magnus};
use crate::formula::Formula;
use crate::simulation::{Method, Motion, Side, Table};
use affinor_tensors::Tolerance;
use control::Control;
use ensemble::Ensemble;
use folder::Folder;
use inertia::Body;
use launch::Launch;
use matrices::Matrices;
use nalgebra::DMatrix;
use output::Times;
use std::borrow::Cow;
use std::path::Path;
use std::sync::OnceLock;

/// A problem of motion.
#[derive(Clone, Debug)]
pub struct Problem {
    /// What it is called.
    pub name: String,
    source: Source,
    /// Paths of the files that it names.
    files: Vec<String>,
    parameters: Vec<Parameter>,
    /// Values that stand in the place of those of the file.
    settings: Vec<(String, f64)>,
    kind: Kind,
    /// The method, unless that of the class of the problem is taken.
    pub method: Option<Method>,
    step: Option<Value>,
    control: Control,
    times: Times,
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
struct Parameter {
    name: String,
    /// A formula in those before it, unless it is the ensemble's own.
    value: Option<Value>,
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
    places: Places,
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

/// Where the file speaks of what it hands on to the space.
#[derive(Clone, Debug)]
struct Places {
    metric: Place,
    /// Unless it names none.
    connection: Option<Place>,
}

impl Places {
    /// An error in what was handed on, at its place in the file.
    fn moved(&self, error: InputError) -> InputError {
        let error = error.moved("--metric", &self.metric);
        match &self.connection {
            Some(place) => error.moved("--connection", place),
            None => error,
        }
    }
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
    /// The times of its rows; the first is that of the start.
    pub times: Vec<f64>,
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
        let folder = Folder::new(Path::new(path).parent().unwrap_or(Path::new("")));
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
        let source = Source::new(name.escape_debug().to_string(), text);
        Self::understand(&source, &Folder::new(Path::new("")))
    }

    /// Gives parameters other values, `name=value,...`: all that depends on them follows, and an ensemble varies them
    /// no longer.
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
            let trimmed = name.trim();
            let known: Vec<&str> = self.parameters.iter().map(|known| &*known.name).collect();
            if !known.contains(&trimmed) {
                let message = format!("`{}` is no parameter here", shown(trimmed));
                let help = match known.as_slice() {
                    [] => "there are none".into(),
                    known => format!("the parameters are {}", known.join(", ")),
                };
                return Err(InputError::usage(message).at(&source.whole(name)).help(help));
            }
            let [value] = numbers(&Source::new("--set", value))?[..] else {
                let error = InputError::usage("a parameter has one value");
                return Err(error.at(&source.whole(part)));
            };
            self.settings.retain(|(other, _)| other != trimmed);
            self.settings.push((trimmed.into(), value));
            if let Some(ensemble) = &mut self.ensemble {
                ensemble.leave_out(trimmed);
            }
        }
        Ok(())
    }

    /// The values of the parameters for a member of the ensemble, from 0.
    fn values(&self, member: u64) -> Result<Vec<(String, f64)>, InputError> {
        let varied = self.varied().into_iter().zip(self.variation(member));
        let mut given: Vec<(&str, f64)> = varied.collect();
        given.extend(self.settings.iter().map(|(name, value)| (&**name, *value)));
        let mut values = Vec::with_capacity(self.parameters.len());
        for Parameter { name, value } in &self.parameters {
            let own = given.iter().find(|(other, _)| other == name);
            values.push(match (own, value) {
                (Some((_, number)), _) => *number,
                (None, Some(value)) => {
                    let number = value.at(&values);
                    number.map_err(|error| error.or_near(&self.source.key(name)))?
                }
                (None, None) => f64::NAN,
            });
        }
        let names = self.parameters.iter().map(|parameter| parameter.name.clone());
        Ok(names.zip(values).collect())
    }

    /// The times of the rows, of a member of the ensemble from 0; the first is that of the start.
    ///
    /// # Errors
    /// Times that neither increase nor decrease, or are too many; a formula without a value.
    pub fn times(&self, member: u64) -> Result<Vec<f64>, InputError> {
        self.times.at(&self.source, &numbers_of(&self.values(member)?))
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
            control: self.control.of(method, value(tolerance)),
            ..self.clone()
        }
    }

    /// The same problem with other columns, by the names of a file, and no quantities.
    #[must_use]
    pub fn with_columns(&self, names: &[&str]) -> Self {
        let place = Place::within(self.source.clone());
        let written = |name: &&str| Written { text: (*name).into(), place: place.clone() };
        let columns = names.iter().map(written).collect();
        Problem { columns, quantities: vec![], ..self.clone() }
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
        Problem { times: self.times.to_the_end(), ..self.clone() }
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// The files that it names: tables, meshes, the definition of its space.
    pub fn files(&self) -> &[String] {
        &self.files
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

    /// The control of steps along the times of a run.
    fn control_at(&self, parameters: &[f64], times: &[f64]) -> Result<Adaptive, InputError> {
        self.control.at(&self.source, parameters, times)
    }

    /// Refuses keys that the method ignores.
    fn expect_no_idle_control(&self, method: Method) -> Result<(), InputError> {
        let step = [("step", self.step.is_some() && !method.has_steps())];
        let control = self.control.given();
        let control = control.map(|(key, given)| (key, given && !method.is_controlled()));
        let mut keys = step.into_iter().chain(control);
        let Some((key, _)) = keys.find(|(_, idle)| *idle) else { return Ok(()) };
        let message = format!("the method {method} has no `{key}`");
        let help = "leave the key out, or name another method";
        Err(InputError::usage(message).at(&self.source.key(key)).help(help))
    }

    /// Checks that what comes by itself has a name of its own: casimirs, multipliers, and the columns of an ensemble.
    fn expect_distinct(&self, columns: &[Column]) -> Result<(), InputError> {
        let front =
            self.ensemble.as_ref().map_or(vec![], |_| [vec!["member"], self.varied()].concat());
        for (at, Column { name, .. }) in columns.iter().enumerate() {
            let place = self.source.key(name);
            expect_new(&columns[..at], name, &place)?;
            if front.contains(&&**name) {
                return Err(twice(name, &place));
            }
        }
        Ok(())
    }

    /// The motion; of an ensemble that of a member, from 0.
    ///
    /// # Errors
    /// What the mathematics refuses: the algebra, a degenerate metric, a method that is not for this problem.
    pub fn motion(&self, member: u64) -> Result<Ready, InputError> {
        let ready = self.launched(member)?;
        self.expect_no_idle_control(ready.method)?;
        self.expect_distinct(&ready.columns)?;
        Ok(ready)
    }

    fn launched(&self, member: u64) -> Result<Ready, InputError> {
        let parameters = self.values(member)?;
        let numbers = numbers_of(&parameters);
        let times = &*self.times.at(&self.source, &numbers)?;
        let on_group = match &self.kind {
            Kind::Matrices(matrices) => return matrices.motion(self, times, &numbers),
            Kind::Group(on_group) => on_group,
        };
        let of_space = on_group.space.definition.parameters();
        let known = |name: &&String| parameters.iter().any(|(other, _)| other == *name);
        if let Some(name) = of_space.iter().find(|name| !known(name)) {
            let message = format!("`{}` has no value", shown(name));
            let help = "give it one in a table [parameters]";
            return Err(InputError::usage(message).at(&on_group.places.metric).help(help));
        }
        let set = parameters.iter().filter(|(name, _)| of_space.contains(name));
        let set: Vec<String> = set.map(|(name, value)| format!("{name}={value:?}")).collect();
        let mut space = Cow::Borrowed(&on_group.space);
        if !set.is_empty() {
            space.to_mut().set(&set.join(","), &[])?;
        }
        let ready = space.in_floats(Tolerance::default(), |definition, reading| {
            let launch = Launch { problem: self, on_group, parameters, times, definition, reading };
            definition.on_group(reading, launch)
        });
        ready.map_err(|error| on_group.places.moved(error))
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

/// Checks that no column has the name yet.
fn expect_new(columns: &[Column], name: &str, place: &Place) -> Result<(), InputError> {
    let is_new = columns.iter().all(|column| column.name != name);
    if is_new { Ok(()) } else { Err(twice(name, place)) }
}

fn twice(name: &str, place: &Place) -> InputError {
    InputError::usage(format!("there are two columns `{}`", shown(name))).at(place)
}

/// Values without their names.
fn numbers_of(parameters: &[(String, f64)]) -> Vec<f64> {
    parameters.iter().map(|(_, value)| *value).collect()
}

/// The name of a file without its folder and ending.
fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| name.into())
}
