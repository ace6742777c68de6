//! `affinor spacetime`: the Weyl tensor of a spacetime in a null tetrad.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::report::Spacetime;
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
    /// Begin the frame with these vectors, a timelike one or two null ones first, as in
    /// "d_t, d_r"; by default, the vectors of the basis
    #[arg(long, value_name = "VECTORS")]
    pub tetrad: Option<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        let spacetime = Spacetime::of(&space.definition, self.tetrad.as_deref())?;
        self.output.print(space.file.as_slice(), &spacetime)
    }
}
