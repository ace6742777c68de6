//! The names of representations in physics: dimensions with bars and primes, such as `5bar`.
//!
//! # The rule
//!
//! A representation of a simple algebra is named by its dimension. Of two dual representations one
//! has a `bar`. Representations of equal dimension that are not dual have no, one, two primes in
//! the order of their Dynkin indices; for equal indices the lexicographically larger labels come
//! first.
//!
//! Of two dual representations the one with the smaller residue of the
//! [congruency class](HighestWeight::congruency_class) has no bar (Slansky, *Phys. Rep.* 79 (1981)
//! 1-128). If the classes are equal, its labels are larger in lexicographic order, which reads
//! `D_n` from the right. There is one exception: the 6 of SU(3) is the symmetric square of the 3.
//!
//! For a sum of algebras the names of the factors are in parentheses, followed by the charges:
//! `(3,2)(1)`. The factors of a name are in the order of the algebra.

use super::{HighestWeight, ReductiveAlgebra, RepresentationError};
use crate::algebra::roots::{CartanType, Series};
use num_traits::ToPrimitive;

/// The largest dimension of a representation with a name.
pub const MAX_NAMED: u64 = 1_000_000;

/// The name of a representation; `None` if the dimension of a factor exceeds [`MAX_NAMED`].
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra, names::name};
/// let standard_model: ReductiveAlgebra = "SU(3) x SU(2) x U(1)".parse()?;
/// let quarks = HighestWeight::new(&standard_model, [1, 0, 1, 1])?;
/// assert_eq!(name(&quarks).as_deref(), Some("(3,2)(1)"));
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
pub fn name(weight: &HighestWeight) -> Option<String> {
    names([weight]).pop().flatten()
}

/// The [names](name) of representations of one algebra, from one list of all representations up to
/// the largest dimension of a factor.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra, names::names};
/// let su3: ReductiveAlgebra = "SU(3)".parse()?;
/// let weights = [[1, 1], [0, 3]].map(|labels| HighestWeight::new(&su3, labels));
/// let weights = weights.into_iter().collect::<Result<Vec<_>, _>>()?;
/// assert_eq!(names(&weights), [Some("8".into()), Some("10bar".into())]);
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
pub fn names<'w>(weights: impl IntoIterator<Item = &'w HighestWeight>) -> Vec<Option<String>> {
    let weights: Vec<&HighestWeight> = weights.into_iter().collect();
    let Some(first) = weights.first() else { return vec![] };
    let algebra = first.algebra();
    // the names of each factor, by labels
    let tables: Vec<Vec<(Vec<i64>, String)>> = (0..algebra.simple_factors().len())
        .map(|at| {
            let dimensions = weights.iter().filter_map(|w| w.factor_dimension(at).to_u64());
            let mut dimensions: Vec<u64> = dimensions.filter(|d| *d <= MAX_NAMED).collect();
            dimensions.sort_unstable();
            dimensions.dedup();
            let found = of_dimensions(algebra.simple_factors()[at], &dimensions);
            let equal = found.chunk_by(|a, b| a.0 == b.0);
            let mut table: Vec<_> = equal.flat_map(with_names).collect();
            table.sort_unstable();
            table
        })
        .collect();
    let of = |weight: &&HighestWeight| {
        let names: Option<Vec<&str>> = tables
            .iter()
            .enumerate()
            .map(|(at, table)| {
                let labels = &weight.labels()[algebra.positions(at)];
                let place = table.binary_search_by(|(known, _)| known[..].cmp(labels)).ok()?;
                Some(&table[place].1[..])
            })
            .collect();
        let charges = &weight.labels()[algebra.semisimple_rank()..];
        let charges: String = charges.iter().map(|charge| format!("({charge})")).collect();
        Some(match &names?[..] {
            [one] => format!("{one}{charges}"),
            [] if charges.is_empty() => "1".into(),
            [] => charges,
            names => format!("({}){charges}", names.join(",")),
        })
    };
    weights.iter().map(of).collect()
}

