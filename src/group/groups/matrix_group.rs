//! Groups of real matrices, given by a basis of their algebra.

mod fit;
mod half_turn;
mod span;
mod splitting;

use crate::algebra::Complex;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, TOLERANCE, checked, expect_shape, replace};
use crate::group::{Embedded, LieGroup};
use crate::numerics::double::{self, Double};
use crate::numerics::exponential::{
    balance, balanced, balanced_by, exp, exp_less_identity, unbalanced,
};
use crate::numerics::logarithm::{logarithm, logarithm_of_double, near_identity};
use crate::numerics::rounding::expect_digits_of_product;
use crate::{Bracket, Error, Law, LieAlgebra, MatrixBasis};
use affinor_tensors::Tolerance;
use affinor_tensors::linear::Matrix;
use nalgebra::{DMatrix, DVector};
use span::Span;
use splitting::translations;

/// The relative distance from the algebra that roundings give a logarithm.
const OUTSIDE: f64 = 1e-9;

/// The largest norm of generators from whose exponentials 1 is left out before they are multiplied, so that the product less
/// 1 is at most a quarter.
const SHORT: f64 = 0.1;

/// The largest error of a product in floats, in roundings per row, that suffices.
const ACCURATE: f64 = 4.0;

/// The largest number of rows of matrices in double-double arithmetic, which takes a hundred times longer.
const ROWS: usize = 64;

/// The relative rounding error of a logarithm from which on that of the nearest element is computed.
const ILL_CONDITIONED: f64 = 1e-14;

/// The relative distance from the algebra of a logarithm from which the nearest element is sought.
const CLOSE: f64 = 0.1;

/// The largest power of an element whose logarithm is tested. It covers the orders of the centres of small classical groups,
/// and of half and third turns.
const POWERS: usize = 12;

/// The relative rounding of the trace and of powers of a generator.
const ROUNDING: f64 = 1e-12;

/// The group of the exponentials of a Lie algebra of real matrices, and their products.
///
/// ```
/// use affinor::group::{LieGroup, MatrixGroup};
/// use nalgebra::{DMatrix, DVector};
/// // the affine maps s -> a s + b of the line, a > 0
/// let stretch = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]);
/// let shift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
/// let line = MatrixGroup::new(&[stretch, shift])?;
/// let x = DVector::from_vec(vec![0.5, 2.0]);
/// let g = line.exp(&x);
/// assert!((g[(0, 1)] - 2.0 * 0.5_f64.exp_m1() / 0.5).abs() < 1e-14);
/// assert!((line.log(&g)? - x).norm() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct MatrixGroup {
    span: Span,
    bracket: Bracket<f64>,
    /// The projection on the translations, if there are any.
    translations: Option<DMatrix<f64>>,
    /// The diagonal of a form `F` that the group preserves, `g^T F g = F`, if there is one: that of so(p,q), su(p,q).
    form: Option<DVector<f64>>,
}

impl MatrixGroup {
    /// The group of the span of square matrices of one size.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Law::Independent`];
    /// [`Law::Closure`] with the first commutator that leaves the span.
    pub fn new(matrices: &[DMatrix<f64>]) -> Result<Self, Error> {
        Self::with_labels(matrices, (1..=matrices.len()).map(|at| format!("e{at}")))
    }

    /// The group of the span of square matrices of one size, with names for the basis vectors.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`Error::Shape`] unless there are as many names as matrices.
    pub fn with_labels(
        matrices: &[DMatrix<f64>],
        labels: impl IntoIterator<Item: AsRef<str>>,
    ) -> Result<Self, Error> {
        Self::from_basis(&MatrixBasis::from_dmatrices(labels, matrices)?)
    }

    /// The group of a basis of matrices; complex ones `A + iB` act as `[[A, -B], [B, A]]`.
    ///
    /// # Errors
    /// [`Law::Closure`]; [`Error::Shape`] without a matrix.
    pub fn from_basis(basis: &MatrixBasis<f64>) -> Result<Self, Error> {
        let bracket = basis.bracket()?;
        Self::with_bracket(basis, bracket)
    }

