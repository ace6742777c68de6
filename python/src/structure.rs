//! Structure theory: the documents of an algebra and of a geometry, and new algebras from old ones.

use crate::errors::raise;
use crate::geometry::{PyGeometry, Values as Geometries};
use crate::report::written;
use crate::run::run;
use crate::space::PySpace;
use crate::tensor::{Held, PyTensor, Values, of};
use affinor::algebra::structure::{GroundField, StructureTheory, Subspace};
use affinor::{BasisChange, Bracket, LieAlgebra};
use affinor_documents::input::InputError;
use affinor_documents::report::{Format, Info, Program, Properties, Report};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Kind, Symbolic, Tensor, Up};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// The name of a construction in refusals.
const WHAT: &str = "a construction";

/// A report as JSON, as text and as Markdown.
type Written = (String, String, String);

fn all_formats(report: &impl Report) -> Result<Written, InputError> {
    let [json, text, markdown] =
        [Format::Json, Format::Text, Format::Markdown].map(|format| written(report, format));
    Ok((json?, text?, markdown?))
}

fn in_floats(what: &str) -> InputError {
    let error = InputError::usage(format!("{what} is exact, and the values here are floats"));
    error.help("give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'")
}

/// The structure of an algebra, as `affinor info` writes it.
#[pyfunction]
pub fn info(py: Python<'_>, space: &PySpace) -> PyResult<Written> {
    run(py, || all_formats(&Info::of(&space.0.definition, &|_| ())?))
}

/// The properties of a geometry, as `affinor properties` writes them.
#[pyfunction]
pub fn properties(py: Python<'_>, geometry: &PyGeometry) -> PyResult<Written> {
    run(py, || match &geometry.0 {
        Geometries::Exact(geometry) => all_formats(&Properties::of_geometry(geometry)?),
        Geometries::Symbolic(geometry) => all_formats(&Properties::of_geometry(geometry)?),
        Geometries::Float(_) => Err(in_floats("the list of properties")),
    })
}

/// The structure constants as input of GAP, Sage, Maple or SymPy.
#[pyfunction]
pub fn program(py: Python<'_>, algebra: &PyGeometry, program: &str) -> PyResult<String> {
    let program = Program::from_name(program).ok_or_else(|| {
        let names = Program::ALL.map(Program::name).join(", ");
        PyValueError::new_err(format!("the programs are {names}, not {program:?}"))
    })?;
    macro_rules! text {
        ($geometry:expr) => {{
            let algebra = $geometry.frame_origin().algebra_for("input of other programs")?;
            Ok(program.structure($geometry.name(), algebra.labels(), algebra.structure_constants()))
        }};
    }
    run(py, || match &algebra.0 {
        Geometries::Exact(geometry) => text!(geometry),
        Geometries::Symbolic(geometry) => text!(geometry),
        Geometries::Float(geometry) => text!(geometry),
    })
}

/// The labels and the structure constants of a new algebra.
type Made = (Vec<String>, PyTensor);

fn made<S: Held>(algebra: &LieAlgebra<S>) -> Made {
    (algebra.labels().to_vec(), PyTensor(S::wrap(algebra.structure_constants().clone())))
}

/// A construction over the scalar of an algebra and of the tensors beside it.
trait Construct {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError>;

    /// Whether a part other than the algebra has parameters.
    fn has_parameters(&self) -> bool {
        false
    }

