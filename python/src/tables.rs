//! Reports of geometries: properties, equations, tables and comparisons.

use crate::class::{New, Optional};
use crate::errors::refused;
use crate::geometries::{Geometries, each, in_floats};
use crate::geometry::{PyGeometry, quantity};
use crate::report::{all_formats, format, written};
use crate::run::run;
use crate::values::python;
use affinor::Geometry;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::report::{
    ComparedSide, Comparison, EquationReport, Properties, Quantity, Report, Table,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

#[pymethods]
impl PyGeometry {
    /// All properties as ``affinor properties`` finds them: flat, Einstein, naturally reductive, Ricci soliton, ...
    ///
    /// The dict is the JSON document ``affinor.properties/1``; ``print`` shows the table.
    fn properties<'py>(&self, py: Python<'py>) -> New<'py> {
        let written = run(py, || match &self.values {
            Geometries::Exact(geometry) => all_formats(&Properties::of_geometry(geometry)?),
            Geometries::Symbolic(geometry) => all_formats(&Properties::of_geometry(geometry)?),
            Geometries::Float(_) => Err(in_floats("the list of properties")),
        })?;
        python(py, "structure", "Report")?.call1((written,))
    }

    /// Equations of motion: ``euler-poincare``, ``autoparallel`` or ``transport``.
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

    /// The table as the command line prints it, in ``text``, ``markdown``, ``latex``, ``csv`` or ``json``.
    ///
    /// ``show`` names quantities, or is ``all`` or ``derived``.
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

/// The names in a text or in a list.
fn names(show: Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    if let Ok(text) = show.extract::<String>() {
        return Ok(text.replace(',', " ").split_whitespace().map(String::from).collect());
    }
    let found = show.get_type().name()?;
    let reason = format!("show is a text or a list of names of quantities, not {found}");
    let items = show.try_iter().map_err(|_| PyTypeError::new_err(reason))?;
    items.map(|item| item?.extract()).collect()
}

/// Two geometries side by side, with the claims of the paper about them; by default the paper's table.
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

/// The conventions of signs and indices.
#[pyfunction]
#[pyo3(signature = (format="text"))]
pub fn conventions(py: Python<'_>, format: &str) -> PyResult<String> {
    let format = self::format(format)?;
    let report = affinor_documents::report::conventions();
    written(&report, format).map_err(|error| refused(py, error))
}
