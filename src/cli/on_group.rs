//! `affinor exp`, `log`, `compose`, `adjoint`: on the group of a space.

use super::failure::Failure;
use super::options::{Shared, SpaceOptions};
use super::rows::{Expected, map_rows, vector};
use affinor::any_group::AnyGroup;
use clap::Args;
use nalgebra::DMatrix;
use std::process::ExitCode;

/// A group, and rows of numbers about it.
#[derive(Args)]
pub struct Arguments {
    /// The space whose group it is; see `affinor --help`
    pub space: String,
    /// Rows, each one argument, as in "0, pi/2, 1e-3"; without them, lines of standard input, as
    /// CSV or JSON
    #[arg(value_name = "ROW", allow_negative_numbers = true)]
    pub rows: Vec<String>,
    /// Angles in degrees, of the group's rotation vectors, in and out
    #[arg(long)]
    pub degrees: bool,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

/// What is done to each row.
#[derive(Clone, Copy)]
pub enum Operation {
    /// Coordinates to the element.
    Exp,
    /// An element to its coordinates.
    Log,
    /// Two coordinates, one behind the other, to those of the product.
    Compose,
    /// Coordinates to the matrix of `Ad`.
    Adjoint,
}

impl Arguments {
    pub fn run(&self, operation: Operation) -> Result<ExitCode, Failure> {
        let group = self.open()?;
        let n = group.dimension();
        let a_vector = format!("a vector of this algebra of dimension {n}");
        let expected = match operation {
            Operation::Exp | Operation::Adjoint => Expected { numbers: n, what: a_vector },
            Operation::Compose => Expected { numbers: 2 * n, what: format!("twice {a_vector}") },
            Operation::Log => {
                let (rows, columns) = group.shape();
                let what = format!("an element of {rows} rows and {columns} columns");
                Expected { numbers: rows * columns, what }
            }
        };
        let angles = Angles::new(self.degrees, group.as_ref());
        map_rows(&self.rows, &expected, &self.shared.output, |row| {
            Ok(match operation {
                Operation::Exp => group.exp(&angles.read(row)),
                Operation::Adjoint => group.adjoint(&angles.read(row)),
                Operation::Compose => {
                    let (x, y) = row.split_at(n);
                    let product = group.compose(&[angles.read(x), angles.read(y)])?;
                    vector(&angles.written(product))
                }
                Operation::Log => {
                    let (rows, columns) = group.shape();
                    let x = group.log(&DMatrix::from_row_slice(rows, columns, row))?;
                    vector(&angles.written(x))
                }
            })
        })?;
        Ok(ExitCode::SUCCESS)
    }

    fn open(&self) -> Result<Box<dyn AnyGroup>, Failure> {
        self.shared.start()?;
        let space = self.shared.open(Some(&self.space), &self.options)?;
        let tolerance = self.shared.tolerance()?;
        Ok(space.in_floats(tolerance, |definition, reading| definition.group(reading))?)
    }
}

/// The unit of the first components.
pub struct Angles {
    count: usize,
    unit: f64,
}

impl Angles {
    pub fn new(degrees: bool, group: &dyn AnyGroup) -> Self {
        Angles { count: group.angles(), unit: if degrees { 1f64.to_radians() } else { 1.0 } }
    }

    /// In radians.
    pub fn read(&self, x: &[f64]) -> Vec<f64> {
        let unit = |i: usize| if i < self.count { self.unit } else { 1.0 };
        x.iter().enumerate().map(|(i, x)| x * unit(i)).collect()
    }

    /// In the unit.
    pub fn written(&self, mut x: Vec<f64>) -> Vec<f64> {
        x.iter_mut().take(self.count).for_each(|x| *x /= self.unit);
        x
    }
}
