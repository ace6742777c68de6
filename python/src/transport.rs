//! Parallel transport and autoparallels on the group of a geometry.

use crate::arrays::{Floats, batch, with_axes, zeros};
use crate::class::{New, Object, Optional};
use crate::components::float;
use crate::geometries::each;
use crate::geometry::PyGeometry;
use crate::group::{Array, PyGroup};
use crate::run::run;
use crate::values::python;
use affinor::group::AnyGroup;
use affinor::group::transport::ParallelTranslation;
use affinor::{Connection, Frame, Geometry};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_tensors::Tensor;
use nalgebra::{DMatrix, DVector};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Square<'py> = Bound<'py, PyArray2<f64>>;

fn square<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> PyResult<Square<'py>> {
    let rows: Vec<Vec<f64>> = matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    Ok(PyArray2::from_vec2(py, &rows)?)
}

/// The rows of an array as vectors.
fn vectors(array: &Floats<'_>, dimension: usize) -> Vec<DVector<f64>> {
    let all: Vec<f64> = array.as_array().iter().copied().collect();
    all.chunks_exact(dimension).map(DVector::from_column_slice).collect()
}

impl PyGeometry {
    /// The group whose Lie algebra is the algebra of the geometry.
    fn group_of(&self, py: Python<'_>) -> PyResult<PyGroup> {
        PyGroup::of_source(py, Py::new(py, self.source.get().of_algebra(py)?)?)
    }

    /// The group of the algebra, and parallel transport on it by the connection.
    fn translation(&self, py: Python<'_>) -> PyResult<(PyGroup, ParallelTranslation<AnyGroup>)> {
        fn floats<S: Coefficient>(tensor: &Tensor<S>) -> Result<Tensor<f64>, InputError> {
            tensor.nonzero().try_for_each(|value| float(value).map(|_| ()))?;
            Ok(tensor.map(|value| value.to_f64().unwrap_or(f64::NAN)))
        }
        fn connection<S: Coefficient>(
            geometry: &Geometry<S>,
        ) -> Result<Connection<f64>, InputError> {
            geometry.frame_origin().algebra_for("parallel transport on a group")?;
            let frame = geometry.frame();
            let frame = Frame::invariant(frame.labels(), floats(frame.structure_functions())?)?;
            Ok(Connection::new(frame, floats(geometry.connection().affinities())?)?)
        }
        let group = self.group_of(py)?;
        let translation = run(py, || {
            let connection = each!(&self.values, geometry => connection(geometry)?);
            Ok(ParallelTranslation::new(group.group().clone(), connection)?)
        })?;
        Ok((group, translation))
    }
}

#[pymethods]
impl PyGeometry {
    /// Lie group of the algebra, with vectors in its basis.
    ///
    /// Returns
    /// -------
    /// Group
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@plus").group().coordinate_count
    /// 4
    fn group(&self, py: Python<'_>) -> PyResult<PyGroup> {
        self.group_of(py)
    }

