//! Twists of axes in the ground frame.

use crate::Ring;
use crate::tensors::linear::Row;

/// A twist `(w, u)`: the angular velocity, and the velocity of the body point at the origin.
pub type Twist<S> = [S; 6];

/// The cross product of two vectors.
pub fn cross<S: Ring>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].clone() * &b[k] - &(a[k].clone() * &b[j])
    })
}

/// The scalar product of two vectors.
pub fn dot<S: Ring>(a: &[S; 3], b: &[S; 3]) -> S {
    (0..3).fold(S::zero(), |sum, i| sum + &(a[i].clone() * &b[i]))
}

/// The rotation about an axis through a point: `(w, p cross w)`.
///
/// ```
/// use affinor::mechanism::twist::rotation;
/// // about z through (1, 0, 0), the point at the origin moves along -y
/// assert_eq!(rotation(&[1.0, 0.0, 0.0], &[0.0, 0.0, 1.0]), [0.0, 0.0, 1.0, 0.0, -1.0, 0.0]);
/// ```
pub fn rotation<S: Ring>(point: &[S; 3], axis: &[S; 3]) -> Twist<S> {
    joined(axis.clone(), cross(point, axis))
}

/// The translation along an axis: `(0, u)`.
pub fn translation<S: Ring>(axis: &[S; 3]) -> Twist<S> {
    joined(std::array::from_fn(|_| S::zero()), axis.clone())
}

/// The twist with these parts.
pub(super) fn joined<S: Ring>(w: [S; 3], u: [S; 3]) -> Twist<S> {
    let ([a, b, c], [d, e, f]) = (w, u);
    [a, b, c, d, e, f]
}

/// The angular part `w`.
pub(super) fn angular<S: Clone>(twist: &Twist<S>) -> [S; 3] {
    std::array::from_fn(|i| twist[i].clone())
}

/// The linear part `u`.
pub(super) fn linear<S: Clone>(twist: &Twist<S>) -> [S; 3] {
    std::array::from_fn(|i| twist[i + 3].clone())
}

/// The nonzero components.
pub(super) fn sparse<S: Ring>(values: &[S]) -> Row<S> {
    let nonzero = values.iter().enumerate().filter(|(_, value)| !value.vanishes());
    nonzero.map(|(at, value)| (at, value.clone())).collect()
}

/// The nonzero twist with the opposite sign.
pub(super) fn reversed<S: Ring>(twist: &Twist<S>) -> Twist<S> {
    twist.clone().map(|value| -value)
}