    /// The group of matrices whose bracket is known.
    fn with_bracket(basis: &MatrixBasis<f64>, bracket: Bracket<f64>) -> Result<Self, Error> {
        let matrices = basis.matrices();
        let Some(first) = matrices.first() else {
            let (expected, found) = ("at least one matrix".into(), "none".into());
            return Err(Error::Shape { what: "the basis", expected, found });
        };
        let span = Span::new(
            first.rows(),
            matrices.iter().map(|m| m.entries().map(|(i, j, v)| (i, j, *v))),
        )?;
        let form = diagonal_form(matrices, first.rows());
        let orthogonal = form.as_ref().is_some_and(is_identity);
        let translations =
            if orthogonal { None } else { translations(bracket.structure_constants()) };
        Ok(MatrixGroup { span, bracket, translations, form })
    }

    /// The group `exp(ad_x)` of inner automorphisms of an algebra without a centre: near the identity it is
    /// isomorphic to any group of the algebra.
    ///
    /// # Errors
    /// [`Law::FaithfulAdjoint`] with a central vector, which acts as 0.
    pub fn adjoint(algebra: &LieAlgebra<f64>) -> Result<Self, Error> {
        Self::represented(algebra, algebra.dimension(), adjoint_matrices(algebra))
    }

    /// A matrix group with this algebra: `exp(ad_x)` on `g` or, if the algebra has a centre, on the sum of `g` and its
    /// derivations `D`, with `[x, D] = -D x`.
    ///
    /// # Errors
    /// [`Law::FaithfulAdjoint`] with a central vector that every derivation maps to 0;
    /// [`Error::Size`] if the algebra has a centre and its derivations are too many to solve for.
    pub fn of_algebra(algebra: &LieAlgebra<f64>) -> Result<Self, Error> {
        match Self::adjoint(algebra) {
            Err(Error::Broken { law: Law::FaithfulAdjoint, .. }) => {}
            faithful => return faithful,
        }
        let derivations = derivations(algebra)?;
        let n = algebra.dimension();
        let mut matrices = adjoint_matrices(algebra);
        for (x, matrix) in matrices.iter_mut().enumerate() {
            for (at, derivation) in derivations.iter().enumerate() {
                let image = derivation.column(x);
                matrix.extend(image.iter().enumerate().map(|(i, value)| (i, n + at, -value)));
            }
        }
        Self::represented(algebra, n + derivations.len(), matrices)
    }

    /// The group of matrices of a representation: they have the bracket of the algebra.
    fn represented(
        algebra: &LieAlgebra<f64>,
        size: usize,
        matrices: Vec<Entries>,
    ) -> Result<Self, Error> {
        let real = |m: Entries| m.into_iter().map(|(i, j, v)| (i, j, Complex::real(v))).collect();
        let matrices = matrices.into_iter().map(real).collect();
        match MatrixBasis::new(algebra.labels(), size, matrices, Tolerance::default()) {
            Err(Error::Broken { law: Law::Independent, at, residual }) => {
                Err(Law::FaithfulAdjoint.broken(at, residual))
            }
            basis => Self::with_bracket(
                &basis?,
                Bracket::new(algebra.labels(), algebra.structure_constants().clone())?,
            ),
        }
    }

    /// Checks necessary conditions for an element whose entries have the relative error `tolerance`. It is invertible and has
    /// a positive determinant, 1 if all generators are traceless. `Ad_g` maps the algebra to itself. The principal logarithm of
    /// `g` or of a power of it lies in the algebra; in SU(n) that of `g` itself need not.
    ///
    /// The test cannot detect a factor of finite order that normalises the algebra, such as an element of another component
    /// of the pseudo-orthogonal matrices. If the group is not closed, elements far from 1 may be refused.
    ///
    /// # Errors
    /// [`Error::Invalid`] with what fails.
    pub fn expect_element(&self, g: &DMatrix<f64>, tolerance: f64) -> Result<(), Error> {
        let refused = |reason: String| Err(Error::Invalid { what: "element of the group", reason });
        let Some(inverse) = g.clone().try_inverse() else {
            return refused("it is singular".into());
        };
        let tolerance = tolerance * (1.0 + g.norm() * inverse.norm());
        let determinant = g.determinant();
        let traceless = |at| self.span.trace(at).abs() <= ROUNDING * self.span.norm(at);
        let special = (0..self.dimension()).all(traceless);
        let is_one = (determinant - 1.0).abs() <= tolerance;
        if (special && !is_one) || determinant <= 0.0 {
            return refused(format!("its determinant is {determinant}"));
        }
        for at in 0..self.dimension() {
            let off = self.outside(&self.span.between(g, at, &inverse));
            if off.is_nan() || off > tolerance * self.span.norm(at) {
                let vector = at + 1;
                return refused(format!(
                    "Ad takes basis vector {vector} out of the algebra by {off:e}"
                ));
            }
        }
        let (mut power, mut witness) = (g.clone(), None);
        for k in 1..=POWERS {
            if let Ok(log) = logarithm(&power) {
                let off = self.outside(&log);
                if off <= tolerance * k as f64 * (1.0 + log.norm()) {
                    return Ok(());
                }
                witness = witness.or(Some((k, off)));
            }
            power = &power * g;
        }
        match witness {
            Some((1, off)) => refused(format!("its logarithm leaves the algebra by {off:e}")),
            Some((k, off)) => {
                refused(format!("the logarithm of its power {k} leaves the algebra by {off:e}"))
            }
            // there is none to look at
            None => Ok(()),
        }
    }

