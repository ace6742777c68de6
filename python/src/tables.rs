//! Reports of geometries: properties, equations, tables and comparisons.

use crate::class::{New, Optional, in_python};
use crate::errors::refused;
use crate::geometries::{Geometries, each, in_floats};
use crate::geometry::{PyGeometry, quantity};
use crate::report::{all_formats, format, written};
use crate::run::run;
use crate::values::python;
use affinor::Geometry;
use affinor::geometry::conditions::Condition;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::geometry::isometry::Symmetry;
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::problem::{Connecting, geodesics};
use affinor_documents::report::{
    ComparedSide, Comparison, EquationReport, Geodesics, Isometries, Properties, Quantity, Report,
    Solutions, Table,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

#[pymethods]
impl PyGeometry {
    #[pyo3(signature = (start, end, starts=None))]
    fn _geodesics<'py>(
        &self,
        py: Python<'py>,
        start: &str,
        end: &str,
        starts: Option<usize>,
    ) -> New<'py> {
        if starts == Some(0) {
            return Err(PyValueError::new_err("starts is 0: give a positive number"));
        }
        let space = self.source.get().space(py)?;
        let is_plain = self.has_named_connection();
        let written = run(py, || {
            if !is_plain {
                let message =
                    "geodesics need a connection with a name, in the left-invariant frame";
                return Err(InputError::usage(message));
            }
            let found = geodesics(&space, start, end, starts)?;
            let Connecting { space, connection, names, points, measure, geodesics } = &found;
            all_formats(&Geodesics::new(space, connection, names, points, measure, geodesics))
        })?;
        python(py, "structure", "Report")?.call1((written,))
    }

    /// Report of all properties: flat, Einstein, naturally reductive, Ricci soliton and more, with constants or witnesses.
    ///
    /// The report is the JSON document ``affinor.properties/1`` as a dict; ``print`` shows the table of ``affinor properties``.
    ///
    /// Returns
    /// -------
    /// Report
    ///
    /// Raises
    /// ------
    /// InputError
    ///     The components are floats.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3", metric=[1, 1, 1]).properties()["schema"]
    /// 'affinor.properties/1'
    fn properties<'py>(&self, py: Python<'py>) -> New<'py> {
        let written = run(py, || match &self.values {
            Geometries::Exact(geometry) => all_formats(&Properties::of_rational(geometry)?),
            Geometries::Symbolic(geometry) => all_formats(&Properties::of_symbolic(geometry)?),
            Geometries::Float(_) => Err(in_floats("the list of properties")),
        })?;
        python(py, "structure", "Report")?.call1((written,))
    }

    /// All real values of the letters for which a condition holds.
    ///
    /// The report is the JSON document ``affinor.solve/1`` as a dict; ``print`` shows the table of ``affinor solve``.
    ///
    /// Parameters
    /// ----------
    /// condition : str
    ///     ``"einstein"``, ``"ricci-flat"``, ``"flat"``, ``"locally-symmetric"``, ``"ricci-soliton"`` or another condition that
    ///     ``affinor solve --help`` lists.
    ///
    /// Returns
    /// -------
    /// Report
    ///
    /// Raises
    /// ------
    /// InputError
    ///     The condition is unknown, or the geometry has no letters.
    ///
    /// Examples
    /// --------
    /// >>> flags = Geometry("Fl(3)", metric="invariant").solve("einstein")
    /// >>> len(flags["points"]), flags["complete"]
    /// (4, True)
    fn solve<'py>(&self, py: Python<'py>, condition: &str) -> New<'py> {
        let written = run(py, || {
            let condition = Condition::from_name(condition).ok_or_else(|| {
                let names = Condition::ALL.map(Condition::name).join(", ");
                InputError::usage(format!("the conditions are {names}, not {condition:?}"))
            })?;
            match &self.values {
                Geometries::Symbolic(geometry) => {
                    all_formats(&Solutions::of_geometry(geometry, condition)?)
                }
                Geometries::Float(_) => Err(in_floats("solving for letters")),
                Geometries::Exact(_) => {
                    let error = InputError::usage("the geometry has no letters to solve for");
                    Err(error.help("give the metric with letters, as in metric='diag(a,b,c)'"))
                }
            }
        })?;
        python(py, "structure", "Report")?.call1((written,))
    }

    /// Lie algebra of the Killing fields of the metric.
    ///
    /// The report is the JSON document ``affinor.isometries/1`` as a dict; ``print`` shows the table of ``affinor isometries``.
    ///
    /// Parameters
    /// ----------
    /// symmetry : str
    ///     ``"killing"``, ``"homothetic"`` or ``"conformal"``.
    ///
    /// Returns
    /// -------
    /// Report
    ///
    /// Raises
    /// ------
    /// InputError
    ///     There is no metric, or its components are floats.
    ///
    /// Examples
    /// --------
    /// >>> report = Geometry("schwarzschild").isometries()
    /// >>> report["dimension"], report["algebra"]["name"]
    /// (4, 'so(3) + R^1')
    #[pyo3(signature = (symmetry="killing"))]
    fn isometries<'py>(&self, py: Python<'py>, symmetry: &str) -> New<'py> {
        let written = run(py, || {
            let symmetry = Symmetry::from_name(symmetry).ok_or_else(|| {
                let names = Symmetry::ALL.map(Symmetry::name).join(", ");
                InputError::usage(format!("the symmetries are {names}, not {symmetry:?}"))
            })?;
            match &self.values {
                Geometries::Exact(geometry) => {
                    all_formats(&Isometries::of_rational(geometry, symmetry)?)
                }
                Geometries::Symbolic(geometry) => {
                    all_formats(&Isometries::of_symbolic(geometry, symmetry)?)
                }
                Geometries::Float(_) => Err(in_floats("the isometry algebra")),
            }
        })?;
        python(py, "structure", "Report")?.call1((written,))
    }

    /// Equations of motion as text.
    ///
    /// Parameters
    /// ----------
    /// kind : str
    ///     ``"euler-poincare"``, ``"autoparallel"`` or ``"transport"``.
    /// format : str
    ///     ``"text"``, ``"markdown"``, ``"latex"``, ``"csv"``, ``"json"`` or ``"html"``.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Examples
    /// --------
    /// >>> print(Geometry("so3", metric=[1, 1, 2]).equations().splitlines()[-3].strip())
    /// dOmega1/dt = -Omega2*Omega3 + M1
    #[pyo3(signature = (kind="euler-poincare", format="text"))]
    fn equations(&self, py: Python<'_>, kind: &str, format: &str) -> PyResult<String> {
        fn report<S: Coefficient>(
            geometry: &Geometry<S>,
            kind: &str,
        ) -> Result<Box<dyn Report>, InputError> {
            let kind = EquationKind::from_name(kind).ok_or_else(|| {
                let names = EquationKind::ALL.map(EquationKind::name).join(", ");
                InputError::usage(format!("the equations are {names}, not {kind:?}"))
            })?;
            let equations = Equations::new(kind, geometry.connection(), geometry.metric())?;
            Ok(Box::new(EquationReport::new(equations, geometry)))
        }
        let format = self::format(format)?;
        run(py, || {
            let report = each!(&self.values, geometry => report(geometry, kind)?);
            written(&*report, format)
        })
    }

    /// Table of tensors, as ``affinor table`` prints it.
    ///
    /// Parameters
    /// ----------
    /// show : str or list of str, optional
    ///     Names of quantities, ``"all"`` or ``"derived"``; by default the basic tensors.
    /// format : str
    ///     ``"text"``, ``"markdown"``, ``"latex"``, ``"csv"``, ``"json"`` or ``"html"``.
    /// independent : bool
    ///     Whether to list only one of the components that are equal by symmetry.
    ///
    /// Returns
    /// -------
    /// str
    ///     The table, with indices from 1.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").table("ricci", "csv").splitlines()[:2]
    /// ['tensor,i,j,k,l,value', 'ricci,1,1,,,1/2']
    #[pyo3(signature = (show=None, format="text", *, independent=false))]
    pub fn table<'py>(
        &self,
        py: Python<'py>,
        show: Optional<'py>,
        format: &str,
        independent: bool,
    ) -> PyResult<String> {
        let (first, derived) = Quantity::ALL.split_at(10);
        let hidden = [Quantity::InverseMetric, Quantity::Killing];
        let mut keys = Vec::new();
        match show.map(names).transpose()? {
            None => keys.extend(first.iter().filter(|key| !hidden.contains(key))),
            Some(names) => {
                for name in names {
                    match name.as_str() {
                        "all" => keys.extend_from_slice(first),
                        "derived" => keys.extend_from_slice(derived),
                        name => keys.push(quantity(name)?),
                    }
                }
            }
        }
        let mut unique = Vec::new();
        keys.into_iter().for_each(|key| {
            if !unique.contains(&key) {
                unique.push(key);
            }
        });
        let format = self::format(format)?;
        run(py, || {
            each!(&self.values, geometry => {
                let mut table = Table::new(geometry, &unique)?;
                table.independent = independent;
                table.finite()?;
                written(&table, format)
            })
        })
    }
}

