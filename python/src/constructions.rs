//! Constructions of new Lie algebras from given ones.

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

/// The data of a construction that needs no data.
type Nothing = Option<bool>;

/// Defines constructions of new algebras: each row has the arguments and the constructor. A Python function with the
/// same name reads the arguments. It returns the name of the new algebra, further data, and tensors.
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
    /// Subalgebra whose basis is the given vectors.
    ///
    /// Parameters
    /// ----------
    /// vectors : list
    ///     Linearly independent vectors: components, or strings such as ``"e1 + 2*e2"``.
    /// basis : str or list of str, optional
    ///     Names of the vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     The span is not closed under the bracket.
    /// InputError
    ///     The vectors are linearly dependent.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("sl(3)").subalgebra(["E12 + E21", "E12 - E21", "2*H1"], basis="x y z").dimension
    /// 3
    #[pyo3(signature = (vectors, *, basis=None))]
    fn subalgebra(vectors) = |structure: S, _data: Nothing, given| spanned::<S>(structure, &given);
    /// Smallest subalgebra that contains the given vectors.
    ///
    /// Parameters
    /// ----------
    /// vectors : list
    ///     Vectors: components, or strings such as ``"e1 + 2*e2"``.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("sl(3)").generated(["E12", "E21"]).dimension
    /// 3
    #[pyo3(signature = (vectors, *, basis=None))]
    fn generated(vectors) = |structure: S, _data: Nothing, given| {
        inside(structure, &structure.generated(rows::<S>(&given)?))
    };
    /// Subalgebra of all vectors that commute with the given vectors.
    ///
    /// Parameters
    /// ----------
    /// vectors : list
    ///     Vectors: components, or strings such as ``"e1 + 2*e2"``.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// InputError
    ///     The subalgebra is zero.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("sl(3)").centralizer(["H1"]).dimension
    /// 2
    #[pyo3(signature = (vectors, *, basis=None))]
    fn centralizer(vectors) = |structure: S, _data: Nothing, given| {
        let vectors = Subspace::span(structure.dimension(), rows::<S>(&given)?);
        inside(structure, &structure.centralizer(&vectors))
    };
    /// Derived subalgebra ``[L, L]``.
    ///
    /// Parameters
    /// ----------
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// InputError
    ///     The algebra is abelian.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("se(2)").derived_subalgebra().dimension
    /// 2
    #[pyo3(signature = (*, basis=None))]
    fn derived_subalgebra() = |structure: S, _data: Nothing, _given| {
        inside::<S>(structure, structure.derived())
    };
    /// Quotient by the ideal that the given vectors span.
    ///
    /// Parameters
    /// ----------
    /// vectors : list
    ///     Vectors that span the ideal: components, or strings such as ``"e1 + 2*e2"``.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     The span is not an ideal.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("heisenberg(3)").quotient([[0, 0, 1]]).is_abelian
    /// True
    #[pyo3(signature = (vectors, *, basis=None))]
    fn quotient(vectors) = |structure: S, _data: Nothing, given| {
        let ideal = Subspace::span(structure.dimension(), rows::<S>(&given)?);
        if ideal.dimension() == structure.dimension() {
            return Err(InputError::usage("the quotient by the whole algebra is zero"));
        }
        Ok(made(&structure.quotient(&ideal)?))
    };
    /// Central extension: the bracket ``[x, y]`` has an additional component ``omega(x, y)`` in the centre.
    ///
    /// Parameters
    /// ----------
    /// cocycle : str, array or dict
    ///     A string such as ``"[e1, e2] = z"``, or components as an array or a dict. The components are ``omega[j, k]``
    ///     for one central vector, and ``omega[a, j, k]`` for several.
    /// centre : str or list of str
    ///     Names of the central vectors.
    /// basis : str or list of str, optional
    ///     Names of all vectors of the extension.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     The basis of this algebra, followed by the centre.
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     The form is not a cocycle.
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra("R^2").central_extension({(0, 1): 1}))
    /// [e1, e2] = z
    #[pyo3(
        signature = (cocycle, centre=None, *, basis=None),
        text_signature = "($self, cocycle, centre='z', *, basis=None)"
    )]
    fn central_extension(cocycle, centre) = |structure: S, centre: Vec<String>, given| {
        extension::<S>(structure, &centre, &given[0])
    };
    /// The semidirect sum with an algebra on which this algebra acts. The other algebra is given by its labels.
    #[pyo3(signature = (on, by, *, basis=None))]
    fn _semidirect(on, by) = |structure: S, labels: Vec<String>, given| {
        semidirect::<S>(structure, &labels, &given)
    };
    /// Cotangent algebra: the semidirect sum with the dual space, by the coadjoint action.
    ///
    /// Parameters
    /// ----------
    /// basis : str or list of str, optional
    ///     Names of all vectors of the sum.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     The basis of this algebra, followed by the dual basis.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").cotangent_algebra().dimension
    /// 6
    #[pyo3(signature = (*, basis=None))]
    fn cotangent_algebra() = |structure: S, _data: Nothing, _given| {
        Ok(made::<S>(&structure.with_dual()?))
    };
    /// Tensor product with a commutative associative algebra: ``[x u_a, y u_b] = [x, y] (u_a u_b)``.
    ///
    /// Parameters
    /// ----------
    /// units : str or list of str
    ///     Names of the basis ``u_a`` of the commutative algebra.
    /// products : array or dict
    ///     Component ``products[d, a, b]`` of ``u_a u_b`` along ``u_d``.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     The products are not commutative or not associative.
    ///
    /// Examples
    /// --------
    /// >>> so3 = LieAlgebra("so3")
    /// >>> so3.tensor_product("p q", {(0, 0, 0): 1, (1, 1, 1): 1}).dynkin_type
    /// 'A1 + A1'
    #[pyo3(signature = (units, products, *, basis=None))]
    fn tensor_product(units, products) = |structure: S, units: Vec<String>, given| {
        Ok(made(&structure.tensor_product(&units, &*of::<S>(&given[0])?)?))
    };
    /// Truncated current algebra: polynomials in ``t`` with values in this algebra and ``t^order = 0``.
    ///
    /// Parameters
    /// ----------
    /// order : int
    ///     Order of truncation, from 1 to 64: the lowest power of ``t`` that is zero.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     Algebra whose dimension is ``order`` times the dimension of this algebra.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").truncated(3).dimension
    /// 9
    #[pyo3(signature = (order, *, basis=None))]
    fn truncated(order) = |structure: S, order: usize, _given| {
        if !(1..=64).contains(&order) {
            return Err(InputError::usage(format!("the order of truncation is {order}, not from 1 to 64")));
        }
        Ok(made::<S>(&structure.truncated(order)?))
    };
    /// Complexification ``L + i L`` as a real algebra.
    ///
    /// Parameters
    /// ----------
    /// basis : str or list of str, optional
    ///     Names of all vectors of the complexification.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     Algebra of twice the dimension. Its basis is the vectors ``x``, followed by ``i x``.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").complexification().dynkin_type
    /// 'A1 + A1'
    #[pyo3(signature = (*, basis=None))]
    fn complexification() = |structure: S, _data: Nothing, _given| {
        Ok(made::<S>(&structure.complexified()?))
    };
    /// Inonu-Wigner contraction: ``e_i`` is scaled by ``t^w_i``, and ``t`` tends to 0.
    ///
    /// Parameters
    /// ----------
    /// weights : list of int
    ///     Weight ``w_i`` of each basis vector.
    /// basis : str or list of str, optional
    ///     Names of the basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     The brackets have no limit.
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra("so3").contraction([0, 1, 1], basis="r x y"))
    /// [r, x] = y
    /// [r, y] = -x
    #[pyo3(signature = (weights, *, basis=None))]
    fn contraction(weights) = |structure: S, weights: Vec<i64>, _given| {
        Ok(made::<S>(&structure.inonu_wigner_contraction(&weights)?))
    };
}

