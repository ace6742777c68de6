//! The options that commands share.

use super::color::Color;
use super::failure::Failure;
use super::note::note;
use super::stages::Stages;
use affinor::definition::{InputError, Request, ScalarChoice, Space, Work};
use affinor::report::Format;
use affinor_tensors::Tolerance;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What a space is completed with, and how it is computed.
#[derive(Args)]
pub struct SpaceOptions {
    /// Basis names of brackets given inline, e.g. "x y z"
    #[arg(long, value_name = "NAMES")]
    pub basis: Option<String>,
    /// A bracket given inline, e.g. "[x,y]=z"; repeat it, or separate several by ;
    #[arg(long, value_name = "BRACKET")]
    pub bracket: Vec<String>,
    /// plus, zero, minus, lambda=1/3, or levi-civita
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub connection: Option<String>,
    /// identity, killing, "diag(1,2,3)", or rows "[[1,0],[0,2]]"
    #[arg(long, value_name = "METRIC", allow_hyphen_values = true)]
    pub metric: Option<String>,
}

/// How to compute and where to write.
#[derive(Args)]
pub struct Shared {
    /// Values for parameters, e.g. "J1=1/2,h=-1"
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Option<String>,
    /// Compute exactly (rationals, or rational functions of the parameters) or in f64
    #[arg(long, value_enum, default_value_t = Scalar::Exact)]
    pub scalar: Scalar,
    /// A float is zero below this times the sum of the sizes of its terms [default: 64 epsilons]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// The number of threads [default: all cores]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub threads: Option<i64>,
    /// A line for each stage and its seconds on standard error
    #[arg(long)]
    pub timings: bool,
    #[command(flatten)]
    pub output: Output,
}

/// Where and how to write.
#[derive(Args)]
pub struct Output {
    /// text, markdown, latex, csv, or json
    #[arg(long, default_value = "text", value_parser = format)]
    pub format: Format,
    /// Write to this file, by way of a temporary one beside it
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Colours in messages
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    pub color: Color,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Scalar {
    Exact,
    Float,
}

impl Shared {
    fn scalar(&self) -> ScalarChoice {
        match self.scalar {
            Scalar::Exact => ScalarChoice::Exact,
            Scalar::Float => ScalarChoice::Float,
        }
    }

    /// When a float counts as zero.
    pub fn tolerance(&self) -> Result<Tolerance, Failure> {
        let Some(relative) = self.tolerance else { return Ok(Tolerance::default()) };
        Tolerance::new(relative).ok_or_else(|| {
            let message = format!("--tolerance {relative} is not in 0 <= T < 1");
            InputError::usage(message).help("the default is 64 machine epsilons, 1.42e-14").into()
        })
    }

    /// Begins a command, with the reading of its input; the stages of it.
    pub fn start(&self) -> Result<Stages, Failure> {
        self.start_threads()?;
        let stages = Stages::new(self.timings);
        stages.begin("input");
        Ok(stages)
    }

    /// Runs work over the scalar that a space needs.
    pub fn run<W: Work>(&self, space: &Space, work: W) -> Result<W::Output, Failure> {
        Ok(space.run(self.scalar(), self.tolerance()?, work)?)
    }

    /// Sets the number of threads for everything that follows.
    fn start_threads(&self) -> Result<(), Failure> {
        let Some(given) = self.threads else { return Ok(()) };
        let Some(threads) = usize::try_from(given).ok().filter(|n| (1..=1024).contains(n)) else {
            let message = format!("--threads {given} is not between 1 and 1024");
            return Err(InputError::usage(message).into());
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        pool.map_err(|error| InputError::usage(format!("cannot start threads: {error}")).into())
    }

    /// Understands a space, and says which parameters the command line brought in.
    pub fn open(&self, space: Option<&str>, options: &SpaceOptions) -> Result<Space, Failure> {
        let space = Space::open(&Request {
            space: space.map(str::to_string),
            basis: options.basis.clone(),
            brackets: options.bracket.clone(),
            connection: options.connection.clone(),
            metric: options.metric.clone(),
            set: self.set.clone(),
        })?;
        introduce(&space);
        Ok(space)
    }

    /// Understands two spaces; `--set` serves whichever has the parameter.
    pub fn open_both(&self, names: [&str; 2]) -> Result<[Space; 2], Failure> {
        let open =
            |name: &str| Space::open(&Request { space: Some(name.into()), ..Request::default() });
        let mut spaces = [open(names[0])?, open(names[1])?];
        if let Some(text) = &self.set {
            let parameters = spaces.each_ref().map(|space| space.definition.parameters());
            for (space, others) in spaces.iter_mut().zip(parameters.iter().rev()) {
                space.set(text, others)?;
            }
        }
        spaces.iter().for_each(introduce);
        Ok(spaces)
    }
}

/// Says which parameters the command line brought in.
fn introduce(space: &Space) {
    if !space.introduced.is_empty() {
        note(&format!("taken as parameters: {}", space.introduced.join(", ")));
    }
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| {
        let all: Vec<&str> = Format::ALL.into_iter().map(Format::name).collect();
        format!("the formats are {}", all.join(", "))
    })
}
