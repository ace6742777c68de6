//! Lie algebras: their values, vectors and sums.

use crate::class::{New, Object, Optional, constructors, immutable, properties};
use crate::components::{Held, Values, of};
use crate::contraction::contract_all;
use crate::geometries::{Geometries, Made, algebra, made, symbolic};
use crate::group::PyGroup;
use crate::report::Written;
use crate::run::run;
use crate::source::{Given, PySource};
use crate::tensor::{Names, PyTensor};
use crate::values::{error, merged, python};
use affinor::{BasisChange, LieAlgebra};
use affinor_documents::input::InputError;
use affinor_documents::report::Quantity;
use affinor_documents::space::Space;
use affinor_tensors::Kind;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple, PyType};

/// Lie algebra with a basis.
///
/// Structure constants are ``c[i, j, k]``, with ``[e_j, e_k] = c^i_jk e_i``. The constructor checks the Jacobi identity.
///
/// Parameters
/// ----------
/// space : str, path, dict or array
///     Name in the catalogue, sum of such names (``"so3+R^3"``), or path of a definition file. Also brackets, as a
///     string or
///     a list of strings; a dict with the keys of a definition file; or structure constants as for
///     :meth:`from_structure`. A file is read only once: geometries and groups of this algebra do not read it again.
/// basis : str or list of str, optional
///     Names of the basis vectors; required for brackets.
/// scalar : str
///     ``"exact"`` (``symbolic`` if there are parameters) or ``"float"``.
/// tolerance : float, optional
///     For floats: a sum counts as zero below this bound, relative to its terms.
///
/// Raises
/// ------
/// InputError
///     The name, the file or the brackets cannot be read.
/// JacobiError
///     The brackets violate the Jacobi identity; ``triple`` and ``residual`` are the witness.
///
/// Examples
/// --------
/// >>> LieAlgebra("so3")
/// <LieAlgebra so(3), dimension 3, exact>
/// >>> LieAlgebra("[x,y]=z, [y,z]=x, [z,x]=y", basis="x y z").is_simple
/// True
#[pyclass(name = "LieAlgebra", frozen, subclass, module = "affinor")]
pub struct PyAlgebra {
    pub source: Py<PySource>,
    pub space: Space,
    /// The geometry of the algebra with the connection zero, and without a metric.
    pub values: Geometries,
    /// The report of the structure, which is computed once.
    pub found: PyOnceLock<(Written, Py<PyAny>)>,
}

immutable! { PyAlgebra }

properties! { PyAlgebra, own:
    /// Name of the algebra.
    name: &str = &own.space.definition.name;
    /// Names of the basis vectors.
    basis: Vec<String> = own.values.labels();
    /// Dimension of the algebra.
    dimension: usize = own.values.labels().len();
    /// Kind of the scalars of the structure constants: ``exact``, ``symbolic`` or ``float``.
    scalar: &'static str = own.values.scalar();
    /// Names of the parameters, sorted.
    parameters: Vec<String> = own.space.definition.parameters();
}

constructors! { PyAlgebra:
    /// Lie algebra defined by structure constants ``c[i, j, k]``, with ``[e_j, e_k] = c^i_jk e_i`` and indices from 0.
    ///
    /// Parameters
    /// ----------
    /// constants : array, sparse array, tuple, list, dict or Tensor
    ///     An array of the shape (n, n, n), or a pair of indices (3, count) and values. A sparse array of SciPy of the
    ///     shape (n, n, n), or (n, n*n) with the column ``j*n + k``. A list of tuples ``(i, j, k, value)``, a dict
    ///     ``{(i, j, k): value}``, or a Tensor. Each pair ``j, k`` may occur in one order or in both.
    /// basis : str or list of str, optional
    ///     Names of the basis vectors; by default ``e1``, ``e2``, ...
    /// name : str, optional
    ///     Name of the algebra.
    /// dimension : int, optional
    ///     Dimension; by default the dimension of the array or of the basis, otherwise the largest index plus one.
    /// scalar : str
    ///     ``"exact"`` or ``"float"``.
    /// tolerance : float, optional
    ///     For floats: a sum counts as zero below this bound, relative to its terms.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// AntisymmetryError
    ///     A pair is given in both orders, but the values do not agree.
    /// JacobiError
    ///     The brackets violate the Jacobi identity.
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra.from_structure([(2, 0, 1, 1)], basis="x y z"))
    /// [x, y] = z
    from_structure("($cls, constants, *, basis=None, name=None, dimension=None, scalar='exact', tolerance=None)")
        = "_source"."from_structure";
    /// Lie algebra that matrices span over the real numbers, with the commutator as bracket.
    ///
    /// Parameters
    /// ----------
    /// matrices : list of arrays
    ///     Basis of square matrices: NumPy arrays, SymPy matrices or nested lists. Entries may be complex.
    /// basis : str or list of str, optional
    ///     Names of the basis vectors; by default ``e1``, ``e2``, ...
    /// name : str, optional
    ///     Name of the algebra.
    /// scalar : str
    ///     ``"exact"`` or ``"float"``.
    /// tolerance : float, optional
    ///     For floats: a sum counts as zero below this bound, relative to its terms.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// DependentError
    ///     The matrices are linearly dependent over the reals.
    /// ClosureError
    ///     A commutator is not in the span of the matrices.
    ///
    /// Examples
    /// --------
    /// >>> x, y = [[1, 0], [0, 0]], [[0, 1], [0, 0]]
    /// >>> print(LieAlgebra.from_matrices([x, y], basis="x y"))
    /// [x, y] = y
    from_matrices("($cls, matrices, *, basis=None, name=None, scalar='exact', tolerance=None)")
        = "_source"."from_matrices";
}

