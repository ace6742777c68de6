//! Constructions of new Lie algebras from old ones.

use crate::algebra::PyAlgebra;
use crate::class::{New, Optional, in_python};
use crate::components::{Held, Values, of};
use crate::geometries::{Geometries, Made, algebra, in_floats, made, symbolic};
use crate::run::run;
use crate::tensor::PyTensor;
use crate::values::{merged, python};
use affinor::algebra::structure::{GroundField, StructureTheory, Subspace};
use affinor::{BasisChange, Bracket, LieAlgebra};
use affinor_documents::input::InputError;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Kind, Rational, Symbolic, Tensor, Up};
use pyo3::prelude::*;
use std::sync::Arc;

/// The name of a construction in errors.
const WHAT: &str = "a construction";

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

/// The components of vectors.
fn rows<S: Held>(vectors: &[Values]) -> Result<Vec<Row<S>>, InputError> {
    let row = |vector: &Values| -> Result<Row<S>, InputError> {
        let vector = of::<S>(vector)?;
        Ok(vector.components().map(|(at, value)| (at[0], value.clone())).collect())
    };
    vectors.iter().map(row).collect()
}
