//! Geometries: a frame with a connection and perhaps a metric, over the three scalars.

use crate::algebra::PyAlgebra;
use crate::class::{New, Object, Optional, constructors, immutable, in_python, properties};
use crate::components::Held;
use crate::geometries::{Geometries, Grounded, each};
use crate::run::run;
use crate::source::PySource;
use crate::tensor::{Names, PyTensor};
use crate::values::{merged, number, python};
use affinor::geometry::properties::Property;
use affinor::{Error, Geometry};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::report::Quantity;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};

/// A frame with a connection and perhaps a metric; every quantity of ``affinor table`` is a property.
///
/// Parameters
/// ----------
/// space
///     A LieAlgebra or anything that makes one, a geometry of the paper (``"M3"``, ``"SO3"``), a name with a connection
///     (``"so3@plus"``), or a definition with a chart.
/// connection : str or number, optional
///     ``plus``, ``zero``, ``minus``, ``levi-civita``, ``lambda=1/3`` or a number lambda. Without one it is levi-civita if
///     there is a metric, else zero.
/// metric : str, array or list, optional
///     ``identity``, ``killing``, ``diag(...)``, a matrix, or the entries of a diagonal; unknown names are parameters.
/// affinities, torsion, nonmetricity : array or Tensor, optional
///     Instead of a connection: affinities (slots ``^__``, direction first), or torsion and nonmetricity (slots ``^__`` and
///     ``___``, with a metric).
/// frame : str
///     ``"right"`` gives the components in the right-invariant frame.
/// basis, scalar, tolerance
///     As for a :class:`LieAlgebra`.
///
/// Examples
/// --------
/// >>> Geometry("so3", metric=[1, 1, 1]).scalar_curvature
/// Fraction(3, 2)
/// >>> print(Geometry("so3", metric="diag(a,a,b)").ricci[2, 2])
/// b**2/(2*a**2)
#[pyclass(name = "Geometry", frozen, subclass, module = "affinor")]
pub struct PyGeometry {
    pub source: Py<PySource>,
    /// Affinities, or torsion and nonmetricity, by name.
    extra: Vec<(String, Py<PyTensor>)>,
    frame: String,
    pub symbols: Py<PyDict>,
    pub values: Geometries,
}

/// The quantity of a name.
pub fn quantity(key: &str) -> PyResult<Quantity> {
    Quantity::from_key(key).ok_or_else(|| {
        let keys: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::key).collect();
        PyValueError::new_err(format!("{key:?} is not one of {}", keys.join(", ")))
    })
}

/// A property that holds, with its value, or the witness of its failure.
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

/// The quantities as properties: a row has the key and the form of the value.
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
    /// Affinities ``Lambda^i_jk``: ``nabla_{e_j} e_k = Lambda^i_jk e_i``, the direction first.
    affinities: tensor;
    /// Torsion ``tau^i_jk``.
    torsion: tensor;
    /// Curvature ``R^i_jkl``: ``R(e_k, e_l) e_j = R^i_jkl e_i``.
    curvature: tensor;
    /// Ricci tensor ``Ric_jl``.
    ricci: tensor;
    /// Scalar curvature ``S``.
    scalar_curvature: number_of;
    /// Metric ``g_ij``.
    metric: tensor;
    /// Inverse metric ``g^ij``.
    inverse_metric: tensor;
    /// Nonmetricity ``Q_kij = (nabla_k g)_ij``.
    nonmetricity: tensor;
    /// Killing form ``K_ij`` of the algebra.
    killing: tensor;
    /// Derivative of the torsion ``(nabla_m tau)^i_jk``, slots ``^i_mjk``.
    nabla_torsion: tensor;
    /// Derivative of the curvature ``(nabla_m R)^i_jkl``, slots ``^i_mjkl``.
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
    /// Kretschmann scalar ``R_ijkl R^ijkl``.
    kretschmann: number_of;
}

immutable! { PyGeometry }

