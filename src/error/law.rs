//! Laws whose violation is an error. The row of a law contains its witness, class, message and
//! advice.

use super::Error;
use std::fmt;

/// Defines the laws. A row is `Law(part: names, ...; residual) Class "message" "advice"`. The
/// message may use every name of the row.
macro_rules! laws {
    ($(
        $(#[$doc:meta])+
        $law:ident($($part:ident: $($name:ident)+),*; $residual:ident) $class:ident
        $message:literal $($advice:literal)?
    )+) => {
        /// A law that a construction requires. [`Error::Broken`] reports where the law fails.
        #[non_exhaustive]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Law {
            $($(#[$doc])+ $law,)+
        }

        impl Law {
            /// All laws.
            pub const ALL: &[Law] = &[$(Law::$law),+];

            /// The parts of the witness, such as a `pair` or a `triple`, each with the names of its
            /// entries. [`Error::Broken`] stores the entries in this order.
            pub fn parts(self) -> &'static [(&'static str, &'static [&'static str])] {
                match self {
                    $(Law::$law => &[$((stringify!($part), &[$(stringify!($name)),+])),*],)+
                }
            }

            /// The class of the error; see [`Error::class`].
            pub(super) fn class(self) -> &'static str {
                match self {
                    $(Law::$law => stringify!($class),)+
                }
            }

            /// Advice on what to change; see [`Error::advice`].
            pub(super) fn advice(self) -> Option<&'static str> {
                let advice: &[&str] = match self {
                    $(Law::$law => &[$($advice)?],)+
                };
                advice.first().copied()
            }

            /// Writes the message of the error.
            pub(super) fn write(
                &self,
                at: &[String],
                residual: &str,
                f: &mut fmt::Formatter<'_>,
            ) -> fmt::Result {
                let mut entries = at.iter().map(String::as_str);
                let mut next = || entries.next().unwrap_or_default();
                match self {
                    $(Law::$law => {
                        $($(let $name = next();)+)*
                        let $residual = residual;
                        write!(f, $message)
                    })+
                }
            }
        }
    };
}

