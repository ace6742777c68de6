//! `affinor convert`: conversion between coordinates of rotations.

use super::columns::Expected;
use super::failure::Failure;
use super::note::{counted, note};
use super::restore::{Restore, Restored};
use super::rows::{self, RowOutput, map_rows};
use affinor::Error;
use affinor::group::rotation;
use affinor::group::rotation::{GimbalLock, Sequence};
use affinor::group::{LieGroup, So3};
use clap::{Args, ValueEnum};
use nalgebra::{DMatrix, Matrix3, UnitQuaternion, Vector3};
use std::cell::Cell;

/// Orthogonality tolerance: the largest deviation of a matrix from a rotation.
const TOLERANCE: f64 = 1e-6;

#[derive(Args)]
pub struct Arguments {
    /// The coordinates of the input: vector (a rotation vector), quaternion (w,x,y,z or --order),
    /// matrix, gibbs or modified (Rodrigues vectors), or Euler angles. Upper case, as in ZYX, means
    /// rotations about the axes of the body; lower case, as in zyx, about the axes of space
    #[arg(long, value_name = "KIND", value_parser = kind)]
    pub from: Kind,
    /// The coordinates of the output, one of the same kinds
    #[arg(long, value_name = "KIND", value_parser = kind)]
    pub to: Kind,
    /// Input rows, one argument per row; by default the lines of standard input, as CSV or JSON
    #[arg(value_name = "ROW", allow_negative_numbers = true)]
    pub rows: Vec<String>,
    /// Read and write rotation vectors and Euler angles in degrees
    #[arg(long)]
    pub degrees: bool,
    /// The order of the components of quaternions in the output, and in input without a header
    #[arg(long, value_enum, value_name = "ORDER", default_value_t = Order::Wxyz)]
    pub order: Order,
    #[command(flatten)]
    pub restore: Restore,
    #[command(flatten)]
    pub output: RowOutput,
}

/// An order of the components of a quaternion `w + x i + y j + z k`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Order {
    Wxyz,
    Xyzw,
}

/// A kind of coordinates of rotations.
#[derive(Clone, Copy)]
pub enum Kind {
    Vector,
    Quaternion,
    Matrix,
    Gibbs,
    Modified,
    /// Euler angles, with the letters of the axes.
    Euler(Sequence, [char; 3]),
}

impl Kind {
    fn expected(self) -> Expected {
        const AXES: [&str; 3] = ["x", "y", "z"];
        match self {
            Kind::Vector => {
                let expected = Expected::vector(3, "a rotation vector").or(&AXES);
                expected.or(&["rx", "ry", "rz"]).or(&["wx", "wy", "wz"])
            }
            Kind::Quaternion => {
                Expected::named(&["w", "x", "y", "z"], "a quaternion").or(&["qw", "qx", "qy", "qz"])
            }
            Kind::Matrix => Expected::matrix((3, 3), "a rotation matrix"),
            Kind::Gibbs | Kind::Modified => Expected::vector(3, "a Rodrigues vector").or(&AXES),
            Kind::Euler(_, axes) => {
                let expected = Expected::vector(3, "a triple of Euler angles");
                let name = |axis: char| match axis.to_ascii_uppercase() {
                    'X' => "roll",
                    'Y' => "pitch",
                    _ => "yaw",
                };
                let names = axes.map(name);
                // an axis that occurs twice does not identify an angle, so its name is not allowed
                if names[0] == names[2] { expected } else { expected.or(&names) }
            }
        }
    }

