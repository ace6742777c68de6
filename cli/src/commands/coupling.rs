//! `affinor coupling`: Clebsch-Gordan coefficients, 3j and 6j symbols.

use super::failure::Failure;
use super::options::Output;
use affinor_documents::report::{CouplingKind, CouplingReport};
use clap::{Args, ValueEnum};

#[derive(Args)]
pub struct Arguments {
    /// The spins: two, such as 1 3/2, and optionally the third one; six for a 6j symbol
    #[arg(required = true, num_args = 2..=6, value_name = "SPIN")]
    pub spins: Vec<String>,
    /// The kind of coefficients
    #[arg(long, value_enum, default_value_t = Symbol::ClebschGordan)]
    pub symbol: Symbol,
    /// Write the invariant tensor of integer spins in the real basis that e3nn uses
    #[arg(long, conflicts_with = "symbol")]
    pub real: bool,
    #[command(flatten)]
    pub output: Output,
}

/// The kind of coefficients.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Symbol {
    ClebschGordan,
    #[value(name = "3j")]
    ThreeJ,
    #[value(name = "6j")]
    SixJ,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let kind = match self.symbol {
            _ if self.real => CouplingKind::Real,
            Symbol::ClebschGordan => CouplingKind::ClebschGordan,
            Symbol::ThreeJ => CouplingKind::ThreeJ,
            Symbol::SixJ => CouplingKind::SixJ,
        };
        let report = CouplingReport::new(&self.spins, kind)?;
        self.output.print(&[], &report)
    }
}