#[pymethods]
impl PyAlgebra {
    #[new]
    #[pyo3(
        signature = (*arguments, **keys),
        text_signature = "(space, *, basis=None, scalar='exact', tolerance=None)"
    )]
    fn __new__<'py>(
        arguments: Bound<'py, PyTuple>,
        keys: Option<Bound<'py, PyDict>>,
    ) -> PyResult<Self> {
        let py = arguments.py();
        let source = match arguments.get_item(0).map(|first| first.cast_into::<PySource>()) {
            Ok(Ok(source)) => source,
            _ => python(py, "_source", "source_of")?.call(arguments, keys.as_ref())?.cast_into()?,
        };
        let space = source.get().space(py)?;
        let values = source.get().geometry(py, &space, Given::None)?;
        Ok(PyAlgebra { source: source.unbind(), space, values, found: PyOnceLock::new() })
    }

    /// SymPy symbols in the definition, by name.
    #[getter]
    fn symbols<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.source.get().symbols.bind(py).copy()
    }

    #[getter]
    fn _source(&self, py: Python<'_>) -> Py<PySource> {
        self.source.clone_ref(py)
    }

    /// Structure constants ``c^i_jk``: ``[e_j, e_k] = c^i_jk e_i``.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").structure[2, 0, 1]
    /// Fraction(1, 1)
    #[getter]
    pub fn structure(&self, py: Python<'_>) -> PyResult<PyTensor> {
        self.quantity(py, Quantity::Structure)
    }

    /// Killing form ``K_ij = tr(ad_i ad_j) = c^k_il c^l_jk``.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").killing_form[0, 0]
    /// Fraction(-2, 1)
    #[getter]
    fn killing_form(&self, py: Python<'_>) -> PyResult<PyTensor> {
        self.quantity(py, Quantity::Killing)
    }

    /// Matrix of ``y -> [x, y]``: ``(ad_x)^i_k = c^i_jk x^j``.
    ///
    /// Parameters
    /// ----------
    /// x : list, Tensor or str
    ///     Vector: its components, or a string such as ``"e1 + 2*e2"``.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///     Slots ``^_``; the upper index is the row.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").ad([0, 0, 1])[1, 0]
    /// Fraction(1, 1)
    fn ad<'py>(slf: &Bound<'py, Self>, x: Object<'py>) -> PyResult<PyTensor> {
        Self::contract(slf, "^i_jk ^j -> ^i_k", &[x])
    }

    /// Bracket of two vectors: ``[x, y]^i = c^i_jk x^j y^k``.
    ///
    /// Parameters
    /// ----------
    /// x, y : list, Tensor or str
    ///     Vectors: their components, or strings such as ``"e1 + 2*e2"``.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///     Vector with the slot ``^``.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").bracket([1, 0, 0], [0, 2, 0])[2]
    /// Fraction(2, 1)
    fn bracket<'py>(slf: &Bound<'py, Self>, x: Object<'py>, y: Object<'py>) -> PyResult<PyTensor> {
        Self::contract(slf, "^i_jk ^j ^k -> ^i", &[x, y])
    }

    /// Direct sum with another algebra; also written ``self + other``.
    ///
    /// Parameters
    /// ----------
    /// other : LieAlgebra
    ///     Second summand. Both summands must be exact, or both must be floats.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///     The basis of this algebra, followed by the basis of the other.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").direct_sum(LieAlgebra("R^2")).dimension
    /// 5
    fn direct_sum<'py>(slf: &Bound<'py, Self>, other: &Object<'py>) -> New<'py> {
        let Ok(other) = other.cast::<PyAlgebra>() else {
            let found = other.get_type().name()?;
            return Err(PyTypeError::new_err(format!("a LieAlgebra was expected, not {found}")));
        };
        let (py, first, second) = (slf.py(), slf.get(), other.get());
        let sources = [first, second].map(|algebra| algebra.source.get());
        if let [Some(a), Some(b)] =
            [first, second].map(|one| one.source.get().plain_name(&one.space))
            && sources[0].scalar == sources[1].scalar
        {
            return slf.get_type().call1((sources[0].renamed(py, format!("{a}+{b}")),));
        }
        let what = "a direct sum";
        fn sum<S: Held>(a: &LieAlgebra<S>, b: &LieAlgebra<S>) -> Result<Made, InputError> {
            Ok(made(&a.direct_sum(b)?))
        }
        let (labels, values) = run(py, || match (&first.values, &second.values) {
            (Geometries::Exact(a), Geometries::Exact(b)) => {
                sum(algebra(a, what)?, algebra(b, what)?)
            }
            (Geometries::Float(a), Geometries::Float(b)) => {
                sum(algebra(a, what)?, algebra(b, what)?)
            }
            (a, b) => sum(&symbolic(a, what)?, &symbolic(b, what)?),
        })?;
        let mixed = first.scalar() != second.scalar();
        let name = format!("{}+{}", first.name(), second.name());
        let symbols = merged(py, sources.map(|source| &source.symbols))?;
        Self::structured(slf, values, &symbols, &name, (!mixed).then_some(labels))
    }

    fn __add__<'py>(slf: &Bound<'py, Self>, other: &Bound<'py, PyAlgebra>) -> New<'py> {
        Self::direct_sum(slf, other)
    }

    /// The same algebra in the basis ``e'_a = A^i_a e_i``.
    ///
    /// Parameters
    /// ----------
    /// matrix : array or Tensor
    ///     Regular matrix ``A`` of the shape (n, n). The column ``a`` has the components of ``e'_a``.
    /// basis : str or list of str, optional
    ///     Names of the new basis vectors.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     The matrix is singular.
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra("so3").change_basis([[2, 0, 0], [0, 2, 0], [0, 0, 1]], basis="x y z"))
    /// [x, y] = 4*z
    /// [x, z] = -y
    /// [y, z] = x
    #[pyo3(signature = (matrix, *, basis=None))]
    fn change_basis<'py>(
        slf: &Bound<'py, Self>,
        matrix: &Object<'py>,
        basis: Optional<'py>,
    ) -> New<'py> {
        let py = slf.py();
        let tensor = python(py, "structure", "matrix")?.call1((slf, matrix))?;
        let tensor = tensor.cast_into::<PyTensor>()?;
        let (own, matrix) = (slf.get(), &tensor.get().values);
        fn changed<S: Held>(algebra: &LieAlgebra<S>, matrix: &Values) -> Result<Made, InputError> {
            let change = BasisChange::new((*of::<S>(matrix)?).clone())?;
            Ok(made(&algebra.change_basis(&change)?))
        }
        let what = "a change of basis";
        let (_, values) = run(py, || match &own.values {
            // the matrix has parameters that the algebra does not have, so the algebra is converted first
            Geometries::Exact(_) if matrix.kind() == Kind::Symbolic => {
                changed(&symbolic(&own.values, what)?, matrix)
            }
            Geometries::Exact(geometry) => changed(algebra(geometry, what)?, matrix),
            Geometries::Symbolic(geometry) => changed(algebra(geometry, what)?, matrix),
            Geometries::Float(geometry) => changed(algebra(geometry, what)?, matrix),
        })?;
        let symbols = merged(py, [&own.source.get().symbols, &tensor.get().symbols])?;
        Self::structured(slf, values, &symbols, own.name(), basis)
    }

    /// The algebra with parameters replaced by values.
    ///
    /// Parameters
    /// ----------
    /// values : dict
    ///     Numbers or expressions. The keys are names or symbols of parameters.
    ///
    /// Returns
    /// -------
    /// LieAlgebra
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra("[x,y]=h*y", basis="x y").subs({"h": 2}))
    /// [x, y] = 2*y
    fn subs<'py>(slf: &Bound<'py, Self>, values: &Object<'py>) -> New<'py> {
        if !values.is_truthy()? {
            return Ok(slf.clone().into_any());
        }
        let source = PySource::subs(slf.get().source.bind(slf.py()), values)?;
        slf.get_type().call1((source,))
    }

    /// Lie group of this algebra, with vectors in its basis.
    ///
    /// Returns
    /// -------
    /// Group
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("[x,y]=z, [y,z]=x, [z,x]=y", basis="x y z").group().dimension
    /// 3
    fn group(&self, py: Python<'_>) -> PyResult<PyGroup> {
        PyGroup::of_source(py, self.source.clone_ref(py))
    }

    /// Certificate of the definition: antisymmetry, the Jacobi identity and further identities.
    ///
    /// Returns
    /// -------
    /// list of Check
    ///
    /// Examples
    /// --------
    /// >>> all(LieAlgebra("so3").check())
    /// True
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Vec<Object<'py>>> {
        self.source.get().checks(py)
    }

    /// Algebras are equal if they have equal names of basis vectors and equal structure constants.
    fn __eq__(&self, py: Python<'_>, other: &PyAlgebra) -> PyResult<bool> {
        let equal = self.basis() == other.basis();
        Ok(equal && self.structure(py)?.equals(&other.structure(py)?))
    }

    fn __hash__<'py>(&self, py: Python<'py>) -> PyResult<isize> {
        (PyTuple::new(py, self.basis())?, self.structure(py)?).into_pyobject(py)?.hash()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, (Py<PySource>,)) {
        (slf.get_type(), (slf.get().source.clone_ref(slf.py()),))
    }

    fn __repr__(&self) -> String {
        let (name, scalar) = (self.name(), self.scalar());
        format!("<LieAlgebra {name}, dimension {}, {scalar}>", self.dimension())
    }

    /// The nonzero brackets, one per line.
    fn __str__(&self) -> String {
        self.values.brackets().unwrap_or_default()
    }

    fn _repr_latex_(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.structure(py)?._repr_latex_())
    }
}

