//! Arithmetic of tensors: sums, and products with numbers.

use crate::class::Object;
use crate::components::{Held, Values, of, widest};
use crate::errors::refused;
use crate::run::run;
use crate::tensor::{LETTERS, Names, PyTensor, written};
use crate::values::{self, text_of};
use affinor_documents::input::InputError;
use affinor_documents::over_kind;
use affinor_tensors::{Symbolic, Tensor, contract};
use numpy::PyUntypedArray;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

#[pymethods]
impl PyTensor {
    fn __add__(&self, py: Python<'_>, other: &PyTensor) -> PyResult<Self> {
        self.sum(py, other, "+")
    }

    fn __sub__(&self, py: Python<'_>, other: &PyTensor) -> PyResult<Self> {
        self.sum(py, other, "-")
    }

    fn __neg__(&self, py: Python<'_>) -> PyResult<Self> {
        self.scale(py, "-1", self.symbols.bind(py))
    }

    fn __mul__(&self, factor: &Bound<'_, PyAny>) -> PyResult<Self> {
        if factor.is_instance_of::<PyTensor>()
            || factor.is_instance_of::<PyUntypedArray>()
            || factor.is_instance_of::<PyList>()
            || factor.is_instance_of::<PyTuple>()
        {
            let reason =
                "a tensor is multiplied by a number; products of tensors are written with contract";
            return Err(PyTypeError::new_err(reason));
        }
        let (text, symbols) = self.factor(factor)?;
        self.scale(factor.py(), &text, &symbols)
    }

    fn __rmul__(&self, factor: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__mul__(factor)
    }

    fn __truediv__(&self, divisor: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (text, symbols) = self.factor(divisor)?;
        self.scale(divisor.py(), &format!("1/({text})"), &symbols)
    }
}

impl PyTensor {
    fn sum(&self, py: Python<'_>, other: &PyTensor, sign: &str) -> PyResult<Self> {
        let (slots, dimension) = (self.slots(), self.dimension());
        if slots != other.slots() || dimension != other.dimension() {
            return Err(PyValueError::new_err(format!(
                "a sum needs equal shapes: '{slots}' of dimension {dimension}, and '{}' of dimension {}",
                other.slots(),
                other.dimension()
            )));
        }
        let letters = written(LETTERS, &slots, false);
        let both = [&self.values, &other.values];
        let values = run(py, || {
            over_kind!(widest(both), S => {
                sum(&*of::<S>(both[0])?, &*of::<S>(both[1])?, sign, &letters)
            })
        })?;
        let symbols = values::merged(py, [&self.symbols, &other.symbols])?;
        Self::new(py, values, &symbols, Names::of("T"))
    }

    /// Multiplies the components by a number or an expression.
    fn scale(&self, py: Python<'_>, factor: &str, symbols: &Bound<'_, PyDict>) -> PyResult<Self> {
        fn scaled<S: Held>(tensor: &Tensor<S>, factor: &str) -> PyResult<Values> {
            Ok(S::wrap(tensor.scale(&values::read(factor)?)))
        }
        let symbolic: Symbolic = values::read(factor)?;
        let values = match &self.values {
            Values::Exact(tensor) if symbolic.as_constant().is_some() => scaled(tensor, factor)?,
            Values::Float(tensor) => scaled(tensor, factor)?,
            other => {
                let tensor = of::<Symbolic>(other).map_err(|error| refused(py, error))?;
                Symbolic::wrap(tensor.scale(&symbolic))
            }
        };
        Self::new(py, values, symbols, Names::of("T"))
    }

    /// Converts a factor to text. Also returns the symbols of the product.
    fn factor<'py>(&self, factor: &Object<'py>) -> PyResult<(String, Bound<'py, PyDict>)> {
        let symbols = self.symbols.bind(factor.py()).copy()?;
        Ok((text_of(factor, &symbols, self.scalar() == "float")?, symbols))
    }
}

/// The sum or the difference of two tensors. Both have these index letters.
fn sum<S: Held>(
    a: &Tensor<S>,
    b: &Tensor<S>,
    sign: &str,
    letters: &str,
) -> Result<Values, InputError> {
    if !letters.is_empty() {
        let expression = format!("a{letters} {sign} b{letters} -> {letters}");
        return Ok(S::wrap(contract(&expression, &[("a", a), ("b", b)])?));
    }
    let signed = |value: &S| if sign == "-" { -value.clone() } else { value.clone() };
    let terms = a.nonzero().cloned().chain(b.nonzero().map(signed));
    Ok(S::wrap(Tensor::from_components(a.dimension(), &[], terms.map(|value| (vec![], value)))?))
}
