//! The linear equations of small deviations from an equilibrium or a steady motion.

use super::{TreeState, TreeSystem};
use crate::Error;
use crate::numerics::derivative::derivative;
use crate::numerics::least_squares::least_squares;
use crate::numerics::null_space::null_space;
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector, Schur, Vector3};

/// The linear equations `u' = A u` of deviations from an equilibrium or a steady motion of a tree.
///
/// A deviation consists of displacements `xi` and of changes `eta` of the rates, one of each for each
/// rate of the tree. It satisfies the constraints to first order, `(xi, eta) = B u`:
///
/// ```text
/// G xi = 0,   (d(G v - b)/dq) xi + G eta = 0
/// xi' = eta - w x xi  (for rotations about points),   eta' = (da/dq) xi + (da/dv) eta
/// ```
///
/// with the accelerations `a(q, v)` on the constraints. In a steady motion, the coordinates change at
/// constant rates and `A` is constant.
///
/// Some eigenvalues vanish. They belong to coordinates without influence, such as the angle of a
/// wheel, and to families of steady motions. They are removed first, so that their rounding errors
/// do not change the others.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// The matrix `A`.
    pub matrix: DMatrix<f64>,
    /// The matrix `B`: displacements first, then changes of rates, in units of the tree. Its first
    /// columns have orthonormal displacements, and its other columns have no displacements and
    /// orthonormal changes.
    pub basis: DMatrix<f64>,
    /// The number of eigenvalues that vanish.
    pub zeros: usize,
    /// The other eigenvalues, by decreasing real part. Conjugate pairs begin with the positive
    /// imaginary part.
    pub eigenvalues: Vec<Complex<f64>>,
    /// For each of these eigenvalues, the size of the displacement along each rate, relative to the
    /// largest one.
    pub shapes: Vec<Vec<f64>>,
}

/// Half of the widest and of the narrowest interval of derivatives, in units of the tree.
const WIDTHS: [f64; 2] = [0.5, 1e-3];
/// Accelerations vanish up to this multiple of the largest entry of the matrix.
const STEADY: f64 = 1e-9;
/// A displacement that is a rounding error, in units of the tree.
const ROUNDING: f64 = 1e-12;
/// The part of a row that is a rounding error, relative to the longest one.
const ZERO: f64 = 1e-8;
/// An entry of the matrix that is a rounding error, relative to the largest one of its row, and to
/// the largest one of all.
const NOISE: [f64; 2] = [1e-11, 1e-13];
/// The largest relative change of the matrix of a steady motion.
const CONSTANT: f64 = 1e-6;
/// The time by which a steady motion is followed, in units of the fastest rate.
const LATER: f64 = 0.3;
/// The longest step of Newton's method to an equilibrium, in units of the tree.
const LONGEST: f64 = 0.3;
/// The largest number of steps of Newton's method to an equilibrium.
const ITERATIONS: usize = 50;

impl TreeSystem {
    /// The equilibrium near a state without rates, by Newton's method.
    ///
    /// # Errors
    /// [`Error::Invalid`] if no equilibrium is found.
    pub fn equilibrium(&self, state: &TreeState) -> Result<TreeState, Error> {
        let (mut state, n) = (state.clone(), self.tree.freedom());
        let split = state.numbers.len() - n;
        let units = DVector::from_iterator(n, self.tree.units());
        for _ in 0..ITERATIONS {
            let rest = self.accelerations(&state, &units)?;
            let slopes = self.slopes(&state, &units, 0)?;
            if rest.amax() <= ROUNDING * slopes.amax() {
                return Ok(state);
            }
            let [closed, _] = self.constraint_rows(&state, &units)?;
            let free = null_space(&closed, ZERO);
            if free.is_empty() {
                return Err(invalid("the constraints leave no freedom".into()));
            }
            let mut change = &free * least_squares(&(&slopes * &free), &-&rest);
            if change.amax() <= ROUNDING {
                if rest.amax() <= STEADY * slopes.amax() {
                    return Ok(state);
                }
                // falls if Newton's method does not move, as a horizontal pendulum
                let fall = &free * free.tr_mul(&rest);
                change = &fall / fall.amax().max(f64::MIN_POSITIVE);
            }
            let longest = change.amax();
            let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            let displacement = (change * share).component_mul(&units);
            let numbers = &mut state.numbers.as_mut_slice()[..split];
            self.tree.displace(numbers, displacement.as_slice());
            state.numbers = self.projected(state.time, &state.numbers, &mut []).map_err(invalid)?;
        }
        Err(invalid("there is no equilibrium near the initial position".into()))
    }

