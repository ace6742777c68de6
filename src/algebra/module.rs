//! Modules of Lie algebras: representations by exact matrices, and constructions of others.
//!
//! A [`Module`] is checked once: its matrices satisfy `D_[x,y] = D_x D_y - D_y D_x`. `powers`:
//! tensor, symmetric and exterior products. The cohomology with coefficients in a module is
//! [`StructureTheory::cohomology`](super::structure::StructureTheory::cohomology).

mod powers;

use super::LieAlgebra;
use super::invariants::common_kernel;
use super::structure::{Subspace, collected, combination};
use crate::{Error, Law};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar};

/// A finite-dimensional module of a Lie algebra, by the matrices of the basis vectors.
///
/// ```
/// use affinor::Rational;
/// use affinor::algebra::{Module, catalogue};
/// let algebra = catalogue::algebra::<Rational>("so(3)")?;
/// // the vectors, their symmetric square, and the invariant quadratic form
/// let vectors = Module::adjoint(&algebra);
/// let square = vectors.symmetric_power(2)?;
/// assert_eq!((square.dimension(), square.invariants()?.dimension()), (6, 1));
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("representation", "action"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Module<S> {
    algebra: LieAlgebra<S>,
    labels: Vec<String>,
    /// The images `x_j v_a` at `[j][a]`.
    images: Vec<Vec<Row<S>>>,
}

/// The largest dimension of a module that a construction returns.
pub const MAX_DIMENSION: usize = 4096;

impl<S: Field + Scalar> Module<S> {
    /// The module on the vectors `labels` in which the basis vector `e_j` of the algebra acts by the
    /// matrix `D_j`: `e_j v_a = (D_j)_ba v_b`.
    ///
    /// # Errors
    /// [`Error::Shape`] for a wrong number or size of matrices; [`Law::Action`] with two basis vectors
    /// and a vector of the module at which `D_[x,y]` differs from `[D_x, D_y]`.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::algebra::{Module, catalogue};
    /// use affinor_tensors::linear::Matrix;
    /// let heisenberg = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let unit = |i, j| Matrix::from_rows(3, (0..3).map(|row| {
    ///     (row == i).then(|| (j, Rational::from(1)))
    /// })).expect("three columns");
    /// let labels = ["u", "v", "w"].map(String::from);
    /// // [e1, e2] = e3
    /// let maps = vec![unit(0, 1), unit(1, 2), unit(0, 2)];
    /// let module = Module::new(&heisenberg, labels.clone(), maps)?;
    /// assert_eq!(module.invariants()?.dimension(), 1);
    /// let maps = vec![unit(0, 1), unit(1, 2), unit(0, 1)];
    /// assert!(Module::new(&heisenberg, labels, maps).is_err());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn new(
        algebra: &LieAlgebra<S>,
        labels: impl Into<Vec<String>>,
        matrices: Vec<Matrix<S>>,
    ) -> Result<Self, Error> {
        let module = Self::unchecked(algebra, labels, matrices)?;
        module.expect_action()?;
        Ok(module)
    }

    /// Matrices of the right number and size, which need not be an action.
    pub(crate) fn unchecked(
        algebra: &LieAlgebra<S>,
        labels: impl Into<Vec<String>>,
        matrices: Vec<Matrix<S>>,
    ) -> Result<Self, Error> {
        let labels = labels.into();
        let (n, m) = (algebra.dimension(), labels.len());
        if matrices.len() != n || matrices.iter().any(|d| d.rows() != m || d.columns() != m) {
            let sizes: Vec<_> =
                matrices.iter().map(|d| format!("{} x {}", d.rows(), d.columns())).collect();
            let found = format!("{} of {}", matrices.len(), sizes.first().map_or("none", |s| s));
            let expected = format!("{n} matrices of size {m} x {m}");
            return Err(Error::Shape { what: "the action", expected, found });
        }
        let columns = |d: &Matrix<S>| -> Vec<Row<S>> {
            let transposed = d.transpose();
            (0..m).map(|k| transposed.row(k).to_vec()).collect()
        };
        let images = matrices.iter().map(columns).collect();
        Ok(Module { algebra: algebra.clone(), labels, images })
    }

    /// Checks `D_[x,y] = D_x D_y - D_y D_x`.
    pub(crate) fn expect_action(&self) -> Result<(), Error> {
        let n = self.algebra.dimension();
        let mut brackets: Vec<Row<S>> = vec![vec![]; n * n];
        for (at, value) in self.algebra.structure_constants().components() {
            brackets[at[1] * n + at[2]].push((at[0], value.clone()));
        }
        for (j, k) in (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k))) {
            checkpoint();
            for v in 0..self.dimension() {
                let first = self.act(j, &self.images[k][v]);
                let second = negative(self.act(k, &self.images[j][v]));
                let whole = brackets[j * n + k].iter().flat_map(|(i, factor)| {
                    let image = self.images[*i][v].iter();
                    image.map(move |(at, value)| (*at, -(value.clone() * factor)))
                });
                let residual = collected([first, second, whole.collect()].concat());
                if !residual.is_empty() {
                    let [x, y] = [j, k].map(|at| self.algebra.labels()[at].clone());
                    return Err(
                        Law::Action.broken([x, y, self.labels[v].clone()], self.write(&residual))
                    );
                }
            }
        }
        Ok(())
    }

    /// The module of this dimension on which the algebra acts by zero.
    pub fn trivial(algebra: &LieAlgebra<S>, dimension: usize) -> Self {
        let labels = (1..=dimension).map(|a| format!("v{a}")).collect();
        let images = vec![vec![vec![]; dimension]; algebra.dimension()];
        Module { algebra: algebra.clone(), labels, images }
    }

    /// The adjoint module: the algebra itself, with `x y = [x, y]`.
    pub fn adjoint(algebra: &LieAlgebra<S>) -> Self {
        let n = algebra.dimension();
        let mut images = vec![vec![vec![]; n]; n];
        for (at, value) in algebra.structure_constants().components() {
            images[at[1]][at[2]].push((at[0], value.clone()));
        }
        Module { algebra: algebra.clone(), labels: algebra.labels().to_vec(), images }
    }

    /// The coadjoint module, the dual of the adjoint module: `(x f)(y) = -f([x, y])`.
    pub fn coadjoint(algebra: &LieAlgebra<S>) -> Self {
        Self::adjoint(algebra).dual()
    }

    /// The algebra.
    pub fn algebra(&self) -> &LieAlgebra<S> {
        &self.algebra
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.labels.len()
    }

    /// The names of the basis vectors.
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// The image of the basis vector `v_a` under the basis vector `e_j` of the algebra.
    pub fn image(&self, j: usize, a: usize) -> &[(usize, S)] {
        &self.images[j][a]
    }

    /// The matrix `D_j` of a basis vector of the algebra: the column `a` is `e_j v_a`.
    pub fn matrix(&self, j: usize) -> Matrix<S> {
        let rows = self.images[j].iter().cloned();
        Matrix::from_rows(self.dimension(), rows).expect("indices of the module").transpose()
    }

    /// Whether the algebra acts by zero.
    pub fn is_trivial(&self) -> bool {
        self.images.iter().flatten().all(Vec::is_empty)
    }

    /// The image of a vector under the basis vector `e_j`.
    pub(crate) fn act(&self, j: usize, vector: &[(usize, S)]) -> Row<S> {
        combination(&self.images[j], vector)
    }

    /// The dual module: `(x f)(v) = -f(x v)`.
    #[must_use]
    pub fn dual(&self) -> Self {
        let transposed = |images: &Vec<Row<S>>| {
            let mut dual = vec![vec![]; images.len()];
            for (a, image) in images.iter().enumerate() {
                image.iter().for_each(|(b, value)| dual[*b].push((a, -value.clone())));
            }
            dual
        };
        let images = self.images.iter().map(transposed).collect();
        let labels = self.labels.iter().map(|label| format!("{label}*")).collect();
        Module { algebra: self.algebra.clone(), labels, images }
    }

    /// The invariants: the vectors `v` with `x v = 0` for all `x`.
    ///
    /// # Errors
    /// [`Error::Size`] beyond the limit of [`invariant_tensors`](super::invariants::invariant_tensors).
    pub fn invariants(&self) -> Result<Subspace<S>, Error> {
        let (m, tolerance) = (self.dimension(), self.algebra.structure_constants().tolerance());
        let maps = 0..self.algebra.dimension();
        let image = |j: usize, vector: &[(usize, S)]| Ok(self.act(j, vector));
        let kernel = common_kernel("components of a vector", m, tolerance, maps, image)?;
        Ok(Subspace::span(m, (0..kernel.rows()).map(|at| kernel.row(at).to_vec())))
    }

    /// The quotient by a submodule, on the basis vectors that are not pivots of the submodule.
    ///
    /// # Errors
    /// [`Law::Submodule`] with a basis vector of the algebra and a vector whose image leaves the
    /// subspace; [`Error::Shape`] if the subspace has another number of components.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::algebra::structure::{StructureTheory, Subspace};
    /// use affinor::algebra::{Module, catalogue};
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let centre = StructureTheory::new(algebra.clone()).centre().clone();
    /// let quotient = Module::adjoint(&algebra).quotient(&centre)?;
    /// assert!(quotient.is_trivial() && quotient.dimension() == 2);
    /// let other = Subspace::span(3, [vec![(0, Rational::from(1))]]);
    /// assert!(Module::adjoint(&algebra).quotient(&other).is_err());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn quotient(&self, submodule: &Subspace<S>) -> Result<Self, Error> {
        if submodule.ambient() != self.dimension() {
            return Err(Error::Shape {
                what: "the submodule",
                expected: format!("vectors with {} components", self.dimension()),
                found: submodule.ambient().to_string(),
            });
        }
        for (j, vector) in
            (0..self.images.len()).flat_map(|j| submodule.basis().iter().map(move |v| (j, v)))
        {
            let image = self.act(j, vector);
            if !submodule.contains(&image) {
                let at = [self.algebra.labels()[j].clone(), self.write(vector)];
                return Err(Law::Submodule.broken(at, self.write(&image)));
            }
        }
        let places: Vec<usize> = submodule.complement().collect();
        let place = |at: usize| places.binary_search(&at).ok();
        let image = |image: &Row<S>| {
            let rest = submodule.reduce(image.clone()).into_iter();
            rest.filter_map(|(at, value)| Some((place(at)?, value))).collect::<Row<S>>()
        };
        let images = self.images.iter().map(|all| places.iter().map(|at| image(&all[*at])));
        let images = images.map(Iterator::collect).collect();
        let labels = places.iter().map(|at| self.labels[*at].clone()).collect();
        Ok(Module { algebra: self.algebra.clone(), labels, images })
    }

    /// The same module over another field; `None` if a value has no image.
    pub(crate) fn images_in<T>(
        &self,
        convert: impl Fn(&S) -> Option<T>,
    ) -> Option<Vec<Vec<Row<T>>>> {
        let row = |row: &Row<S>| {
            row.iter().map(|(at, value)| Some((*at, convert(value)?))).collect::<Option<Row<T>>>()
        };
        let all = |images: &Vec<Row<S>>| images.iter().map(row).collect::<Option<Vec<_>>>();
        self.images.iter().map(all).collect()
    }

    fn write(&self, row: &[(usize, S)]) -> String {
        let terms = row.iter().map(|(at, value)| (value.to_string(), self.labels[*at].clone()));
        affinor_tensors::text::combination(terms.collect::<Vec<_>>())
    }
}

fn negative<S: Scalar>(row: Row<S>) -> Row<S> {
    row.into_iter().map(|(at, value)| (at, -value)).collect()
}
