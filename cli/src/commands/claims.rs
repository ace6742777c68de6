//! `affinor claims`: tests of statements about a space.

use super::failure::Failure;
use super::note::note_default_connection;
use super::options::{Shared, SpaceOptions};
use affinor_documents::input::InputError;
use affinor_documents::report::Statements;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The space (see `affinor --help`), followed by files of claims, one claim per line: "Ric_11 =
    /// (a - b)/2", "torsion = 0", "flat"
    #[arg(num_args = 0.., value_names = ["SPACE", "FILE"])]
    pub arguments: Vec<String>,
    /// A claim, tested in addition to those of the files; may be repeated
    #[arg(long, value_name = "CLAIM", allow_hyphen_values = true)]
    pub claim: Vec<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let (space, files) = match self.arguments.as_slice() {
            files if self.options.basis.is_some() => (None, files),
            [space, files @ ..] => (Some(space.as_str()), files),
            [] => (None, &[][..]),
        };
        let mut lists = vec![];
        for file in files {
            lists.push(Statements::read(file)?);
        }
        for claim in &self.claim {
            lists.push(Statements::parse("--claim", claim)?);
        }
        if lists.is_empty() {
            let error = InputError::usage("no claims are given");
            let help = "name a file of claims, or write one, as in --claim \"torsion = 0\"";
            return Err(error.help(help).into());
        }
        let space = self.shared.open(space, &self.options)?;
        note_default_connection(&space.definition);
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        let verdicts = stages.bound(|| computation.test(&Statements::join(lists)))??;
        let inputs: Vec<_> =
            space.file.into_iter().chain(files.iter().map(PathBuf::from)).collect();
        // if no statement could be tested, there are only errors and no table is printed
        if verdicts.iter().next().is_some() {
            self.shared.print(&stages, &inputs, &verdicts)?;
        }
        match verdicts.errors() {
            [] if verdicts.all_hold() => Ok(()),
            [] => Err(Failure::Refuted),
            errors => Err(Failure::Several(errors.to_vec())),
        }
    }
}
