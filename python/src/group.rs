//! Groups over arrays of elements.

use crate::arrays::{self, Floats, Rows, common, fresh, with_axes, zeros};
use crate::class::{New, Object, Optional, immutable, in_python, properties};
use crate::run::{run, run_here};
use crate::source::{Arguments, PySource};
use crate::values::python;
use affinor::Error;
use affinor::group::batch;
use affinor::group::{
    AnyGroup, Coordinates, Embedded, LieGroup, MatrixNotation, Product, Se2, Se3, Se23, Sl2, So2,
    So3, registry,
};
use affinor_documents::input::InputError;
use affinor_tensors::Limits;
use affinor_tensors::Tolerance;
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Operations on rows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Operation {
    Exp,
    Log,
    Inverse,
    Compose,
    Between,
    Adjoint,
    Coadjoint,
    Bracket,
    TangentLeft,
    TangentLeftInverse,
    Matrix,
    Read,
    Restore,
}

/// The kinds of rows.
#[derive(Clone, Copy)]
enum Row {
    Vector,
    Element,
    Matrix,
}

/// The most rows that one thread handles without others.
const ALONE: usize = 512;

/// A Lie group. All operations take and give arrays, with the axes of a batch in front and NumPy's broadcasting.
///
/// Vectors are components in the basis of the algebra, of the shape (..., dimension). Elements are arrays of coordinates of
/// the shape (..., coordinates): a unit quaternion ``w, x, y, z`` for rotations, a quaternion and a position for SE(3),
/// entries column by column for groups of matrices, coordinates for R^n and nilpotent groups. Vectors of se(3) have the
/// rotation first. Groups are equal if they are made of the same name or the same definition.
///
/// Parameters
/// ----------
/// name : str
///     A name of the catalogue or a sum of names.
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
    /// For each coordinate of Python its index in the library, where quaternions end with w.
    order: Vec<usize>,
    dimension: usize,
    shape: (usize, usize),
}

/// The name or the source from which a group is made.
enum MadeOf {
    Name(String),
    Source(Py<PySource>),
}

/// Runs the same expression with the group in its own type, where that is known.
macro_rules! with_group {
    ($any:expr, $group:ident => $body:expr; $($G:ty),*) => {
        $(if let Some($group) = $any.downcast_ref::<$G>() { $body } else)* {
            let $group = $any;
            $body
        }
    };
}

/// The order of the coordinates of Python in those of the library.
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

