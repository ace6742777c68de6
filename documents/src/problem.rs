//! Problems of motion: files that are parsed into motions.
//!
//! The class of a problem is one of: Euler-Poincare equations, with or without constraints;
//! Lie-Poisson equations; a prescribed velocity; an isospectral flow of matrices. All classes have
//! parameters, integration settings, output settings and, optionally, an ensemble that varies
//! parameters. Every number may be a formula in the parameters.
//!
//! In reading order: `keys` defines the keys of a file; `reader` evaluates them; each class has a
//! file that builds its part of a [`Problem`]. A problem starts motions ([`Ready`]), which an
//! [`Integration`] integrates.

mod body;
mod constrained;
mod ensemble;
mod euler_poincare;
mod forces;
mod initial;
mod integration;
mod integrator;
mod keys;
mod lie_poisson;
mod matrix_flow;
mod on_group;
mod output;
mod prescribed_velocity;
mod reader;
mod ready;
mod solid;

pub use integration::{Integration, Progress};
pub use ready::{Column, Factor, Ready};
pub use solid::Solid;

use crate::input::{InputError, Source, file, numbers::numbers_in, parse_keys};
use crate::space::setting::no_parameter;
use affinor::mechanics::simulation::{Class as MethodClass, ForceFrame, ForceFunction, Method};
use constrained::Constrained;
use ensemble::Ensemble;
use euler_poincare::EulerPoincare;
use integrator::{Integrator, Member, method_of, values_of};
use keys::Keys;
use lie_poisson::LiePoisson;
use matrix_flow::MatrixFlow;
use on_group::OnGroup;
use output::{Output, expect_distinct};
use prescribed_velocity::PrescribedVelocity;
use reader::{Reader, Value};
use std::path::Path;

/// A problem of motion.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The name.
    pub name: String,
    source: Source,
    /// The paths of other files to which the problem refers.
    files: Vec<String>,
    parameters: Vec<Parameter>,
    /// Values that replace values of the file.
    settings: Vec<(String, f64)>,
    class: Class,
    integrator: Integrator,
    output: Output,
    ensemble: Option<Ensemble>,
}

#[derive(Clone, Debug)]
struct Parameter {
    name: String,
    /// A formula in the earlier parameters; `None` for a parameter that only the ensemble defines.
    value: Option<Value>,
}

/// The classes of problems; all but one are on a group.
#[derive(Clone, Debug)]
enum Class {
    MatrixFlow(Box<MatrixFlow>),
    EulerPoincare(Box<OnGroup>, Box<EulerPoincare>),
    Constrained(Box<OnGroup>, Box<Constrained>),
    LiePoisson(Box<OnGroup>, Box<LiePoisson>),
    PrescribedVelocity(Box<OnGroup>, Box<PrescribedVelocity>),
}

impl Class {
    fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        if let Some(flow) = &keys.flow {
            return Ok(Class::MatrixFlow(MatrixFlow::read(flow, reader)?.into()));
        }
        let group = Box::new(OnGroup::read(keys, reader)?);
        if let Some(prescribed) = &keys.prescribed {
            let class = PrescribedVelocity::read(prescribed, reader)?;
            return Ok(Class::PrescribedVelocity(group, class.into()));
        }
        if let Some(hamiltonian) = &keys.hamiltonian {
            let class = LiePoisson::read(hamiltonian, keys, &group, reader)?;
            return Ok(Class::LiePoisson(group, class.into()));
        }
        if keys.constraints.is_some() {
            let class = Constrained::read(keys, &group, reader)?;
            return Ok(Class::Constrained(group, class.into()));
        }
        let class = EulerPoincare::read(keys, &group, reader)?;
        Ok(Class::EulerPoincare(group, class.into()))
    }

    /// The motion of a member of the ensemble.
    fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        match self {
            Class::MatrixFlow(flow) => flow.motion(member),
            Class::EulerPoincare(group, class) => group.start(member, |start| class.motion(start)),
            Class::Constrained(group, class) => group.start(member, |start| class.motion(start)),
            Class::LiePoisson(group, class) => group.start(member, |start| class.motion(start)),
            Class::PrescribedVelocity(group, class) => {
                group.start(member, |start| class.motion(start))
            }
        }
    }
}