impl HighestWeight {
    /// The irreducible representations of a semisimple algebra up to a dimension, which is at most
    /// [`MAX_NAMED`], by dimension; the charges of other algebras are 0.
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] for a larger dimension.
    ///
    /// ```
    /// use affinor::representation::HighestWeight;
    /// let found = HighestWeight::up_to(&"E8".parse()?, 30_380)?;
    /// let dimensions: Vec<u32> = found.iter().map(|w| w.dimension().try_into().unwrap()).collect();
    /// assert_eq!(dimensions, [1, 248, 3875, 27_000, 30_380]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn up_to(
        algebra: &ReductiveAlgebra,
        dimension: u64,
    ) -> Result<Vec<Self>, RepresentationError> {
        if dimension > MAX_NAMED {
            let (what, limit) = (format!("the dimension {dimension}"), MAX_NAMED.to_string());
            return Err(RepresentationError::TooLarge { what, limit });
        }
        let mut found = vec![];
        Search::new(algebra, dimension).collect(&mut |labels, dimension| {
            let mut labels = labels.to_vec();
            labels.resize(algebra.rank(), 0);
            found.push((dimension, labels));
        });
        found.sort_unstable();
        Ok(found.into_iter().map(|(_, labels)| Self::of(algebra, labels)).collect())
    }

    /// Reads Dynkin labels, such as `[0,1,0,0]`, `0 1 0 0` or `0,1,0,0`, or a name by the
    /// [rule](super::names): `10`, `5bar`, `(3,2)(1)`. A single number is a name; the labels of
    /// rank 1 need brackets.
    ///
    /// # Errors
    /// The errors of [`HighestWeight::new`] for labels; [`RepresentationError::UnknownWeight`] if
    /// no representation has the name.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let su3: ReductiveAlgebra = "SU(3)".parse()?;
    /// assert_eq!(HighestWeight::parse(&su3, "3bar")?.labels(), [0, 1]);
    /// assert_eq!(HighestWeight::parse(&su3, "[4, 0]")?, HighestWeight::parse(&su3, "15'")?);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn parse(algebra: &ReductiveAlgebra, text: &str) -> Result<Self, RepresentationError> {
        let text = text.trim();
        let inner = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let list = inner.unwrap_or(text);
        let numbers: Option<Vec<i64>> =
            list.split([',', ' ']).filter(|n| !n.is_empty()).map(|n| n.parse().ok()).collect();
        match numbers {
            Some(labels) if inner.is_some() || labels.len() != 1 => Self::new(algebra, labels),
            _ => parse_name(algebra, text).map_err(|reason| RepresentationError::UnknownWeight {
                text: text.into(),
                algebra: algebra.to_string(),
                reason,
            }),
        }
    }
}

fn parse_name(algebra: &ReductiveAlgebra, text: &str) -> Result<HighestWeight, String> {
    let factors = algebra.simple_factors();
    let form = "write Dynkin labels such as [1,0,0], or a name such as 10, 5bar, 15' or (3,2)(1)";
    // the parts in parentheses; a name without parentheses is the first part
    let mut parts: Vec<&str> = vec![];
    let open = text.find('(').unwrap_or(text.len());
    if open > 0 {
        parts.push(&text[..open]);
    }
    for part in text[open..].split('(').skip(1) {
        parts.push(part.trim().strip_suffix(')').ok_or(form)?);
    }
    let mut parts = parts.into_iter();
    let names: Vec<&str> = match factors.len() {
        0 => vec![],
        _ => parts.next().unwrap_or_default().split(',').map(str::trim).collect(),
    };
    if names.len() != factors.len() {
        let (given, expected) = (names.len(), factors.len());
        return Err(format!(
            "the name has {given} factors, but the algebra has {expected}; {form}"
        ));
    }
    let mut labels = vec![];
    for (factor, name) in factors.iter().zip(names) {
        let name = name.replace('*', "bar").replace('’', "'");
        let digits = name.find(|c: char| !c.is_ascii_digit()).unwrap_or(name.len());
        let dimension: u64 = name[..digits].parse().map_err(|_| form.to_string())?;
        if dimension > MAX_NAMED {
            return Err(format!("names exist up to dimension {MAX_NAMED}; write Dynkin labels"));
        }
        let named = named(*factor, dimension);
        // primes may precede or follow the bar
        let primes = "'".repeat(name.matches('\'').count());
        let bar = if name.contains("bar") { "bar" } else { "" };
        let normal = format!("{dimension}{primes}{bar}");
        let found = named.iter().find(|(candidate, _)| *candidate == normal);
        let complete = normal.len() == name.len();
        match found.filter(|_| complete) {
            Some((_, found)) => labels.extend_from_slice(found),
            None if named.is_empty() => {
                return Err(format!("{factor} has no representation of dimension {dimension}"));
            }
            None => {
                let known: Vec<String> = named
                    .iter()
                    .map(|(name, labels)| format!("{name} = {labels:?}").replace(", ", ","))
                    .collect();
                return Err(format!("{factor} has {}", known.join(", ")));
            }
        }
    }
    let charges: Result<Vec<i64>, String> = parts
        .flat_map(|part| part.split(','))
        .map(|charge| charge.trim().parse().map_err(|_| form.to_string()))
        .collect();
    let charges = charges?;
    if charges.len() != algebra.abelian_dimension() {
        let (given, expected) = (charges.len(), algebra.abelian_dimension());
        return Err(format!("the name has {given} charges, but the algebra needs {expected}"));
    }
    labels.extend(charges);
    HighestWeight::new(algebra, labels).map_err(|error| error.to_string())
}

