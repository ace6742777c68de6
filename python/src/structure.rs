//! Structure theory of Lie algebras, and new algebras from old ones.

use crate::algebra::PyAlgebra;
use crate::class::{New, Object, Optional, in_python};
use crate::components::{Held, Values, of};
use crate::geometries::{Geometries, Made, algebra, each, in_floats, made, symbolic};
use crate::report::{Written, all_formats};
use crate::run::run;
use crate::tensor::PyTensor;
use crate::values::{merged, python};
use affinor::algebra::structure::{GroundField, StructureTheory, Subspace};
use affinor::{BasisChange, Bracket, LieAlgebra};
use affinor_documents::input::InputError;
use affinor_documents::report::{Info, Program};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Kind, Rational, Symbolic, Tensor, Up};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::sync::Arc;

/// The name of a construction in errors.
const WHAT: &str = "a construction";

/// The properties that are entries of the report of the structure: a row has the name, the form of the value, and the keys.
macro_rules! answers {
    ($($(#[doc = $doc:literal])* $name:ident: $form:ident $keys:tt;)*) => {
        #[pymethods]
        impl PyAlgebra {
            $(
                $(#[doc = $doc])*
                #[getter]
                fn $name<'py>(slf: &Bound<'py, Self>) -> New<'py> {
                    let answer = Self::answer(slf, &$keys)?;
                    if answer.is_none() { Ok(answer) } else { $form(slf, answer) }
                }
            )*
        }
    };
}

answers! {
    /// Whether all brackets vanish.
    is_abelian: value["abelian"];
    /// Whether the lower central series ends in zero.
    is_nilpotent: value["nilpotent"];
    /// Whether the derived series ends in zero.
    is_solvable: value["solvable"];
    /// Whether ``tr ad_x = 0`` for all ``x``.
    is_unimodular: value["unimodular"];
    /// Whether ``[L, L] = L``.
    is_perfect: value["perfect"];
    /// Whether the radical is the centre.
    is_reductive: value["reductive"];
    /// Whether the Killing form is not degenerate.
    is_semisimple: value["semisimple"];
    /// Whether the only ideals over the reals are zero and the algebra; None if it was not decided.
    is_simple: value["simple"];
    /// Whether the centre is zero and all derivations are inner; None if it was not decided.
    is_complete: value["complete"];
    /// The length of the lower central series; None if the algebra is not nilpotent.
    nilpotency_class: value["nilpotency_class"];
    /// The length of the derived series; None if the algebra is not solvable.
    derived_length: value["derived_length"];
    /// The dimensions of the derived series, until they are stable.
    derived_series: list["derived_series"];
    /// The dimensions of the lower central series, until they are stable.
    lower_central_series: list["lower_central_series"];
    /// The dimensions of the upper central series, until they are stable.
    upper_central_series: list["upper_central_series"];
    /// A basis of the centre, one row per vector: an object array of the shape (dimension of the centre, n).
    centre: subspace["centre", "basis"];
    /// A basis of the solvable radical, one row per vector.
    radical: subspace["radical", "basis"];
    /// A basis of the nilradical, one row per vector.
    nilradical: subspace["nilradical", "basis"];
    /// A basis of a Levi subalgebra, one row per vector.
    levi_subalgebra: subspace["levi", "basis"];
    /// A basis of a Cartan subalgebra, one row per vector.
    cartan_subalgebra: subspace["cartan_subalgebra", "basis"];
    /// The dimension of a Cartan subalgebra.
    rank: value["rank"];
    /// The numbers of positive, negative and zero squares of the Killing form; None if they depend on parameters.
    killing_signature: tuple["killing", "signature"];
    /// The type of the Levi subalgebra over the complex numbers, such as ``"A1 + A1"``; None without one.
    dynkin_type: value["dynkin_type"];
    /// The Betti numbers; None where they were not computed.
    betti: list["betti"];
    /// The dimension minus the generic rank of ``f([x, y])``.
    index: value["index"];
    /// The name of an isomorphic algebra, where one is found.
    identification: value["identification", "name"];
}

fn value<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer)
}

fn list<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer.cast_into::<PyList>()?.get_slice(0, usize::MAX).into_any())
}

fn tuple<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer.cast_into::<PyList>()?.to_tuple().into_any())
}

fn subspace<'py>(algebra: &Bound<'py, PyAlgebra>, rows: Object<'py>) -> New<'py> {
    python(rows.py(), "structure", "subspace")?.call1((algebra, rows))
}

