//! Equations of motion of vectors and covectors along a curve, derived from a connection.
//!
//! All equations are quadratic: the time derivative of a vector is bilinear in the vector and the
//! velocity. The coefficients are constants in an invariant frame, and functions of the position in
//! a moving frame.

use crate::Error;
use crate::algebra::frame::{expect_slots, formula};
use crate::algebra::to_matrix;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

/// The kind of equations of motion.
#[doc(alias("geodesic equation", "Euler-Poincare", "Euler-Arnold"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EquationKind {
    /// The equations `DH/Dt = M` (104) for the covector `H = g(Omega, .)`. For the connection
    /// `plus`, these are the Euler-Poincare equations (106), (108) of a left-invariant system.
    EulerPoincare,
    /// The equations `nabla_v v = 0` (B6), in components (B7), of the velocity of an autoparallel.
    Autoparallel,
    /// The equations `nabla_w u = 0` (B4), in components (B5), of a vector that is
    /// parallel-transported along a curve of velocity `w`.
    Transport,
}

impl EquationKind {
    /// All kinds.
    pub const ALL: [EquationKind; 3] =
        [EquationKind::EulerPoincare, EquationKind::Autoparallel, EquationKind::Transport];

    /// The name of the kind in options and JSON.
    pub fn name(self) -> &'static str {
        match self {
            EquationKind::EulerPoincare => "euler-poincare",
            EquationKind::Autoparallel => "autoparallel",
            EquationKind::Transport => "transport",
        }
    }

    /// The kind with this name; `None` if no kind has the name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The law of the equations, without and with components, in the notation of the paper:
    /// equations (104), (B7) and (B5).
    pub fn statement(self) -> [&'static str; 2] {
        match self {
            EquationKind::EulerPoincare => [
                "DH/Dt = M",
                "g_ij dOmega^j/dt = Lambda^j_ki Omega^k H_j + M_i, H_j = g_jm Omega^m",
            ],
            EquationKind::Autoparallel => ["nabla_v v = 0", "dv^i/dt = -Lambda^i_jk v^j v^k"],
            EquationKind::Transport => ["nabla_w u = 0", "du^i/dt = -Lambda^i_jk w^j u^k"],
        }
    }
}

/// The equations `a_ij dx^j/dt = q_ijk y^j x^k + M_i`. Only [`EquationKind::EulerPoincare`] has the
/// external covector `M`. For [`EquationKind::Transport`], `y` is the velocity `w` of the curve;
/// for the other kinds, `y` is `x`.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::geometry::equations::Equations;
/// use affinor::{CanonicalConnection, Connection, Metric, Rational};
/// let so3 = catalogue::algebra("so(3)")?;
/// let inertia = Metric::diagonal([1, 2, 3].map(Rational::from))?;
/// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
/// let euler = Equations::euler_poincare(&plus, &inertia)?;
/// // Euler's equations: J1 dOmega1/dt = (J2 - J3) Omega2 Omega3
/// let [omega, free] = [[0, 1, 1].map(Rational::from), [0, 0, 0].map(Rational::from)];
/// assert_eq!(euler.rate(&omega, &free)?, [-1, 0, 0].map(Rational::from));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Equations<S> {
    kind: EquationKind,
    left: Tensor<S>,
    inverse: Tensor<S>,
    quadratic: Tensor<S>,
    force: Option<Tensor<S>>,
}

impl<S: Field + Scalar> Equations<S> {
    /// The equations of this kind.
    ///
    /// # Errors
    /// [`Error::NoMetric`] for Euler-Poincare without a metric; the errors of
    /// [`euler_poincare`](Self::euler_poincare).
    pub fn new(
        kind: EquationKind,
        connection: &Connection<S>,
        metric: Option<&Metric<S>>,
    ) -> Result<Self, Error> {
        match kind {
            EquationKind::EulerPoincare => {
                Self::euler_poincare(connection, metric.ok_or(Error::NoMetric)?)
            }
            EquationKind::Autoparallel | EquationKind::Transport => {
                Ok(Self::parallel(kind, connection))
            }
        }
    }

