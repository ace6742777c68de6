//! Problems of motion: files that are parsed into motions.
//!
//! The class of a problem is one of: Euler-Poincare equations, with or without constraints;
//! Lie-Poisson equations; a prescribed velocity; an isospectral flow of matrices. There are also
//! curves on charts and on homogeneous spaces, and trees of bodies in joint coordinates. All classes have
//! parameters, integration settings, output settings and, optionally, an ensemble that varies
//! parameters. Every number may be a formula in the parameters.
//! In reading order: `keys` defines the keys of a file, and `reader` evaluates them. Each class has
//! its own file, which builds the part of a [`Problem`] for this class. A problem starts motions
//! ([`Ready`]), which an [`Integration`] integrates. [`geodesics`] joins two points, and
//! `horizontal` computes curves of distributions. `tree` reads the tree of a file without a motion.

#[cfg(feature = "mechanisms")]
mod assembly;
mod body;
mod constrained;
mod ensemble;
mod euler_poincare;
mod forces;
mod geodesic;
#[cfg(feature = "curves")]
mod horizontal;
mod initial;
mod integration;
mod integrator;
#[cfg(feature = "mechanisms")]
mod joined;
#[cfg(feature = "mechanisms")]
mod joint;
#[cfg(feature = "mechanisms")]
mod joint_keys;
mod keys;
mod lie_poisson;
mod matrix_flow;
mod on_chart;
mod on_group;
mod on_homogeneous;
#[cfg(feature = "mechanisms")]
mod on_tree;
mod output;
mod part;
mod prescribed_velocity;
mod reader;
mod ready;
mod solid;
#[cfg(feature = "mechanisms")]
pub mod tree;

#[cfg(feature = "mechanisms")]
pub(crate) use assembly::read_robot;
pub use geodesic::{Connecting, geodesics};
#[cfg(feature = "curves")]
pub use horizontal::{
    Horizontal, HorizontalCurve, HorizontalCurves, HorizontalRequest, WrittenPoint, horizontal,
};
pub use integration::{Integration, Progress};
#[cfg(feature = "mechanisms")]
pub(crate) use joint_keys::{BodyKeys, JointKeys};
pub use ready::{Column, Factor, Ready};
pub use solid::Solid;

use crate::input::{InputError, Source, file, parse_keys};
use crate::space::setting::{named_numbers, no_parameter};
use affinor::mechanics::simulation::{Class as MethodClass, ForceFrame, ForceFunction, Method};
use constrained::Constrained;
use ensemble::Ensemble;
use euler_poincare::EulerPoincare;
use integrator::{Integrator, Member, method_of, values_of};
use keys::Keys;
#[cfg(feature = "mechanisms")]
use keys::OF_TREES;
use lie_poisson::LiePoisson;
use matrix_flow::MatrixFlow;
use on_chart::OnChart;
use on_group::OnGroup;
use on_homogeneous::OnHomogeneous;
#[cfg(feature = "mechanisms")]
use on_tree::OnTree;
use output::{Output, expect_distinct};
use prescribed_velocity::PrescribedVelocity;
use reader::{Reader, Value};
use std::path::Path;

#[cfg(feature = "mechanisms")]
pub use on_tree::LinearProblem;

/// A problem of motion.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The name.
    pub name: String,
    source: Source,
    /// The paths of other files to which the problem refers.
    files: Vec<String>,
    parameters: Vec<Parameter>,
    /// Values that override parameters of the file.
    settings: Vec<(String, f64)>,
    class: Class,
    integrator: Integrator,
    output: Output,
    ensemble: Option<Ensemble>,
}

#[derive(Clone, Debug)]
struct Parameter {
    name: String,
    /// The value as a formula in the earlier parameters; `None` if only the ensemble defines the
    /// parameter.
    value: Option<Value>,
}

/// The classes of problems. All classes except two are defined on a group.
#[derive(Clone, Debug)]
enum Class {
    MatrixFlow(Box<MatrixFlow>),
    Chart(Box<OnChart>),
    Homogeneous(Box<OnHomogeneous>),
    #[cfg(feature = "mechanisms")]
    Tree(Box<OnTree>),
    EulerPoincare(Box<OnGroup>, Box<EulerPoincare>),
    Constrained(Box<OnGroup>, Box<Constrained>),
    LiePoisson(Box<OnGroup>, Box<LiePoisson>),
    PrescribedVelocity(Box<OnGroup>, Box<PrescribedVelocity>),
}

