//! `affinor completions`: command-line completions for a shell.

use super::convert::KINDS;
use super::failure::Failure;
use super::output::deliver;
use affinor::algebra::catalogue;
use affinor::geometry::equations::EquationKind;
use affinor::mechanics::simulation::Method;
use affinor_documents::report::{Format, Language, Quantity};
use affinor_documents::space::NamedChart;
use clap::builder::PossibleValuesParser;
use clap::{Arg, Args, Command};
use clap_complete::{Shell, generate};

/// The largest dimension of the algebras that completions suggest.
const LARGEST: usize = 6;

#[derive(Args)]
pub struct Arguments {
    /// The shell that reads the completions
    pub shell: Shell,
}

impl Arguments {
    pub fn run(&self, command: &Command) -> Result<(), Failure> {
        let mut script = Vec::new();
        generate(self.shell, &mut suggesting(command.clone()), "affinor", &mut script);
        deliver(None, &[], |out| out.write_all(&script))
    }
}

/// Returns the command with suggestions for its arguments, which in fact accept other text too.
pub fn suggesting(command: Command) -> Command {
    let suggested = |argument: Arg| match names(argument.get_id().as_str()) {
        names if names.is_empty() => argument,
        names => argument.value_parser(PossibleValuesParser::new(names)),
    };
    command.mut_args(suggested).mut_subcommands(suggesting)
}

/// The names to suggest for an argument; empty if there are none.
fn names(argument: &str) -> Vec<String> {
    let own = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
    match argument {
        "space" => {
            let charts = NamedChart::all().map(|chart| chart.name().into());
            (1..=LARGEST).flat_map(catalogue::names).chain(charts).collect()
        }
        "show" => Quantity::ALL.iter().map(|quantity| quantity.key().into()).collect(),
        "connection" => own(&["plus", "zero", "minus", "levi-civita"]),
        "metric" => own(&["identity", "killing"]),
        "kind" => EquationKind::ALL.map(|kind| kind.name().into()).to_vec(),
        "code" => Language::ALL.map(|language| language.name().into()).to_vec(),
        "method" | "methods" => Method::ALL.iter().map(|method| method.name().into()).collect(),
        "from" | "to" => [own(&KINDS.map(|(name, _)| name)), own(&["ZYX", "zyx"])].concat(),
        "format" => Format::ALL.map(|format| format.name().into()).to_vec(),
        _ => vec![],
    }
}
