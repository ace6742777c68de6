//! `affinor table`: the tensors of a space.

use super::code::{self, CodeOptions};
use super::failure::Failure;
use super::note::{note, note_default_connection};
use super::options::{OutputFormat, Shared, SpaceOptions};
use super::output::deliver;
use affinor_documents::input::InputError;
use affinor_documents::report::{Format, Quantity, Selection};
use clap::{Args, ValueEnum};

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Choice,
    /// In JSON, write common factors of denominators only once, under `where`, as the other formats
    /// do
    #[arg(long)]
    pub common_factors: bool,
    /// Write the indices of components as numbers, or as names: of the coordinates on a chart,
    /// otherwise of the basis vectors
    #[arg(long, value_enum, default_value_t = Labels::Numbers)]
    pub labels: Labels,
    /// Compute in floats at a point, given by values of coordinates, parameters and functions, as
    /// in "r=3,theta=pi/2,M=1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...", conflicts_with = "code")]
    pub at: Vec<String>,
    #[command(flatten)]
    pub code: CodeOptions,
    #[command(flatten)]
    pub shared: Shared,
}

/// The choice of tensors and components.
#[derive(Args)]
pub struct Choice {
    #[arg(long, value_name = "TENSORS", value_parser = quantities, help = tensors_to_show())]
    pub show: Option<Quantities>,
    /// Show only one of the components that are equal up to sign by symmetry
    #[arg(long)]
    pub independent: bool,
    /// The invariant frame in which components are given
    #[arg(long, value_enum, default_value_t = Frame::Left)]
    pub frame: Frame,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Labels {
    Numbers,
    Names,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Frame {
    Left,
    Right,
}

/// A list of distinct tensors.
#[derive(Clone)]
pub struct Quantities(pub Vec<Quantity>);

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let space = self.shared.open(self.space.as_deref(), &self.options)?;
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        let chosen = self.selection.of(self.selection.quantities());
        let named_indices = self.labels == Labels::Names;
        let selection = Selection { common_factors: self.common_factors, named_indices, ..chosen };
        let numbered = [Format::Csv, Format::Json].map(OutputFormat::Report);
        if named_indices && numbered.contains(&self.shared.output.format()) {
            let error = InputError::usage(
                "--labels names cannot be combined with the formats csv and json, which number the indices",
            );
            return Err(error
                .help("leave --labels names out, or write text, markdown, latex or html")
                .into());
        }
        if self.common_factors && self.shared.output.format() == OutputFormat::Report(Format::Csv) {
            let error =
                InputError::usage("--common-factors cannot be combined with the format csv");
            return Err(error
                .help("use --format json, which supports names for common factors")
                .into());
        }
        if let OutputFormat::Program(program) = self.shared.output.format()
            && selection.quantities == [Quantity::Structure]
        {
            let code = stages.bound(|| computation.structure(program))??;
            let file = self.shared.output.file.as_deref();
            return deliver(file, space.file.as_slice(), |out| out.write_all(code.as_bytes()));
        }
        note_default_connection(&space.definition);
        if let Some(language) = self.code.language(&self.shared)? {
            if selection.independent {
                let message = "--independent cannot be combined with --code, which always writes all components";
                return Err(InputError::usage(message).help("leave --independent out").into());
            }
            let by = self.code.derivatives(&space.definition)?;
            let code = computation.table_as_code(&selection, language, &by)?;
            return code::print(&code, &space, &self.shared, &stages);
        }
        let table = stages.bound(|| match self.at.as_slice() {
            [] => computation.table(&selection),
            values => computation.table_at(&selection, &space.point(&values.join(","))?),
        })??;
        let absent: Vec<&str> = table.absent.iter().map(|quantity| quantity.key()).collect();
        let known = self.selection.quantities();
        if self.selection.show.is_some() && known.iter().all(|one| table.absent.contains(one)) {
            let message = format!("no tensor to show: this space has no {}", absent.join(", "));
            let metric = space.definition.has_metric();
            let help = match (metric, selection.right_frame) {
                (true, true) => {
                    "leave --frame right out: the metric has no constant components in the right-invariant frame"
                }
                (true, false) => "show tensors of this connection: --show torsion,curvature",
                (false, _) => "give a metric, as in --metric identity",
            };
            return Err(InputError::usage(message).help(help).into());
        }
        if !absent.is_empty() && selection.right_frame && space.definition.has_metric() {
            let why = "the metric has no constant components in the right-invariant frame";
            note(&format!("not shown: {}; {why}", absent.join(", ")));
        } else if !absent.is_empty() && self.selection.show.is_some() {
            note(&format!("not defined for this space: {}", absent.join(", ")));
        }
        self.shared.print(&stages, space.file.as_slice(), &*table.report)
    }
}

impl Choice {
    /// The chosen tensors; by default all basic tensors except the inverse metric and the Killing
    /// form.
    pub fn quantities(&self) -> Vec<Quantity> {
        match &self.show {
            Some(Quantities(chosen)) => chosen.clone(),
            None => Quantity::shown(),
        }
    }

    /// The selection of the given tensors, with the other options of this choice.
    pub fn of(&self, quantities: Vec<Quantity>) -> Selection {
        let right_frame = self.frame == Frame::Right;
        Selection { quantities, right_frame, independent: self.independent, ..Selection::default() }
    }
}

fn tensors_to_show() -> String {
    let [basic, derived] = Quantity::names();
    format!(
        "Tensors to show or to compare, separated by commas: {basic} (together: all); {derived} (together: derived)"
    )
}

fn quantities(text: &str) -> Result<Quantities, String> {
    Quantity::list(text).map(Quantities)
}
