//! The methods of integration by name.

use crate::Error;
use crate::mechanics::Magnus;
use crate::mechanics::integrators::moser_veselov::Order;
use crate::mechanics::integrators::splitting::Composition;
use crate::mechanics::integrators::{Pair, kick};
use std::fmt;

/// The tolerance below which order 8 needs less work than order 5.
const EIGHT: f64 = 1e-8;

/// The least tolerance that double precision resolves.
const LEAST: f64 = 1e-15;

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Elliptic functions, for the free rigid body.
    Exact,
    /// An embedded pair of Dormand and Prince with step-size control.
    Adaptive(Pair),
    /// Runge-Kutta-Munthe-Kaas of order 4.
    MuntheKaas,
    /// Runge-Kutta in embedded coordinates with projection, of order 4.
    Projected,
    /// An embedded pair of Dormand and Prince in embedded coordinates with projection, with step-size control.
    ProjectedAdaptive(Pair),
    /// Commutator-free, of order 4.
    CommutatorFree,
    /// Crouch and Grossman, of order 3.
    CrouchGrossman,
    /// Discrete Moser-Veselov, for the free rigid body.
    MoserVeselov(Order),
    /// Rotations about the principal axes, for the free rigid body.
    Splitting(Composition),
    /// Simo and Wong, for bodies.
    SimoWong,
    /// Free motion and kicks, for bodies with forces that do not depend on the velocity.
    Kick(kick::Order),
    /// Generalised alpha, for systems with constraints.
    GeneralisedAlpha,
    /// Magnus, for a given velocity.
    Magnus(Magnus),
    /// The isospectral midpoint rule, for flows of matrices.
    Isospectral,
    /// The same composed to order 4.
    ComposedIsospectral,
}

/// All methods with their names in problem files.
const NAMES: [(Method, &str); 25] = [
    (Method::Exact, "exact"),
    (Method::Adaptive(Pair::Five), "rkmk54"),
    (Method::Adaptive(Pair::Eight), "rkmk853"),
    (Method::MuntheKaas, "rkmk4"),
    (Method::Projected, "projected4"),
    (Method::ProjectedAdaptive(Pair::Five), "projected54"),
    (Method::ProjectedAdaptive(Pair::Eight), "projected853"),
    (Method::CommutatorFree, "cf4"),
    (Method::CrouchGrossman, "cg3"),
    (Method::MoserVeselov(Order::Two), "dmv2"),
    (Method::MoserVeselov(Order::Four), "dmv4"),
    (Method::MoserVeselov(Order::Six), "dmv6"),
    (Method::MoserVeselov(Order::Eight), "dmv8"),
    (Method::MoserVeselov(Order::Ten), "dmv10"),
    (Method::Splitting(Composition::Strang), "strang"),
    (Method::Splitting(Composition::Suzuki), "suzuki4"),
    (Method::SimoWong, "simo-wong"),
    (Method::Kick(kick::Order::Two), "kick2"),
    (Method::Kick(kick::Order::Four), "kick4"),
    (Method::Kick(kick::Order::Six), "kick6"),
    (Method::GeneralisedAlpha, "generalised-alpha"),
    (Method::Magnus(Magnus::Four), "magnus4"),
    (Method::Magnus(Magnus::Six), "magnus6"),
    (Method::Isospectral, "isospectral2"),
    (Method::ComposedIsospectral, "isospectral4"),
];

impl Method {
    /// All methods.
    pub const ALL: [Method; 25] = {
        let mut all = [Method::Exact; 25];
        let mut at = 0;
        while at < all.len() {
            all[at] = NAMES[at].0;
            at += 1;
        }
        all
    };

    /// The name in problem files.
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(method, _)| *method == self).map_or("", |(_, name)| name)
    }

    /// The controlled method for a tolerance: of order 8 where that needs less work, else of order 5.
    pub fn to(tolerance: f64) -> Self {
        Method::Adaptive(if tolerance <= EIGHT { Pair::Eight } else { Pair::Five })
    }

    /// The method of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        NAMES.iter().find(|(_, known)| *known == name).map(|(method, _)| *method)
    }

    /// The class of problems that the method integrates.
    pub fn why(self) -> &'static str {
        match self {
            Method::Exact => "a free rigid body",
            Method::MoserVeselov(_) | Method::Splitting(_) => "a free rigid body, with a step",
            Method::SimoWong => "a rigid body, with a step",
            Method::Kick(_) => "a body in a potential, with a step",
            Method::Adaptive(_) => "any group and any forces, to a tolerance",
            Method::GeneralisedAlpha => "a system with constraints",
            Method::Magnus(_) => "a velocity given over time",
            Method::Isospectral | Method::ComposedIsospectral => {
                "a flow of matrices that keeps their spectrum"
            }
            _ => "any group and any forces, with a step",
        }
    }

    /// Whether the method has a fixed step size.
    pub fn has_steps(self) -> bool {
        self != Method::Exact && !self.is_controlled()
    }

    /// Whether the method has step-size control.
    pub fn is_controlled(self) -> bool {
        matches!(self, Method::Adaptive(_) | Method::ProjectedAdaptive(_))
    }

    /// Checks that a method with step-size control can meet the tolerance.
    ///
    /// # Errors
    /// [`Error::NoMethod`] for a tolerance below the resolution of floats.
    pub fn expect_resolved(self, tolerance: f64) -> Result<(), Error> {
        if !self.is_controlled() || tolerance >= LEAST {
            return Ok(());
        }
        let reason =
            format!("floats do not resolve the tolerance {tolerance:e}: the least is {LEAST:e}");
        Err(Error::NoMethod { method: self.name(), reason })
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
