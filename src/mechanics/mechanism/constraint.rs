//! The equations of a joint between two moving bodies, as polynomials in the entries of their poses.
//!
//! The frame of each body is that of the ground at the initial position. So a point or a direction
//! has the same components in both bodies.

use super::joint::JointKind;
use nalgebra::{DVector, Vector3};

/// A sum of terms, each with a coefficient and its factors.
pub type Polynomial<Q> = Vec<(f64, Vec<Q>)>;

/// An equation between the poses `(R_a, x_a)` and `(R_b, x_b)` of two bodies. All equations hold at
/// the initial position, where both poses are the identity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointConstraint {
    /// Component `i` of the positions of a point `p` agrees: `(R_b p + x_b - R_a p - x_a)_i = 0`.
    Position(usize, Vector3<f64>),
    /// The angle of two directions is constant: `R_a u . R_b v = u . v`.
    Product(Vector3<f64>, Vector3<f64>),
    /// A point `p` does not move along a direction `u` of the first body:
    /// `(R_b p + x_b - R_a p - x_a) . R_a u = 0`.
    Displacement(Vector3<f64>, Vector3<f64>),
}

impl JointConstraint {
    /// The independent equations of a joint at a point, with an axis, and with a second axis of a
    /// universal joint. The list is empty for the kind `Free`, and for the kinds `Helical` and
    /// `Subgroup`, which have no equations of this form.
    ///
    /// ```
    /// use affinor::mechanism::{JointConstraint, JointKind};
    /// use nalgebra::Vector3;
    /// let (point, axis) = (Vector3::x(), Vector3::z());
    /// let hinge = JointConstraint::all(JointKind::Revolute, &point, &axis, &Vector3::zeros());
    /// assert_eq!(hinge.len(), 5);
    /// // the rotation of the second body about the axis satisfies all equations to first order
    /// let turned = [0.0, 0.0, 1.0, 0.0, -1.0, 0.0];
    /// for equation in hinge {
    ///     let row = equation.gradient([None, Some(0)], 1);
    ///     assert_eq!(row.iter().zip(turned).map(|(a, b)| a * b).sum::<f64>(), 0.0);
    /// }
    /// ```
    pub fn all(
        kind: JointKind,
        point: &Vector3<f64>,
        axis: &Vector3<f64>,
        second: &Vector3<f64>,
    ) -> Vec<Self> {
        let positions = || (0..3).map(|i| JointConstraint::Position(i, *point));
        let [first, other] = normals(axis);
        let parallel = [first, other].map(|normal| JointConstraint::Product(normal, *axis));
        let across = [first, other].map(|normal| JointConstraint::Displacement(*point, normal));
        let unit = |k: usize| Vector3::ith(k % 3, 1.0);
        let equal = || (0..3).map(|k| JointConstraint::Product(unit(k), unit(k + 1)));
        match kind {
            JointKind::Revolute => positions().chain(parallel).collect(),
            JointKind::Prismatic => equal().chain(across).collect(),
            JointKind::Cylindrical => parallel.into_iter().chain(across).collect(),
            JointKind::Planar => {
                let along = JointConstraint::Displacement(*point, *axis);
                parallel.into_iter().chain([along]).collect()
            }
            JointKind::Spherical => positions().collect(),
            JointKind::Universal => {
                positions().chain([JointConstraint::Product(*axis, *second)]).collect()
            }
            JointKind::Fixed => positions().chain(equal()).collect(),
            JointKind::Free | JointKind::Helical | JointKind::Subgroup => vec![],
        }
    }

