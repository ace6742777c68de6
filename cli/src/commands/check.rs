//! `affinor check`: a certificate, or a witness for each failed identity.

use super::failure::Failure;
use super::options::{Shared, SpaceOptions};
use super::stages::Stages;
use affinor_documents::certificate::{Check, certify};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::certificate;
use affinor_tensors::Notation;
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
        let checks = self.shared.run(&stages, &space, Certificate { stages: &stages })?;
        let tolerance = self.shared.float_tolerance()?;
        let report = certificate(&space.definition.name, &checks, tolerance);
        self.shared.print(&stages, space.file.as_slice(), &report)?;
        if checks.iter().all(|check| check.ok) { Ok(()) } else { Err(Failure::Refuted) }
    }
}

struct Certificate<'a> {
    stages: &'a Stages,
}

impl Work for Certificate<'_> {
    type Output = Vec<Check>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Vec<Check>, InputError> {
        certify(definition, reading, &|name| self.stages.begin(name))
    }
}
