//! Sources: the arguments that define algebras, geometries and groups.

use crate::class::Object;
use crate::components::Values;
use crate::geometries::{Geometries, Grounded};
use crate::run::run;
use crate::tensor::PyTensor;
use crate::values::python;
use affinor::{CanonicalConnection, Connection, ConnectionKind, Error, Geometry};
use affinor_documents::input::{Files, InputError};
use affinor_documents::report::Computation;
use affinor_documents::space::{Definition, Request, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::{
    Down, Kind, Notation, Rational, Scalar, Symbolic, Tensor, Tolerance, TrackedFloat, Up,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use std::collections::BTreeMap;

/// The arguments that define a space, as a Python dict.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, FromPyObject, IntoPyObject)]
pub struct Arguments {
    #[pyo3(item)]
    space: Option<String>,
    #[pyo3(item, default)]
    definition: Option<(String, String)>,
    #[pyo3(item, default)]
    basis: Option<String>,
    #[pyo3(item, default)]
    brackets: Vec<String>,
    #[pyo3(item, default)]
    connection: Option<String>,
    #[pyo3(item, default)]
    metric: Option<String>,
    /// Values of parameters and functions; the keys are the names in the text.
    #[pyo3(item, default)]
    values: Vec<(String, String)>,
    /// The contents of the files that were read, by path.
    #[pyo3(item, default)]
    files: BTreeMap<String, String>,
}

impl Arguments {
    /// The arguments of a space with this name.
    pub fn named(name: &str) -> Self {
        Arguments { space: Some(name.into()), ..Arguments::default() }
    }
}

/// The arguments of a space, the SymPy symbols in them, and the kind of scalars.
#[pyclass(name = "Source", frozen, module = "affinor._engine")]
pub struct PySource {
    arguments: Arguments,
    files: Files,
    pub symbols: Py<PyDict>,
    pub scalar: ScalarChoice,
    pub tolerance: Option<f64>,
}

/// How tensors define the connection of a geometry.
#[derive(Clone, Copy)]
pub enum Given<'t> {
    Definition,
    /// No tensors are needed: the zero connection without a metric, for questions about the algebra alone.
    None,
    Affinities(&'t Values),
    /// Torsion and nonmetricity.
    TorsionAndNonmetricity(Option<&'t Values>, Option<&'t Values>),
}

/// Converts a tensor to another scalar type.
fn read<S: Coefficient>(values: &Values, tolerance: Tolerance) -> Result<Tensor<S>, InputError> {
    fn convert<S: Coefficient, T: Scalar>(
        tensor: &Tensor<T>,
        tolerance: Tolerance,
        exact: impl Fn(&T) -> Option<Symbolic>,
    ) -> Result<Tensor<S>, InputError> {
        let mut components = Vec::new();
        for (at, value) in tensor.components() {
            let converted = exact(value).and_then(|value| S::from_symbolic(&value));
            let refused = || {
                InputError::usage(format!("the value {value} cannot be represented in this scalar"))
            };
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
    fn has_parameters(&self) -> bool {
        let tensors = match self {
            Given::Definition | Given::None => [None, None],
            Given::Affinities(tensor) => [Some(*tensor), None],
            Given::TorsionAndNonmetricity(torsion, nonmetricity) => [*torsion, *nonmetricity],
        };
        tensors.into_iter().flatten().any(|tensor| matches!(tensor, Values::Symbolic(_)))
    }

    pub fn geometry<S: Coefficient>(
        self,
        definition: &Definition,
        tolerance: Tolerance,
    ) -> Result<Geometry<S>, InputError> {
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
                let given = |values: Option<&Values>, slots: &[_]| match values {
                    Some(values) => read(values, tolerance),
                    None => Tensor::zero(n, slots).map_err(InputError::from),
                };
                let tau = given(torsion, &[Up, Down, Down])?;
                let connection = match nonmetricity {
                    None => Connection::with_torsion(frame, &metric, &tau)?,
                    some => {
                        let q = given(some, &[Down; 3])?;
                        Connection::with_torsion_and_nonmetricity(frame, &metric, &tau, &q)?
                    }
                };
                let kind = ConnectionKind::Affinities(connection.affinities().clone());
                Geometry::new(name, ground, kind, Some(metric))?
            }
        };
        Ok(geometry)
    }
}

impl PySource {
    fn tolerance(&self) -> PyResult<Tolerance> {
        self.tolerance.map_or(Ok(Tolerance::default()), |relative| {
            let reason = || format!("the tolerance {relative} is not in 0 <= x < 1");
            Tolerance::new(relative).ok_or_else(|| PyValueError::new_err(reason()))
        })
    }

    fn open(&self, py: Python<'_>, arguments: Arguments) -> PyResult<Space> {
        let settings: Vec<String> =
            arguments.values.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let set = (!settings.is_empty()).then(|| settings.join(","));
        let Arguments { space, definition, basis, brackets, connection, metric, .. } = arguments;
        let files = self.files.clone();
        let request = Request {
            space,
            definition,
            basis,
            brackets,
            connection,
            metric,
            set,
            files,
            ..Request::default()
        };
        run(py, || Space::open(&request))
    }

    /// Opens the space that the arguments define. Its files are read only once.
    pub fn space(&self, py: Python<'_>) -> PyResult<Space> {
        self.open(py, self.arguments.clone())
    }

    /// The geometry of the space with this connection.
    pub fn geometry(
        &self,
        py: Python<'_>,
        space: &Space,
        given: Given<'_>,
    ) -> PyResult<Geometries> {
        let (choice, tolerance) = (self.scalar, self.tolerance()?);
        run(py, || {
            let kind = match choice {
                // uses symbolic scalars, because a tensor has parameters that the definition does not have
                ScalarChoice::Exact if given.has_parameters() => Kind::Symbolic,
                _ => space.kind(choice)?,
            };
            over_kind!(kind, S => {
                Ok(Grounded::geometry(given.geometry::<S>(&space.definition, tolerance)?))
            })
        })
    }

    fn with(&self, py: Python<'_>, arguments: Arguments) -> Self {
        let (symbols, files) = (self.symbols.clone_ref(py), self.files.clone());
        PySource { arguments, files, symbols, scalar: self.scalar, tolerance: self.tolerance }
    }

    /// The source without its connection and its metric, but with the values of the parameters that remain.
    pub fn of_algebra(&self, py: Python<'_>) -> PyResult<Self> {
        let all = self.arguments.clone();
        let alone = Arguments { connection: None, metric: None, values: vec![], ..all.clone() };
        let parameters = self.open(py, alone.clone())?.definition.parameters();
        let values = all.values.into_iter().filter(|(name, _)| parameters.contains(name)).collect();
        Ok(self.with(py, Arguments { values, ..alone }))
    }

    /// The name of a space, if the source consists only of a catalogue name or of a sum of such names.
    pub fn plain_name(&self, space: &Space) -> Option<&str> {
        let name = self.arguments.space.as_deref()?;
        let alone = Arguments { space: None, ..self.arguments() } == Arguments::default();
        (alone && space.definition.is_of_catalogue() && !name.contains('@')).then_some(name)
    }

    /// The same source with another name.
    pub fn renamed(&self, py: Python<'_>, name: String) -> Self {
        self.with(py, Arguments { space: Some(name), ..self.arguments.clone() })
    }

    /// The checks of the certificate, as Python objects.
    pub fn checks<'py>(&self, py: Python<'py>) -> PyResult<Vec<Object<'py>>> {
        let (choice, tolerance, space) = (self.scalar, self.tolerance()?, self.space(py)?);
        let checks = run(py, || {
            Computation { scalar: choice, tolerance, ..Computation::of(&space) }.checks()
        })?;
        let class = python(py, "algebra", "Check")?;
        let made = checks.into_iter().map(|check| {
            let witness = check.witness.map(|witness| (witness.indices, witness.residual));
            class.call1((check.name.to_string(), check.ok, check.detail, witness))
        });
        made.collect()
    }
}

