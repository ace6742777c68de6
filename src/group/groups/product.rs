//! Direct products of two groups.

use crate::group::TranslationSplit;
use crate::group::matrices::expect_shape;
use crate::group::{Block, Coordinates, Embedded, Generator, LieGroup, MatrixNotation, Partial};
use crate::{Error, LieAlgebra};
use nalgebra::{DMatrix, DVector};

/// The direct product of two groups. Elements are pairs. Vectors are the components in the first
/// group, followed by the components in the second group.
///
/// ```
/// use affinor::group::{LieGroup, Product, So3, Translations};
/// use nalgebra::{Const, dvector};
/// // a body whose position and attitude do not mix, other than in SE(3)
/// let bodies = Product(Translations(Const::<3>), So3);
/// let (position, attitude) = bodies.exp(&dvector![1.0, 2.0, 3.0, 0.0, 0.0, 0.5]);
/// assert_eq!(position.z, 3.0);
/// assert!((attitude.angle() - 0.5).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Product<G, H>(
    /// The first group.
    pub G,
    /// The second group.
    pub H,
);

impl<G: LieGroup, H: LieGroup> Product<G, H> {
    /// Splits a vector into its two parts.
    ///
    /// # Panics
    /// If the vector is shorter than the dimension of the first group.
    pub fn split(&self, x: &DVector<f64>) -> (G::Vector, H::Vector) {
        let (first, second) = x.as_slice().split_at(self.0.dimension());
        (G::Vector::from_components(first), H::Vector::from_components(second))
    }

    /// Joins two parts to one vector.
    pub fn join(&self, first: &G::Vector, second: &H::Vector) -> DVector<f64> {
        let parts = [first.components(), second.components()];
        DVector::from_vec(parts.concat())
    }

    /// Joins two parts to one vector. A missing part is replaced by zeros. Returns `None` if both
    /// parts are missing.
    fn join_parts(
        &self,
        first: Option<G::Vector>,
        second: Option<H::Vector>,
    ) -> Option<DVector<f64>> {
        if first.is_none() && second.is_none() {
            return None;
        }
        let first = first.unwrap_or_else(|| G::Vector::zeros(self.0.dimension()));
        let second = second.unwrap_or_else(|| H::Vector::zeros(self.1.dimension()));
        Some(self.join(&first, &second))
    }

    /// Applies a map to each part of a vector.
    fn map(
        &self,
        v: &DVector<f64>,
        first: impl FnOnce(&G::Vector) -> G::Vector,
        second: impl FnOnce(&H::Vector) -> H::Vector,
    ) -> DVector<f64> {
        let (v, w) = self.split(v);
        self.join(&first(&v), &second(&w))
    }
}

/// Not every call checks sizes: a vector of a wrong size panics or yields a wrong result.
impl<G: LieGroup, H: LieGroup> LieGroup for Product<G, H> {
    type Element = (G::Element, H::Element);
    type Vector = DVector<f64>;

    fn dimension(&self) -> usize {
        self.0.dimension() + self.1.dimension()
    }

    fn identity(&self) -> Self::Element {
        (self.0.identity(), self.1.identity())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        (self.0.compose(&g.0, &h.0), self.1.compose(&g.1, &h.1))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        (self.0.inverse(&g.0), self.1.inverse(&g.1))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (x, y) = self.split(x);
        (self.0.exp(&x), self.1.exp(&y))
    }

    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(self.join(&self.0.log(&g.0)?, &self.1.log(&g.1)?))
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.map(x, |x| self.0.adjoint(&g.0, x), |x| self.1.adjoint(&g.1, x))
    }

    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        self.map(h, |h| self.0.coadjoint(&g.0, h), |h| self.1.coadjoint(&g.1, h))
    }

    fn project(&self, g: Self::Element) -> Self::Element {
        (self.0.project(g.0), self.1.project(g.1))
    }

    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        let (x, y) = self.split(x);
        self.map(h, |h| self.0.coadjoint_exp(&x, h), |h| self.1.coadjoint_exp(&y, h))
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let (x, x_second) = self.split(x);
        self.map(y, |y| self.0.bracket(&x, y), |y| self.1.bracket(&x_second, y))
    }

    /// The block-diagonal matrix of the two factors.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        block_diagonal([self.0.matrix(&g.0), self.1.matrix(&g.1)])
    }

    /// The block-diagonal matrix of the two factors.
    fn adjoint_exp(&self, x: &Self::Vector) -> DMatrix<f64> {
        let (x, y) = self.split(x);
        block_diagonal([self.0.adjoint_exp(&x), self.1.adjoint_exp(&y)])
    }

    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        let ((x, x_second), (y, y_second)) = (self.split(x), self.split(y));
        let first = self.0.log_product(&x, &y)?;
        Ok(self.join(&first, &self.1.log_product(&x_second, &y_second)?))
    }

    /// The direct sum of the algebras.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        self.0.algebra()?.direct_sum(&self.1.algebra()?)
    }

    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        let (x, x_second) = self.split(x);
        self.map(v, |v| self.0.tangent_left(&x, v), |v| self.1.tangent_left(&x_second, v))
    }

    /// Returns an error if the operator of either factor is singular.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        let ((x, x_second), (v, v_second)) = (self.split(x), self.split(v));
        let first = self.0.tangent_left_inverse(&x, &v)?;
        Ok(self.join(&first, &self.1.tangent_left_inverse(&x_second, &v_second)?))
    }
}