    /// The matrix of a vector, `x^i B_i`.
    pub fn generator(&self, x: &DVector<f64>) -> DMatrix<f64> {
        self.span.combination(x)
    }

    /// The components of the matrix of the algebra that is nearest to `m`, entry by entry.
    pub fn components(&self, m: &DMatrix<f64>) -> DVector<f64> {
        self.span.coordinates(m)
    }

    /// The distance of a matrix from the algebra.
    fn outside(&self, m: &DMatrix<f64>) -> f64 {
        (self.generator(&self.components(m)) - m).norm()
    }

    /// The coordinates of a logarithm, if it lies in the algebra.
    fn in_algebra(&self, log: DMatrix<f64>) -> Result<DVector<f64>, Error> {
        let outside = self.outside(&log);
        if outside <= OUTSIDE * (1.0 + log.norm()) {
            return Ok(self.components(&log));
        }
        let reason = format!("the principal logarithm leaves the algebra by {outside:e}");
        Err(Error::Invalid { what: "logarithm", reason })
    }

    /// `log(exp(x) exp(y))` of generators that are balanced by `exponents`.
    fn product_in_floats(&self, [x, y]: [DMatrix<f64>; 2], exponents: &[i32]) -> FloatProduct {
        let (terms, log) = if x.norm().max(y.norm()) <= SHORT {
            // g h - 1, of factors near 1
            let [g, h] = [&x, &y].map(exp_less_identity);
            (x.norm() + y.norm(), near_identity(&(&g + &h + &g * &h)))
        } else {
            let (g, h) = (exp(&x), exp(&y));
            let (back, first) = (exp(&-x), exp(&-y));
            // cancellation: the inverse may be small by chance
            let rounding = f64::EPSILON * first.norm() * back.norm();
            let inverse = (first * back).norm().max(rounding);
            (g.norm() * h.norm() * inverse, logarithm(&(g * h)))
        };
        let size = log.as_ref().map_or(0.0, DMatrix::norm);
        let log = log.map(|log| unbalanced(&log, exponents));
        // the factors of orthogonal matrices have the norm sqrt(n)
        let roundings = ACCURATE * self.size() as f64;
        match log {
            // near a half turn the errors leave the algebra
            Ok(log)
                if terms <= roundings * size
                    && self.outside(&log) <= roundings * f64::EPSILON * log.norm() =>
            {
                FloatProduct::Accurate(log)
            }
            log => FloatProduct::Lost { terms, log },
        }
    }

    fn size(&self) -> usize {
        self.span.size()
    }
}

/// `log(exp(x) exp(y))` in floats.
enum FloatProduct {
    /// Right to a few roundings.
    Accurate(DMatrix<f64>),
    /// With the error of so many roundings.
    Lost { terms: f64, log: Result<DMatrix<f64>, Error> },
}

/// The diagonal of a form `F` with `F B + B^T F = 0` for all matrices, if there is one: `F_i B_ij = -F_j B_ji`.
fn diagonal_form(matrices: &[Matrix<f64>], size: usize) -> Option<DVector<f64>> {
    let mut neighbours = vec![vec![]; size];
    for matrix in matrices {
        for (i, j, value) in matrix.entries() {
            let mirrored = matrix.get(j, i);
            if mirrored == 0.0 || i == j {
                return None;
            }
            neighbours[i].push((j, -value / mirrored));
        }
    }
    let mut form = vec![None; size];
    for start in 0..size {
        let mut waiting = if form[start].is_none() { vec![(start, 1.0)] } else { vec![] };
        while let Some((i, value)) = waiting.pop() {
            match form[i] {
                None => {
                    form[i] = Some(value);
                    waiting.extend(neighbours[i].iter().map(|(j, share)| (*j, value * share)));
                }
                Some(known) if (value / known - 1.0_f64).abs() > ROUNDING => return None,
                Some(_) => {}
            }
        }
    }
    form.into_iter().collect::<Option<Vec<f64>>>().map(DVector::from_vec)
}

