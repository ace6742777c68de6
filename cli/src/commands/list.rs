//! `affinor list`: the catalogue of spaces.

use super::failure::Failure;
use super::options::Output;
use affinor_documents::input::InputError;
use affinor_documents::report::{catalogue, catalogue_where};
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// List only entries that contain this text, ignoring case
    pub pattern: Option<String>,
    /// List the algebras with these properties, as in "dimension=4, nilpotent" (without a
    /// dimension, up to dimension 6), or the charts, as in "spacetime, Ricci-flat, isometries=4"
    #[arg(long = "where", value_name = "CONDITION", conflicts_with = "pattern")]
    pub condition: Option<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(condition) = &self.condition {
            let Some(entries) = catalogue_where(condition)? else {
                let message =
                    format!("nothing in the catalogue satisfies `{}`", condition.escape_debug());
                return Err(InputError::usage(message).into());
            };
            return self.output.print(&[], &*entries);
        }
        let pattern = self.pattern.as_deref().unwrap_or_default().to_lowercase();
        let Some(entries) = catalogue(&pattern) else {
            let message =
                format!("no entry of the catalogue contains `{}`", pattern.escape_debug());
            return Err(InputError::usage(message)
                .help("use `affinor list` to show all entries")
                .into());
        };
        self.output.print(&[], &entries)
    }
}
