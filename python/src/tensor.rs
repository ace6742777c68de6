//! The class of tensors.

use crate::arrays::fresh;
use crate::class::{New, Object, Optional, immutable, in_python, properties};
use crate::components::{
    Held, Values, build, each, marks, of, parameters, text, widest, write_floats,
};
use crate::errors::refused;
use crate::run::run;
use crate::values::{self, python};
use affinor_documents::input::InputError;
use affinor_documents::over_kind;
use affinor_tensors::{Kind, Notation, Rational, Symbolic, TrackedFloat};
use numpy::{PyArrayDescr, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyEllipsis, PyInt, PyIterator, PyList, PySlice, PyTuple};
use std::hash::{DefaultHasher, Hash, Hasher};

/// The names of a tensor in displays. In Python they are a dict.
#[derive(Clone, FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub struct Names {
    pub symbol: String,
    pub latex: String,
    pub title: Option<String>,
    pub letters: Option<String>,
}

impl Names {
    /// Names that contain only a symbol.
    pub fn of(symbol: &str) -> Self {
        Names { symbol: symbol.into(), latex: symbol.into(), title: None, letters: None }
    }
}

/// Sparse tensor over exact numbers, rational functions of parameters, or floats.
///
/// Indices count from 0 in Python, and from 1 in all printed output. ``tensor[i, j]`` is a component; ``tensor[i, ...,
/// :]`` is a tensor of lower rank.
///
/// Parameters
/// ----------
/// components : array or dict
///     Numbers (int, Fraction, integral floats), SymPy expressions, or strings. A dict has the components as values and
///     their indices as keys.
/// slots : str
///     One mark per index: ``"^"`` for an upper index and ``"_"`` for a lower index. For example, a curvature has the
///     slots ``"^___"``.
/// dimension : int, optional
///     Dimension; required for a dict.
/// scalar : str, optional
///     ``"float"`` creates a tensor of floats.
/// symbol : str
///     Symbol of the tensor in displays.
///
/// Raises
/// ------
/// TypeError
///     A component is a float that is not an integer, and ``scalar`` is not ``"float"``.
///
/// Examples
/// --------
/// >>> Tensor([[1, 2], [3, 4]], "^_").trace(0, 1)[()]
/// Fraction(5, 1)
/// >>> Tensor({(0, 1): "a"}, "__", dimension=3).parameters
/// ['a']
#[pyclass(name = "Tensor", frozen, mapping, subclass, module = "affinor")]
pub struct PyTensor {
    pub values: Values,
    pub symbols: Py<PyDict>,
    pub names: Names,
}

/// The indices and the values of the nonzero components.
type Coordinates<'py> = (Bound<'py, PyArrayDyn<i64>>, Bound<'py, PyArrayDyn<f64>>);

/// The dimension, the slots, the indices, the values and the kind of scalars of a tensor, and the SymPy symbols in it.
type Parts<'py> =
    (usize, String, PyArrayLikeDyn<'py, i64>, Object<'py>, String, Bound<'py, PyDict>);

impl PyTensor {
    /// Creates a tensor. Of the given symbols, those that are its parameters are stored.
    pub fn new(
        py: Python<'_>,
        values: Values,
        symbols: &Bound<'_, PyDict>,
        names: Names,
    ) -> PyResult<Self> {
        let own = PyDict::new(py);
        if !symbols.is_empty() {
            for name in parameters(&values) {
                if let Some(symbol) = symbols.get_item(&name)? {
                    own.set_item(name, symbol)?;
                }
            }
        }
        Ok(PyTensor { values, symbols: own.unbind(), names })
    }

    fn made(py: Python<'_>, parts: Parts<'_>, names: Names) -> PyResult<Self> {
        let (dimension, marks, indices, values, scalar, symbols) = parts;
        let values = build(py, dimension, &marks, indices.as_array(), &values, &scalar)?;
        Self::new(py, values, &symbols, names)
    }

    /// The component at these indices, which count from 0.
    pub fn value<'py>(&self, py: Python<'py>, at: &[usize]) -> New<'py> {
        let failed = |error| refused(py, InputError::from(error));
        match &self.values {
            Values::Exact(tensor) => values::fraction(py, tensor.try_get(at).map_err(failed)?),
            Values::Symbolic(tensor) => {
                let text = tensor.try_get(at).map_err(failed)?.to_string();
                values::python(py, "_scalars", "value_of")?.call1((text, &self.symbols))
            }
            Values::Float(tensor) => {
                let value = tensor.try_get(at).map_err(failed)?.to_f64();
                Ok(value.into_pyobject(py)?.into_any())
            }
        }
    }
}