/// The element with coordinates in the order of Python.
#[inline]
fn element<G: Embedded>(group: &G, order: &[usize], row: &[f64]) -> G::Element {
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
fn write_element<G: Embedded>(group: &G, order: &[usize], g: &G::Element, out: &mut [f64]) {
    let numbers = group.coordinates(g);
    let numbers = numbers.components();
    order.iter().zip(out).for_each(|(at, value)| *value = numbers[*at]);
}

/// One operation on one row of each argument.
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
            // zero and NaN have no inverse
            let one = group.compose(&g, &group.inverse(&g));
            let off = group.write(&one) - group.write(&group.identity());
            if !off.iter().all(|entry| entry.abs() < 0.5) {
                group.read(&group.write(&g))?;
            }
            Err(g)
        }
        Operation::Read => {
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

/// One operation on all rows.
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
            apply(group, order, operation, a.row(at), b.row(at), out).map_err(|error| {
                let error = InputError::from(error);
                let message = format!("element {at} of the batch: {}", error.message);
                InputError { message, ..error }
            })?;
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

/// Rotations by rows in a batch; `false` if the rows have to be taken one by one.
fn rotations(operation: Operation, [a, b]: [&Rows<'_>; 2], out: &mut [f64]) -> bool {
    let Some(rows) = a.all() else { return false };
    match operation {
        Operation::Exp => {
            let (x, g) = (rows.as_chunks::<3>().0, out.as_chunks_mut::<4>().0);
            if g.len() <= ALONE {
                batch::exp_rows(x, g);
            } else {
                let pairs = x.par_chunks(ALONE).zip(g.par_chunks_mut(ALONE));
                pairs.for_each(|(x, g)| batch::exp_rows(x, g));
            }
            true
        }
        Operation::Log => {
            let (g, x) = (rows.as_chunks::<4>().0, out.as_chunks_mut::<3>().0);
            // a batch with an element that has no logarithm is refused row by row
            if x.len() <= ALONE {
                return batch::log_rows(g, x);
            }
            let pairs = g.par_chunks(ALONE).zip(x.par_chunks_mut(ALONE));
            pairs.all(|(g, x)| batch::log_rows(g, x))
        }
        Operation::Compose => {
            let Some(others) = b.all() else { return false };
            let (g, h) = (rows.as_chunks::<4>().0, others.as_chunks::<4>().0);
            let out = out.as_chunks_mut::<4>().0;
            if g.len() != h.len() || g.len() != out.len() {
                return false;
            }
            if g.len() <= ALONE {
                batch::compose_rows(g, h, out);
            } else {
                let pairs = g.par_chunks(ALONE).zip(h.par_chunks(ALONE));
                let all = pairs.zip(out.par_chunks_mut(ALONE));
                all.for_each(|((g, h), out)| batch::compose_rows(g, h, out));
            }
            true
        }
        _ => false,
    }
}

impl PyGroup {
    fn new(name: String, group: AnyGroup, made: MadeOf) -> Self {
        let (order, dimension) = (order(&group), group.dimension());
        let shape = group.write(&group.identity()).shape();
        PyGroup { name, group, made, order, dimension, shape }
    }

    /// The group of the algebra of a source.
    pub fn of_source(py: Python<'_>, source: Py<PySource>) -> PyResult<Self> {
        let space = source.get().space(py)?;
        let group = run(py, || space.in_floats()?.group(Tolerance::default()))?;
        Ok(PyGroup::new(space.definition.name.clone(), group, MadeOf::Source(source)))
    }

    /// The arguments that equal groups have in common.
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

    /// The shape of one row.
    fn row(&self, kind: Row) -> Vec<usize> {
        match kind {
            Row::Vector => vec![self.dimension],
            Row::Element => vec![self.order.len()],
            Row::Matrix if self.shape.1 == 1 => vec![self.shape.0],
            Row::Matrix => vec![self.shape.0, self.shape.1],
        }
    }

    /// An operation on arrays, row by row.
    fn map<'py>(
        &self,
        py: Python<'py>,
        operation: Operation,
        first: (&str, Row, &Floats<'py>),
        second: Option<(&str, Row, &Floats<'py>)>,
        result: Row,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let own = arrays::batch(first.0, first.2, &self.row(first.1))?;
        let other = match &second {
            Some((name, kind, array)) => arrays::batch(name, array, &self.row(*kind))?,
            None => own,
        };
        let whole = common(own, other)?;
        let row = self.row(result);
        let out = fresh(py, &whole, &row)?;
        let a = Rows::new(first.2, own, &whole);
        let b = second.as_ref().map(|(_, _, array)| Rows::new(array, other, &whole));
        let b = b.as_ref().unwrap_or(&a);
        let width = row.iter().product::<usize>();
        {
            let mut target = out.readwrite();
            let target = target.as_slice_mut()?;
            let (order, any) = (&self.order, &self.group);
            let alone = target.len() <= ALONE * width;
            let is_so3 = any.downcast_ref::<So3>().is_some();
            let work = || {
                if is_so3 && rotations(operation, [&a, b], target) {
                    return Ok(());
                }
                with_group!(any, group =>
                    apply_all(group, order, operation, [&a, b], target, width);
                    So3, Se3, Se2, Se23, Sl2, So2)
            };
            if alone { run_here(py, work) } else { run(py, work) }?;
        }
        Ok(out)
    }
}

/// An array of floats.
pub type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Methods that apply an operation to rows: the arguments with their kinds, and the kind of the result.
macro_rules! operations {
    ($(
        $(#[doc = $doc:literal])*
        $name:ident($a:ident: $A:ident $(, $b:ident: $B:ident)?) -> $result:ident = $operation:ident;
    )*) => {
        #[pymethods]
        #[allow(clippy::wrong_self_convention, reason = "a group reads and writes its elements")]
        impl PyGroup {
            $(
                $(#[doc = $doc])*
                fn $name<'py>(
                    &self,
                    py: Python<'py>,
                    $a: Floats<'py>,
                    $($b: Floats<'py>,)?
                ) -> PyResult<Array<'py>> {
                    let first = (stringify!($a), Row::$A, &$a);
                    #[allow(unused_mut, unused_assignments, reason = "some have one argument")]
                    let mut second = None;
                    $(second = Some((stringify!($b), Row::$B, &$b));)?
                    self.map(py, Operation::$operation, first, second, Row::$result)
                }
            )*
        }
    };
}

operations! {
    /// The exponential of vectors (..., dimension): elements (..., coordinates).
    exp(x: Vector) -> Element = Exp;
    /// The logarithm of elements, near the identity the one near 0.
    log(g: Element) -> Vector = Log;
    /// The products ``g h``.
    compose(g: Element, h: Element) -> Element = Compose;
    /// The inverse elements.
    inverse(g: Element) -> Element = Inverse;
    /// ``g^-1 h``.
    between(g: Element, h: Element) -> Element = Between;
    /// Drifted elements projected back onto the group; elements without an inverse are an error.
    project(g: Element) -> Element = Restore;
    /// ``Ad_g x``.
    adjoint(g: Element, x: Vector) -> Vector = Adjoint;
    /// ``Ad*_g h``: spatial to body momentum.
    coadjoint(g: Element, h: Vector) -> Vector = Coadjoint;
    /// The bracket of vectors.
    bracket(x: Vector, y: Vector) -> Vector = Bracket;
    /// ``T_left(x) v``: ``exp(x + dx) = exp(x) exp(T_left(x) dx + ...)``.
    tangent_left(x: Vector, v: Vector) -> Vector = TangentLeft;
    /// ``T_left(x)^-1 v``.
    tangent_left_inverse(x: Vector, v: Vector) -> Vector = TangentLeftInverse;
    /// Elements as matrices (..., rows, columns), or as columns (..., rows) for vector groups and products.
    matrix(g: Element) -> Matrix = Matrix;
    /// The elements of matrices, which are checked.
    from_matrix(matrix: Matrix) -> Element = Read;
}

in_python! { PyGroup, "group":
    /// The matrices of ``Ad_g``, (..., dimension, dimension).
    adjoint_matrix (g) [g];
    /// The action of matrices of size k on points (..., k); affine maps, such as rigid motions, act on points
    /// (..., k - 1) too.
    act (g, points) [g, points];
    /// The point ``g exp(t log(g^-1 h))``: ``g`` at ``t = 0``, ``h`` at ``t = 1``; ``t`` has the shape of the batch.
    interpolate (g, h, t) [g, h, t];
}

immutable! { PyGroup }

properties! { PyGroup, own:
    /// The name of the algebra.
    name: &str = &own.name;
    /// The dimension of the algebra.
    dimension: usize = own.dimension;
    /// The number of coordinates of an element.
    coordinate_count: usize = own.order.len();
    _shape: (usize, usize) = own.shape;
}

#[pymethods]
impl PyGroup {
    /// The group of a name of the catalogue, or of names joined by `+`.
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

    /// The neutral element.
    pub fn identity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.written(py, &self.group.identity())
    }

    /// The mean of elements (count, coordinates): ``sum log(m^-1 g_i) = 0``.
    fn mean<'py>(&self, g: &Object<'py>) -> PyResult<Array<'py>> {
        let elements = self.elements(&with_axes("g", g, &[2])?)?;
        let mean = run(g.py(), || Ok(self.group.mean(&elements)?))?;
        self.written(g.py(), &mean)
    }

    /// Exponentials of normal vectors of this scale.
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

    /// Whether both are made of the same name or definition.
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

/// The argument of the constructor.
type Argument<'py> = (Object<'py>,);

impl PyGroup {
    /// The elements of an array.
    pub fn elements(&self, g: &Floats<'_>) -> PyResult<Vec<DVector<f64>>> {
        let own = arrays::batch("g", g, &self.row(Row::Element))?;
        let rows = Rows::new(g, own, own);
        let count = own.iter().product();
        Ok((0..count).map(|at| element(&self.group, &self.order, rows.row(at))).collect())
    }

    /// The coordinates of an element.
    fn written<'py>(&self, py: Python<'py>, g: &DVector<f64>) -> PyResult<Array<'py>> {
        let out = zeros(py, &[], &[self.order.len()]);
        self.write(g, out.readwrite().as_slice_mut()?);
        Ok(out)
    }

    /// Writes the coordinates of an element.
    pub fn write(&self, g: &DVector<f64>, row: &mut [f64]) {
        write_element(&self.group, &self.order, g, row);
    }

    /// Elements of an array with some axes, which are checked; their quaternions get the length 1.
    pub fn checked(
        &self,
        what: &str,
        g: &Bound<'_, PyAny>,
        axes: usize,
    ) -> PyResult<Vec<DVector<f64>>> {
        let (py, array) = (g.py(), with_axes(what, g, &[axes])?);
        let matrix = self.matrix(py, array)?;
        self.from_matrix(py, matrix.as_any().extract()?)?;
        let restored = self.project(py, with_axes(what, g, &[axes])?)?;
        self.elements(&restored.as_any().extract()?)
    }
}

/// The groups in closed form: pattern, and how their elements are written.
#[pyfunction]
pub fn groups() -> Vec<(&'static str, &'static str)> {
    registry::families().iter().map(|family| (family.pattern, family.summary)).collect()
}