    /// The names of the columns, or the letter with which they begin.
    fn head(self) -> &'static str {
        match self {
            Kind::Vector | Kind::Gibbs | Kind::Modified => "x,y,z",
            Kind::Quaternion => "w,x,y,z",
            Kind::Matrix => "R",
            Kind::Euler(..) => "angle",
        }
    }

    fn rotation(self, row: &[f64], unit: f64) -> Result<UnitQuaternion<f64>, Error> {
        let vector = || Vector3::from_column_slice(row);
        Ok(match self {
            Kind::Vector => So3.exp(&(vector() * unit)),
            Kind::Quaternion => rotation::from_wxyz([row[0], row[1], row[2], row[3]])?,
            Kind::Matrix => rotation::from_matrix(&Matrix3::from_row_slice(row), TOLERANCE)?,
            Kind::Gibbs => rotation::from_rodrigues(&vector()),
            Kind::Modified => rotation::from_modified_rodrigues(&vector()),
            Kind::Euler(sequence, _) => sequence.rotation((vector() * unit).into()),
        })
    }

    /// Converts a rotation to coordinates. Also returns the gimbal lock, if the Euler angles have
    /// one.
    fn written(
        self,
        g: &UnitQuaternion<f64>,
        unit: f64,
    ) -> Result<(DMatrix<f64>, Option<GimbalLock>), Error> {
        let vector = |x: Vector3<f64>| rows::vector(x.as_slice());
        Ok(match self {
            Kind::Vector => (vector(So3.log(g)? / unit), None),
            Kind::Quaternion => (rows::vector(&rotation::wxyz(g)), None),
            Kind::Matrix => {
                let matrix = rotation::matrix(g);
                (DMatrix::from_fn(3, 3, |i, j| matrix[(i, j)]), None)
            }
            Kind::Gibbs => (vector(rotation::rodrigues(g)?), None),
            Kind::Modified => (vector(rotation::modified_rodrigues(g)), None),
            Kind::Euler(sequence, _) => {
                let found = sequence.angles(g);
                (vector(Vector3::from(found.angles) / unit), found.lock)
            }
        })
    }
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let unit = if self.degrees { 1f64.to_radians() } else { 1.0 };
        let locked = Cell::new(0u64);
        let scalar_last = self.order == Order::Xyzw;
        let ends = [self.from, self.to].map(|kind| matches!(kind, Kind::Quaternion) && scalar_last);
        if scalar_last && ends == [false; 2] {
            note("--order has no effect: no quaternion is read or written");
        }
        let mut expected = self.from.expected();
        if ends[0] {
            expected = expected.without_head([3, 0, 1, 2]);
        }
        let head = if ends[1] { "x,y,z,w" } else { self.to.head() };
        let mut restored = Restored::default();
        map_rows(&self.rows, &expected, head, &self.output, |row| {
            let g = match self.from {
                Kind::Matrix => {
                    let matrix = DMatrix::from_row_slice(3, 3, row);
                    let strict = |_: &DMatrix<f64>| self.from.rotation(row, unit);
                    restored.read(&self.restore, &So3, &matrix, strict)?
                }
                from => from.rotation(row, unit)?,
            };
            let (row, lock) = self.to.written(&g, unit)?;
            locked.set(locked.get() + u64::from(lock.is_some()));
            Ok(if ends[1] { DMatrix::from_fn(1, 4, |_, at| row[(at + 1) % 4]) } else { row })
        })?;
        restored.note();
        if locked.get() > 0 {
            let rows = counted(locked.get(), "row");
            note(&format!("gimbal lock in {rows}: the last angle is set to 0 there"));
        }
        Ok(())
    }
}

/// The kinds with a name of their own; Euler angles are named by their axes.
pub const KINDS: [(&str, Kind); 5] = [
    ("vector", Kind::Vector),
    ("quaternion", Kind::Quaternion),
    ("matrix", Kind::Matrix),
    ("gibbs", Kind::Gibbs),
    ("modified", Kind::Modified),
];

fn kind(name: &str) -> Result<Kind, String> {
    if let Some((_, kind)) = KINDS.iter().find(|(own, _)| *own == name) {
        return Ok(*kind);
    }
    let unknown = || {
        let names = KINDS.map(|(name, _)| name).join(", ");
        format!("choose {names}, and Euler angles such as ZYX")
    };
    let axes: Vec<char> = name.chars().collect();
    let axes = axes.try_into().map_err(|_| unknown())?;
    Ok(Kind::Euler(name.parse().map_err(|_| unknown())?, axes))
}
