//! Regular subalgebras, whose roots are roots of the algebra, and subalgebras sl(2).

use super::algebra::PositiveRoot;
use super::subalgebra::not_a_subalgebra;
use super::{ReductiveAlgebra, RepresentationError, Subalgebra};
use crate::algebra::roots::{CartanType, Series, identify};
use crate::algebra::structure::coprime;
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

impl Subalgebra {
    /// The Levi subalgebra whose Dynkin diagram is the diagram of the algebra without some nodes,
    /// which count from 1 through all simple factors.
    ///
    /// Each removed node `k` gives a charge: the multiple of `<λ, ω_k^∨>`, with the fundamental
    /// coweight `ω_k^∨`, whose values on the fundamental weights are coprime integers.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if there is no node with a number.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let e6: ReductiveAlgebra = "E6".parse()?;
    /// let so10 = Subalgebra::levi(&e6, &[6])?;
    /// let restriction = so10.branch(&HighestWeight::parse(&e6, "27")?)?;
    /// assert_eq!(restriction.to_string(), "1(-4) + 10(2) + 16bar(-1)");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn levi(
        ambient: &ReductiveAlgebra,
        removed: &[usize],
    ) -> Result<Self, RepresentationError> {
        let rank = ambient.semisimple_rank();
        if let Some(node) = removed.iter().find(|node| !(1..=rank).contains(node)) {
            let reason = format!("the diagram has no node {node}, only 1 to {rank}");
            return Err(not_a_subalgebra(ambient, "the Levi subalgebra", reason));
        }
        let simple = simple_roots(ambient);
        let kept = (0..rank).filter(|i| !removed.contains(&(i + 1)));
        let base: Vec<BaseRoot> = kept.map(|i| BaseRoot::of(simple[i], 1)).collect();
        let mut nodes: Vec<usize> = removed.iter().map(|node| node - 1).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let charges = nodes.iter().map(|&node| {
            let others = (0..rank).filter(|i| *i != node);
            functionals(rank, others.map(|i| &simple[i].labels[..])).pop().unwrap_or_default()
        });
        let names: Vec<String> = nodes.iter().map(|node| (node + 1).to_string()).collect();
        let plural = if names.len() == 1 { "" } else { "s" };
        let description = format!("Levi subalgebra without node{plural} {}", names.join(", "));
        Ok(by_base(ambient, base, charges.collect())?.described(description))
    }

    /// The semisimple subalgebra of Borel and de Siebenthal: the extended Dynkin diagram of a
    /// simple factor without a node. Factors count from 0; nodes count from 1 in the factor.
    ///
    /// The new simple root is the negative of the highest root. The subalgebra is maximal if the
    /// coefficient of the node in the highest root is a prime number.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if there is no factor or no node with the number.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// let so16 = Subalgebra::borel_de_siebenthal(&e8, 0, 1)?;
    /// let restriction = so16.branch(&HighestWeight::parse(&e8, "248")?)?;
    /// assert_eq!(restriction.to_string(), "120 + 128'");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn borel_de_siebenthal(
        ambient: &ReductiveAlgebra,
        factor: usize,
        node: usize,
    ) -> Result<Self, RepresentationError> {
        let positions = ambient.positions(factor);
        let highest = ambient.roots_of(factor).last();
        let (Some(highest), true) = (highest, (1..=positions.len()).contains(&node)) else {
            let reason = format!("the extended diagram has no node {node} to remove");
            return Err(not_a_subalgebra(ambient, "the subalgebra", reason));
        };
        let simple = simple_roots(ambient).into_iter().enumerate();
        let kept = simple.filter(|(i, _)| *i + 1 != positions.start + node);
        let mut base: Vec<BaseRoot> = kept.map(|(_, root)| BaseRoot::of(root, 1)).collect();
        base.push(BaseRoot::of(highest, -1));
        let node = positions.start + node;
        let description = format!("extended diagram without node {node}");
        Ok(by_base(ambient, base, vec![])?.described(description))
    }

    /// The subalgebra sl(2) with a weighted Dynkin diagram: the values of the simple roots at `h`.
    /// Every subalgebra sl(2) is conjugate to one whose values are 0, 1 or 2 (Jacobson and Morozov,
    /// Dynkin).
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if the adjoint representation has no decomposition
    /// or the values are not integers on all weights.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let g2: ReductiveAlgebra = "G2".parse()?;
    /// let long_root = Subalgebra::sl2(&g2, &[0, 1])?;
    /// let restriction = long_root.branch(&HighestWeight::parse(&g2, "7")?)?;
    /// assert_eq!(restriction.to_string(), "3 (1) + 2 (2)");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn sl2(ambient: &ReductiveAlgebra, values: &[i64]) -> Result<Self, RepresentationError> {
        let wrong = |reason: &str| not_a_subalgebra(ambient, "sl(2)", reason);
        let rank = ambient.semisimple_rank();
        if values.len() != rank || values.iter().any(|value| !(0..=2).contains(value)) {
            return Err(wrong("the weighted diagram needs one value 0, 1 or 2 for each node"));
        }
        let row = solved(ambient, values);
        let row = row.ok_or_else(|| wrong("h has a value on a weight that is not an integer"))?;
        let sl2 = ReductiveAlgebra::new(CartanType::new(Series::A, 1).ok(), 0);
        let sl2 = Self::by_projection(ambient, &sl2, vec![row])?;
        let text: Vec<String> = values.iter().map(ToString::to_string).collect();
        Ok(sl2.described(format!("weighted diagram {}", text.join(","))))
    }

    /// The principal subalgebra sl(2): all values of its weighted Dynkin diagram are 2.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if the algebra is abelian.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// let restriction = Subalgebra::principal_sl2(&e8)?.branch(&HighestWeight::parse(&e8, "248")?)?;
    /// // the dimensions are twice the exponents plus 1
    /// assert_eq!(restriction.to_string(), "3 + 15 + 23 + 27 + 35 + 39 + 47 + 59");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn principal_sl2(ambient: &ReductiveAlgebra) -> Result<Self, RepresentationError> {
        Self::sl2(ambient, &vec![2; ambient.semisimple_rank()])
    }
}

