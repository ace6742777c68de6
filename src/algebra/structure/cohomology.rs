//! Betti numbers: the dimensions of Chevalley-Eilenberg cohomology with trivial coefficients.

use super::certificates::Certified;
use super::dynkin::exponents;
use super::reduction::ModularAlgebra;
use super::subspace::collected;
use super::{GroundField, StructureTheory};
use polycore::Lead;
use polycore::modp_echelon::Echelon;
use std::collections::BTreeMap;

/// The largest dimension at which the ranks of all differentials are computed.
pub const MAX_DIMENSION: usize = 11;

/// The largest Betti number that is given.
const LARGEST: u64 = 1 << 53;

impl<S: GroundField> StructureTheory<S> {
    /// The Betti numbers `b_0, .., b_n`; `None` beyond [`MAX_DIMENSION`] unless the algebra is reductive, and
    /// where one is beyond `2^53`, the whole numbers of a float.
    ///
    /// The polynomial of a reductive algebra is `(1+t)^z prod (1 + t^(2m+1))`, with the dimension `z` of
    /// the centre and the exponents `m` of its simple factors.
    ///
    /// The numbers come with whether they are proved: by a theorem, or by closed forms multiplied out. In a unimodular algebra
    /// `d` on `Lambda^k` has the rank of `d` on `Lambda^(n-1-k)` (Poincare duality).
    pub fn betti_numbers(&self) -> Option<(Vec<u64>, bool)> {
        let n = self.dimension();
        if n <= MAX_DIMENSION {
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
            return None;
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

    /// The closed forms of degree `k`.
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
    /// A basis of the closed forms among those with these index sets, in reduced echelon form.
    fn closed_forms(&self, sets: &[usize]) -> Vec<Vec<u64>> {
        let (n, p) = (self.dimension(), self.prime());
        let mut equations: BTreeMap<usize, Vec<(usize, u64)>> = BTreeMap::new();
        for (at, &set) in sets.iter().enumerate() {
            for (to, minus, &value) in differential(n, |j| self.of(j), set) {
                let value = if minus { p.neg(value) } else { value };
                equations.entry(to).or_default().push((at, value));
            }
        }
        let mut echelon = Echelon::new(Lead::Low, p.get());
        equations.values().for_each(|row| {
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

/// The terms `(set, minus, c)` of `d e^set`, with `d e^i = -sum over j < l of c^i_jl e^j e^l`.
fn differential<'a, V>(
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
                    // e^j e^l in the place of e^i, then sorted
                    let minus = !(below(i) ^ below(j) ^ below(*l));
                    terms.push((rest | 1 << j | 1 << l, minus, value));
                }
            }
        }
    }
    terms
}
