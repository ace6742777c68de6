//! Groups that are chosen while the program runs: vectors as lists, elements as matrices.

use crate::group::{
    Coordinates, LieGroup, MatrixGroup, Nilpotent, Opposite, Se2, Se3, Sl2, So2, So3, rotation,
};
use crate::transport::ParallelTranslation;
use crate::{Connection, Error};
use nalgebra::{
    DMatrix, DVector, Isometry2, Isometry3, Matrix2, Translation2, UnitComplex, Vector2,
};

/// How far the entries of an element may be from what its group asks for.
const TOLERANCE: f64 = 1e-6;

/// A group whose elements are written as matrices and read back.
pub trait Written: LieGroup {
    /// How many components of a vector, the first, are angles in radians.
    const ANGLES: usize = 0;

    /// The element as written.
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        self.matrix(g)
    }

    /// The element that a matrix is.
    ///
    /// # Errors
    /// [`Error::Shape`], and [`Error::NotInGroup`] with the defect.
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error>;
}

/// A [`LieGroup`] behind lists of numbers.
///
/// Lists of another length than the dimension panic, as vectors of nalgebra do.
pub trait AnyGroup {
    /// The dimension.
    fn dimension(&self) -> usize;
    /// How many components of a vector, the first, are angles in radians.
    fn angles(&self) -> usize;
    /// Rows and columns of an element as written.
    fn shape(&self) -> (usize, usize);
    /// The element `exp(x)`.
    fn exp(&self, x: &[f64]) -> DMatrix<f64>;
    /// The coordinates of an element.
    ///
    /// # Errors
    /// As [`Written::read`] and [`LieGroup::log`].
    fn log(&self, element: &DMatrix<f64>) -> Result<Vec<f64>, Error>;
    /// The coordinates of `exp(x_1) exp(x_2) ..`, the product (73) in canonical coordinates.
    ///
    /// # Errors
    /// As [`LieGroup::log`].
    fn compose(&self, factors: &[Vec<f64>]) -> Result<Vec<f64>, Error>;
    /// The matrix of `Ad_exp(x)`.
    fn adjoint(&self, x: &[f64]) -> DMatrix<f64>;
    /// Parallel translation along the arcs `exp(s x_1)`, then `exp(x_1) exp(s x_2)`, and so on: the
    /// matrix `B` in left components (49).
    ///
    /// # Errors
    /// As [`ParallelTranslation::new`].
    fn transport(
        &self,
        connection: &Connection<f64>,
        arcs: &[Vec<f64>],
    ) -> Result<DMatrix<f64>, Error>;
}

impl<G: Written + Clone> AnyGroup for G {
    fn dimension(&self) -> usize {
        LieGroup::dimension(self)
    }

    fn angles(&self) -> usize {
        G::ANGLES
    }

    fn shape(&self) -> (usize, usize) {
        self.write(&self.identity()).shape()
    }

    fn exp(&self, x: &[f64]) -> DMatrix<f64> {
        self.write(&LieGroup::exp(self, &G::Vector::from_components(x)))
    }

    fn log(&self, element: &DMatrix<f64>) -> Result<Vec<f64>, Error> {
        Ok(LieGroup::log(self, &self.read(element)?)?.components().to_vec())
    }

    fn compose(&self, factors: &[Vec<f64>]) -> Result<Vec<f64>, Error> {
        let factors = factors.iter().map(|x| LieGroup::exp(self, &G::Vector::from_components(x)));
        let product = factors.reduce(|g, h| LieGroup::compose(self, &g, &h));
        let product = product.unwrap_or_else(|| self.identity());
        Ok(LieGroup::log(self, &product)?.components().to_vec())
    }

    fn adjoint(&self, x: &[f64]) -> DMatrix<f64> {
        let g = LieGroup::exp(self, &G::Vector::from_components(x));
        self.operator(|v| LieGroup::adjoint(self, &g, v))
    }

