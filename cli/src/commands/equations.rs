//! `affinor equations`: the equations of motion of one space.

use super::failure::Failure;
use super::note::{note, note_default_connection};
use super::options::{Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{Canonical, Error};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{EquationReport, Language, Report};
use affinor_tensors::Notation;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// The equations: euler-poincare (needs a metric), autoparallel, or transport
    #[arg(long, default_value = "euler-poincare", value_parser = motion)]
    pub motion: EquationKind,
    /// Solve for the time derivatives, by the inverse metric
    #[arg(long)]
    pub solved: bool,
    /// Print a function that computes the time derivatives, in rust, c or python
    #[arg(long, value_name = "LANGUAGE", value_parser = language, conflicts_with_all = ["format", "solved"])]
    pub code: Option<Language>,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let mut space = self.shared.open(self.space.as_deref(), &self.options)?;
        if self.motion == EquationKind::EulerPoincare && space.definition.connection_is_default() {
            note("no connection given: using plus, for Euler-Poincare equations");
            space.definition.set_canonical(Canonical::Plus);
        }
        note_default_connection(&space.definition);
        let build = Build { arguments: self, stages: &stages };
        match self.shared.run(&space, build)? {
            Written::Equations(report) => {
                self.shared.print(&stages, space.file.as_slice(), &*report)
            }
            Written::Code(code) => {
                stages.begin_output();
                let file = self.shared.output.file.as_deref();
                deliver(file, space.file.as_slice(), |out| out.write_all(code.as_bytes()))
            }
        }
    }
}

/// The result: a report, or source code.
enum Written {
    Equations(Box<dyn Report>),
    Code(String),
}

struct Build<'a> {
    arguments: &'a Arguments,
    stages: &'a Stages,
}

impl Work for Build<'_> {
    type Output = Written;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        let Arguments { motion, solved, code, .. } = self.arguments;
        self.stages.begin("geometry");
        let geometry = definition.geometry(reading)?;
        self.stages.begin("equations");
        let equations = Equations::new(*motion, geometry.connection(), geometry.metric());
        let equations = equations.map_err(|error| match error {
            Error::NoMetric => InputError::usage("Euler-Poincare equations need a metric")
                .help("give one, as in --metric \"diag(J1,J2,J3)\", or choose another --motion"),
            other => other.into(),
        })?;
        let equations = if *solved { equations.solved() } else { equations };
        let system = EquationReport::new(equations, &geometry);
        system.finite()?;
        Ok(match code {
            None => Written::Equations(Box::new(system)),
            Some(language) => {
                let code = system.code(*language);
                Written::Code(code.map_err(|error| InputError::usage(error.to_string()))?)
            }
        })
    }
}

fn motion(name: &str) -> Result<EquationKind, String> {
    EquationKind::from_name(name).ok_or_else(|| {
        format!("the motions are {}", EquationKind::ALL.map(EquationKind::name).join(", "))
    })
}

fn language(name: &str) -> Result<Language, String> {
    Language::from_name(name).ok_or_else(|| {
        format!("the languages are {}", Language::ALL.map(Language::name).join(", "))
    })
}
