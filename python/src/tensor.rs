//! Tensors over the three scalars, as the engine hands them to Python.

use crate::arrays::fresh;
use crate::errors::{refused, wrong};
use crate::run::run;
use crate::values;
use affinor_documents::input::InputError;
use affinor_documents::report::{components_in_latex, components_in_text};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::{
    Down, Kind, Notation, Rational, Symbolic, Tensor, TensorError, TrackedFloat, Up, Variance,
    contract,
};
use numpy::{PyArrayDyn, PyArrayLikeDyn, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};
use std::sync::Arc;

/// The components over one of the scalars.
#[derive(Clone, Debug)]
pub enum Values {
    Exact(Arc<Tensor<Rational>>),
    Symbolic(Arc<Tensor<Symbolic>>),
    Float(Arc<Tensor<TrackedFloat>>),
}

/// Runs the same expression over each scalar.
macro_rules! each {
    ($values:expr, $tensor:ident => $body:expr) => {
        match $values {
            Values::Exact($tensor) => $body,
            Values::Symbolic($tensor) => $body,
            Values::Float($tensor) => $body,
        }
    };
}

/// Indices and values of the nonzero components.
type Coordinates<'py> = (Bound<'py, PyArrayDyn<i64>>, Bound<'py, PyArrayDyn<f64>>);

/// A component as a float.
pub fn float<S: Coefficient>(value: &S) -> Result<f64, InputError> {
    let refused = |what: &str, help: &str| {
        let text = value.to_string();
        let shown: String = text.chars().take(40).collect();
        let rest = if shown.len() < text.len() { "..." } else { "" };
        Err(InputError::usage(format!("the component {shown}{rest} {what}")).help(help))
    };
    match Notation::to_f64(value) {
        Some(float) if float.is_finite() => Ok(float),
        Some(_) => refused("is beyond the range of floats", "take exact numbers: to_numpy(object)"),
        None if value.parameters().is_empty() => {
            refused("is no rational number", "take to_sympy(), and evalf of its expressions")
        }
        None => refused(
            "has parameters, and is no float",
            "substitute numbers for the parameters, or take to_sympy()",
        ),
    }
}

/// The nonzero components as floats.
fn write_floats<S: Coefficient>(tensor: &Tensor<S>, list: &mut [f64]) -> Result<(), InputError> {
    for (value, out) in tensor.nonzero().zip(list) {
        *out = float(value)?;
    }
    Ok(())
}

/// A scalar of the tensors that Python holds.
pub trait Held: Coefficient {
    fn wrap(tensor: Tensor<Self>) -> Values;
    /// The tensor over this scalar, if its values exist here.
    fn of(values: &Values) -> Option<Arc<Tensor<Self>>>;
}

/// A tensor over another scalar; `None` if a value does not exist there.
fn over<S: Coefficient, T: Coefficient>(
    tensor: &Tensor<S>,
    convert: impl Fn(&S) -> Option<T>,
) -> Option<Arc<Tensor<T>>> {
    tensor
        .components()
        .all(|(_, value)| convert(value).is_some())
        .then(|| Arc::new(tensor.map(|value| convert(value).unwrap_or_else(T::zero))))
}

impl Held for Rational {
    fn wrap(tensor: Tensor<Self>) -> Values {
        Values::Exact(tensor.into())
    }
    fn of(values: &Values) -> Option<Arc<Tensor<Self>>> {
        match values {
            Values::Exact(tensor) => Some(tensor.clone()),
            Values::Symbolic(tensor) => over(tensor, |value| value.as_constant().cloned()),
            Values::Float(_) => None,
        }
    }
}

impl Held for Symbolic {
    fn wrap(tensor: Tensor<Self>) -> Values {
        Values::Symbolic(tensor.into())
    }
    fn of(values: &Values) -> Option<Arc<Tensor<Self>>> {
        match values {
            Values::Exact(tensor) => over(tensor, |value| Some(Symbolic::constant(value.clone()))),
            Values::Symbolic(tensor) => Some(tensor.clone()),
            Values::Float(_) => None,
        }
    }
}

impl Held for TrackedFloat {
    fn wrap(tensor: Tensor<Self>) -> Values {
        Values::Float(tensor.into())
    }
    fn of(values: &Values) -> Option<Arc<Tensor<Self>>> {
        match values {
            Values::Exact(tensor) => over(tensor, TrackedFloat::from_rational),
            Values::Symbolic(tensor) => {
                over(tensor, |value| TrackedFloat::from_rational(&value.approximation()?))
            }
            Values::Float(tensor) => Some(tensor.clone()),
        }
    }
}