impl<G: TranslationSplit, H: TranslationSplit> TranslationSplit for Product<G, H> {
    fn translational_part(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let (x, y) = self.split(x);
        self.join_parts(self.0.translational_part(&x), self.1.translational_part(&y))
    }

    fn has_translations(&self) -> bool {
        self.0.has_translations() || self.1.has_translations()
    }

    fn translational_momentum(&self, h: &DVector<f64>) -> Option<DVector<f64>> {
        let (h, k) = self.split(h);
        self.join_parts(self.0.translational_momentum(&h), self.1.translational_momentum(&k))
    }

    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        (self.0.linear_part(&g.0), self.1.linear_part(&g.1))
    }

    fn coadjoint_inverse(&self, k: &Self::Element, h: &Self::Vector) -> Self::Vector {
        self.map(h, |h| self.0.coadjoint_inverse(&k.0, h), |h| self.1.coadjoint_inverse(&k.1, h))
    }

    fn relative_linear_part(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        (self.0.relative_linear_part(&g.0, &h.0), self.1.relative_linear_part(&g.1, &h.1))
    }

    fn has_bounded_adjoint(&self) -> bool {
        self.0.has_bounded_adjoint() && self.1.has_bounded_adjoint()
    }
}

fn block_diagonal(blocks: [DMatrix<f64>; 2]) -> DMatrix<f64> {
    let first = blocks[0].nrows();
    let size = first + blocks[1].nrows();
    let mut matrix = DMatrix::zeros(size, size);
    for (block, at) in blocks.iter().zip([0, first]) {
        matrix.view_mut((at, at), block.shape()).copy_from(block);
    }
    matrix
}

/// The embedding coordinates are the coordinates of the first element, followed by the coordinates
/// of the second element.
impl<G: Embedded, H: Embedded> Embedded for Product<G, H> {
    type Ambient = DVector<f64>;

    fn coordinates(&self, g: &Self::Element) -> DVector<f64> {
        let (first, second) = (self.0.coordinates(&g.0), self.1.coordinates(&g.1));
        DVector::from_vec([first.components(), second.components()].concat())
    }

    fn from_coordinates(&self, y: &DVector<f64>) -> Self::Element {
        let (first, second) = y.as_slice().split_at(self.0.embedding_dimension());
        let first = self.0.from_coordinates(&G::Ambient::from_components(first));
        (first, self.1.from_coordinates(&H::Ambient::from_components(second)))
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> DVector<f64> {
        let (v, w) = self.split(v);
        let (first, second) = (self.0.rate(&g.0, &v), self.1.rate(&g.1, &w));
        DVector::from_vec([first.components(), second.components()].concat())
    }

    fn rate_at_projected(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> DVector<f64> {
        let (v, w) = self.split(v);
        let first = self.0.rate_at_projected(&point.0, &projected.0, &v);
        let second = self.1.rate_at_projected(&point.1, &projected.1, &w);
        DVector::from_vec([first.components(), second.components()].concat())
    }

    fn embedding_dimension(&self) -> usize {
        self.0.embedding_dimension() + self.1.embedding_dimension()
    }

    fn is_translation_coordinate(&self, at: usize) -> bool {
        let first = self.0.embedding_dimension();
        if at < first {
            self.0.is_translation_coordinate(at)
        } else {
            self.1.is_translation_coordinate(at - first)
        }
    }

    fn has_projection(&self) -> bool {
        self.0.has_projection() && self.1.has_projection()
    }
}

/// The written form is one column: the entries of the first written element, row by row, followed
/// by the entries of the second.
impl<G: MatrixNotation, H: MatrixNotation> MatrixNotation for Product<G, H> {
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        stacked(&self.0.write(&g.0), &self.1.write(&g.1))
    }

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        let shapes =
            [self.0.write(&self.0.identity()).shape(), self.1.write(&self.1.identity()).shape()];
        let [first, second] = shapes.map(|(rows, columns)| rows * columns);
        expect_shape(matrix, (first + second, 1))?;
        let (first, second) = matrix.as_slice().split_at(first);
        let part = |(rows, columns), entries| DMatrix::from_row_slice(rows, columns, entries);
        let first = self.0.read(&part(shapes[0], first))?;
        Ok((first, self.1.read(&part(shapes[1], second))?))
    }