laws! {
    /// The law `x - x = 0` for numbers. It fails for intervals.
    AdditiveInverse(value: x; residual) MathematicsError
        "the numbers are not a ring: {x} - {x} = {residual} instead of 0, as with intervals"
        "compute over exact numbers or floats, and bound the error of the result"
    /// The law `[x, y] + [y, x] = 0`.
    Antisymmetry(pair: x y; residual) AntisymmetryError
        "the bracket is not antisymmetric: [{x}, {y}] + [{y}, {x}] = {residual}"
        "change the brackets, so that [y,x] = -[x,y] and [x,x] = 0"
    /// The law `[x, y] + [y, x] = 0`, for a bracket that is given in both orders.
    OppositeOrders(pair: x y, values: forward backward; residual) AntisymmetryError
        "the bracket is not antisymmetric: [{x}, {y}] + [{y}, {x}] = {residual}, \
         for [{x}, {y}] = {forward} and [{y}, {x}] = {backward}"
        "change the brackets, so that [y,x] = -[x,y] and [x,x] = 0"
    /// Each structure constant is given only once. The residual is its second value.
    GivenOnce(pair: x y, component: component, value: first; second) MathematicsError
        "the component of [{x}, {y}] along {component} is given twice: {first} and {second}"
    /// The law `[[x, y], z] + [[y, z], x] + [[z, x], y] = 0`.
    Jacobi(triple: x y z; residual) JacobiError
        "the Jacobi identity fails: [[{x},{y}],{z}] + [[{y},{z}],{x}] + [[{z},{x}],{y}] = {residual}"
        "correct the brackets of these three basis vectors"
    /// Structure constants become rational if basis vectors are divided by square roots. The
    /// residual is a constant that cannot become rational.
    RationalConstants(pair: x y, component: component; value) MathematicsError
        "no division of basis vectors by square roots makes all structure constants rational: \
         the component of [{x}, {y}] along {component} is {value}"
        "give another basis, or a parameter instead of the number: structure theory computes over the rational numbers"
    /// The span of the matrices is closed under the commutator. The residual is an entry of the
    /// remainder.
    Closure(pair: x y; residual) ClosureError
        "the matrices do not close: [{x}, {y}] is not in their real span, with the remainder {residual}"
        "add the missing matrices to the basis"
    /// A subspace contains the bracket of any two of its vectors.
    Subalgebra(pair: x y; bracket) ConstructionError
        "the subspace is not a subalgebra: [{x}, {y}] = {bracket} is not in it"
        "add the bracket to the vectors, or take the subalgebra that they generate"
    /// A subspace contains the bracket of its vectors `v` with any basis vector `x`.
    Ideal(pair: x v; bracket) ConstructionError
        "the subspace is not an ideal: [{x}, {v}] = {bracket} is not in it"
        "add the bracket to the vectors"
    /// The law `omega([x, y], z) + omega([y, z], x) + omega([z, x], y) = 0`. The residual is this
    /// sum, up to its sign.
    Cocycle(triple: x y z; residual) ConstructionError
        "the form is not a cocycle: \
         omega([{x},{y}],{z}) + omega([{y},{z}],{x}) + omega([{z},{x}],{y}) = {residual}"
        "change the values of the form on these vectors"
    /// The law `x y - y x = 0` for a product of vectors.
    Commutative(pair: x y; residual) ConstructionError
        "the products do not commute: {x} {y} - {y} {x} = {residual}"
        "change the products: they must be commutative and associative"
    /// The law `(x y) z - x (y z) = 0` for a product of vectors.
    Associative(triple: x y z; residual) ConstructionError
        "the products are not associative: ({x} {y}) {z} - {x} ({y} {z}) = {residual}"
        "change the products: they must be commutative and associative"
    /// The law `D [x, y] - [D x, y] - [x, D y] = 0` for the matrix `D` by which the vector `d`
    /// acts.
    Derivation(derivation: d, pair: x y; residual) ConstructionError
        "the matrix D of {d} is not a derivation: D [{x},{y}] - [D {x},{y}] - [{x},D {y}] = {residual}"
    /// The law `(D_x D_y - D_y D_x - D_[x,y]) v = 0` for the matrices by which an algebra acts.
    Action(pair: x y, vector: v; residual) ConstructionError
        "the matrices are not an action: (D_{x} D_{y} - D_{y} D_{x} - D_[{x},{y}]) {v} = {residual}"
    /// A subspace of a module contains the images of its vectors `v` under any basis vector `x` of
    /// the algebra.
    Submodule(pair: x v; image) ConstructionError
        "the subspace is not a submodule: {x} {v} = {image} is not in it"
        "add the image to the vectors"
    /// The structure constants of a contraction have a limit. The residual is a constant without a
    /// limit.
    Limit(pair: x y, component: component; value) ConstructionError
        "the contraction has no limit: the component {value} of [{x}, {y}] along {component} grows \
         beyond all bounds"
    /// Matrices are linearly independent over the reals.
    Independent(relation: relation; zero) DependentError
        "the matrices are linearly dependent over the reals: {relation} = {zero}"
        "leave a matrix out, so that the others are independent"
    /// Vector fields are linearly independent at some point.
    IndependentFields(relation: relation; zero) DependentError
        "the frame is degenerate: its determinant is zero, for {relation} = {zero}"
    /// The law `g(x, y) - g(y, x) = 0` for a metric.
    SymmetricMetric(pair: x y; residual) MetricError
        "the metric is not symmetric: g({x},{y}) - g({y},{x}) = {residual}"
        "write the same value in both entries"
    /// A value, such as a structure function, is constant, because an operation requires this. The
    /// residual is the value.
    Constant(operation: what, component: component; value) MathematicsError
        "{what} needs constants, but here {component} = {value}"
    /// The law `L_direction Lambda = 0` for a connection. It is required for constant components in
    /// the right-invariant frame.
    AdInvariance(direction: direction, indices: i j k; residual) MathematicsError
        "the connection has no constant components in the right-invariant frame: \
         (L_{direction} Lambda)^{i}_{j}{k} = {residual}, not 0 (it is not invariant under ad)"
    /// The isotropy algebra `h` of a reductive pair contains the bracket of any two of its vectors.
    ReductiveIsotropy(pair: x y; bracket) MathematicsError
        "the vectors of h do not span a subalgebra: [{x}, {y}] = {bracket} is not in their span"
    /// The complement `m` of a reductive pair contains the bracket of its vectors `y` with any
    /// vector `x` of `h`.
    ReductiveComplement(pair: x y; bracket) MathematicsError
        "the complement m is not invariant under h: [{x}, {y}] = {bracket} is not in m"
    /// A subalgebra `h` has a complement that contains the brackets of its vectors with `h`. The
    /// complement is the kernel of a projection `P` onto `h` with `P([x,y]) = [x, P(y)]`.
    Reductive(pair: x y; residual) MathematicsError
        "no complement of h is invariant under h: for a projection P onto h, \
         P([x,y]) = [x, P(y)] with x = {x}, y = {y} leaves {residual} = 0"
    /// A tensor at the origin of a homogeneous space is invariant under the isotropy group.
    IsotropyInvariance(tensor: tensor, direction: direction, component: component; residual) MathematicsError
        "{tensor} must be invariant under h, but the action of {direction} gives the component \
         {component} = {residual}"
    /// A polynomial in the velocity is constant along the curves of a chart. The residual is the
    /// coefficient of a monomial in its derivative.
    Conserved(quantity: name, monomial: monomial; coefficient) MathematicsError
        "{name} is not conserved: its derivative along a curve has the term ({coefficient})*{monomial}"
    /// The Killing form is not degenerate on a subalgebra `h`.
    KillingOnSubalgebra(null: null; _zero) MathematicsError
        "the Killing form is degenerate on h: {null} is orthogonal to h"
    /// The law `nabla_n n = 0`. The autoparallel in the direction `n` then has a constant tangent
    /// vector.
    ConstantTangent(direction: n; residual) MathematicsError
        "{n} is not the constant tangent of an autoparallel: \
         nabla_n n = {residual} in the left-invariant frame"
    /// The adjoint representation is faithful, which means that no vector is central.
    FaithfulAdjoint(central: central; zero) MathematicsError
        "the algebra has a centre: {central} commutes with all vectors, so ad maps it to {zero}"
    /// The algebra is nilpotent. The residual is a component that should vanish.
    Nilpotent(; component) MathematicsError
        "the algebra is not nilpotent: {component} is not zero"
    /// Canonical coordinates are regular at a point, which means that the invariant forms are
    /// linearly independent.
    RegularPoint(vector: vector; _zero) MathematicsError
        "the coordinates are singular at this point: the invariant forms vanish on {vector}"
    /// The exponential map is locally invertible at `x`.
    RegularTangent(vector: x; _zero) MathematicsError
        "the tangent operator of exp is singular at {x}: ad_x has an eigenvalue 2 pi i k, k != 0"
    /// The eigenvalues of `ad_x` are small integers `a + ib`. The residual is the minimal
    /// polynomial, in `z`.
    Eigenvalues(vector: x; polynomial) MathematicsError
        "ad_{x} has an eigenvalue that is not a + ib with small integers a and b: a root of {polynomial}"
}

impl Law {
    /// The error that reports a violation of the law at these vectors.
    ///
    /// ```
    /// use affinor::Law;
    /// let error = Law::Ideal.broken(["x".to_string(), "v".to_string()], "z");
    /// assert_eq!(error.to_string(), "the subspace is not an ideal: [x, v] = z is not in it");
    /// assert_eq!(error.advice(), Some("add the bracket to the vectors"));
    /// assert_eq!(error.class(), "ConstructionError");
    /// ```
    pub fn broken(self, at: impl Into<Vec<String>>, residual: impl Into<String>) -> Error {
        Error::Broken { law: self, at: at.into(), residual: residual.into() }
    }
}
