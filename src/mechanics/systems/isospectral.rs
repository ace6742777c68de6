//! Isospectral flows `L' = [B(L), L]` of matrices. They conserve the spectrum.
//!
//! The flows are [`Toda`], [`Manakov`], [`Zeitlin`], and [`Flow`] for any function `B`.
//! [`IsospectralMidpoint`](crate::mechanics::IsospectralMidpoint) integrates them.

mod entry;
mod manakov;
mod toda;
mod zeitlin;

pub use entry::MatrixEntry;
pub use manakov::Manakov;
pub use toda::Toda;
pub use zeitlin::Zeitlin;

use super::System;
use crate::Error;
use nalgebra::DMatrix;
use std::marker::PhantomData;

/// A state of a flow of matrices.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixState<T> {
    /// The time.
    pub time: f64,
    /// The square matrix `L`.
    pub matrix: DMatrix<T>,
}

/// A flow `L' = [B(L), L]`, over real or complex matrices.
pub trait Isospectral {
    /// The type of the entries of `L`.
    type Entry: MatrixEntry;

    /// The matrix `B(L)`, which has the same shape as `L`.
    fn generator(&self, matrix: &DMatrix<Self::Entry>) -> DMatrix<Self::Entry>;

    /// The symmetry of `L`, if `B^* = -B`. The flow conserves this symmetry, and steps conserve it
    /// exactly.
    fn symmetry(&self) -> Option<Symmetry> {
        None
    }
}

impl<F: Isospectral> System for F {
    type State = MatrixState<F::Entry>;

    fn time(&self, state: &Self::State) -> f64 {
        state.time
    }
}

/// A symmetry of matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// The symmetry `L^* = L`. Real matrices with this symmetry are symmetric.
    Hermitian,
    /// The symmetry `L^* = -L`. Real matrices with this symmetry are antisymmetric.
    Antihermitian,
}

impl Symmetry {
    /// The part of a matrix that has this symmetry: `(L + L^*)/2` or `(L - L^*)/2`.
    pub fn part<T: MatrixEntry>(self, matrix: &DMatrix<T>) -> DMatrix<T> {
        let half = T::from_real(0.5);
        matrix.zip_map(&matrix.adjoint(), |x, mirrored| match self {
            Symmetry::Hermitian => (x + mirrored) * half,
            Symmetry::Antihermitian => (x - mirrored) * half,
        })
    }
}

/// The flow of a function `B`.
///
/// ```
/// use affinor::mechanics::systems::isospectral::Flow;
/// use affinor::mechanics::{Integrator, IsospectralMidpoint};
/// use nalgebra::DMatrix;
/// // Brockett's double bracket L' = [L, [L, D]] sorts the spectrum as D is
/// let d = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 2.0]);
/// let flow = Flow::new(move |l: &DMatrix<f64>| &d * l - l * &d);
/// let mut state = flow.state(0.0, DMatrix::from_row_slice(2, 2, &[3.0, 1.0, 1.0, 0.0]))?;
/// for _ in 0..200 {
///     IsospectralMidpoint.step(&flow, &mut state, 0.1)?;
/// }
/// let root = 3.25_f64.sqrt();
/// assert!((state.matrix[(0, 0)] - (1.5 - root)).abs() < 1e-12);
/// assert!((state.matrix[(1, 1)] - (1.5 + root)).abs() < 1e-12);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Flow<T, B> {
    generator: B,
    symmetry: Option<Symmetry>,
    entry: PhantomData<T>,
}

impl<T: MatrixEntry, B: Fn(&DMatrix<T>) -> DMatrix<T>> Flow<T, B> {
    /// The flow of a function `B`, which maps square matrices to matrices of the same shape.
    pub fn new(generator: B) -> Self {
        Flow { generator, symmetry: None, entry: PhantomData }
    }

    /// The same flow, restricted to matrices with a symmetry that it conserves.
    #[must_use]
    pub fn on(self, symmetry: Symmetry) -> Self {
        Flow { symmetry: Some(symmetry), ..self }
    }

