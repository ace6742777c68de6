//! `affinor equations`: the equations of motion of one space.

use super::code::{self, CodeOptions};
use super::failure::Failure;
use super::note::{note, note_default_connection};
use super::options::{Shared, SpaceOptions};
use affinor::CanonicalConnection;
use affinor::geometry::equations::EquationKind;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// The equations: euler-poincare (needs a metric), autoparallel, or transport
    #[arg(long, default_value = "euler-poincare", value_parser = kind)]
    pub kind: EquationKind,
    /// Solve the equations for the time derivatives, with the inverse metric
    #[arg(long, conflicts_with = "code")]
    pub solve: bool,
    #[command(flatten)]
    pub code: CodeOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let mut space = self.shared.open(self.space.as_deref(), &self.options)?;
        if self.kind == EquationKind::EulerPoincare && space.definition.connection_is_default() {
            note("no connection given: using plus, for Euler-Poincare equations");
            space.definition.set_canonical(CanonicalConnection::Plus);
        }
        note_default_connection(&space.definition);
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        if let Some(language) = self.code.language(&self.shared)? {
            let by = self.code.derivatives(&space.definition)?;
            let code = computation.equations_as_code(self.kind, language, &by)?;
            return code::print(&code, &space, &self.shared, &stages);
        }
        let report = stages.bound(|| computation.equations(self.kind, self.solve))??;
        self.shared.print(&stages, space.file.as_slice(), &*report)
    }
}

fn kind(name: &str) -> Result<EquationKind, String> {
    EquationKind::from_name(name).ok_or_else(|| {
        format!("the motions are {}", EquationKind::ALL.map(EquationKind::name).join(", "))
    })
}
