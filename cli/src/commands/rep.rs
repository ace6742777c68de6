//! `affinor rep`: representations of reductive algebras.

use super::failure::Failure;
use super::options::{Output, Settings, SpaceOptions};
use affinor::representation::{ReductiveAlgebra, RepresentationError};
use affinor::{LieAlgebra, Rational};
use affinor_documents::input::InputError;
use affinor_documents::report::{
    MatrixReport, Operations, Power, RepresentationReport, dynkin_type,
};
use affinor_tensors::Tolerance;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The algebra: "SU(5)", E6, "SU(3)xSU(2)xU(1)", "A4 + T1", or a semisimple space
    pub space: String,
    /// The highest weight: Dynkin labels "[0,1,0,0]" numbered as in Bourbaki, then charges, or a
    /// name such as 10, 5bar, 15', "(3,2)(1)"
    #[arg(allow_hyphen_values = true)]
    pub weight: String,
    /// Multiply by this representation; may be repeated
    #[arg(long, value_name = "WEIGHT", allow_hyphen_values = true)]
    pub tensor: Vec<String>,
    /// Compute the power of this degree, before the products
    #[arg(long, value_name = "DEGREE")]
    pub power: Option<usize>,
    /// The kind of the power
    #[arg(long, value_enum, default_value_t = Kind::Symmetric, requires = "power")]
    pub kind: Kind,
    /// Restrict the result to a subalgebra, such as "SU(3)xSU(2)xU(1)", "levi 3", "extended 4",
    /// principal, "span e1-f1, e2-f2, e3-f3", or others of docs/representations.md
    #[arg(long, value_name = "SUBALGEBRA")]
    pub branch: Option<String>,
    /// List the dominant weights of the result with their multiplicities
    #[arg(long)]
    pub weights: bool,
    /// Write the matrices of the generators e_i, f_i, h_i, or of all root vectors, and the
    /// invariant forms
    #[arg(long, value_enum, value_name = "WHICH", num_args = 0..=1, require_equals = true,
        default_missing_value = "generators", conflicts_with_all = ["tensor", "power", "branch", "weights"])]
    pub matrices: Option<Matrices>,
    #[command(flatten)]
    pub output: Output,
}

/// The elements of the algebra whose matrices are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Matrices {
    Generators,
    All,
}

/// The kind of a power.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    Symmetric,
    Exterior,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let (algebra, brackets, file) = algebra(&self.space)?;
        if let Some(which) = self.matrices {
            let report = MatrixReport::new(&algebra, &self.weight, which == Matrices::All)?;
            return self.output.print(file.as_slice(), &report);
        }
        let kind = match self.kind {
            Kind::Symmetric => Power::Symmetric,
            Kind::Exterior => Power::Exterior,
        };
        let operations = Operations {
            power: self.power.map(|degree| (kind, degree)),
            tensor: self.tensor.clone(),
            branch: self.branch.clone(),
            weights: self.weights,
            brackets,
        };
        let report = RepresentationReport::new(&algebra, &self.weight, &operations)?;
        self.output.print(file.as_slice(), &report)
    }
}

/// The reductive algebra of a name; or the type of a semisimple space, with its brackets if they are
/// rational.
fn algebra(name: &str) -> Result<Found, Failure> {
    match name.parse::<ReductiveAlgebra>() {
        Ok(algebra) => return Ok((algebra, None, None)),
        Err(RepresentationError::UnknownAlgebra { .. }) => {}
        Err(error) => return Err(InputError::usage(error.to_string()).into()),
    }
    let settings = Settings { set: vec![], tolerance: None, threads: None };
    let space = settings.open(Some(name), &SpaceOptions::default())?;
    let algebra = ReductiveAlgebra::new(dynkin_type(&space.definition)?, 0);
    if algebra.dimension() != space.definition.dimension() {
        let message = format!(
            "`{}` is not semisimple: its Levi subalgebra has the type {algebra}",
            name.escape_debug()
        );
        let help = "write the type of a reductive algebra, such as \"A2 + T1\" or \"U(3)\"";
        return Err(InputError::mathematics(message).help(help).into());
    }
    let definition = space.definition.algebra_alone();
    let brackets = match definition.is_rational() {
        true => Some(definition.algebra::<Rational>(Tolerance::default())?),
        false => None,
    };
    Ok((algebra, brackets, space.file))
}

/// An algebra, its brackets if it is a space, and the file of the space.
type Found = (ReductiveAlgebra, Option<LieAlgebra<Rational>>, Option<PathBuf>);
