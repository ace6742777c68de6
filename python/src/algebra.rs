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

/// A Lie algebra with a basis; the Jacobi identity is checked.
///
/// Structure constants are ``c[i, j, k]``, with ``[e_j, e_k] = c^i_jk e_i``.
///
/// Parameters
/// ----------
/// space : str, path, dict or array
///     A name of the catalogue, a sum of names (``"so3+R^3"``), or the path of a definition file; brackets, in one text or
///     in a list; the keys of a definition file; structure constants (:meth:`from_structure`). A file is read once:
///     geometries and groups of this algebra do not read it again.
/// basis : str or list, optional
///     The names of the basis vectors, which brackets need.
/// scalar : str
///     ``"exact"`` (with parameters ``symbolic``) or ``"float"``.
/// tolerance : float, optional
///     For floats: the bound below which a sum counts as zero, relative to its terms.
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
    /// The algebra with the connection zero and without a metric.
    pub values: Geometries,
    /// The report of the structure, which is computed once.
    pub found: PyOnceLock<(Written, Py<PyAny>)>,
}

immutable! { PyAlgebra }

properties! { PyAlgebra, own:
    /// The name.
    name: &str = &own.space.definition.name;
    /// The names of the basis vectors.
    basis: Vec<String> = own.values.labels();
    /// The dimension.
    dimension: usize = own.values.labels().len();
    /// ``exact``, ``symbolic`` or ``float``.
    scalar: &'static str = own.values.scalar();
    /// The names of the parameters, sorted.
    parameters: Vec<String> = own.space.definition.parameters();
}

constructors! { PyAlgebra:
    /// The algebra with the structure constants ``c[i, j, k]``, ``[e_j, e_k] = c^i_jk e_i``, indices from 0.
    ///
    /// They are an array of the shape (n, n, n); a pair of indices (3, count) and values; a sparse array of SciPy of the
    /// shape (n, n, n), or (n, n*n) with the column ``j*n + k``; a list of tuples ``(i, j, k, value)``; a dict; a Tensor.
    /// Each pair may be given in one order or in both.
    from_structure("($cls, constants, *, basis=None, name=None, dimension=None, scalar='exact', tolerance=None)")
        = "_source"."from_structure";
    /// The algebra of a basis of matrices under the commutator, over the reals.
    ///
    /// Matrices are arrays of NumPy, matrices of SymPy or nested lists; entries may be complex.
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

    /// The symbols of SymPy that were given, by name.
    #[getter]
    fn symbols<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.source.get().symbols.bind(py).copy()
    }

    #[getter]
    fn _source(&self, py: Python<'_>) -> Py<PySource> {
        self.source.clone_ref(py)
    }

    /// The structure constants ``c^i_jk``.
    #[getter]
    pub fn structure(&self, py: Python<'_>) -> PyResult<PyTensor> {
        self.quantity(py, Quantity::Structure)
    }

    /// The Killing form ``K_ij = tr(ad_i ad_j)``.
    #[getter]
    fn killing_form(&self, py: Python<'_>) -> PyResult<PyTensor> {
        self.quantity(py, Quantity::Killing)
    }

    /// The matrix of ``[x, .]``: ``(ad_x)^i_k = c^i_jk x^j``.
    fn ad<'py>(slf: &Bound<'py, Self>, x: Object<'py>) -> PyResult<PyTensor> {
        Self::contract(slf, "^i_jk ^j -> ^i_k", &[x])
    }

    /// The bracket of two vectors by their components.
    fn bracket<'py>(slf: &Bound<'py, Self>, x: Object<'py>, y: Object<'py>) -> PyResult<PyTensor> {
        Self::contract(slf, "^i_jk ^j ^k -> ^i", &[x, y])
    }

    /// The direct sum, in the basis of this algebra followed by that of the other.
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

    /// The same algebra in the basis ``e'_a = A^i_a e_i``: column ``a`` of the matrix has the components of ``e'_a``.
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
            // parameters of the matrix
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

    /// The algebra with parameters replaced, by name or by symbol.
    fn subs<'py>(slf: &Bound<'py, Self>, values: &Object<'py>) -> New<'py> {
        if !values.is_truthy()? {
            return Ok(slf.clone().into_any());
        }
        let source = PySource::subs(slf.get().source.bind(slf.py()), values)?;
        slf.get_type().call1((source,))
    }

    /// A group with this algebra, in its basis.
    fn group(&self, py: Python<'_>) -> PyResult<PyGroup> {
        PyGroup::of_source(py, self.source.clone_ref(py))
    }

    /// The checks of the certificate.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Vec<Object<'py>>> {
        self.source.get().checks(py)
    }

    /// Equal names of the basis vectors and equal structure constants.
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

    /// The nonzero brackets, one a line.
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
        let reason = || format!("{} is not defined here", quantity.key());
        found.ok_or_else(|| error(py, "MathematicsError", (reason(),)))
    }

    /// The contraction of the structure constants with vectors.
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

    /// The algebra of structure constants, with the tolerance of this one.
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

/// The families of named algebras that contain a text: pattern, description, example.
#[pyfunction]
#[pyo3(signature = (pattern=""))]
pub fn catalogue(pattern: &str) -> Vec<(&'static str, &'static str, &'static str)> {
    let pattern = pattern.to_lowercase();
    let families = affinor::algebra::catalogue::families().iter();
    let rows = families.map(|family| (family.pattern, family.summary, family.example));
    let matches = |text: &str| text.to_lowercase().contains(&pattern);
    rows.filter(|row| matches(row.0) || matches(row.1) || matches(row.2)).collect()
}
