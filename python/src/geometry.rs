//! Geometries: a frame with a connection and optionally a metric, over the three scalar types.

use crate::algebra::PyAlgebra;
use crate::class::{New, Object, Optional, constructors, immutable, in_python, properties};
use crate::components::{Held, parameters};
use crate::errors::refused;
use crate::family::{PyFamily, Recorder};
use crate::geometries::{Geometries, Grounded, each, in_floats};
use crate::run::run;
use crate::source::PySource;
use crate::tensor::{Names, PyTensor};
use crate::values::{merged, number, python};
use affinor::geometry::properties::Property;
use affinor::{Error, Geometry};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::report::Quantity;
use affinor_tensors::Tolerance;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use std::sync::{Arc, OnceLock};

/// Geometry: a frame with a connection and, optionally, a metric. Every quantity of ``affinor table`` is a property.
///
/// Parameters
/// ----------
/// space : LieAlgebra, str, path or dict
///     A LieAlgebra or anything that defines one, a name with a connection (``"so3@plus"``), or a definition with a
///     chart. A homogeneous space has names such as ``"SU(3)/U(2)"`` and ``"CP^2"``. ``"M3"`` and ``"SO3"`` are the geometries of Paraskevopoulos and Natsiavas (2013).
/// connection : str or number, optional
///     ``plus``, ``zero``, ``minus``, ``levi-civita``, ``lambda=1/3`` or a number lambda. ``canonical`` and
///     ``natural`` are ``minus`` and ``zero`` on a homogeneous space. The default is ``levi-civita`` if there is a
///     metric, otherwise ``zero``.
/// metric : str, array or list, optional
///     ``identity``, ``killing``, ``invariant``, ``diag(...)``, a symmetric matrix ``g_ij``, or a list of diagonal entries. Unknown
///     names become parameters.
/// basis : str or list of str, optional
///     Names of the basis vectors; required for brackets.
/// affinities : array or Tensor, optional
///     Affinities ``Lambda^i_jk``, instead of a connection. Their slots are ``^__``; the direction is the first lower
///     index.
/// torsion, nonmetricity : array or Tensor, optional
///     Torsion with the slots ``^__`` and nonmetricity with the slots ``___``, instead of a connection; they need a
///     metric.
/// frame : str
///     ``"left"`` for components in the left-invariant frame, or ``"right"`` for the right-invariant frame.
/// scalar : str
///     ``"exact"`` (``symbolic`` if there are parameters) or ``"float"``.
/// tolerance : float, optional
///     For floats: a sum counts as zero below this bound, relative to its terms.
///
/// Raises
/// ------
/// MetricError
///     The metric is not symmetric or is degenerate, or ``levi-civita`` is given without a metric.
///
/// Examples
/// --------
/// >>> Geometry("so3", metric=[1, 1, 1]).scalar_curvature
/// Fraction(3, 2)
/// >>> Geometry("CP^2", metric="killing").scalar_curvature
/// Fraction(2, 1)
/// >>> print(Geometry("so3", metric="diag(a,a,b)").ricci[2, 2])
/// b**2/(2*a**2)
#[pyclass(name = "Geometry", frozen, subclass, module = "affinor")]
pub struct PyGeometry {
    pub source: Py<PySource>,
    /// The tensors that define the connection, by name: affinities, or torsion and nonmetricity.
    extra: Vec<(String, Py<PyTensor>)>,
    frame: String,
    pub symbols: Py<PyDict>,
    pub values: Geometries,
    /// The recorded programs of the quantities.
    recorder: OnceLock<Arc<Recorder>>,
}

/// The quantity with this name.
pub fn quantity(key: &str) -> PyResult<Quantity> {
    Quantity::from_key(key).ok_or_else(|| {
        let keys: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::key).collect();
        PyValueError::new_err(format!("{key:?} is not one of {}", keys.join(", ")))
    })
}

