//! `affinor conventions`: the conventions of signs and indices.

use super::failure::Failure;
use super::options::Output;
use affinor_documents::report::conventions;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.output.print(&[], &conventions())
    }
}