impl Values {
    pub fn kind(&self) -> Kind {
        match self {
            Values::Exact(_) => Kind::Exact,
            Values::Symbolic(_) => Kind::Symbolic,
            Values::Float(_) => Kind::Float,
        }
    }
}

/// The widest of the kinds: floats before expressions before rationals.
pub fn widest<'v>(all: impl IntoIterator<Item = &'v Values>) -> Kind {
    let rank = |kind: &Kind| match kind {
        Kind::Exact => 0,
        Kind::Symbolic => 1,
        Kind::Float => 2,
    };
    all.into_iter().map(Values::kind).max_by_key(rank).unwrap_or(Kind::Exact)
}

/// The tensor over a scalar, or the reason why a component is not in it.
pub fn of<S: Held>(values: &Values) -> Result<Arc<Tensor<S>>, InputError> {
    S::of(values).ok_or_else(|| {
        if values.kind() == Kind::Float {
            let error = InputError::usage("the components are floats, and exact ones are needed");
            return error.help("give exact numbers (int, Fraction, SymPy or texts)");
        }
        let reason = each!(values, tensor => tensor.nonzero().find_map(|value| float(value).err()));
        reason.unwrap_or_else(|| InputError::usage("a component is not in the scalars"))
    })
}

/// A tensor: sparse components over upper and lower slots.
#[pyclass(name = "Tensor", frozen, module = "affinor._engine")]
#[derive(Debug)]
pub struct PyTensor(pub Values);

/// Upper and lower slots from the marks `^` and `_`.
pub fn slots(marks: &str) -> PyResult<Vec<Variance>> {
    let slot = |mark: char| match mark {
        '^' => Ok(Up),
        '_' => Ok(Down),
        other => {
            Err(PyValueError::new_err(format!("slots are written with ^ and _, not `{other}`")))
        }
    };
    marks.chars().map(slot).collect()
}

#[pymethods]
impl PyTensor {
    /// A tensor from components: `indices` of the shape (rank, count), from 0, and as many values: texts, or floats for
    /// the scalar `float`.
    #[staticmethod]
    fn build(
        dimension: usize,
        marks: &str,
        indices: PyArrayLikeDyn<'_, i64>,
        values: &Bound<'_, PyAny>,
        scalar: &str,
    ) -> PyResult<Self> {
        let py = values.py();
        let slots = slots(marks)?;
        let places = indices.as_array();
        let shape = places.shape().to_vec();
        if shape.len() != 2 || shape[0] != slots.len() {
            let expected = format!("of the shape ({}, count)", slots.len());
            return Err(wrong("indices", &expected, &format!("{shape:?}")));
        }
        let mut keys = Vec::with_capacity(shape[1]);
        for column in 0..shape[1] {
            let index = |row: usize| {
                let index = places[[row, column]];
                usize::try_from(index).ok().filter(|index| *index < dimension).ok_or(index)
            };
            let at: Result<Vec<usize>, i64> = (0..shape[0]).map(index).collect();
            keys.push(at.map_err(|index| {
                let reason = format!("the index {index} is not in 0..{dimension}");
                pyo3::exceptions::PyIndexError::new_err(reason)
            })?);
        }
        fn make<S: Held>(
            dimension: usize,
            slots: &[Variance],
            keys: Vec<Vec<usize>>,
            values: Vec<S>,
        ) -> Result<PyTensor, TensorError> {
            let tensor = Tensor::from_components(dimension, slots, keys.into_iter().zip(values))?;
            Ok(PyTensor(S::wrap(tensor)))
        }
        let count = values.len()?;
        if count != keys.len() {
            return Err(wrong("values", &format!("{} in number", keys.len()), &count.to_string()));
        }
        let made = if scalar == "float" {
            let floats: Vec<f64> = values.extract()?;
            make(dimension, &slots, keys, floats.into_iter().map(TrackedFloat::from).collect())
        } else {
            let texts: Vec<String> = values.extract()?;
            let symbolic = texts.iter().map(|text| values::read(text));
            let symbolic = symbolic.collect::<PyResult<Vec<Symbolic>>>()?;
            let exact: Option<Vec<Rational>> =
                symbolic.iter().map(|value| value.as_constant().cloned()).collect();
            match exact.filter(|_| scalar != "symbolic") {
                Some(exact) => make(dimension, &slots, keys, exact),
                None => make(dimension, &slots, keys, symbolic),
            }
        };
        made.map_err(|error| refused(py, error))
    }

    #[getter]
    fn dimension(&self) -> usize {
        each!(&self.0, tensor => tensor.dimension())
    }

