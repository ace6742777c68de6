//! Spaces as documents read them: names, definition files, brackets, with a connection and a metric.

use crate::errors::raise;
use crate::geometry::{Grounded, PyGeometry, Values as Geometries};
use crate::group::PyGroup;
use crate::report::written;
use crate::run::run;
use crate::tensor::{PyTensor, Values};
use affinor::{CanonicalConnection, Connection, ConnectionKind, Error, Geometry};
use affinor_documents::certificate::Check;
use affinor_documents::input::{Files, InputError};
use affinor_documents::report::{Computation, certificate};
use affinor_documents::space::{Definition, Request, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::{
    Down, Kind, Notation, Rational, Scalar, Symbolic, Tensor, Tolerance, TrackedFloat,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A space that is read, over no scalar yet, and the contents of its files.
#[pyclass(name = "Space", frozen, module = "affinor._engine")]
pub struct PySpace(pub Space, BTreeMap<String, Arc<str>>);

/// The connection of a geometry beside that of its definition.
#[derive(Clone, Copy)]
enum Given<'t> {
    Definition,
    /// The zero connection without a metric: for questions about the algebra alone.
    None,
    Affinities(&'t Values),
    /// Torsion and nonmetricity.
    TorsionAndNonmetricity(Option<&'t Values>, Option<&'t Values>),
}

impl Given<'_> {
    fn has_parameters(&self) -> bool {
        let tensors = match self {
            Given::Definition | Given::None => [None, None],
            Given::Affinities(tensor) => [Some(*tensor), None],
            Given::TorsionAndNonmetricity(torsion, nonmetricity) => [*torsion, *nonmetricity],
        };
        tensors.into_iter().flatten().any(|tensor| matches!(tensor, Values::Symbolic(_)))
    }
}

/// The tensor over another scalar.
fn read<S: Coefficient>(values: &Values, tolerance: Tolerance) -> Result<Tensor<S>, InputError> {
    fn convert<S: Coefficient, T: Scalar>(
        tensor: &Tensor<T>,
        tolerance: Tolerance,
        exact: impl Fn(&T) -> Option<Symbolic>,
    ) -> Result<Tensor<S>, InputError> {
        let mut components = Vec::new();
        for (at, value) in tensor.components() {
            let converted = exact(value).and_then(|value| S::from_symbolic(&value));
            let refused = || InputError::usage(format!("{value} is no value of this scalar"));
            components.push((at, converted.ok_or_else(refused)?));
        }
        let tensor = Tensor::from_components(tensor.dimension(), tensor.slots(), components)?;
        Ok(tensor.with_tolerance(tolerance))
    }
    match values {
        Values::Exact(tensor) => {
            convert(tensor, tolerance, |value| Some(Symbolic::constant(value.clone())))
        }
        Values::Symbolic(tensor) => convert(tensor, tolerance, |value| Some(value.clone())),
        Values::Float(tensor) => convert(tensor, tolerance, |value: &TrackedFloat| {
            Rational::from_f64(value.to_f64()?).map(Symbolic::constant)
        }),
    }
}

impl Given<'_> {
    fn geometry<S: Grounded>(
        self,
        definition: &Definition,
        tolerance: Tolerance,
    ) -> Result<Geometries, InputError> {
        let ground = definition.ground(tolerance)?;
        let name = definition.name.clone();
        let geometry = match self {
            Given::Definition => definition.geometry_over(ground, tolerance)?,
            Given::None => Geometry::new(
                name,
                ground,
                ConnectionKind::Canonical(CanonicalConnection::Zero),
                None,
            )?,
            Given::Affinities(gamma) => {
                let metric = definition.metric(&ground, tolerance)?;
                let kind = ConnectionKind::Affinities(read(gamma, tolerance)?);
                Geometry::new(name, ground, kind, metric)?
            }
            Given::TorsionAndNonmetricity(torsion, nonmetricity) => {
                let metric = definition.metric(&ground, tolerance)?.ok_or(Error::NoMetric)?;
                let (frame, n) = (ground.frame(), ground.frame().dimension());
                let connection = match (torsion, nonmetricity) {
                    (Some(torsion), None) => {
                        Connection::with_torsion(frame, &metric, &read(torsion, tolerance)?)?
                    }
                    (torsion, nonmetricity) => {
                        let zero = |slots: &[_]| Tensor::zero(n, slots).map_err(InputError::from);
                        let up = [affinor_tensors::Up, Down, Down];
                        let torsion = torsion.map_or_else(|| zero(&up), |t| read(t, tolerance))?;
                        let given = nonmetricity.map(|values| read(values, tolerance));
                        let nonmetricity = given.unwrap_or_else(|| zero(&[Down; 3]))?;
                        Connection::with_torsion_and_nonmetricity(
                            frame,
                            &metric,
                            &torsion,
                            &nonmetricity,
                        )?
                    }
                };
                let kind = ConnectionKind::Affinities(connection.affinities().clone());
                Geometry::new(name, ground, kind, Some(metric))?
            }
        };
        Ok(S::geometry(geometry))
    }
}

