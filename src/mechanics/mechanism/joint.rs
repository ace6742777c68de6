//! Joints: subgroups of SE(3) to which they restrict a relative pose.

use super::twist::{Twist, cross, dot, rotation, sparse, translation};
use crate::algebra::catalogue;
use crate::algebra::structure::Subspace;
use crate::{Error, Field, LieAlgebra, Notation, Scalar};

/// The kinds of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// A rotation about an axis.
    Revolute,
    /// A translation along an axis.
    Prismatic,
    /// A rotation about an axis with a proportional translation along it.
    Helical,
    /// A rotation about an axis and an independent translation along it.
    Cylindrical,
    /// All rotations about a point.
    Spherical,
    /// The motions of a plane.
    Planar,
    /// The product of two rotations about axes through a point. It is not a subgroup.
    Universal,
    /// No relative motion.
    Fixed,
    /// All relative motions.
    Free,
    /// A subgroup that is given by a basis of its algebra.
    Subgroup,
}

impl JointKind {
    /// All kinds.
    pub const ALL: [JointKind; 10] = [
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Helical,
        JointKind::Cylindrical,
        JointKind::Spherical,
        JointKind::Planar,
        JointKind::Universal,
        JointKind::Fixed,
        JointKind::Free,
        JointKind::Subgroup,
    ];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
            JointKind::Helical => "helical",
            JointKind::Cylindrical => "cylindrical",
            JointKind::Spherical => "spherical",
            JointKind::Planar => "planar",
            JointKind::Universal => "universal",
            JointKind::Fixed => "fixed",
            JointKind::Free => "free",
            JointKind::Subgroup => "subgroup",
        }
    }

    /// The kind with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// A joint between two bodies.
///
/// The pose of the second body relative to the first is a product `exp(q_1 S_1) exp(q_2 S_2) ...`
/// of one-parameter groups. It covers a neighbourhood of the identity in the subgroup of the
/// joint. The twists `S_k` are components in the ground frame at the given position.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint<S> {
    /// The name.
    pub name: String,
    /// The indices of the two bodies.
    pub bodies: [usize; 2],
    kind: JointKind,
    twists: Vec<Twist<S>>,
}

/// The numbers that define a joint; each kind uses some of them.
#[derive(Clone, Debug, PartialEq)]
pub struct JointData<S> {
    /// A point on the axis, or the centre.
    pub point: [S; 3],
    /// The axis, or the normal of a plane.
    pub axis: [S; 3],
    /// The second axis of a universal joint.
    pub second_axis: [S; 3],
    /// The translation per radian of a helical joint.
    pub pitch: S,
    /// The twists of a subgroup.
    pub twists: Vec<Twist<S>>,
}

impl<S: Field + Scalar + Notation> Joint<S> {
    /// The joint of a kind.
    ///
    /// # Errors
    /// Those of the kind, such as [`revolute`](Self::revolute).
    pub fn of_kind(kind: JointKind, data: JointData<S>) -> Result<Self, Error> {
        let JointData { point, axis, second_axis, pitch, twists } = data;
        match kind {
            JointKind::Revolute => Self::revolute(&point, &axis),
            JointKind::Prismatic => Self::prismatic(&axis),
            JointKind::Helical => Self::helical(&point, &axis, &pitch),
            JointKind::Cylindrical => Self::cylindrical(&point, &axis),
            JointKind::Spherical => Self::spherical(&point),
            JointKind::Planar => Self::planar(&point, &axis),
            JointKind::Universal => Self::universal(&point, [&axis, &second_axis]),
            JointKind::Fixed => Ok(Self::fixed()),
            JointKind::Free => Self::free(&point),
            JointKind::Subgroup => Self::subgroup(twists),
        }
    }

    /// A revolute joint, about an axis through a point.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the axis is zero.
    pub fn revolute(point: &[S; 3], axis: &[S; 3]) -> Result<Self, Error> {
        Self::of(JointKind::Revolute, vec![rotation(point, nonzero(axis)?)])
    }

    /// A prismatic joint, along an axis.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the axis is zero.
    pub fn prismatic(axis: &[S; 3]) -> Result<Self, Error> {
        Self::of(JointKind::Prismatic, vec![translation(nonzero(axis)?)])
    }

    /// A helical joint, whose pitch is the translation per radian.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the axis is zero.
    pub fn helical(point: &[S; 3], axis: &[S; 3], pitch: &S) -> Result<Self, Error> {
        let mut twist = rotation(point, nonzero(axis)?);
        for (i, component) in axis.iter().enumerate() {
            twist[i + 3] = twist[i + 3].clone() + &(component.clone() * pitch);
        }
        Self::of(JointKind::Helical, vec![twist])
    }

    /// A cylindrical joint, about and along an axis through a point.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the axis is zero.
    pub fn cylindrical(point: &[S; 3], axis: &[S; 3]) -> Result<Self, Error> {
        let axis = nonzero(axis)?;
        Self::of(JointKind::Cylindrical, vec![rotation(point, axis), translation(axis)])
    }

    /// A spherical joint, about a point.
    ///
    /// # Errors
    /// None in practice; the algebra of rotations is checked as any other.
    pub fn spherical(point: &[S; 3]) -> Result<Self, Error> {
        Self::of(JointKind::Spherical, unit_vectors().map(|axis| rotation(point, &axis)).into())
    }