    #[getter]
    fn slots(&self) -> String {
        let mark = |slot: &Variance| if *slot == Up { '^' } else { '_' };
        each!(&self.0, tensor => tensor.slots().iter().map(mark).collect())
    }

    #[getter]
    fn nnz(&self) -> usize {
        each!(&self.0, tensor => tensor.len())
    }

    #[getter]
    fn scalar(&self) -> &'static str {
        match self.0.kind() {
            Kind::Exact => "exact",
            Kind::Symbolic => "symbolic",
            Kind::Float => "float",
        }
    }

    /// The names of the parameters, sorted.
    fn parameters(&self) -> Vec<String> {
        let mut names = std::collections::BTreeSet::new();
        each!(&self.0, tensor => {
            tensor.components().for_each(|(_, value)| names.extend(value.parameters()))
        });
        names.into_iter().collect()
    }

    /// One component, indices from 0: a fraction, a float, or the text of an expression.
    fn get<'py>(&self, py: Python<'py>, at: Vec<usize>) -> PyResult<Bound<'py, PyAny>> {
        let failed = |error| refused(py, InputError::from(error));
        match &self.0 {
            Values::Exact(tensor) => values::fraction(py, tensor.try_get(&at).map_err(failed)?),
            Values::Symbolic(tensor) => {
                let text = tensor.try_get(&at).map_err(failed)?.to_string();
                Ok(text.into_pyobject(py)?.into_any())
            }
            Values::Float(tensor) => {
                let value = tensor.try_get(&at).map_err(failed)?.to_f64();
                Ok(value.into_pyobject(py)?.into_any())
            }
        }
    }

    /// The indices of the nonzero components, shape (rank, count), from 0.
    fn indices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<i64>>> {
        let count = each!(&self.0, tensor => tensor.len());
        let out = fresh(py, &[self.slots().len()], &[count])?;
        {
            let mut list = out.readwrite();
            let list = list.as_slice_mut()?;
            run(py, || {
                each!(&self.0, tensor => tensor.write_coordinates(list));
                Ok(())
            })?;
        }
        Ok(out)
    }

    /// The nonzero components as floats.
    fn floats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let out = fresh(py, &[each!(&self.0, tensor => tensor.len())], &[])?;
        {
            let mut list = out.readwrite();
            let list = list.as_slice_mut()?;
            run(py, || each!(&self.0, tensor => write_floats(tensor, list)))?;
        }
        Ok(out)
    }

    /// The indices and the floats, both at once.
    fn coo<'py>(&self, py: Python<'py>) -> PyResult<Coordinates<'py>> {
        let count = each!(&self.0, tensor => tensor.len());
        let indices = fresh(py, &[self.slots().len()], &[count])?;
        let floats = fresh(py, &[count], &[])?;
        {
            let (mut list, mut values) = (indices.readwrite(), floats.readwrite());
            let (list, values) = (list.as_slice_mut()?, values.as_slice_mut()?);
            run(py, || {
                each!(&self.0, tensor => {
                    rayon::join(|| tensor.write_coordinates(list), || write_floats(tensor, values)).1
                })
            })?;
        }
        Ok((indices, floats))
    }

    /// The nonzero components: fractions, floats, or texts of expressions.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        match &self.0 {
            Values::Exact(tensor) => {
                let values = tensor.nonzero().map(|value| values::fraction(py, value));
                PyList::new(py, values.collect::<PyResult<Vec<_>>>()?)
            }
            Values::Symbolic(tensor) => PyList::new(
                py,
                tensor.components().map(|(_, value)| value.to_string()).collect::<Vec<_>>(),
            ),
            Values::Float(tensor) => PyList::new(
                py,
                tensor.components().map(|(_, value)| value.to_f64()).collect::<Vec<_>>(),
            ),
        }
    }

    /// The nonzero components as texts.
    fn texts(&self) -> Vec<String> {
        each!(&self.0, tensor => tensor.nonzero().map(|value| value.to_string()).collect())
    }

    /// The first components as text, at most `limit`.
    fn text(&self, symbol: &str, limit: usize) -> String {
        each!(&self.0, tensor => components_in_text(symbol, &first(tensor, limit)))
    }

    /// Lines of LaTeX with the first components, at most `limit`, grouped by value.
    fn latex(&self, symbol: &str, limit: usize) -> Vec<String> {
        each!(&self.0, tensor => components_in_latex(symbol, &first(tensor, limit)))
    }

    /// A sum of products in index letters, of operands by name.
    #[staticmethod]
    fn contract(
        py: Python<'_>,
        expression: &str,
        operands: Vec<(String, Py<PyTensor>)>,
    ) -> PyResult<Self> {
        let all: Vec<&Values> = operands.iter().map(|(_, tensor)| &tensor.get().0).collect();
        run(py, || {
            over_kind!(widest(all.iter().copied()), S => {
                let tensors = all.iter().map(|values| of::<S>(values));
                let tensors = tensors.collect::<Result<Vec<_>, _>>()?;
                let names = operands.iter().map(|(name, _)| name.as_str());
                let named: Vec<_> = names.zip(tensors.iter().map(|tensor| &**tensor)).collect();
                Ok(PyTensor(S::wrap(contract(expression, &named)?)))
            })
        })
    }

    /// The same components over floats, or over expressions.
    fn over(&self, py: Python<'_>, scalar: &str) -> PyResult<Self> {
        let values = match scalar {
            "float" => of::<TrackedFloat>(&self.0).map(Values::Float),
            "symbolic" => of::<Symbolic>(&self.0).map(Values::Symbolic),
            "exact" => Rational::of(&self.0)
                .map(Values::Exact)
                .ok_or_else(|| InputError::usage("these components are no rational numbers")),
            other => Err(InputError::usage(format!("no scalar `{other}`"))),
        };
        values.map(PyTensor).map_err(|error| refused(py, error))
    }

    /// The slots in another order.
    fn permute(&self, py: Python<'_>, order: Vec<usize>) -> PyResult<Self> {
        let permuted = each!(&self.0, tensor => tensor.permute(&order).map(Held::wrap));
        permuted.map(PyTensor).map_err(|error| refused(py, error))
    }

    /// The tensor with the index of one slot fixed.
    fn slice(&self, py: Python<'_>, slot: usize, index: usize) -> PyResult<Self> {
        let slice = each!(&self.0, tensor => tensor.slice(slot, index).map(Held::wrap));
        slice.map(PyTensor).map_err(|error| refused(py, error))
    }

    /// The sum over an upper and a lower slot.
    fn trace(&self, py: Python<'_>, a: usize, b: usize) -> PyResult<Self> {
        let trace = each!(&self.0, tensor => tensor.trace(a, b).map(Held::wrap));
        trace.map(PyTensor).map_err(|error| refused(py, error))
    }

    /// The components multiplied by a number or an expression.
    fn scale(&self, py: Python<'_>, factor: &str) -> PyResult<Self> {
        fn scaled<S: Held>(tensor: &Tensor<S>, factor: &str) -> PyResult<Values> {
            Ok(S::wrap(tensor.scale(&values::read(factor)?)))
        }
        let symbolic: Symbolic = values::read(factor)?;
        Ok(PyTensor(match &self.0 {
            Values::Exact(tensor) if symbolic.as_constant().is_some() => scaled(tensor, factor)?,
            Values::Float(tensor) => scaled(tensor, factor)?,
            other => {
                let tensor = of::<Symbolic>(other).map_err(|error| refused(py, error))?;
                Symbolic::wrap(tensor.scale(&symbolic))
            }
        }))
    }

    /// Whether both have the same shape and the same components; a float is never equal to an exact value.
    fn equals(&self, other: &PyTensor) -> bool {
        let floats = [&self.0, &other.0].map(|values| values.kind() == Kind::Float);
        floats[0] == floats[1]
            && over_kind!(widest([&self.0, &other.0]), S => {
                S::of(&self.0).zip(S::of(&other.0)).is_some_and(|(a, b)| a == b)
            })
    }

    /// Bytes that `from_bytes` reads back.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = each!(&self.0, tensor => serde_json::to_vec(&**tensor));
        let bytes = bytes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    #[staticmethod]
    fn from_bytes(scalar: &str, bytes: &[u8]) -> PyResult<Self> {
        let read = match scalar {
            "exact" => serde_json::from_slice(bytes).map(Rational::wrap),
            "symbolic" => serde_json::from_slice(bytes).map(Symbolic::wrap),
            "float" => serde_json::from_slice(bytes).map(TrackedFloat::wrap),
            other => return Err(PyTypeError::new_err(format!("no scalar `{other}`"))),
        };
        read.map(PyTensor).map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

/// The tensor of the first components.
fn first<S: Coefficient>(tensor: &Tensor<S>, limit: usize) -> Tensor<S> {
    if tensor.len() <= limit {
        return tensor.clone();
    }
    let some = tensor.components().take(limit).map(|(at, value)| (at, value.clone()));
    Tensor::from_components(tensor.dimension(), tensor.slots(), some)
        .unwrap_or_else(|_| tensor.clone())
}
