//! `affinor info`: the structure of a Lie algebra.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use super::stages::Stages;
use affinor_documents::report::Info;
use affinor_tensors::Effort;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space, of which only the Lie algebra is used; see `affinor --help`
    pub space: Option<String>,
    /// The names of the basis vectors, if no SPACE is given, as in "x y z"
    #[arg(long, value_name = "NAMES")]
    pub basis: Option<String>,
    /// Brackets of the --basis vectors, as in "[x,y]=z; [y,z]=x"; may be repeated
    #[arg(long, value_name = "BRACKET")]
    pub bracket: Vec<String>,
    /// Values of parameters, as in "h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// Print the seconds of each stage to standard error
    #[arg(long)]
    pub timings: bool,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = Stages::new(self.timings, Effort::DEFAULT);
        stages.begin("input");
        let (basis, bracket) = (self.basis.clone(), self.bracket.clone());
        let options = SpaceOptions { basis, bracket, ..SpaceOptions::default() };
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &options)?;
        let info = Info::of(&space.definition, &|name| stages.begin(name))?;
        stages.begin_output();
        self.output.print(space.file.as_slice(), &info)
    }
}
