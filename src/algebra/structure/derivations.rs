//! Dimensions of derivations, of the centroid and of invariant symmetric forms (de Graaf 1.9, 1.11).

use super::reduction::Reduction;
use super::{Ground, Structure};
use affinor_tensors::linear::modular::Residues;

/// The largest dimension of an algebra, not reductive, whose derivations are counted.
pub const MAX_DIMENSION: usize = 30;

impl<S: Ground> Structure<S> {
    /// Whether [`derivations`](Self::derivations) follows from a theorem. Otherwise it is read from a rank modulo two
    /// primes, and the true dimension is at most this.
    pub fn derivations_by_theorem(&self) -> bool {
        self.is_semisimple() || self.dimension() > MAX_DIMENSION || self.is_abelian()
    }

    /// The dimension of the derivations; `None` beyond [`MAX_DIMENSION`] unless the algebra is reductive.
    /// Derivations of a semisimple algebra are inner (de Graaf 4.5); those of `s + z` are `ad s + gl(z)`.
    pub fn derivations(&self) -> Option<usize> {
        let n = self.dimension();
        if self.is_semisimple() {
            return Some(n);
        }
        if self.derivations_by_theorem() {
            let z = self.radical().dimension();
            return self.is_reductive().then_some(n - z + z * z);
        }
        let equations = |reduction: &Reduction| reduction.derivation_equations().rank();
        Some(n * n - self.rank_modulo_primes(equations))
    }

    /// The dimension of the symmetric forms with `B([x,y],z) = B(x,[y,z])`; `None` beyond [`MAX_DIMENSION`]
    /// unless the algebra is reductive: then a form for each simple factor over the complex numbers, and all on the centre.
    pub fn invariant_forms(&self) -> Option<usize> {
        let n = self.dimension();
        if n > MAX_DIMENSION {
            let z = self.radical().dimension();
            let factors = self.is_reductive().then(|| self.dynkin_type())??;
            return Some(factors.len() + z * (z + 1) / 2);
        }
        let equations = |reduction: &Reduction| reduction.form_equations().rank();
        Some(n * (n + 1) / 2 - self.rank_modulo_primes(equations))
    }
}

impl Reduction {
    /// `D[x,e_j] = [Dx,e_j] + [x,De_j]` for generators `x`, in the unknowns `D^a_b` at `a n + b`. A map
    /// that satisfies it for generators satisfies it for all `x`.
    fn derivation_equations(&self) -> Residues {
        let (n, p) = (self.dimension(), self.prime());
        let mut rows = vec![];
        for x in self.generators() {
            let ad = self.ad(&x);
            for j in 0..n {
                // component i of each side
                let mut block = vec![vec![0; n * n]; n];
                for (i, row) in block.iter_mut().enumerate() {
                    for b in 0..n {
                        row[i * n + b] = p.add(row[i * n + b], ad.rows()[b][j]);
                        let at = b * n + j;
                        row[at] = p.add(row[at], p.neg(ad.rows()[i][b]));
                    }
                }
                // -[Dx, e_j] = [e_j, e_a] D^a_b x_b
                for &(a, i, value) in self.of(j) {
                    for (b, &component) in x.iter().enumerate() {
                        let at = a * n + b;
                        block[i][at] = p.reduce(block[i][at] + value * component);
                    }
                }
                rows.extend(block);
            }
        }
        Residues::new(p, n * n, rows)
    }

    /// `B([x,e_j],e_k) + B(e_j,[x,e_k]) = 0` for generators `x`, in the unknowns `B_jk` with `j <= k`.
    fn form_equations(&self) -> Residues {
        let (n, p) = (self.dimension(), self.prime());
        let at = |j: usize, k: usize| {
            let (j, k) = (j.min(k), j.max(k));
            j * (2 * n - j + 1) / 2 + k - j
        };
        let mut rows = vec![];
        for x in self.generators() {
            let ad = self.ad(&x);
            for j in 0..n {
                for k in j..n {
                    let mut row = vec![0; n * (n + 1) / 2];
                    for i in 0..n {
                        row[at(i, k)] = p.add(row[at(i, k)], ad.rows()[i][j]);
                        row[at(j, i)] = p.add(row[at(j, i)], ad.rows()[i][k]);
                    }
                    rows.push(row);
                }
            }
        }
        Residues::new(p, n * (n + 1) / 2, rows)
    }
}
