//! Why a name stands for no algebra.

use super::MAX_DIMENSION;
use affinor_tensors::expression::ExpressionError;
use std::ops::Range;

/// A name that the catalogue cannot answer with one algebra.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CatalogueError {
    /// No family begins like this.
    #[error("there is no algebra named `{}`{}", .name.escape_debug(), suggestion(.nearest))]
    Unknown {
        /// The name.
        name: String,
        /// Names of the catalogue that differ from it by little.
        nearest: Vec<String>,
    },
    /// A short form with more than one reading.
    #[error(
        "`{}` can be read as {}: write the parentheses",
        .name.escape_debug(), .readings.join(" or ")
    )]
    Ambiguous {
        /// The name.
        name: String,
        /// All readings, in full.
        readings: Vec<String>,
    },
    /// A family without the arguments that choose one algebra.
    #[error(
        "`{}` needs arguments: write for instance {}",
        .name.escape_debug(), .candidates.join(" or ")
    )]
    Incomplete {
        /// The name.
        name: String,
        /// An example of every family that begins like this.
        candidates: Vec<String>,
    },
    /// A family has no algebra with these arguments.
    #[error("there is no `{}` in the catalogue: {rule}", .name.escape_debug())]
    NoSuchAlgebra {
        /// The name.
        name: String,
        /// What the arguments have to be.
        rule: String,
    },
    /// The algebra exists, but its dimension exceeds [`MAX_DIMENSION`].
    #[error("the dimension of `{}` exceeds the limit of {MAX_DIMENSION}", .name.escape_debug())]
    TooLarge {
        /// The name.
        name: String,
    },
    /// Parentheses that do not match.
    #[error("`{}`: {reason}", .name.escape_debug())]
    Malformed {
        /// The name.
        name: String,
        /// The offending part of the name (byte positions).
        span: Range<usize>,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A parameter whose value is no expression.
    #[error("`{}`: {source}", .name.escape_debug())]
    Value {
        /// The name.
        name: String,
        /// What is wrong with the value; its span counts in the name.
        source: ExpressionError,
    },
}

fn suggestion(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        names => format!("; the nearest is {}", names.join(" or ")),
    }
}
