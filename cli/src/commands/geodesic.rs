//! `affinor geodesic`: the geodesics between two points.

use super::failure::Failure;
use super::note::note_default_connection;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::problem::{Connecting, geodesics};
use affinor_documents::report::Geodesics;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space: a chart, a group or a homogeneous space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// The start. On a chart: coordinates, as in "theta=pi/2, phi=0" or a list. On a group:
    /// coordinates x of exp(x). On a homogeneous space: the components of x in the complement. An
    /// element may also be a matrix, row by row
    #[arg(long, value_name = "POINT", allow_hyphen_values = true)]
    pub from: String,
    /// The end, in the same form
    #[arg(long, value_name = "POINT", allow_hyphen_values = true)]
    pub to: String,
    /// Search from N initial velocities, and print all geodesics that are found. By default, the
    /// search ends at the first one
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub starts: Option<u16>,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        note_default_connection(&space.definition);
        let found = geodesics(&space, &self.from, &self.to, self.starts.map(usize::from))?;
        let Connecting { space: name, connection, names, points, measure, geodesics } = &found;
        let report = Geodesics::new(name, connection, names, points, measure, geodesics);
        self.output.print(space.file.as_slice(), &report)
    }
}