    /// Matrix of parallel transport along consecutive arcs ``g exp(s x)``, ``0 <= s <= 1``.
    ///
    /// Parameters
    /// ----------
    /// arcs : array of the shape (dimension,) or (count, dimension)
    ///     The vector ``x`` of each arc.
    ///
    /// Returns
    /// -------
    /// array of the shape (dimension, dimension)
    ///     The matrix maps components at the start to components at the end, in the left-invariant frame; the upper
    ///     index is the row.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").transport([0, 0, 1]).round(6)
    /// array([[ 0.877583,  0.479426,  0.      ],
    ///        [-0.479426,  0.877583,  0.      ],
    ///        [ 0.      ,  0.      ,  1.      ]])
    fn transport<'py>(&self, arcs: &Object<'py>) -> PyResult<Square<'py>> {
        let py = arcs.py();
        let (group, translation) = self.translation(py)?;
        let arcs = with_axes("arcs", arcs, &[1, 2])?;
        batch("arcs", arcs.shape(), &[group.dimension()])?;
        let arcs = vectors(&arcs, group.dimension());
        square(py, &run(py, || Ok(translation.along_arcs(&arcs)?))?)
    }

    /// Matrix of parallel transport along a curve of elements. For a closed curve, the matrix is the holonomy.
    ///
    /// Parameters
    /// ----------
    /// elements : array of the shape (count, coordinates)
    ///     Elements of the curve, joined by arcs ``g exp(s x)``. For other curves, the error is of second order in the
    ///     distance of elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (dimension, dimension)
    ///     The matrix maps components at the start to components at the end, in the left-invariant frame; the upper
    ///     index is the row.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     Two adjacent elements are too far apart for a logarithm.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").transport_along(SO3.exp([[0, 0, 0], [0, 0, 1]])).round(6)
    /// array([[ 0.877583,  0.479426,  0.      ],
    ///        [-0.479426,  0.877583,  0.      ],
    ///        [ 0.      ,  0.      ,  1.      ]])
    fn transport_along<'py>(&self, elements: &Object<'py>) -> PyResult<Square<'py>> {
        let py = elements.py();
        let (group, translation) = self.translation(py)?;
        let elements = group.checked("elements", elements, 2)?;
        square(py, &run(py, || Ok(translation.along_samples(&elements)?))?)
    }

    /// Autoparallel curve ``nabla_n n = 0`` that starts at an element.
    ///
    /// Parameters
    /// ----------
    /// tangent : array of the shape (dimension,)
    ///     Initial velocity in the left-invariant frame.
    /// times : float or array of the shape (count,)
    ///     Times later than 0, at which the curve is returned.
    /// start : array of the shape (coordinates,), optional
    ///     Initial element; by default the identity.
    /// tolerance : float
    ///     Relative tolerance of each step.
    ///
    /// Returns
    /// -------
    /// Geodesic
    ///
    /// Raises
    /// ------
    /// IntegrationError
    ///     The curve leaves every bounded set before the last time, so it cannot be continued.
    ///
    /// Examples
    /// --------
    /// >>> curve = Geometry("so3", metric=[1, 1, 1]).geodesic([0, 0, 1], [0.5, 1])
    /// >>> SO3.log(curve.elements).round(9)
    /// array([[0. , 0. , 0.5],
    ///        [0. , 0. , 1. ]])
    #[pyo3(signature = (tangent, times, start=None, *, tolerance=1e-12))]
    fn geodesic<'py>(
        &self,
        tangent: &Object<'py>,
        times: &Object<'py>,
        start: Optional<'py>,
        tolerance: f64,
    ) -> New<'py> {
        let py = tangent.py();
        let (group, translation) = self.translation(py)?;
        let times = with_axes("times", times, &[0, 1])?;
        let times: Vec<f64> = times.as_array().iter().copied().collect();
        let start = start.map_or_else(|| Ok(group.identity(py)?.into_any()), PyResult::Ok)?;
        let start = group.checked("start", &start, 1)?;
        let tangent = with_axes("tangent", tangent, &[1])?;
        batch("tangent", tangent.shape(), &[group.dimension()])?;
        let tangent = vectors(&tangent, group.dimension()).swap_remove(0);
        let path =
            run(py, || Ok(translation.autoparallel(&start[0], &tangent, &times, tolerance)?))?;
        let elements = zeros(py, &[path.len()], &[group.coordinate_count()]);
        let tangents = zeros(py, &[path.len()], &[group.dimension()]);
        {
            let (mut g, mut n) = (elements.readwrite(), tangents.readwrite());
            let rows = g.as_slice_mut()?.chunks_exact_mut(group.coordinate_count());
            let vectors = n.as_slice_mut()?.chunks_exact_mut(group.dimension());
            for ((point, row), vector) in path.iter().zip(rows).zip(vectors) {
                group.write(&point.base, row);
                vector.copy_from_slice(point.left.as_slice());
            }
        }
        let times = PyArray1::from_vec(py, times);
        python(py, "geometry", "Geodesic")?.call1((times, elements, tangents))
    }

    /// Initial velocity of an autoparallel curve that connects two elements in the time 1. Other such curves may exist.
    ///
    /// Parameters
    /// ----------
    /// start, end : array of the shape (coordinates,)
    ///     Elements at the time 0 and at the time 1.
    /// tolerance : float
    ///     Largest error of the element at the time 1.
    ///
    /// Returns
    /// -------
    /// array of the shape (dimension,)
    ///     Components in the left-invariant frame.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     No curve was found, or ``start^-1 end`` has no logarithm.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric=[1, 1, 1]).geodesic_between(SO3.identity(), SO3.exp([0, 0, 2])).round(9)
    /// array([0., 0., 2.])
    #[pyo3(signature = (start, end, *, tolerance=1e-10))]
    fn geodesic_between<'py>(
        &self,
        start: &Object<'py>,
        end: &Object<'py>,
        tolerance: f64,
    ) -> PyResult<Array<'py>> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            let message = format!("the tolerance {tolerance:?} is not positive");
            return Err(PyValueError::new_err(message));
        }
        let py = start.py();
        let (group, translation) = self.translation(py)?;
        let (start, end) = (group.checked("start", start, 1)?, group.checked("end", end, 1)?);
        let tangent =
            run(py, || Ok(translation.autoparallel_between(&start[0], &end[0], tolerance)?))?;
        let out = zeros(py, &[], &[group.dimension()]);
        out.readwrite().as_slice_mut()?.copy_from_slice(tangent.as_slice());
        Ok(out)
    }
}
