//! The Toda lattice.

use super::{Isospectral, MatrixState, Symmetry, checked, expect_square, spectrum};
use crate::Error;
use crate::mechanics::stopped;
use crate::numerics::exponential::exp;
use nalgebra::DMatrix;

/// The Toda lattice `q_k'' = exp(q_(k-1) - q_k) - exp(q_k - q_(k+1))` with free ends. It is the
/// flow `L' = [B(L), L]` of a real symmetric matrix, where `B` is the upper triangle of `L` minus
/// the lower triangle.
///
/// The matrix [`Toda::lattice`] is tridiagonal. Any symmetric `L` is allowed (the full lattice),
/// because the errors of steps are not tridiagonal. H. Flaschka, *Phys. Rev. B* 9 (1974) 1924-1925.
/// The solution by `QR` follows W. W. Symes, *Physica D* 4 (1982) 275-280.
///
/// ```
/// use affinor::mechanics::systems::isospectral::Toda;
/// let start = Toda.state(0.0, Toda::lattice(&[0.0, 0.0], &[1.0, -1.0])?)?;
/// // two particles pass as 1/cosh^2: L_11 = -p/2 to a root of L
/// let (end, root) = (Toda.exact(&start, 40.0)?, 0.5_f64.sqrt());
/// assert!((end.matrix[(0, 0)] - root).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Toda;

/// The largest number of `QR` decompositions for one state.
const PIECES: f64 = 1e5;

impl Toda {
    /// Flaschka's matrix for the positions `q` and momenta `p`: `L_kk = -p_k/2`,
    /// `L_(k,k+1) = exp((q_k - q_(k+1))/2)/2`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the numbers of momenta and positions are equal, and at least one.
    pub fn lattice(positions: &[f64], momenta: &[f64]) -> Result<DMatrix<f64>, Error> {
        let n = positions.len();
        if momenta.len() != n || n == 0 {
            let (what, found) = ("the momenta", format!("{} components", momenta.len()));
            return Err(Error::Shape { what, expected: format!("{} components", n.max(1)), found });
        }
        Ok(DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => -0.5 * momenta[i],
            1 => 0.5 * (0.5 * (positions[i.min(j)] - positions[i.max(j)])).exp(),
            _ => 0.0,
        }))
    }

    /// The state with the matrix `L`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `L` is square; [`Error::Invalid`] unless it is finite and symmetric.
    pub fn state(&self, time: f64, matrix: DMatrix<f64>) -> Result<MatrixState<f64>, Error> {
        checked(time, matrix, None, self.symmetry())
    }

    /// The energy `H = sum p_k^2/2 + sum exp(q_k - q_(k+1)) = 2 tr L^2`.
    pub fn energy(&self, matrix: &DMatrix<f64>) -> f64 {
        2.0 * matrix.dot(&matrix.transpose())
    }

    /// The eigenvalues of `L` in ascending order. They are `-1/2` times the asymptotic momenta of
    /// the particles.
    pub fn spectrum(&self, matrix: &DMatrix<f64>) -> Vec<f64> {
        spectrum(matrix)
    }

    /// The exact state at a time, which is `L(t) = Q^T L Q` with `exp((t - t_0) L) = Q R` and a
    /// positive diagonal of `R`. Long times are divided into intervals with exponentials of
    /// moderate size. The number of intervals is `|t - t_0|` times the largest column sum of `|L|`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `L` is square. [`Error::Integration`] if the time is not finite, or
    /// if more than a hundred thousand intervals are needed.
    pub fn exact(&self, start: &MatrixState<f64>, time: f64) -> Result<MatrixState<f64>, Error> {
        expect_square("the matrix", &start.matrix, None)?;
        let length = time - start.time;
        let sums = start.matrix.column_iter().map(|column| column.lp_norm(1));
        let pieces = (length.abs() * sums.fold(0.0, f64::max)).max(1.0).ceil();
        if !length.is_finite() || !pieces.is_finite() || pieces > PIECES {
            return Err(stopped(
                start.time,
                format!("the time {time} is too far from the start for the exact solution"),
            ));
        }
        let mut matrix = start.matrix.clone();
        for _ in 0..pieces as u64 {
            let (q, r) = exp(&(&matrix * (length / pieces))).qr().unpack();
            let signs = DMatrix::from_diagonal(&r.diagonal().map(f64::signum));
            let q = q * signs;
            matrix = q.tr_mul(&matrix) * q;
            matrix = Symmetry::Hermitian.part(&matrix);
        }
        Ok(MatrixState { time, matrix })
    }
}

impl Isospectral for Toda {
    type Entry = f64;

    fn generator(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, m) = matrix.shape();
        DMatrix::from_fn(n, m, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Less => matrix[(i, j)],
            std::cmp::Ordering::Equal => 0.0,
            std::cmp::Ordering::Greater => -matrix[(j, i)],
        })
    }

    fn symmetry(&self) -> Option<Symmetry> {
        Some(Symmetry::Hermitian)
    }
}