/// The irreducible representations of a simple algebra whose dimensions are in a sorted list, by
/// dimension.
fn of_dimensions(factor: CartanType, dimensions: &[u64]) -> Vec<(u64, HighestWeight)> {
    let algebra = ReductiveAlgebra::new([factor], 0);
    let mut found = vec![];
    Search::new(&algebra, dimensions.last().copied().unwrap_or(0)).collect(&mut |labels, d| {
        if dimensions.binary_search(&d).is_ok() {
            found.push((d, HighestWeight::of(&algebra, labels.to_vec())));
        }
    });
    found.sort_by_key(|(dimension, _)| *dimension);
    found
}

/// The labels of the irreducible representations of a simple algebra of a dimension, in descending
/// lexicographic order.
pub(super) fn irreducible(factor: CartanType, dimension: u64) -> Vec<Vec<i64>> {
    let found = of_dimensions(factor, &[dimension]);
    let mut labels: Vec<_> = found.iter().map(|(_, weight)| weight.labels().to_vec()).collect();
    labels.sort_by(|a, b| b.cmp(a));
    labels
}

/// The names and labels of all representations of a simple algebra of a dimension.
fn named(factor: CartanType, dimension: u64) -> Vec<(String, Vec<i64>)> {
    let found = with_names(&of_dimensions(factor, &[dimension]));
    found.into_iter().map(|(labels, name)| (name, labels)).collect()
}

/// The labels and names of all representations of a dimension.
fn with_names(found: &[(u64, HighestWeight)]) -> Vec<(Vec<i64>, String)> {
    let dimension = found.first().map_or(0, |(dimension, _)| *dimension);
    let plain = found.iter().map(|(_, weight)| weight).filter(|weight| without_bar(weight));
    let mut plain: Vec<&HighestWeight> = plain.collect();
    plain.sort_by(|a, b| a.index().cmp(&b.index()).then_with(|| b.labels().cmp(a.labels())));
    let mut names = vec![];
    for (primes, weight) in plain.into_iter().enumerate() {
        let name = format!("{dimension}{}", "'".repeat(primes));
        let dual = weight.dual();
        if dual != *weight {
            names.push((dual.labels().to_vec(), format!("{name}bar")));
        }
        names.push((weight.labels().to_vec(), name));
    }
    names
}

/// Whether the name of a representation has no bar.
fn without_bar(weight: &HighestWeight) -> bool {
    let dual = weight.dual();
    let factor = weight.algebra().simple_factors()[0];
    let residues =
        |w: &HighestWeight| w.congruency_class().concat().iter().map(|c| c.0).collect::<Vec<_>>();
    let (class, dual_class) = (residues(weight), residues(&dual));
    if factor.series() == Series::A && [weight.labels(), dual.labels()].contains(&&[2, 0][..]) {
        return weight.labels() == [2, 0];
    }
    if class != dual_class {
        return class < dual_class;
    }
    match factor.series() {
        Series::D => weight.labels().iter().rev().ge(dual.labels().iter().rev()),
        _ => weight.labels() >= dual.labels(),
    }
}

/// A search for the representations up to a dimension. Dimensions are floats, whose error is below
/// `1e-13` of them for the 120 roots of E8, so they are exact after rounding up to [`MAX_NAMED`].
struct Search {
    /// The coefficients of the factors of Weyl's formula: `1 + sum_i c_i λ_i` for each positive
    /// root.
    factors: Vec<Vec<f64>>,
    rank: usize,
    largest: f64,
}

impl Search {
    fn new(algebra: &ReductiveAlgebra, largest: u64) -> Self {
        let factors = algebra.positive_roots().iter().map(|root| {
            let height: i64 = root.coroot.iter().sum();
            root.coroot.iter().map(|c| *c as f64 / height as f64).collect()
        });
        let rank = algebra.semisimple_rank();
        Search { factors: factors.collect(), rank, largest: largest as f64 }
    }

    fn dimension(&self, labels: &[i64]) -> f64 {
        let factor = |row: &Vec<f64>| {
            1.0 + row.iter().zip(labels).map(|(c, label)| c * *label as f64).sum::<f64>()
        };
        self.factors.iter().map(factor).product::<f64>().round()
    }

    /// Visits the labels of the representations with their dimensions.
    fn collect(&self, visit: &mut dyn FnMut(&[i64], u64)) {
        if self.rank > 0 {
            self.collect_from(&mut vec![0; self.rank], 0, visit);
        }
    }

    /// Varies the labels from a position on. The dimension grows with each label, so each label
    /// ends when the largest dimension is exceeded.
    fn collect_from(&self, labels: &mut [i64], at: usize, visit: &mut dyn FnMut(&[i64], u64)) {
        affinor_tensors::stop::checkpoint();
        loop {
            let dimension = self.dimension(labels);
            if dimension > self.largest {
                break;
            }
            match at + 1 < self.rank {
                true => self.collect_from(labels, at + 1, visit),
                false => visit(labels, dimension as u64),
            }
            labels[at] += 1;
        }
        labels[at] = 0;
    }
}