/// A check: its name, whether it holds, the detail, and the indices and residual of its witness.
type Checked = (String, bool, String, Option<(Vec<usize>, Vec<(usize, String)>)>);

fn choice(scalar: &str) -> PyResult<ScalarChoice> {
    match scalar {
        "exact" => Ok(ScalarChoice::Exact),
        "float" => Ok(ScalarChoice::Float),
        other => Err(PyValueError::new_err(format!("the scalar is exact or float, not {other:?}"))),
    }
}

fn tolerance(relative: Option<f64>) -> PyResult<Tolerance> {
    relative.map_or(Ok(Tolerance::default()), |relative| {
        Tolerance::new(relative).ok_or_else(|| {
            PyValueError::new_err(format!("the tolerance {relative} is not in 0 <= x < 1"))
        })
    })
}

impl PySpace {
    fn build(
        &self,
        py: Python<'_>,
        scalar: &str,
        relative: Option<f64>,
        given: Given<'_>,
    ) -> PyResult<PyGeometry> {
        let (choice, tolerance, space) = (choice(scalar)?, tolerance(relative)?, &self.0);
        let geometry = run(py, || {
            let kind = match choice {
                // parameters of a tensor that the definition does not have
                ScalarChoice::Exact if given.has_parameters() => Kind::Symbolic,
                _ => space.kind(choice)?,
            };
            over_kind!(kind, S => given.geometry::<S>(&space.definition, tolerance))
        })?;
        Ok(PyGeometry(geometry))
    }
}

#[pymethods]
impl PySpace {
    /// A space from the arguments of the command line, or from the text of a definition file; `files` that it names are not read.
    #[new]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    #[pyo3(signature = (space=None, definition=None, basis=None, brackets=vec![], connection=None, metric=None, set=None, files=BTreeMap::new()))]
    fn new(
        py: Python<'_>,
        space: Option<String>,
        definition: Option<(String, String)>,
        basis: Option<String>,
        brackets: Vec<String>,
        connection: Option<String>,
        metric: Option<String>,
        set: Option<String>,
        files: BTreeMap<String, String>,
    ) -> PyResult<Self> {
        let files = files.into_iter().map(|(path, text)| (path, text.into())).collect();
        let files = Files::new(files);
        let request =
            Request { space, definition, basis, brackets, connection, metric, set, files };
        let space = run(py, || Space::open(&request))?;
        Ok(PySpace(space, request.files.contents()))
    }

    /// The contents of the files that it names, by their paths.
    #[getter]
    fn files(&self) -> BTreeMap<String, String> {
        self.1.iter().map(|(path, text)| (path.clone(), text.to_string())).collect()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.definition.name
    }

