//! Groups whose methods act on arrays of elements.

use crate::arrays::{self, Input, common, fresh, with_axes, zeros};
use crate::class::{New, Object, Optional, immutable, properties};
use crate::rows::{Closed, Ground, Operation, element, write_element};
use crate::run::{run, run_here};
use crate::source::{Arguments, PySource};
use crate::values::python;
use affinor::group::{
    AnyGroup, Embedded, LieGroup, MatrixNotation, Product, Se3, Se23, So3, registry,
};
use affinor_tensors::Tolerance;
use nalgebra::DVector;
use numpy::{PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Deref;
use std::sync::OnceLock;

/// The kinds of rows of an array.
#[derive(Clone, Copy)]
pub enum Row {
    Vector,
    Element,
    Matrix,
    /// The matrix of a linear map of the algebra.
    Operator,
    /// A point with this number of coordinates.
    Point(usize),
}

/// The shape of a row, which has one or two axes, and the number of axes.
struct RowShape([usize; 2], usize);

impl Deref for RowShape {
    type Target = [usize];
    fn deref(&self) -> &[usize] {
        &self.0[..self.1]
    }
}

/// How elements act on points.
#[derive(Clone, Copy)]
pub struct Action {
    /// The size of the matrices.
    pub size: usize,
    /// Whether the last row of all matrices is 0, ..., 0, 1.
    pub is_affine: bool,
}

/// The largest size of a result that is stored on the stack.
const FEW: usize = 64;

/// Lie group whose elements are rows of arrays.
///
/// All methods broadcast as NumPy does; the first axes are the axes of the batch. Vectors are components
/// in the basis of the algebra, of the shape (..., dimension). Angles are in radians, and lengths in
/// any consistent units. Elements are embedding coordinates of the shape (..., coordinates). Elements of
/// SO(3) are unit quaternions ``w, x, y, z``; elements of SE(3) are a quaternion and a position.
/// Elements of matrix groups are matrices, column by column; elements of R^n and of nilpotent groups are
/// coordinates. Vectors of se(3) have the rotation first. Groups are equal if they are made from the
/// same name or the same definition.
///
/// Parameters
/// ----------
/// name : str
///     Name of the catalogue, or a sum of names such as ``"so3+R^3"``.
///
/// Raises
/// ------
/// InputError
///     The name is unknown.
///
/// Examples
/// --------
/// >>> SO2 = Group("so2")
/// >>> SO2.log(SO2.compose(SO2.exp([1.0]), SO2.exp([0.5])))
/// array([1.5])
#[pyclass(name = "Group", frozen, subclass, module = "affinor")]
pub struct PyGroup {
    name: String,
    group: AnyGroup,
    made: MadeOf,
    /// For each coordinate in Python, its index in the library. Quaternions in the library end with w.
    order: Vec<usize>,
    dimension: usize,
    shape: (usize, usize),
    closed: Closed,
    /// The action on points, if there is one. It is determined when it is used for the first time.
    action: OnceLock<Option<Action>>,
}

/// The name or the source from which a group was created.
enum MadeOf {
    Name(String),
    Source(Py<PySource>),
}

/// For each coordinate in Python, its index in the library.
fn order(group: &AnyGroup) -> Vec<usize> {
    if let Some(Product(first, second)) = group.downcast_ref::<Product<AnyGroup, AnyGroup>>() {
        let mut all = order(first);
        let behind = all.len();
        all.extend(order(second).into_iter().map(|at| at + behind));
        return all;
    }
    let quaternion = group.downcast_ref::<So3>().is_some()
        || group.downcast_ref::<Se3>().is_some()
        || group.downcast_ref::<Se23>().is_some();
    let count = group.embedding_dimension();
    if quaternion {
        [3, 0, 1, 2].into_iter().chain(4..count).collect()
    } else {
        (0..count).collect()
    }
}

impl PyGroup {
    fn new(name: String, group: AnyGroup, made: MadeOf) -> Self {
        let (order, dimension) = (order(&group), group.dimension());
        let shape = group.write(&group.identity()).shape();
        let closed = if group.downcast_ref::<So3>().is_some() {
            Closed::So3
        } else if group.downcast_ref::<Se3>().is_some() {
            Closed::Se3
        } else {
            Closed::Other
        };
        PyGroup { name, group, made, order, dimension, shape, closed, action: OnceLock::new() }
    }

    /// Creates the group of the algebra of a source.
    pub fn of_source(py: Python<'_>, source: Py<PySource>) -> PyResult<Self> {
        let space = source.get().space(py)?;
        let group = run(py, || space.in_floats()?.group(Tolerance::default()))?;
        Ok(PyGroup::new(space.definition.name.clone(), group, MadeOf::Source(source)))
    }

    /// The arguments that determine equality of groups.
    fn arguments(&self) -> Arguments {
        match &self.made {
            MadeOf::Name(name) => Arguments::named(name),
            MadeOf::Source(source) => source.get().arguments(),
        }
    }

    /// The group of the library.
    pub fn group(&self) -> &AnyGroup {
        &self.group
    }

    /// The shape of a row of this kind.
    fn row(&self, kind: Row) -> RowShape {
        match kind {
            Row::Vector => RowShape([self.dimension, 0], 1),
            Row::Element => RowShape([self.order.len(), 0], 1),
            Row::Matrix if self.shape.1 == 1 => RowShape([self.shape.0, 0], 1),
            Row::Matrix => RowShape([self.shape.0, self.shape.1], 2),
            Row::Operator => RowShape([self.dimension; 2], 2),
            Row::Point(size) => RowShape([size, 0], 1),
        }
    }

    /// The action on points, if the elements are square matrices. A group of vectors with one component has no action;
    /// it is recognized by its identity, the 1 x 1 matrix 0.
    pub fn action(&self) -> Option<Action> {
        *self.action.get_or_init(|| {
            let (rows, columns) = self.shape;
            let one = self.group.write(&self.group.identity());
            if rows != columns || one.iter().all(|entry| *entry == 0.0) {
                return None;
            }
            let is_affine = self.group.basis().iter().all(|x| {
                let g = self.group.write(&self.group.exp(x));
                (0..columns).all(|k| g[(rows - 1, k)] == f64::from(k + 1 == columns))
            });
            Some(Action { size: rows, is_affine })
        })
    }

    /// Applies an operation to arrays, row by row.
    pub fn map<'py>(
        &self,
        py: Python<'py>,
        operation: Operation,
        first: (&str, Row, &Input<'py>),
        second: Option<(&str, Row, &Input<'py>)>,
        result: Row,
    ) -> PyResult<Array<'py>> {
        let own = arrays::batch(first.0, first.2.shape(), &self.row(first.1))?;
        let other = match &second {
            Some((name, kind, array)) => arrays::batch(name, array.shape(), &self.row(*kind))?,
            None => own,
        };
        let whole = common(own, other)?;
        let row = self.row(result);
        let rows = || {
            let b = second.as_ref().map(|(_, _, array)| array.rows(other, &whole));
            (first.2.rows(own, &whole), b)
        };
        let size = |shape: &[usize]| shape.iter().fold(1, |size: usize, n| size.saturating_mul(*n));
        let (count, width) = (size(&whole), size(&row));
        let ground = Ground { group: &self.group, closed: self.closed, order: &self.order };
        if count.saturating_mul(width) <= FEW && whole.len() + row.len() <= arrays::AXES {
            let (a, b) = rows();
            let rows = [&a, b.as_ref().unwrap_or(&a)];
            let mut numbers = [0.0; FEW];
            let numbers = &mut numbers[..count * width];
            run_here(py, || ground.operate(operation, rows, numbers, width))?;
            return arrays::array(py, &whole, &row, numbers);
        }
        // allocates the result first, so that a result that is too large is an error before an argument is copied
        let out = fresh(py, &whole, &row)?;
        {
            let (a, b) = rows();
            let rows = [&a, b.as_ref().unwrap_or(&a)];
            let mut target = out.readwrite();
            let target = target.as_slice_mut()?;
            let work = || ground.operate(operation, rows, target, width);
            if ground.is_alone(count, width) { run_here(py, work) } else { run(py, work) }?;
        }
        Ok(out)
    }
}

/// An array of floats.
pub type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

immutable! { PyGroup }

properties! { PyGroup, own:
    /// Name of the algebra.
    name: &str = &own.name;
    /// Dimension of the algebra, which is the length of a vector.
    dimension: usize = own.dimension;
    /// Number of coordinates of an element.
    coordinate_count: usize = own.order.len();
    _shape: (usize, usize) = own.shape;
}

#[pymethods]
impl PyGroup {
    /// Creates a group from a name of the catalogue, or from names joined by `+`.
    #[new]
    fn __new__(name: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = name.py();
        if let Ok(source) = name.cast::<PySource>() {
            return Self::of_source(py, source.clone().unbind());
        }
        let name: String = name.extract().map_err(|_| {
            let found = name.get_type().name().map_or_else(|_| String::new(), |n| n.to_string());
            PyTypeError::new_err(format!("the name of a group is a text, not {found}"))
        })?;
        let group = run(py, || Ok(registry::find(&name)?))?;
        Ok(PyGroup::new(name.clone(), group, MadeOf::Name(name)))
    }

    /// Identity element.
    ///
    /// Returns
    /// -------
    /// array of the shape (coordinates,)
    ///
    /// Examples
    /// --------
    /// >>> SE3.identity()
    /// array([1., 0., 0., 0., 0., 0., 0.])
    pub fn identity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.written(py, &self.group.identity())
    }

    /// Matrices ``E_k`` of the basis vectors: the derivatives of ``matrix(exp(s e_k))`` at ``s = 0``.
    ///
    /// Returns
    /// -------
    /// array of the shape (dimension, rows, columns)
    ///     The first index is the number ``k`` of the basis vector.
    ///
    /// Examples
    /// --------
    /// >>> SO2.generators()
    /// array([[[ 0., -1.],
    ///         [ 1.,  0.]]])
    fn generators<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let (rows, columns) = self.shape;
        // the matrix of a product has one column, which contains the entries of all factors
        let (mut entries, mut count, mut first) = (vec![], 0, 0);
        for factor in self.group.factors() {
            let generators = factor.generators();
            let size = factor.write(&factor.identity()).len();
            for generator in &generators {
                let mut own = vec![0.0; rows * columns];
                own[first..first + size].copy_from_slice(generator.transpose().as_slice());
                entries.extend(own);
            }
            (count, first) = (count + generators.len(), first + size);
        }
        arrays::array(py, &[count], &[rows, columns], &entries)
    }

    /// Random elements: exponentials of vectors whose components are independent and normally distributed.
    ///
    /// Parameters
    /// ----------
    /// shape : int or tuple of ints
    ///     Shape of the batch; by default a single element is generated.
    /// rng : numpy.random.Generator or int, optional
    ///     Random generator, or a seed for it; by default a fresh seed is used.
    /// scale : float
    ///     Standard deviation of each component, in radians or units of length.
    ///
    /// Returns
    /// -------
    /// array of the shape ``(*shape, coordinates)``
    ///
    /// Examples
    /// --------
    /// >>> SO3.random((2, 5), rng=1, scale=0.1).shape
    /// (2, 5, 4)
    #[pyo3(
        signature = (shape=None, *, rng=None, scale=1.0),
        text_signature = "($self, shape=(), *, rng=None, scale=1.0)"
    )]
    fn random<'py>(
        slf: &Bound<'py, Self>,
        shape: Optional<'py>,
        rng: Optional<'py>,
        scale: f64,
    ) -> New<'py> {
        python(slf.py(), "group", "random")?.call1((slf, shape, rng, scale))
    }

    fn __repr__(&self) -> String {
        let (name, n, count) = (&self.name, self.dimension, self.order.len());
        format!("<Group {name}, dimension {n}, {count} coordinates>")
    }

    /// Whether both groups are created from the same name or definition.
    fn __eq__(&self, other: &PyGroup) -> bool {
        self.arguments() == other.arguments()
    }

    fn __hash__(&self) -> u64 {
        let mut state = DefaultHasher::new();
        self.arguments().hash(&mut state);
        state.finish()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, Argument<'py>)> {
        let argument = match &slf.get().made {
            MadeOf::Name(name) => name.into_pyobject(slf.py())?.into_any(),
            MadeOf::Source(source) => source.bind(slf.py()).clone().into_any(),
        };
        Ok((slf.get_type(), (argument,)))
    }
}

