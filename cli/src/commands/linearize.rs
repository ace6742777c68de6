//! `affinor linearize`: small deviations from an equilibrium or a steady motion.

use super::failure::Failure;
use super::note::note;
use super::options::Output;
use affinor_documents::problem::Problem;
use affinor_documents::report::LinearizationReport;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The problem in joint coordinates, as a TOML file; - for standard input
    #[arg(value_name = "FILE")]
    pub problem: String,
    /// Override values of parameters of the problem, as in "v=5,g=9.81"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...", allow_hyphen_values = true)]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let mut problem = Problem::read(&self.problem)?;
        for set in &self.set {
            problem.set(set)?;
        }
        let inputs: Vec<PathBuf> = vec![PathBuf::from(&self.problem)];
        let report = LinearizationReport::of(&problem)?;
        report.notes().iter().for_each(|text| note(text));
        self.output.print(&inputs, &report)
    }
}