/// The result of a test of a property: whether it holds, its value, and the witness of its failure.
type Tested = (bool, Option<String>, Option<String>);

fn tested<S: Coefficient, T>(
    property: Property<S, T>,
    value: impl FnOnce(T) -> Option<String>,
) -> Tested {
    match property {
        Property::Holds(held) => (true, value(held), None),
        Property::Fails(witness) => (false, None, Some(witness.to_string())),
    }
}

/// The source, the tensors that determine the connection, and the frame of a geometry.
type Parts<'py> = (Bound<'py, PySource>, Vec<(String, Py<PyTensor>)>, Object<'py>);

/// Defines the quantities as properties: each row has the key and the form of the value.
macro_rules! quantities {
    ($($(#[doc = $doc:literal])* $key:ident: $form:ident;)*) => {
        #[pymethods]
        impl PyGeometry {
            $(
                $(#[doc = $doc])*
                #[getter]
                fn $key<'py>(&self, py: Python<'py>) -> New<'py> {
                    let quantity = quantity(stringify!($key))?;
                    $form(py, self.values.tensor(py, quantity, &self.symbols)?)
                }
            )*
        }
    };
}

fn tensor(py: Python<'_>, found: PyTensor) -> PyResult<Bound<'_, PyAny>> {
    Ok(Bound::new(py, found)?.into_any())
}

fn number_of(py: Python<'_>, found: PyTensor) -> PyResult<Bound<'_, PyAny>> {
    found.value(py, &[])
}

quantities! {
    /// Structure constants ``c^i_jk``: ``[e_j, e_k] = c^i_jk e_i``.
    structure: tensor;
    /// Affinities ``Lambda^i_jk``: ``nabla_{e_j} e_k = Lambda^i_jk e_i``. The direction is the first lower index.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").affinities[2, 0, 1]
    /// Fraction(1, 2)
    affinities: tensor;
    /// Torsion ``tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk``.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@plus").torsion[2, 0, 1]
    /// Fraction(1, 1)
    torsion: tensor;
    /// Curvature ``R^i_jkl``: ``R(e_k, e_l) e_j = R^i_jkl e_i``.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").curvature[0, 1, 0, 1]
    /// Fraction(1, 4)
    curvature: tensor;
    /// Ricci tensor ``Ric_jl = R^i_jil``.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").ricci[0, 0]
    /// Fraction(1, 2)
    ricci: tensor;
    /// Scalar curvature ``S = g^jl Ric_jl``, a number. It needs a metric.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric=[1, 1, 2]).scalar_curvature
    /// Fraction(1, 1)
    scalar_curvature: number_of;
    /// Metric ``g_ij``. For a geometry without a metric, the property raises MathematicsError, and
    /// ``quantity("metric")`` is None.
    metric: tensor;
    /// Inverse metric ``g^ij``.
    inverse_metric: tensor;
    /// Nonmetricity ``Q_kij = (nabla_k g)_ij``.
    nonmetricity: tensor;
    /// Killing form ``K_ij = c^m_il c^l_jm`` of the algebra.
    killing: tensor;
    /// Covariant derivative of the torsion ``(nabla_m tau)^i_jk``, slots ``^i_mjk``.
    nabla_torsion: tensor;
    /// Covariant derivative of the curvature ``(nabla_m R)^i_jkl``, slots ``^i_mjkl``.
    nabla_curvature: tensor;
    /// Symmetric part of the Ricci tensor, ``(Ric_jl + Ric_lj)/2``.
    ricci_symmetric: tensor;
    /// Antisymmetric part of the Ricci tensor, ``(Ric_jl - Ric_lj)/2``.
    ricci_antisymmetric: tensor;
    /// Trace-free part of the Ricci tensor, ``Ric_jl - S/n g_jl``.
    ricci_trace_free: tensor;
    /// Einstein tensor ``G_jl = Ric_jl - 1/2 S g_jl``.
    einstein: tensor;
    /// Schouten tensor ``P_jl = (Ric_jl - S/(2 (n - 1)) g_jl)/(n - 2)`` of a Levi-Civita connection.
    schouten: tensor;
    /// Weyl tensor ``W^i_jkl`` of a Levi-Civita connection, the trace-free part of the curvature.
    weyl: tensor;
    /// Cotton tensor ``C_jkl = (nabla_k P)_jl - (nabla_l P)_jk`` of a Levi-Civita connection.
    cotton: tensor;
    /// Kretschmann scalar ``R_ijkl R^ijkl``, a number.
    kretschmann: number_of;
}

immutable! { PyGeometry }

properties! { PyGeometry, own:
    /// Name of the geometry.
    name: String = each!(&own.values, geometry => geometry.name().into());
    /// Names of the frame vectors.
    basis: Vec<String> = own.values.labels();
    /// Dimension of the space.
    dimension: usize = own.values.labels().len();
    /// Kind of the scalars: ``exact``, ``symbolic`` or ``float``.
    scalar: &'static str = own.values.scalar();
    /// Name of the connection: ``plus``, ``zero``, ``minus``, ``lambda``, ``levi-civita`` or ``affinities``; on a
    /// homogeneous space also ``canonical`` or ``natural``.
    connection: String = each!(&own.values, geometry => geometry.connection_name().into());
    /// Kind of the frame: ``left-invariant``, ``right-invariant``, ``coordinate``, ``moving`` or ``reductive``.
    frame: &'static str = each!(&own.values, geometry => geometry.frame_name());
}

constructors! { PyGeometry:
    /// Geometry on a coordinate chart, in the coordinate frame or in a frame of given vector fields.
    ///
    /// Parameters
    /// ----------
    /// coordinates : str or list
    ///     Names of the coordinates, or SymPy symbols.
    /// metric : str, array or list, optional
    ///     Metric as in :class:`Geometry`. Its entries are formulas in the coordinates and parameters.
    /// fields : dict, optional
    ///     Fields of the frame by name: strings such as ``"1/sin(theta)*d_phi"``, or components in the coordinate
    ///     frame.
    /// connection : str or number, optional
    ///     Connection as in :class:`Geometry`.
    /// affinities : str or list of str, optional
    ///     Affinities such as ``"nabla[d_x, d_y] = x*d_y"``, instead of a connection.
    /// parameters : list
    ///     Names or SymPy symbols of parameters that occur neither in the metric nor in the fields.
    /// functions : list
    ///     Undetermined functions, such as ``"a(t)"``. SymPy functions in the metric and the fields are found without
    ///     being listed.
    /// positive : list
    ///     Functions that are positive on the chart, which defines roots and logarithms.
    /// name : str
    ///     Name of the geometry.
    ///
    /// Returns
    /// -------
    /// Geometry
    ///
    /// Examples
    /// --------
    /// >>> Geometry.on_chart("theta phi", [1, "sin(theta)^2"]).scalar_curvature
    /// 2
    on_chart("($cls, coordinates, metric=None, *, fields=None, connection=None, affinities=None, parameters=(), functions=(), positive=(), name='chart')")
        = "geometry"."chart";
}

#[pymethods]
impl PyGeometry {
    #[new]
    #[pyo3(
        signature = (*arguments, **keys),
        text_signature = "(space, connection=None, metric=None, *, basis=None, affinities=None, torsion=None, nonmetricity=None, frame='left', scalar='exact', tolerance=None)"
    )]
    fn __new__<'py>(
        arguments: Bound<'py, PyTuple>,
        keys: Option<Bound<'py, PyDict>>,
    ) -> PyResult<Self> {
        let py = arguments.py();
        let parts = python(py, "geometry", "parts")?.call(arguments, keys.as_ref())?;
        let (source, extra, frame): Parts<'py> = parts.extract()?;
        let right = match frame.extract::<String>().as_deref() {
            Ok("left") => false,
            Ok("right") => true,
            _ => {
                let reason = format!("the frame is left or right, not {}", frame.repr()?);
                return Err(PyValueError::new_err(reason));
            }
        };
        let given = extra.iter().map(|(_, tensor)| &tensor.get().symbols);
        let symbols = merged(py, [&source.get().symbols].into_iter().chain(given))?.unbind();
        let space = source.get().space(py)?;
        let mut values = source.get().geometry(py, &space, PyTensor::given(&extra)?)?;
        if right {
            values = run(py, || {
                Ok(each!(&values, geometry => Grounded::geometry(geometry.in_right_frame()?)))
            })?;
        }
        let (source, frame, recorder) = (source.unbind(), frame.extract()?, OnceLock::new());
        Ok(PyGeometry { source, extra, frame, symbols, values, recorder })
    }

    /// Factor lambda of a connection ``Lambda = lambda c``. It is None for other connections.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").lambda_
    /// Fraction(1, 2)
    #[getter]
    fn lambda_<'py>(&self, py: Python<'py>) -> PyResult<Optional<'py>> {
        let factor = each!(&self.values, geometry => {
            geometry.kind().lambda().map(|lambda| lambda.to_string())
        });
        factor.map(|text| self.number(py, &text)).transpose()
    }

    /// SymPy symbols in the definition, by name.
    #[getter]
    fn symbols<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.symbols.bind(py).copy()
    }

    #[getter]
    fn _source(&self, py: Python<'_>) -> Py<PySource> {
        self.source.clone_ref(py)
    }

    /// The tensors that determine the connection, and the frame.
    #[getter]
    fn _extra<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyDict>, &str)> {
        let extra = PyDict::new(py);
        self.extra.iter().try_for_each(|(key, tensor)| extra.set_item(key, tensor))?;
        Ok((extra, &self.frame))
    }

    /// Values of the quantities at points, in floats.
    ///
    /// Each formula is simplified and compiled once, and then evaluated at all points on all cores.
    ///
    /// Parameters
    /// ----------
    /// points : array of the shape (..., n), or dict of arrays
    ///     Coordinates of the points, in the order of the chart. A dict has values of coordinates, parameters and
    ///     functions, by name or symbol. Values on which a quantity does not depend may be left out.
    /// **values : arrays
    ///     Values of parameters and coordinates by name, broadcast with the batch of points.
    ///
    /// Returns
    /// -------
    /// PointValues
    ///     Every quantity as an array whose first axes are the axes of the batch. NaN and infinity, in points and in
    ///     results, are errors. The error names the index and the coordinates of the point.
    ///
    /// Examples
    /// --------
    /// >>> sphere = Geometry.on_chart("theta phi", ["r^2", "r^2*sin(theta)^2"])
    /// >>> sphere.at([[1, 0], [2, 0], [3, 0]], r=2).scalar_curvature
    /// array([0.5, 0.5, 0.5])
    /// >>> sphere.at({"theta": 1}, r=[1, 2]).metric.shape
    /// (2, 2, 2)
    #[pyo3(signature = (points=None, /, **values))]
    fn at<'py>(
        slf: &Bound<'py, Self>,
        points: Optional<'py>,
        values: Option<Bound<'py, PyDict>>,
    ) -> New<'py> {
        python(slf.py(), "_points", "at")?.call1((slf, points, values))
    }

    /// The family of the quantities, for values with these names.
    fn _at(&self, py: Python<'_>, names: Vec<String>) -> PyResult<PyFamily> {
        let space = self.source.get().space(py)?;
        if matches!(self.values, Geometries::Float(_)) {
            return Err(refused(py, in_floats("the geometry at points")));
        }
        let recorder = match self.recorder.get() {
            Some(recorder) => recorder.clone(),
            None => {
                let (given, values) = (PyTensor::given(&self.extra)?, self.values.clone());
                let right = self.frame == "right";
                let recorder = run(py, || {
                    let geometry = given.geometry(&space.definition, Tolerance::default())?;
                    let geometry = if right { geometry.in_right_frame()? } else { geometry };
                    Ok(Recorder::new(geometry, Some(values)))
                })?;
                self.recorder.get_or_init(|| recorder.into()).clone()
            }
        };
        let others = self.extra.iter().flat_map(|(_, tensor)| parameters(&tensor.get().values));
        let others: Vec<String> = others.collect();
        PyFamily::at_points(py, recorder, &space, &others, &names)
    }

    /// Lie algebra to which the frame belongs.
    #[getter]
    fn algebra<'py>(&self, py: Python<'py>) -> New<'py> {
        py.get_type::<PyAlgebra>().call1((self.source.get().of_algebra(py)?,))
    }

    /// Quantity by its name in tables.
    ///
    /// Parameters
    /// ----------
    /// key : str
    ///     Name such as ``"ricci"``, ``"weyl"`` or ``"nabla_torsion"``: any property that is a tensor or a number.
    ///
    /// Returns
    /// -------
    /// Tensor or None
    ///     The quantity. It is None if the quantity needs a metric or another connection. Numbers are tensors of rank
    ///     0.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     The name is unknown.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric=[1, 1, 1]).quantity("scalar_curvature")[()]
    /// Fraction(3, 2)
    #[pyo3(name = "quantity")]
    fn of_key(&self, py: Python<'_>, key: &str) -> PyResult<Option<PyTensor>> {
        self.values.quantity(py, quantity(key)?, &self.symbols)
    }

    /// Tests whether a property holds. The result has the constant of the property, or a witness of its failure.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     ``"einstein"``, ``"constant_curvature"``, ``"bi_invariant"``, ``"locally_symmetric"``, ``"parallel_torsion"`` or
    ///     ``"parallel_curvature"``.
    ///
    /// Returns
    /// -------
    /// Property
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric=[1, 1, 1]).check_property("einstein")
    /// Property(holds=True, value=Fraction(1, 2), witness=None)
    fn check_property<'py>(&self, py: Python<'py>, name: &str) -> New<'py> {
        fn test<S: Coefficient>(geometry: &Geometry<S>, name: &str) -> Result<Tested, InputError> {
            let connection = geometry.connection();
            let metric = || geometry.metric().ok_or(Error::NoMetric);
            Ok(match name {
                "parallel_torsion" => tested(connection.parallel_torsion(), |()| None),
                "parallel_curvature" => tested(connection.parallel_curvature(), |()| None),
                "locally_symmetric" => tested(connection.locally_symmetric(), |()| None),
                "constant_curvature" => {
                    tested(connection.constant_curvature(metric()?)?, |constant| {
                        Some(constant.to_string())
                    })
                }
                "bi_invariant" => {
                    let algebra = geometry.frame_origin().algebra_for("bi-invariance")?;
                    tested(metric()?.bi_invariant(algebra)?, |()| None)
                }
                "einstein" => tested(connection.einstein_constant(metric()?)?, |constant| {
                    Some(constant.to_string())
                }),
                other => return Err(InputError::usage(format!("unknown property {other}"))),
            })
        }
        let (holds, value, witness) =
            run(py, || each!(&self.values, geometry => test(geometry, name)))?;
        let value = value.map(|text| self.number(py, &text)).transpose()?;
        python(py, "geometry", "Property")?.call1((holds, value, witness))
    }

    /// Basis of the holonomy algebra, as matrices.
    ///
    /// Returns
    /// -------
    /// list of Tensor
    ///     Matrices ``A^i_j``; the upper index is the row.
    ///
    /// Examples
    /// --------
    /// >>> len(Geometry("so3@zero").holonomy())
    /// 3
    fn holonomy(&self, py: Python<'_>) -> PyResult<Vec<PyTensor>> {
        fn basis<S: Held>(
            geometry: &Geometry<S>,
        ) -> Result<Vec<crate::components::Values>, InputError> {
            let holonomy = geometry.connection().holonomy()?;
            Ok(holonomy.basis()?.into_iter().map(Held::wrap).collect())
        }
        let basis = run(py, || each!(&self.values, geometry => basis(geometry)))?;
        let symbols = self.symbols.bind(py);
        basis.into_iter().map(|matrix| PyTensor::new(py, matrix, symbols, Names::of("A"))).collect()
    }

    /// Certificate of the geometry: antisymmetry, the Jacobi identity, the metric and the Bianchi identities.
    ///
    /// Returns
    /// -------
    /// list of Check
    ///
    /// Examples
    /// --------
    /// >>> [check.name for check in Geometry("so3@zero").check()]
    /// ['antisymmetry', 'jacobi', 'bianchi_first', 'bianchi_second']
    fn check<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<Object<'py>>> {
        let (py, geometry) = (slf.py(), slf.get());
        if geometry.extra.is_empty() {
            return geometry.source.get().checks(py);
        }
        let source = python(py, "geometry", "written")?.call1((slf,))?;
        source.cast_into::<PySource>()?.get().checks(py)
    }

    /// Geometries are equal if they have equal structure constants, affinities and metrics.
    fn __eq__(&self, py: Python<'_>, other: &PyGeometry) -> PyResult<bool> {
        for key in [Quantity::Structure, Quantity::Affinities, Quantity::Metric] {
            let [a, b] = [self, other].map(|one| one.values.quantity(py, key, &one.symbols));
            match (a?, b?) {
                (None, None) => {}
                (Some(a), Some(b)) if a.equals(&b) => {}
                _ => return Ok(false),
            }
        }
        Ok(true)
    }

    fn __hash__<'py>(&self, py: Python<'py>) -> PyResult<isize> {
        (self.structure(py)?, self.affinities(py)?).into_pyobject(py)?.hash()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, geometry) = (slf.py(), slf.get());
        let (extra, frame) = geometry._extra(py)?;
        let arguments = (slf.get_type(), geometry.source.clone_ref(py), extra, frame.into());
        Ok((python(py, "geometry", "restored")?, arguments))
    }

    /// The metric and the affinities in LaTeX.
    fn _repr_latex_<'py>(slf: &Bound<'py, Self>) -> New<'py> {
        python(slf.py(), "geometry", "latex")?.call1((slf,))
    }

    fn __repr__(&self) -> String {
        let (name, connection, scalar) = (self.name(), self.connection(), self.scalar());
        let dimension = self.dimension();
        format!("<Geometry {name}, connection {connection}, dimension {dimension}, {scalar}>")
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        self.table(py, None, "text", false)
    }

    fn _repr_markdown_(&self, py: Python<'_>) -> PyResult<String> {
        self.table(py, None, "markdown", false)
    }
}

/// The Python function that restores a pickled geometry, and its arguments.
type Reduced<'py> = (Object<'py>, (Bound<'py, PyType>, Py<PySource>, Bound<'py, PyDict>, String));

in_python! { PyGeometry, "geometry":
    /// The geometry with parameters replaced by values.
    ///
    /// Parameters
    /// ----------
    /// values : dict
    ///     Numbers or expressions. The keys are names or symbols of parameters or undetermined functions.
    ///
    /// Returns
    /// -------
    /// Geometry
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric="diag(a,a,b)").subs({"a": 1, "b": 2}).scalar_curvature
    /// Fraction(1, 1)
    subs (values) [values];
}

impl PyGeometry {
    /// Whether the arguments alone define the geometry: no tensors, and the left-invariant frame.
    pub fn has_named_connection(&self) -> bool {
        self.extra.is_empty() && self.frame == "left"
    }

    /// Converts a number of the geometry from its text.
    fn number<'py>(&self, py: Python<'py>, text: &str) -> New<'py> {
        number(text, self.symbols.bind(py), self.scalar() == "float")
    }
}
