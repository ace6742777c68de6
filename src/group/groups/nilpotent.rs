//! The simply connected group of a nilpotent algebra.

use crate::group::TranslationSplit;
use crate::group::matrices::{Generator, MatrixNotation, Partial, checked, column, replace};
use crate::group::{Embedded, LieGroup};
use crate::numerics::exponential::exp;
use crate::{Error, Law, LieAlgebra};
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::{Field, Scalar};
use nalgebra::{DMatrix, DVector};

/// The simply connected group of a nilpotent algebra, in canonical coordinates of the first kind.
/// In these coordinates, `exp` and `log` are the identity map, and the product is the
/// Baker-Campbell-Hausdorff series, which is finite.
///
/// The [`product`](Self::product) is exact over any field. Over floats, the group is a
/// [`LieGroup`].
///
/// ```
/// use affinor::group::Nilpotent;
/// use affinor::{Bracket, LieAlgebra};
/// use affinor::tensors::Rational;
/// let whole = |n: &[i64]| n.iter().map(|n| Rational::from(*n)).collect::<Vec<_>>();
/// // [e1, e2] = e3, [e1, e3] = e4
/// let bracket = Bracket::from_fn(&["e1", "e2", "e3", "e4"], |j, k| match (j, k) {
///     (0, 1 | 2) => vec![(k + 1, Rational::from(1))],
///     _ => vec![],
/// })?;
/// let group = Nilpotent::new(LieAlgebra::try_from(bracket)?)?;
/// assert_eq!(group.class(), 3);
/// let product = group.product(&whole(&[1, 0, 0, 0]), &whole(&[0, 1, 0, 0]))?;
/// let product: Vec<String> = product.iter().map(Rational::to_string).collect();
/// assert_eq!(product, ["1", "1", "1/2", "1/12"]);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Nilpotent<S> {
    algebra: LieAlgebra<S>,
    class: usize,
}

impl<S: Field + Scalar> Nilpotent<S> {
    /// The simply connected group of a nilpotent algebra.
    ///
    /// # Errors
    /// [`Law::Nilpotent`] with a vector that is in every term of the lower central series.
    pub fn new(algebra: LieAlgebra<S>) -> Result<Self, Error> {
        let class = class(&algebra)?;
        Ok(Nilpotent { algebra, class })
    }

    /// The algebra.
    pub fn algebra(&self) -> &LieAlgebra<S> {
        &self.algebra
    }

    /// The nilpotency class: all brackets with more factors than the class vanish.
    pub fn class(&self) -> usize {
        self.class
    }

    /// The product in canonical coordinates, `log(exp(x) exp(y))`.
    ///
    /// # Errors
    /// The errors of [`LieAlgebra::bch`].
    pub fn product(&self, x: &[S], y: &[S]) -> Result<Vec<S>, Error> {
        let parts = self.algebra.bch(x, y, self.class)?;
        let zero = vec![S::zero(); self.algebra.dimension()];
        let sum = |sum: Vec<S>, part: Vec<S>| sum.into_iter().zip(part).map(|(a, b)| a + &b);
        Ok(parts.into_iter().fold(zero, |total, part| sum(total, part).collect()))
    }
}

/// The nilpotency class: the index of the first zero term of the lower central series.
fn class<S: Field + Scalar>(algebra: &LieAlgebra<S>) -> Result<usize, Error> {
    let mut term: Vec<_> = algebra.basis().collect();
    let mut class = 0;
    while !term.is_empty() {
        let mut next = Echelon::new().with_tolerance(algebra.structure_constants().tolerance());
        for vector in &term {
            // equal ranks mean equal terms, because each term of the series contains the next term
            if next.rank() == term.len() {
                break;
            }
            let mut brackets = vec![vec![]; algebra.dimension()];
            for (at, value) in algebra.ad(vector)?.components() {
                brackets[at[1]].push((at[0], value.clone()));
            }
            for bracket in brackets {
                next.insert(bracket)?;
            }
        }
        if next.rank() == term.len() {
            let vector = affinor_tensors::text::combination(
                next.rows()[0].iter().map(|(i, v)| (v, algebra.labels()[*i].clone())),
            );
            let component =
                format!("the vector {vector} in every term of the lower central series");
            return Err(Law::Nilpotent.broken([], component));
        }
        term = Matrix::from_rows(algebra.dimension(), next.rows().to_vec())?.to_dense();
        class += 1;
    }
    Ok(class)
}

