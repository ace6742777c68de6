//! `affinor verify`: comparison of a space with a stored table.

use super::failure::Failure;
use super::note::note;
use super::options::{Shared, SpaceOptions};
use super::stages::Stages;
use super::table::{Quantities, Selection};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{Differences, Quantity, StoredTable};
use affinor_tensors::Notation;
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
    pub selection: Selection,
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
            stored.select(chosen)?;
        }
        let space = self.shared.open(space, &self.options)?;
        stored.expect_basis(&space.definition.labels)?;
        let compare = Compare { selection: &self.selection, stored: &stored, stages: &stages };
        let found = self.shared.run(&stages, &space, compare)?;
        let inputs: Vec<_> = space.file.into_iter().chain([PathBuf::from(file)]).collect();
        self.shared.print(&stages, &inputs, &found)?;
        if found.is_empty() { Ok(()) } else { Err(Failure::Refuted) }
    }
}

struct Compare<'a> {
    selection: &'a Selection,
    stored: &'a StoredTable,
    stages: &'a Stages,
}

impl Work for Compare<'_> {
    type Output = Differences;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Differences, InputError> {
        let mut quantities = self.stored.quantities();
        if quantities.is_empty() {
            quantities = Quantity::BASIC.to_vec();
        }
        let table = self.selection.table(definition, reading, &quantities, self.stages)?;
        self.stored.remarks(&table).iter().for_each(|remark| note(remark));
        self.stages.begin("comparison");
        self.stored.or_vanishing(&table)?.differences(&table)
    }
}
