//! Errors for names that do not identify exactly one algebra of the catalogue.

use crate::algebra::roots::MAX_DIMENSION;
use affinor_tensors::expression::ExpressionError;
use std::ops::Range;

/// The name does not identify exactly one algebra of the catalogue.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CatalogueError {
    /// The beginning of the name matches no family.
    #[error("there is no algebra named `{}`{}", .name.escape_debug(), suggestion(.nearest))]
    Unknown {
        /// The name.
        name: String,
        /// Similar names of the catalogue.
        nearest: Vec<String>,
    },
    /// A short form has several readings.
    #[error(
        "`{}` can be read as {}: write the parentheses",
        .name.escape_debug(), .readings.join(" or ")
    )]
    Ambiguous {
        /// The name.
        name: String,
        /// All readings, written in full.
        readings: Vec<String>,
    },
    /// The name has no arguments, but its family needs them.
    #[error(
        "`{}` needs arguments: write for instance {}",
        .name.escape_debug(), .candidates.join(" or ")
    )]
    Incomplete {
        /// The name.
        name: String,
        /// One example from each family that the beginning of the name matches.
        candidates: Vec<String>,
    },
    /// The family has no algebra for these arguments.
    #[error("there is no `{}` in the catalogue: {rule}", .name.escape_debug())]
    NoSuchAlgebra {
        /// The name.
        name: String,
        /// The condition on the arguments.
        rule: String,
    },
    /// The algebra exists, but its dimension exceeds [`MAX_DIMENSION`].
    #[error("the dimension of `{}` exceeds the limit of {MAX_DIMENSION}", .name.escape_debug())]
    TooLarge {
        /// The name.
        name: String,
    },
    /// Parentheses do not match.
    #[error("`{}`: {reason}", .name.escape_debug())]
    Malformed {
        /// The name.
        name: String,
        /// The offending part of the name (byte positions).
        span: Range<usize>,
        /// The description of the mistake.
        reason: &'static str,
    },
    /// The scalar cannot represent a structure constant.
    #[error(
        "`{}` has the structure constant {value}, which these scalars cannot represent: \
         give the value of its parameter, or use symbolic scalars",
        .name.escape_debug()
    )]
    Parameter {
        /// The full name.
        name: String,
        /// The structure constant.
        value: String,
    },
    /// The value of a parameter is not an expression.
    #[error("`{}`: {source}", .name.escape_debug())]
    Value {
        /// The name.
        name: String,
        /// The error; its span counts bytes of the name.
        source: ExpressionError,
    },
}

fn suggestion(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        names => format!("; the nearest is {}", names.join(" or ")),
    }
}