/// The arguments of the constructor.
type Argument<'py> = (Object<'py>,);

impl PyGroup {
    /// Converts an array to elements.
    pub fn elements(&self, g: &Input<'_>) -> PyResult<Vec<DVector<f64>>> {
        let own = arrays::batch("g", g.shape(), &self.row(Row::Element))?;
        let rows = g.rows(own, own);
        let count = own.iter().product();
        Ok((0..count).map(|at| element(&self.group, &self.order, rows.row(at))).collect())
    }

    /// The coordinates of an element as an array.
    fn written<'py>(&self, py: Python<'py>, g: &DVector<f64>) -> PyResult<Array<'py>> {
        let out = zeros(py, &[], &[self.order.len()]);
        self.write(g, out.readwrite().as_slice_mut()?);
        Ok(out)
    }

    /// Writes the coordinates of an element into a row.
    pub fn write(&self, g: &DVector<f64>, row: &mut [f64]) {
        write_element(&self.group, &self.order, g, row);
    }

    /// Checks the elements of an array with `axes` axes, and returns them with normalized quaternions.
    pub fn checked(
        &self,
        what: &str,
        g: &Bound<'_, PyAny>,
        axes: usize,
    ) -> PyResult<Vec<DVector<f64>>> {
        let (py, array) = (g.py(), with_axes(what, g, &[axes])?);
        let matrix = self.matrix(py, Input::Array(array))?;
        self.from_matrix(py, matrix.as_any().extract()?, true)?;
        let restored = self.project(py, Input::Array(with_axes(what, g, &[axes])?))?;
        self.elements(&restored.as_any().extract()?)
    }
}

/// Groups whose operations are computed in closed form.
///
/// Returns
/// -------
/// list of (str, str)
///     Pattern of the name, and a description of the elements.
///
/// Examples
/// --------
/// >>> groups()[0]
/// ('R^n', 'columns of n coordinates')
#[pyfunction]
pub fn groups() -> Vec<(&'static str, &'static str)> {
    registry::families().iter().map(|family| (family.pattern, family.summary)).collect()
}