    /// The left side minus the right side. The bodies are factors of a product of groups SE(3), or
    /// `None` for the ground; `entry` names an entry of the pose of a factor.
    pub fn polynomial<Q: Clone>(
        &self,
        [a, b]: [Option<usize>; 2],
        entry: &dyn Fn(usize, usize, usize) -> Q,
    ) -> Polynomial<Q> {
        let point = |body, i, p: &Vector3<f64>| image(body, i, p, true, entry);
        let along = |body, i, u: &Vector3<f64>| image(body, i, u, false, entry);
        let apart = |i, p: &Vector3<f64>| difference(point(b, i, p), point(a, i, p));
        match self {
            JointConstraint::Position(i, p) => apart(*i, p),
            JointConstraint::Product(u, v) => {
                let terms = (0..3).flat_map(|i| product(&along(a, i, u), &along(b, i, v)));
                terms.chain([(-u.dot(v), vec![])]).filter(|(c, _)| *c != 0.0).collect()
            }
            JointConstraint::Displacement(p, u) => {
                (0..3).flat_map(|i| product(&apart(i, p), &along(a, i, u))).collect()
            }
        }
    }

    /// The derivatives at the initial position by the body velocities of `count` factors: three
    /// angular and three linear components for each factor.
    pub fn gradient(&self, ends: [Option<usize>; 2], count: usize) -> DVector<f64> {
        // the derivatives by the velocity of the second body; those of the first body are the
        // negative ones
        let (turn, shift) = match self {
            JointConstraint::Position(i, p) => {
                let unit = Vector3::ith(*i, 1.0);
                (p.cross(&unit), unit)
            }
            JointConstraint::Product(u, v) => (v.cross(u), Vector3::zeros()),
            JointConstraint::Displacement(p, u) => (p.cross(u), *u),
        };
        let mut row = DVector::zeros(6 * count);
        for (factor, sign) in ends.into_iter().zip([-1.0, 1.0]) {
            if let Some(factor) = factor {
                row.fixed_rows_mut::<3>(6 * factor).copy_from(&(turn * sign));
                row.fixed_rows_mut::<3>(6 * factor + 3).copy_from(&(shift * sign));
            }
        }
        row
    }
}

/// The potential `-g . (m c)` of uniform gravity: the sum over the factors of `-g . (R s + m x)`,
/// with the mass `m` and its first moment `s = m c` in the frame of the body.
pub fn gravity<Q: Clone>(
    acceleration: &Vector3<f64>,
    moments: &[(f64, Vector3<f64>)],
    entry: &dyn Fn(usize, usize, usize) -> Q,
) -> Polynomial<Q> {
    let mut terms = vec![];
    for (body, (mass, moment)) in moments.iter().enumerate() {
        for i in 0..3 {
            let mut own = image(Some(body), i, moment, false, entry);
            own.push((*mass, vec![entry(body, i, 3)]));
            terms.extend(product(&own, &[(-acceleration[i], vec![])]));
        }
    }
    terms
}

/// Two directions that are orthogonal to this one, and independent.
fn normals(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let largest = axis.iamax();
    [1, 2].map(|k| axis.cross(&Vector3::ith((largest + k) % 3, 1.0)))
}

/// Component `i` of the image of a vector in a body, with the translation for a point.
fn image<Q: Clone>(
    body: Option<usize>,
    i: usize,
    vector: &Vector3<f64>,
    is_point: bool,
    entry: &dyn Fn(usize, usize, usize) -> Q,
) -> Polynomial<Q> {
    let Some(body) = body else { return vec![(vector[i], vec![])] };
    let nonzero = (0..3).filter(|k| vector[*k] != 0.0);
    let turned = nonzero.map(|k| (vector[k], vec![entry(body, i, k)]));
    turned.chain(is_point.then(|| (1.0, vec![entry(body, i, 3)]))).collect()
}

fn difference<Q>(a: Polynomial<Q>, b: Polynomial<Q>) -> Polynomial<Q> {
    let negative = b.into_iter().map(|(coefficient, factors)| (-coefficient, factors));
    a.into_iter().chain(negative).collect()
}

fn product<Q: Clone>(a: &[(f64, Vec<Q>)], b: &[(f64, Vec<Q>)]) -> Polynomial<Q> {
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    let terms = pairs.map(|((c, first), (d, second))| (c * d, [&first[..], second].concat()));
    terms.filter(|(coefficient, _)| *coefficient != 0.0).collect()
}