/// The names in a string or in a list of strings.
fn names(show: Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    if let Ok(text) = show.extract::<String>() {
        return Ok(text.replace(',', " ").split_whitespace().map(String::from).collect());
    }
    let found = show.get_type().name()?;
    let reason = format!("show is a text or a list of names of quantities, not {found}");
    let items = show.try_iter().map_err(|_| PyTypeError::new_err(reason))?;
    items.map(|item| item?.extract()).collect()
}

/// Two geometries side by side, with the claims of Paraskevopoulos and Natsiavas (2013) about them.
///
/// Parameters
/// ----------
/// first, second : Geometry, LieAlgebra or str
///     Geometries, or spaces as for :class:`Geometry`; by default M(3) and SO(3) of Paraskevopoulos and Natsiavas
///     (2013).
/// format : str
///     ``"text"``, ``"markdown"``, ``"latex"``, ``"csv"``, ``"json"`` or ``"html"``.
///
/// Returns
/// -------
/// str
///
/// Examples
/// --------
/// >>> compare("so3@plus", "so3@zero").splitlines()[0]
/// 'so(3)@plus and so(3)@zero'
#[pyfunction]
#[pyo3(
    signature = (first=None, second=None, *, format="text"),
    text_signature = "(first='M(3)', second='SO(3)', *, format='text')"
)]
pub fn compare<'py>(
    py: Python<'py>,
    first: Optional<'py>,
    second: Optional<'py>,
    format: &str,
) -> PyResult<String> {
    let side = |given: Optional<'py>, name: &str| {
        let given = given.map_or_else(|| Ok(name.into_pyobject(py)?.into_any()), PyResult::Ok)?;
        let geometry = match given.cast_into::<PyGeometry>() {
            Ok(geometry) => geometry,
            Err(other) => py.get_type::<PyGeometry>().call1((other.into_inner(),))?.cast_into()?,
        };
        PyResult::Ok(geometry)
    };
    let sides = [side(first, "M(3)")?, side(second, "SO(3)")?];
    let sides = [&sides[0], &sides[1]].map(|side| &side.get().values);
    let format = self::format(format)?;
    run(py, || {
        let [a, b] = sides.map(|values| each!(values, geometry => ComparedSide::new(geometry)));
        written(&Comparison::new(a?, b?), format)
    })
}

