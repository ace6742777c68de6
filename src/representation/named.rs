//! Subalgebras by a text: a name, nodes of a diagram, a representation or a projection.

use super::names::irreducible;
use super::subalgebra::not_a_subalgebra;
use super::{Decomposition, HighestWeight, ReductiveAlgebra, RepresentationError, Subalgebra};
use crate::algebra::roots::{CartanType, numbering};
use crate::representation::embeddings::defining_dimension;
use affinor_tensors::stop::checkpoint;

/// The forms of the text, for messages.
const FORMS: &str = "write a name such as SU(3)xSU(2)xU(1), `levi 3`, `extended 4`, `principal`, \
     `sl2 2,0`, `SU(3)xSU(2): (3,2)` or `A1: [[2,2]]`";

impl Subalgebra {
    /// Reads a subalgebra in one of these forms:
    ///
    /// | text | subalgebra |
    /// |---|---|
    /// | `levi 3`, `levi 2,3` | [`Subalgebra::levi`] |
    /// | `extended 4` | [`Subalgebra::borel_de_siebenthal`]; nodes count through all factors |
    /// | `principal` | [`Subalgebra::principal_sl2`] |
    /// | `sl2 2,0` | [`Subalgebra::sl2`] with these values |
    /// | `SU(3)xSU(2): (3,2)` | [`Subalgebra::by_representation`], with `;` between the components |
    /// | `A1: [[2,2]]` | [`Subalgebra::by_projection`] |
    /// | `SU(3)xSU(2)xU(1)` | the first subalgebra of this type in the order below |
    ///
    /// A name is searched among the subalgebras of Borel and de Siebenthal, then the Levi
    /// subalgebras, by increasing numbers of nodes. For a simple algebra, the restriction of the
    /// defining representation follows: first an irreducible one, then a sum of one small
    /// representation for each factor and of trivial ones. [`Subalgebra::description`] states the
    /// result of the search.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if the text has another form or no subalgebra is
    /// found, and the errors of the named functions.
    ///
    /// ```
    /// use affinor::representation::{ReductiveAlgebra, Subalgebra};
    /// let so10: ReductiveAlgebra = "SO(10)".parse()?;
    /// let pati_salam = Subalgebra::parse(&so10, "SU(4) x SU(2) x SU(2)")?;
    /// assert_eq!(pati_salam.description(), "extended diagram without node 2");
    /// let so9 = Subalgebra::parse(&so10, "SO(9)")?;
    /// assert_eq!(so9.description(), "defining representation 1 + 9");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn parse(ambient: &ReductiveAlgebra, text: &str) -> Result<Self, RepresentationError> {
        let text = text.trim();
        let wrong = |reason: &str| not_a_subalgebra(ambient, format!("`{text}`"), reason);
        let (word, rest) = text.split_once(' ').unwrap_or((text, ""));
        let numbers = |text: &str| -> Result<Vec<usize>, RepresentationError> {
            let numbers = text.split(',').map(|number| number.trim().parse().ok());
            let numbers: Option<Vec<usize>> = numbers.collect();
            numbers.filter(|all| all.iter().all(|n| *n <= 99)).ok_or_else(|| wrong(FORMS))
        };
        match word {
            "levi" => return Self::levi(ambient, &numbers(rest)?),
            "principal" if rest.is_empty() => return Self::principal_sl2(ambient),
            "sl2" if !rest.is_empty() => {
                let values: Vec<i64> = numbers(rest)?.into_iter().map(|n| n as i64).collect();
                return Self::sl2(ambient, &values);
            }
            "extended" => {
                let [node] = numbers(rest)?[..] else { return Err(wrong(FORMS)) };
                return Self::extended(ambient, node);
            }
            _ => {}
        }
        let (name, data) = match text.split_once(':') {
            Some((name, data)) => (name, Some(data.trim())),
            None => (text, None),
        };
        let algebra: ReductiveAlgebra = name
            .parse()
            .map_err(|error: RepresentationError| wrong(&format!("{error}; {FORMS}")))?;
        match data {
            Some(rows) if rows.starts_with("[[") => {
                let inner = rows.strip_prefix("[[").and_then(|rows| rows.strip_suffix("]]"));
                let rows = inner.ok_or_else(|| wrong(FORMS))?.split(']').map(|row| {
                    let row = row.trim_start_matches([',', ' ', '[']);
                    let entries = row.split(',').map(|entry| entry.trim().parse().ok());
                    entries.collect::<Option<Vec<i64>>>()
                });
                let rows: Option<Vec<Vec<i64>>> = rows.collect();
                Self::by_projection(ambient, &algebra, rows.ok_or_else(|| wrong(FORMS))?)
            }
            Some(components) => {
                let mut sum = Decomposition::of(&algebra, vec![]);
                for component in components.split(';') {
                    let weight = HighestWeight::parse(&algebra, component)?;
                    sum = sum.plus(&Decomposition::irreducible(&weight), 1)?;
                }
                Self::by_representation(ambient, &sum)
            }
            None => search(ambient, &algebra)
                .ok_or_else(|| wrong(&format!("no subalgebra of this type is known; {FORMS}"))),
        }
    }

    /// The subalgebra of Borel and de Siebenthal without a node, which counts through all factors.
    fn extended(ambient: &ReductiveAlgebra, node: usize) -> Result<Self, RepresentationError> {
        let factors = 0..ambient.simple_factors().len();
        let positions = |factor: &usize| ambient.positions(*factor);
        let mut found = factors.filter(|factor| positions(factor).contains(&node.wrapping_sub(1)));
        let factor = found.next().unwrap_or(ambient.simple_factors().len());
        let start = ambient.positions(factor).start;
        Self::borel_de_siebenthal(ambient, factor, node.saturating_sub(start))
    }
}