    fn of(&self, py: Python<'_>, algebra: &PyGeometry) -> PyResult<Made>
    where
        Self: Sync,
    {
        run(py, || match &algebra.0 {
            Geometries::Exact(geometry) => {
                let algebra = geometry.frame_origin().algebra_for(WHAT)?;
                if !self.has_parameters() {
                    return self.run(&StructureTheory::new(algebra.clone()));
                }
                let algebra = algebra.map(|value| Symbolic::constant(value.clone()))?;
                self.run(&StructureTheory::new(algebra))
            }
            Geometries::Symbolic(geometry) => {
                let algebra = geometry.frame_origin().algebra_for(WHAT)?;
                self.run(&StructureTheory::new(algebra.clone()))
            }
            Geometries::Float(_) => Err(in_floats(WHAT)),
        })
    }
}

/// The components of vectors.
fn rows<S: Held>(vectors: &[Values]) -> Result<Vec<Row<S>>, InputError> {
    let row = |vector: &Values| -> Result<Row<S>, InputError> {
        let vector = of::<S>(vector)?;
        Ok(vector.components().map(|(at, value)| (at[0], value.clone())).collect())
    };
    vectors.iter().map(row).collect()
}

fn values(tensors: &[Py<PyTensor>]) -> Vec<Values> {
    tensors.iter().map(|tensor| tensor.get().0.clone()).collect()
}

fn symbolic(tensors: &[Values]) -> bool {
    tensors.iter().any(|tensor| tensor.kind() == Kind::Symbolic)
}

/// The ways to name a subalgebra by vectors.
enum Way {
    Spanned,
    Generated,
    Centralizer,
    Derived,
}

struct Subalgebra(Way, Vec<Values>);

impl Construct for Subalgebra {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        let (n, vectors) = (structure.dimension(), rows::<S>(&self.1)?);
        let subspace = match self.0 {
            Way::Spanned => Subspace::span(n, vectors.clone()),
            Way::Generated => structure.generated(vectors.clone()),
            Way::Centralizer => structure.centralizer(&Subspace::span(n, vectors.clone())),
            Way::Derived => structure.derived().clone(),
        };
        if subspace.is_zero() {
            return Err(InputError::usage("the subalgebra is zero"));
        }
        let inside = structure.subalgebra(&subspace)?;
        if !matches!(self.0, Way::Spanned) {
            return Ok(made(inside.algebra()));
        }
        // the vectors are the basis
        let m = subspace.dimension();
        if vectors.len() != m {
            return Err(InputError::usage("the vectors are linearly dependent"));
        }
        let coordinates = vectors.iter().filter_map(|row| subspace.coordinates(row)).enumerate();
        let entries =
            coordinates.flat_map(|(a, row)| row.into_iter().map(move |(i, value)| ([i, a], value)));
        let matrix = Tensor::from_components(m, &[Up, Down], entries)?;
        Ok(made(&inside.algebra().change_basis(&BasisChange::new(matrix)?)?))
    }

    fn has_parameters(&self) -> bool {
        symbolic(&self.1)
    }
}

/// The subalgebra that vectors span or generate, their centralizer, or the derived algebra.
#[pyfunction]
pub fn subalgebra(
    py: Python<'_>,
    algebra: &PyGeometry,
    way: &str,
    vectors: Vec<Py<PyTensor>>,
) -> PyResult<Made> {
    let way = match way {
        "spanned" => Way::Spanned,
        "generated" => Way::Generated,
        "centralizer" => Way::Centralizer,
        "derived" => Way::Derived,
        _ => return Err(PyValueError::new_err(format!("no subalgebra is called {way:?}"))),
    };
    Subalgebra(way, values(&vectors)).of(py, algebra)
}

struct Quotient(Vec<Values>);

impl Construct for Quotient {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        let ideal = Subspace::span(structure.dimension(), rows::<S>(&self.0)?);
        if ideal.dimension() == structure.dimension() {
            return Err(InputError::usage("the quotient by the whole algebra is zero"));
        }
        Ok(made(&structure.quotient(&ideal)?))
    }

    fn has_parameters(&self) -> bool {
        symbolic(&self.0)
    }
}

/// The quotient by the ideal that vectors span.
#[pyfunction]
pub fn quotient(
    py: Python<'_>,
    algebra: &PyGeometry,
    vectors: Vec<Py<PyTensor>>,
) -> PyResult<Made> {
    Quotient(values(&vectors)).of(py, algebra)
}

struct Extension(Vec<String>, [Values; 1]);

impl Construct for Extension {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        let (n, cocycle) = (structure.dimension(), of::<S>(&self.1[0])?);
        let mut constants = vec![];
        for (at, value) in cocycle.components() {
            if at[0] < n || at[1] >= n || at[2] >= n {
                let message = "a cocycle maps two vectors of the algebra into the centre";
                return Err(InputError::usage(message));
            }
            constants.push((at[1], at[2], at[0] - n, value.clone()));
        }
        Ok(made(&structure.central_extension(&self.0, constants)?))
    }

    fn has_parameters(&self) -> bool {
        symbolic(&self.1)
    }
}

/// The central extension by a cocycle: constants `w^i_jk` of the larger space, with `i` in the centre.
#[pyfunction]
pub fn central_extension(
    py: Python<'_>,
    algebra: &PyGeometry,
    centre: Vec<String>,
    cocycle: &PyTensor,
) -> PyResult<Made> {
    Extension(centre, [cocycle.0.clone()]).of(py, algebra)
}

