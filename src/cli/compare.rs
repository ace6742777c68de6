//! `affinor compare`: two spaces side by side.

use super::failure::Failure;
use super::options::{Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use affinor::definition::{Definition, InputError, Reading, Work};
use affinor::report::{Comparison, Side};
use affinor_tensors::Notation;
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    /// Two spaces; without them the paper's M(3) and SO(3)
    #[arg(num_args = 0..=2)]
    pub spaces: Vec<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        self.shared.start_threads()?;
        let stages = Stages::new(self.shared.timings);
        let [left, right] = match self.spaces.as_slice() {
            [] => ["M(3)", "SO(3)"],
            [left, right] => [left.as_str(), right.as_str()],
            _ => {
                return Err(InputError::usage("compare takes two spaces, or none")
                    .help("affinor compare M3 SO3")
                    .into());
            }
        };
        let side = |name: &str| {
            stages.begin(name);
            let space = self.shared.open(Some(name), &self.options)?;
            let tolerance = self.shared.tolerance()?;
            let side = space.run(self.shared.scalar(), tolerance, OneSide)?;
            Ok::<(Side, Option<PathBuf>), Failure>((side, space.file))
        };
        let ((left, first), (right, second)) = (side(left)?, side(right)?);
        let inputs: Vec<&Path> = [&first, &second].into_iter().flatten().map(|f| &**f).collect();
        let comparison = Comparison::new(left, right);
        stages.begin("output");
        let output = &self.shared.output;
        let write = |out: &mut dyn std::io::Write| comparison.write(output.format, out);
        deliver(output.file.as_deref(), &inputs, write)?;
        Ok(ExitCode::SUCCESS)
    }
}

struct OneSide;

impl Work for OneSide {
    type Output = Side;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Side, InputError> {
        Ok(Side::new(&definition.geometry(reading)?)?)
    }
}