impl PyAlgebra {
    fn answers<'a>(slf: &'a Bound<'_, Self>) -> PyResult<&'a (Written, Py<PyAny>)> {
        let (py, algebra) = (slf.py(), slf.get());
        algebra.found.get_or_try_init(py, || -> PyResult<_> {
            let written = run(py, || {
                if matches!(algebra.values, Geometries::Float(_)) {
                    let error = "structure theory is exact, and the structure constants are floats";
                    let help = "give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'";
                    return Err(InputError::usage(error).help(help));
                }
                all_formats(&Info::of(&algebra.space.definition, &|_| ())?)
            })?;
            let report = python(py, "structure", "Report")?.call1((written.clone(),))?;
            Ok((written, report.unbind()))
        })
    }

    /// An entry of the report; None where a key before it is None.
    fn answer<'py>(slf: &Bound<'py, Self>, keys: &[&str]) -> New<'py> {
        let mut found = Self::answers(slf)?.1.bind(slf.py()).clone();
        for key in keys {
            if !found.is_none() {
                found = found.get_item(key)?;
            }
        }
        Ok(found)
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

#[pymethods]
impl PyAlgebra {
    /// The structure as ``affinor info`` finds it: series, radical, Levi subalgebra, type, cohomology, ...
    ///
    /// The dict is the JSON document ``affinor.info/1``; ``print`` shows the table. The answers are exact; with parameters
    /// they hold for generic values. The computation is done once for an algebra.
    fn info<'py>(slf: &Bound<'py, Self>) -> New<'py> {
        let written = Self::answers(slf)?.0.clone();
        python(slf.py(), "structure", "Report")?.call1((written,))
    }

    /// The structure constants as input of another program: ``gap``, ``sage``, ``maple`` or ``sympy``.
    fn export(&self, py: Python<'_>, program: &str) -> PyResult<String> {
        let program = Program::from_name(program).ok_or_else(|| {
            let names = Program::ALL.map(Program::name).join(", ");
            PyValueError::new_err(format!("the programs are {names}, not {program:?}"))
        })?;
        run(py, || {
            each!(&self.values, geometry => {
                let algebra = geometry.frame_origin().algebra_for("input of other programs")?;
                Ok(program.structure(geometry.name(), algebra.labels(), algebra.structure_constants()))
            })
        })
    }
}

/// The data of a construction that has none.
type Nothing = Option<bool>;

