//! Frames of links and joints, over any scalar.

use affinor::Field;
use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

/// The element `origin`: a position, and the angles roll, pitch and yaw about the fixed axes x, y
/// and z.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Origin {
    pub position: [f64; 3],
    pub angles: [f64; 3],
}

/// Scalars to which the numbers of a file are converted.
pub(crate) trait Number: Field {
    /// The scalar of a number.
    fn of(number: f64) -> Self;

    /// The cosine and the sine of an angle in radians.
    fn turn(angle: f64) -> [Self; 2];
}

impl Number for f64 {
    fn of(number: f64) -> Self {
        number
    }

    fn turn(angle: f64) -> [Self; 2] {
        let (sin, cos) = angle.sin_cos();
        [cos, sin]
    }
}

/// The pose of a frame: its rotation as rows, and its origin.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pose<S> {
    rotation: [[S; 3]; 3],
    pub position: [S; 3],
}

impl<S: Number> Pose<S> {
    pub fn identity() -> Self {
        let unit = |i: usize, k: usize| if i == k { S::one() } else { S::zero() };
        Pose {
            rotation: std::array::from_fn(|i| std::array::from_fn(|k| unit(i, k))),
            position: std::array::from_fn(|_| S::zero()),
        }
    }

    /// The pose of an origin: `Rz(yaw) Ry(pitch) Rx(roll)`, then the translation.
    pub fn of(origin: &Origin) -> Self {
        let about = |axis: usize| {
            let [cos, sin] = S::turn(origin.angles[axis]);
            let mut rotation = Self::identity();
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            rotation.rotation[j][j] = cos.clone();
            rotation.rotation[k][k] = cos;
            rotation.rotation[j][k] = -sin.clone();
            rotation.rotation[k][j] = sin;
            rotation
        };
        Pose { position: origin.position.map(S::of), ..about(2).then(&about(1)).then(&about(0)) }
    }

    /// The pose of a frame that is given relative to this frame.
    pub fn then(&self, next: &Self) -> Self {
        let mut columns: [[S; 3]; 3] = std::array::from_fn(|_| self.position.clone());
        for (k, column) in columns.iter_mut().enumerate() {
            *column = self.direction(&next.rotation.each_ref().map(|row| row[k].clone()));
        }
        let moved = self.direction(&next.position);
        Pose {
            rotation: std::array::from_fn(|i| columns.each_ref().map(|column| column[i].clone())),
            position: std::array::from_fn(|i| self.position[i].clone() + &moved[i]),
        }
    }

    /// The components of a vector of this frame in the frame outside.
    pub fn direction(&self, vector: &[S; 3]) -> [S; 3] {
        self.rotation.each_ref().map(|row| {
            let terms = row.iter().zip(vector).map(|(a, b)| a.clone() * b);
            terms.fold(S::zero(), |sum, term| sum + &term)
        })
    }
}

impl Pose<f64> {
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|i, k| self.rotation[i][k])
    }

    pub fn isometry(&self) -> Isometry3<f64> {
        let rotation = Rotation3::from_matrix_unchecked(self.matrix());
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Isometry3::from_parts(Vector3::from(self.position).into(), rotation)
    }
}
