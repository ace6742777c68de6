//! Betti numbers: the dimensions of Chevalley-Eilenberg cohomology with trivial coefficients.

use super::certificates::Certified;
use super::dynkin::exponents;
use super::reduction::ModularAlgebra;
use super::subspace::collected;
use super::{GroundField, StructureTheory};
use affinor_tensors::stop::{checkpoint, stage};
use polycore::Lead;
use polycore::modp_echelon::Echelon;
use std::collections::BTreeMap;

/// The largest dimension at which closed forms of all degrees are lifted to the rationals and
/// verified.
const MAX_CERTIFIED: usize = 11;
/// The largest dimension at which the ranks of all differentials are computed modulo primes.
pub const MAX_DIMENSION: usize = 18;
/// Limits beyond [`MAX_CERTIFIED`]: the number of forms of one degree, and its product with the
/// number of structure constants.
const MAX_ROWS: usize = 13_000;
const MAX_WORK: usize = 1_500_000;

/// Larger Betti numbers are not returned.
const LARGEST: u64 = 1 << 53;

impl<S: GroundField> StructureTheory<S> {
    /// The Betti numbers `b_0, ..., b_n`. Unless the algebra is reductive, the method returns
    /// `None` beyond [`MAX_DIMENSION`], or if the differentials have too many entries. It also
    /// returns `None` if a number exceeds `2^53`, because floats represent all integers only up to
    /// this limit.
    ///
    /// The Poincaré polynomial of a reductive algebra is `(1+t)^z prod (1 + t^(2m+1))`, with the
    /// dimension `z` of the centre and the exponents `m` of its simple factors.
    ///
    /// The flag tells whether the numbers are proved: by a theorem, or, up to dimension 11, by
    /// verified closed forms. Beyond dimension 11, they follow from ranks modulo two primes. In a
    /// unimodular algebra, `d` on `Lambda^k` has the same rank as `d` on `Lambda^(n-1-k)` (Poincare
    /// duality).
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("heisenberg(3)")?);
    /// assert_eq!(algebra.betti_numbers(), Some((vec![1, 2, 2, 1], true)));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("cohomology", "Chevalley-Eilenberg"))]
    pub fn betti_numbers(&self) -> Option<(Vec<u64>, bool)> {
        let _stage = stage("cohomology");
        let n = self.dimension();
        if n <= MAX_CERTIFIED {
            let mut closed: Vec<Certified> = vec![];
            for k in 0..=n {
                let dual = n.checked_sub(k + 1).filter(|dual| *dual < k && self.is_unimodular());
                closed.push(match dual.map(|dual| (dual, closed[dual])) {
                    Some((dual, Certified { dimension, proved })) => {
                        let rank = binomial(n, dual) - dimension;
                        Certified { dimension: binomial(n, k) - rank, proved }
                    }
                    None => self.closed_forms(k),
                });
            }
            let rank = |k: usize| binomial(n, k) - closed[k].dimension;
            let exact = |k: usize| if k == 0 { 0 } else { rank(k - 1) };
            let betti = (0..=n).map(|k| (closed[k].dimension - exact(k)) as u64);
            return Some((betti.collect(), closed.iter().all(|counted| counted.proved)));
        }
        if !self.is_reductive() {
            return Some((self.betti_modulo_primes()?, false));
        }
        let degrees = self.dynkin_type()?.into_iter().flat_map(exponents);
        let degrees = degrees.map(|m| 2 * m + 1);
        let lines = std::iter::repeat_n(1, self.radical().dimension());
        let mut polynomial = vec![1];
        for degree in degrees.chain(lines) {
            let mut product = polynomial.clone();
            product.resize(polynomial.len() + degree, 0);
            polynomial.iter().enumerate().for_each(|(at, value)| product[at + degree] += value);
            if product.iter().any(|value| *value > LARGEST) {
                return None;
            }
            polynomial = product;
        }
        Some((polynomial, true))
    }

    /// The Betti numbers from the ranks modulo two primes; if these differ, the larger rank is
    /// used.
    fn betti_modulo_primes(&self) -> Option<Vec<u64>> {
        let (n, duality) = (self.dimension(), self.is_unimodular());
        let mut best: Option<Vec<Vec<u64>>> = None;
        for reduction in self.reductions().take(2) {
            let [forms, ranks] = reduction.ranks_of_differentials(duality)?;
            best = Some(match best {
                // combines the ranks only if the numbers of forms agree modulo both primes
                Some(known) if known[0] == forms => {
                    let larger = known[1].iter().zip(&ranks).map(|(a, b)| *a.max(b)).collect();
                    vec![forms, larger]
                }
                _ => vec![forms, ranks],
            });
        }
        let [forms, ranks] = &best?[..] else { return None };
        let exact = |k: usize| if k == 0 { 0 } else { ranks[k - 1] };
        (0..=n).map(|k| forms[k].checked_sub(ranks[k])?.checked_sub(exact(k))).collect()
    }

    /// The dimension of the space of closed forms of degree `k`.
    fn closed_forms(&self, k: usize) -> Certified {
        let n = self.dimension();
        let sets: Vec<usize> =
            (0..1usize << n).filter(|set| set.count_ones() as usize == k).collect();
        let kernel = |reduction: &ModularAlgebra| reduction.closed_forms(&sets);
        self.counted(sets.len(), kernel, |structure, form| {
            let image = form.iter().flat_map(|(at, factor)| {
                let terms = differential(n, |j| structure.products.of(j), sets[*at]);
                terms.into_iter().map(move |(to, minus, c)| {
                    let value = c.clone() * factor;
                    (to, if minus { -value } else { value })
                })
            });
            collected(image.collect()).is_empty()
        })
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (0..k).fold(1, |value, i| value * (n - i) / (i + 1))
}