/// Conventions of signs and indices, as a table.
///
/// Parameters
/// ----------
/// format : str
///     ``"text"``, ``"markdown"``, ``"latex"``, ``"csv"``, ``"json"`` or ``"html"``.
///
/// Returns
/// -------
/// str
///
/// Examples
/// --------
/// >>> "[e_j, e_k] = c^i_jk e_i" in conventions()
/// True
#[pyfunction]
#[pyo3(signature = (format="text"))]
pub fn conventions(py: Python<'_>, format: &str) -> PyResult<String> {
    let format = self::format(format)?;
    let report = affinor_documents::report::conventions();
    written(&report, format).map_err(|error| refused(py, error))
}

in_python! { PyGeometry, "geometry":
    /// Geodesics (autoparallel curves) between two points of a chart, a group or a homogeneous space.
    ///
    /// The report is the JSON document ``affinor.geodesic/1`` as a dict; ``print`` shows the table of ``affinor geodesic``.
    /// Each entry of ``"geodesics"`` has the ``"length"``, the initial ``"velocity"`` for a parameter from 0 to 1, and the
    /// ``"residual"`` at the end. ``"conjugate"`` tells whether the points are conjugate along the curve.
    ///
    /// Parameters
    /// ----------
    /// start, end : sequence of float, dict or str
    ///     Points: coordinates of a chart, or coordinates ``x`` of ``exp(x)`` on a group. On a homogeneous space, ``x`` is in
    ///     the complement. Elements may also be matrices. A dict has names of components.
    /// starts : int, optional
    ///     Number of initial velocities of the search. By default, the search ends at the first geodesic.
    ///
    /// Returns
    /// -------
    /// Report
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     No geodesic was found, or the end is not in the chart.
    /// InputError
    ///     A point is invalid, or a parameter has no value.
    ///
    /// Examples
    /// --------
    /// >>> found = Geometry("S^2", metric="identity").geodesics([0, 0], {"m1": 0.3, "m2": 0.4})
    /// >>> round(found["geodesics"][0]["length"], 9)
    /// 0.5
    geodesics (start, end, *, starts=None) [start, end, starts];
}