/// Whether a form is that of orthogonal matrices.
fn is_identity(form: &DVector<f64>) -> bool {
    form.iter().all(|value| *value == 1.0)
}

/// The entries `(row, column, value)` of a matrix.
type Entries = Vec<(usize, usize, f64)>;

/// The matrices of `[e_j, .]`.
fn adjoint_matrices(algebra: &LieAlgebra<f64>) -> Vec<Entries> {
    let mut matrices = vec![vec![]; algebra.dimension()];
    algebra
        .structure_constants()
        .components()
        .for_each(|(at, c)| matrices[at[1]].push((at[0], at[2], *c)));
    matrices
}

/// The largest dimension of an algebra with a centre.
const LARGEST: usize = 24;

/// A basis of the derivations, `D [x, y] = [D x, y] + [x, D y]`.
fn derivations(algebra: &LieAlgebra<f64>) -> Result<Vec<DMatrix<f64>>, Error> {
    let n = algebra.dimension();
    if n > LARGEST {
        let what = "dimensions of an algebra with a centre";
        return Err(Error::Size { what, size: n, limit: LARGEST });
    }
    // unknown D^i_m is number i n + m; an equation for each i and j < k
    let equation = |i: usize, j: usize, k: usize| (i * n + j) * n + k;
    let mut rows = vec![Vec::new(); n * n * n];
    for (at, c) in algebra.structure_constants().components() {
        let [m, j, k] = [at[0], at[1], at[2]];
        for i in 0..n {
            // D^i_m c^m_jk, c^m_ik D^i_j and c^m_ji D^i_k with the letters of this component
            rows[equation(i, j, k)].push((i * n + m, *c));
            rows[equation(m, i, k)].push((j * n + i, -c));
            rows[equation(m, j, i)].push((k * n + i, -c));
        }
    }
    let solutions = Matrix::from_rows(n * n, rows)?.nullspace()?;
    let matrix = |row: usize| DMatrix::from_fn(n, n, |i, m| solutions.get(row, i * n + m));
    Ok((0..solutions.rows()).map(matrix).collect())
}

/// Sizes are not checked in every call: vectors and matrices of another size than that of the group panic or give a wrong
/// result.
impl LieGroup for MatrixGroup {
    type Element = DMatrix<f64>;
    type Vector = DVector<f64>;

    fn dimension(&self) -> usize {
        self.span.dimension()
    }

    fn identity(&self) -> Self::Element {
        DMatrix::identity(self.size(), self.size())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    /// `F^-1 g^T F` if the group preserves a diagonal form `F`: its rounding is that of `g`. Orthogonal matrices need it not: theirs
    /// is that of `g` too, and their rounding leaves the group. NaN for a singular matrix, which is no element.
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        if let Some(form) = self.form.as_ref().filter(|form| !is_identity(form)) {
            return DMatrix::from_fn(g.nrows(), g.ncols(), |i, j| g[(j, i)] * form[j] / form[i]);
        }
        let nan = || DMatrix::from_element(g.nrows(), g.ncols(), f64::NAN);
        g.clone().try_inverse().unwrap_or_else(nan)
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        exp(&self.generator(x))
    }

