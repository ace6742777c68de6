//! Betti numbers: the dimensions of Chevalley-Eilenberg cohomology with trivial coefficients.

use super::dynkin::exponents;
use super::reduction::Reduction;
use super::{Ground, Structure};
use affinor_tensors::linear::modular::Prime;
use polycore::Lead;
use polycore::modp_echelon::Echelon;

/// The largest dimension at which the ranks of all differentials are computed.
pub const MAX_DIMENSION: usize = 11;

/// The largest Betti number that is given.
const LARGEST: u64 = 1 << 53;

impl<S: Ground> Structure<S> {
    /// The Betti numbers `b_0, .., b_n`; `None` beyond [`MAX_DIMENSION`] unless the algebra is reductive, and
    /// where one is beyond `2^53`, the whole numbers of a float.
    ///
    /// The polynomial of a reductive algebra is `(1+t)^z prod (1 + t^(2m+1))`, with the dimension `z` of
    /// the centre and the exponents `m` of its simple factors.
    pub fn betti(&self) -> Option<Vec<u64>> {
        let n = self.dimension();
        if n <= MAX_DIMENSION {
            let images = self.reductions().take(2).map(|reduction| reduction.ranks());
            let ranks = images.reduce(|a, b| a.iter().zip(&b).map(|(a, b)| *a.max(b)).collect())?;
            // rank of d on Lambda^(k-1) and on Lambda^k
            let betti = |k: usize| (binomial(n, k) - ranks[k] - ranks[k + 1]) as u64;
            return Some((0..=n).map(betti).collect());
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
        Some(polynomial)
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (0..k).fold(1, |value, i| value * (n - i) / (i + 1))
}

impl Reduction {
    /// The ranks of `0 -> Lambda^0 -> .. -> Lambda^n -> 0`.
    fn ranks(&self) -> Vec<usize> {
        let n = self.dimension();
        let inner = (0..n).map(|k| self.rank_of_differential(k));
        [0].into_iter().chain(inner).chain([0]).collect()
    }

    /// The rank of `d: Lambda^k -> Lambda^(k+1)`, `d e^i = -sum over j < l of c^i_jl e^j e^l`.
    fn rank_of_differential(&self, k: usize) -> usize {
        let (n, p) = (self.dimension(), self.prime());
        let mut echelon = Echelon::new(Lead::Low, p.get());
        for set in (0..1usize << n).filter(|set| set.count_ones() as usize == k) {
            let mut image: Vec<(usize, u64)> = vec![];
            for i in (0..n).filter(|i| set >> i & 1 == 1) {
                let rest = set & !(1 << i);
                let before = sign(p, rest & ((1 << i) - 1));
                for j in (0..n).filter(|j| rest >> j & 1 == 0) {
                    for &(l, component, value) in self.of(j) {
                        if component != i || l <= j || rest >> l & 1 == 1 {
                            continue;
                        }
                        // e^j e^l in the place of e^i, then sorted
                        let below = |at: usize| rest & ((1 << at) - 1);
                        let turn = p.mul(sign(p, below(j)), sign(p, below(l)));
                        let value = p.mul(p.neg(value), p.mul(before, turn));
                        image.push((rest | 1 << j | 1 << l, value));
                    }
                }
            }
            echelon.insert(&image);
        }
        echelon.rank()
    }
}

/// The sign of moving a factor past a set of others.
fn sign(p: Prime, passed: usize) -> u64 {
    if passed.count_ones().is_multiple_of(2) { 1 } else { p.neg(1) }
}