impl Class {
    /// Reads the class; `parameters` are the values of the parameters, as far as the file has them.
    fn read(
        keys: &Keys,
        reader: &Reader,
        parameters: &[Option<Value>],
    ) -> Result<Self, InputError> {
        #[cfg(feature = "mechanisms")]
        if OnTree::is_meant(keys, reader)? {
            return Ok(Class::Tree(OnTree::read(keys, reader)?.into()));
        }
        #[cfg(feature = "mechanisms")]
        if keys.urdf.is_some() || keys.bodies.is_some() || keys.joints.is_some() {
            // a parameter that only the ensemble defines counts as 1 for the choice of constraints
            let mut values = vec![];
            for name in 0..reader.names.len() {
                let value = parameters.get(name).and_then(Option::as_ref);
                values.push(value.map_or(Ok(1.0), |value| value.at(&values))?);
            }
            let (group, dynamics, joints) = joined::read(keys, reader, &values)?;
            let class = Constrained::of_joints(dynamics, joints);
            return Ok(Class::Constrained(group.into(), class.into()));
        }
        #[cfg(feature = "mechanisms")]
        reader.refuse("a problem without bodies", &OF_TREES)?;
        #[cfg(not(feature = "mechanisms"))]
        let _ = parameters;
        if let Some(flow) = &keys.flow {
            return Ok(Class::MatrixFlow(MatrixFlow::read(flow, reader)?.into()));
        }
        let group = Box::new(OnGroup::read(keys, reader)?);
        if group.definition().is_on_chart() {
            return Ok(Class::Chart(OnChart::read(keys, group.into_space(), reader)?.into()));
        }
        if group.definition().is_homogeneous() {
            return Ok(Class::Homogeneous(OnHomogeneous::read(keys, *group, reader)?.into()));
        }
        if let Some(prescribed) = &keys.prescribed {
            let class = PrescribedVelocity::read(prescribed, reader)?;
            return Ok(Class::PrescribedVelocity(group, class.into()));
        }
        if let Some(hamiltonian) = &keys.hamiltonian {
            let class = LiePoisson::read(hamiltonian, keys, &group, reader)?;
            return Ok(Class::LiePoisson(group, class.into()));
        }
        if keys.constraints.is_some() || reader.source.has_key("velocity_constraints") {
            let class = Constrained::read(keys, &group, reader)?;
            return Ok(Class::Constrained(group, class.into()));
        }
        let class = EulerPoincare::read(keys, &group, reader)?;
        Ok(Class::EulerPoincare(group, class.into()))
    }

