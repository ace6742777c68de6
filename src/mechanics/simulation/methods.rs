//! The methods of integration, with one row of a table for each method.

use super::classes::free_body::{self, Body, FreeStart};
use super::group::SimulationGroup;
use super::stepper::Stepper;
use crate::Error;
use crate::group::{So3, TranslationSplit};
use crate::mechanics::integrators::kick::{self, FreeMotion};
use crate::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use crate::mechanics::integrators::{Magnus, Pair};
use crate::mechanics::systems::euler_poincare::Torque;
use crate::mechanics::{
    Adaptive, CommutatorFree, Composed, Constrained, Constraint, CotangentSystem, GeneralisedAlpha,
    Inertia, Isospectral, IsospectralMidpoint, Kick, MoserVeselov, MuntheKaas, Projected, SimoWong,
};
use std::fmt;

/// The class of problems that a method integrates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A rigid body on SO(3) without forces.
    FreeBody,
    /// A rigid body on SO(3) with forces that do not depend on the velocity.
    BodyInPotential,
    /// A rigid body on SO(3) with any forces.
    Body,
    /// Any equations of motion of a momentum on a group.
    AnySystem,
    /// The problems of [`Class::AnySystem`] on groups with a projection, if the equations are
    /// left-invariant.
    Projection,
    /// Systems with holonomic constraints.
    Constrained,
    /// Kinematic equations, whose velocity is a prescribed function of time.
    PrescribedVelocity,
    /// Isospectral flows of matrices.
    MatrixFlow,
    /// Curves on charts, and trees of bodies in joint coordinates.
    Chart,
    /// Trees of bodies in joint coordinates.
    Tree,
}

/// The way in which a method chooses its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// The method computes the state at any time.
    Exact,
    /// All steps have equal lengths.
    Fixed,
    /// A tolerance controls the lengths of steps.
    Controlled,
}

/// A row of the table of methods.
#[derive(Clone, Copy, Debug)]
struct Row {
    name: &'static str,
    /// The order of convergence; 0 for exact solutions.
    order: u32,
    class: Class,
    steps: Steps,
    why: &'static str,
}

/// The table of methods. A row contains the variant of [`Method`], its name in problem files, its
/// order, a description of the problems that it integrates, its [`Class`], its [`Steps`], and its
/// constructor.
macro_rules! methods {
    ($($Method:ident $name:literal $order:literal $why:literal $Class:ident $Steps:ident $make:expr;)+) => {
        /// A method of integration.
        #[doc(alias("integrator", "integration method"))]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Method {
            $(#[doc = concat!("`", $name, "`: ", $why, ".")] $Method,)+
        }

        static TABLE: &[Row] = &[$(Row {
            name: $name,
            order: $order,
            class: Class::$Class,
            steps: Steps::$Steps,
            why: $why,
        }),+];

        impl Method {
            /// All methods.
            pub const ALL: &'static [Method] = &[$(Method::$Method),+];

            /// The integrator for systems with any group and any forces. Returns `None` unless the
            /// method belongs to this class.
            pub(super) fn any_system<S: CotangentSystem<Group: SimulationGroup> + 'static>(
                self,
                step: f64,
                control: Adaptive,
            ) -> Option<Stepper<S>> {
                match self {
                    $(Method::$Method => construct!(any_system $Class $Steps ($make) step control),)+
                }
            }

            /// The integrator for a body. Returns `None` unless the method belongs to one of the
            /// classes for bodies.
            pub(super) fn body(self, start: &FreeStart, step: f64) -> Option<Result<Stepper<Body<So3>>, Error>> {
                match self {
                    $(Method::$Method => construct!(body $Class $Steps ($make) start step),)+
                }
            }

            /// The integrator for a system with constraints. Returns `None` unless the method
            /// belongs to this class.
            pub(super) fn constrained<G: TranslationSplit + 'static, C: Constraint<G> + 'static, M: Torque<G> + 'static>(
                self,
                step: f64,
            ) -> Option<Stepper<Constrained<G, C, M>>> {
                match self {
                    $(Method::$Method => construct!(constrained $Class ($make) step),)+
                }
            }

            /// The Magnus method for a prescribed velocity. Returns `None` unless the method
            /// belongs to this class.
            pub(super) fn magnus(self) -> Option<Magnus> {
                match self {
                    $(Method::$Method => construct!(magnus $Class ($make)),)+
                }
            }

            /// The integrator for a flow of matrices. Returns `None` unless the method belongs to
            /// this class.
            pub(super) fn matrix_flow<F: Isospectral + 'static>(self, step: f64) -> Option<Stepper<F>> {
                match self {
                    $(Method::$Method => construct!(matrix_flow $Class ($make) step),)+
                }
            }
        }
    };
}