impl Nilpotent<f64> {
    fn ad(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let ad = self.algebra.ad(x.as_slice()).and_then(|ad| Ok(ad.to_dmatrix()?));
        ad.expect("as many components as the algebra")
    }
}

/// Not every call checks sizes: a vector of a wrong size panics or yields a wrong result.
impl LieGroup for Nilpotent<f64> {
    type Element = DVector<f64>;
    type Vector = DVector<f64>;

    fn dimension(&self) -> usize {
        self.algebra.dimension()
    }

    fn identity(&self) -> Self::Element {
        DVector::zeros(self.dimension())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let product = self.product(g.as_slice(), h.as_slice());
        DVector::from_vec(product.expect("as many components as the algebra"))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        -g
    }

    /// The identity map.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        x.clone()
    }

    /// The identity map.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(g.clone())
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        exp(&self.ad(g)) * x
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        self.ad(x) * y
    }

    /// The matrix of `Ad_g`. The representation is not faithful, because central elements act as 1;
    /// [`Heisenberg`](super::Heisenberg) has a faithful matrix.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        exp(&self.ad(g))
    }

    /// The algebra from which the group was made, with its labels.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        Ok(self.algebra.clone())
    }

    /// Computes the operator by its series, which is finite.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        let order = self.class.saturating_sub(1);
        let image = self.algebra.tangent_left_inverse(x.as_slice(), v.as_slice(), order)?;
        Ok(DVector::from_vec(image))
    }
}

impl TranslationSplit for Nilpotent<f64> {}

/// The embedding coordinates are the canonical coordinates `x`. Their time derivative is
/// `T_left(x)^-1 v`.
impl Embedded for Nilpotent<f64> {
    type Ambient = DVector<f64>;

    fn coordinates(&self, g: &Self::Element) -> DVector<f64> {
        g.clone()
    }

    fn from_coordinates(&self, y: &DVector<f64>) -> Self::Element {
        y.clone()
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> DVector<f64> {
        // no error can occur, because the series is finite
        self.tangent_left_inverse(g, v).unwrap_or_else(|_| v * f64::NAN)
    }
}

/// The written form is a column of canonical coordinates.
impl MatrixNotation for Nilpotent<f64> {
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        column(g)
    }

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| Ok(DVector::from_column_slice(m.as_slice())))
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, g.as_slice());
    }

    /// Returns an empty list, because the derivatives of the written form depend on the element.
    fn generators(&self) -> Vec<DMatrix<f64>> {
        vec![DMatrix::zeros(0, 0); self.dimension()]
    }

    fn derivatives(
        &self,
        g: &Self::Element,
        _: &[f64],
        _: &[Generator],
        partial: &[Partial],
    ) -> Self::Vector {
        DVector::from_fn(self.dimension(), |i, _| {
            let rate = self.rate(g, &self.basis_vector(i));
            partial.iter().map(|(row, _, share)| share * rate[*row]).sum()
        })
    }

    /// Computed by a difference quotient of order 4, because the coordinates of `g exp(s v)` are
    /// polynomials in `s`.
    fn second_derivative(
        &self,
        g: &Self::Element,
        _: &[f64],
        _: &[Generator],
        partial: &[Partial],
        v: &Self::Vector,
    ) -> f64 {
        let size = v.amax();
        if size == 0.0 {
            return 0.0;
        }
        let step = 1e-3 / size;
        let rate = |s: f64| -> f64 {
            let rate = self.rate(&self.compose(g, &self.exp(&(v * s))), v);
            partial.iter().map(|(row, _, share)| share * rate[*row]).sum()
        };
        let [near, far] = [step, 2.0 * step].map(|s| rate(s) - rate(-s));
        (8.0 * near - far) / (12.0 * step)
    }
}