/// Constructions of new algebras: a row has the arguments and the constructor. A function of Python with the same name reads
/// the arguments: it returns the name of the new algebra, further data, and tensors.
macro_rules! constructions {
    ($($(#[$attribute:meta])* fn $name:ident($($argument:ident),*) =
        |$structure:ident: $S:ident, $data:ident: $Data:ty, $given:ident| $body:expr;)*) => {
        #[pymethods]
        impl PyAlgebra {
            $(
                $(#[$attribute])*
                fn $name<'py>(
                    slf: &Bound<'py, Self>,
                    $($argument: Optional<'py>,)*
                    basis: Optional<'py>,
                ) -> New<'py> {
                    let read = python(slf.py(), "structure", stringify!($name))?;
                    let (name, $data, tensors): (String, $Data, Vec<Py<PyTensor>>) =
                        read.call1((slf, $($argument,)*))?.extract()?;
                    let $given: Vec<_> = tensors.iter().map(|one| one.get().values.clone()).collect();
                    let (values, has_parameters) = (&slf.get().values, has_parameters(&$given));
                    let (labels, constants) = run(slf.py(), || match values {
                        Geometries::Exact(geometry) if !has_parameters => {
                            type $S = Rational;
                            let $structure = &StructureTheory::new(algebra(geometry, WHAT)?.clone());
                            $body
                        }
                        Geometries::Float(_) => Err(in_floats(WHAT)),
                        _ => {
                            type $S = Symbolic;
                            let $structure = &StructureTheory::new(symbolic(values, WHAT)?);
                            $body
                        }
                    })?;
                    let labels = match basis {
                        Some(basis) => python(slf.py(), "structure", "names")?.call1((basis,))?.extract()?,
                        None => labels,
                    };
                    let given = tensors.iter().map(|tensor| &tensor.get().symbols);
                    let own = [&slf.get().source.get().symbols].into_iter();
                    let symbols = merged(slf.py(), own.chain(given))?;
                    Self::structured(slf, constants, &symbols, &name, labels)
                }
            )*
        }
    };
}

fn has_parameters(tensors: &[Values]) -> bool {
    tensors.iter().any(|tensor| tensor.kind() == Kind::Symbolic)
}

constructions! {
    /// The subalgebra with these vectors as its basis.
    ///
    /// A vector is its components, or a text such as ``"e1 + 2*e2"``. A span that is not closed raises ConstructionError.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("sl(3)").subalgebra(["E12 + E21", "E12 - E21", "2*H1"], basis="x y z").dimension
    /// 3
    #[pyo3(signature = (vectors, *, basis=None))]
    fn subalgebra(vectors) = |structure: S, _data: Nothing, given| spanned::<S>(structure, &given);
    /// The subalgebra that vectors generate.
    #[pyo3(signature = (vectors, *, basis=None))]
    fn generated(vectors) = |structure: S, _data: Nothing, given| {
        inside(structure, &structure.generated(rows::<S>(&given)?))
    };
    /// The subalgebra of all vectors that commute with these.
    #[pyo3(signature = (vectors, *, basis=None))]
    fn centralizer(vectors) = |structure: S, _data: Nothing, given| {
        let vectors = Subspace::span(structure.dimension(), rows::<S>(&given)?);
        inside(structure, &structure.centralizer(&vectors))
    };
    /// The subalgebra ``[L, L]``.
    #[pyo3(signature = (*, basis=None))]
    fn derived_subalgebra() = |structure: S, _data: Nothing, _given| {
        inside::<S>(structure, structure.derived())
    };
    /// The quotient by the ideal that vectors span; a span that is not an ideal raises ConstructionError.
    #[pyo3(signature = (vectors, *, basis=None))]
    fn quotient(vectors) = |structure: S, _data: Nothing, given| {
        let ideal = Subspace::span(structure.dimension(), rows::<S>(&given)?);
        if ideal.dimension() == structure.dimension() {
            return Err(InputError::usage("the quotient by the whole algebra is zero"));
        }
        Ok(made(&structure.quotient(&ideal)?))
    };
    /// The extension by a centre with the names ``centre``: ``[x, y]`` gets the further component ``omega(x, y)``.
    ///
    /// ``cocycle`` is a text such as ``"[e1, e2] = z"``; or ``omega[j, k]`` for one central vector, ``omega[a, j, k]`` for
    /// several, as an array or a dict. A form that is not a cocycle raises ConstructionError.
    #[pyo3(
        signature = (cocycle, centre=None, *, basis=None),
        text_signature = "($self, cocycle, centre='z', *, basis=None)"
    )]
    fn central_extension(cocycle, centre) = |structure: S, centre: Vec<String>, given| {
        extension::<S>(structure, &centre, &given[0])
    };
    /// The semidirect sum with an algebra on which this one acts, by its labels.
    #[pyo3(signature = (on, by, *, basis=None))]
    fn _semidirect(on, by) = |structure: S, labels: Vec<String>, given| {
        semidirect::<S>(structure, &labels, &given)
    };
    /// The semidirect sum with the dual space, by the coadjoint action.
    #[pyo3(signature = (*, basis=None))]
    fn cotangent_algebra() = |structure: S, _data: Nothing, _given| {
        Ok(made::<S>(&structure.with_dual()?))
    };
    /// The tensor product with a commutative algebra: ``[x u_a, y u_b] = [x, y] (u_a u_b)``.
    ///
    /// ``units`` are the names of its basis. ``products[d, a, b]`` is the component of ``u_a u_b`` along ``u_d``, as an array
    /// or a dict. Products that do not commute or are not associative raise ConstructionError.
    #[pyo3(signature = (units, products, *, basis=None))]
    fn tensor_product(units, products) = |structure: S, units: Vec<String>, given| {
        Ok(made(&structure.tensor_product(&units, &*of::<S>(&given[0])?)?))
    };
    /// Polynomials in ``t`` with values in this algebra and ``t^order = 0``.
    #[pyo3(signature = (order, *, basis=None))]
    fn truncated(order) = |structure: S, order: usize, _given| {
        if !(1..=64).contains(&order) {
            return Err(InputError::usage("the order of truncation is not between 1 and 64"));
        }
        Ok(made::<S>(&structure.truncated(order)?))
    };
    /// The complexification, as a real algebra of twice the dimension: ``x`` and ``i x``.
    #[pyo3(signature = (*, basis=None))]
    fn complexification() = |structure: S, _data: Nothing, _given| {
        Ok(made::<S>(&structure.complexified()?))
    };
    /// The Inonu-Wigner contraction: ``e_i`` is scaled by ``t^w_i``, in the limit of ``t`` to 0.
    ///
    /// Weights without a limit raise ConstructionError.
    #[pyo3(signature = (weights, *, basis=None))]
    fn contraction(weights) = |structure: S, weights: Vec<i64>, _given| {
        Ok(made::<S>(&structure.inonu_wigner_contraction(&weights)?))
    };
}