#[pymethods]
impl PySource {
    #[new]
    fn __new__(
        arguments: Arguments,
        symbols: Py<PyDict>,
        scalar: &Object<'_>,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        let choice = match scalar.extract::<String>().as_deref() {
            Ok("exact") => ScalarChoice::Exact,
            Ok("float") => ScalarChoice::Float,
            _ => {
                let reason = format!("the scalar is exact or float, not {}", scalar.repr()?);
                return Err(PyValueError::new_err(reason));
            }
        };
        if tolerance.is_some() && choice == ScalarChoice::Exact {
            let reason = "exact numbers have no tolerance: choose scalar='float', or leave the tolerance out";
            return Err(PyValueError::new_err(reason));
        }
        let files = arguments.files.iter().map(|(path, text)| (path.clone(), text.as_str().into()));
        let files = Files::new(files.collect());
        Ok(PySource { arguments, files, symbols, scalar: choice, tolerance })
    }

    /// The arguments, with the contents of the files that were read.
    #[getter]
    pub fn arguments(&self) -> Arguments {
        let files = self.files.contents().into_iter();
        let files = files.map(|(path, text)| (path, text.to_string())).collect();
        Arguments { files, ..self.arguments.clone() }
    }

    #[getter]
    fn symbols(&self, py: Python<'_>) -> Py<PyDict> {
        self.symbols.clone_ref(py)
    }

    #[getter]
    fn scalar(&self) -> &'static str {
        if self.scalar == ScalarChoice::Float { "float" } else { "exact" }
    }

    #[getter(tolerance)]
    fn relative(&self) -> Option<f64> {
        self.tolerance
    }

    /// The parameters and the coordinates. If `settled` is set, the list includes parameters that have values.
    fn names(&self, py: Python<'_>, settled: bool) -> PyResult<(Vec<String>, Vec<String>)> {
        let mut arguments = self.arguments.clone();
        arguments.values.retain(|_| settled);
        let definition = self.open(py, arguments)?.definition;
        Ok((definition.parameters(), definition.coordinates().to_vec()))
    }

    /// The source with additional values of parameters, by name or by symbol.
    pub fn subs(slf: &Bound<'_, Self>, values: &Object<'_>) -> PyResult<Self> {
        let settings = python(slf.py(), "_source", "settings")?.call1((values, slf))?;
        let (values, symbols) = settings.extract()?;
        let source = slf.get();
        let made = source.with(slf.py(), Arguments { values, ..source.arguments.clone() });
        Ok(PySource { symbols, ..made })
    }

    /// The checks of the certificate.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Vec<Object<'py>>> {
        self.checks(py)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, Stored) {
        let source = slf.get();
        let symbols = source.symbols.clone_ref(slf.py());
        (slf.get_type(), (source.arguments(), symbols, source.scalar(), source.tolerance))
    }
}

/// The state of a pickled source.
type Stored = (Arguments, Py<PyDict>, &'static str, Option<f64>);

impl PyTensor {
    /// The connection of a geometry, from the tensors in a dictionary.
    pub fn given<'t>(extra: &'t [(String, Py<PyTensor>)]) -> PyResult<Given<'t>> {
        let find = |name: &str| {
            extra.iter().find(|(key, _)| key == name).map(|(_, tensor)| &tensor.get().values)
        };
        Ok(match (find("affinities"), find("torsion"), find("nonmetricity")) {
            (None, None, None) => Given::Definition,
            (Some(affinities), None, None) => Given::Affinities(affinities),
            (None, torsion, nonmetricity) => Given::TorsionAndNonmetricity(torsion, nonmetricity),
            _ => {
                let reason = "give affinities, or torsion and nonmetricity, not both";
                return Err(PyValueError::new_err(reason));
            }
        })
    }
}
