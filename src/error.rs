//! Errors of the library, each with its witness.

use crate::algebra::catalogue::CatalogueError;
use affinor_tensors::TensorError;
use affinor_tensors::linear::LinearError;

/// An error of the library. It says what failed, where, and by how much.
///
/// Basis vectors appear by their labels, residuals as linear combinations of them.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// Tensors whose shapes do not fit, or scalars without an inverse that a formula needs.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// Linear equations over scalars that do not form a field.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// A name that does not denote one algebra of the catalogue.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// A search over more candidates than its limit.
    #[error("{size} {what} are too many to search: the limit is {limit}")]
    Size {
        /// The candidates, in the plural.
        what: &'static str,
        /// Their number.
        size: usize,
        /// The largest number allowed.
        limit: usize,
    },
    /// A tensor of the wrong dimension or with the wrong slots.
    #[error("{what} should have {expected}, not {found}")]
    Shape {
        /// The name of the object.
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
    /// A bracket given in both orders, with values that are not opposite.
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
    #[error("{what}: the component {} = {value} is no finite number", indices(.at))]
    NotFinite {
        /// The name of the object.
        what: &'static str,
        /// The indices of the component, from 1.
        at: Vec<usize>,
        /// The component.
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
        /// The value of the left side, which must vanish.
        residual: String,
    },
    /// Structure constants that square roots as divisors of the basis vectors do not make rational.
    #[error(
        "no division of basis vectors by square roots makes all structure constants rational: \
         the component of [{x}, {y}] along {component} is {value}"
    )]
    NoRationalBasis {
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// The basis vector of the component.
        component: String,
        /// The component that prevents it.
        value: String,
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
    /// A subspace that is no subalgebra.
    #[error("the subspace is no subalgebra: [{x}, {y}] = {bracket} is not in it")]
    NotSubalgebra {
        /// A vector of the subspace.
        x: String,
        /// The second vector.
        y: String,
        /// `[x, y]`, which is not in the subspace.
        bracket: String,
    },
    /// A subspace that is no ideal.
    #[error("the subspace is no ideal: [{x}, {v}] = {bracket} is not in it")]
    NotIdeal {
        /// A basis vector of the algebra.
        x: String,
        /// A vector of the subspace.
        v: String,
        /// Their bracket.
        bracket: String,
    },
    /// A form that is no cocycle.
    #[error(
        "the form is no cocycle: \
         omega([{x},{y}],{z}) + omega([{y},{z}],{x}) + omega([{z},{x}],{y}) = {residual}"
    )]
    NotCocycle {
        /// The first basis vector of the triple.
        x: String,
        /// The second basis vector.
        y: String,
        /// The third basis vector.
        z: String,
        /// The value of the left side, which must vanish, up to sign.
        residual: String,
    },
    /// A product of vectors that is not commutative.
    #[error("the products do not commute: {x} {y} - {y} {x} = {residual}")]
    NotCommutative {
        /// The first vector.
        x: String,
        /// The second vector.
        y: String,
        /// The value of the left side, which must vanish.
        residual: String,
    },
    /// A product of vectors that is not associative.
    #[error("the products are not associative: ({x} {y}) {z} - {x} ({y} {z}) = {residual}")]
    NotAssociative {
        /// The first vector.
        x: String,
        /// The second vector.
        y: String,
        /// The third vector.
        z: String,
        /// The value of the left side, which must vanish.
        residual: String,
    },
    /// A matrix that is no derivation.
    #[error(
        "the matrix D of {d} is no derivation: D [{x},{y}] - [D {x},{y}] - [{x},D {y}] = {residual}"
    )]
    NotDerivation {
        /// The vector that acts.
        d: String,
        /// The first basis vector.
        x: String,
        /// The second basis vector.
        y: String,
        /// The value of the left side, which must vanish.
        residual: String,
    },
    /// Matrices that are no action of a Lie algebra.
    #[error(
        "the matrices are no action: (D_{x} D_{y} - D_{y} D_{x} - D_[{x},{y}]) {v} = {residual}"
    )]
    NotAction {
        /// The first vector that acts.
        x: String,
        /// The second one.
        y: String,
        /// The vector on which they act.
        v: String,
        /// The value of the left side, which must vanish.
        residual: String,
    },
    /// A contraction whose limit does not exist.
    #[error(
        "the contraction has no limit: the component {value} of [{x}, {y}] along {component} grows \
         beyond all bounds"
    )]
    NoLimit {
        /// The first basis vector.
        x: String,
        /// The second one.
        y: String,
        /// The basis vector of the component.
        component: String,
        /// The component.
        value: String,
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
    /// A degenerate bilinear form.
    #[error("the metric is degenerate: {null} is orthogonal to every vector")]
    Degenerate {
        /// A vector of the kernel.
        null: String,
        /// Its nonzero components, each with the number of its basis vector, from 1.
        components: Vec<(usize, String)>,
    },
    /// A tensor that lacks a required symmetry.
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
        /// The component minus (for antisymmetry: plus) the one with the two indices exchanged.
        residual: String,
    },
    /// A Levi-Civita connection was asked for without a metric.
    #[error("levi-civita is the connection of a metric, and none is given")]
    NoMetric,
    /// A change of basis whose matrix is singular.
    #[error("the new basis is linearly dependent")]
    SingularBasis,
    /// Vector fields that are linearly dependent everywhere.
    #[error("the frame is degenerate: its determinant is zero, for {relation} = 0")]
    DegenerateFrame {
        /// A vanishing combination of the fields.
        relation: String,
    },
    /// A name that cannot serve as a coordinate: not an identifier, or used twice.
    #[error("`{name}` is not the name of one coordinate")]
    Coordinate {
        /// The name.
        name: String,
    },
    /// A value that must be constant, such as a structure constant, and is not.
    #[error("{what} needs constants, but here {component} = {value}")]
    NotConstant {
        /// The operation that needs constants.
        what: &'static str,
        /// The symbol of the value.
        component: String,
        /// The value.
        value: String,
    },
    /// A point at which the coordinates are singular.
    #[error("the coordinates are singular at this point: the invariant forms vanish on {vector}")]
    SingularPoint {
        /// A tangent vector on which all invariant forms vanish.
        vector: String,
    },
    /// A matrix exponential without a closed form in the functions known here.
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
    /// Bases of `h` and `m` of which `h` is no subalgebra, or `m` is not invariant under it.
    #[error("{law}: [{x}, {y}] = {bracket} is not in {span}")]
    NotReductive {
        /// The law that fails.
        law: &'static str,
        /// The span that the bracket leaves.
        span: &'static str,
        /// A vector of `h`.
        x: String,
        /// A vector of `h` or `m`.
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
    /// A tensor at the origin of a homogeneous space that is not invariant under the isotropy group.
    #[error(
        "{what} must be invariant under h, but the action of {direction} gives the component \
         {} = {residual}", indices(.at)
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
    /// A direction in which no autoparallel has a constant tangent vector.
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
    /// An algebra that is not nilpotent.
    #[error("the algebra is not nilpotent: {component} is not zero")]
    NotNilpotent {
        /// A component that should vanish.
        component: String,
    },
    /// A name that stands for no group.
    #[error("no group named `{name}`: {reason}")]
    NoGroup {
        /// The name.
        name: String,
        /// Why there is none.
        reason: String,
    },
    /// Elements whose mean is not found.
    #[error("no mean: after {steps} iterations the mean logarithm still has the size {residual:e}")]
    NoMean {
        /// The number of iterations.
        steps: usize,
        /// The largest component of the mean logarithm.
        residual: f64,
    },
    /// A value that does not exist or is not admissible: `no inertia: the mass is -1`.
    #[error("no {what}: {reason}")]
    Invalid {
        /// The object: `basis`, `element of the group`, `logarithm`, `rotation`, `inertia`, `state`, `solid`
        /// or coordinates.
        what: &'static str,
        /// Why, with the witness.
        reason: String,
    },
    /// A vector at which the exponential map is not locally invertible.
    #[error(
        "the tangent operator of exp is singular at {x:?}: ad_x has an eigenvalue 2 pi i k, k != 0"
    )]
    SingularTangent {
        /// The components of the vector.
        x: Vec<f64>,
    },
    /// An integration that failed before its end.
    #[error("the integration stops at t = {t}: {reason}")]
    Integration {
        /// The time that was reached.
        t: f64,
        /// Why.
        reason: String,
    },
    /// A column that the trajectory does not have.
    #[error("the run has no column {name}")]
    NoColumn {
        /// Its name.
        name: String,
    },
    /// An integrator that does not apply to the problem.
    #[error("the method {method} does not serve here: {reason}")]
    NoMethod {
        /// Its name.
        method: &'static str,
        /// Why.
        reason: String,
    },
    /// A value that left the range of `f64`.
    #[error("{component} = {value}: the computation left the range of f64")]
    Overflow {
        /// The component.
        component: String,
        /// The value.
        value: String,
    },
    /// An operation that is not defined in this frame.
    #[error("{0}")]
    Frame(&'static str),
}

/// Indices as they are listed: `1,2,3`.
fn indices(at: &[usize]) -> String {
    at.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
}
