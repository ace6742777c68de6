//! Applies a formula to many rows. Whole blocks are computed at once, and rows outside the range of
//! the formula are computed separately.

use crate::Error;
use crate::numerics::lanes::{LANES, Lane, Lanes};
#[cfg(feature = "simd")]
use multiversion::multiversion;

/// The rows of an argument.
#[derive(Clone, Copy, Debug)]
pub enum Operand<'a, const N: usize> {
    /// One row for each row of the result.
    Many(&'a [[f64; N]]),
    /// The same row for all rows of the result.
    One([f64; N]),
}

impl<'a, const N: usize> Operand<'a, N> {
    /// The row at an index.
    #[inline(always)]
    fn row(&self, at: usize) -> [f64; N] {
        match self {
            Operand::Many(rows) => rows[at],
            Operand::One(row) => *row,
        }
    }

    /// A block of rows, transposed to columns.
    #[inline(always)]
    fn block(&self, start: usize) -> [Lanes; N] {
        match self {
            Operand::Many(rows) => {
                let block = &rows[start..start + LANES];
                let mut columns = [Lanes::splat(0.0); N];
                for (column, lanes) in columns.iter_mut().enumerate() {
                    for (t, row) in block.iter().enumerate() {
                        lanes.0[t] = row[column];
                    }
                }
                columns
            }
            Operand::One(row) => row.map(Lanes::splat),
        }
    }

    /// The rows from the index `start` to the index `end`, which is excluded.
    pub fn part(&self, start: usize, end: usize) -> Operand<'a, N> {
        match self {
            Operand::Many(rows) => Operand::Many(&rows[start..end]),
            Operand::One(row) => Operand::One(*row),
        }
    }
}

/// An operation that maps a row of `A` numbers and a row of `B` numbers to a row of `O` numbers.
///
/// The kernels of [`rotations`](super::rotations) and [`motions`](super::motions) implement this
/// trait.
pub trait Kernel<const A: usize, const B: usize, const O: usize>: Formula<A, B, O> {}

impl<const A: usize, const B: usize, const O: usize, K: Formula<A, B, O>> Kernel<A, B, O> for K {}

/// The formula of a kernel, without branches.
pub trait Formula<const A: usize, const B: usize, const O: usize> {
    /// The formula is valid if the measure of a row is below this limit.
    #[doc(hidden)]
    const LIMIT: f64 = f64::INFINITY;

    /// Whether a block of rows is computed at once, by vector instructions of the processor. For a
    /// formula with few operations, the transposition of rows and columns would take longer than
    /// the formula.
    #[doc(hidden)]
    const SIDE_BY_SIDE: bool = false;

    /// Returns the result, and the measure that must be below the limit.
    #[doc(hidden)]
    fn formula<T: Lane>(&self, a: [T; A], b: [T; B]) -> ([T; O], T);

    /// Computes the result for a row outside the range of the formula.
    ///
    /// # Errors
    /// The reason why a row has no result.
    #[doc(hidden)]
    fn alone(&self, a: [f64; A], b: [f64; B]) -> Result<[f64; O], Error> {
        Ok(self.formula(a, b).0)
    }
}

/// Computes a single row of results.
///
/// # Errors
/// The errors of the operation on elements.
#[inline]
pub fn single<const A: usize, const B: usize, const O: usize>(
    kernel: &impl Kernel<A, B, O>,
    a: [f64; A],
    b: [f64; B],
) -> Result<[f64; O], Error> {
    let (found, measure) = kernel.formula(a, b);
    if in_range(measure, kernel) { Ok(found) } else { kernel.alone(a, b) }
}

#[inline(always)]
fn in_range<const A: usize, const B: usize, const O: usize, K: Formula<A, B, O>>(
    measure: f64,
    _: &K,
) -> bool {
    // a NaN is out of range, unless there is no limit
    measure < K::LIMIT || K::LIMIT == f64::INFINITY
}

/// Applies a kernel to all rows, in the thread of the caller.
///
/// # Errors
/// The index of the first row without a result, and the reason.
///
/// # Panics
/// If an argument has fewer rows than the result.
pub fn map<const A: usize, const B: usize, const O: usize, K: Kernel<A, B, O>>(
    kernel: &K,
    a: Operand<'_, A>,
    b: Operand<'_, B>,
    out: &mut [[f64; O]],
) -> Result<(), (usize, Error)> {
    if K::SIDE_BY_SIDE { side_by_side(kernel, a, b, out) } else { one_by_one(kernel, a, b, out, 0) }
}

fn one_by_one<const A: usize, const B: usize, const O: usize, K: Kernel<A, B, O>>(
    kernel: &K,
    a: Operand<'_, A>,
    b: Operand<'_, B>,
    out: &mut [[f64; O]],
    start: usize,
) -> Result<(), (usize, Error)> {
    for (at, row) in out.iter_mut().enumerate() {
        let at = start + at;
        *row = single(kernel, a.row(at), b.row(at)).map_err(|error| (at, error))?;
    }
    Ok(())
}

#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
fn side_by_side<const A: usize, const B: usize, const O: usize, K: Kernel<A, B, O>>(
    kernel: &K,
    a: Operand<'_, A>,
    b: Operand<'_, B>,
    out: &mut [[f64; O]],
) -> Result<(), (usize, Error)> {
    let (blocks, rest) = out.as_chunks_mut::<LANES>();
    let mut start = 0;
    for block in blocks {
        let (found, measure) = kernel.formula(a.block(start), b.block(start));
        for (t, row) in block.iter_mut().enumerate() {
            for (value, column) in row.iter_mut().zip(&found) {
                *value = column.0[t];
            }
        }
        let mut inside = true;
        for measure in &measure.0 {
            inside &= *measure < K::LIMIT;
        }
        for (t, row) in block.iter_mut().enumerate().take(if inside { 0 } else { LANES }) {
            if !in_range(measure.0[t], kernel) {
                let at = start + t;
                *row = kernel.alone(a.row(at), b.row(at)).map_err(|error| (at, error))?;
            }
        }
        start += LANES;
    }
    one_by_one(kernel, a, b, rest, start)
}
