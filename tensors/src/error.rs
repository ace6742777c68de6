//! Errors of tensors and of their index notation.

/// An error of a tensor operation.
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
    /// The number of indices differs from the rank of a tensor.
    #[error("a tensor of rank {rank} was given {given} indices")]
    Rank {
        /// The rank of the tensor.
        rank: usize,
        /// The number of indices that were given.
        given: usize,
    },
    /// The slots are not different slots of the tensor.
    #[error("{slots:?} are not different slots, counted from 0, of a tensor of rank {rank}")]
    Slots {
        /// The slots that were given.
        slots: Vec<usize>,
        /// The rank of the tensor.
        rank: usize,
    },
    /// The sides of an array or a matrix differ in length.
    #[error("the sides must have equal lengths, but the shape is {shape:?}")]
    NotSquare {
        /// The lengths of the sides.
        shape: Vec<usize>,
    },
    /// An integer has no inverse in the scalars.
    #[error("the integer {0} has no inverse in the scalars")]
    NotInvertible(i64),
    /// `dimension^rank` exceeds the range of 64-bit component keys, or a table of a contraction
    /// would be too large.
    #[error("a tensor of rank {rank} in dimension {dimension} is too large")]
    TooLarge {
        /// The dimension.
        dimension: usize,
        /// The rank.
        rank: usize,
    },
    /// The operands have different dimensions.
    #[error("the operands have different dimensions, {0} and {1}")]
    Dimension(usize, usize),
    /// A contraction is malformed, or does not fit its operands.
    #[error("in `{expression}`: {error}")]
    Notation {
        /// The text of the contraction.
        expression: String,
        /// The mistake.
        error: NotationError,
    },
}

/// A mistake in the index notation of a contraction.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotationError {
    /// The arrow that introduces the indices of the result is missing.
    #[error("no `->` before the result")]
    NoArrow,
    /// A term is empty or has only a coefficient.
    #[error("a term has no factor")]
    NoFactor,
    /// A coefficient exceeds 64 bits.
    #[error("a coefficient is too large")]
    Coefficient,
    /// A name is not among the operands.
    #[error("no operand is called `{0}`")]
    Unknown(String),
    /// A word is neither a sign, a coefficient nor a name with indices.
    #[error("`{0}` is not a name with indices")]
    Word(String),
    /// Two operands have the same name.
    #[error("two operands are called `{0}`")]
    Ambiguous(String),
    /// The variances in the notation differ from the slots of the operand.
    #[error("the indices of `{0}` do not match its slots")]
    Slots(String),
    /// A symbol is not allowed among these indices.
    #[error("`{0}` is not allowed in the indices `{1}`")]
    Symbol(char, String),
    /// An opening bracket is not closed.
    #[error("`[` without `]`")]
    Unclosed,
    /// A closing bracket has no opening bracket.
    #[error("`]` without `[`")]
    Unopened,
    /// The indices of a factor contain brackets.
    #[error("brackets are allowed in the result only")]
    Brackets,
    /// A letter occurs twice in the result.
    #[error("the index `{0}` occurs twice in the result")]
    Twice(char),
    /// A letter of the result is missing in a term.
    #[error("a term lacks the index `{0}`")]
    Missing(char),
    /// A letter is upper in a term and lower in the result, or vice versa.
    #[error("the index `{0}` is upper on one side of `->` and lower on the other")]
    Variance(char),
    /// The two slots of a summed letter have the same variance.
    #[error("the index `{0}` is summed, but not once upper and once lower")]
    Level(char),
    /// A letter neither occurs once in the result, nor is summed as a pair.
    #[error("the letter `{0}` is neither an index of the result nor summed in a pair")]
    Count(char),
}
