//! What can go wrong with tensors and their index notation.

/// An error of the tensor engine.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TensorError {
    /// An index is not below the dimension.
    #[error("index {index} is out of range for dimension {dimension}")]
    IndexRange {
        /// The offending index, from 0.
        index: usize,
        /// The dimension.
        dimension: usize,
    },
    /// A component has the wrong number of indices, or a slot does not exist.
    #[error("a tensor of rank {rank} was given {given} indices")]
    Rank {
        /// The rank of the tensor.
        rank: usize,
        /// The number of indices given.
        given: usize,
    },
    /// What are not different slots of the tensor.
    #[error("{slots:?} are not different slots, counted from 0, of a tensor of rank {rank}")]
    Slots {
        /// The slots given.
        slots: Vec<usize>,
        /// The rank of the tensor.
        rank: usize,
    },
    /// A number that has no inverse in the scalars.
    #[error("{0} has no inverse in the scalars")]
    NotInvertible(i64),
    /// `dimension^rank` does not fit the 64-bit component keys, or a contraction would need too
    /// large a table.
    #[error("a tensor of rank {rank} in dimension {dimension} is too large")]
    TooLarge {
        /// The dimension.
        dimension: usize,
        /// The rank.
        rank: usize,
    },
    /// Operands of different dimensions.
    #[error("operands have dimensions {0} and {1}")]
    Dimension(usize, usize),
    /// The contraction expression is malformed.
    #[error("in `{expression}`: {reason}")]
    Notation {
        /// The expression.
        expression: String,
        /// What is wrong with it.
        reason: String,
    },
}
