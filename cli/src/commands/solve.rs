//! `affinor solve`: the values of letters for which a space has a property.

use super::failure::Failure;
use super::note::note_default_connection;
use super::options::{Output, Settings, SpaceOptions};
use affinor::geometry::conditions::Condition;
use affinor_documents::report::Solutions;
use clap::Args;
use clap::builder::PossibleValuesParser;

#[derive(Args)]
pub struct Arguments {
    /// The space, with letters in its metric, brackets or connection; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// The condition, which is solved for the letters
    #[arg(long = "for", value_name = "CONDITION", value_parser = conditions())]
    pub condition: String,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

fn conditions() -> PossibleValuesParser {
    PossibleValuesParser::new(Condition::ALL.map(Condition::name))
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        note_default_connection(&space.definition);
        // the parser accepts only names of conditions
        let condition = Condition::from_name(&self.condition).unwrap_or(Condition::Einstein);
        let solutions = Solutions::of(&space.definition, condition)?;
        self.output.print(space.file.as_slice(), &solutions)
    }
}
