//! `affinor hypersurface`: the extrinsic curvature of the hypersurfaces of a function.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::report::HypersurfaceReport;
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
    /// The function that is constant on the hypersurfaces, as in "r" or "x^2 + y^2 + z^2"
    #[arg(long, value_name = "FUNCTION", allow_hyphen_values = true)]
    pub function: String,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        let report = HypersurfaceReport::of(&space.definition, &self.function)?;
        self.output.print(space.file.as_slice(), &report)
    }
}