in_python! { PyAlgebra, "structure":
    /// The semidirect sum with ``on``, an algebra on which this one acts: ``[e_j, v] = D_j v``.
    ///
    /// ``by`` has a matrix ``D_j`` for each basis vector of this algebra. ``semidirect("adjoint")`` acts on the algebra
    /// itself as a vector space, ``semidirect("coadjoint")`` on its dual space. Matrices that are not derivations, or not
    /// an action, raise ConstructionError.
    semidirect (on, by=None, *, basis=None) [on, by, basis];
    /// The algebra of the tangent bundle: the semidirect sum with itself as a vector space, by the adjoint action.
    tangent_algebra (*, basis=None) [basis];
}

/// The algebra of a subspace that is closed.
fn inside<S: Held + GroundField>(
    structure: &StructureTheory<S>,
    subspace: &Subspace<S>,
) -> Result<Made, InputError> {
    if subspace.is_zero() {
        return Err(InputError::usage("the subalgebra is zero"));
    }
    Ok(made(structure.subalgebra(subspace)?.algebra()))
}

/// The subalgebra with these vectors as its basis.
fn spanned<S: Held + GroundField>(
    structure: &StructureTheory<S>,
    vectors: &[Values],
) -> Result<Made, InputError> {
    let vectors = rows::<S>(vectors)?;
    let subspace = Subspace::span(structure.dimension(), vectors.clone());
    let m = subspace.dimension();
    if m == 0 {
        return Err(InputError::usage("the subalgebra is zero"));
    }
    let inside = structure.subalgebra(&subspace)?;
    if vectors.len() != m {
        return Err(InputError::usage("the vectors are linearly dependent"));
    }
    let coordinates = vectors.iter().filter_map(|row| subspace.coordinates(row)).enumerate();
    let entries =
        coordinates.flat_map(|(a, row)| row.into_iter().map(move |(i, value)| ([i, a], value)));
    let matrix = Tensor::from_components(m, &[Up, Down], entries)?;
    Ok(made(&inside.algebra().change_basis(&BasisChange::new(matrix)?)?))
}

/// The central extension by a cocycle: constants `w^i_jk` of the larger space, with `i` in the centre.
fn extension<S: Held + GroundField>(
    structure: &StructureTheory<S>,
    centre: &[String],
    cocycle: &Values,
) -> Result<Made, InputError> {
    let (n, cocycle) = (structure.dimension(), of::<S>(cocycle)?);
    let mut constants = vec![];
    for (at, value) in cocycle.components() {
        if at[0] < n || at[1] >= n || at[2] >= n {
            let message = "a cocycle maps two vectors of the algebra into the centre";
            return Err(InputError::usage(message));
        }
        constants.push((at[1], at[2], at[0] - n, value.clone()));
    }
    Ok(made(&structure.central_extension(centre, constants)?))
}

/// The semidirect sum: the structure constants of the algebra that is acted on, which has these labels, and the matrices.
fn semidirect<S: Held + GroundField>(
    structure: &StructureTheory<S>,
    labels: &[String],
    given: &[Values],
) -> Result<Made, InputError> {
    let Some((on, by)) = given.split_first() else {
        return Err(InputError::usage("the algebra acted on is missing"));
    };
    let constants = of::<S>(on)?;
    let constants = constants.components().map(|(at, value)| (at[1], at[2], at[0], value.clone()));
    let on = LieAlgebra::try_from(Bracket::from_constants(labels, constants)?)?;
    let matrix = |values: &Values| {
        let tensor: Arc<Tensor<S>> = of(values)?;
        let mut rows = vec![vec![]; tensor.dimension()];
        for (at, value) in tensor.components() {
            rows[at[0]].push((at[1], value.clone()));
        }
        Ok(Matrix::from_rows(tensor.dimension(), rows).map_err(affinor::Error::from)?)
    };
    let by = by.iter().map(matrix).collect::<Result<Vec<_>, InputError>>()?;
    Ok(made(&structure.semidirect(&StructureTheory::new(on), &by)?))
}