    /// A planar joint: the motions of the planes orthogonal to a vector. The first twist is the
    /// rotation about an axis through a point, then follow two translations.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the normal vector is zero.
    pub fn planar(point: &[S; 3], normal: &[S; 3]) -> Result<Self, Error> {
        let normal = nonzero(normal)?;
        let mut twists = vec![rotation(point, normal)];
        let pivot = normal.iter().position(|value| !value.vanishes()).unwrap_or(0);
        for (i, unit) in unit_vectors().iter().enumerate() {
            if i != pivot {
                twists.push(translation(&cross(normal, unit)));
            }
        }
        Self::of(JointKind::Planar, twists)
    }

    /// A universal joint: the product of rotations about two axes through a point.
    ///
    /// # Errors
    /// [`Error::Invalid`] if an axis is zero, or if the axes are parallel.
    pub fn universal(point: &[S; 3], axes: [&[S; 3]; 2]) -> Result<Self, Error> {
        let [first, second] = [nonzero(axes[0])?, nonzero(axes[1])?];
        if cross(first, second).iter().all(S::vanishes) {
            return Err(invalid("the two axes of a universal joint are parallel".into()));
        }
        let twists = vec![rotation(point, first), rotation(point, second)];
        Ok(Joint { name: String::new(), bodies: [0, 1], kind: JointKind::Universal, twists })
    }

    /// A joint without relative motion.
    pub fn fixed() -> Self {
        Joint { name: String::new(), bodies: [0, 1], kind: JointKind::Fixed, twists: vec![] }
    }

    /// A joint with all relative motions: three translations along the axes of the ground, then the
    /// rotations about a point.
    ///
    /// # Errors
    /// None in practice; the algebra is checked as any other.
    pub fn free(point: &[S; 3]) -> Result<Self, Error> {
        let translations = unit_vectors().map(|axis| translation(&axis));
        let rotations = unit_vectors().map(|axis| rotation(point, &axis));
        Self::of(JointKind::Free, translations.into_iter().chain(rotations).collect())
    }

    /// A joint whose subgroup has the algebra that is spanned by these twists.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::mechanism::Joint;
    /// let twist = |list: [i64; 6]| list.map(Rational::from);
    /// // the rotations about x and y generate the rotations about z
    /// let error = Joint::subgroup(vec![twist([1, 0, 0, 0, 0, 0]), twist([0, 1, 0, 0, 0, 0])]);
    /// assert!(error.unwrap_err().to_string().contains("[1, 2] = (0, 0, 1, 0, 0, 0)"));
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] if the twists are dependent, or do not span a subalgebra, with the
    /// bracket that is not in the span.
    pub fn subgroup(twists: Vec<Twist<S>>) -> Result<Self, Error> {
        Self::of(JointKind::Subgroup, twists)
    }

    /// The joint with these twists, which must be a basis of a subalgebra.
    fn of(kind: JointKind, twists: Vec<Twist<S>>) -> Result<Self, Error> {
        let mut span = Subspace::zero(6);
        for (at, twist) in twists.iter().enumerate() {
            if !span.add(sparse(twist)) {
                let at = at + 1;
                return Err(invalid(format!("twist {at} is a combination of the earlier twists")));
            }
        }
        let algebra = rigid_motions::<S>()?;
        for (i, first) in twists.iter().enumerate() {
            for (j, second) in twists.iter().enumerate().skip(i + 1) {
                let bracket = algebra.bracket(first, second)?;
                if !span.contains(&sparse(&bracket)) {
                    let parts: Vec<_> = bracket.iter().map(S::to_string).collect();
                    let (i, j, parts) = (i + 1, j + 1, parts.join(", "));
                    return Err(invalid(format!(
                        "the twists do not span a subalgebra: the bracket [{i}, {j}] = ({parts}) \
                         is not in their span"
                    )));
                }
            }
        }
        Ok(Joint { name: String::new(), bodies: [0, 1], kind, twists })
    }

    /// The joint with a name, between two bodies.
    #[must_use]
    pub fn between(self, name: impl Into<String>, bodies: [usize; 2]) -> Self {
        Joint { name: name.into(), bodies, ..self }
    }
}

impl<S> Joint<S> {
    /// The kind.
    pub fn kind(&self) -> JointKind {
        self.kind
    }

    /// The twists `S_k` of the factors of the relative pose, in their order.
    pub fn twists(&self) -> &[Twist<S>] {
        &self.twists
    }

    /// The number of degrees of freedom.
    pub fn freedom(&self) -> usize {
        self.twists.len()
    }

    /// The joint over another scalar.
    ///
    /// # Errors
    /// The error of `f`.
    pub fn map<T, E>(&self, f: impl Fn(&S) -> Result<T, E>) -> Result<Joint<T>, E> {
        let mut twists = Vec::with_capacity(self.twists.len());
        for [a, b, c, d, e, g] in &self.twists {
            twists.push([f(a)?, f(b)?, f(c)?, f(d)?, f(e)?, f(g)?]);
        }
        Ok(Joint { name: self.name.clone(), bodies: self.bodies, kind: self.kind, twists })
    }
}

/// The algebra se(3), in the basis of twists.
pub(super) fn rigid_motions<S: Scalar + Notation>() -> Result<LieAlgebra<S>, Error> {
    catalogue::algebra("se(3)")
}

fn unit_vectors<S: Field>() -> [[S; 3]; 3] {
    let entry = |i: usize, k: usize| if i == k { S::one() } else { S::zero() };
    std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
}

/// Checks that an axis is not zero.
fn nonzero<S: Field>(axis: &[S; 3]) -> Result<&[S; 3], Error> {
    match axis.iter().all(S::vanishes) || dot(axis, axis).vanishes() {
        true => Err(invalid("the axis has length zero".into())),
        false => Ok(axis),
    }
}

pub(super) fn invalid(reason: String) -> Error {
    Error::Invalid { what: "joint", reason }
}