/// The integer functional on weights with these values on the simple roots, and 0 on charges.
/// `None` if it has a value on a fundamental weight that is not an integer.
pub(super) fn solved(ambient: &ReductiveAlgebra, values: &[i64]) -> Option<Vec<i64>> {
    // h = sum of x_i α_i^∨ with <α_j, h> = value_j
    let simple = simple_roots(ambient);
    let rows = simple.iter().map(|root| {
        root.labels.iter().copied().enumerate().map(|(i, label)| (i, Rational::from(label)))
    });
    let matrix = Matrix::from_rows(ambient.semisimple_rank(), rows).ok()?;
    let values: Vec<Rational> = values.iter().map(|value| Rational::from(*value)).collect();
    let x = matrix.solve(&values).ok()??;
    let mut row: Vec<i64> = x.iter().map(Rational::to_i64).collect::<Option<_>>()?;
    row.resize(ambient.rank(), 0);
    Some(row)
}

fn simple_roots(algebra: &ReductiveAlgebra) -> Vec<&PositiveRoot> {
    let roots = algebra.positive_roots().iter();
    let mut simple: Vec<&PositiveRoot> =
        roots.filter(|root| root.coefficients.iter().sum::<i64>() == 1).collect();
    simple.sort_by_key(|root| root.coefficients.iter().position(|c| *c == 1));
    simple
}

/// A simple root of a regular subalgebra.
struct BaseRoot {
    labels: Vec<i64>,
    coroot: Vec<i64>,
}

impl BaseRoot {
    fn of(root: &PositiveRoot, sign: i64) -> Self {
        let times = |values: &[i64]| values.iter().map(|value| sign * value).collect();
        BaseRoot { labels: times(&root.labels), coroot: times(&root.coroot) }
    }

    /// `<α, β^∨>`, with `β` this root.
    fn pair(&self, labels: &[i64]) -> i64 {
        self.coroot.iter().zip(labels).map(|(c, label)| c * label).sum()
    }
}

/// The subalgebra with simple roots among the roots of the algebra, and with charges. The charges
/// of the algebra are appended.
fn by_base(
    ambient: &ReductiveAlgebra,
    base: Vec<BaseRoot>,
    charges: Vec<Vec<i64>>,
) -> Result<Subalgebra, RepresentationError> {
    let cartan: Vec<Vec<i64>> = base
        .iter()
        .map(|left| base.iter().map(|right| right.pair(&left.labels)).collect())
        .collect();
    let Some(mut factors) = identify(&cartan) else {
        let reason = "the differences of its simple roots are roots";
        return Err(not_a_subalgebra(ambient, "the regular subalgebra", reason));
    };
    // large factors first; equal factors in the order of their nodes
    factors.sort_by_key(|(factor, _)| std::cmp::Reverse((factor.dimension(), factor.rank())));
    let (rank, own) = (ambient.semisimple_rank(), ambient.abelian_dimension());
    let extended = |mut row: Vec<i64>| {
        row.resize(rank + own, 0);
        row
    };
    let order = factors.iter().flat_map(|(_, nodes)| nodes);
    let mut projection: Vec<Vec<i64>> =
        order.map(|&node| extended(base[node].coroot.clone())).collect();
    let abelian = charges.len() + own;
    projection.extend(charges.into_iter().map(extended));
    projection.extend((rank..rank + own).map(|k| {
        let mut row = vec![0; rank + own];
        row[k] = 1;
        row
    }));
    let algebra = ReductiveAlgebra::new(factors.iter().map(|(factor, _)| *factor), abelian);
    Subalgebra::by_projection(ambient, &algebra, projection)
}

/// A basis of the integer vectors `x` with `sum of x_i l_i = 0` for all given lists of labels. The
/// entries of each vector are coprime. The first entry that is not 0 is positive.
fn functionals<'a>(rank: usize, labels: impl Iterator<Item = &'a [i64]>) -> Vec<Vec<i64>> {
    let rows = labels.map(|labels| {
        labels.iter().copied().enumerate().map(|(i, label)| (i, Rational::from(label)))
    });
    let Ok(matrix) = Matrix::from_rows(rank, rows) else { return vec![] };
    let Ok(space) = matrix.nullspace() else { return vec![] };
    space.to_dense().iter().filter_map(|vector| coprime(vector)).collect()
}
