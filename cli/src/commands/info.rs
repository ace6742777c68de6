//! `affinor info`: the structure of a Lie algebra.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use super::stages::Stages;
use affinor_documents::report::{Coefficients, Info};
use affinor_tensors::Effort;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space, of which only the Lie algebra is used; see `affinor --help`
    pub space: Option<String>,
    /// The names of the basis vectors, if no SPACE is given, as in "x y z"
    #[arg(long, value_name = "NAMES")]
    pub basis: Option<String>,
    /// Brackets of the --basis vectors, as in "[x,y]=z; [y,z]=x"; may be repeated
    #[arg(long, value_name = "BRACKET")]
    pub bracket: Vec<String>,
    /// Values of parameters, as in "h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    /// Add the cohomology with coefficients in a module: adjoint, coadjoint, trivial, or a matrix for
    /// each basis vector, as in "[[0,1],[0,0]], [[1,0],[0,-1]]"
    #[arg(long, value_name = "MODULE")]
    pub coefficients: Option<String>,
    /// Add a left-invariant distribution, spanned by vectors as in "e1, e2 + e3": whether it is
    /// involutive, its growth vector, and whether it generates the algebra
    #[arg(long, value_name = "VECTORS", allow_hyphen_values = true)]
    pub distribution: Option<String>,
    /// Print the seconds of each stage to standard error
    #[arg(long)]
    pub timings: bool,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = Stages::new(self.timings, Effort::DEFAULT);
        stages.begin("input");
        let (basis, bracket) = (self.basis.clone(), self.bracket.clone());
        let options = SpaceOptions { basis, bracket, ..SpaceOptions::default() };
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let coefficients = match &self.coefficients {
            Some(text) => text.parse()?,
            None => Coefficients::Trivial,
        };
        let space = settings.open(self.space.as_deref(), &options)?;
        let begin = |name: &str| stages.begin(name);
        let mut info = Info::with_coefficients(&space.definition, &coefficients, &begin)?;
        if let Some(vectors) = &self.distribution {
            stages.begin("distribution");
            info.add_distribution(&space.definition, vectors)?;
        }
        stages.begin_output();
        self.output.print(space.file.as_slice(), &info)
    }
}