    #[getter]
    fn labels(&self) -> Vec<String> {
        self.0.definition.labels.clone()
    }

    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.0.definition.parameters()
    }

    #[getter]
    fn coordinates(&self) -> Vec<String> {
        self.0.definition.coordinates().to_vec()
    }

    #[getter]
    fn has_metric(&self) -> bool {
        self.0.definition.has_metric()
    }

    /// The geometry; affinities, or torsion and nonmetricity, replace the connection of the definition.
    #[pyo3(signature = (scalar="exact", tolerance=None, affinities=None, torsion=None, nonmetricity=None))]
    fn geometry(
        &self,
        py: Python<'_>,
        scalar: &str,
        tolerance: Option<f64>,
        affinities: Option<Py<PyTensor>>,
        torsion: Option<Py<PyTensor>>,
        nonmetricity: Option<Py<PyTensor>>,
    ) -> PyResult<PyGeometry> {
        let values = |tensor: &'_ Option<Py<PyTensor>>| tensor.as_ref().map(|t| t.clone_ref(py));
        let [affinities, torsion, nonmetricity] =
            [&affinities, &torsion, &nonmetricity].map(values);
        let given = match (&affinities, &torsion, &nonmetricity) {
            (None, None, None) => Given::Definition,
            (Some(affinities), None, None) => Given::Affinities(&affinities.get().0),
            (None, torsion, nonmetricity) => Given::TorsionAndNonmetricity(
                torsion.as_ref().map(|t| &t.get().0),
                nonmetricity.as_ref().map(|t| &t.get().0),
            ),
            _ => {
                let reason = "give affinities, or torsion and nonmetricity, not both";
                return Err(PyValueError::new_err(reason));
            }
        };
        self.build(py, scalar, tolerance, given)
    }

    /// The algebra, with the connection zero and without a metric.
    #[pyo3(signature = (scalar="exact", tolerance=None))]
    fn algebra(
        &self,
        py: Python<'_>,
        scalar: &str,
        tolerance: Option<f64>,
    ) -> PyResult<PyGeometry> {
        self.build(py, scalar, tolerance, Given::None)
    }

    /// The checks: name, whether it holds, detail, witness.
    #[pyo3(signature = (scalar="exact", tolerance=None))]
    fn check(
        &self,
        py: Python<'_>,
        scalar: &str,
        tolerance: Option<f64>,
    ) -> PyResult<Vec<Checked>> {
        let checks = self.checks(py, scalar, tolerance)?;
        let data = |check: Check| {
            let witness = check.witness.map(|witness| (witness.indices, witness.residual));
            (check.name.to_string(), check.ok, check.detail, witness)
        };
        Ok(checks.into_iter().map(data).collect())
    }

    /// The certificate as the program prints it.
    #[pyo3(signature = (format, scalar="exact", tolerance=None))]
    fn certificate(
        &self,
        py: Python<'_>,
        format: &str,
        scalar: &str,
        tolerance: Option<f64>,
    ) -> PyResult<String> {
        let checks = self.checks(py, scalar, tolerance)?;
        let format = crate::report::format(format)?;
        let tolerance = (scalar == "float").then_some(self::tolerance(tolerance)?);
        let report = certificate(&self.0.definition.name, &checks, tolerance);
        written(&report, format).map_err(|error| raise(py, &error))
    }

    /// The group of the algebra.
    fn group(&self, py: Python<'_>) -> PyResult<PyGroup> {
        let space = &self.0;
        let group = run(py, || space.in_floats()?.group(Tolerance::default()))?;
        Ok(PyGroup::new(space.definition.name.clone(), group))
    }
}

impl PySpace {
    fn checks(&self, py: Python<'_>, scalar: &str, relative: Option<f64>) -> PyResult<Vec<Check>> {
        let (choice, tolerance, space) = (choice(scalar)?, tolerance(relative)?, &self.0);
        run(py, || Computation { scalar: choice, tolerance, ..Computation::of(space) }.checks())
    }
}