    /// The linear equations at an equilibrium or a steady motion. The matrix consists of derivatives of
    /// Chebyshev series, with errors of about `1e-13` of its size.
    ///
    /// # Errors
    /// [`Error::Invalid`] if rates change, or if the matrix changes along the motion.
    pub fn linearized(&self, state: &TreeState) -> Result<Linearization, Error> {
        let units = DVector::from_iterator(self.tree.freedom(), self.tree.units());
        let accelerations = self.accelerations(state, &units)?;
        let own = self.restricted(state, &units)?;
        let Restricted { matrix, displacements, .. } = &own;
        if matrix.is_empty() {
            // motors move all coordinates
            return Ok(own.with_modes(0, vec![]));
        }
        if accelerations.amax() > STEADY * matrix.amax() {
            let rate = accelerations.iamax();
            return Err(invalid(format!(
                "rate {} changes by {:.3e} per unit of time, so the motion is not steady",
                rate + 1,
                accelerations[rate] * units[rate]
            )));
        }
        let rates = state.numbers.rows_range(state.numbers.len() - units.len()..).into_owned();
        let fastest = rates.component_div(&units).amax();
        let time = if fastest > 0.0 { LATER / fastest } else { 1.0 };
        let mut later = TreeState { time: state.time + time, ..state.clone() };
        let split = later.numbers.len() - units.len();
        let path = &rates * time;
        self.tree.displace(&mut later.numbers.as_mut_slice()[..split], path.as_slice());
        let changes = || {
            let reason = "the linear equations change along the motion, so it is not steady in \
                          joint coordinates";
            invalid(reason.into())
        };
        let bend = self.accelerations(&later, &units).map_err(|_| changes())?;
        let other = self.restricted(&later, &units).map_err(|_| changes())?;
        if other.matrix.shape() != matrix.shape() || bend.amax() > STEADY * matrix.amax() {
            return Err(changes());
        }
        let (here, there) = (own.on_all_deviations(), other.on_all_deviations());
        if (&there - &here).amax() > CONSTANT * here.amax() {
            return Err(changes());
        }
        let (zeros, eigenvalues) = modes(matrix, *displacements);
        Ok(own.with_modes(zeros, eigenvalues))
    }

    /// The accelerations on the constraints, in units of the tree.
    fn accelerations(
        &self,
        state: &TreeState,
        units: &DVector<f64>,
    ) -> Result<DVector<f64>, Error> {
        let slope = self.slope(state.time, &state.numbers);
        match self.take_trouble() {
            Some(reason) => Err(invalid(reason)),
            None => Ok(slope.rows_range(slope.len() - units.len()..).component_div(units)),
        }
    }

    /// The matrix on the deviations that satisfy the constraints, and their basis.
    fn restricted(&self, state: &TreeState, units: &DVector<f64>) -> Result<Restricted, Error> {
        let n = units.len();
        let mut full = DMatrix::zeros(2 * n, 2 * n);
        full.view_mut((0, n), (n, n)).fill_with_identity();
        let rates = state.numbers.rows_range(state.numbers.len() - n..);
        for (first, _) in self.tree.balls() {
            let w = Vector3::new(rates[first], rates[first + 1], rates[first + 2]);
            full.view_mut((first, first), (3, 3)).copy_from(&-w.cross_matrix());
        }
        for which in 0..2 {
            let slopes = self.slopes(state, units, which)?;
            full.view_mut((n, which * n), (n, n)).copy_from(&slopes);
        }
        let [closed, moving] = self.constraint_rows(state, units)?;
        let on_rates = moving.columns(n, n).into_owned();
        let [displacements, changes] =
            [closed, on_rates.clone()].map(|rows| null_space(&rows, ZERO));
        let (d, c) = (displacements.ncols(), changes.ncols());
        let mut basis = DMatrix::zeros(2 * n, d + c);
        basis.view_mut((0, 0), (n, d)).copy_from(&displacements);
        basis.view_mut((n, d), (n, c)).copy_from(&changes);
        // each displacement has the smallest change of the rates that follows from it
        let follows = -(moving.columns(0, n) * &displacements);
        for (k, right) in follows.column_iter().enumerate().filter(|_| !on_rates.is_empty()) {
            let change = least_squares(&on_rates, &right.into_owned());
            basis.view_mut((n, k), (n, 1)).copy_from(&change);
        }
        let image = full * &basis;
        let mut matrix = DMatrix::zeros(d + c, d + c);
        matrix.rows_mut(0, d).copy_from(&displacements.tr_mul(&image.rows(0, n)));
        matrix.rows_mut(d, c).copy_from(&changes.tr_mul(&image.rows(n, n)));
        Ok(Restricted { matrix, basis, displacements: d })
    }

