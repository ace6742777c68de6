//! `affinor isometries`: the Lie algebra of the Killing fields of a metric.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use affinor::geometry::isometry::Symmetry;
use affinor_documents::report::Isometries;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; only its metric is used; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// Find the homothetic fields, which scale the metric by a constant
    #[arg(long)]
    pub homothetic: bool,
    /// Find the conformal Killing fields, which scale the metric by a function, in dimension 3 and
    /// more
    #[arg(long, conflicts_with = "homothetic")]
    pub conformal: bool,
    /// Write the fields in the functions of the chart, as far as they are found
    #[arg(long)]
    pub fields: bool,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        let symmetry = match (self.homothetic, self.conformal) {
            (true, _) => Symmetry::Homothetic,
            (_, true) => Symmetry::Conformal,
            _ => Symmetry::Killing,
        };
        let isometries = match self.fields {
            true => Isometries::with_fields(&space.definition, symmetry)?,
            false => Isometries::of(&space.definition, symmetry)?,
        };
        self.output.print(space.file.as_slice(), &isometries)
    }
}
