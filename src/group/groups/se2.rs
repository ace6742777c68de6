//! SE(2), the rigid motions of a plane.

use super::so2::nearest_turn;
use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, checked, replace, sparse};
use crate::group::{Embedded, LieGroup, So2, tangent};
use nalgebra::{DMatrix, Isometry2, UnitComplex, Vector1, Vector2, Vector3, Vector4};

/// The group of rigid motions of a plane, `p -> R p + t`.
///
/// Elements are nalgebra's `Isometry2<f64>`. Vectors `(w, u_1, u_2)` consist of the angle and the
/// translation. The basis is the basis of `se(2)` in the catalogue: `[e, p1] = p2`,
/// `[e, p2] = -p1`.
///
/// ```
/// use affinor::group::{LieGroup, Se2};
/// use nalgebra::Vector3;
/// // drive ahead while turning by a quarter: an arc of radius 1
/// let quarter = std::f64::consts::FRAC_PI_2;
/// let end = Se2.exp(&Vector3::new(quarter, quarter, 0.0)).translation.vector;
/// assert!((end - nalgebra::Vector2::new(1.0, 1.0)).norm() < 1e-15);
/// ```
#[doc(alias("planar motions", "SE(2)"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Se2;

/// Rotates a vector by a quarter turn.
fn turned(u: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-u.y, u.x)
}

fn translation(x: &Vector3<f64>) -> Vector2<f64> {
    Vector2::new(x[1], x[2])
}

fn join(angle: f64, u: Vector2<f64>) -> Vector3<f64> {
    Vector3::new(angle, u.x, u.y)
}

impl LieGroup for Se2 {
    type Element = Isometry2<f64>;
    type Vector = Vector3<f64>;

    fn dimension(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        Isometry2::identity()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.inverse()
    }

    /// The rotation by the angle `w` and the translation `T_right(w) u`.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let turn = join(x[0], Vector2::zeros());
        let end = self.tangent_right(&turn, &join(0.0, translation(x)));
        Isometry2::from_parts(translation(&end).into(), UnitComplex::new(x[0]))
    }

    /// The logarithm whose angle is between `-pi` and `pi`.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        let turn = join(g.rotation.angle(), Vector2::zeros());
        let u = self.tangent_right_inverse(&turn, &join(0.0, g.translation.vector))?;
        Ok(turn + u)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        join(x[0], g.rotation * translation(x) - turned(g.translation.vector) * x[0])
    }

    fn project(&self, g: Self::Element) -> Self::Element {
        let rotation = UnitComplex::new_normalize(g.rotation.into_inner());
        Isometry2::from_parts(g.translation, rotation)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        join(0.0, turned(translation(y)) * x[0] - turned(translation(x)) * y[0])
    }

    /// The homogeneous matrix of size 3.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        DMatrix::from_column_slice(3, 3, g.to_homogeneous().as_slice())
    }

    /// Computes the operator in closed form, because `ad_x^3 = -w^2 ad_x`.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        tangent::cubic(self, |x| x[0] * x[0], x, v)
    }

    /// Computes the operator in closed form.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        tangent::cubic_inverse(self, [x[0] * x[0]; 2], x, v)
    }
}

impl TranslationSplit for Se2 {
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        Some(join(0.0, translation(x)))
    }

    fn translational_momentum(&self, h: &Self::Vector) -> Option<Self::Vector> {
        Some(join(0.0, translation(h)))
    }

    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        Isometry2::from_parts(Vector2::zeros().into(), g.rotation)
    }

    fn has_bounded_adjoint(&self) -> bool {
        true
    }
}

/// The embedding coordinates are cosine and sine of the angle, followed by the translation.
impl Embedded for Se2 {
    type Ambient = Vector4<f64>;

    fn coordinates(&self, g: &Self::Element) -> Vector4<f64> {
        let (turn, t) = (So2.coordinates(&g.rotation), g.translation);
        Vector4::new(turn.x, turn.y, t.x, t.y)
    }

    fn from_coordinates(&self, y: &Vector4<f64>) -> Self::Element {
        let rotation = So2.from_coordinates(&Vector2::new(y[0], y[1]));
        Isometry2::from_parts(Vector2::new(y[2], y[3]).into(), rotation)
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Vector4<f64> {
        let turn = So2.rate(&g.rotation, &Vector1::new(v[0]));
        // uses the projected rotation, so that the path is consistent with the momentum
        let t = So2.project(g.rotation) * translation(v);
        Vector4::new(turn.x, turn.y, t.x, t.y)
    }

    fn is_translation_coordinate(&self, at: usize) -> bool {
        at >= 2
    }
}

/// The written form is the homogeneous matrix of size 3. The angle and the position are named
/// coordinates.
impl MatrixNotation for Se2 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let translation = Vector2::new(m[(0, 2)], m[(1, 2)]);
            Ok(Isometry2::from_parts(translation.into(), nearest_turn(m)))
        })
    }

    fn is_angle(&self, at: usize) -> bool {
        at == 0
    }

    fn names(&self) -> &'static [&'static str] {
        &["angle", "x", "y"]
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        [g.rotation.angle(), g.translation.x, g.translation.y][k]
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, g.to_homogeneous().as_slice());
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let turn = sparse(3, &[(1, 0, 1.0), (0, 1, -1.0)]);
        vec![turn, sparse(3, &[(0, 2, 1.0)]), sparse(3, &[(1, 2, 1.0)])]
    }
}