/// The first subalgebra of a type.
fn search(ambient: &ReductiveAlgebra, algebra: &ReductiveAlgebra) -> Option<Subalgebra> {
    let rank = ambient.semisimple_rank();
    if algebra.rank() == ambient.rank() {
        let extended = (1..=rank).filter_map(|node| Subalgebra::extended(ambient, node).ok());
        let removed = algebra.abelian_dimension().checked_sub(ambient.abelian_dimension());
        let levi = removed.into_iter().flat_map(|count| subsets(rank, count));
        let levi = levi.filter_map(|nodes| Subalgebra::levi(ambient, &nodes).ok());
        let found = extended.chain(levi).find_map(|found| found.in_the_order_of(algebra));
        if found.is_some() {
            return found;
        }
    }
    let [factor] = ambient.simple_factors() else { return None };
    let dimension = defining_dimension(*factor) as u64;
    if algebra.abelian_dimension() > 0 || ambient.abelian_dimension() > 0 {
        return None;
    }
    let factors = algebra.simple_factors();
    let by = |defining: &Decomposition| Subalgebra::by_representation(ambient, defining).ok();
    for labels in irreducible_of_dimension(factors, dimension) {
        let weight = HighestWeight::new(algebra, labels).ok()?;
        if let Some(found) = by(&Decomposition::irreducible(&weight)) {
            return Some(found);
        }
    }
    // one small representation for each factor
    let mut choices = vec![(vec![], 0)];
    for (at, simple) in factors.iter().enumerate() {
        let small = (2..=dimension.min(56))
            .flat_map(|d| irreducible(*simple, d).into_iter().map(move |labels| (labels, d)));
        let small: Vec<_> = small.take(4).collect();
        let mut longer: Vec<(Vec<HighestWeight>, u64)> = vec![];
        for (chosen, sum) in &choices {
            for (labels, d) in &small {
                let mut all = vec![0; algebra.rank()];
                all[algebra.positions(at)].copy_from_slice(labels);
                if sum + d <= dimension {
                    let weight = HighestWeight::new(algebra, all).ok()?;
                    longer.push(([chosen.clone(), vec![weight]].concat(), sum + d));
                }
            }
        }
        longer.truncate(4096);
        choices = longer;
    }
    choices.into_iter().find_map(|(weights, sum)| {
        checkpoint();
        let rest = i128::from(dimension - sum);
        let start = Decomposition::of(algebra, vec![]);
        let trivial = Decomposition::irreducible(&HighestWeight::trivial(algebra));
        let all = weights.iter().try_fold(start.plus(&trivial, rest).ok()?, |all, weight| {
            all.plus(&Decomposition::irreducible(weight), 1).ok()
        });
        by(&all?)
    })
}

/// The labels of the irreducible representations of a sum of simple algebras that have a dimension
/// and are not trivial on any factor.
fn irreducible_of_dimension(factors: &[CartanType], dimension: u64) -> Vec<Vec<i64>> {
    let Some((first, rest)) = factors.split_first() else {
        return if dimension == 1 { vec![vec![]] } else { vec![] };
    };
    let mut found = vec![];
    for d in (2..=dimension).filter(|d| dimension.is_multiple_of(*d)) {
        let others = irreducible_of_dimension(rest, dimension / d);
        if !others.is_empty() {
            for labels in irreducible(*first, d) {
                found.extend(others.iter().map(|other| [&labels[..], other].concat()));
            }
        }
    }
    found
}

/// The sets of `count` numbers from 1 to `n`.
fn subsets(n: usize, count: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![vec![]];
    for _ in 0..count {
        let longer = all.iter().flat_map(|set| {
            let next = set.last().map_or(1, |last| last + 1);
            (next..=n).map(move |node| [&set[..], &[node]].concat())
        });
        all = longer.take(100_000).collect();
    }
    all
}

impl Subalgebra {
    /// The same subalgebra with the factors and the numbering of an isomorphic algebra. `None` if
    /// the algebras are not isomorphic.
    fn in_the_order_of(&self, wanted: &ReductiveAlgebra) -> Option<Self> {
        let own = self.algebra();
        let same = own.semisimple_rank() == wanted.semisimple_rank() && own.rank() == wanted.rank();
        if !same || own.dimension() != wanted.dimension() {
            return None;
        }
        let rank = own.semisimple_rank();
        let mut cartan = vec![vec![0; rank]; rank];
        for (i, row) in cartan.iter_mut().enumerate() {
            row[i] = 2;
            own.neighbours(i).iter().for_each(|&(j, entry)| row[j] = entry);
        }
        let mut open: Vec<_> = (0..own.simple_factors().len()).collect();
        let mut rows = vec![];
        for factor in wanted.simple_factors() {
            let at = open.iter().position(|&found| {
                let component: Vec<usize> = own.positions(found).collect();
                let fits = component.len() == factor.rank();
                let nodes = fits.then(|| numbering(&cartan, &factor.cartan_matrix(), &component));
                let nodes = nodes.flatten();
                rows.extend(nodes.iter().flatten());
                nodes.is_some()
            })?;
            open.remove(at);
        }
        rows.extend(rank..own.rank());
        let projection = rows.into_iter().map(|row| self.projection()[row].clone()).collect();
        let found = Self::by_projection(self.ambient(), wanted, projection).ok()?;
        Some(found.described(self.description()))
    }
}
