//! Isospectral flows, `L' = [B(L), L]`: matrices that move by similarity and keep their spectrum.
//!
//! [`Toda`], [`Manakov`] and [`Zeitlin`] are flows; [`Flow`] makes one of any function `B`.
//! [`IsospectralMidpoint`](super::integrators::IsospectralMidpoint) steps them.

mod entry;
mod manakov;
mod toda;
mod zeitlin;

pub use entry::Entry;
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
    /// `L`, square.
    pub matrix: DMatrix<T>,
}

/// A flow `L' = [B(L), L]`, over real or complex matrices.
pub trait Isospectral: System<State = MatrixState<Self::Entry>> {
    /// What an entry of `L` is.
    type Entry: Entry;

    /// `B(L)`, of the shape of `L`.
    fn generator(&self, matrix: &DMatrix<Self::Entry>) -> DMatrix<Self::Entry>;

    /// The sign of `L^* = L` or `L^* = -L`, if `B^* = -B` keeps one of them.
    fn symmetry(&self) -> Option<f64> {
        None
    }
}

/// The flow of a function `B`.
///
/// ```
/// use affinor::dynamics::isospectral::Flow;
/// use affinor::dynamics::{Integrator, IsospectralMidpoint};
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
    entry: PhantomData<T>,
}

impl<T: Entry, B: Fn(&DMatrix<T>) -> DMatrix<T>> Flow<T, B> {
    /// The flow of a function that takes square matrices to matrices of their shape.
    pub fn new(generator: B) -> Self {
        Flow { generator, entry: PhantomData }
    }

    /// A state of it.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `L` and `B(L)` are square of one size; [`Error::NoState`] for an entry that is not
    /// finite.
    pub fn state(&self, time: f64, matrix: DMatrix<T>) -> Result<MatrixState<T>, Error> {
        let state = checked(time, matrix, None)?;
        expect_square("B(L)", &(self.generator)(&state.matrix), Some(state.matrix.nrows()))?;
        Ok(state)
    }
}

impl<T: Entry, B: Fn(&DMatrix<T>) -> DMatrix<T>> System for Flow<T, B> {
    type State = MatrixState<T>;

    fn time(&self, state: &MatrixState<T>) -> f64 {
        state.time
    }
}

impl<T: Entry, B: Fn(&DMatrix<T>) -> DMatrix<T>> Isospectral for Flow<T, B> {
    type Entry = T;

    fn generator(&self, matrix: &DMatrix<T>) -> DMatrix<T> {
        (self.generator)(matrix)
    }
}

/// The eigenvalues of a matrix that is its own adjoint (only its lower triangle is read), in ascending order; NaN if they are
/// not found.
///
/// ```
/// use affinor::dynamics::isospectral::spectrum;
/// use nalgebra::DMatrix;
/// let roots = spectrum(&DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 2.0, 3.0]));
/// assert!((roots[0] + 1.0).abs() < 1e-15 && (roots[1] - 4.0).abs() < 1e-15);
/// ```
pub fn spectrum<T: Entry>(matrix: &DMatrix<T>) -> Vec<f64> {
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

/// The largest modulus of an entry; NaN if one is NaN.
pub(super) fn largest<T: Entry>(matrix: &DMatrix<T>) -> f64 {
    let most = |most: f64, entry: &T| {
        let modulus = entry.modulus();
        if modulus > most || modulus.is_nan() { modulus } else { most }
    };
    matrix.iter().fold(0.0, most)
}

fn expect_square<T: Entry>(
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

/// A state of a square matrix with finite entries.
fn checked<T: Entry>(
    time: f64,
    matrix: DMatrix<T>,
    size: Option<usize>,
) -> Result<MatrixState<T>, Error> {
    expect_square("the matrix", &matrix, size)?;
    let infinite = |(_, entry): &(usize, &T)| !entry.is_finite();
    if let Some((at, entry)) = matrix.iter().enumerate().find(infinite) {
        let (i, j) = (at % matrix.nrows() + 1, at / matrix.nrows() + 1);
        return Err(Error::NoState { reason: format!("L_{i}{j} = {entry}") });
    }
    Ok(MatrixState { time, matrix })
}

/// How far from a symmetry a matrix may be by rounding, relatively.
const ROUNDING: f64 = 1e-12;

/// `(L + sign L^*)/2`.
pub(super) fn symmetric_part<T: Entry>(matrix: &DMatrix<T>, sign: f64) -> DMatrix<T> {
    let half = T::from_real(0.5);
    matrix.zip_map(&matrix.adjoint(), |x, mirrored| (x + mirrored * T::from_real(sign)) * half)
}

/// The part of a matrix with `L = sign L^*`, if that is all of it.
fn expect_symmetry<T: Entry>(
    law: &str,
    sign: f64,
    matrix: &DMatrix<T>,
) -> Result<DMatrix<T>, Error> {
    let mirrored = matrix.adjoint() * T::from_real(sign);
    let off = matrix - &mirrored;
    let (at, _) = (off.iter().enumerate())
        .max_by(|(_, x), (_, y)| x.modulus().total_cmp(&y.modulus()))
        .unwrap_or((0, &off[0]));
    if off[at].modulus() <= ROUNDING * largest(matrix) {
        return Ok(symmetric_part(matrix, sign));
    }
    let (i, j) = (at % matrix.nrows(), at / matrix.nrows());
    let (one, other) = (matrix[(i, j)], matrix[(j, i)]);
    let (i, j) = (i + 1, j + 1);
    Err(Error::NoState { reason: format!("L is not {law}: L_{i}{j} = {one}, L_{j}{i} = {other}") })
}
