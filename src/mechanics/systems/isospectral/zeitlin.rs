//! Zeitlin's model of the flow of an ideal fluid on the sphere.

mod laplacian;

use super::{Isospectral, MatrixState, Symmetry, checked, spectrum};
use crate::Error;
use laplacian::Laplacian;
use nalgebra::{Complex, DMatrix};
use std::f64::consts::PI;

type Matrix = DMatrix<Complex<f64>>;

/// Zeitlin's model of Euler's equations on the unit sphere, on su(N): `W' = [P, W]/hbar`,
/// `Delta P = W`. Here `hbar = 2/sqrt(N^2 - 1)`, and `Delta = -sum_a ad(S_a)^2` is the Laplacian of
/// Hoppe and Yau.
///
/// The vorticity `w` is represented by the antihermitian matrix `W = i sqrt(N/4pi) sum w_lm Y_lm`.
/// Here `Y_lm`, with `l < N`, is the matrix of a real spherical harmonic ([`Zeitlin::harmonic`]).
/// The bracket `{f, g}` is represented by `[F, G]/(i hbar)`. The velocity is `u = x cross grad psi`
/// with `Delta psi = w`. The energy, the enstrophy and the angular momentum are integrals over the
/// sphere of the field with these coefficients. The flow conserves all `tr W^k`, the energy and the
/// angular momentum.
///
/// `Delta` is a tridiagonal matrix on each diagonal of `P`, so it is inverted in `O(N^2)`. A time
/// derivative needs two matrix products. V. Zeitlin, *Phys. Rev. Lett.* 93 (2004) 264501; J. Hoppe
/// and S.-T. Yau, *Commun. Math. Phys.* 195 (1998) 67-77; K. Modin and M. Viviani, *J. Fluid Mech.*
/// 884 (2020) A22.
///
/// ```
/// use affinor::mechanics::{Integrator, IsospectralMidpoint, Zeitlin};
/// let fluid = Zeitlin::new(17)?;
/// let mut state = fluid.state(0.0, fluid.random(7, 5)?)?;
/// let (energy, enstrophy) = (fluid.energy(&state.matrix), fluid.enstrophy(&state.matrix));
/// for _ in 0..20 {
///     IsospectralMidpoint.step(&fluid, &mut state, 0.1)?;
/// }
/// assert!((fluid.energy(&state.matrix) / energy - 1.0).abs() < 1e-3);
/// assert!((fluid.enstrophy(&state.matrix) / enstrophy - 1.0).abs() < 1e-13);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Zeitlin {
    laplacian: Laplacian,
    hbar: f64,
}

impl Zeitlin {
    /// The largest `N`.
    pub const LARGEST: usize = 4096;

    /// The model on su(N), whose dimension is `N^2 - 1`.
    ///
    /// # Errors
    /// [`Error::Size`] if `N` exceeds [`Zeitlin::LARGEST`], and [`Error::Shape`] if `N` is below 2.
    pub fn new(size: usize) -> Result<Self, Error> {
        if size < 2 {
            let (expected, found) = ("N of 2 or more".into(), size.to_string());
            return Err(Error::Shape { what: "su(N)", expected, found });
        }
        if size > Self::LARGEST {
            let what = "rows of a vorticity matrix";
            return Err(Error::Size { what, size, limit: Self::LARGEST });
        }
        let hbar = 2.0 / ((size * size - 1) as f64).sqrt();
        Ok(Zeitlin { laplacian: Laplacian::new(size), hbar })
    }

    /// The size `N` of the matrices.
    pub fn size(&self) -> usize {
        self.laplacian.size()
    }

    /// The constant `hbar = 2/sqrt(N^2 - 1)`.
    pub fn hbar(&self) -> f64 {
        self.hbar
    }

    /// The state with a vorticity matrix, which must be in su(N).
    ///
    /// # Errors
    /// [`Error::Shape`] unless the matrix has `N` rows and columns; [`Error::Invalid`] unless it is
    /// finite, antihermitian and trace-free.
    pub fn state(&self, time: f64, vorticity: Matrix) -> Result<MatrixState<Complex<f64>>, Error> {
        let state = checked(time, vorticity, Some(self.size()), self.symmetry())?;
        let trace = state.matrix.trace().im;
        if trace.abs() > 1e-12 * state.matrix.norm() {
            return Err(Error::Invalid {
                what: "state",
                reason: format!("the trace of W is {trace}i, not 0"),
            });
        }
        Ok(state)
    }

    /// The matrix `P` of the stream function, which satisfies `Delta P = W`. It is antihermitian
    /// and trace-free. Only the entries `W_ij` with `i <= j` are read, and the trace of `W` is
    /// ignored.
    pub fn stream(&self, vorticity: &Matrix) -> Matrix {
        self.laplacian.solve(vorticity)
    }

    /// The Laplacian `Delta P = -sum_a [S_a, [S_a, P]]`, which is the inverse of
    /// [`Zeitlin::stream`]. On harmonics, it is the factor `-l(l+1)`.
    pub fn laplacian(&self, stream: &Matrix) -> Matrix {
        self.laplacian.apply(stream)
    }