    /// Prepares the motion of a member of the ensemble.
    fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        match self {
            Class::MatrixFlow(flow) => flow.motion(member),
            Class::Chart(curve) => curve.motion(member),
            Class::Homogeneous(curve) => curve.motion(member),
            #[cfg(feature = "mechanisms")]
            Class::Tree(tree) => tree.motion(member),
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
    /// An error with its location if the file cannot be read, or if its content is invalid.
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

    /// Reads a problem from the text of a file. Relative paths in the text start at the current
    /// folder.
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

    /// Reads a problem from a source. Relative paths in the source start at `folder`.
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
        let class = Class::read(&keys, &reader, &values)?;
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
            class,
            ensemble,
            files: reader.into_files(),
            source,
        })
    }

    /// Overrides values of parameters, written as `name=value,...`. Parameters that depend on them
    /// change too. An ensemble no longer varies these parameters.
    ///
    /// # Errors
    /// An error for a name that is not a parameter, and for a value that is not a number.
    pub fn set(&mut self, text: &str) -> Result<(), InputError> {
        let source = Source::new("--set", text);
        for (name, value) in named_numbers(&source)? {
            let known: Vec<_> = self.parameters.iter().map(|known| known.name.clone()).collect();
            if known.iter().all(|known| known != name) {
                return Err(no_parameter(name, &known).at(&source.whole(name)));
            }
            self.settings.retain(|(other, _)| other != name);
            self.settings.push((name.into(), value));
            if let Some(ensemble) = &mut self.ensemble {
                ensemble.leave_out(name);
            }
        }
        Ok(())
    }

    /// Overrides the method, the step and the tolerance of the file by the values of the options
    /// `--method`, `--step` and `--tolerance`. As in the file, the values may be formulas in the
    /// parameters.
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

    /// Overrides the final time and the interval between rows of the file by the values of the
    /// options `--end` and `--every`. If the file has a list of times, its final time is the last
    /// one.
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

    /// Parses the value of an option.
    fn option(&self, name: &str, text: Option<&str>) -> Result<Option<Value>, InputError> {
        let Some(text) = text else { return Ok(None) };
        let source = Source::new(name, text);
        let names = self.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let mut reader = Reader::new(&source, Path::new(""));
        reader.names = names;
        reader.whole().map(Some)
    }

    /// The values of the parameters for a member of the ensemble. Members count from 0.
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

    /// The integration method that the file names.
    pub fn method(&self) -> Option<Method> {
        self.integrator.method
    }

    /// The times of the rows for a member of the ensemble; members count from 0. The first time is
    /// the initial time.
    ///
    /// # Errors
    /// An error if the times are not monotonic or are too many, or if a formula has no
    /// value.
    pub fn times(&self, member: u64) -> Result<Vec<f64>, InputError> {
        self.output.times.at(&self.source, &values_of(&self.values(member)?))
    }

    /// Returns the problem with another method, and with the given step size or relative tolerance.
    /// Without a given value, the method uses the value of the file if it needs one.
    #[must_use]
    pub fn with_method(&self, method: Method, step: Option<f64>, tolerance: Option<f64>) -> Self {
        let integrator = self.integrator.with_method(method, step, tolerance, &self.source);
        Problem { integrator, ..self.clone() }
    }

    /// Returns the problem with an additional force, given as a function. Columns of the power and
    /// of Casimir functions include this force. The function is called several times per step.
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
    /// An error if the problem has no forces, because it has a Hamiltonian, a prescribed velocity
    /// or a flow of matrices.
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

    /// Returns the problem with other output columns, given by their names in a file. If a column
    /// of the file and a quantity have the same name, the name means the column.
    #[must_use]
    pub fn with_columns(&self, names: &[&str]) -> Self {
        Problem { output: self.output.with_columns(names, &self.source), ..self.clone() }
    }

    /// Returns the problem with rows at the initial time and at these times, and without rows at a
    /// section.
    #[must_use]
    pub fn at_times(&self, times: &[f64]) -> Self {
        let mut problem = self.clone();
        problem.output.section = None;
        problem.output.times = self.output.times.listed(times, &self.source);
        problem
    }

    /// Returns the problem without output times between the initial and the final time.
    #[must_use]
    pub fn to_the_end(&self) -> Self {
        let mut problem = self.clone();
        problem.output.times = self.output.times.to_the_end();
        problem
    }

    /// The methods of a class that has methods of its own, the most accurate method last. The list
    /// is empty for other classes.
    pub fn own_methods(&self) -> Vec<Method> {
        let classes: &[MethodClass] = match &self.class {
            Class::MatrixFlow(_) => &[MethodClass::MatrixFlow],
            Class::PrescribedVelocity(..) => &[MethodClass::PrescribedVelocity],
            Class::Constrained(..) => &[MethodClass::Constrained],
            Class::Chart(_) => &[MethodClass::Chart],
            #[cfg(feature = "mechanisms")]
            Class::Tree(_) => &[MethodClass::Chart, MethodClass::Tree],
            Class::EulerPoincare(..) | Class::LiePoisson(..) | Class::Homogeneous(_) => &[],
        };
        let own = Method::ALL.iter().copied().filter(|method| classes.contains(&method.class()));
        let mut own: Vec<Method> = own.collect();
        own.sort_by_key(|method| method.order());
        own
    }

    /// The terminal event, at which the motion ends.
    pub fn terminal_event(&self) -> Option<&str> {
        self.output.stop.as_deref()
    }

    /// The event at which rows are written, if rows are not written at given times.
    pub fn section(&self) -> Option<&str> {
        self.output.section.as_deref()
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// The paths of other files to which the problem refers: tables, meshes, and the definition of
    /// its space.
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

    /// The values of the parameters that the ensemble varies, for one member. Members count from 0.
    pub fn variation(&self, member: u64) -> Vec<f64> {
        self.ensemble.as_ref().map_or(vec![], |ensemble| ensemble.values(member))
    }

    /// Prepares the motion, or the motion of one member of an ensemble; members count from 0.
    ///
    /// # Errors
    /// A mathematical error, such as a degenerate metric, and an error for a method that
    /// does not apply to this class.
    pub fn motion(&self, member: u64) -> Result<Ready, InputError> {
        let (source, integrator) = (&self.source, &self.integrator);
        let ready = self.class.motion(&self.member(member)?)?;
        integrator.expect_no_ignored_keys(ready.method, source)?;
        let of_ensemble =
            self.ensemble.as_ref().map_or(vec![], |_| [vec!["member"], self.varied()].concat());
        expect_distinct(&ready.columns, &of_ensemble, source)?;
        Ok(ready)
    }

    /// A member of the ensemble, with its parameters and times.
    fn member(&self, member: u64) -> Result<Member<'_>, InputError> {
        let parameters = self.values(member)?;
        let times = self.output.times.at(&self.source, &values_of(&parameters))?;
        let (source, integrator, output) = (&self.source, &self.integrator, &self.output);
        Ok(Member { source, parameters, times, integrator, output })
    }

    /// The linear equations of small deviations from the initial state, for a problem in joint
    /// coordinates. If the state is at rest, they are those of the equilibrium near it.
    ///
    /// # Errors
    /// An error for other problems, and for a state that is neither an equilibrium nor a steady
    /// motion.
    #[cfg(feature = "mechanisms")]
    pub fn linearized(&self) -> Result<LinearProblem, InputError> {
        match &self.class {
            Class::Tree(tree) => tree.linearized(&self.member(0)?),
            _ => Err(InputError::usage("only problems in joint coordinates can be linearized")
                .help("give [[bodies]] and [[joints]]")),
        }
    }

    /// Prepares the integration of a motion of this problem through its output times and events.
    pub fn integrate(&self, ready: Ready) -> Integration {
        Integration::new(ready, self.output.stop.clone(), self.output.section.clone())
    }
}