/// The labels and the constants of the algebra that is acted on, and a matrix for each basis vector that acts.
struct Semidirect {
    labels: Vec<String>,
    /// The structure constants, then the matrices.
    tensors: Vec<Values>,
}

impl Construct for Semidirect {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        let all = self.tensors.iter().map(of::<S>).collect::<Result<Vec<_>, _>>()?;
        let Some((constants, matrices)) = all.split_first() else {
            return Err(InputError::usage("the algebra acted on is missing"));
        };
        let constants =
            constants.components().map(|(at, value)| (at[1], at[2], at[0], value.clone()));
        let on = LieAlgebra::try_from(Bracket::from_constants(&self.labels, constants)?)?;
        let matrix = |tensor: &Arc<Tensor<S>>| {
            let mut rows = vec![vec![]; tensor.dimension()];
            for (at, value) in tensor.components() {
                rows[at[0]].push((at[1], value.clone()));
            }
            Matrix::from_rows(tensor.dimension(), rows).map_err(affinor::Error::from)
        };
        let by = matrices.iter().map(matrix).collect::<Result<Vec<_>, _>>()?;
        Ok(made(&structure.semidirect(&StructureTheory::new(on), &by)?))
    }

    fn has_parameters(&self) -> bool {
        symbolic(&self.tensors)
    }
}

/// The semidirect sum of an algebra and another one, on which it acts by matrices.
#[pyfunction]
pub fn semidirect(
    py: Python<'_>,
    algebra: &PyGeometry,
    on: &PyGeometry,
    by: Vec<Py<PyTensor>>,
) -> PyResult<Made> {
    let structure = match &on.0 {
        Geometries::Exact(on) => Held::wrap(on.frame().structure_functions().clone()),
        Geometries::Symbolic(on) => Held::wrap(on.frame().structure_functions().clone()),
        Geometries::Float(_) => return Err(raise(py, &in_floats(WHAT))),
    };
    let tensors = [structure].into_iter().chain(values(&by)).collect();
    Semidirect { labels: on.labels(), tensors }.of(py, algebra)
}

struct Contraction(Vec<i64>);

impl Construct for Contraction {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        Ok(made(&structure.inonu_wigner_contraction(&self.0)?))
    }
}

/// The contraction by weights of the basis vectors.
#[pyfunction]
pub fn contraction(py: Python<'_>, algebra: &PyGeometry, weights: Vec<i64>) -> PyResult<Made> {
    Contraction(weights).of(py, algebra)
}

struct TensorProduct(Vec<String>, [Values; 1]);

impl Construct for TensorProduct {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        Ok(made(&structure.tensor_product(&self.0, &*of::<S>(&self.1[0])?)?))
    }

    fn has_parameters(&self) -> bool {
        symbolic(&self.1)
    }
}

/// The tensor product with a commutative algebra of these vectors, by the constants `p^d_ab` of their products.
#[pyfunction]
pub fn tensor_product(
    py: Python<'_>,
    algebra: &PyGeometry,
    units: Vec<String>,
    products: &PyTensor,
) -> PyResult<Made> {
    TensorProduct(units, [products.0.clone()]).of(py, algebra)
}

/// The constructions that need no further data.
enum Plain {
    Complexification,
    WithDual,
    Truncated(usize),
}

impl Construct for Plain {
    fn run<S: Held + GroundField>(
        &self,
        structure: &StructureTheory<S>,
    ) -> Result<Made, InputError> {
        Ok(made(&match self {
            Plain::Complexification => structure.complexified()?,
            Plain::WithDual => structure.with_dual()?,
            Plain::Truncated(order) if (1..=64).contains(order) => structure.truncated(*order)?,
            Plain::Truncated(_) => {
                let message = "the order of truncation is not between 1 and 64";
                return Err(InputError::usage(message));
            }
        }))
    }
}

/// The complexification as a real algebra.
#[pyfunction]
pub fn complexification(py: Python<'_>, algebra: &PyGeometry) -> PyResult<Made> {
    Plain::Complexification.of(py, algebra)
}

/// The semidirect sum with the dual space, by the coadjoint action.
#[pyfunction]
pub fn with_dual(py: Python<'_>, algebra: &PyGeometry) -> PyResult<Made> {
    Plain::WithDual.of(py, algebra)
}

/// Polynomials in `t` with values in the algebra and `t^order = 0`.
#[pyfunction]
pub fn truncated(py: Python<'_>, algebra: &PyGeometry, order: usize) -> PyResult<Made> {
    Plain::Truncated(order).of(py, algebra)
}
