//! The scalar types in which spaces and reports are computed.

use crate::input::{InputError, shown};
use affinor::tensors::{Notation, Rational, Recorded, Scalar, Symbolic, Tabular, TrackedFloat};

/// A scalar type that can represent the values of a definition, and whose tensors can be contracted
/// and written in tables.
pub trait Coefficient: Tabular + Scalar {
    /// Converts a value to this scalar type; `None` if this type cannot represent the value.
    fn from_symbolic(value: &Symbolic) -> Option<Self>;

    /// Like [`from_symbolic`](Self::from_symbolic), but returns an error instead of `None`.
    ///
    /// # Errors
    /// An error if the value does not exist in this scalar type.
    fn read(value: &Symbolic) -> Result<Self, InputError> {
        Self::from_symbolic(value).ok_or_else(|| {
            let shown = shown(&value.to_string());
            InputError::usage(format!("the value {shown} cannot be represented in this scalar"))
                .help("set every parameter with --set; floats must be 0, or have a magnitude from 1e-307 to 1e308")
        })
    }
}

impl Coefficient for Rational {
    fn from_symbolic(value: &Symbolic) -> Option<Self> {
        value.as_constant().cloned()
    }
}

impl Coefficient for Symbolic {
    fn from_symbolic(value: &Symbolic) -> Option<Self> {
        Some(value.clone())
    }
}

/// Values are recorded as programs, whose inputs are the parameters and coordinates.
impl Coefficient for Recorded {
    fn from_symbolic(value: &Symbolic) -> Option<Self> {
        Recorded::try_from(value).ok()
    }
}

/// Roots of numbers and pi are first approximated by rational numbers that are more accurate than
/// floats, so that the rounding errors are known.
impl Coefficient for TrackedFloat {
    fn from_symbolic(value: &Symbolic) -> Option<Self> {
        Self::from_rational(&value.approximation()?)
    }
}

impl Coefficient for f64 {
    fn from_symbolic(value: &Symbolic) -> Option<Self> {
        Self::from_rational(&value.approximation()?)
    }
}

/// Evaluates an expression over the scalar type of a [`Kind`](affinor::tensors::Kind):
/// `over_kind!(kind, S => f::<S>(x))`.
#[macro_export]
macro_rules! over_kind {
    ($kind:expr, $S:ident => $body:expr) => {
        match $kind {
            $crate::scalars::Kind::Exact => {
                type $S = $crate::scalars::Rational;
                $body
            }
            $crate::scalars::Kind::Symbolic => {
                type $S = $crate::scalars::Symbolic;
                $body
            }
            $crate::scalars::Kind::Float => $crate::over_floats!($S => $body),
        }
    };
}

/// Evaluates an expression over floats.
#[doc(hidden)]
#[cfg(not(target_arch = "wasm32"))]
#[macro_export]
macro_rules! over_floats {
    ($S:ident => $body:expr) => {{
        type $S = $crate::scalars::TrackedFloat;
        $body
    }};
}

/// Requests of the page cannot choose floats, whose code would be a tenth of its download.
#[doc(hidden)]
#[cfg(target_arch = "wasm32")]
#[macro_export]
macro_rules! over_floats {
    ($S:ident => $body:expr) => {
        unreachable!("the page computes exactly")
    };
}