    /// The derivatives of the accelerations with respect to displacements (`which` is 0) or rates (1),
    /// in units of the tree.
    fn slopes(
        &self,
        state: &TreeState,
        units: &DVector<f64>,
        which: usize,
    ) -> Result<DMatrix<f64>, Error> {
        let n = units.len();
        let mut slopes = DMatrix::zeros(n, n);
        for k in 0..n {
            let value = |s: f64| {
                let y = self.displaced(state, k, s * units[k], which);
                let slope = self.slope(state.time, &y);
                slope.rows_range(slope.len() - n..).component_div(units)
            };
            slopes.column_mut(k).copy_from(&derivative(value, WIDTHS));
        }
        // reasons of wide intervals, which were not used
        let trouble = self.take_trouble();
        if slopes.iter().all(|slope| slope.is_finite()) {
            return Ok(slopes);
        }
        Err(invalid(trouble.unwrap_or_else(|| "accelerations have no derivatives".into())))
    }

    /// The rows of the constraints on displacements, and of those on deviations of displacements and
    /// rates, in units of the tree. The longest row of a constraint has length 1.
    fn constraint_rows(
        &self,
        state: &TreeState,
        units: &DVector<f64>,
    ) -> Result<[DMatrix<f64>; 2], Error> {
        let n = units.len();
        let rows =
            |y: &DVector<f64>| self.rows(state.time, y.as_slice(), &mut self.buffers.borrow_mut());
        let here = rows(&state.numbers);
        let count = here.values.len();
        let in_units = DMatrix::from_diagonal(units);
        let matrix = here.matrix() * &in_units;
        let mut moving = DMatrix::zeros(count, 2 * n);
        moving.view_mut((0, n), (count, n)).copy_from(&matrix);
        let rates = state.numbers.rows_range(state.numbers.len() - n..).into_owned();
        for k in 0..n {
            let value = |s: f64| rows(&self.displaced(state, k, s * units[k], 0)).residual(&rates);
            moving.column_mut(k).copy_from(&derivative(value, WIDTHS));
        }
        let of_position: Vec<usize> =
            (0..count).filter(|row| here.values[*row].is_some()).collect();
        let mut closed = matrix.select_rows(&of_position);
        let mut longest = vec![0.0_f64; count];
        for (row, first) in here.first.iter().enumerate() {
            longest[*first] = longest[*first].max(matrix.row(row).norm());
        }
        let size = |row: usize| match longest[here.first[row]] {
            0.0 => 1.0,
            size => size,
        };
        moving.row_iter_mut().enumerate().for_each(|(row, mut own)| own /= size(row));
        let of_position = of_position.iter().copied().zip(closed.row_iter_mut());
        of_position.for_each(|(row, mut own)| own /= size(row));
        if !closed.iter().chain(moving.iter()).all(|entry| entry.is_finite()) {
            return Err(invalid("the constraints are not finite".into()));
        }
        Ok([closed, moving])
    }

    /// The numbers of a state after a displacement along one rate (`which` is 0), or with a change of
    /// one rate (1).
    fn displaced(&self, state: &TreeState, rate: usize, by: f64, which: usize) -> DVector<f64> {
        let mut y = state.numbers.clone();
        let split = y.len() - self.tree.freedom();
        if which == 1 {
            y[split + rate] += by;
            return y;
        }
        let mut displacement = vec![0.0; self.tree.freedom()];
        displacement[rate] = by;
        self.tree.displace(&mut y.as_mut_slice()[..split], &displacement);
        y
    }
}