    /// A state of the flow.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `L` and `B(L)` are square matrices of the same size;
    /// [`Error::Invalid`] if an entry is not finite, or if the matrix does not have the symmetry.
    pub fn state(&self, time: f64, matrix: DMatrix<T>) -> Result<MatrixState<T>, Error> {
        let state = checked(time, matrix, None, self.symmetry)?;
        expect_square("B(L)", &(self.generator)(&state.matrix), Some(state.matrix.nrows()))?;
        Ok(state)
    }
}

impl<T: MatrixEntry, B: Fn(&DMatrix<T>) -> DMatrix<T>> Isospectral for Flow<T, B> {
    type Entry = T;

    fn generator(&self, matrix: &DMatrix<T>) -> DMatrix<T> {
        (self.generator)(matrix)
    }

    fn symmetry(&self) -> Option<Symmetry> {
        self.symmetry
    }
}

/// The eigenvalues of a self-adjoint matrix, in ascending order. They are NaN if the iteration does
/// not converge. Only the lower triangle of the matrix is read.
///
/// ```
/// use affinor::mechanics::systems::isospectral::spectrum;
/// use nalgebra::DMatrix;
/// let roots = spectrum(&DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 2.0, 3.0]));
/// assert!((roots[0] + 1.0).abs() < 1e-15 && (roots[1] - 4.0).abs() < 1e-15);
/// ```
pub fn spectrum<T: MatrixEntry>(matrix: &DMatrix<T>) -> Vec<f64> {
    let finite = matrix.is_square() && largest(matrix).is_finite();
    let none = || vec![f64::NAN; matrix.nrows()];
    if !finite || matrix.is_empty() {
        return none();
    }
    let found =
        nalgebra::SymmetricEigen::try_new(matrix.clone(), f64::EPSILON, 100 * matrix.nrows());
    let mut values = found.map_or_else(none, |found| found.eigenvalues.as_slice().to_vec());
    values.sort_by(f64::total_cmp);
    values
}

/// The size of the largest entry. The size of an entry is the sum of the magnitudes of its real and
/// imaginary part. Returns NaN if an entry is NaN.
pub(in crate::mechanics) fn largest<T: MatrixEntry>(matrix: &DMatrix<T>) -> f64 {
    let most = |most: f64, entry: &T| {
        let size = entry.norm1();
        if size > most || size.is_nan() { size } else { most }
    };
    matrix.iter().fold(0.0, most)
}

fn expect_square<T: MatrixEntry>(
    what: &'static str,
    matrix: &DMatrix<T>,
    size: Option<usize>,
) -> Result<(), Error> {
    let size = size.unwrap_or(matrix.nrows());
    if size > 0 && matrix.shape() == (size, size) {
        return Ok(());
    }
    let expected = format!("{0} rows and {0} columns", size.max(1));
    let found = format!("{} and {}", matrix.nrows(), matrix.ncols());
    Err(Error::Shape { what, expected, found })
}

/// The relative tolerance of a symmetry.
const ROUNDING: f64 = 1e-12;

/// A state with a square matrix. Checks that the entries are finite, and that the matrix has the
/// symmetry.
fn checked<T: MatrixEntry>(
    time: f64,
    matrix: DMatrix<T>,
    size: Option<usize>,
    symmetry: Option<Symmetry>,
) -> Result<MatrixState<T>, Error> {
    expect_square("the matrix", &matrix, size)?;
    let infinite = |entry: &T| !entry.is_finite();
    if let Some(at) = matrix.iter().position(infinite) {
        let (i, j) = (at % matrix.nrows() + 1, at / matrix.nrows() + 1);
        return Err(Error::Invalid {
            what: "state",
            reason: format!("the entry L_{i}{j} is {}, which is not finite", matrix[at]),
        });
    }
    let Some(symmetry) = symmetry else { return Ok(MatrixState { time, matrix }) };
    let part = symmetry.part(&matrix);
    let off = (&matrix - &part).map(|entry| entry.modulus());
    if off.max() <= ROUNDING * largest(&matrix) {
        return Ok(MatrixState { time, matrix: part });
    }
    let (i, j) = off.iamax_full();
    let (one, other) = (matrix[(i, j)], matrix[(j, i)]);
    let (i, j) = (i + 1, j + 1);
    let law = format!("{symmetry:?}").to_lowercase();
    Err(Error::Invalid {
        what: "state",
        reason: format!("L is not {law}: L_{i}{j} = {one}, L_{j}{i} = {other}"),
    })
}
