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

/// Rounding errors may cause this relative distance of a logarithm from the algebra.
const OUTSIDE: f64 = 1e-9;

/// If the norm of the generators is at most this value, the factors `exp(x) - 1` are multiplied
/// instead of `exp(x)`. The product minus 1 then is at most a quarter.
const SHORT: f64 = 0.1;

/// The largest accepted error of a product in floats, in units of rounding errors per row.
const ACCURATE: f64 = 4.0;

/// The largest number of rows of matrices in double-double arithmetic, which is a hundred times
/// slower than floats.
const ROWS: usize = 64;

/// If the relative rounding error of a logarithm exceeds this value, the logarithm of the nearest
/// element is computed.
const ILL_CONDITIONED: f64 = 1e-14;

/// If the relative distance of a logarithm from the algebra is at most this value, the nearest
/// element is searched for.
const CLOSE: f64 = 0.1;

/// The largest power of an element whose logarithm is tested. This limit includes the orders of the
/// centres of small classical groups, and half and third turns.
const POWERS: usize = 12;

/// The relative rounding error of the trace and of powers of a generator.
const ROUNDING: f64 = 1e-12;

/// The group that the exponentials of a Lie algebra of real matrices generate.
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
    /// The projection onto the translations; `None` if the group has no translations.
    translations: Option<DMatrix<f64>>,
    /// The diagonal of a form `F` that the group preserves, `g^T F g = F`, as for so(p,q) and
    /// su(p,q). `None` if there is no such form.
    form: Option<DVector<f64>>,
}

impl MatrixGroup {
    /// The group whose algebra is the span of these square matrices of one size.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Law::Independent`]; [`Law::Closure`] with the
    /// first commutator that leaves the span.
    pub fn new(matrices: &[DMatrix<f64>]) -> Result<Self, Error> {
        Self::with_labels(matrices, (1..=matrices.len()).map(|at| format!("e{at}")))
    }

    /// The group whose algebra is the span of these square matrices of one size, with names for the
    /// basis vectors.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new), and [`Error::Shape`] unless there are as many names as
    /// matrices.
    pub fn with_labels(
        matrices: &[DMatrix<f64>],
        labels: impl IntoIterator<Item: AsRef<str>>,
    ) -> Result<Self, Error> {
        Self::from_basis(&MatrixBasis::from_dmatrices(labels, matrices)?)
    }

    /// The group whose algebra has this basis of matrices. A complex matrix `A + iB` is represented
    /// by `[[A, -B], [B, A]]`.
    ///
    /// # Errors
    /// [`Law::Closure`]; [`Error::Shape`] if there are no matrices.
    pub fn from_basis(basis: &MatrixBasis<f64>) -> Result<Self, Error> {
        let bracket = basis.bracket()?;
        Self::with_bracket(basis, bracket)
    }

    /// The group of a basis of matrices whose bracket has been computed before.
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

    /// The group of inner automorphisms `exp(ad_x)` of an algebra without a centre. Near the
    /// identity, it is isomorphic to any group with this algebra.
    ///
    /// # Errors
    /// [`Law::FaithfulAdjoint`] with a central vector, because `ad` maps this vector to 0.
    pub fn adjoint(algebra: &LieAlgebra<f64>) -> Result<Self, Error> {
        Self::represented(algebra, algebra.dimension(), adjoint_matrices(algebra))
    }

    /// A matrix group with this algebra. If the algebra `g` has no centre, its elements are
    /// `exp(ad_x)` on `g`. Otherwise the algebra acts on the sum of `g` and its derivations `D`,
    /// with `[x, D] = -D x`.
    ///
    /// # Errors
    /// [`Law::FaithfulAdjoint`] with a central vector that every derivation maps to 0;
    /// [`Error::Size`] if the algebra has a centre and the system of equations for its derivations
    /// is too large.
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

    /// The group of a representation by matrices, which have the same bracket as the algebra.
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