/// The linear equations on the deviations that satisfy the constraints.
struct Restricted {
    matrix: DMatrix<f64>,
    basis: DMatrix<f64>,
    /// The number of deviations with displacements, which come first.
    displacements: usize,
}

impl Restricted {
    /// The matrix on all deviations. It does not depend on the choice of the basis, and vanishes on
    /// deviations that are orthogonal to the displacements and changes of the basis.
    fn on_all_deviations(&self) -> DMatrix<f64> {
        let (n, d) = (self.basis.nrows() / 2, self.displacements);
        let mut left = self.basis.transpose();
        left.view_mut((0, n), (d, n)).fill(0.0);
        &self.basis * &self.matrix * left
    }

    /// The result with these eigenvalues.
    fn with_modes(self, zeros: usize, eigenvalues: Vec<Complex<f64>>) -> Linearization {
        let rates = self.basis.nrows() / 2;
        let displacements = self.basis.rows(0, rates).map(Complex::from);
        let shapes = eigenvalues.iter().map(|value| {
            let sizes = (&displacements * vector(&self.matrix, value)).map(|x| x.norm());
            let largest = sizes.max();
            sizes.iter().map(|x| if largest > 0.0 { x / largest } else { 0.0 }).collect()
        });
        let shapes = shapes.collect();
        let Restricted { matrix, basis, .. } = self;
        Linearization { matrix, basis, zeros, eigenvalues, shapes }
    }
}

/// The number of eigenvalues that vanish, and the other eigenvalues. The first `d` rows are the time
/// derivatives of displacements.
fn modes(matrix: &DMatrix<f64>, d: usize) -> (usize, Vec<Complex<f64>>) {
    let n = matrix.nrows();
    // the unit of time in which the entries are at most about 1
    let (slow, fast) = (matrix.view((d, 0), (n - d, d)), matrix.view((d, d), (n - d, n - d)));
    let rate = slow.amax().sqrt().max(fast.amax());
    let rate = if rate > 0.0 { rate } else { 1.0 };
    let mut reduced = matrix.clone();
    reduced.view_mut((0, d), (d, n - d)).scale_mut(rate);
    reduced.view_mut((d, 0), (n - d, d)).scale_mut(1.0 / rate);
    let largest = reduced.amax();
    for mut row in reduced.row_iter_mut() {
        let least = NOISE[0] * row.amax() + NOISE[1] * largest;
        row.iter_mut().filter(|x| x.abs() <= least).for_each(|x| *x = 0.0);
    }
    if n > 0 {
        // a stiff part does not hide a soft one
        balance_parlett_reinsch(&mut reduced);
    }
    // the quotient by generalized eigenvectors of 0
    loop {
        if reduced.is_empty() {
            return (n, vec![]);
        }
        let null = null_space(&reduced, ZERO);
        if null.ncols() == 0 {
            break;
        }
        let rest = null_space(&null.transpose(), ZERO);
        reduced = rest.transpose() * &reduced * &rest;
    }
    let zeros = n - reduced.nrows();
    let mut eigenvalues: Vec<Complex<f64>> =
        Schur::new(reduced.clone()).complex_eigenvalues().iter().copied().collect();
    eigenvalues.sort_by(|a, b| b.re.total_cmp(&a.re).then(b.im.total_cmp(&a.im)));
    (zeros, eigenvalues)
}

/// An eigenvector of a matrix, by inverse iteration.
fn vector(matrix: &DMatrix<f64>, value: &Complex<f64>) -> DVector<Complex<f64>> {
    let n = matrix.nrows();
    // the shift avoids a singular matrix
    let shift = value + Complex::from(f64::EPSILON.sqrt() * matrix.norm());
    let shifted = (matrix.map(Complex::from) - DMatrix::identity(n, n) * shift).lu();
    let mut vector = DVector::from_fn(n, |k, _| Complex::from(1.0 + 0.1 * k as f64));
    for _ in 0..3 {
        match shifted.solve(&vector) {
            Some(next) => vector = next.normalize(),
            None => break,
        }
    }
    vector
}

fn invalid(reason: String) -> Error {
    Error::Invalid { what: "linearization", reason }
}
