//! The Laplacian of Hoppe and Yau on matrices, its inverse and its eigenvectors.

use nalgebra::{Complex, DMatrix};
use std::f64::consts::FRAC_1_SQRT_2;

/// The Laplacian `Delta P = -sum_a [S_a, [S_a, P]]` with the spin matrices `S_a` of size `N`. On
/// the entries `(a, a + d)` of `P`, the Laplacian is the symmetric tridiagonal matrix
///
/// ```text
/// 2 m_a m_(a+d) - (N^2 - 1)/2 on the diagonal, c_a c_(a+d) beside it,   m_a = (N - 1)/2 - a,   c_a^2 = (a + 1)(N - 1 - a)
/// ```
///
/// which is negative definite, except for the multiples of the identity at `d = 0`.
#[derive(Clone, Debug)]
pub(in crate::mechanics) struct Laplacian {
    size: usize,
    /// The decomposition `L D L^T` for each diagonal. A pair consists of the entry of `L` and the
    /// inverse pivot.
    factors: Vec<Vec<(f64, f64)>>,
}

impl Laplacian {
    pub(in crate::mechanics) fn new(size: usize) -> Self {
        let mut laplacian = Laplacian { size, factors: vec![] };
        laplacian.factors = (0..size).map(|d| laplacian.factored(d)).collect();
        laplacian
    }

    pub(in crate::mechanics) fn size(&self) -> usize {
        self.size
    }

    /// The entry `a` on the main diagonal of the matrix for the diagonal `d` of `P`.
    fn own(&self, d: usize, a: usize) -> f64 {
        let n = self.size as f64;
        let [m, other] = [a, a + d].map(|a| 0.5 * (n - 1.0) - a as f64);
        2.0 * m * other - 0.5 * (n * n - 1.0)
    }

    /// The entry next to the main diagonal, between `a` and `a + 1`, of the matrix for the diagonal
    /// `d` of `P`.
    fn beside(&self, d: usize, a: usize) -> f64 {
        let square = |a: usize| ((a + 1) * (self.size - 1 - a)) as f64;
        (square(a) * square(a + d)).sqrt()
    }

    fn factored(&self, d: usize) -> Vec<(f64, f64)> {
        let length = self.size - d;
        let mut pivot = self.own(d, 0);
        let mut factors = Vec::with_capacity(length);
        for a in 0..length - 1 {
            let beside = self.beside(d, a);
            factors.push((beside / pivot, 1.0 / pivot));
            pivot = self.own(d, a + 1) - beside * beside / pivot;
        }
        // the last pivot of the main diagonal is 0: stores 0 instead of its inverse, so that the
        // solution is 0 there
        factors.push((0.0, if d == 0 { 0.0 } else { 1.0 / pivot }));
        factors
    }

    /// The antihermitian, trace-free `P` with `Delta P = W - tr W/N`, computed from the entries
    /// `W_ij` with `i <= j`.
    pub(in crate::mechanics) fn solve(&self, w: &DMatrix<Complex<f64>>) -> DMatrix<Complex<f64>> {
        let n = self.size;
        let mut p = DMatrix::zeros(n, n);
        let mean = w.trace().im / n as f64;
        let mut values = Vec::with_capacity(n);
        for (d, factors) in self.factors.iter().enumerate() {
            values.clear();
            let mut value = Complex::new(0.0, 0.0);
            let mut below = 0.0;
            for (a, &(next, _)) in factors.iter().enumerate() {
                let entry = w[(a, a + d)];
                let entry = if d == 0 { Complex::new(0.0, entry.im - mean) } else { entry };
                value = entry - value * below;
                below = next;
                values.push(value);
            }
            let mut value = Complex::new(0.0, 0.0);
            for (a, &(next, inverse)) in factors.iter().enumerate().rev() {
                value = values[a] * inverse - value * next;
                values[a] = value;
            }
            let level =
                if d == 0 { values.iter().sum::<Complex<f64>>() / n as f64 } else { 0.0.into() };
            for (a, &value) in values.iter().enumerate() {
                p[(a + d, a)] = level.conj() - value.conj();
                p[(a, a + d)] = value - level;
            }
        }
        p
    }

    /// The matrix `Delta P`.
    pub(in crate::mechanics) fn apply(&self, p: &DMatrix<Complex<f64>>) -> DMatrix<Complex<f64>> {
        let n = self.size;
        DMatrix::from_fn(n, n, |i, j| {
            let (a, d) = (i.min(j), i.abs_diff(j));
            let mut sum = p[(i, j)] * self.own(d, a);
            if a > 0 {
                sum += p[(i - 1, j - 1)] * self.beside(d, a - 1);
            }
            if i.max(j) + 1 < n {
                sum += p[(i + 1, j + 1)] * self.beside(d, a);
            }
            sum
        })
    }

    /// The matrix of the real harmonic of degree `l < N` and order `|m| <= l`.
    pub(in crate::mechanics) fn harmonic(&self, l: usize, m: i64) -> DMatrix<Complex<f64>> {
        let d = m.unsigned_abs() as usize;
        let diagonal = self.eigenvector(d, l);
        let mut harmonic = DMatrix::zeros(self.size, self.size);
        for (a, &value) in diagonal.iter().enumerate() {
            let entry = match m.signum() {
                0 => value.into(),
                1 => Complex::new(value * FRAC_1_SQRT_2, 0.0),
                _ => Complex::new(0.0, -value * FRAC_1_SQRT_2),
            };
            harmonic[(a + d, a)] = entry.conj();
            harmonic[(a, a + d)] = entry;
        }
        harmonic
    }

    /// The eigenvector for the eigenvalue `-l(l+1)` on the diagonal `d`. Its first entry is
    /// positive. A recurrence computes the entries from the end, where they grow, to the middle;
    /// the other half follows from the parity.
    fn eigenvector(&self, d: usize, l: usize) -> Vec<f64> {
        let length = self.size - d;
        let eigenvalue = -((l * (l + 1)) as f64);
        let mut v = vec![0.0; length];
        v[0] = 1.0;
        for a in 1..length.div_ceil(2) {
            let before = if a > 1 { self.beside(d, a - 2) * v[a - 2] } else { 0.0 };
            let next = (eigenvalue - self.own(d, a - 1)) * v[a - 1] - before;
            v[a] = next / self.beside(d, a - 1);
            if v[a].abs() > 1e100 {
                v[..=a].iter_mut().for_each(|x| *x *= 1e-100);
            }
        }
        let sign = if (l - d).is_multiple_of(2) { 1.0 } else { -1.0 };
        for a in 0..length / 2 {
            v[length - 1 - a] = sign * v[a];
        }
        if length % 2 == 1 && sign < 0.0 {
            v[length / 2] = 0.0;
        }
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.iter().map(|x| x / norm).collect()
    }
}
