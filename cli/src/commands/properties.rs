//! `affinor properties`: the properties of a connection and a metric.

use super::failure::Failure;
use super::note::note_default_connection;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::report::Properties;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// Also print the sectional curvature of the plane that two vectors span, as in "x1, y1+2*z"; may be repeated
    #[arg(long, value_name = "X,Y")]
    pub plane: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        note_default_connection(&space.definition);
        let properties = Properties::with_planes(&space.definition, &self.plane)?;
        self.output.print(space.file.as_slice(), &properties)
    }
}
