//! Complex reductive Lie algebras: sums of simple types and abelian factors.

use super::RepresentationError;
use crate::algebra::roots::{CartanType, RootSystem, Series};
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// A complex reductive Lie algebra `g_1 + ... + g_k + t`, with simple factors `g_i` and an abelian
/// summand `t`, together with its positive roots.
///
/// A name is a Cartan type (`E6`), an abelian algebra (`T1`, `U(1)`) or a classical algebra
/// (`SU(5)`, `SL(5)`, `U(5)`, `SO(10)`, `Sp(6)` of rank 3, in capitals or small letters). A real
/// form denotes its complexification. `+` or `x` between names is a direct sum; the abelian factors
/// come last.
///
/// ```
/// use affinor::representation::ReductiveAlgebra;
/// let algebra: ReductiveAlgebra = "SU(3) x U(1) x SU(2)".parse()?;
/// assert_eq!(algebra.to_string(), "A2 + A1 + T1");
/// assert_eq!((algebra.rank(), algebra.dimension()), (4, 12));
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone)]
pub struct ReductiveAlgebra(Arc<Data>);

struct Data {
    simple: Vec<CartanType>,
    abelian: usize,
    /// The first label of each simple factor, then the number of all labels.
    starts: Vec<usize>,
    /// The entries `<α_i, α_j^∨>` of the Cartan matrix that are not 0, for `j != i`.
    neighbours: Vec<Vec<(usize, i64)>>,
    roots: Vec<PositiveRoot>,
}

/// A positive root of a simple factor, in the coordinates of all factors.
pub(super) struct PositiveRoot {
    /// Over the simple roots.
    pub coefficients: Vec<i64>,
    /// The coroot over the simple coroots.
    pub coroot: Vec<i64>,
    /// The Dynkin labels.
    pub labels: Vec<i64>,
    /// `(α, α)/2`, where short roots of the factor have `(α, α) = 2`.
    pub half_length: i64,
    /// The simple factor of the root.
    pub factor: usize,
}

impl ReductiveAlgebra {
    /// The sum of simple algebras and of an abelian algebra of the given dimension.
    pub fn new(simple: impl IntoIterator<Item = CartanType>, abelian: usize) -> Self {
        let simple: Vec<CartanType> = simple.into_iter().collect();
        let mut starts = vec![0];
        for factor in &simple {
            starts.push(starts[starts.len() - 1] + factor.rank());
        }
        let rank = starts[simple.len()];
        let (mut neighbours, mut roots) = (vec![], vec![]);
        for (at, factor) in simple.iter().enumerate() {
            let start = starts[at];
            for (i, row) in factor.cartan_matrix().into_iter().enumerate() {
                let entries = row.into_iter().enumerate();
                let joined = entries.filter(|&(j, entry)| j != i && entry != 0);
                neighbours.push(joined.map(|(j, entry)| (start + j, entry)).collect());
            }
            let padded = |labels: &[i64]| {
                let mut all = vec![0; rank];
                all[start..start + labels.len()].copy_from_slice(labels);
                all
            };
            roots.extend(RootSystem::new(*factor).positive_roots().iter().map(|root| {
                PositiveRoot {
                    coefficients: padded(root.coefficients()),
                    coroot: padded(root.coroot()),
                    labels: padded(root.weight()),
                    half_length: root.squared_length() / 2,
                    factor: at,
                }
            }));
        }
        ReductiveAlgebra(Arc::new(Data { simple, abelian, starts, neighbours, roots }))
    }

    /// The simple factors.
    pub fn simple_factors(&self) -> &[CartanType] {
        &self.0.simple
    }

    /// The dimension of the centre: the number of charges of a weight.
    pub fn abelian_dimension(&self) -> usize {
        self.0.abelian
    }

    /// The rank: the number of Dynkin labels and charges of a weight.
    pub fn rank(&self) -> usize {
        self.semisimple_rank() + self.0.abelian
    }

    /// The rank of the semisimple part: the number of Dynkin labels of a weight.
    pub fn semisimple_rank(&self) -> usize {
        self.0.neighbours.len()
    }

    /// The dimension of the algebra.
    pub fn dimension(&self) -> usize {
        2 * self.0.roots.len() + self.rank()
    }