impl PyAlgebra {
    fn quantity(&self, py: Python<'_>, quantity: Quantity) -> PyResult<PyTensor> {
        let found = self.values.quantity(py, quantity, &self.source.get().symbols)?;
        let reason = || format!("the quantity {} is not defined for this algebra", quantity.key());
        found.ok_or_else(|| error(py, "MathematicsError", (reason(),)))
    }

    /// Contracts the structure constants with vectors.
    fn contract<'py>(
        slf: &Bound<'py, Self>,
        expression: &str,
        vectors: &[Object<'py>],
    ) -> PyResult<PyTensor> {
        let (py, vector) = (slf.py(), python(slf.py(), "structure", "vector")?);
        let mut factors = vec![Bound::new(py, slf.get().structure(py)?)?.into_any()];
        for x in vectors {
            factors.push(vector.call1((slf, x))?);
        }
        let expression = expression.into_pyobject(py)?.into_any();
        contract_all(expression, PyTuple::new(py, factors)?, None)
    }

    /// Creates an algebra with these structure constants and the tolerance of this algebra.
    pub fn structured<'py>(
        slf: &Bound<'py, Self>,
        values: Values,
        symbols: &Bound<'py, PyDict>,
        name: &str,
        labels: impl IntoPyObject<'py>,
    ) -> New<'py> {
        let py = slf.py();
        let tensor = PyTensor::new(py, values, symbols, Names::of("T"))?;
        let tolerance = slf.get().source.get().tolerance;
        let arguments = (tensor, name, labels, tolerance);
        slf.get_type().call1((python(py, "_source", "structured")?.call1(arguments)?,))
    }
}

/// Families of named algebras in the catalogue.
///
/// Parameters
/// ----------
/// pattern : str
///     String that the name, the description or the example of a family contains; by default all families are listed.
///
/// Returns
/// -------
/// list of (str, str, str)
///     Pattern, description and example of each family.
///
/// Examples
/// --------
/// >>> [row[0] for row in catalogue("Heisenberg")]
/// ['heisenberg(2m+1)']
#[pyfunction]
#[pyo3(signature = (pattern=""))]
pub fn catalogue(pattern: &str) -> Vec<(&'static str, &'static str, &'static str)> {
    let pattern = pattern.to_lowercase();
    let families = affinor::algebra::catalogue::families().iter();
    let rows = families.map(|family| (family.pattern, family.summary, family.example));
    let matches = |text: &str| text.to_lowercase().contains(&pattern);
    rows.filter(|row| matches(row.0) || matches(row.1) || matches(row.2)).collect()
}
