//! Cartan types: the names of the simple Lie algebras, and their Cartan matrices.

use std::fmt;

/// The largest dimension of an algebra that a [`CartanType`] may name.
pub const MAX_DIMENSION: usize = 2048;

/// The Cartan type of a simple Lie algebra: a series and a rank, such as `E8`.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
///
/// let e8 = CartanType::new(Series::E, 8)?;
/// assert_eq!((e8.to_string().as_str(), e8.dimension()), ("E8", 248));
/// assert!(CartanType::new(Series::E, 9).is_err());
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CartanType {
    series: Series,
    rank: usize,
}

/// The four classical series and the three exceptional series.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Series {
    /// `sl(n+1)`
    A,
    /// `so(2n+1)`
    B,
    /// `sp(2n)`
    C,
    /// `so(2n)`
    D,
    /// E6, E7, E8
    E,
    /// F4
    F,
    /// G2
    G,
}

/// The reason why no [`CartanType`] has this series and rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RootError {
    /// The series has no simple algebra of this rank.
    #[error(
        "there is no simple Lie algebra {series}{rank}: {series}n needs {}", .series.ranks()
    )]
    NoSuchType {
        /// The requested series.
        series: Series,
        /// The requested rank.
        rank: usize,
    },
    /// The algebra exists, but its dimension exceeds [`MAX_DIMENSION`].
    #[error("the dimension of {series}{rank} exceeds the limit of {MAX_DIMENSION}")]
    TooLarge {
        /// The requested series.
        series: Series,
        /// The requested rank.
        rank: usize,
    },
}

impl Series {
    /// The condition on the rank, as text for messages.
    fn ranks(self) -> &'static str {
        match self {
            Series::A => "n >= 1",
            Series::B | Series::C => "n >= 2",
            Series::D => "n >= 3",
            Series::E => "n = 6, 7, 8",
            Series::F => "n = 4",
            Series::G => "n = 2",
        }
    }
}

impl CartanType {
    /// The type of this series and rank: `A_n` with n >= 1, `B_n` and `C_n` with n >= 2, `D_n` with
    /// n >= 3, `E6`, `E7`, `E8`, `F4`, `G2`.
    ///
    /// Two names are aliases, up to the numbering of the simple roots: `C2` is `B2`, and `D3` is
    /// `A3`. All four names are accepted.
    ///
    /// # Errors
    ///
    /// [`RootError::NoSuchType`] for every other rank; [`RootError::TooLarge`] if the dimension
    /// exceeds [`MAX_DIMENSION`]: from rank 45 in series A, 32 in B and C, 33 in D.
    pub fn new(series: Series, rank: usize) -> Result<Self, RootError> {
        let exists = match series {
            Series::A => rank >= 1,
            Series::B | Series::C => rank >= 2,
            Series::D => rank >= 3,
            Series::E => (6..=8).contains(&rank),
            Series::F => rank == 4,
            Series::G => rank == 2,
        };
        let cartan_type = CartanType { series, rank };
        if !exists {
            Err(RootError::NoSuchType { series, rank })
        } else if rank > MAX_DIMENSION || cartan_type.dimension() > MAX_DIMENSION {
            Err(RootError::TooLarge { series, rank })
        } else {
            Ok(cartan_type)
        }
    }

    /// The series.
    pub fn series(self) -> Series {
        self.series
    }

    /// The rank: the dimension of a Cartan subalgebra, the number of simple roots.
    pub fn rank(self) -> usize {
        self.rank
    }

    /// The dimension of the Lie algebra.
    pub fn dimension(self) -> usize {
        let n = self.rank;
        match self.series {
            Series::A => n * (n + 2),
            Series::B | Series::C => n * (2 * n + 1),
            Series::D => n * (2 * n - 1),
            Series::E => match n {
                6 => 78,
                7 => 133,
                _ => 248,
            },
            Series::F => 52,
            Series::G => 14,
        }
    }

    /// The Cartan matrix `a_ij = <α_i, α_j^∨> = 2 (α_i, α_j) / (α_j, α_j)`. Rows belong to roots
    /// and columns to coroots, as in Bourbaki and in GAP. The Chevalley relation is then `[h_j,
    /// e_i] = a_ij e_i`.
    pub fn cartan_matrix(self) -> Vec<Vec<i64>> {
        let lengths = self.squared_lengths();
        let mut matrix = vec![vec![0; self.rank]; self.rank];
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] = 2;
        }
        // joined simple roots satisfy (α_i, α_j) = -max(|α_i|², |α_j|²)/2.
        for (i, j) in self.edges() {
            let longer = lengths[i].max(lengths[j]);
            matrix[i][j] = -longer / lengths[j];
            matrix[j][i] = -longer / lengths[i];
        }
        matrix
    }

    /// The squared lengths of the simple roots. The squared length of short roots is 2.
    pub(super) fn squared_lengths(self) -> Vec<i64> {
        let n = self.rank;
        match self.series {
            Series::A | Series::D | Series::E => vec![2; n],
            Series::B => (1..=n).map(|i| if i < n { 4 } else { 2 }).collect(),
            Series::C => (1..=n).map(|i| if i < n { 2 } else { 4 }).collect(),
            Series::F => vec![4, 4, 2, 2],
            Series::G => vec![2, 6],
        }
    }

    /// The edges of the Dynkin diagram.
    fn edges(self) -> Vec<(usize, usize)> {
        let n = self.rank;
        let chain = |from: usize, to: usize| (from + 1..to).map(|i| (i - 1, i));
        match self.series {
            Series::D => chain(0, n - 1).chain([(n - 3, n - 1)]).collect(),
            // joins α_2 to α_4; the other roots form the chain 1, 3, 4, ..., n.
            Series::E => [(0, 2), (1, 3)].into_iter().chain(chain(2, n)).collect(),
            _ => chain(0, n).collect(),
        }
    }
}

impl fmt::Display for Series {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

impl fmt::Display for CartanType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.series, self.rank)
    }
}
