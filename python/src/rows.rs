//! Group operations on rows. Rotations and rigid motions have kernels; for any other group, the rows are processed one
//! by one.

use crate::arrays::Rows;
use affinor::Error;
use affinor::group::batch::motions::{
    InverseMotion, MotionAdjoint, MotionExp, MotionLog, MotionMatrix, MotionOfMatrix,
    MotionProduct, MovedPoint,
};
use affinor::group::batch::rotations::{
    InverseRotation, Jacobian, JacobianKind, RotatedPoint, RotationMatrix, RotationOfMatrix,
};
use affinor::group::batch::{self, Kernel, Operand, map};
use affinor::group::{
    AnyGroup, Coordinates, Embedded, MatrixNotation, Se2, Se3, Se23, Sl2, So2, So3,
};
use affinor_documents::input::InputError;
use affinor_tensors::Limits;
use affinor_tensors::stop::checkpoint;
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Operations on rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    Exp,
    Log,
    Inverse,
    Compose,
    Between,
    Adjoint,
    Coadjoint,
    AdjointMatrix,
    Bracket,
    TangentLeft,
    TangentLeftInverse,
    Jacobian(JacobianKind),
    Rate,
    Matrix,
    Act,
    Read,
    ReadUnchecked,
    Restore,
}

/// The groups that have kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closed {
    So3,
    Se3,
    Other,
}

/// A group, its kernels, and for each coordinate in Python its index in the library. Quaternions in the library end
/// with w.
pub struct Ground<'g> {
    pub group: &'g AnyGroup,
    pub closed: Closed,
    pub order: &'g [usize],
}

/// The largest number of rows that one thread processes alone.
pub const ALONE: usize = 512;

/// The number of results, counted as numbers, that one task of a kernel computes. Such a task takes some tens of
/// microseconds.
const CHUNK: usize = 1 << 16;

/// Evaluates the same expression with the static type of the group, if this type is known.
macro_rules! with_group {
    ($any:expr, $group:ident => $body:expr; $($G:ty),*) => {
        $(if let Some($group) = $any.downcast_ref::<$G>() { $body } else)* {
            let $group = $any;
            $body
        }
    };
}

/// The element with these coordinates, which are in the order of Python.
#[inline]
pub fn element<G: Embedded>(group: &G, order: &[usize], row: &[f64]) -> G::Element {
    let mut sorted = [0.0; 16];
    if order.len() <= sorted.len() {
        order.iter().zip(row).for_each(|(at, value)| sorted[*at] = *value);
        return group.from_coordinates(&G::Ambient::from_components(&sorted[..order.len()]));
    }
    let mut sorted = vec![0.0; order.len()];
    order.iter().zip(row).for_each(|(at, value)| sorted[*at] = *value);
    group.from_coordinates(&G::Ambient::from_components(&sorted))
}

#[inline]
pub fn write_element<G: Embedded>(group: &G, order: &[usize], g: &G::Element, out: &mut [f64]) {
    write_coordinates(order, group.coordinates(g).components(), out);
}

#[inline]
fn write_coordinates(order: &[usize], numbers: &[f64], out: &mut [f64]) {
    order.iter().zip(out).for_each(|(at, value)| *value = numbers[*at]);
}

/// Writes the columns of a matrix in row-major order.
fn write_columns<V: Coordinates>(
    n: usize,
    out: &mut [f64],
    column: impl Fn(usize) -> Result<V, Error>,
) -> Result<(), Error> {
    for k in 0..n {
        let column = column(k)?;
        for (i, value) in column.components().iter().enumerate() {
            out[i * n + k] = *value;
        }
    }
    Ok(())
}