impl Problem {
    /// Reads a problem from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// An error with its location, for a file that cannot be read, parsed or understood.
    pub fn read(path: &str) -> Result<Self, InputError> {
        let ending = Path::new(path).extension().and_then(|ending| ending.to_str());
        if let Some(ending @ ("csv" | "parquet" | "arrow")) = ending {
            let shown = path.escape_debug();
            let message = format!("{shown} contains rows, not a problem");
            let help = format!("name the problem, a TOML file, and the rows as --rows {shown}");
            let help =
                if ending == "arrow" { "name the problem, a TOML file".into() } else { help };
            return Err(InputError::usage(message).help(help));
        }
        Self::of_source(&file::read(path)?, Path::new(path).parent().unwrap_or(Path::new("")))
    }

    /// Reads a problem from the text of a file; paths in it are relative to the current folder.
    ///
    /// ```
    /// use affinor_documents::problem::Problem;
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
    /// # Ok::<(), affinor_documents::input::InputError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::of_source(&Source::new(name.escape_debug().to_string(), text), Path::new(""))
    }

    /// Reads a problem whose file is in the given folder.
    fn of_source(source: &Source, folder: &Path) -> Result<Self, InputError> {
        let content = "give a space, its metric, initial values and an output";
        let (keys, source): (Keys, Source) = parse_keys(source, content)?;
        let mut reader = Reader::new(&source, folder);
        let mut values = Vec::new();
        for (name, number) in keys.parameters.iter().flat_map(|table| &table.0) {
            values.push(Some(reader.value(number)?));
            reader.declare(name)?;
        }
        let ensemble = keys.ensemble.as_ref();
        let ensemble = ensemble.map(|keys| Ensemble::read(keys, &mut reader)).transpose()?;
        let values = values.into_iter().chain(std::iter::repeat(None));
        let parameters = reader.names.iter().cloned().zip(values);
        let stem = Path::new(&source.name).file_stem();
        let stem = stem.map_or(source.name.clone(), |stem| stem.to_string_lossy().into_owned());
        Ok(Problem {
            name: keys.name.clone().unwrap_or(stem),
            parameters: parameters.map(|(name, value)| Parameter { name, value }).collect(),
            settings: vec![],
            integrator: Integrator::read(&keys.integrator, &reader)?,
            output: Output::read(&keys, &reader)?,
            class: Class::read(&keys, &reader)?,
            ensemble,
            files: reader.into_files(),
            source,
        })
    }

    /// Replaces values of parameters, `name=value,...`. Parameters that depend on them change too.
    /// An ensemble no longer varies them.
    ///
    /// # Errors
    /// A name that is not a parameter; a value that is not a number.
    pub fn set(&mut self, text: &str) -> Result<(), InputError> {
        let source = Source::new("--set", text);
        for part in source.text.split(',').filter(|part| !part.trim().is_empty()) {
            let Some((name, value)) = part.split_once('=') else {
                let error = InputError::usage("this is not of the form name=value");
                return Err(error.at(&source.whole(part)));
            };
            let trimmed = name.trim();
            let known: Vec<_> = self.parameters.iter().map(|known| known.name.clone()).collect();
            if known.iter().all(|known| known != trimmed) {
                return Err(no_parameter(trimmed, &known).at(&source.whole(name)));
            }
            let [value] = numbers_in(value, &source)?[..] else {
                let error = InputError::usage("give the parameter exactly one value");
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

    /// Replaces the method, step and tolerance of the file by the options `--method`, `--step` and
    /// `--tolerance`: formulas in the parameters, as in the file.
    ///
    /// # Errors
    /// Those for the keys of the file.
    pub fn replace_integration(
        &mut self,
        method: Option<&str>,
        step: Option<&str>,
        tolerance: Option<&str>,
    ) -> Result<(), InputError> {
        let method = method.map(|name| {
            let source = Source::new("--method", name);
            method_of(name, &source.whole(&source.text))
        });
        let (step, tolerance) =
            (self.option("--step", step)?, self.option("--tolerance", tolerance)?);
        self.integrator = self.integrator.replaced(method.transpose()?, step, tolerance);
        Ok(())
    }

    /// Replaces the end and the interval between rows of the file by the options `--end` and
    /// `--every`. The end of a list of times is its last time.
    ///
    /// # Errors
    /// Those for the keys of the file.
    pub fn replace_times(
        &mut self,
        end: Option<&str>,
        every: Option<&str>,
    ) -> Result<(), InputError> {
        if end.or(every).is_some() {
            let (end, every) = (self.option("--end", end)?, self.option("--every", every)?);
            self.output.times = self.output.times.replaced(end, every);
        }
        Ok(())
    }

    /// The value of an option.
    fn option(&self, name: &str, text: Option<&str>) -> Result<Option<Value>, InputError> {
        let Some(text) = text else { return Ok(None) };
        let source = Source::new(name, text);
        let names = self.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let mut reader = Reader::new(&source, Path::new(""));
        reader.names = names;
        reader.whole().map(Some)
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
                (None, Some(value)) => value.at(&values)?,
                (None, None) => f64::NAN,
            });
        }
        let names = self.parameters.iter().map(|parameter| parameter.name.clone());
        Ok(names.zip(values).collect())
    }

    /// The method of integration in the file.
    pub fn method(&self) -> Option<Method> {
        self.integrator.method
    }

    /// The times of the rows for a member of the ensemble, from 0; the first is the initial time.
    ///
    /// # Errors
    /// Errors for times that are not monotonic, or are too many, and for a formula without a value.
    pub fn times(&self, member: u64) -> Result<Vec<f64>, InputError> {
        self.output.times.at(&self.source, &values_of(&self.values(member)?))
    }

    /// The same problem with another method, and with this step size or relative tolerance. Without
    /// a value, that of the file is used if the method needs it.
    #[must_use]
    pub fn with_method(&self, method: Method, step: Option<f64>, tolerance: Option<f64>) -> Self {
        let integrator = self.integrator.with_method(method, step, tolerance, &self.source);
        Problem { integrator, ..self.clone() }
    }

    /// The same problem with an additional force, given as a function. Columns of the power and of
    /// Casimir functions include it. The function is called several times in a step.
    ///
    /// ```
    /// use affinor::mechanics::simulation::{ForceFunction, ForceFrame};
    /// use affinor_documents::problem::Problem;
    /// let text = r#"
    /// space = "so3"
    /// metric = "identity"
    /// initial.velocity = [0, 0, 0]
    /// output = { end = 2, every = 2 }
    /// "#;
    /// let torque = ForceFunction::new(|_, _, _| vec![0.0, 0.0, 3.0]);
    /// let problem = Problem::parse("turn.toml", text)?.with_force(ForceFrame::Body, torque)?;
    /// let mut ready = problem.motion(0)?;
    /// while !ready.motion.step(2.0)? {}
    /// let spin = ready.columns.iter().position(|column| column.name == "Omega3").unwrap();
    /// assert!((ready.motion.row()[spin] - 6.0).abs() < 1e-9);
    /// # Ok::<(), affinor_documents::input::InputError>(())
    /// ```
    ///
    /// # Errors
    /// An error for a problem without forces: with a Hamiltonian, a prescribed velocity or a flow
    /// of matrices.
    pub fn with_force(
        &self,
        side: ForceFrame,
        function: ForceFunction,
    ) -> Result<Self, InputError> {
        let mut problem = self.clone();
        match &mut problem.class {
            Class::EulerPoincare(_, dynamics) => {
                dynamics.add_force(side, function);
                Ok(problem)
            }
            Class::Constrained(_, dynamics) => {
                dynamics.add_force(side, function);
                Ok(problem)
            }
            _ => Err(InputError::usage(
                "forces as functions are allowed with Euler-Poincare equations only",
            )
            .help("give a metric")),
        }
    }

    /// The same problem with other columns, by their names in a file. A column of the file takes
    /// precedence over a quantity with the same name.
    #[must_use]
    pub fn with_columns(&self, names: &[&str]) -> Self {
        Problem { output: self.output.with_columns(names, &self.source), ..self.clone() }
    }

    /// The same problem with rows at the initial time and at these times, and none at a section.
    #[must_use]
    pub fn at_times(&self, times: &[f64]) -> Self {
        let mut problem = self.clone();
        problem.output.section = None;
        problem.output.times = self.output.times.listed(times, &self.source);
        problem
    }

    /// The same problem with a row at the end only.
    #[must_use]
    pub fn to_the_end(&self) -> Self {
        let mut problem = self.clone();
        problem.output.times = self.output.times.to_the_end();
        problem
    }

    /// The methods of a class that has no step-size control, the most accurate one last; none for other classes.
    pub fn own_methods(&self) -> Vec<Method> {
        let class = match &self.class {
            Class::MatrixFlow(_) => MethodClass::MatrixFlow,
            Class::PrescribedVelocity(..) => MethodClass::PrescribedVelocity,
            Class::Constrained(..) => MethodClass::Constrained,
            Class::EulerPoincare(..) | Class::LiePoisson(..) => return vec![],
        };
        let own = Method::ALL.iter().copied().filter(|method| method.class() == class);
        let mut own: Vec<Method> = own.collect();
        own.sort_by_key(|method| method.order());
        own
    }

    /// The terminal event, at which the motion ends.
    pub fn terminal_event(&self) -> Option<&str> {
        self.output.stop.as_deref()
    }

    /// The event at which rows are written, instead of times.
    pub fn section(&self) -> Option<&str> {
        self.output.section.as_deref()
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// The paths of other files to which the problem refers: tables, meshes, the definition of its
    /// space.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// The number of members of the ensemble; `None` without an ensemble.
    pub fn members(&self) -> Option<u64> {
        self.ensemble.as_ref().and_then(Ensemble::checked_size)
    }

    /// The names of the parameters that the ensemble varies.
    pub fn varied(&self) -> Vec<&str> {
        self.ensemble.iter().flat_map(|ensemble| ensemble.names()).collect()
    }

    /// The values of the parameters that the ensemble varies, for a member from 0.
    pub fn variation(&self, member: u64) -> Vec<f64> {
        self.ensemble.as_ref().map_or(vec![], |ensemble| ensemble.values(member))
    }

    /// The motion. For an ensemble, the motion of a member, from 0.
    ///
    /// # Errors
    /// A mathematical error, such as a degenerate metric; an error for a method that does not apply
    /// to this class.
    pub fn motion(&self, member: u64) -> Result<Ready, InputError> {
        let parameters = self.values(member)?;
        let times = self.output.times.at(&self.source, &values_of(&parameters))?;
        let (source, integrator, output) = (&self.source, &self.integrator, &self.output);
        let member = Member { source, parameters, times, integrator, output };
        let ready = self.class.motion(&member)?;
        integrator.expect_no_ignored_keys(ready.method, source)?;
        let of_ensemble =
            self.ensemble.as_ref().map_or(vec![], |_| [vec!["member"], self.varied()].concat());
        expect_distinct(&ready.columns, &of_ensemble, source)?;
        Ok(ready)
    }

    /// Integrates a motion of this problem through its output times and events.
    pub fn integrate(&self, ready: Ready) -> Integration {
        Integration::new(ready, self.output.stop.clone(), self.output.section.clone())
    }
}
