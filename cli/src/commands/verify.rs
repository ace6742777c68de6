//! `affinor verify`: comparison of a space with a stored table.

use super::failure::Failure;
use super::note::note;
use super::options::{Shared, SpaceOptions};
use super::table::{Choice, Quantities};
use affinor_documents::input::InputError;
use affinor_documents::report::{Quantity, StoredTable};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The space (see `affinor --help`) and the stored table, JSON or CSV
    #[arg(num_args = 1..=2, required = true, value_names = ["SPACE", "FILE"])]
    pub arguments: Vec<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Choice,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let (space, file) = match self.arguments.as_slice() {
            [space, file] => (Some(space.as_str()), file),
            [file] => (None, file),
            _ => return Err(InputError::usage("verify takes a SPACE and a FILE").into()),
        };
        let mut stored = StoredTable::read(file)?;
        if let Some(Quantities(chosen)) = &self.selection.show {
            stored.select(chosen);
        }
        let space = self.shared.open(space, &self.options)?;
        stored.expect_basis(&space.definition.labels)?;
        let mut quantities = stored.quantities();
        if quantities.is_empty() {
            quantities = Quantity::BASIC.to_vec();
        }
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        let (found, remarks) =
            stages.bound(|| computation.differences(&stored, &self.selection.of(quantities)))??;
        remarks.iter().for_each(|remark| note(remark));
        let inputs: Vec<_> = space.file.into_iter().chain([PathBuf::from(file)]).collect();
        self.shared.print(&stages, &inputs, &found)?;
        if found.is_empty() { Ok(()) } else { Err(Failure::Refuted) }
    }
}
