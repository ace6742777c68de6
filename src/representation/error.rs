//! Errors of representations.

/// An invalid algebra, weight or subalgebra, or a computation beyond its limits.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RepresentationError {
    /// The text does not name a reductive algebra.
    #[error("`{}` is not a reductive algebra: {reason}", .text.escape_debug())]
    UnknownAlgebra {
        /// The text of the factor.
        text: String,
        /// The reason.
        reason: String,
    },
    /// The number of labels is not the rank.
    #[error("the weight has {given} labels, but the rank of {algebra} is {expected}")]
    Length {
        /// The number of labels.
        given: usize,
        /// The rank.
        expected: usize,
        /// The algebra.
        algebra: String,
    },
    /// A Dynkin label of a highest weight is negative.
    #[error(
        "label {position} of the weight is {label}: the labels of a highest weight are at least 0"
    )]
    NotDominant {
        /// The position of the label, from 1.
        position: usize,
        /// The label.
        label: i64,
    },
    /// A label exceeds the limit.
    #[error("label {position} of the weight is {label}, which exceeds the limit of {limit}")]
    LargeLabel {
        /// The position of the label, from 1.
        position: usize,
        /// The label.
        label: i64,
        /// The limit.
        limit: i64,
    },
    /// The text is neither a list of labels nor the name of a representation.
    #[error("`{}` is not a representation of {algebra}: {reason}", .text.escape_debug())]
    UnknownWeight {
        /// The text.
        text: String,
        /// The algebra.
        algebra: String,
        /// The reason.
        reason: String,
    },
    /// Two representations belong to different algebras.
    #[error("the representations belong to {left} and to {right}")]
    DifferentAlgebras {
        /// The algebra of the first representation.
        left: String,
        /// The algebra of the second one.
        right: String,
    },
    /// A result would exceed the limit of memory or of the integers.
    #[error("{what} exceeds the limit of {limit}")]
    TooLarge {
        /// The quantity.
        what: String,
        /// The limit.
        limit: String,
    },
    /// The weights are not the weights of a representation.
    #[error("the weights are not those of a representation: {reason}")]
    NotACharacter {
        /// The reason.
        reason: String,
    },
    /// The data do not define a subalgebra.
    #[error("{subalgebra} is not a subalgebra of {algebra} in this way: {reason}")]
    NotASubalgebra {
        /// The subalgebra.
        subalgebra: String,
        /// The algebra.
        algebra: String,
        /// The reason.
        reason: String,
    },
    /// The text or the number is not a spin that the function accepts.
    #[error("the spin `{}` is invalid: {reason}", .text.escape_debug())]
    NotASpin {
        /// The text or the number.
        text: String,
        /// The reason.
        reason: String,
    },
}
