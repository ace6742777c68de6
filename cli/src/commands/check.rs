//! `affinor check`: a certificate of the identities of a space, with a witness for each failed
//! identity.

use super::failure::Failure;
use super::options::{Shared, SpaceOptions};
use affinor_documents::report::certificate;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let space = self.shared.open(self.space.as_deref(), &self.options)?;
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        let checks = stages.bound(|| computation.checks())??;
        let tolerance = self.shared.float_tolerance()?;
        let report = certificate(&space.definition.name, &checks, tolerance);
        self.shared.print(&stages, space.file.as_slice(), &report)?;
        if checks.iter().all(|check| check.ok) { Ok(()) } else { Err(Failure::Refuted) }
    }
}
