//! `affinor table`: the tensors of one space.

use super::failure::Failure;
use super::note::note;
use super::options::{Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use affinor::definition::{Definition, InputError, Reading, Work};
use affinor::report::{Quantity, Table};
use affinor_tensors::Notation;
use clap::{Args, ValueEnum};
use std::path::Path;
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Selection,
    #[command(flatten)]
    pub shared: Shared,
}

/// Which components of which tensors.
#[derive(Args)]
pub struct Selection {
    /// Tensors, separated by commas: structure, affinities, torsion, curvature, ricci,
    /// scalar_curvature, metric, inverse_metric, nonmetricity, killing, or all
    #[arg(long, value_name = "TENSORS", value_parser = quantities)]
    pub show: Option<Quantities>,
    /// One component of each set that is equal by symmetry
    #[arg(long)]
    pub independent: bool,
    /// Components in the left- or the right-invariant frame
    #[arg(long, value_enum, default_value_t = Frame::Left)]
    pub frame: Frame,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Frame {
    Left,
    Right,
}

/// A list of tensors.
#[derive(Clone)]
pub struct Quantities(pub Vec<Quantity>);

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        self.shared.start_threads()?;
        let stages = Stages::new(self.shared.timings);
        stages.begin("input");
        let space = self.shared.open(self.space.as_deref(), &self.options)?;
        if space.definition.connection_is_default() {
            if space.definition.has_metric() {
                note("no connection is named, and there is a metric: levi-civita");
            } else if !space.definition.is_on_chart() {
                note("no connection is named, and there is no metric: zero");
            }
        }
        let quantities = self.selection.quantities();
        let input = space.file.as_deref();
        let write = Write { arguments: self, input, quantities, stages: &stages };
        let tolerance = self.shared.tolerance()?;
        space.run(self.shared.scalar(), tolerance, write)?
    }
}

impl Selection {
    /// What is shown: everything that the geometry is about, unless it was chosen.
    pub fn quantities(&self) -> Vec<Quantity> {
        let default =
            |quantity: &Quantity| !matches!(quantity, Quantity::InverseMetric | Quantity::Killing);
        match &self.show {
            Some(Quantities(chosen)) => chosen.clone(),
            None => Quantity::ALL.into_iter().filter(default).collect(),
        }
    }

    /// The table of a definition.
    pub fn table<S: Notation>(
        &self,
        definition: &Definition,
        reading: &Reading<S>,
        quantities: &[Quantity],
        stages: &Stages,
    ) -> Result<Table<S>, InputError> {
        stages.begin("jacobi");
        let ground = definition.ground(reading)?;
        stages.begin("connection");
        let mut geometry = definition.geometry_over(ground, reading)?;
        if self.frame == Frame::Right {
            geometry = geometry.in_right_frame()?;
        }
        let mut table = Table::in_stages(&geometry, quantities, &|name| stages.begin(name))?;
        table.independent = self.independent;
        if self.frame == Frame::Right {
            table.frame = "right-invariant";
        }
        table.finite()?;
        Ok(table)
    }
}

struct Write<'a> {
    arguments: &'a Arguments,
    input: Option<&'a Path>,
    quantities: Vec<Quantity>,
    stages: &'a Stages,
}

impl Work for Write<'_> {
    type Output = Result<ExitCode, Failure>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        let Arguments { selection, shared, .. } = self.arguments;
        let table = selection.table(definition, reading, &self.quantities, self.stages)?;
        self.stages.begin("output");
        let inputs: Vec<&Path> = self.input.into_iter().collect();
        let output = &shared.output;
        let done = deliver(output.file.as_deref(), &inputs, |out| table.write(output.format, out));
        Ok(done.map(|()| ExitCode::SUCCESS))
    }
}

fn quantities(text: &str) -> Result<Quantities, String> {
    if text.trim() == "all" {
        return Ok(Quantities(Quantity::ALL.to_vec()));
    }
    let quantity = |key: &str| {
        Quantity::from_key(key.trim()).ok_or_else(|| {
            let all: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::key).collect();
            format!("`{}` is not one of {}, all", key.escape_debug(), all.join(", "))
        })
    };
    text.split(',').map(quantity).collect::<Result<_, _>>().map(Quantities)
}
