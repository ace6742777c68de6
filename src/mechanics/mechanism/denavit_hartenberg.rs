//! Closed chains in the parameters of Denavit and Hartenberg.

use super::joint::{Joint, invalid};
use crate::{Error, Field, Notation, Scalar};

/// A link in the convention of Denavit and Hartenberg (1955). The joint rotates about the axis z of
/// its frame. Relative to it, the frame of the next joint is
/// `Rz(angle) Tz(offset) Tx(length) Rx(twist)`.
#[derive(Clone, Debug)]
pub struct Link<S> {
    /// The distance along the common normal.
    pub length: S,
    /// The cosine and sine of the angle between the axes, about the common normal.
    pub twist: [S; 2],
    /// The distance along the axis of the joint.
    pub offset: S,
    /// The cosine and sine of the angle of the joint.
    pub angle: [S; 2],
}

/// The point and the three columns of the rotation of a frame.
type Pose<S> = ([S; 3], [[S; 3]; 3]);

/// The revolute joints of a chain of links, each between the bodies `k - 1` and `k`; the last link
/// is body 0. All are in the frame of the first joint.
///
/// # Errors
/// [`Error::Invalid`] if the last frame is not the first, with the distance and the rotation.
pub fn closed_chain<S: Field + Scalar + Notation>(
    links: &[Link<S>],
) -> Result<Vec<Joint<S>>, Error> {
    let unit = |i: usize, k: usize| if i == k { S::one() } else { S::zero() };
    let mut pose: Pose<S> = (
        std::array::from_fn(|_| S::zero()),
        std::array::from_fn(|k| std::array::from_fn(|i| unit(i, k))),
    );
    let mut joints = vec![];
    for (at, link) in links.iter().enumerate() {
        let name = format!("J{}", at + 1);
        let bodies = [at, (at + 1) % links.len()];
        joints.push(Joint::revolute(&pose.0, &pose.1[2])?.between(name, bodies));
        pose = next(&pose, link);
    }
    let far = pose.0.iter().any(|value| !value.vanishes());
    let turned = (0..3).any(|k| (0..3).any(|i| pose.1[k][i] != unit(i, k)));
    if far || turned {
        let list = |values: &[S; 3]| values.each_ref().map(S::to_string).join(", ");
        return Err(invalid(format!(
            "the loop is not closed: the last frame is at ({}), with the axes ({}), ({}), ({})",
            list(&pose.0),
            list(&pose.1[0]),
            list(&pose.1[1]),
            list(&pose.1[2])
        )));
    }
    Ok(joints)
}

fn next<S: Field>((point, [x, y, z]): &Pose<S>, link: &Link<S>) -> Pose<S> {
    let sum = |a: &S, u: &[S; 3], b: &S, v: &[S; 3]| -> [S; 3] {
        std::array::from_fn(|i| a.clone() * &u[i] + &(b.clone() * &v[i]))
    };
    let [cos, sin] = &link.angle;
    let (x, y) = (sum(cos, x, sin, y), sum(&-sin.clone(), x, cos, y));
    let moved = sum(&link.offset, z, &link.length, &x);
    let point = std::array::from_fn(|i| point[i].clone() + &moved[i]);
    let [cos, sin] = &link.twist;
    let (y, z) = (sum(cos, &y, sin, z), sum(&-sin.clone(), &y, cos, z));
    (point, [x, y, z])
}