/// Calls the constructor of a row for one class of problems. The result is `None` for rows of other
/// classes.
macro_rules! construct {
    (any_system AnySystem Fixed ($make:expr) $step:ident $control:ident) => {
        Some(Stepper::fixed($make, $step))
    };
    (any_system AnySystem Controlled ($make:expr) $step:ident $control:ident) => {
        Some(Stepper::controlled($make, $control, |control| control))
    };
    (any_system Projection Fixed ($make:expr) $step:ident $control:ident) => {
        Some(Stepper::fixed($make, $step))
    };
    (any_system Projection Controlled ($make:expr) $step:ident $control:ident) => {
        Some(Stepper::controlled($make, $control, Adaptive::projected))
    };
    (body FreeBody Exact ($make:expr) $start:ident $step:ident) => {
        Some(($make)($start))
    };
    (body FreeBody Fixed ($make:expr) $start:ident $step:ident) => {
        Some(Ok(Stepper::fixed(($make)(&$start.inertia), $step)))
    };
    (body BodyInPotential Fixed ($make:expr) $start:ident $step:ident) => {
        Some(Ok(Stepper::fixed(($make)(&$start.inertia), $step)))
    };
    (body Body Fixed ($make:expr) $start:ident $step:ident) => {
        Some(Ok(Stepper::fixed(($make)(&$start.inertia), $step)))
    };
    (constrained Constrained ($make:expr) $step:ident) => {
        Some(Stepper::fixed($make, $step))
    };
    (magnus PrescribedVelocity ($make:expr)) => {
        Some($make)
    };
    (matrix_flow MatrixFlow ($make:expr) $step:ident) => {
        Some(Stepper::fixed($make, $step))
    };
    ($($other:tt)+) => {
        None
    };
}

methods! {
    // method        name                order     problems
    Exact            "exact"              0     "a free rigid body"
        FreeBody Exact free_body::exact;
    MuntheKaas54     "rkmk54"            5  "any motion on a group or a homogeneous space, to a tolerance"
        AnySystem Controlled Pair::Five;
    MuntheKaas853    "rkmk853"           8  "any motion on a group or a homogeneous space, to a tolerance"
        AnySystem Controlled Pair::Eight;
    MuntheKaas4      "rkmk4"             4  "any motion on a group or a homogeneous space, with a step"
        AnySystem Fixed MuntheKaas::RK4;
    Projected4       "projected4"        4  "a group with a projection and any forces, with a step"
        Projection Fixed Projected::RK4;
    Projected54      "projected54"       5  "a group with a projection and any forces, to a tolerance"
        Projection Controlled Pair::Five;
    Projected853     "projected853"      8  "a group with a projection and any forces, to a tolerance"
        Projection Controlled Pair::Eight;
    CommutatorFree4  "cf4"               4  "any motion on a group or a homogeneous space, with a step"
        AnySystem Fixed CommutatorFree;
    MoserVeselov10   "dmv10"             10  "a free rigid body, with a step"
        FreeBody Fixed |inertia: &Inertia| MoserVeselov::new(inertia, MoserVeselovOrder::Ten);
    SimoWong         "simo-wong"         2  "a rigid body, with a step"
        Body Fixed SimoWong::new;
    Kick4            "kick4"             4  "a body in a potential, with a step"
        BodyInPotential Fixed |inertia: &Inertia| {
            Kick::new(inertia, kick::KickOrder::Four, FreeMotion::MoserVeselov(MoserVeselovOrder::Ten))
        };
    GeneralisedAlpha "generalised-alpha" 2  "a system with constraints"
        Constrained Fixed GeneralisedAlpha::default();
    Magnus6          "magnus6"           6  "a prescribed velocity"
        PrescribedVelocity Fixed Magnus::Six;
    Isospectral2     "isospectral2"      2  "an isospectral flow of matrices"
        MatrixFlow Fixed IsospectralMidpoint;
    Isospectral4     "isospectral4"      4  "an isospectral flow of matrices"
        MatrixFlow Fixed Composed(IsospectralMidpoint);
    DormandPrince853 "dop853"            8  "a curve on a chart, or bodies in joint coordinates, to a tolerance"
        Chart Controlled Pair::Eight;
    Radau5           "radau5"            5  "bodies in joint coordinates with stiff springs and dampers, to a tolerance"
        Tree Controlled ();
}

