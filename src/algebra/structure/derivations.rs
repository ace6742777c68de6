//! Dimensions of derivations, of the centroid and of invariant symmetric forms (de Graaf 1.9,
//! 1.11).

use super::certificates::Certified;
use super::reduction::ModularAlgebra;
use super::subspace::collected;
use super::{GroundField, StructureTheory};
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::ResidueMatrix;
use affinor_tensors::stop::stage;

/// The largest dimension at which derivations are counted, if the algebra is not reductive.
pub const MAX_DIMENSION: usize = 30;

impl<S: GroundField> StructureTheory<S> {
    /// The dimension of the algebra of derivations, proved by a theorem or a verified basis where
    /// possible. Returns `None` beyond [`MAX_DIMENSION`] unless the algebra is reductive.
    ///
    /// All derivations of a semisimple algebra are inner (de Graaf 4.5). The derivations of
    /// `s + z`, with `s` semisimple and `z` abelian, are `ad s + gl(z)`.
    pub fn derivation_dimension(&self) -> Option<Certified> {
        let _stage = stage("derivations");
        let n = self.dimension();
        if self.is_semisimple() {
            return Some(Certified::theorem(n));
        }
        if n > MAX_DIMENSION || self.is_abelian() {
            let z = self.radical().dimension();
            return self.is_reductive().then(|| Certified::theorem(n - z + z * z));
        }
        let kernel = |reduction: &ModularAlgebra| Some(reduction.derivation_equations().kernel());
        let counted = self.counted(n * n, kernel, StructureTheory::is_derivation_row);
        // the dimension is proved if it equals the number of inner derivations, which is a lower
        // bound
        let inner = n - self.centre().dimension();
        Some(Certified { proved: counted.proved || counted.dimension == inner, ..counted })
    }

    /// The dimension of the symmetric forms with `B([x,y],z) = B(x,[y,z])`, proved where possible.
    /// Returns `None` beyond [`MAX_DIMENSION`] unless the algebra is reductive. A reductive algebra
    /// has one form for each simple factor over the complex numbers, and all forms on the centre.
    pub fn invariant_form_dimension(&self) -> Option<Certified> {
        let _stage = stage("invariant forms");
        let n = self.dimension();
        if n > MAX_DIMENSION {
            let z = self.radical().dimension();
            let factors = self.is_reductive().then(|| self.dynkin_type())??;
            return Some(Certified::theorem(factors.len() + z * (z + 1) / 2));
        }
        let kernel = |reduction: &ModularAlgebra| Some(reduction.form_equations().kernel());
        Some(self.counted(n * (n + 1) / 2, kernel, StructureTheory::is_invariant_row))
    }
}

impl StructureTheory<Rational> {
    /// Whether `map` is a derivation. Its component `D^a_b` is stored at `a n + b`.
    fn is_derivation_row(&self, map: &Row<Rational>) -> bool {
        let n = self.dimension();
        let (mut rows, mut columns) = (vec![vec![]; n], vec![vec![]; n]);
        for (at, value) in map {
            rows[at / n].push((at % n, value));
            columns[at % n].push((at / n, value));
        }
        (0..n).all(|j| {
            let mut terms = vec![];
            // adds [D e_j, e_k]
            for &(a, d) in &columns[j] {
                let line = self.products.of(a).iter();
                terms.extend(line.map(|(k, i, c)| (k * n + i, c.clone() * d)));
            }
            for (a, i, c) in self.products.of(j) {
                // adds [e_j, D e_k], and -D [e_j, e_k], in which a plays the role of k
                terms.extend(rows[*a].iter().map(|(k, d)| (k * n + i, c.clone() * *d)));
                terms.extend(columns[*i].iter().map(|(b, d)| (a * n + b, -(c.clone() * *d))));
            }
            collected(terms).is_empty()
        })
    }

    /// Whether the symmetric form is invariant. The list `form` contains its components `B_jk` with
    /// `j <= k`.
    fn is_invariant_row(&self, form: &Row<Rational>) -> bool {
        let n = self.dimension();
        let mut places = (0..n).flat_map(|j| (j..n).map(move |k| (j, k))).enumerate();
        let mut rows = vec![vec![]; n];
        for (at, value) in form {
            let Some((_, (j, k))) = places.find(|(place, _)| place == at) else { return false };
            rows[j].push((k, value));
            if j != k {
                rows[k].push((j, value));
            }
        }
        (0..n).all(|x| {
            let terms = self.products.of(x).iter().flat_map(|(j, i, c)| {
                rows[*i].iter().flat_map(move |(k, b)| {
                    let value = c.clone() * *b;
                    [(j * n + k, value.clone()), (k * n + j, value)]
                })
            });
            collected(terms.collect()).is_empty()
        })
    }
}

impl ModularAlgebra {
    /// The equations `D[x,e_j] = [Dx,e_j] + [x,De_j]` for generators `x`. The unknown `D^a_b` has
    /// the index `a n + b`. If a map satisfies the equations for generators, it satisfies them for
    /// all `x`.
    fn derivation_equations(&self) -> ResidueMatrix {
        let (n, p) = (self.dimension(), self.prime());
        let mut rows = vec![];
        for x in self.generators() {
            let ad = self.ad(&x);
            for j in 0..n {
                // row i of the block is component i of the equation
                let mut block = vec![vec![0; n * n]; n];
                for (i, row) in block.iter_mut().enumerate() {
                    for b in 0..n {
                        row[i * n + b] = p.add(row[i * n + b], ad.rows()[b][j]);
                        let at = b * n + j;
                        row[at] = p.add(row[at], p.neg(ad.rows()[i][b]));
                    }
                }
                // adds -[Dx, e_j] = [e_j, e_a] D^a_b x_b
                for &(a, i, value) in self.of(j) {
                    for (b, &component) in x.iter().enumerate() {
                        let at = a * n + b;
                        block[i][at] = p.reduce(block[i][at] + value * component);
                    }
                }
                rows.extend(block);
            }
        }
        ResidueMatrix::new(p, n * n, rows)
    }

    /// The equations `B([x,e_j],e_k) + B(e_j,[x,e_k]) = 0` for generators `x`. The unknowns are
    /// `B_jk` with `j <= k`.
    fn form_equations(&self) -> ResidueMatrix {
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
        ResidueMatrix::new(p, n * (n + 1) / 2, rows)
    }
}