in_python! { PyAlgebra, "structure":
    /// Semidirect sum with an algebra on which this algebra acts: ``[e_j, v] = D_j v``.
    ///
    /// Parameters
    /// ----------
    /// on : LieAlgebra or str
    ///     Algebra on which this algebra acts. Without ``by``: ``"adjoint"`` means this algebra as a vector space, and
    ///     ``"coadjoint"`` means its dual space.
    /// by : list of arrays, optional
    ///     One matrix ``D_j`` for each basis vector of this algebra.
    /// basis : str or list of str, optional
    ///     Names of all vectors of the sum.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     The basis of this algebra, followed by the basis of ``on``.
    ///
    /// Raises
    /// ------
    /// ConstructionError
    ///     A matrix is not a derivation of ``on``, or the matrices are not an action.
    ///
    /// Examples
    /// --------
    /// >>> turn = [[0, -1], [1, 0]]
    /// >>> print(LieAlgebra("R^1").semidirect("R^2", [turn], basis="r x y"))
    /// [r, x] = y
    /// [r, y] = -x
    semidirect (on, by=None, *, basis=None) [on, by, basis];
    /// Tangent algebra: the semidirect sum with the algebra itself as a vector space, by the adjoint action.
    ///
    /// Parameters
    /// ----------
    /// basis : str or list of str, optional
    ///     Names of all vectors of the sum.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     Algebra of twice the dimension.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").tangent_algebra().dimension
    /// 6
    tangent_algebra (*, basis=None) [basis];
}

/// The algebra of a subspace that is closed under the bracket.
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

/// The central extension by a cocycle, which is given by constants `w^i_jk` over the larger space with `i` in the
/// centre.
fn extension<S: Held + GroundField>(
    structure: &StructureTheory<S>,
    centre: &[String],
    cocycle: &Values,
) -> Result<Made, InputError> {
    let (n, cocycle) = (structure.dimension(), of::<S>(cocycle)?);
    let mut constants = vec![];
    for (at, value) in cocycle.components() {
        if at[0] < n || at[1] >= n || at[2] >= n {
            let message = "the cocycle does not map two vectors of the algebra into the centre";
            return Err(InputError::usage(message));
        }
        constants.push((at[1], at[2], at[0] - n, value.clone()));
    }
    Ok(made(&structure.central_extension(centre, constants)?))
}

/// The semidirect sum. `given` are the structure constants of the algebra that is acted on, then the matrices; `labels`
/// are the names of its basis vectors.
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

/// The components of vectors, as sparse rows.
fn rows<S: Held>(vectors: &[Values]) -> Result<Vec<Row<S>>, InputError> {
    let row = |vector: &Values| -> Result<Row<S>, InputError> {
        let vector = of::<S>(vector)?;
        Ok(vector.components().map(|(at, value)| (at[0], value.clone())).collect())
    };
    vectors.iter().map(row).collect()
}
