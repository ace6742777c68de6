//! The smallest and the largest sectional curvature of a left-invariant metric.
//!
//! In three dimensions, the plane orthogonal to `n` has the curvature `S/2 - Ric(n,n)/g(n,n)`, so
//! the extremes belong to eigenvectors of the Ricci endomorphism (J. Milnor, *Adv. Math.* 21 (1976)
//! 293-329, section 4). In other dimensions, a search in floats starts from vectors of an
//! orthonormal basis, and their sums and differences. For a fixed `x`, the best `y` is an
//! eigenvector of the form `g(R(x,y)y,x)`; then `x` is optimized for this `y`, and so on. The
//! resulting plane is rounded to rational vectors, and its curvature is computed exactly.

use super::Property;
use crate::Error;
use crate::algebra::frame::Frame;
use crate::algebra::structure::Killing;
use crate::algebra::{LieAlgebra, irreducible_factors};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::Matrix;
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Rational, Ring, Tensor};
use nalgebra::{DMatrix, DVector};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};
use polycore::Uni;

/// The largest dimension in which the extremes of the sectional curvature are searched for.
pub const MAX_SEARCHED: usize = 12;

/// The largest number of improvements of one plane.
const ROUNDS: usize = 60;
const LAST_ROUNDS: usize = 5000;
/// The number of starting planes with pseudorandom vectors, in addition to those of the basis.
const RANDOM_STARTS: usize = 40;
/// The denominators of the components of the plane that are tried, in order. An error `e` of the
/// plane changes an extreme curvature by `e^2`. The last denominator therefore causes an error in
/// the order of the rounding errors.
const DENOMINATORS: [i64; 10] = [1, 2, 3, 4, 5, 6, 8, 10, 12, 100_000_000];

/// An extreme of the sectional curvature, either smallest or largest, with its plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    /// The exact curvature of the plane.
    pub curvature: Rational,
    /// Two vectors that span the plane.
    pub plane: [Vec<Rational>; 2],
    /// Whether the curvature is proved to be extreme. Otherwise, a search has found no better
    /// plane.
    pub proved: bool,
}

impl Metric<Rational> {
    /// The smallest and the largest sectional curvature of the left-invariant metric. Returns
    /// `None` for an indefinite metric, in dimension 1, and beyond [`MAX_SEARCHED`]. The extremes
    /// are proved if the curvature is constant, and in dimension 3 if the eigenvalues of the Ricci
    /// endomorphism are rational. For a bi-invariant metric, the bound 0 is also proved, because
    /// `K = |[x,y]|^2/4` for orthonormal `x`, `y`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let [least, most] = Metric::identity(3)?.sectional_extremes(&algebra)?.expect("definite");
    /// assert_eq!(least.curvature, Rational::new(-3, 4).expect("4 is not 0"));
    /// assert_eq!(most.curvature, Rational::new(1, 4).expect("4 is not 0"));
    /// assert!(least.proved && most.proved);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn sectional_extremes(
        &self,
        algebra: &LieAlgebra<Rational>,
    ) -> Result<Option<[Extreme; 2]>, Error> {
        let found = self.sectional_extremes_in(algebra.left_frame())?;
        let Some([mut least, mut most]) = found else { return Ok(None) };
        if self.ad_invariance_defect(algebra)?.is_empty() {
            let positive = self.definite(algebra.dimension())?.is_some_and(|sign| sign > 0.0);
            let bound = if positive { &mut least } else { &mut most };
            bound.proved |= bound.curvature.vanishes();
        }
        Ok(Some([least, most]))
    }

    /// The extremes of the sectional curvature as in
    /// [`sectional_extremes`](Self::sectional_extremes), for an invariant metric in the frame of a
    /// homogeneous space.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn sectional_extremes_in(
        &self,
        frame: &Frame<Rational>,
    ) -> Result<Option<[Extreme; 2]>, Error> {
        let _stage = stage("sectional curvature");
        let n = frame.dimension();
        let Some(sign) = self.definite(n)? else { return Ok(None) };
        if !(2..=MAX_SEARCHED).contains(&n) {
            return Ok(None);
        }
        let connection = Connection::levi_civita(frame, self)?;
        let unit = |at: usize| (0..n).map(|i| Rational::from_i64(i64::from(i == at))).collect();
        if let Property::Holds(curvature) = connection.constant_curvature(self)? {
            let extreme = Extreme { curvature, plane: [unit(0), unit(1)], proved: true };
            return Ok(Some([extreme.clone(), extreme]));
        }
        if n == 3
            && let Some(extremes) = self.by_ricci(&connection)?
        {
            return Ok(Some(extremes));
        }
        let search = Search::new(&connection, self, sign)?;
        let Some(search) = search else { return Ok(None) };
        let mut found: Vec<Extreme> = vec![];
        for plane in [search.best(-sign), search.best(sign)] {
            let [x, y] = &plane;
            let Some(curvature) = connection.sectional_curvature(self, x, y)? else {
                return Ok(None);
            };
            found.push(Extreme { curvature, plane, proved: false });
        }
        Ok(found.try_into().ok())
    }

    /// The sign of a definite metric; `None` if the metric is indefinite.
    fn definite(&self, n: usize) -> Result<Option<f64>, Error> {
        self.expect_dimension(n)?;
        let mut rows = vec![vec![]; n];
        self.components().components().for_each(|(at, v)| rows[at[0]].push((at[1], v.clone())));
        let signature = Killing::new(Matrix::from_rows(n, rows)?).signature();
        Ok(signature.and_then(|[plus, minus, _]| match (plus, minus) {
            (_, 0) => Some(1.0),
            (0, _) => Some(-1.0),
            _ => None,
        }))
    }

    /// The extremes in three dimensions, if the eigenvalues of the Ricci endomorphism are rational.
    fn by_ricci(&self, connection: &Connection<Rational>) -> Result<Option<[Extreme; 2]>, Error> {
        let ricci = connection.ricci().raise(0, self.inverse())?;
        let rows: Vec<Vec<Rational>> =
            (0..3).map(|i| (0..3).map(|j| ricci.get(&[i, j])).collect()).collect();
        let ricci = Matrix::from_dense(&rows)?;
        let square = ricci.mul(&ricci)?;
        let trace = |m: &Matrix<Rational>| (0..3).fold(Rational::from(0), |t, i| t + &m.get(i, i));
        let (t, half) = (trace(&ricci), ratio(1, 2));
        let second = (t.clone() * &t - &trace(&square)) * &half;
        let coefficients = [-ricci.determinant()?, second, -t.clone(), Rational::from(1)];
        let big = Uni::new(coefficients.iter().map(BigRational::from).collect());
        let factors = irreducible_factors(&big);
        if factors.iter().any(|(factor, _)| factor.deg() != 1) {
            return Ok(None);
        }
        let mut values: Vec<Rational> =
            factors.iter().map(|(f, _)| -Rational::from(&f.0[0] / &f.0[1])).collect();
        values.sort_by(|a, b| BigRational::from(a).cmp(&BigRational::from(b)));
        let mut extremes = vec![];
        for value in [values.last(), values.first()].into_iter().flatten() {
            let shift = Matrix::diagonal(std::iter::repeat_n(-value.clone(), 3));
            let normal = ricci.add(&shift)?.nullspace()?.to_dense().swap_remove(0);
            let plane = Matrix::from_dense(&[self.lower(&normal)?])?.nullspace()?.to_dense();
            let Ok(plane) = <[Vec<Rational>; 2]>::try_from(plane) else { return Ok(None) };
            let curvature = t.clone() * &half - value;
            extremes.push(Extreme { curvature, plane, proved: true });
        }
        Ok(extremes.try_into().ok())
    }
}

