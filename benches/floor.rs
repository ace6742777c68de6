//! Hand-written integer loops for E8: the speed that the hardware allows, for comparison with the
//! engine.
//!
//! They use knowledge that the engine does not have: the constants are small integers, the
//! connection is `c/2`, and only a count is needed.

/// The structure constants as rows: `rows[j * n + k]` lists `(i, c^i_jk)`.
pub struct Constants {
    n: usize,
    rows: Vec<Vec<(u32, i64)>>,
    /// For every `m`, all `(k, i, c^i_mk)`.
    ad: Vec<Vec<(u32, u32, i64)>>,
}

impl Constants {
    /// From entries `(j, k, i, v)` with `j < k`.
    pub fn new(n: usize, entries: &[(usize, usize, usize, i64)]) -> Self {
        let mut rows = vec![Vec::new(); n * n];
        for &(j, k, i, v) in entries {
            rows[j * n + k].push((i as u32, v));
            rows[k * n + j].push((i as u32, -v));
        }
        let row = |m: usize, k: usize| rows[m * n + k].iter().map(move |&(i, v)| (k as u32, i, v));
        let ad = (0..n).map(|m| (0..n).flat_map(|k| row(m, k)).collect()).collect();
        Constants { n, rows, ad }
    }

    /// The number of nonzero components of `4 R^i_jkl`, `k < l`, by the three terms of (B14) with
    /// `Lambda = c/2`; with `jacobi` those of the Jacobi sum for `k < l < j` instead.
    fn three_terms(&self, jacobi: bool) -> usize {
        let n = self.n;
        let third = if jacobi { 1 } else { 2 };
        let (mut sums, mut touched) = (vec![0i64; n * n], Vec::new());
        let mut nonzero = 0;
        for k in 0..n {
            for l in k + 1..n {
                let first = if jacobi { l as u32 + 1 } else { 0 };
                for (inner, outer, sign) in [(l, k, 1), (k, l, -1)] {
                    for &(j, m, v) in self.ad[inner].iter().filter(|e| e.0 >= first) {
                        for &(i, w) in &self.rows[outer * n + m as usize] {
                            let at = j as usize * n + i as usize;
                            sums[at] += sign * v * w;
                            touched.push(at);
                        }
                    }
                }
                for &(m, v) in &self.rows[k * n + l] {
                    for &(j, i, w) in self.ad[m as usize].iter().filter(|e| e.0 >= first) {
                        let at = j as usize * n + i as usize;
                        sums[at] -= third * v * w;
                        touched.push(at);
                    }
                }
                for at in touched.drain(..) {
                    nonzero += usize::from(sums[at] != 0);
                    sums[at] = 0;
                }
            }
        }
        nonzero
    }

    /// The number of nonzero curvature components of the connection `zero` with `k < l`.
    pub fn curvature(&self) -> usize {
        self.three_terms(false)
    }

    /// The number of components at which the Jacobi identity fails.
    pub fn jacobi(&self) -> usize {
        self.three_terms(true)
    }

    /// The number of nonzero components of the Killing form.
    pub fn killing(&self) -> usize {
        let n = self.n;
        // entries by (upper, second lower) index, to be met by those of (second lower, upper)
        let mut by_pair = vec![Vec::new(); n * n];
        for (i, ad) in self.ad.iter().enumerate() {
            for &(b, a, v) in ad {
                by_pair[a as usize * n + b as usize].push((i, v));
            }
        }
        let mut form = vec![0i64; n * n];
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
            for &(i, v) in &by_pair[a * n + b] {
                for &(j, w) in &by_pair[b * n + a] {
                    form[i * n + j] += v * w;
                }
            }
        }
        form.iter().filter(|value| **value != 0).count()
    }
}
