//! What the mathematics refuses, each with its witness.

use affinor_tensors::TensorError;
use affinor_tensors::linear::LinearError;

/// An error of the geometry: what failed, where, and by how much.
///
/// Basis vectors are named by their labels, residuals written as linear combinations of them.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// Shapes that do not fit together.
    #[error("{0}")]
    Tensor(#[from] TensorError),
    /// Linear equations over scalars that are no field.
    #[error("{0}")]
    Linear(#[from] LinearError),
    /// A search that is too large.
    #[error("{size} {what} are too many to search: the limit is {limit}")]
    Size {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        size: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A tensor of the wrong dimension or with the wrong slots.
    #[error("{what} should have {expected}, not {found}")]
    Shape {
        /// The object.
        what: &'static str,
        /// The shape it needs.
        expected: String,
        /// The shape it has.
        found: String,
    },
    /// A bracket that is not antisymmetric.
    #[error("the bracket is not antisymmetric: [{x}, {y}] + [{y}, {x}] = {residual}")]
    NotAntisymmetric {
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// `[x,y] + [y,x]`.
        residual: String,
    },
    /// A pair that is given in both orders, with values that are not opposite.
    #[error(
        "the bracket is not antisymmetric: [{x}, {y}] + [{y}, {x}] = {residual}, \
         for [{x}, {y}] = {} and [{y}, {x}] = {}",
        .values[0], .values[1]
    )]
    OrdersDisagree {
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// `[x,y]` and `[y,x]` as given.
        values: Box<[String; 2]>,
        /// `[x,y] + [y,x]`.
        residual: String,
    },
    /// A structure constant that is given twice.
    #[error(
        "the component of [{x}, {y}] along {component} is given twice: {} and {}",
        .values[0], .values[1]
    )]
    GivenTwice {
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// The basis vector of the component.
        component: String,
        /// Both values as given.
        values: Box<[String; 2]>,
    },
    /// A component that is infinite or not a number.
    #[error("{what} has the component {} = {value}, which is no number", indices(.at))]
    NotFinite {
        /// The object.
        what: &'static str,
        /// The indices of the component, from 1.
        at: Vec<usize>,
        /// What stands there.
        value: String,
    },
    /// A bracket that violates the Jacobi identity.
    #[error(
        "the Jacobi identity fails: \
         [[{x},{y}],{z}] + [[{y},{z}],{x}] + [[{z},{x}],{y}] = {residual}"
    )]
    Jacobi {
        /// The first basis vector of the triple.
        x: String,
        /// The second basis vector.
        y: String,
        /// The third basis vector.
        z: String,
        /// The left side.
        residual: String,
    },
    /// Matrices whose span is not closed under the commutator.
    #[error("the matrices do not close: [{x}, {y}] leaves their real span, by {residual}")]
    NotClosed {
        /// The first matrix.
        x: String,
        /// The second matrix.
        y: String,
        /// An entry of the remainder.
        residual: String,
    },
    /// Matrices that are linearly dependent over the reals.
    #[error("the matrices are linearly dependent over the reals: {relation} = 0")]
    Dependent {
        /// A vanishing linear combination.
        relation: String,
    },
    /// A metric that is not symmetric.
    #[error("the metric is not symmetric: g({x},{y}) - g({y},{x}) = {residual}")]
    NotSymmetric {
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// The difference.
        residual: String,
    },
    /// A bilinear form with a null vector.
    #[error("the metric is degenerate: {null} is orthogonal to every vector")]
    Degenerate {
        /// A vector of the kernel.
        null: String,
    },
    /// A tensor without a symmetry that it needs.
    #[error(
        "{what} is not {law} in the slots {} and {}: component {} is off by {residual}",
        .slots[0], .slots[1], indices(.at)
    )]
    Symmetry {
        /// The tensor.
        what: &'static str,
        /// `symmetric` or `antisymmetric`.
        law: &'static str,
        /// The two slots, from 1.
        slots: [usize; 2],
        /// The indices of a component, from 1.
        at: Vec<usize>,
        /// The component less (or plus) the one with the two indices exchanged.
        residual: String,
    },
    /// A Levi-Civita connection without a metric to belong to.
    #[error("levi-civita is the connection of a metric, and none is given")]
    NoMetric,
    /// A change of basis that cannot be inverted.
    #[error("the new basis is linearly dependent")]
    SingularBasis,
    /// Fields that are linearly dependent everywhere.
    #[error("the frame is degenerate: its determinant is zero, for {relation} = 0")]
    DegenerateFrame {
        /// A vanishing combination of the fields.
        relation: String,
    },
    /// A coordinate that is no name, or the name of two.
    #[error("`{name}` is not the name of one coordinate")]
    Coordinate {
        /// The name.
        name: String,
    },
    /// A function on a chart where a constant is needed, such as a structure constant.
    #[error("{what} needs constants, but here {component} = {value}")]
    NotConstant {
        /// What needs it.
        what: &'static str,
        /// What is not constant.
        component: String,
        /// Its value.
        value: String,
    },
    /// A point at which coordinates are singular.
    #[error("the coordinates are singular at this point: the invariant forms vanish on {vector}")]
    SingularPoint {
        /// A vector that the forms take to zero.
        vector: String,
    },
    /// An exponential that is not made of functions known here.
    #[error("ad_{x} has an eigenvalue other than small integers a + ib: a root of {polynomial}")]
    Eigenvalue {
        /// The vector.
        x: String,
        /// The minimal polynomial, in `z`.
        polynomial: String,
    },
    /// A connection without constant components in the right-invariant frame.
    #[error(
        "the connection has no constant components in the right-invariant frame: \
         (L_{direction} Lambda)^{i}_{j}{k} = {residual}, not 0 (it is not invariant under ad)"
    )]
    NotInvariant {
        /// The generator that moves the connection.
        direction: String,
        /// Upper index, from 1.
        i: usize,
        /// First lower index, from 1.
        j: usize,
        /// Second lower index, from 1.
        k: usize,
        /// The component.
        residual: String,
    },
    /// Vectors whose span is not closed under the bracket.
    #[error("the vectors of h span no subalgebra: [{x}, {y}] = {bracket} is not in their span")]
    NotSubalgebra {
        /// A vector of the basis.
        x: String,
        /// Another one.
        y: String,
        /// Their bracket.
        bracket: String,
    },
    /// A complement that the subalgebra does not keep.
    #[error("the complement m is not invariant under h: [{x}, {y}] = {bracket} is not in m")]
    NotReductive {
        /// A vector of the subalgebra.
        x: String,
        /// A vector of the complement.
        y: String,
        /// Their bracket.
        bracket: String,
    },
    /// A subalgebra without an orthogonal complement.
    #[error("the Killing form is degenerate on h: {null} is orthogonal to all of it")]
    DegenerateOnSubalgebra {
        /// A vector of `h`.
        null: String,
    },
    /// A tensor at the origin of a homogeneous space that belongs to no invariant field.
    #[error(
        "h does not leave {what} alone: \
         moved by {direction}, component {} is {residual}, not 0", indices(.at)
    )]
    NotIsotropic {
        /// The tensor.
        what: &'static str,
        /// The vector of `h` that moves it.
        direction: String,
        /// The indices of a component, from 1.
        at: Vec<usize>,
        /// The component.
        residual: String,
    },
    /// A direction along which the frame components of the tangent are not constant.
    #[error(
        "{n} is not the constant tangent of an autoparallel: \
         nabla_n n = {residual} in the left-invariant frame"
    )]
    NotAutoparallel {
        /// The direction.
        n: String,
        /// `Lambda^i_jk n^j n^k e_i`.
        residual: String,
    },
    /// An adjoint representation that is not faithful.
    #[error("the algebra has a centre: {central} commutes with everything, and ad takes it to 0")]
    Centre {
        /// A vector of the centre.
        central: String,
    },
    /// An algebra whose lower central series does not end at 0.
    #[error("the algebra is not nilpotent: {component} is not zero")]
    NotNilpotent {
        /// A component that should vanish.
        component: String,
    },
    /// A matrix that is no element of the group.
    #[error("no element of the group: {reason}")]
    NotInGroup {
        /// What is wrong with it, with its witness.
        reason: String,
    },
    /// A group element without a logarithm in the algebra.
    #[error("no logarithm: {reason}")]
    NoLogarithm {
        /// What stands against one, with its witness.
        reason: String,
    },
    /// Numbers that belong to no rotation.
    #[error("no rotation: {reason}")]
    NoRotation {
        /// What is wrong with them, with its witness.
        reason: String,
    },
    /// A matrix that is no inertia of a rigid body.
    #[error("no inertia: {reason}")]
    NoInertia {
        /// What is wrong with it, with its witness.
        reason: String,
    },
    /// Values that no state of a system has.
    #[error("no state: {reason}")]
    NoState {
        /// What is wrong with them, with its witness.
        reason: String,
    },
    /// A surface that bounds no solid.
    #[error("no solid: {reason}")]
    NoSolid {
        /// What is wrong with it, with its witness.
        reason: String,
    },
    /// A point that coordinates do not reach.
    #[error("no {what}: {reason}")]
    NoCoordinates {
        /// The coordinates.
        what: &'static str,
        /// Why they fail there.
        reason: String,
    },
    /// A vector at which the exponential is no local chart.
    #[error(
        "the tangent operator of exp is singular at {x:?}: ad_x has an eigenvalue 2 pi i k, k != 0"
    )]
    SingularTangent {
        /// The components of the vector.
        x: Vec<f64>,
    },
    /// A differential equation that cannot be solved further.
    #[error("the integration stops at t = {t}: {reason}")]
    Integration {
        /// The time that was reached.
        t: f64,
        /// Why.
        reason: String,
    },
    /// A column that a run does not have.
    #[error("the run has no column {name}")]
    NoColumn {
        /// Its name.
        name: String,
    },
    /// A method of integration that is not for a problem.
    #[error("the method {method} does not serve here: {reason}")]
    NoMethod {
        /// Its name.
        method: &'static str,
        /// Why.
        reason: String,
    },
    /// A saved state that cannot be written or read.
    #[error("the saved state is of no use: {reason}")]
    Snapshot {
        /// Why.
        reason: String,
    },
    /// A float that left its range.
    #[error("{component} = {value}: the computation left the range of f64")]
    Overflow {
        /// The component.
        component: String,
        /// What became of it.
        value: String,
    },
    /// An operation that this frame does not support.
    #[error("{0}")]
    Frame(&'static str),
}

