//! `affinor mobility`: the degrees of freedom of a mechanism, with proofs.

use super::failure::Failure;
use super::options::Output;
use affinor_documents::mechanism::MechanismFile;
use affinor_documents::report::MobilityReport;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The mechanism, as a TOML file with bodies and joints; - for standard input
    #[arg(value_name = "FILE")]
    pub mechanism: String,
    /// Values of parameters, as in "a=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...", allow_hyphen_values = true)]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let file = MechanismFile::read(&self.mechanism, &self.set)?;
        let inputs: Vec<PathBuf> = vec![PathBuf::from(&self.mechanism)];
        self.output.print(&inputs, &MobilityReport::of(&file)?)
    }
}