    /// Checks necessary conditions for an element whose entries have the relative error
    /// `tolerance`. The element must be invertible, and its determinant must be positive; it must
    /// be 1 if all generators are traceless. `Ad_g` must map the algebra to itself. The algebra
    /// must contain the principal logarithm of `g` or of a power of `g`; in SU(n), it need not
    /// contain the logarithm of `g` itself.
    ///
    /// The test does not detect factors of finite order that normalize the algebra, such as an
    /// element of another component of the pseudo-orthogonal matrices. If the group is not closed,
    /// elements far from 1 may be rejected.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the condition that fails.
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
                    "Ad maps basis vector {vector} to a matrix at the distance {off:e} from the algebra"
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
            Some((1, off)) => {
                refused(format!("its logarithm has the distance {off:e} from the algebra"))
            }
            Some((k, off)) => refused(format!(
                "the logarithm of its power {k} has the distance {off:e} from the algebra"
            )),
            // no power has a logarithm that could be tested, so the element is accepted
            None => Ok(()),
        }
    }

    /// The matrix of a vector, `x^i B_i`.
    pub fn generator(&self, x: &DVector<f64>) -> DMatrix<f64> {
        self.span.combination(x)
    }

    /// The components of the matrix in the algebra that is nearest to `m` in the Frobenius norm.
    pub fn components(&self, m: &DMatrix<f64>) -> DVector<f64> {
        self.span.coordinates(m)
    }

    /// The distance of a matrix from the algebra.
    fn outside(&self, m: &DMatrix<f64>) -> f64 {
        (self.generator(&self.components(m)) - m).norm()
    }

    /// The coordinates of a logarithm. Returns an error if the algebra does not contain the
    /// logarithm.
    fn in_algebra(&self, log: DMatrix<f64>) -> Result<DVector<f64>, Error> {
        let outside = self.outside(&log);
        if outside <= OUTSIDE * (1.0 + log.norm()) {
            return Ok(self.components(&log));
        }
        let reason =
            format!("the principal logarithm has the distance {outside:e} from the algebra");
        Err(Error::Invalid { what: "logarithm", reason })
    }

    /// Computes the logarithm `log(exp(x) exp(y))` of generators that are balanced by `exponents`.
    fn product_in_floats(&self, [x, y]: [DMatrix<f64>; 2], exponents: &[i32]) -> FloatProduct {
        let (terms, log) = if x.norm().max(y.norm()) <= SHORT {
            // computes g h - 1, because the factors are near 1
            let [g, h] = [&x, &y].map(exp_less_identity);
            (x.norm() + y.norm(), near_identity(&(&g + &h + &g * &h)))
        } else {
            let (g, h) = (exp(&x), exp(&y));
            let (back, first) = (exp(&-x), exp(&-y));
            // the norms of the factors bound the rounding error of the inverse, which may be small
            // because of cancellation
            let rounding = f64::EPSILON * first.norm() * back.norm();
            let inverse = (first * back).norm().max(rounding);
            (g.norm() * h.norm() * inverse, logarithm(&(g * h)))
        };
        let size = log.as_ref().map_or(0.0, DMatrix::norm);
        let log = log.map(|log| unbalanced(&log, exponents));
        // the norm of orthogonal factors is sqrt(n), so the limit is proportional to n
        let roundings = ACCURATE * self.size() as f64;
        match log {
            // the logarithm is also checked against the algebra, because near a half turn, rounding
            // errors move the logarithm out of the algebra
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

/// The result of the product `log(exp(x) exp(y))` in floats.
enum FloatProduct {
    /// The logarithm, which is accurate up to a few rounding errors.
    Accurate(DMatrix<f64>),
    /// The logarithm, and an error that is too large, in units of rounding errors.
    Lost { terms: f64, log: Result<DMatrix<f64>, Error> },
}

/// The diagonal of a form `F` with `F B + B^T F = 0` for all matrices `B`, which means
/// `F_i B_ij = -F_j B_ji`. Returns `None` if there is no such form.
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

/// Whether a form is the identity. Orthogonal matrices preserve this form.
fn is_identity(form: &DVector<f64>) -> bool {
    form.iter().all(|value| *value == 1.0)
}

/// The nonzero entries `(row, column, value)` of a matrix.
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

/// The largest dimension of an algebra with a centre for which derivations are computed.
const LARGEST: usize = 24;

/// A basis of the derivations, which satisfy `D [x, y] = [D x, y] + [x, D y]`.
fn derivations(algebra: &LieAlgebra<f64>) -> Result<Vec<DMatrix<f64>>, Error> {
    let n = algebra.dimension();
    if n > LARGEST {
        let what = "dimensions of an algebra with a centre";
        return Err(Error::Size { what, size: n, limit: LARGEST });
    }
    // the unknown D^i_m has the number i n + m; there is one equation for each i and each pair j <
    // k
    let equation = |i: usize, j: usize, k: usize| (i * n + j) * n + k;
    let mut rows = vec![Vec::new(); n * n * n];
    for (at, c) in algebra.structure_constants().components() {
        let [m, j, k] = [at[0], at[1], at[2]];
        for i in 0..n {
            // this component occurs in three terms of the equations: D^i_m c^m_jk, c^m_ik D^i_j and
            // c^m_ji D^i_k; each push uses the index letters of this component
            rows[equation(i, j, k)].push((i * n + m, *c));
            rows[equation(m, i, k)].push((j * n + i, -c));
            rows[equation(m, j, i)].push((k * n + i, -c));
        }
    }
    let solutions = Matrix::from_rows(n * n, rows)?.nullspace()?;
    let matrix = |row: usize| DMatrix::from_fn(n, n, |i, m| solutions.get(row, i * n + m));
    Ok((0..solutions.rows()).map(matrix).collect())
}

/// Not every call checks sizes: vectors and matrices of a wrong size panic or yield a wrong result.
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

    /// Returns `F^-1 g^T F` if the group preserves a diagonal form `F`, because this product only
    /// has the rounding error of `g`. For orthogonal matrices, the general inverse is used: it is
    /// as accurate, and it remains an inverse if rounding errors move `g` off the group. Returns
    /// NaN for a singular matrix, which is not an element.
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

    /// The principal logarithm of the matrix, if the algebra contains it. Other logarithms, for
    /// example of a rotation by `pi`, are not computed. If the logarithm is ill-conditioned, the
    /// method returns the logarithm of the nearest element of the group.
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

    /// Returns `g x g^-1`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.components(&(g * self.generator(x) * self.inverse(g)))
    }

    /// Computes the operator without the inverse of `exp(x)`, which is inaccurate if entries are
    /// large.
    fn adjoint_exp(&self, x: &Self::Vector) -> DMatrix<f64> {
        let mut ad = DMatrix::zeros(self.dimension(), self.dimension());
        let structure = self.bracket.structure_constants();
        structure.components().for_each(|(at, c)| ad[(at[0], at[2])] += c * x[at[1]]);
        exp(&ad)
    }

    /// Uses double-double arithmetic if the product is ill-conditioned, because the logarithm may
    /// multiply rounding errors by `|g h| |(g h)^-1|`. Returns an error if the result is still
    /// inaccurate, because the rounding error of an entry of `g h` is relative to `|g| |h|`.
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
                // computes g h - 1, which is accurate if g and h are near 1
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

    /// The algebra with the names of the basis. Structure constants that vanish are exactly zero.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        LieAlgebra::try_from(self.bracket.clone())
    }
}

impl TranslationSplit for MatrixGroup {
    /// The component of a vector in the kernel of the Killing form. Returns `None` unless the
    /// kernel is abelian and has a complementary subalgebra.
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        self.translations.as_ref().map(|projection| projection * x)
    }

    fn has_translations(&self) -> bool {
        self.translations.is_some()
    }

    /// Returns true for groups of orthogonal matrices.
    fn has_bounded_adjoint(&self) -> bool {
        self.form.as_ref().is_some_and(is_identity)
    }
}

/// The embedding coordinates are the entries of the matrix, column by column. Points near the group
/// are not projected back.
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

/// The written form is the matrix.
impl MatrixNotation for MatrixGroup {
    /// Checks the matrix by the necessary conditions of
    /// [`expect_element`](MatrixGroup::expect_element).
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            self.expect_element(m, TOLERANCE)?;
            Ok(m.clone())
        })
    }

    /// Whether the generator `B` is a rotation, which means `B^3 = -w^2 B` with `w > 0`.
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