/// Applies an operation to one row of each argument.
#[inline]
fn apply<G: MatrixNotation>(
    group: &G,
    order: &[usize],
    operation: Operation,
    a: &[f64],
    b: &[f64],
    out: &mut [f64],
) -> Result<(), Error> {
    let element = |row: &[f64]| element(group, order, row);
    let vector = |row: &[f64]| G::Vector::from_components(row);
    let found = match operation {
        Operation::Exp => Err(group.exp(&vector(a))),
        Operation::Inverse => Err(group.inverse(&element(a))),
        Operation::Compose => Err(group.compose(&element(a), &element(b))),
        Operation::Between => Err(group.between(&element(a), &element(b))),
        Operation::Restore => {
            let g = group.project(element(a));
            // rejects zero and NaN, which have no inverse: the test is negated, because it fails for NaN
            let one = group.compose(&g, &group.inverse(&g));
            let off = group.write(&one) - group.write(&group.identity());
            if !off.iter().all(|entry| entry.abs() < 0.5) {
                group.read(&group.write(&g))?;
            }
            Err(g)
        }
        Operation::Read | Operation::ReadUnchecked => {
            let (rows, columns) = group.write(&group.identity()).shape();
            Err(group.read(&DMatrix::from_row_slice(rows, columns, a))?)
        }
        Operation::Matrix => {
            let matrix = group.write(&element(a));
            let rows = matrix.ncols();
            for (at, value) in out.iter_mut().enumerate() {
                *value = matrix[(at / rows, at % rows)];
            }
            return Ok(());
        }
        Operation::Act => {
            let mut entries = Vec::new();
            group.entries(&element(a), &mut entries);
            let rows = entries.len().isqrt();
            for (i, value) in out.iter_mut().enumerate() {
                // affine maps act on points with the last coordinate 1
                let rest = if b.len() < rows { entries[rows * b.len() + i] } else { 0.0 };
                let terms = b.iter().enumerate().map(|(k, x)| entries[rows * k + i] * x);
                *value = terms.sum::<f64>() + rest;
            }
            return Ok(());
        }
        Operation::AdjointMatrix => {
            let g = element(a);
            let column = |k| Ok(group.adjoint(&g, &group.basis_vector(k)));
            return write_columns(group.dimension(), out, column);
        }
        Operation::Jacobian(kind) => {
            let x = vector(a);
            let minus = -x.clone();
            let column = |k| {
                let v = group.basis_vector(k);
                match kind {
                    JacobianKind::Left => Ok(group.tangent_left(&minus, &v)),
                    JacobianKind::Right => Ok(group.tangent_left(&x, &v)),
                    JacobianKind::LeftInverse => group.tangent_left_inverse(&minus, &v),
                    JacobianKind::RightInverse => group.tangent_left_inverse(&x, &v),
                }
            };
            return write_columns(group.dimension(), out, column);
        }
        Operation::Rate => {
            let rate = group.rate(&element(a), &vector(b));
            write_coordinates(order, rate.components(), out);
            return Ok(());
        }
        Operation::Log => Ok(group.log(&element(a))?),
        Operation::Adjoint => Ok(group.adjoint(&element(a), &vector(b))),
        Operation::Coadjoint => Ok(group.coadjoint(&element(a), &vector(b))),
        Operation::Bracket => Ok(group.bracket(&vector(a), &vector(b))),
        Operation::TangentLeft => Ok(group.tangent_left(&vector(a), &vector(b))),
        Operation::TangentLeftInverse => Ok(group.tangent_left_inverse(&vector(a), &vector(b))?),
    };
    match found {
        Ok(x) => out.copy_from_slice(x.components()),
        Err(g) => write_element(group, order, &g, out),
    }
    Ok(())
}

/// Adds the index of an element in a batch to an error.
fn named(at: usize, error: Error) -> InputError {
    let error = InputError::from(error);
    let message = format!("element {at} of the batch: {}", error.message);
    InputError { message, ..error }
}