    /// The matrix of the real spherical harmonic `Y_lm`, `|m| <= l < N`. It is Hermitian, and its
    /// Frobenius norm is 1. The harmonics of degree 1 are along `y`, `z`, `x` for `m = -1, 0, 1`.
    /// There is no Condon-Shortley sign: near the north pole, the factor of `cos(m phi)` or, for
    /// `m < 0`, of `sin(|m| phi)` is positive.
    ///
    /// # Errors
    /// [`Error::Shape`] if `l` or `m` is out of range.
    pub fn harmonic(&self, l: usize, m: i64) -> Result<Matrix, Error> {
        if l >= self.size() || m.unsigned_abs() > l as u64 {
            let expected = format!("|m| <= l < {}", self.size());
            let found = format!("l = {l}, m = {m}");
            return Err(Error::Shape { what: "a spherical harmonic", expected, found });
        }
        Ok(self.laplacian.harmonic(l, m))
    }

    /// The vorticity matrix with the coefficients `(l, m, w_lm)` of real spherical harmonics,
    /// `l >= 1`.
    ///
    /// # Errors
    /// The errors of [`Zeitlin::harmonic`]; [`Error::Shape`] if `l = 0`, because vorticity has zero
    /// mean.
    pub fn vorticity(&self, coefficients: &[(usize, i64, f64)]) -> Result<Matrix, Error> {
        let mut sum = Matrix::zeros(self.size(), self.size());
        for &(l, m, coefficient) in coefficients {
            if l == 0 {
                let (expected, found) = ("l >= 1".into(), "l = 0".into());
                return Err(Error::Shape { what: "a harmonic of vorticity", expected, found });
            }
            sum += self.harmonic(l, m)? * Complex::new(0.0, coefficient * self.scale());
        }
        Ok(sum)
    }

    /// The coefficient `w_lm` of a vorticity matrix.
    ///
    /// # Errors
    /// The errors of [`Zeitlin::harmonic`].
    pub fn coefficient(&self, vorticity: &Matrix, l: usize, m: i64) -> Result<f64, Error> {
        Ok(self.harmonic(l, m)?.dotc(vorticity).im / self.scale())
    }

    /// A random vorticity that a seed determines. Every `w_lm` with `1 <= l <= degree` is `1/l`
    /// times a number in `[-1, 1)`. The numbers are the upper 53 bits of the outputs of the
    /// generator SplitMix64, in ascending order of `l`, then `m`. The field is the same for every
    /// `N`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `degree < N`.
    pub fn random(&self, seed: u64, degree: usize) -> Result<Matrix, Error> {
        let mut bits = seed;
        let mut coefficients = vec![];
        for l in 1..=degree.min(self.size()) {
            for m in -(l as i64)..=l as i64 {
                coefficients.push((l, m, random_unit(&mut bits) / l as f64));
            }
        }
        self.vorticity(&coefficients)
    }

    /// The kinetic energy, `-int w psi/2 = 2 pi/N tr(P W)`. Here `P` is the matrix of the stream
    /// function, and `W` is the matrix of the vorticity.
    pub fn energy(&self, vorticity: &Matrix) -> f64 {
        -0.5 * self.integral(&self.stream(vorticity), vorticity)
    }

    /// The enstrophy `int w^2 = -4 pi/N tr W^2`, which is a Casimir function.
    pub fn enstrophy(&self, vorticity: &Matrix) -> f64 {
        self.integral(vorticity, vorticity)
    }

    /// The angular momentum `int w x` over the sphere, for the three coordinates `x`.
    pub fn angular_momentum(&self, vorticity: &Matrix) -> [f64; 3] {
        // each coordinate x is sqrt(4pi/3) times a harmonic
        let scale = (4.0 * PI / 3.0).sqrt() / self.scale();
        [1, -1, 0].map(|m| scale * self.laplacian.harmonic(1, m).dotc(vorticity).im)
    }

    /// The eigenvalues of `-i W` in ascending order. They are the discrete analogue of the
    /// distribution of vorticity.
    pub fn spectrum(&self, vorticity: &Matrix) -> Vec<f64> {
        spectrum(&vorticity.map(|w| Complex::new(w.im, -w.re)))
    }

    /// The factor `sqrt(N/4pi)`, which is the norm of the matrix of a field of norm 1.
    fn scale(&self) -> f64 {
        (self.size() as f64 / (4.0 * PI)).sqrt()
    }

    /// The integral `int f g` of two fields: `4 pi/N tr F^* G`.
    fn integral(&self, f: &Matrix, g: &Matrix) -> f64 {
        f.dotc(g).re / (self.scale() * self.scale())
    }
}

/// The next number of the generator SplitMix64, scaled to `[-1, 1)`.
///
/// G. L. Steele, D. Lea and C. H. Flood, *OOPSLA* 2014, 453-472.
fn random_unit(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Isospectral for Zeitlin {
    type Entry = Complex<f64>;

    fn generator(&self, vorticity: &Matrix) -> Matrix {
        self.stream(vorticity) / Complex::from(self.hbar)
    }

    fn symmetry(&self) -> Option<Symmetry> {
        Some(Symmetry::Antihermitian)
    }
}