    /// The equations `DH/Dt = M` (104). In components, they are
    /// `g_ij dOmega^j/dt = Lambda^j_ki Omega^k g_jm Omega^m + M_i` (106).
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Unsupported`] for a metric whose
    /// components are not constant.
    pub fn euler_poincare(connection: &Connection<S>, metric: &Metric<S>) -> Result<Self, Error> {
        let n = connection.frame().dimension();
        expect_slots("the metric", metric.components(), n, &[Down, Down])?;
        if !connection.frame().derivative(metric.components())?.is_empty() {
            return Err(Error::Unsupported(
                "Euler-Poincare equations need a metric with constant components".into(),
            ));
        }
        Ok(Equations {
            kind: EquationKind::EulerPoincare,
            left: metric.components().clone(),
            inverse: metric.inverse().clone(),
            quadratic: inertial(connection, metric),
            force: Some(Tensor::identity(n).permute(&[1, 0])?),
        })
    }

    /// The equations `nabla_w u = 0` or `nabla_v v = 0`: `dx^i/dt = -Lambda^i_jk y^j x^k`.
    fn parallel(kind: EquationKind, connection: &Connection<S>) -> Self {
        let identity = Tensor::identity(connection.frame().dimension());
        Equations {
            kind,
            left: identity.clone(),
            inverse: identity,
            quadratic: formula("-1 L^i_jk -> ^i_jk", &[("L", connection.affinities())]),
            force: None,
        }
    }

    /// The same equations, solved for the time derivatives: `dx^i/dt = h^il (q_ljk y^j x^k + M_l)`.
    #[must_use]
    pub fn solved(&self) -> Self {
        let _stage = stage("solution for the derivatives");
        // returns equations that are already solved for the time derivatives; they have an upper
        // index
        if self.force.is_none() || self.quadratic.slots()[0] == Up {
            return self.clone();
        }
        let operands = [("h", &self.inverse), ("q", &self.quadratic)];
        let identity = Tensor::identity(self.dimension());
        Equations {
            kind: self.kind,
            left: identity.clone(),
            quadratic: formula("h^il q_ljk -> ^i_jk", &operands),
            force: Some(self.inverse.clone()),
            inverse: identity,
        }
    }

    /// Whether these equations and the equations of another connection with the same metric have
    /// the same solutions. This holds if the symmetric parts of the quadratic terms are equal up to
    /// the tolerance of floats: `q_ijk + q_ikj = p_ijk + p_ikj`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::geometry::equations::Equations;
    /// use affinor::{CanonicalConnection, Connection, Metric};
    /// let so3 = catalogue::algebra("so(3)")?;
    /// let inertia = Metric::diagonal([0.1, 0.2, 0.3])?;
    /// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    /// let levi_civita = Connection::levi_civita(so3.left_frame(), &inertia)?;
    /// let [euler, geodesics] =
    ///     [plus, levi_civita].map(|connection| Equations::euler_poincare(&connection, &inertia));
    /// assert!(geodesics?.agree_with(&euler?)?);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] for equations of another kind or dimension, or if only one of the systems
    /// is solved for the time derivatives.
    pub fn agree_with(&self, other: &Self) -> Result<bool, Error> {
        let slots = self.quadratic.slots();
        expect_slots("the quadratic terms", &other.quadratic, self.dimension(), slots)?;
        let first = if slots[0] == Up { "^i" } else { "_i" };
        let text = format!("q{first}_jk + q{first}_kj - p{first}_jk - p{first}_kj -> {first}_jk");
        let operands = [("q", &self.quadratic), ("p", &other.quadratic)];
        Ok(formula(&text, &operands).is_empty())
    }

    /// The time derivatives `dx/dt`, computed by one elimination. The vector `other` is the
    /// external covector `M` (Euler-Poincare), the velocity `w` of the curve (transport), or empty
    /// (autoparallel).
    ///
    /// # Errors
    /// [`Error::Shape`] for vectors of another length; [`Error::Linear`] over a ring without
    /// pivots.
    pub fn rate(&self, state: &[S], other: &[S]) -> Result<Vec<S>, Error> {
        let n = self.dimension();
        let x = Tensor::vector(state, Up);
        expect_slots("the state", &x, n, &[Up])?;
        let expected = if self.kind == EquationKind::Autoparallel { 0 } else { n };
        if other.len() != expected {
            let [expected, found] = [expected, other.len()].map(|n| format!("{n} components"));
            return Err(Error::Shape {
                what: "the external covector or the velocity of the curve",
                expected,
                found,
            });
        }
        let y = if self.kind == EquationKind::Transport {
            Tensor::vector(other, Up)
        } else {
            x.clone()
        };
        let first = if self.quadratic.slots()[0] == Up { "^i" } else { "_i" };
        let quadratic = [("q", &self.quadratic), ("y", &y)];
        let moved = formula(&format!("q{first}_jk y^j -> {first}_k"), &quadratic);
        let operands = [("q", &moved), ("x", &x)];
        let moved = formula(&format!("q{first}_k x^k -> {first}"), &operands);
        let right = match &self.force {
            None => moved,
            Some(force) => {
                let given = Tensor::vector(other, Down);
                let text = format!("r{first} + f{first}^j m_j -> {first}");
                formula(&text, &[("r", &moved), ("f", force), ("m", &given)])
            }
        };
        let right = right.to_vector().unwrap_or_default();
        // the solution is unique, because the matrix is invertible
        Ok(to_matrix(&self.left).solve(&right)?.unwrap_or_default())
    }
}

/// The coefficients `q_ikm = Lambda^j_ki g_jm` of the quadratic part of equation (104). The
/// inertial forces are `q_ikm Omega^k Omega^m`.
pub(crate) fn inertial<S: Field + Scalar>(
    connection: &Connection<S>,
    metric: &Metric<S>,
) -> Tensor<S> {
    formula("L^j_ki g_jm -> _ikm", &[("L", connection.affinities()), ("g", metric.components())])
}

/// A variable of the equations: its role, and its index from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variable {
    /// The velocity `w` of the curve along which a vector is transported.
    Along(usize),
    /// The unknown `x`.
    State(usize),
    /// The external covector `M`.
    Force(usize),
}

/// One equation: the coefficients of the time derivatives, and of the products of variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<S> {
    /// The coefficient `a_j` of each time derivative `dx^j/dt`, with `j` from 0.
    pub left: Vec<(S, usize)>,
    /// The coefficient and the factors of each product. A square lists its variable twice.
    pub right: Vec<(S, Vec<Variable>)>,
}

impl<S: Scalar> Equations<S> {
    /// The kind of the equations.
    pub fn kind(&self) -> EquationKind {
        self.kind
    }

    /// The number of equations.
    pub fn dimension(&self) -> usize {
        self.left.dimension()
    }

    /// The inverse of the matrix that multiplies the time derivatives.
    pub fn inverse(&self) -> &Tensor<S> {
        &self.inverse
    }

    /// The equations, one row for each. Equal products are collected.
    pub fn rows(&self) -> Vec<Row<S>> {
        let n = self.dimension();
        let mut rows = vec![Row { left: vec![], right: vec![] }; n];
        for (at, value) in self.left.components() {
            rows[at[0]].left.push((value.clone(), at[1]));
        }
        let square = self.kind != EquationKind::Transport;
        let collected = if square { collect(&self.quadratic) } else { self.quadratic.clone() };
        for (at, value) in collected.components() {
            let first = if square { Variable::State(at[1]) } else { Variable::Along(at[1]) };
            rows[at[0]].right.push((value.clone(), vec![first, Variable::State(at[2])]));
        }
        for (at, value) in self.force.iter().flat_map(Tensor::components) {
            rows[at[0]].right.push((value.clone(), vec![Variable::Force(at[1])]));
        }
        rows
    }
}

/// The quadratic terms `q_ijk x^j x^k`, in which each product occurs once. The coefficients are
/// `q_ijk + q_ikj` for `j < k`, and `q_ijj` for squares.
fn collect<S: Scalar>(quadratic: &Tensor<S>) -> Tensor<S> {
    let first = if quadratic.slots()[0] == Up { "^i" } else { "_i" };
    let both = formula(&format!("q{first}_jk + q{first}_kj -> {first}_jk"), &[("q", quadratic)]);
    let products = both.filter_map(|at, value| (at[1] < at[2]).then(|| value.clone()));
    let squares = quadratic.filter_map(|at, value| (at[1] == at[2]).then(|| value.clone()));
    let text = format!("p{first}_jk + s{first}_jk -> {first}_jk");
    formula(&text, &[("p", &products), ("s", &squares)])
}