impl ModularAlgebra {
    /// The dimensions of a complex whose cohomology is the cohomology of the algebra, and the ranks
    /// of its differentials, by degree. Returns `None` if the matrices are too large. If `duality`
    /// is set, the ranks above the middle degree are copied from the ranks below it.
    ///
    /// A derivation `ad_x` acts as zero on cohomology. If `ad_x` is diagonal in the basis, the
    /// forms of weight zero are therefore sufficient. Forms that are pivots of exact forms are
    /// omitted, because they are closed up to other forms (`d d = 0`).
    fn ranks_of_differentials(&self, duality: bool) -> Option<[Vec<u64>; 2]> {
        let (n, p) = (self.dimension(), self.prime());
        if n > MAX_DIMENSION {
            return None;
        }
        let is_diagonal = |j: &usize| self.of(*j).iter().all(|(k, i, _)| k == i);
        let weights = (0..n).filter(is_diagonal).map(|j| {
            let mut weights = vec![0; n];
            self.of(j).iter().for_each(|&(k, _, value)| weights[k] = value);
            weights
        });
        let weights: Vec<Vec<u64>> = weights.filter(|w| w.iter().any(|v| *v != 0)).collect();
        let elements = |set: usize| (0..n).filter(move |i| set >> i & 1 == 1);
        let invariant = |set: &usize| {
            let weight = |w: &Vec<u64>| elements(*set).fold(0, |sum, i| p.add(sum, w[i]));
            weights.iter().all(|w| weight(w) == 0)
        };
        let mut sets: Vec<Vec<usize>> = vec![vec![]; n + 1];
        for set in (0..1usize << n).filter(invariant) {
            checkpoint();
            sets[set.count_ones() as usize].push(set);
        }
        let rows = sets.iter().map(Vec::len).max().unwrap_or(0);
        let constants: usize = (0..n).map(|j| self.of(j).len() / 2).sum();
        if rows > MAX_ROWS || rows * constants > MAX_WORK {
            return None;
        }
        let mut ranks: Vec<u64> = vec![];
        let mut exact = vec![false; 1 << n];
        for (k, sets) in sets.iter().enumerate() {
            if let Some(&dual) = n.checked_sub(k + 1).and_then(|dual| ranks.get(dual))
                && duality
            {
                ranks.push(dual);
                continue;
            }
            let mut echelon = Echelon::new(Lead::Low, p.get());
            let mut pivots = vec![];
            for &set in sets.iter().filter(|set| !exact[**set]) {
                checkpoint();
                let terms = differential(n, |j| self.of(j), set).into_iter();
                let row = terms.map(|(to, minus, &c)| (to, if minus { p.neg(c) } else { c }));
                pivots.extend(echelon.insert(&row.collect::<Vec<_>>()));
            }
            pivots.iter().for_each(|pivot| exact[*pivot] = true);
            ranks.push(pivots.len() as u64);
        }
        Some([sets.iter().map(|sets| sets.len() as u64).collect(), ranks])
    }

    /// A basis of the closed forms that are combinations of the forms with these index `sets`, in
    /// reduced echelon form.
    fn closed_forms(&self, sets: &[usize]) -> Vec<Vec<u64>> {
        let (n, p) = (self.dimension(), self.prime());
        let mut equations: BTreeMap<usize, Vec<(usize, u64)>> = BTreeMap::new();
        for (at, &set) in sets.iter().enumerate() {
            checkpoint();
            for (to, minus, &value) in differential(n, |j| self.of(j), set) {
                let value = if minus { p.neg(value) } else { value };
                equations.entry(to).or_default().push((at, value));
            }
        }
        let mut echelon = Echelon::new(Lead::Low, p.get());
        equations.values().for_each(|row| {
            checkpoint();
            echelon.insert(row);
        });
        let dense = |row: Vec<(usize, u64)>| {
            let mut vector = vec![0; sets.len()];
            row.into_iter().for_each(|(at, value)| vector[at] = value);
            vector
        };
        echelon.nullspace(sets.len()).into_iter().map(dense).collect()
    }
}

/// The terms `(set, minus, c)` of `d e^set`, of `d e^set`, where
/// `d e^i = -sum over j < l of c^i_jl e^j e^l`; `minus` marks a negative sign.
pub(super) fn differential<'a, V>(
    n: usize,
    of: impl Fn(usize) -> &'a [(usize, usize, V)],
    set: usize,
) -> Vec<(usize, bool, &'a V)> {
    let odd = |passed: usize| passed.count_ones() % 2 == 1;
    let mut terms = vec![];
    for i in (0..n).filter(|i| set >> i & 1 == 1) {
        let rest = set & !(1 << i);
        let below = |at: usize| odd(rest & ((1 << at) - 1));
        for j in (0..n).filter(|j| rest >> j & 1 == 0) {
            for (l, component, value) in of(j) {
                if *component == i && *l > j && rest >> l & 1 == 0 {
                    // the sign of the permutation that sorts e^j e^l into the set, in place of e^i
                    let minus = !(below(i) ^ below(j) ^ below(*l));
                    terms.push((rest | 1 << j | 1 << l, minus, value));
                }
            }
        }
    }
    terms
}