/// A search for planes. The curvature is stored in floats, in an orthonormal basis of the metric or
/// of the negative metric.
struct Search {
    n: usize,
    /// The vectors of the orthonormal basis, as columns.
    basis: DMatrix<f64>,
    /// The components `R_ijkl` in the orthonormal basis, as a dense list.
    curvature: Vec<f64>,
}

impl Search {
    fn new(
        connection: &Connection<Rational>,
        metric: &Metric<Rational>,
        sign: f64,
    ) -> Result<Option<Self>, Error> {
        let n = connection.frame().dimension();
        let float = |value: BigRational| value.to_f64().unwrap_or(f64::NAN);
        // scales the largest component to 1, because a scaling of the metric or the structure
        // constants does not change the planes
        let dense = |tensor: &Tensor<Rational>| {
            let exact = tensor.components().map(|(at, value)| (at, BigRational::from(value)));
            let exact: Vec<_> = exact.collect();
            let largest = exact.iter().map(|(_, value)| value.abs()).max();
            let largest = largest.unwrap_or_else(BigRational::one);
            let mut values = vec![0.0; n.pow(tensor.slots().len() as u32)];
            for (at, value) in exact {
                values[at.iter().fold(0, |place, i| place * n + i)] =
                    sign * float(value / &largest);
            }
            values
        };
        let gram = DMatrix::from_row_slice(n, n, &dense(metric.components()));
        let Some(cholesky) = gram.cholesky() else { return Ok(None) };
        let Some(basis) = cholesky.l().transpose().try_inverse() else { return Ok(None) };
        let mut curvature = dense(&connection.curvature().lower(0, metric.components())?);
        // transforms all four indices: each pass transforms the first index and moves it to the end
        for _ in 0..4 {
            let matrix = DMatrix::from_row_slice(n, n * n * n, &curvature);
            curvature = (matrix.transpose() * &basis).transpose().as_slice().to_vec();
        }
        let largest = curvature.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            return Ok(None);
        }
        curvature.iter_mut().for_each(|value| *value /= largest);
        Ok(Some(Search { n, basis, curvature }))
    }

    /// The plane with the best curvature that is found: the largest if `side` is 1, or the smallest
    /// if it is -1.
    fn best(&self, side: f64) -> [Vec<Rational>; 2] {
        let mut best: Option<(f64, [DVector<f64>; 2])> = None;
        for plane in self.starts(side) {
            let (value, plane) = self.improved(plane, side, ROUNDS);
            // requires a small improvement, so that the first plane in the order of the basis is
            // chosen among equal planes
            if best.as_ref().is_none_or(|(known, _)| side * (value - known) > 1e-9) {
                best = Some((value, plane));
            }
        }
        let (_, plane) = best.expect("a plane, for the dimension is at least 2");
        let (_, [x, y]) = self.improved(plane, side, LAST_ROUNDS);
        rounded(&(&self.basis * x), &(&self.basis * y))
    }

    /// Improves a plane: replaces one vector by the best partner of the other, alternately for both
    /// vectors, until the curvature no longer changes. The tolerance is absolute, because the
    /// curvatures are of the order of 1.
    fn improved(
        &self,
        [mut x, mut y]: [DVector<f64>; 2],
        side: f64,
        rounds: usize,
    ) -> (f64, [DVector<f64>; 2]) {
        let mut value = self.value(&x, &y);
        let mut unchanged = 0;
        for _ in 0..rounds {
            checkpoint();
            let next = self.partner(&x, side);
            let improved = self.value(&x, &next);
            if side * (improved - value) > 1e-15 {
                (y, value, unchanged) = (next, improved, 0);
            } else {
                unchanged += 1;
            }
            if unchanged == 2 {
                break;
            }
            std::mem::swap(&mut x, &mut y);
        }
        (value, [x, y])
    }

    /// The starting planes. Some are pairs of basis vectors; others contain sums and differences of
    /// basis vectors, or pseudorandom vectors, with their best partners. Pairs are not sufficient,
    /// because two basis vectors may be each other's best partners although their plane is not
    /// extreme.
    fn starts(&self, side: f64) -> Vec<[DVector<f64>; 2]> {
        let n = self.n;
        let unit = |at: usize| DVector::from_fn(n, |row, _| f64::from(u8::from(row == at)));
        let pairs = || (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        let coordinate = pairs().map(|(i, j)| [unit(i), unit(j)]);
        let diagonal = pairs().flat_map(|(i, j)| [unit(i) + unit(j), unit(i) - unit(j)]);
        let mut state = 0x9e37_79b9_u64;
        let mut draw = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let random: Vec<DVector<f64>> =
            (0..RANDOM_STARTS).map(|_| DVector::from_fn(n, |_, _| draw())).collect();
        let with_partner = diagonal.chain(random).map(|x| {
            let x = x.normalize();
            let y = self.partner(&x, side);
            [x, y]
        });
        coordinate.chain(with_partner).collect()
    }

    /// The symmetric matrix `M_jl = R_ijkl x^i x^k`.
    fn form(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let n = self.n;
        let entry = |j: usize, l: usize| {
            let pairs = (0..n).flat_map(|i| (0..n).map(move |k| (i, k)));
            pairs
                .map(|(i, k)| self.curvature[((i * n + j) * n + k) * n + l] * x[i] * x[k])
                .sum::<f64>()
        };
        DMatrix::from_fn(n, n, |j, l| (entry(j, l) + entry(l, j)) / 2.0)
    }

    fn value(&self, x: &DVector<f64>, y: &DVector<f64>) -> f64 {
        y.dot(&(self.form(x) * y))
    }

    /// The unit vector that is orthogonal to `x` and for which the curvature is extreme.
    fn partner(&self, x: &DVector<f64>, side: f64) -> DVector<f64> {
        let form = self.form(x) * side;
        let shift = 2.0 * form.norm() + 1e-3;
        let eigen = (form - x * x.transpose() * shift).symmetric_eigen();
        eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned()
    }
}

