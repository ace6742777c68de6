//! Geometries over the three scalars.

use crate::errors::raise;
use crate::group::{PyGroup, PyTransport};
use crate::report::{format, written};
use crate::run::run;
use crate::tensor::{Held, PyTensor, float, of};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::geometry::properties::Property;
use affinor::group::transport::ParallelTranslation;
use affinor::{BasisChange, Connection, Error, Frame, Geometry};
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_documents::report::{
    ComparedSide, Comparison, EquationReport, Quantity, Report, Table,
};
use affinor_tensors::{Kind, Rational, Symbolic, Tensor, TrackedFloat};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A geometry over one of the scalars.
#[derive(Clone, Debug)]
pub enum Values {
    Exact(Geometry<Rational>),
    Symbolic(Geometry<Symbolic>),
    Float(Geometry<TrackedFloat>),
}

macro_rules! each {
    ($values:expr, $geometry:ident => $body:expr) => {
        match $values {
            Values::Exact($geometry) => $body,
            Values::Symbolic($geometry) => $body,
            Values::Float($geometry) => $body,
        }
    };
}

/// A scalar of the geometries that Python holds.
pub trait Grounded: Held {
    fn geometry(geometry: Geometry<Self>) -> Values;
}

impl Grounded for Rational {
    fn geometry(geometry: Geometry<Self>) -> Values {
        Values::Exact(geometry)
    }
}

impl Grounded for Symbolic {
    fn geometry(geometry: Geometry<Self>) -> Values {
        Values::Symbolic(geometry)
    }
}

impl Grounded for TrackedFloat {
    fn geometry(geometry: Geometry<Self>) -> Values {
        Values::Float(geometry)
    }
}

/// A geometry: a frame, a connection and perhaps a metric.
#[pyclass(name = "Geometry", frozen, module = "affinor._engine")]
pub struct PyGeometry(pub Values);

/// The quantity of a name.
fn quantity(key: &str) -> PyResult<Quantity> {
    Quantity::from_key(key).ok_or_else(|| {
        let keys: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::key).collect();
        PyValueError::new_err(format!("{key:?} is not one of {}", keys.join(", ")))
    })
}

/// A quantity: its name, its symbol, its LaTeX symbol, its title, and the letters of its indices.
type Description = (&'static str, &'static str, &'static str, &'static str, String);

/// The quantities of a table, in its order.
#[pyfunction]
pub fn quantities() -> Vec<Description> {
    let describe = |q: Quantity| (q.key(), q.symbol(), q.latex(), q.title(), q.letters());
    Quantity::ALL.into_iter().map(describe).collect()
}

/// A property that holds, with its value, or the witness of its failure.
type Tested = (bool, Option<String>, Option<(String, Vec<usize>, String)>);

fn tested<S: Coefficient, T>(
    property: Property<S, T>,
    value: impl FnOnce(T) -> Option<String>,
) -> Tested {
    match property {
        Property::Holds(held) => (true, value(held), None),
        Property::Fails(witness) => {
            let text = witness.to_string();
            (false, None, Some((text, witness.indices, witness.residual.to_string())))
        }
    }
}

#[pymethods]
impl PyGeometry {
    #[getter]
    fn name(&self) -> String {
        each!(&self.0, geometry => geometry.name().into())
    }

    #[getter]
    pub fn labels(&self) -> Vec<String> {
        each!(&self.0, geometry => geometry.frame().labels().to_vec())
    }