properties! { PyGeometry, own:
    /// The name.
    name: String = each!(&own.values, geometry => geometry.name().into());
    /// The names of the frame vectors.
    basis: Vec<String> = own.values.labels();
    /// The dimension.
    dimension: usize = own.values.labels().len();
    /// ``exact``, ``symbolic`` or ``float``.
    scalar: &'static str = own.values.scalar();
    /// The connection: ``plus``, ``zero``, ``minus``, ``lambda``, ``levi-civita`` or ``affinities``.
    connection: String = each!(&own.values, geometry => geometry.kind().name().into());
    /// ``left-invariant``, ``right-invariant``, ``coordinate`` or ``moving``.
    frame: &'static str = each!(&own.values, geometry => geometry.frame_name());
}

constructors! { PyGeometry:
    /// A geometry over coordinates, with a metric in the frame of the coordinates or of ``fields``.
    ///
    /// Coordinates are symbols of SymPy or names; metric and fields may contain sin, cos, exp and others of them. A field is
    /// a text such as ``"1/sin(theta)*d_phi"``, or its components in the coordinate frame. ``functions`` are functions of
    /// coordinates that are not given, such as ``"a(t)"``; those of SymPy in the metric and the fields need no mention.
    /// ``positive`` are functions that are positive, for roots and logarithms.
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
        Ok(PyGeometry { source: source.unbind(), extra, frame: frame.extract()?, symbols, values })
    }

    /// The factor lambda of a connection ``Lambda = lambda c``; None for others.
    #[getter]
    fn lambda_<'py>(&self, py: Python<'py>) -> PyResult<Optional<'py>> {
        let factor = each!(&self.values, geometry => {
            geometry.kind().lambda().map(|lambda| lambda.to_string())
        });
        factor.map(|text| self.number(py, &text)).transpose()
    }

    /// The symbols of SymPy that were given, by name.
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

    /// The Lie algebra.
    #[getter]
    fn algebra<'py>(&self, py: Python<'py>) -> New<'py> {
        py.get_type::<PyAlgebra>().call1((self.source.get().of_algebra(py)?,))
    }

    /// A quantity by its name in tables; None where it does not apply.
    #[pyo3(name = "quantity")]
    fn of_key(&self, py: Python<'_>, key: &str) -> PyResult<Option<PyTensor>> {
        self.values.quantity(py, quantity(key)?, &self.symbols)
    }

    /// ``einstein``, ``constant_curvature``, ``bi_invariant``, ``locally_symmetric``, ``parallel_torsion`` or
    /// ``parallel_curvature``: whether it holds, with its constant or a witness.
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
                other => return Err(InputError::usage(format!("no property is called {other}"))),
            })
        }
        let (holds, value, witness) =
            run(py, || each!(&self.values, geometry => test(geometry, name)))?;
        let value = value.map(|text| self.number(py, &text)).transpose()?;
        python(py, "geometry", "Property")?.call1((holds, value, witness))
    }

    /// A basis of the holonomy algebra, matrices ``A^i_j``.
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

    /// The checks of the certificate, of the connection that was given.
    fn check<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<Object<'py>>> {
        let (py, geometry) = (slf.py(), slf.get());
        if geometry.extra.is_empty() {
            return geometry.source.get().checks(py);
        }
        let source = python(py, "geometry", "written")?.call1((slf,))?;
        source.cast_into::<PySource>()?.get().checks(py)
    }

    /// Equal structure constants, affinities and metrics.
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

    /// The metric and the affinities.
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

/// The function of Python that makes a pickled geometry, and its arguments.
type Reduced<'py> = (Object<'py>, (Bound<'py, PyType>, Py<PySource>, Bound<'py, PyDict>, String));

in_python! { PyGeometry, "geometry":
    /// The geometry with parameters replaced, by name or by symbol.
    subs (values) [values];
}

impl PyGeometry {
    /// A number of the geometry, from its text.
    fn number<'py>(&self, py: Python<'py>, text: &str) -> New<'py> {
        number(text, self.symbols.bind(py), self.scalar() == "float")
    }
}