/// Rational vectors that approximate a plane. In two components, the vectors are (1, 0) and (0, 1);
/// the other components are rounded.
fn rounded(x: &DVector<f64>, y: &DVector<f64>) -> [Vec<Rational>; 2] {
    let n = x.len();
    // chooses two components i, j with the largest minor; there the two vectors become (1, 0) and
    // (0, 1)
    let minor = |i: usize, j: usize| x[i] * y[j] - x[j] * y[i];
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let larger = |a: &(usize, usize), b: &(usize, usize)| {
        minor(a.0, a.1).abs() > minor(b.0, b.1).abs() * (1.0 + 1e-6)
    };
    let (i, j) = pairs.reduce(|a, b| if larger(&b, &a) { b } else { a }).unwrap_or((0, 1));
    let scale = minor(i, j);
    let first = (x * y[j] - y * x[j]) / scale;
    let second = (y * x[i] - x * y[i]) / scale;
    let round = |vector: DVector<f64>| {
        let far = |v: f64| (v - v.round()).abs() > 1e-6;
        let near = |d: i64| !vector.iter().any(|v| far(v * d as f64));
        let last = DENOMINATORS[DENOMINATORS.len() - 1];
        let d = DENOMINATORS.into_iter().find(|&d| near(d)).unwrap_or(last);
        let component = |v: &f64| ratio((v * d as f64).round() as i64, d);
        vector.iter().map(component).collect()
    };
    [round(first), round(second)]
}

fn ratio(above: i64, below: i64) -> Rational {
    Rational::new(above, below).expect("a denominator of the list")
}