    /// The positions of the labels of a simple factor in a weight.
    ///
    /// ```
    /// use affinor::representation::ReductiveAlgebra;
    /// let algebra: ReductiveAlgebra = "A2 + G2".parse()?;
    /// assert_eq!(algebra.positions(1), 2..4);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn positions(&self, factor: usize) -> std::ops::Range<usize> {
        let start = |at: usize| self.0.starts.get(at).copied().unwrap_or(self.semisimple_rank());
        start(factor)..start(factor.saturating_add(1))
    }

    pub(super) fn positive_roots(&self) -> &[PositiveRoot] {
        &self.0.roots
    }

    /// The positive roots of a simple factor; the highest root is the last.
    pub(super) fn roots_of(&self, factor: usize) -> impl Iterator<Item = &PositiveRoot> {
        self.0.roots.iter().filter(move |root| root.factor == factor)
    }

    #[inline]
    pub(super) fn neighbours(&self, i: usize) -> &[(usize, i64)] {
        &self.0.neighbours[i]
    }

    /// The first neighbour of a node of the Dynkin diagram, or the node after it.
    #[inline]
    pub(super) fn first_neighbour(&self, i: usize) -> usize {
        self.0.neighbours[i].first().map_or(i + 1, |&(j, _)| j)
    }

    /// `(α_i, α_i)/2` for each simple root.
    pub(super) fn half_lengths(&self) -> Vec<i64> {
        let mut lengths = vec![0; self.semisimple_rank()];
        for root in &self.0.roots {
            if root.coefficients.iter().sum::<i64>() == 1 {
                let simple = root.coefficients.iter().position(|&c| c == 1);
                lengths[simple.unwrap_or(0)] = root.half_length;
            }
        }
        lengths
    }
}

impl PartialEq for ReductiveAlgebra {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || self.0.simple == other.0.simple && self.0.abelian == other.0.abelian
    }
}

impl Eq for ReductiveAlgebra {}

impl fmt::Display for ReductiveAlgebra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut names: Vec<String> = self.0.simple.iter().map(ToString::to_string).collect();
        if self.0.abelian > 0 || names.is_empty() {
            names.push(format!("T{}", self.0.abelian));
        }
        f.write_str(&names.join(" + "))
    }
}

impl fmt::Debug for ReductiveAlgebra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ReductiveAlgebra({self})")
    }
}

/// The maximum dimension of the centre.
const MAX_ABELIAN: usize = 64;

impl FromStr for ReductiveAlgebra {
    type Err = RepresentationError;

    fn from_str(text: &str) -> Result<Self, RepresentationError> {
        let (mut simple, mut abelian) = (vec![], 0);
        for name in text.split(['+', 'x', '×']) {
            let factor = factor(name.trim()).map_err(|reason| {
                RepresentationError::UnknownAlgebra { text: name.trim().into(), reason }
            })?;
            simple.extend(factor.0);
            abelian += factor.1;
        }
        let rank = simple.iter().map(|factor| factor.rank()).sum::<usize>();
        if rank > MAX_ABELIAN || abelian > MAX_ABELIAN {
            let limit = format!("{MAX_ABELIAN}");
            return Err(RepresentationError::TooLarge {
                what: format!("the rank of {text}"),
                limit,
            });
        }
        Ok(Self::new(simple, abelian))
    }
}

/// The simple factors and the dimension of the centre of an algebra that one name denotes.
fn factor(name: &str) -> Result<(Vec<CartanType>, usize), String> {
    let at = name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len());
    let (family, argument) = name.split_at(at);
    let inner = argument.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let digits = inner.unwrap_or(argument).trim();
    let numbers: Option<Vec<usize>> =
        digits.split(',').map(|number| number.trim().parse().ok().filter(|&n| n <= 2048)).collect();
    let names = "write a sum of names such as E6, A4, SU(5), SO(10), Sp(6), U(1)";
    let n = match numbers.as_deref() {
        Some([n]) => *n,
        // real forms by signature
        Some([p, q]) if ["su", "so", "u"].contains(&family.to_lowercase().as_str()) => p + q,
        _ => return Err(names.into()),
    };
    let simple = |series, rank| match CartanType::new(series, rank) {
        Ok(factor) => Ok((vec![factor], 0)),
        Err(error) => Err(error.to_string()),
    };
    let special = |n: usize| if n == 1 { Ok((vec![], 0)) } else { simple(Series::A, n - 1) };
    match family {
        "A" => simple(Series::A, n),
        "B" => simple(Series::B, n),
        "C" => simple(Series::C, n),
        "D" => simple(Series::D, n),
        "E" => simple(Series::E, n),
        "F" => simple(Series::F, n),
        "G" => simple(Series::G, n),
        "T" => Ok((vec![], n)),
        _ => match (family.to_lowercase().as_str(), n) {
            ("su" | "sl" | "u" | "gl" | "so" | "sp" | "usp", 0) => Err("n must be positive".into()),
            ("su" | "sl", _) => special(n),
            ("u" | "gl", _) => special(n).map(|(simple, _)| (simple, 1)),
            ("so", 1) => Ok((vec![], 0)),
            ("so", 2) => Ok((vec![], 1)),
            ("so", 3) => simple(Series::A, 1),
            ("so", 4) => simple(Series::A, 1).map(|(one, _)| ([one.clone(), one].concat(), 0)),
            ("so", _) if n % 2 == 1 => simple(Series::B, n / 2),
            ("so", _) => simple(Series::D, n / 2),
            ("sp" | "usp", _) if n % 2 == 1 => Err("the argument of Sp must be even".into()),
            ("sp" | "usp", 2) => simple(Series::A, 1),
            ("sp" | "usp", _) => simple(Series::C, n / 2),
            _ => Err(names.into()),
        },
    }
}
