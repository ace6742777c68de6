//! Options that several commands share.

use super::color::ColorOption;
use super::failure::Failure;
use super::note::note;
use super::output::{deliver, ending};
use super::stages::Stages;
use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use affinor_documents::report::{Computation, Format, Program, Report};
use affinor_documents::space::{Request, ScalarChoice, Space};
use affinor_tensors::{Effort, Tolerance};
use clap::{Args, ValueEnum};
use std::io::{self, Write};
use std::path::PathBuf;

/// A space defined by options, and its connection and metric.
#[derive(Args, Default)]
pub struct SpaceOptions {
    /// The names of the basis vectors, if no SPACE is given, as in "x y z"
    #[arg(long, value_name = "NAMES")]
    pub basis: Option<String>,
    /// Brackets of the --basis vectors, as in "[x,y]=z; [y,z]=x"; may be repeated
    #[arg(long, value_name = "BRACKET")]
    pub bracket: Vec<String>,
    #[command(flatten)]
    pub geometry: GeometryOptions,
}

/// The connection and the metric of a space.
#[derive(Args, Clone, Default)]
pub struct GeometryOptions {
    /// The connection: plus, zero, minus, lambda=1/3, levi-civita, or "nonholonomic(e1, e2)" of the
    /// distribution that e1 and e2 span; canonical (lambda=0) or natural (lambda=1/2) on a
    /// homogeneous space
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub connection: Option<String>,
    /// The metric: identity, killing, invariant (one letter per parameter), "diag(1,2,3)", rows
    /// "[[1,0],[0,2]]", or on a homogeneous space "summands(1,2)"
    #[arg(long, value_name = "METRIC", allow_hyphen_values = true)]
    pub metric: Option<String>,
    /// Multiply the metric by the square of this function, as in "1/r"
    #[arg(long, value_name = "FUNCTION", allow_hyphen_values = true)]
    pub conformal_factor: Option<String>,
}

/// Parameters, threads, and the tolerance of floating-point results.
#[derive(Args)]
pub struct Settings {
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// Relative tolerance: a float counts as zero if it is below T times the sum of the absolute
    /// values of its terms [default: 64 machine epsilons]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// The number of threads [default: all cores]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub threads: Option<i64>,
}

/// A problem of mechanics, and options that override keys of its file.
#[derive(Args)]
pub struct ProblemOptions {
    /// The problem, as a TOML file; - for standard input
    #[arg(value_name = "FILE")]
    pub problem: String,
    /// Override values of parameters of the problem, as in "m=15,g=9.81"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Override the step size that the file sets: a number, or a formula in its parameters
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    pub step: Option<String>,
    /// Override the relative tolerance that the file sets: a number, or a formula in its parameters
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Override the final time that the file sets: a number, or a formula in its parameters
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub end: Option<String>,
    /// Override the time between output rows that the file sets: a number, or a formula in its
    /// parameters
    #[arg(long, value_name = "DT", allow_hyphen_values = true)]
    pub every: Option<String>,
}

/// The settings of a computation, the kind of its scalars, and its output.
#[derive(Args)]
pub struct Shared {
    #[command(flatten)]
    pub settings: Settings,
    /// The scalars: exact (rational numbers, or rational functions of the parameters) or float
    /// (f64)
    #[arg(long, value_enum, default_value_t = Scalar::Exact)]
    pub scalar: Scalar,
    /// The largest number of terms of all formulas together [default: 20000000, which use about 3
    /// GB]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_terms: Option<u64>,
    /// Print the seconds of each stage to standard error
    #[arg(long)]
    pub timings: bool,
    #[command(flatten)]
    pub output: Output,
}

/// The format and file of a table, and the colours of messages.
#[derive(Args)]
pub struct Output {
    /// The format: text, markdown, latex, html, csv or json [default: by the ending of the output
    /// file, otherwise text]
    #[arg(long, value_parser = format)]
    format: Option<OutputFormat>,
    /// Write to this file; if the run fails, the file remains unchanged
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    pub file: Option<PathBuf>,
    #[command(flatten)]
    pub color: ColorOption,
}

/// A format of reports, or a program that can read the written structure constants.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum OutputFormat {
    Report(Format),
    Program(Program),
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Scalar {
    Exact,
    Float,
}

impl Settings {
    /// The values of all `--set` options, separated by commas.
    fn set(&self) -> Option<String> {
        (!self.set.is_empty()).then(|| self.set.join(","))
    }

    /// The tolerance below which a float counts as zero.
    pub fn tolerance(&self) -> Result<Tolerance, Failure> {
        let Some(relative) = self.tolerance else { return Ok(Tolerance::default()) };
        Tolerance::new(relative).ok_or_else(|| {
            let message = format!("--tolerance {relative} is not in 0 <= T < 1");
            InputError::usage(message).help("the default is 64 machine epsilons, 1.42e-14").into()
        })
    }

    /// Sets the number of threads for all following computations.
    pub fn start_threads(&self) -> Result<(), Failure> {
        let Some(given) = self.threads else { return Ok(()) };
        let Some(threads) = usize::try_from(given).ok().filter(|n| (1..=1024).contains(n)) else {
            let message = format!("--threads {given} is not between 1 and 1024");
            return Err(InputError::usage(message).into());
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        pool.map_err(|error| InputError::usage(format!("cannot start the threads: {error}")).into())
    }

    /// Opens a space, and prints notes, such as a note on parameters that the options introduce.
    pub fn open(&self, space: Option<&str>, options: &SpaceOptions) -> Result<Space, Failure> {
        let space = Space::open(&Request {
            space: space.map(str::to_string),
            basis: options.basis.clone(),
            brackets: options.bracket.clone(),
            connection: options.geometry.connection.clone(),
            metric: options.geometry.metric.clone(),
            conformal_factor: options.geometry.conformal_factor.clone(),
            set: self.set(),
            ..Request::default()
        })?;
        note_parameters(&space);
        Ok(space)
    }
}

impl ProblemOptions {
    /// Reads the problem, and applies the options. `method` overrides the method that the file
    /// sets.
    pub fn open(&self, method: Option<&str>) -> Result<Problem, Failure> {
        let mut problem = self.with_own_integration()?;
        problem.replace_integration(method, self.step.as_deref(), self.tolerance.as_deref())?;
        Ok(problem)
    }

