//! `affinor exp`, `log`, `compose`, `adjoint`: operations in the group of a space.

use super::columns::Expected;
use super::failure::Failure;
use super::note::{counted, note};
use super::options::{Settings, SpaceOptions};
use super::restore::{Restore, Restored};
use super::rows::{RowOutput, map_rows, vector};
use affinor::group::{AnyGroup, LieGroup, MatrixNotation};
use clap::Args;
use nalgebra::{DMatrix, DVector};

/// A group, and its input rows.
#[derive(Args)]
pub struct Arguments {
    /// The space that defines the group; see `affinor --help`
    pub space: String,
    /// Input rows, one argument per row, as in "0, pi/2, 1e-3"; by default the lines of standard
    /// input, as CSV or JSON
    #[arg(value_name = "ROW", allow_negative_numbers = true)]
    pub rows: Vec<String>,
    /// Read and write the angles of rotations in degrees
    #[arg(long)]
    pub degrees: bool,
    #[command(flatten)]
    pub settings: Settings,
    #[command(flatten)]
    pub output: RowOutput,
}

/// A group, and its elements as input rows.
#[derive(Args)]
pub struct LogArguments {
    #[command(flatten)]
    pub arguments: Arguments,
    #[command(flatten)]
    pub restore: Restore,
}

impl LogArguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.arguments.run(Operation::Log(&self.restore))
    }
}

/// The operation on each row.
#[derive(Clone, Copy)]
pub enum Operation<'r> {
    /// Maps coordinates to the element.
    Exp,
    /// Maps an element to its coordinates.
    Log(&'r Restore),
    /// Maps two coordinate vectors, concatenated, to the coordinates of the product.
    Compose,
    /// Maps coordinates to the matrix of `Ad`.
    Adjoint,
}

impl Arguments {
    pub fn run(&self, operation: Operation<'_>) -> Result<(), Failure> {
        let (group, labels) = self.open()?;
        let (n, shape) = (group.dimension(), group.write(&group.identity()).shape());
        let a_vector = format!("a vector of this algebra of dimension {n}");
        let expected = match operation {
            Operation::Exp | Operation::Adjoint => {
                Expected::vector(n, a_vector).or(&labels).or(&["x", "y", "z"])
            }
            Operation::Compose => {
                let pair = ["x", "y"].map(|letter| (1..=n).map(move |at| format!("{letter}{at}")));
                let pair: Vec<String> = pair.into_iter().flatten().collect();
                Expected::vector(2 * n, format!("twice {a_vector}")).or(&pair)
            }
            Operation::Log(_) => {
                let (rows, columns) = shape;
                let what = format!("an element of {rows} rows and {columns} columns");
                Expected::matrix(shape, what)
            }
        };
        let angles = Angles::new(self.degrees, &group);
        let head = match operation {
            Operation::Exp => "g",
            Operation::Adjoint => "Ad",
            Operation::Log(_) | Operation::Compose => "x",
        };
        let (mut coarse, mut restored) = (Coarse::default(), Restored::default());
        map_rows(&self.rows, &expected, head, &self.output, |row| {
            Ok(match operation {
                Operation::Exp => group.write(&group.exp(&angles.read(row))),
                Operation::Adjoint => group.adjoint_exp(&angles.read(row)),
                Operation::Compose => {
                    let (x, y) = row.split_at(n);
                    let product = group.log_product(&angles.read(x), &angles.read(y))?;
                    vector(&angles.written(product))
                }
                Operation::Log(restore) => {
                    let element = DMatrix::from_row_slice(shape.0, shape.1, row);
                    let g = restored.read(restore, &group, &element, |m| group.read(m))?;
                    let x = group
                        .log(&g)
                        .map_err(|error| restored.refused(restore, &group, &element, error))?;
                    coarse.add(group.log_rounding(&g, &x), x.amax());
                    vector(&angles.written(x))
                }
            })
        })?;
        coarse.note();
        restored.note();
        Ok(())
    }

    /// The group, and the names of its basis vectors.
    fn open(&self) -> Result<(AnyGroup, Vec<String>), Failure> {
        self.settings.start_threads()?;
        let space = self.settings.open(Some(&self.space), &SpaceOptions::default())?;
        let definition = space.in_floats()?;
        Ok((definition.group(self.settings.tolerance()?)?, definition.labels.clone()))
    }
}

/// Statistics of ill-conditioned logarithms: the rounded entries of an element determine only a few
/// digits of such a logarithm.
#[derive(Default)]
struct Coarse {
    rows: u64,
    /// The largest relative error.
    error: f64,
}

impl Coarse {
    /// The relative error below which no note is printed, because the output has only twelve
    /// digits.
    const FINE: f64 = 1e-12;

    /// Counts a logarithm of size `size` whose absolute error is `error`.
    fn add(&mut self, error: Option<f64>, size: f64) {
        let error = error.unwrap_or(0.0);
        // a zero logarithm has no relative error
        if size > 0.0 && error > Self::FINE * size {
            self.rows += 1;
            self.error = self.error.max(error / size);
        }
    }

    /// Prints a note on the number of correct digits of the worst logarithm.
    fn note(&self) {
        if self.rows > 0 {
            let digits = (-self.error.log10()).floor().max(0.0);
            let rows = counted(self.rows, "row");
            note(&format!(
                "entries rounded to floats determine about {digits} digits of the logarithm ({rows})"
            ));
        }
    }
}

/// The units of the components of a vector, in radians; 1 for a component that is not an angle.
pub struct Angles(Vec<f64>);

impl Angles {
    pub fn new(degrees: bool, group: &AnyGroup) -> Self {
        let degree = |i: usize| degrees && group.is_angle(i);
        let unit = |i: usize| if degree(i) { 1f64.to_radians() } else { 1.0 };
        let units: Vec<f64> = (0..group.dimension()).map(unit).collect();
        if degrees && units.iter().all(|unit| *unit == 1.0) {
            note("--degrees has no effect: no component is an angle");
        }
        Angles(units)
    }

    /// Converts the angles among the components to radians.
    pub fn read(&self, x: &[f64]) -> DVector<f64> {
        DVector::from_iterator(x.len(), x.iter().zip(&self.0).map(|(x, unit)| x * unit))
    }

    /// Converts the angles among the components from radians to these units.
    pub fn written(&self, x: DVector<f64>) -> Vec<f64> {
        x.iter().zip(&self.0).map(|(x, unit)| x / unit).collect()
    }
}