/// Replaces `...` by full slices for all remaining indices.
fn filled<'py>(at: &Bound<'py, PyTuple>, rank: usize) -> PyResult<Bound<'py, PyTuple>> {
    let py = at.py();
    let dots = PyEllipsis::get(py);
    let Some(place) = at.iter().position(|item| item.is(&*dots)) else { return Ok(at.clone()) };
    if at.iter().skip(place + 1).any(|item| item.is(&*dots)) {
        return Err(PyIndexError::new_err("an index has '...' once at most"));
    }
    let full = PySlice::full(py).into_any();
    let before = at.iter().take(place);
    let between = std::iter::repeat_n(full, (rank + 1).saturating_sub(at.len()));
    PyTuple::new(py, before.chain(between).chain(at.iter().skip(place + 1)).collect::<Vec<_>>())
}

/// The index letters of tensors whose indices have no other letters.
pub const LETTERS: &str = "ijklmnpq";

/// Index letters with their marks: `^i_j_k`, or in runs `^i_jk`.
pub fn written(letters: &str, slots: &str, runs: bool) -> String {
    let mut last = None;
    let mut text = String::new();
    for (letter, mark) in letters.chars().zip(slots.chars()) {
        if !(runs && last == Some(mark)) {
            text.push(mark);
        }
        text.push(letter);
        last = Some(mark);
    }
    text
}

immutable! { PyTensor }

properties! { PyTensor, own:
    /// Dimension; indices run from 0 to ``dimension - 1``.
    dimension: usize = each!(&own.values, tensor => tensor.dimension());
    /// One mark for each index: ``^`` for an upper index and ``_`` for a lower index.
    slots: String = each!(&own.values, tensor => marks(tensor.slots()));
    /// Number of indices.
    rank: usize = each!(&own.values, tensor => tensor.slots().len());
    /// Number of nonzero components.
    nnz: usize = each!(&own.values, tensor => tensor.len());
    /// Kind of the scalars of the components: ``exact``, ``symbolic`` or ``float``.
    scalar: &'static str = text(own.values.kind());
    /// Names of the parameters, sorted.
    parameters: Vec<String> = parameters(&own.values).into_iter().collect();
    /// Whether all components vanish.
    is_zero: bool = own.nnz() == 0;
    _letters: String = own.letters();
}

