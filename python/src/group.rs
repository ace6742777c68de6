//! Groups over arrays of elements, and parallel transport.

use crate::arrays::{self, Floats, Rows, common, fresh, zeros};
use crate::errors::{raise, refused};
use crate::run::{run, run_here};
use affinor::Error;
use affinor::group::batch;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{
    AnyGroup, Coordinates, Embedded, LieGroup, MatrixNotation, Product, Se2, Se3, Se23, Sl2, So2,
    So3, registry,
};
use affinor_documents::input::InputError;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

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

/// A group; elements are arrays of coordinates, quaternions first and in the order w, x, y, z.
#[pyclass(name = "Group", frozen, module = "affinor._engine")]
pub struct PyGroup {
    name: String,
    group: AnyGroup,
    /// For each coordinate of Python its index in the library, where quaternions end with w.
    order: Vec<usize>,
    dimension: usize,
    shape: (usize, usize),
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
    pub fn new(name: String, group: AnyGroup) -> Self {
        let (order, dimension) = (order(&group), group.dimension());
        let shape = group.write(&group.identity()).shape();
        PyGroup { name, group, order, dimension, shape }
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

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

#[pymethods]
impl PyGroup {
    /// The group of a name of the catalogue, or of names joined by `+`.
    #[new]
    fn named(py: Python<'_>, name: &str) -> PyResult<Self> {
        let group = run(py, || Ok(registry::find(name)?))?;
        Ok(PyGroup::new(name.into(), group))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn dimension(&self) -> usize {
        self.dimension
    }

    /// The number of coordinates of an element.
    #[getter]
    fn coordinate_count(&self) -> usize {
        self.order.len()
    }

    /// Rows and columns of the matrix of an element.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        self.shape
    }

    fn identity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let out = zeros(py, &[], &[self.order.len()]);
        write_element(
            &self.group,
            &self.order,
            &self.group.identity(),
            out.readwrite().as_slice_mut()?,
        );
        Ok(out)
    }

    fn exp<'py>(&self, py: Python<'py>, x: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Exp, ("x", Row::Vector, &x), None, Row::Element)
    }

    fn log<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Log, ("g", Row::Element, &g), None, Row::Vector)
    }

    fn inverse<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Inverse, ("g", Row::Element, &g), None, Row::Element)
    }

    fn project<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Restore, ("g", Row::Element, &g), None, Row::Element)
    }

    fn compose<'py>(
        &self,
        py: Python<'py>,
        g: Floats<'py>,
        h: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("h", Row::Element, &h));
        self.map(py, Operation::Compose, ("g", Row::Element, &g), second, Row::Element)
    }

    fn between<'py>(
        &self,
        py: Python<'py>,
        g: Floats<'py>,
        h: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("h", Row::Element, &h));
        self.map(py, Operation::Between, ("g", Row::Element, &g), second, Row::Element)
    }

    fn adjoint<'py>(
        &self,
        py: Python<'py>,
        g: Floats<'py>,
        x: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("x", Row::Vector, &x));
        self.map(py, Operation::Adjoint, ("g", Row::Element, &g), second, Row::Vector)
    }

    fn coadjoint<'py>(
        &self,
        py: Python<'py>,
        g: Floats<'py>,
        h: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("h", Row::Vector, &h));
        self.map(py, Operation::Coadjoint, ("g", Row::Element, &g), second, Row::Vector)
    }

    fn bracket<'py>(
        &self,
        py: Python<'py>,
        x: Floats<'py>,
        y: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("y", Row::Vector, &y));
        self.map(py, Operation::Bracket, ("x", Row::Vector, &x), second, Row::Vector)
    }

    fn tangent_left<'py>(
        &self,
        py: Python<'py>,
        x: Floats<'py>,
        v: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("v", Row::Vector, &v));
        self.map(py, Operation::TangentLeft, ("x", Row::Vector, &x), second, Row::Vector)
    }

    fn tangent_left_inverse<'py>(
        &self,
        py: Python<'py>,
        x: Floats<'py>,
        v: Floats<'py>,
    ) -> PyResult<Array<'py>> {
        let second = Some(("v", Row::Vector, &v));
        self.map(py, Operation::TangentLeftInverse, ("x", Row::Vector, &x), second, Row::Vector)
    }

    fn matrix<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Matrix, ("g", Row::Element, &g), None, Row::Matrix)
    }

    #[pyo3(name = "from_matrix")]
    fn read<'py>(&self, py: Python<'py>, matrix: Floats<'py>) -> PyResult<Array<'py>> {
        self.map(py, Operation::Read, ("matrix", Row::Matrix, &matrix), None, Row::Element)
    }

    /// The mean of the elements of an array of the shape (count, coordinates).
    fn mean<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Array<'py>> {
        let elements = self.elements(&g)?;
        let mean = run(py, || Ok(self.group.mean(&elements)?))?;
        let out = zeros(py, &[], &[self.order.len()]);
        write_element(&self.group, &self.order, &mean, out.readwrite().as_slice_mut()?);
        Ok(out)
    }
}

