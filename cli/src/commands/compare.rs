//! `affinor compare`: a comparison of two spaces.

use super::failure::Failure;
use super::options::Shared;
use affinor_documents::input::InputError;
use affinor_documents::report::Comparison;
use affinor_documents::space::Space;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The two spaces to compare; by default M3 and SO3
    #[arg(num_args = 0..=2)]
    pub spaces: Vec<String>,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let [left, right] = match self.spaces.as_slice() {
            [] => ["M(3)", "SO(3)"],
            [left, right] => [left.as_str(), right.as_str()],
            _ => {
                return Err(InputError::usage("compare needs two spaces, or none")
                    .help("write for instance affinor compare M3 SO3")
                    .into());
            }
        };
        let [first, second] = self.shared.open_both([left, right])?;
        let side = |name: &str, space: &Space| {
            stages.begin(name);
            let computation = self.shared.computation(space, &|_| ())?;
            Ok::<_, Failure>(stages.bound(|| computation.side())??)
        };
        let comparison = Comparison::new(side(left, &first)?, side(right, &second)?);
        let inputs: Vec<_> = [first.file, second.file].into_iter().flatten().collect();
        self.shared.print(&stages, &inputs, &comparison)
    }
}