#[pymethods]
impl PyTensor {
    #[new]
    #[pyo3(signature = (components, slots, *, dimension=None, scalar=None, symbol="T"))]
    fn __new__<'py>(
        components: &Object<'py>,
        slots: Object<'py>,
        dimension: Optional<'py>,
        scalar: Optional<'py>,
        symbol: &str,
    ) -> PyResult<Self> {
        let py = components.py();
        let parts = python(py, "tensor", "parts")?;
        let parts = parts.call1((components, slots, dimension, scalar))?.extract()?;
        Self::made(py, parts, Names::of(symbol))
    }

    /// Tensor from components in coordinate form. Components with equal indices are added.
    ///
    /// Parameters
    /// ----------
    /// indices : array of the shape (rank, count)
    ///     Indices from 0.
    /// values : array of the shape (count,)
    ///     Components at the indices.
    /// slots : str
    ///     One mark for each index: ``"^"`` or ``"_"``.
    /// dimension : int
    ///     Dimension.
    /// scalar : str, optional
    ///     ``"float"`` creates a tensor of floats.
    /// symbol : str
    ///     Symbol of the tensor in displays.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///
    /// Examples
    /// --------
    /// >>> Tensor.from_coo([[0, 0], [1, 1]], [2, 3], "__", 3)[0, 1]
    /// Fraction(5, 1)
    #[staticmethod]
    #[pyo3(signature = (indices, values, slots, dimension, *, scalar=None, symbol="T"))]
    fn from_coo<'py>(
        indices: &Object<'py>,
        values: Object<'py>,
        slots: Object<'py>,
        dimension: Object<'py>,
        scalar: Optional<'py>,
        symbol: &str,
    ) -> PyResult<Self> {
        let py = indices.py();
        let parts = python(py, "tensor", "parts_of_coo")?;
        let parts = parts.call1((indices, values, slots, dimension, scalar))?.extract()?;
        Self::made(py, parts, Names::of(symbol))
    }

    /// Shape of the dense array, ``(dimension,) * rank``.
    #[getter]
    fn shape<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, vec![self.dimension(); self.rank()])
    }

    /// Data type of :meth:`to_numpy`: object if there are parameters, otherwise float64.
    #[getter]
    fn dtype<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDescr> {
        let numbers = parameters(&self.values).is_empty();
        if numbers { numpy::dtype::<f64>(py) } else { PyArrayDescr::object(py) }
    }

    #[getter(_symbols)]
    fn symbols_of(&self, py: Python<'_>) -> Py<PyDict> {
        self.symbols.clone_ref(py)
    }

    fn __len__(&self) -> PyResult<usize> {
        match self.rank() {
            0 => Err(PyTypeError::new_err("a tensor of rank 0 has no length")),
            _ => Ok(self.dimension()),
        }
    }

    fn __bool__(&self) -> PyResult<bool> {
        Err(PyTypeError::new_err("the truth value of a tensor is ambiguous: use is_zero"))
    }

    // with None, the product of a NumPy scalar and a tensor is a tensor, not a dense array
    #[classattr]
    fn __array_ufunc__() -> Option<bool> {
        None
    }

    /// Iterates over the components of a vector or covector; for other tensors, over the tensors in which the first
    /// index is fixed.
    fn __iter__<'py>(slf: &Bound<'py, Self>) -> New<'py> {
        python(slf.py(), "tensor", "rows")?.call1((slf,))
    }

    /// The component at these indices, or the tensor in which some indices are fixed: ``R[0, :, :, 1]``, ``R[0, ...,
    /// -1]``.
    ///
    /// Indices count from 0; negative indices count from the end. Displays and the command line count from 1.
    fn __getitem__<'py>(&self, at: Object<'py>) -> New<'py> {
        let (py, rank, dimension) = (at.py(), self.rank(), self.dimension());
        let at = match at.cast_into::<PyTuple>() {
            Ok(at) => at,
            Err(error) => PyTuple::new(py, [error.into_inner()])?,
        };
        let at = filled(&at, rank)?;
        if at.len() != rank {
            let reason = format!("a tensor of rank {rank} takes {rank} indices, not {}", at.len());
            return Err(PyIndexError::new_err(reason));
        }
        let place = |item: Object<'py>| -> PyResult<Option<usize>> {
            if item.is_instance_of::<PySlice>() {
                let all = item.eq(PySlice::full(py))?;
                let reason = "a slice of a sparse tensor is ':'";
                return if all { Ok(None) } else { Err(PyIndexError::new_err(reason)) };
            }
            let index = match item.is_exact_instance_of::<PyInt>() {
                true => item,
                false => python(py, "_scalars", "index")?.call1(("an index", item))?,
            };
            let size = dimension as isize;
            let found = index.extract().ok().filter(|found: &isize| (-size..size).contains(found));
            let found = found.map(|found| found.rem_euclid(size) as usize);
            let reason = || format!("the index {index} is not in {}..{}", -size, size - 1);
            found.map(Some).ok_or_else(|| PyIndexError::new_err(reason()))
        };
        let at = at.iter().map(place).collect::<PyResult<Vec<_>>>()?;
        if let Some(at) = at.iter().copied().collect::<Option<Vec<usize>>>() {
            return self.value(py, &at);
        }
        let mut part = self.values.clone();
        for (slot, index) in at.into_iter().enumerate().rev() {
            if let Some(index) = index {
                let slice = each!(&part, tensor => tensor.slice(slot, index).map(Held::wrap));
                part = slice.map_err(|error| refused(py, error))?;
            }
        }
        let names = Names { title: None, letters: None, ..self.names.clone() };
        let part = Self::new(py, part, self.symbols.bind(py), names)?;
        Ok(Bound::new(py, part)?.into_any())
    }

    /// Nonzero components, in the order of their indices.
    ///
    /// Returns
    /// -------
    /// iterator of (tuple of ints, value)
    ///     Indices from 0, and the component.
    ///
    /// Examples
    /// --------
    /// >>> list(Tensor([[0, 1], [2, 0]], "__").items())
    /// [((0, 1), Fraction(1, 1)), ((1, 0), Fraction(2, 1))]
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        let places = each!(&self.values, tensor => {
            let places = tensor.components().map(|(at, _)| PyTuple::new(py, at.to_vec()));
            places.collect::<PyResult<Vec<_>>>()
        })?;
        let items = places.into_iter().zip(self._values(py)?).collect::<Vec<_>>();
        PyList::new(py, items)?.try_iter()
    }

    /// The indices of the nonzero components, from 0, as an array of the shape (rank, count).
    fn _indices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<i64>>> {
        let out = fresh(py, &[self.rank()], &[self.nnz()])?;
        {
            let mut list = out.readwrite();
            let list = list.as_slice_mut()?;
            run(py, || {
                each!(&self.values, tensor => tensor.write_coordinates(list));
                Ok(())
            })?;
        }
        Ok(out)
    }

    /// The indices and the values as floats of the nonzero components.
    fn _coo<'py>(&self, py: Python<'py>) -> PyResult<Coordinates<'py>> {
        let indices = fresh(py, &[self.rank()], &[self.nnz()])?;
        let floats = fresh(py, &[self.nnz()], &[])?;
        {
            let (mut list, mut values) = (indices.readwrite(), floats.readwrite());
            let (list, values) = (list.as_slice_mut()?, values.as_slice_mut()?);
            run(py, || {
                each!(&self.values, tensor => {
                    rayon::join(|| tensor.write_coordinates(list), || write_floats(tensor, values)).1
                })
            })?;
        }
        Ok((indices, floats))
    }

    /// The nonzero components: fractions, floats, or expressions of SymPy.
    fn _values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Object<'py>>> {
        match &self.values {
            Values::Exact(tensor) => {
                tensor.nonzero().map(|value| values::fraction(py, value)).collect()
            }
            Values::Symbolic(tensor) => {
                let value_of = python(py, "_scalars", "value_of")?;
                let value = |value: &Symbolic| value_of.call1((value.to_string(), &self.symbols));
                tensor.nonzero().map(value).collect()
            }
            Values::Float(tensor) => {
                let values = tensor.nonzero().map(|value| value.to_f64().into_pyobject(py));
                Ok(values.collect::<Result<Vec<_>, _>>()?)
            }
        }
    }

    /// The nonzero components as texts.
    fn _texts(&self) -> Vec<String> {
        each!(&self.values, tensor => tensor.nonzero().map(|value| value.to_string()).collect())
    }

    /// The tensor whose nonzero components are replaced by these texts.
    fn _with_texts<'py>(
        &self,
        texts: &Object<'py>,
        symbols: &Bound<'py, PyDict>,
    ) -> PyResult<Self> {
        let (py, indices) = (texts.py(), self._indices(texts.py())?.readonly());
        let indices = indices.as_array();
        let values = build(py, self.dimension(), &self.slots(), indices, texts, "exact")?;
        Self::new(py, values, symbols, self.names.clone())
    }

    /// The same tensor over floats.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///
    /// Examples
    /// --------
    /// >>> Tensor([1, "1/2"], "^").to_float()[1]
    /// 0.5
    fn to_float(&self, py: Python<'_>) -> PyResult<Self> {
        let values = of::<TrackedFloat>(&self.values).map(Values::Float);
        let values = values.map_err(|error| refused(py, error))?;
        Self::new(py, values, &PyDict::new(py), self.names.clone())
    }

    /// Tensors are equal if they have equal shapes and equal components. A tensor of floats is never equal to an exact
    /// tensor.
    #[pyo3(name = "__eq__")]
    pub fn equals(&self, other: &PyTensor) -> bool {
        let both = [&self.values, &other.values];
        let floats = both.map(|values| values.kind() == Kind::Float);
        floats[0] == floats[1]
            && over_kind!(widest(both), S => {
                S::of(both[0]).zip(S::of(both[1])).is_some_and(|(a, b)| a == b)
            })
    }

    fn __hash__(&self) -> u64 {
        let mut state = DefaultHasher::new();
        (self.dimension(), self.slots(), self.nnz()).hash(&mut state);
        if self.nnz() <= 64 {
            self._texts().hash(&mut state);
        }
        state.finish()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Object<'py>, Stored<'py>)> {
        let bytes = each!(&self.values, tensor => serde_json::to_vec(&**tensor));
        let bytes = bytes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let symbols = self.symbols.bind(py).clone();
        let scalar = self.scalar().to_string();
        let stored = (scalar, PyBytes::new(py, &bytes), symbols, self.names.clone());
        Ok((python(py, "_engine", "_restore_tensor")?, stored))
    }
}