    /// The principal logarithm of the matrix, if it lies in the algebra. Other logarithms, as of a rotation by `pi`, are not
    /// computed. Where it is ill-conditioned, the logarithm of the nearest element of the group.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        expect_shape(g, (self.size(), self.size()))?;
        let (balanced, _) = balanced(g);
        let inverse = balanced.clone().try_inverse();
        let lost = inverse.map_or(0.0, |inverse| balanced.norm() * inverse.norm() * f64::EPSILON);
        let is_ill_conditioned = lost > ILL_CONDITIONED && self.size() <= ROWS;
        let log = if is_ill_conditioned {
            let one = DMatrix::identity(self.size(), self.size());
            logarithm_of_double(&(g.map(Double::from) - one))
        } else {
            logarithm(g)
        };
        let log = match log {
            Ok(log) => log,
            Err(error) => {
                return self
                    .log_near_half_turn(g)
                    .or_else(|| self.log_of_rotation(g))
                    .ok_or_else(|| half_turn::near_pi(g).unwrap_or(error));
            }
        };
        let outside = self.outside(&log) / (1.0 + log.norm());
        if (is_ill_conditioned || outside > OUTSIDE)
            && outside <= CLOSE
            && let Some(x) = fit::nearest(&self.span, g, &self.components(&log))
        {
            return Ok(x);
        }
        self.in_algebra(log)
    }

    /// `g x g^-1`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.components(&(g * self.generator(x) * self.inverse(g)))
    }

    /// Not by the inverse of `exp(x)`, which loses its digits where entries are large.
    fn adjoint_exp(&self, x: &Self::Vector) -> DMatrix<f64> {
        let mut ad = DMatrix::zeros(self.dimension(), self.dimension());
        let structure = self.bracket.structure_constants();
        structure.components().for_each(|(at, c)| ad[(at[0], at[2])] += c * x[at[1]]);
        exp(&ad)
    }

    /// In double-double arithmetic if the product is ill-conditioned: the logarithm may multiply rounding errors by
    /// `|g h| |(g h)^-1|`. Rejected if the result loses digits even so: an entry of `g h` has the error of a term, about
    /// `|g| |h|` roundings.
    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        let generators = [x, y].map(|x| self.generator(x));
        let exponents = balance(&(generators[0].abs() + generators[1].abs()));
        let balanced = generators.map(|x| balanced_by(&x, &exponents));
        let log = match self.product_in_floats(balanced, &exponents) {
            FloatProduct::Accurate(log) => log,
            FloatProduct::Lost { terms, log } if self.size() > ROWS => {
                expect_digits_of_product(f64::EPSILON * terms)?;
                log?
            }
            FloatProduct::Lost { terms, .. } => {
                expect_digits_of_product(Double::EPSILON * terms)?;
                // g h - 1 has all digits where g and h are near 1
                let [g, h] = [x, y].map(|x| {
                    let generator = self.span.double_combination(x);
                    let balanced = double::mapped(&generator, |m| balanced_by(m, &exponents));
                    double::exp_less_identity(&balanced)
                });
                let product = &g + &h + &g * &h;
                logarithm_of_double(&double::mapped(&product, |m| unbalanced(m, &exponents)))?
            }
        };
        self.in_algebra(log)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let (x, y) = (self.generator(x), self.generator(y));
        self.components(&(&x * &y - &y * &x))
    }

    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        g.clone()
    }

    /// The algebra of the basis, with its labels; zero structure constants are exact.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        LieAlgebra::try_from(self.bracket.clone())
    }
}

impl TranslationSplit for MatrixGroup {
    /// The part in the kernel of the Killing form, if this is abelian and has a complementary subalgebra.
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        self.translations.as_ref().map(|projection| projection * x)
    }

    fn has_translations(&self) -> bool {
        self.translations.is_some()
    }

    /// True for orthogonal matrices.
    fn has_bounded_adjoint(&self) -> bool {
        self.form.as_ref().is_some_and(is_identity)
    }
}

/// The entries, column by column. Points near the group are not projected back.
impl Embedded for MatrixGroup {
    type Ambient = DVector<f64>;

    fn coordinates(&self, g: &Self::Element) -> DVector<f64> {
        DVector::from_column_slice(g.as_slice())
    }

    fn from_coordinates(&self, y: &DVector<f64>) -> Self::Element {
        DMatrix::from_column_slice(self.size(), self.size(), y.as_slice())
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> DVector<f64> {
        self.coordinates(&(g * self.generator(v)))
    }

    fn has_projection(&self) -> bool {
        false
    }
}

/// The matrix.
impl MatrixNotation for MatrixGroup {
    /// As far as [`expect_element`](MatrixGroup::expect_element) can tell.
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            self.expect_element(m, TOLERANCE)?;
            Ok(m.clone())
        })
    }

    /// Whether the generator `B` turns: `B^3 = -w^2 B` with `w > 0`.
    fn is_angle(&self, at: usize) -> bool {
        let b = self.span.matrix(at);
        let cube = &b * &b * &b;
        let square = -cube.dot(&b) / b.norm_squared();
        square > 0.0 && (&cube + &b * square).norm() <= ROUNDING * cube.norm()
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, g.as_slice());
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        (0..self.dimension()).map(|at| self.span.matrix(at)).collect()
    }

    fn log_rounding(&self, g: &Self::Element, x: &Self::Vector) -> Option<f64> {
        fit::rounding(&self.span, g, x)
    }
}