    /// Reads the problem, and applies the values and times of the options, but leaves the
    /// integration settings of the file unchanged.
    pub fn with_own_integration(&self) -> Result<Problem, Failure> {
        let mut problem = Problem::read(&self.problem)?;
        for set in &self.set {
            problem.set(set)?;
        }
        problem.replace_times(self.end.as_deref(), self.every.as_deref())?;
        Ok(problem)
    }

    /// The names of the options, each with its value if it is given.
    pub fn given(&self) -> Vec<(String, Option<String>)> {
        let ProblemOptions { set, step, tolerance, end, every, .. } = self;
        let set = (!set.is_empty()).then(|| set.join(","));
        let all = [
            ("--set", &set),
            ("--step", step),
            ("--tolerance", tolerance),
            ("--end", end),
            ("--every", every),
        ];
        all.map(|(name, value)| (name.into(), value.clone())).into()
    }
}

impl Output {
    /// The format of `--format`, otherwise that of the ending of the output file, otherwise text.
    pub fn format(&self) -> OutputFormat {
        let named = Format::from_ending(&ending(self.file.as_deref())).unwrap_or(Format::Text);
        self.format.unwrap_or(OutputFormat::Report(named))
    }

    /// Writes a report; `inputs` are files that must not be overwritten.
    pub fn print(&self, inputs: &[PathBuf], report: &dyn Report) -> Result<(), Failure> {
        self.print_with(inputs, |format, out| report.write(format, out))
    }

    /// Writes the output of the function `write` in the chosen format.
    fn print_with(
        &self,
        inputs: &[PathBuf],
        write: impl FnOnce(Format, &mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        match self.format() {
            OutputFormat::Report(format) => {
                deliver(self.file.as_deref(), inputs, |out| write(format, out))
            }
            OutputFormat::Program(program) => {
                let message =
                    format!("the format {} supports structure constants only", program.name());
                let help = "write affinor table SPACE --show structure --format ...";
                Err(InputError::usage(message).help(help).into())
            }
        }
    }
}

impl Shared {
    /// Starts the threads of a command, and begins its first stage, the reading of the input.
    pub fn start(&self) -> Result<Stages, Failure> {
        self.settings.start_threads()?;
        let stages = Stages::new(self.timings, self.max_terms.unwrap_or(Effort::DEFAULT));
        stages.begin("input");
        Ok(stages)
    }

    /// Prepares the computation of a space with these options.
    pub fn computation<'a>(
        &self,
        space: &'a Space,
        stage: &'a dyn Fn(&str),
    ) -> Result<Computation<'a>, Failure> {
        let scalar = match self.scalar {
            Scalar::Exact => ScalarChoice::Exact,
            Scalar::Float => ScalarChoice::Float,
        };
        Ok(Computation { space, scalar, tolerance: self.settings.tolerance()?, stage })
    }

    /// The tolerance below which a float counts as zero, if the scalars are floats.
    pub fn float_tolerance(&self) -> Result<Option<Tolerance>, Failure> {
        (self.scalar == Scalar::Float).then(|| self.settings.tolerance()).transpose()
    }

    /// Opens a space, and prints notes, such as a note on parameters that the options introduce.
    pub fn open(&self, space: Option<&str>, options: &SpaceOptions) -> Result<Space, Failure> {
        self.settings.open(space, options)
    }

    /// Begins the output stage, and writes the report.
    pub fn print(
        &self,
        stages: &Stages,
        inputs: &[PathBuf],
        report: &dyn Report,
    ) -> Result<(), Failure> {
        stages.begin_output();
        // writing simplifies formulas, and the limit on terms applies to this work too
        let write = |format, out: &mut dyn Write| report.write(format, &mut stages.within(out));
        stages.bound(|| self.output.print_with(inputs, write))?
    }

    /// Opens two spaces. `--set` sets a parameter in each space that has the parameter.
    pub fn open_both(&self, names: [&str; 2]) -> Result<[Space; 2], Failure> {
        let open =
            |name: &str| Space::open(&Request { space: Some(name.into()), ..Request::default() });
        let mut spaces = [open(names[0])?, open(names[1])?];
        if let Some(text) = &self.settings.set() {
            let parameters = spaces.each_ref().map(|space| space.definition.parameters());
            for (space, others) in spaces.iter_mut().zip(parameters.iter().rev()) {
                space.set(text, others)?;
            }
        }
        spaces.iter().for_each(note_parameters);
        Ok(spaces)
    }
}

/// Prints notes on the conventions that were assumed for the space, and on parameters that occur
/// only on the command line.
fn note_parameters(space: &Space) {
    space.definition.notes().iter().for_each(|text| note(text));
    if !space.introduced.is_empty() {
        note(&format!("taken as parameters: {}", space.introduced.join(", ")));
    }
}

fn format(name: &str) -> Result<OutputFormat, String> {
    let report = Format::from_name(name).map(OutputFormat::Report);
    let format = report.or_else(|| Program::from_name(name).map(OutputFormat::Program));
    format.ok_or_else(|| {
        let all: Vec<&str> = Format::ALL.into_iter().map(Format::name).collect();
        format!("the formats are {}", all.join(", "))
    })
}