    #[getter]
    fn scalar(&self) -> &'static str {
        match self.0 {
            Values::Exact(_) => "exact",
            Values::Symbolic(_) => "symbolic",
            Values::Float(_) => "float",
        }
    }

    /// The short name of the connection.
    #[getter]
    fn connection(&self) -> String {
        each!(&self.0, geometry => geometry.kind().name().into())
    }

    /// The factor of a connection `lambda c`, as text.
    #[getter]
    fn factor(&self) -> Option<String> {
        each!(&self.0, geometry => geometry.kind().lambda().map(|lambda| lambda.to_string()))
    }

    /// The frame: left-invariant, right-invariant, coordinate or moving.
    #[getter]
    fn frame(&self) -> &'static str {
        each!(&self.0, geometry => geometry.frame_name())
    }

    fn __str__(&self) -> String {
        each!(&self.0, geometry => geometry.to_string())
    }

    /// The brackets of the algebra as text, one a line; none if the frame has none.
    fn brackets(&self) -> Option<String> {
        each!(&self.0, geometry => geometry.algebra().map(|algebra| algebra.to_string()))
    }

    /// A quantity by its name; none where it does not apply.
    fn quantity(&self, py: Python<'_>, key: &str) -> PyResult<Option<PyTensor>> {
        let quantity = quantity(key)?;
        let tensor =
            run(py, || Ok(each!(&self.0, geometry => quantity.of(geometry)?.map(Held::wrap))))?;
        Ok(tensor.map(PyTensor))
    }

    /// A table of quantities as the program prints it.
    #[pyo3(signature = (keys, format, independent=false))]
    fn table(
        &self,
        py: Python<'_>,
        keys: Vec<String>,
        format: &str,
        independent: bool,
    ) -> PyResult<String> {
        let keys = keys.iter().map(|key| quantity(key)).collect::<PyResult<Vec<_>>>()?;
        let format = self::format(format)?;
        run(py, || {
            each!(&self.0, geometry => {
                let mut table = Table::new(geometry, &keys)?;
                table.independent = independent;
                table.finite()?;
                written(&table, format)
            })
        })
    }

    /// Both geometries side by side, and the claims of the paper about them.
    fn compare(&self, py: Python<'_>, other: &PyGeometry, format: &str) -> PyResult<String> {
        let format = self::format(format)?;
        run(py, || {
            let side = |values: &Values| each!(values, geometry => ComparedSide::new(geometry));
            written(&Comparison::new(side(&self.0)?, side(&other.0)?), format)
        })
    }

    /// Equations of motion: euler-poincare, autoparallel or transport.
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
            let report = each!(&self.0, geometry => report(geometry, kind)?);
            written(&*report, format)
        })
    }

    /// The same geometry in the right-invariant frame.
    fn in_right_frame(&self, py: Python<'_>) -> PyResult<PyGeometry> {
        run(py, || {
            let right = each!(&self.0, geometry => Grounded::geometry(geometry.in_right_frame()?));
            Ok(PyGeometry(right))
        })
    }

    /// The labels and the structure constants of the direct sum with another algebra.
    fn direct_sum(&self, py: Python<'_>, other: &PyGeometry) -> PyResult<(Vec<String>, PyTensor)> {
        fn sum<S: Held>(
            first: &Geometry<S>,
            second: &Geometry<S>,
        ) -> Result<(Vec<String>, PyTensor), InputError> {
            let what = "a direct sum";
            let first = first.frame_origin().algebra_for(what)?;
            let sum = first.direct_sum(second.frame_origin().algebra_for(what)?)?;
            Ok((sum.labels().to_vec(), PyTensor(S::wrap(sum.structure_constants().clone()))))
        }
        run(py, || match (&self.0, &other.0) {
            (Values::Exact(first), Values::Exact(second)) => sum(first, second),
            (Values::Symbolic(first), Values::Symbolic(second)) => sum(first, second),
            (Values::Float(first), Values::Float(second)) => sum(first, second),
            _ => Err(InputError::usage("both algebras need the same scalar")),
        })
    }

    /// The structure constants in the basis `e'_a = A^i_a e_i`.
    fn change_basis(&self, py: Python<'_>, matrix: &PyTensor) -> PyResult<PyTensor> {
        fn changed<S: Held>(
            geometry: &Geometry<S>,
            matrix: &PyTensor,
        ) -> Result<PyTensor, InputError> {
            let algebra = geometry.frame_origin().algebra_for("a change of basis")?;
            let change = BasisChange::new((*of::<S>(&matrix.0)?).clone())?;
            Ok(PyTensor(S::wrap(algebra.change_basis(&change)?.structure_constants().clone())))
        }
        run(py, || {
            match (&self.0, matrix.0.kind()) {
                // parameters of the matrix
                (Values::Exact(geometry), Kind::Symbolic) => {
                    let algebra = geometry.frame_origin().algebra_for("a change of basis")?;
                    let algebra = algebra.map(|value| Symbolic::constant(value.clone()))?;
                    let change = BasisChange::new((*of::<Symbolic>(&matrix.0)?).clone())?;
                    let structure = algebra.change_basis(&change)?.structure_constants().clone();
                    Ok(PyTensor(Symbolic::wrap(structure)))
                }
                _ => each!(&self.0, geometry => changed(geometry, matrix)),
            }
        })
    }

    /// A property by its name: whether it holds, its value, or its witness.
    fn property(&self, py: Python<'_>, name: &str) -> PyResult<Tested> {
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
        run(py, || each!(&self.0, geometry => test(geometry, name)))
    }

    /// The connection on a group of its algebra.
    fn transport(&self, py: Python<'_>, group: &PyGroup) -> PyResult<PyTransport> {
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
        run(py, || {
            let connection = each!(&self.0, geometry => connection(geometry)?);
            Ok(PyTransport(ParallelTranslation::new(group.group().clone(), connection)?))
        })
    }

    /// A basis of the holonomy algebra: matrices.
    fn holonomy(&self, py: Python<'_>) -> PyResult<Vec<PyTensor>> {
        fn basis<S: Held>(geometry: &Geometry<S>) -> Result<Vec<PyTensor>, InputError> {
            let holonomy = geometry.connection().holonomy()?;
            let basis = holonomy.basis()?;
            Ok(basis.into_iter().map(|matrix| PyTensor(S::wrap(matrix))).collect())
        }
        run(py, || each!(&self.0, geometry => basis(geometry)))
    }
}

/// The conventions of signs and indices.
#[pyfunction]
pub fn conventions(py: Python<'_>, format: &str) -> PyResult<String> {
    let format = self::format(format)?;
    let report = affinor_documents::report::conventions();
    written(&report, format).map_err(|error| raise(py, &error))
}

/// The catalogue: pattern, summary and example of each family.
#[pyfunction]
pub fn catalogue() -> Vec<(&'static str, &'static str, &'static str)> {
    let families = affinor::algebra::catalogue::families();
    families.iter().map(|family| (family.pattern, family.summary, family.example)).collect()
}