    fn is_angle(&self, at: usize) -> bool {
        let first = self.0.dimension();
        if at < first { self.0.is_angle(at) } else { self.1.is_angle(at - first) }
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        let first: usize = self.0.blocks().iter().map(|block| block.names.len()).sum();
        if k < first { self.0.named(&g.0, k) } else { self.1.named(&g.1, k - first) }
    }

    fn blocks(&self) -> Vec<Block> {
        [self.0.blocks(), self.1.blocks()].concat()
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        [self.0.generators(), self.1.generators()].concat()
    }

    fn derivatives(
        &self,
        g: &Self::Element,
        _: &[f64],
        generators: &[Generator],
        partial: &[Partial],
    ) -> DVector<f64> {
        let (first, second) = generators.split_at(self.0.dimension());
        let (matrix, other) = (self.0.write(&g.0), self.1.write(&g.1));
        let [upper, lower] = split(partial, &matrix, &other);
        // a function of one factor has no derivatives in the other
        let upper =
            (!upper.is_empty()).then(|| self.0.derivatives(&g.0, matrix.as_slice(), first, &upper));
        let lower =
            (!lower.is_empty()).then(|| self.1.derivatives(&g.1, other.as_slice(), second, &lower));
        self.join_parts(upper, lower).unwrap_or_else(|| DVector::zeros(generators.len()))
    }

    fn second_derivative(
        &self,
        g: &Self::Element,
        _: &[f64],
        generators: &[Generator],
        partial: &[Partial],
        v: &Self::Vector,
    ) -> f64 {
        let (first, second) = generators.split_at(self.0.dimension());
        let (matrix, other) = (self.0.write(&g.0), self.1.write(&g.1));
        let [upper, lower] = split(partial, &matrix, &other);
        let (v, w) = self.split(v);
        self.0.second_derivative(&g.0, matrix.as_slice(), first, &upper, &v)
            + self.1.second_derivative(&g.1, other.as_slice(), second, &lower, &w)
    }

    /// The larger of the bounds of the two factors. A factor without a bound is ignored.
    fn log_rounding(&self, g: &Self::Element, x: &Self::Vector) -> Option<f64> {
        let (x, y) = self.split(x);
        let bounds = [self.0.log_rounding(&g.0, &x), self.1.log_rounding(&g.1, &y)];
        bounds.into_iter().flatten().reduce(f64::max)
    }
}

/// The entries of two matrices in one column; each matrix is listed row by row.
fn stacked(first: &DMatrix<f64>, second: &DMatrix<f64>) -> DMatrix<f64> {
    let parts = [first.transpose(), second.transpose()];
    DMatrix::from_vec(first.len() + second.len(), 1, parts.map(|m| m.as_slice().to_vec()).concat())
}

/// Splits derivatives with respect to the entries of a product into those of its two factors, which
/// have these written forms.
fn split(partial: &[Partial], first: &DMatrix<f64>, second: &DMatrix<f64>) -> [Vec<Partial>; 2] {
    let (mut upper, mut lower) = (vec![], vec![]);
    for &(row, _, share) in partial {
        match row.checked_sub(first.len()) {
            None => upper.push((row / first.ncols(), row % first.ncols(), share)),
            Some(row) => lower.push((row / second.ncols(), row % second.ncols(), share)),
        }
    }
    [upper, lower]
}