/// Names of methods in older problem files, with the methods that replace them.
const REPLACED: [(&str, Method); 10] = [
    ("dmv2", Method::MoserVeselov10),
    ("dmv4", Method::MoserVeselov10),
    ("dmv6", Method::MoserVeselov10),
    ("dmv8", Method::MoserVeselov10),
    ("strang", Method::MoserVeselov10),
    ("suzuki4", Method::MoserVeselov10),
    ("kick2", Method::Kick4),
    ("kick6", Method::Kick4),
    ("magnus4", Method::Magnus6),
    ("cg3", Method::CommutatorFree4),
];

/// If the tolerance is below this value, order 8 is faster than order 5.
const EIGHT: f64 = 1e-8;

/// The smallest tolerance that double precision resolves.
const LEAST: f64 = 1e-15;

impl Method {
    fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// The name in problem files.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The order of convergence; `None` for exact solutions.
    pub fn order(self) -> Option<u32> {
        Some(self.row().order).filter(|order| *order > 0)
    }

    /// The class of problems that the method integrates.
    pub fn class(self) -> Class {
        self.row().class
    }

    /// A description of the class of problems, for messages.
    pub fn why(self) -> &'static str {
        self.row().why
    }

    /// The method with this name; `None` if there is no such method.
    pub fn from_name(name: &str) -> Option<Self> {
        Method::ALL.iter().copied().find(|method| method.name() == name)
    }

    /// The method that replaces a name of older problem files; `None` for other names.
    pub fn instead_of(name: &str) -> Option<Self> {
        REPLACED.iter().find(|(old, _)| *old == name).map(|(_, method)| *method)
    }

    /// The method with step-size control that is faster for a tolerance: order 8 for small
    /// tolerances, otherwise order 5.
    pub fn to(tolerance: f64) -> Self {
        if tolerance <= EIGHT { Method::MuntheKaas853 } else { Method::MuntheKaas54 }
    }

    /// The names of the methods of these classes, as text for messages.
    pub fn names_of(classes: &[Class]) -> String {
        let methods = Method::ALL.iter().filter(|method| classes.contains(&method.class()));
        methods.map(|method| method.name()).collect::<Vec<_>>().join(", ")
    }

    /// Whether the method has a fixed step size.
    pub fn has_steps(self) -> bool {
        self.row().steps == Steps::Fixed
    }

    /// Whether the method has step-size control.
    pub fn is_controlled(self) -> bool {
        self.row().steps == Steps::Controlled
    }

    /// Checks that a method with step-size control can meet the tolerance.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the tolerance is below the resolution of floats.
    pub fn expect_resolved(self, tolerance: f64) -> Result<(), Error> {
        if !self.is_controlled() || tolerance >= LEAST {
            return Ok(());
        }
        Err(self.refused(&format!(
            "the tolerance {tolerance:e} is too small for floats: the least is {LEAST:e}"
        )))
    }

    /// The error if a method does not apply to the problem.
    pub(super) fn refused(self, reason: &str) -> Error {
        Error::Unsupported(format!("the method {} does not apply here: {reason}", self.name()))
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