in_python! { PyTensor, "tensor":
    /// Nonzero components in coordinate form.
    ///
    /// Parameters
    /// ----------
    /// dtype : numpy.dtype, optional
    ///     Data type of the values: by default float64; ``object`` for fractions or SymPy expressions. A type of
    ///     integers requires integral components.
    ///
    /// Returns
    /// -------
    /// indices : array of the shape (rank, nnz)
    ///     Indices from 0.
    /// values : array of the shape (nnz,)
    ///     Components at the indices.
    ///
    /// Examples
    /// --------
    /// >>> Tensor([[0, 1], [2, 0]], "__").to_coo()
    /// (array([[0, 1],
    ///        [1, 0]]), array([1., 2.]))
    to_coo (dtype=None) [dtype];
    /// Dense array.
    ///
    /// Parameters
    /// ----------
    /// dtype : numpy.dtype, optional
    ///     Data type: by default float64, or ``object`` if there are parameters. With ``object``, the components are
    ///     fractions or SymPy expressions.
    ///
    /// Returns
    /// -------
    /// array of the shape (dimension, ...)
    ///     One axis for each index, in the order of the indices.
    ///
    /// Raises
    /// ------
    /// MemoryError
    ///     The array would be too large; :meth:`to_coo` may be used instead.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").killing_form.to_numpy()
    /// array([[-2.,  0.,  0.],
    ///        [ 0., -2.,  0.],
    ///        [ 0.,  0., -2.]])
    to_numpy (dtype=None) [dtype];
    __array__ (dtype=None, copy=None) [dtype, copy];
    _sympy_ () [];
    /// SymPy object: an expression for rank 0, a matrix for rank 2, otherwise an array.
    ///
    /// Returns
    /// -------
    /// sympy.Expr, sympy.ImmutableMatrix or sympy.NDimArray
    ///     Large arrays are sparse SymPy arrays.
    ///
    /// Examples
    /// --------
    /// >>> Tensor([["a", 0], [0, "a"]], "__").to_sympy().det()
    /// a**2
    to_sympy () [];
    /// DataFrame with one row per nonzero component: its indices, from 0, and its value.
    ///
    /// Returns
    /// -------
    /// pandas.DataFrame
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("heisenberg(3)").structure.to_pandas().columns.tolist()
    /// ['i', 'j', 'k', 'value']
    to_pandas () [];
    /// The tensor with parameters replaced by values. A tensor of floats is unchanged.
    ///
    /// To replace undetermined functions, use :meth:`Geometry.subs`.
    ///
    /// Parameters
    /// ----------
    /// values : dict
    ///     Numbers or expressions. The keys are names or symbols of parameters.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///
    /// Examples
    /// --------
    /// >>> Tensor(["a", "a^2"], "^").subs({"a": 3})[1]
    /// Fraction(9, 1)
    subs (values) [values];
}

/// The state of a pickled tensor: the scalar, the components as bytes, the symbols, and the names.
type Stored<'py> = (String, Bound<'py, PyBytes>, Bound<'py, PyDict>, Names);

/// Restores a tensor from its pickled state.
#[pyfunction]
#[pyo3(signature = (*stored))]
pub fn _restore_tensor(stored: Stored<'_>) -> PyResult<PyTensor> {
    let (scalar, bytes, symbols, names) = stored;
    let read = match scalar.as_str() {
        "exact" => serde_json::from_slice(bytes.as_bytes()).map(Rational::wrap),
        "symbolic" => serde_json::from_slice(bytes.as_bytes()).map(Symbolic::wrap),
        _ => serde_json::from_slice(bytes.as_bytes()).map(TrackedFloat::wrap),
    };
    let values = read.map_err(|error| PyValueError::new_err(error.to_string()))?;
    PyTensor::new(symbols.py(), values, &symbols, names)
}