impl PyGroup {
    fn elements(&self, g: &Floats<'_>) -> PyResult<Vec<DVector<f64>>> {
        let own = arrays::batch("g", g, &self.row(Row::Element))?;
        let rows = Rows::new(g, own, own);
        let count = own.iter().product();
        Ok((0..count).map(|at| element(&self.group, &self.order, rows.row(at))).collect())
    }
}

/// A group with a connection: parallel transport and autoparallels.
#[pyclass(name = "Transport", frozen, module = "affinor._engine")]
pub struct PyTransport(pub ParallelTranslation<AnyGroup>);

impl PyTransport {
    fn group(&self) -> PyGroup {
        PyGroup::new(String::new(), self.0.group().clone())
    }
}

/// Elements and tangent vectors.
type Path<'py> = (Array<'py>, Array<'py>);

fn square<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows: Vec<Vec<f64>> = matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    Ok(PyArray2::from_vec2(py, &rows)?)
}

fn list(rows: &Rows<'_>, count: usize) -> Vec<DVector<f64>> {
    (0..count).map(|at| DVector::from_column_slice(rows.row(at))).collect()
}

#[pymethods]
impl PyTransport {
    /// The matrix of parallel translation along consecutive arcs `exp(s x)`, one a row.
    fn along<'py>(
        &self,
        py: Python<'py>,
        arcs: Floats<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let own = arrays::batch("arcs", &arcs, &[self.0.group().dimension()])?;
        let count = own.iter().product();
        let arcs = list(&Rows::new(&arcs, own, own), count);
        square(py, &run(py, || Ok(self.0.along_arcs(&arcs)?))?)
    }

    /// The matrix of parallel translation along sampled elements, one a row.
    fn samples<'py>(&self, py: Python<'py>, g: Floats<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let elements = self.group().elements(&g)?;
        square(py, &run(py, || Ok(self.0.along_samples(&elements)?))?)
    }

    /// The autoparallel from an element with a tangent vector: elements and tangent vectors at the times.
    fn autoparallel<'py>(
        &self,
        py: Python<'py>,
        start: Floats<'py>,
        tangent: Floats<'py>,
        times: Vec<f64>,
        tolerance: f64,
    ) -> PyResult<Path<'py>> {
        let group = self.group();
        arrays::batch("tangent", &tangent, &[group.dimension])?;
        let start = group.elements(&start)?;
        let Some(start) = start.first() else {
            return Err(refused(py, InputError::usage("no element is given")));
        };
        let own = &tangent.shape()[..tangent.ndim() - 1];
        let tangent = DVector::from_column_slice(Rows::new(&tangent, own, own).row(0));
        let path = run(py, || Ok(self.0.autoparallel(start, &tangent, &times, tolerance)?))?;
        let elements = zeros(py, &[path.len()], &[group.order.len()]);
        let tangents = zeros(py, &[path.len()], &[group.dimension]);
        {
            let (mut g, mut n) = (elements.readwrite(), tangents.readwrite());
            let rows = g.as_slice_mut()?.chunks_exact_mut(group.order.len());
            let vectors = n.as_slice_mut()?.chunks_exact_mut(group.dimension);
            for ((point, row), vector) in path.iter().zip(rows).zip(vectors) {
                write_element(&group.group, &group.order, &point.base, row);
                vector.copy_from_slice(point.left.as_slice());
            }
        }
        Ok((elements, tangents))
    }

    /// The tangent vector at one element of an autoparallel that is at another at time 1.
    fn between<'py>(
        &self,
        py: Python<'py>,
        start: Floats<'py>,
        end: Floats<'py>,
        tolerance: f64,
    ) -> PyResult<Array<'py>> {
        let group = self.group();
        let ends = [group.elements(&start)?, group.elements(&end)?];
        let [Some(start), Some(end)] = ends.each_ref().map(|elements| elements.first()) else {
            return Err(raise(py, &InputError::usage("no element is given")));
        };
        let tangent = run(py, || Ok(self.0.autoparallel_between(start, end, tolerance)?))?;
        let out = zeros(py, &[], &[group.dimension]);
        out.readwrite().as_slice_mut()?.copy_from_slice(tangent.as_slice());
        Ok(out)
    }
}

/// The groups in closed form: pattern, and how their elements are written.
#[pyfunction]
pub fn groups() -> Vec<(&'static str, &'static str)> {
    registry::families().iter().map(|family| (family.pattern, family.summary)).collect()
}