    fn transport(
        &self,
        connection: &Connection<f64>,
        arcs: &[Vec<f64>],
    ) -> Result<DMatrix<f64>, Error> {
        let n = LieGroup::dimension(self);
        let on_group = ParallelTranslation::new(self.clone(), connection.clone())?;
        arcs.iter().try_fold(DMatrix::identity(n, n), |carried, x| {
            Ok(on_group.along_subgroup(&G::Vector::from_components(x))? * carried)
        })
    }
}

/// The largest entry by which a matrix differs from another, or infinity for NaN.
fn defect(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    let differences = found.iter().zip(expected.iter()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |largest, d| if d <= largest { largest } else { d })
}

/// The element `of` a matrix, if it is written as that matrix.
fn checked<G: Written>(
    group: &G,
    matrix: &DMatrix<f64>,
    of: impl FnOnce(&DMatrix<f64>) -> Result<G::Element, Error>,
) -> Result<G::Element, Error> {
    let shape = group.write(&group.identity()).shape();
    if matrix.shape() != shape {
        let write = |(rows, columns): (usize, usize)| format!("{rows} rows and {columns} columns");
        let (expected, found) = (write(shape), write(matrix.shape()));
        return Err(Error::Shape { what: "an element", expected, found });
    }
    if let Some(value) = matrix.iter().find(|value| !value.is_finite()) {
        return Err(Error::NotInGroup { reason: format!("it has the entry {value}") });
    }
    let element = of(matrix)?;
    let defect = defect(matrix, &group.write(&element));
    if defect <= TOLERANCE * (1.0 + matrix.amax()) {
        return Ok(element);
    }
    let reason = format!("the nearest element found differs by {defect:e} in an entry");
    Err(Error::NotInGroup { reason })
}

/// The rotation of a plane nearest to the upper left block.
fn turn(m: &DMatrix<f64>) -> UnitComplex<f64> {
    UnitComplex::new((m[(1, 0)] - m[(0, 1)]).atan2(m[(0, 0)] + m[(1, 1)]))
}

impl Written for So2 {
    const ANGLES: usize = 1;

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| Ok(turn(m)))
    }
}

impl Written for So3 {
    const ANGLES: usize = 3;

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            rotation::from_matrix(&m.fixed_view::<3, 3>(0, 0).into_owned(), TOLERANCE)
        })
    }
}

impl Written for Se2 {
    const ANGLES: usize = 1;

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let translation = Translation2::from(Vector2::new(m[(0, 2)], m[(1, 2)]));
            Ok(Isometry2::from_parts(translation, turn(m)))
        })
    }
}

impl Written for Se3 {
    const ANGLES: usize = 3;

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let turn = m.fixed_view::<3, 3>(0, 0).into_owned();
            let translation = m.fixed_view::<3, 1>(0, 3).into_owned();
            Ok(Isometry3::from_parts(translation.into(), rotation::from_matrix(&turn, TOLERANCE)?))
        })
    }
}

impl Written for Sl2 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let m: Matrix2<f64> = m.fixed_view::<2, 2>(0, 0).into_owned();
            let determinant = m.determinant();
            if (determinant - 1.0).abs() <= TOLERANCE * (1.0 + m.norm_squared()) {
                return Ok(m);
            }
            Err(Error::NotInGroup { reason: format!("its determinant is {determinant}") })
        })
    }
}

impl Written for MatrixGroup {
    /// As far as [`expect_element`](MatrixGroup::expect_element) sees.
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            self.expect_element(m, TOLERANCE)?;
            Ok(m.clone())
        })
    }
}

/// Elements are columns of canonical coordinates of the first kind.
impl Written for Nilpotent<f64> {
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        DMatrix::from_column_slice(g.len(), 1, g.as_slice())
    }

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| Ok(DVector::from_column_slice(m.as_slice())))
    }
}

/// As elements of the group are.
impl<G: Written> Written for Opposite<G> {
    const ANGLES: usize = G::ANGLES;

    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        self.0.write(g)
    }

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        self.0.read(matrix)
    }
}