/// Applies an operation to all rows.
fn apply_all<G: MatrixNotation + Sync>(
    group: &G,
    order: &[usize],
    operation: Operation,
    [a, b]: [&Rows<'_>; 2],
    out: &mut [f64],
    width: usize,
) -> Result<(), InputError> {
    let task = |(chunk, out): (usize, &mut [f64])| {
        for (at, out) in out.chunks_exact_mut(width).enumerate() {
            let at = chunk * ALONE + at;
            apply(group, order, operation, a.row(at), b.row(at), out)
                .map_err(|error| named(at, error))?;
        }
        Ok(())
    };
    if out.len() <= ALONE * width {
        return task((0, out));
    }
    let limits = Limits::current();
    let task = |chunk| {
        limits.run(|| {
            checkpoint();
            task(chunk)
        })
    };
    out.par_chunks_mut(ALONE * width).enumerate().try_for_each(task)
}

/// Whether a kernel for rows of this width takes less time than the start of threads.
fn is_short(count: usize, width: usize) -> bool {
    count.saturating_mul(width) <= 8 * CHUNK
}

fn operand<'r, const N: usize>(rows: &'r Rows<'_>) -> Operand<'r, N> {
    match (rows.single(), N) {
        (_, 0) => Operand::One([0.0; N]),
        (Some(row), _) => Operand::One(std::array::from_fn(|i| row[i])),
        (None, _) => Operand::Many(rows.list().as_chunks().0),
    }
}

/// Applies a kernel to all rows.
fn each<const A: usize, const B: usize, const O: usize>(
    kernel: &(impl Kernel<A, B, O> + Sync),
    [a, b]: [&Rows<'_>; 2],
    out: &mut [f64],
) -> Result<(), InputError> {
    let out = out.as_chunks_mut::<O>().0;
    let (a, b) = (operand::<A>(a), operand::<B>(b));
    if is_short(out.len(), O) {
        return map(kernel, a, b, out).map_err(|(at, error)| named(at, error));
    }
    out.par_chunks_mut(CHUNK / O).enumerate().try_for_each(|(chunk, out)| {
        let (start, end) = (chunk * (CHUNK / O), chunk * (CHUNK / O) + out.len());
        map(kernel, a.part(start, end), b.part(start, end), out)
            .map_err(|(at, error)| named(start + at, error))
    })
}

/// Applies an operation with its kernel. Returns `None` if there is no kernel, or if the rows must be processed one by
/// one.
fn by_kernel(
    closed: Closed,
    operation: Operation,
    rows: [&Rows<'_>; 2],
    out: &mut [f64],
) -> Option<Result<(), InputError>> {
    let done = match (closed, operation) {
        (Closed::So3, Operation::Exp | Operation::Log | Operation::Compose) => {
            return rotations(operation, rows, out).then_some(Ok(()));
        }
        (Closed::So3, Operation::Matrix | Operation::AdjointMatrix) => {
            each(&RotationMatrix, rows, out)
        }
        (Closed::So3, Operation::Act) => each(&RotatedPoint, rows, out),
        (Closed::So3, Operation::Inverse) => each(&InverseRotation, rows, out),
        (Closed::So3, Operation::Read) => each(&RotationOfMatrix(true), rows, out),
        (Closed::So3, Operation::ReadUnchecked) => each(&RotationOfMatrix(false), rows, out),
        (Closed::So3, Operation::Jacobian(kind)) => each::<3, 0, 9>(&Jacobian(kind), rows, out),
        (Closed::Se3, Operation::Exp) => each(&MotionExp, rows, out),
        (Closed::Se3, Operation::Log) => each(&MotionLog, rows, out),
        (Closed::Se3, Operation::Compose) => each(&MotionProduct, rows, out),
        (Closed::Se3, Operation::Inverse) => each(&InverseMotion, rows, out),
        (Closed::Se3, Operation::Matrix) => each(&MotionMatrix, rows, out),
        // the kernel is for points with three coordinates, not with four
        (Closed::Se3, Operation::Act) if rows[1].width() == 3 => each(&MovedPoint, rows, out),
        (Closed::Se3, Operation::AdjointMatrix) => each(&MotionAdjoint, rows, out),
        (Closed::Se3, Operation::Read) => each(&MotionOfMatrix(true), rows, out),
        (Closed::Se3, Operation::ReadUnchecked) => each(&MotionOfMatrix(false), rows, out),
        (Closed::Se3, Operation::Jacobian(kind)) => each::<6, 0, 36>(&Jacobian(kind), rows, out),
        _ => return None,
    };
    Some(done)
}

impl Ground<'_> {
    /// Applies an operation to all rows, in the threads of the caller.
    pub fn operate(
        &self,
        operation: Operation,
        rows: [&Rows<'_>; 2],
        out: &mut [f64],
        width: usize,
    ) -> Result<(), InputError> {
        if let Some(done) = by_kernel(self.closed, operation, rows, out) {
            return done;
        }
        let (any, order) = (self.group, self.order);
        with_group!(any, group =>
            apply_all(group, order, operation, rows, out, width);
            So3, Se3, Se2, Se23, Sl2, So2)
    }

    /// Whether there are so few rows that the calling thread processes them alone.
    pub fn is_alone(&self, count: usize, width: usize) -> bool {
        match self.closed {
            Closed::Other => count <= ALONE,
            Closed::So3 | Closed::Se3 => is_short(count, width),
        }
    }
}

/// Processes rotations in a batch. Returns `false` if the rows must be processed one by one.
fn rotations(operation: Operation, [a, b]: [&Rows<'_>; 2], out: &mut [f64]) -> bool {
    let Some(rows) = a.all() else { return false };
    match operation {
        Operation::Exp => {
            let (x, g) = (rows.as_chunks::<3>().0, out.as_chunks_mut::<4>().0);
            if is_short(g.len(), 4) {
                batch::exp_rows(x, g);
            } else {
                let pairs = x.par_chunks(CHUNK / 4).zip(g.par_chunks_mut(CHUNK / 4));
                pairs.for_each(|(x, g)| batch::exp_rows(x, g));
            }
            true
        }
        Operation::Log => {
            let (g, x) = (rows.as_chunks::<4>().0, out.as_chunks_mut::<3>().0);
            // returns `false` if an element has no logarithm, so that the rows are processed one by one and this row is
            // reported
            if is_short(x.len(), 3) {
                return batch::log_rows(g, x);
            }
            let pairs = g.par_chunks(CHUNK / 4).zip(x.par_chunks_mut(CHUNK / 4));
            pairs.all(|(g, x)| batch::log_rows(g, x))
        }
        Operation::Compose => {
            let Some(others) = b.all() else { return false };
            let (g, h) = (rows.as_chunks::<4>().0, others.as_chunks::<4>().0);
            let out = out.as_chunks_mut::<4>().0;
            if g.len() != h.len() || g.len() != out.len() {
                return false;
            }
            if is_short(g.len(), 4) {
                batch::compose_rows(g, h, out);
            } else {
                let pairs = g.par_chunks(CHUNK / 4).zip(h.par_chunks(CHUNK / 4));
                let all = pairs.zip(out.par_chunks_mut(CHUNK / 4));
                all.for_each(|((g, h), out)| batch::compose_rows(g, h, out));
            }
            true
        }
        _ => false,
    }
}
