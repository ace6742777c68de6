//! `affinor equations`: the equations of motion of one space.

use super::code::{self, CodeOptions};
use super::failure::Failure;
use super::note::{note, note_default_connection};
use super::options::{Shared, SpaceOptions};
use super::stages::Stages;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{Canonical, Error};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{EquationReport, Report};
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
    #[arg(long, conflicts_with = "code")]
    pub solved: bool,
    #[command(flatten)]
    pub code: CodeOptions,
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
        if let Some(language) = self.code.language(&self.shared)? {
            let by = self.code.derivatives(&space.definition)?;
            let code = space.record(|definition, reading| {
                self.report(definition, reading, &stages)?.code(language, &by)
            })?;
            return code::print(&code, &space, &self.shared, &stages);
        }
        let report =
            self.shared.run(&stages, &space, Build { arguments: self, stages: &stages })?;
        self.shared.print(&stages, space.file.as_slice(), &*report)
    }

    /// The equations of a definition.
    fn report<S: Notation>(
        &self,
        definition: &Definition,
        reading: &Reading<S>,
        stages: &Stages,
    ) -> Result<EquationReport<S>, InputError> {
        stages.begin("geometry");
        let geometry = definition.geometry(reading)?;
        stages.begin("equations");
        let equations = Equations::new(self.motion, geometry.connection(), geometry.metric());
        let equations = equations.map_err(|error| match error {
            Error::NoMetric => InputError::usage("Euler-Poincare equations need a metric")
                .help("give one, as in --metric \"diag(J1,J2,J3)\", or choose another --motion"),
            other => other.into(),
        })?;
        let equations = if self.solved { equations.solved() } else { equations };
        let system = EquationReport::new(equations, &geometry);
        system.finite()?;
        Ok(system)
    }
}

struct Build<'a> {
    arguments: &'a Arguments,
    stages: &'a Stages,
}

impl Work for Build<'_> {
    type Output = Box<dyn Report>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        Ok(Box::new(self.arguments.report(definition, reading, self.stages)?))
    }
}

fn motion(name: &str) -> Result<EquationKind, String> {
    EquationKind::from_name(name).ok_or_else(|| {
        format!("the motions are {}", EquationKind::ALL.map(EquationKind::name).join(", "))
    })
}
