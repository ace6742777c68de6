//! `affinor forms`: the derivative, the Hodge star and the Laplacian of a differential form.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::report::FormReport;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; its metric is needed for all but the derivative; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// The form, as in "Q/r^2*dt^dr". The name of a basis vector means its dual form. A function is
    /// a form of degree 0
    #[arg(long, value_name = "FORM")]
    pub form: String,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        let report = FormReport::of(&space.definition, &self.form)?;
        self.output.print(space.file.as_slice(), &report)
    }
}