/// Indices as they are listed: `1,2,3`.
fn indices(at: &[usize]) -> String {
    at.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
}

/// `coefficients` as a linear combination of `labels`, zeros left out.
pub(crate) fn combination<S: std::fmt::Display>(
    terms: impl IntoIterator<Item = (S, String)>,
) -> String {
    let mut text = String::new();
    for (coefficient, label) in terms {
        let value = written(&coefficient);
        let compound = is_sum(&value);
        let (sign, size) = match value.strip_prefix('-') {
            Some(size) if !compound => (" - ", size.to_string()),
            _ if compound => (" + ", format!("({value})")),
            _ => (" + ", value),
        };
        text.push_str(match (text.is_empty(), sign) {
            (true, " - ") => "-",
            (true, _) => "",
            (false, sign) => sign,
        });
        match size.as_str() {
            "1" => text.push_str(&label),
            size => text.push_str(&format!("{size}*{label}")),
        }
    }
    if text.is_empty() { "0".into() } else { text }
}

/// Whether a written value is a sum of several terms.
pub(crate) fn is_sum(value: &str) -> bool {
    let mut depth = 0i64;
    value.char_indices().any(|(at, c)| {
        depth += i64::from(c == '(') - i64::from(c == ')');
        at > 0 && depth == 0 && matches!(c, ' ' | '+')
    })
}

/// A value in plain text; a float far from 1 with an exponent, in place of its zeros.
pub(crate) fn written(value: &impl std::fmt::Display) -> String {
    let text = value.to_string();
    // a point stands in floats only
    match text.parse::<f64>() {
        Ok(x) if text.contains('.') && x != 0.0 && x.abs() < 1e-5 => format!("{x:e}"),
        _ => text,
    }
}
