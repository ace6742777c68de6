//! Contractions of tensors, and access to components by indices.

use crate::class::Object;
use crate::components::{Held, Values, each, of, widest};
use crate::errors::refused;
use crate::run::run;
use crate::tensor::{LETTERS, Names, PyTensor, written};
use crate::values::{self, error, index, python};
use affinor_documents::over_kind;
use affinor_tensors::contract;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

#[pymethods]
impl PyTensor {
    /// Contraction of this tensor, as the first factor, with other tensors.
    ///
    /// Parameters
    /// ----------
    /// expression : str
    ///     Sum of products in index letters, in the notation of :func:`contract`.
    /// *others : Tensor
    ///     Further factors, in the order of the expression.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///
    /// Examples
    /// --------
    /// >>> Tensor([1, 2], "^").contract("^i _i -> ", Tensor([3, 4], "_"))[()]
    /// Fraction(11, 1)
    #[pyo3(signature = (expression, *others))]
    fn contract<'py>(
        slf: &Bound<'py, Self>,
        expression: Object<'py>,
        others: Bound<'py, PyTuple>,
    ) -> PyResult<Self> {
        let factors = PyTuple::new(slf.py(), [slf])?.as_sequence().concat(others.as_sequence())?;
        contract_all(expression, factors.to_tuple()?, None)
    }

    /// The sum over the last index of one tensor and the first index of the other. One of these indices must be upper
    /// and the other lower.
    fn __matmul__(&self, py: Python<'_>, other: &PyTensor) -> PyResult<Self> {
        let (a, b) = (self.slots(), other.slots());
        let pair = (a.chars().last(), b.chars().next());
        if !matches!(pair, (Some('^'), Some('_')) | (Some('_'), Some('^'))) {
            let reason = format!(
                "a product needs an upper index next to a lower index: the slots are {a:?} and {b:?}"
            );
            return Err(error(py, "ShapeError", (reason,)));
        }
        // the index letters: first the letters of the first factor, then the summed letter, then the letters of the
        // second factor
        let letters: Vec<char> = LETTERS.chars().chain('r'..='z').collect();
        let (rank, last) = (self.rank(), self.rank() + other.rank() - 1);
        if last > letters.len() {
            let reason = format!("a product has at most {} indices", letters.len());
            return Err(error(py, "ShapeError", (reason,)));
        }
        let named = |slots: &str, from: usize| {
            written(&letters[from..].iter().collect::<String>(), slots, false)
        };
        let (first, second) = (named(&a, 0), named(&b, rank - 1));
        let summed: String = [&first[..2 * (rank - 1)], &second[2..]].concat();
        let expression = format!("a{first} b{second} -> {summed}");
        let both = [&self.values, &other.values];
        let values = run(py, || {
            over_kind!(widest(both), S => {
                let (a, b) = (of::<S>(both[0])?, of::<S>(both[1])?);
                Ok(S::wrap(contract(&expression, &[("a", &*a), ("b", &*b)])?))
            })
        })?;
        let symbols = values::merged(py, [&self.symbols, &other.symbols])?;
        Self::new(py, values, &symbols, Names::of("T"))
    }

    /// Tensor with its slots in a different order.
    ///
    /// Parameters
    /// ----------
    /// *order : int
    ///     Slot ``a`` of the result is slot ``order[a]`` of this tensor, from 0.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///
    /// Examples
    /// --------
    /// >>> Tensor([[0, 1], [2, 0]], "^_").permute(1, 0).slots
    /// '_^'
    #[pyo3(signature = (*order))]
    fn permute(&self, order: &Bound<'_, PyTuple>) -> PyResult<Self> {
        let (py, order) = (order.py(), self.positions(order)?);
        let permuted = each!(&self.values, tensor => tensor.permute(&order).map(Held::wrap));
        self.with(py, permuted.map_err(|error| refused(py, error))?)
    }

    /// Trace: the sum over an upper and a lower slot.
    ///
    /// Parameters
    /// ----------
    /// a, b : int
    ///     Positions of the slots, from 0.
    ///
    /// Returns
    /// -------
    /// Tensor
    ///     Tensor whose rank is lower by 2.
    ///
    /// Raises
    /// ------
    /// ShapeError
    ///     Both slots are upper, or both are lower.
    ///
    /// Examples
    /// --------
    /// >>> Geometry("so3@zero").curvature.trace(0, 2)[1, 1]
    /// Fraction(1, 2)
    fn trace<'py>(&self, a: Object<'py>, b: Object<'py>) -> PyResult<Self> {
        let py = a.py();
        let slots = self.positions(&PyTuple::new(py, [a, b])?)?;
        let trace = each!(&self.values, tensor => tensor.trace(slots[0], slots[1]).map(Held::wrap));
        self.with(py, trace.map_err(|error| refused(py, error))?)
    }
}

impl PyTensor {
    /// A tensor with the symbols of this tensor and a new name.
    fn with(&self, py: Python<'_>, values: Values) -> PyResult<Self> {
        Self::new(py, values, self.symbols.bind(py), Names::of("T"))
    }

    /// Checks positions of slots, and returns them.
    fn positions(&self, slots: &Bound<'_, PyTuple>) -> PyResult<Vec<usize>> {
        let position = |slot: Bound<'_, PyAny>| {
            let slot = index("a slot", &slot)?;
            let rank = self.rank();
            usize::try_from(slot).ok().filter(|slot| *slot < rank).ok_or_else(|| {
                let reason =
                    format!("a tensor of rank {rank} has no slot {slot}; they count from 0");
                error(slots.py(), "ShapeError", (reason,))
            })
        };
        slots.iter().map(position).collect()
    }
}

/// Contraction: a sum of products of tensors, written in index letters.
///
/// A letter that occurs twice in a term, once upper and once lower, is summed. Terms may have rational coefficients:
/// ``"1/2 a^i_j - b^i_j -> ^i_j"``.
///
/// Parameters
/// ----------
/// expression : str
///     Products and the indices of the result, such as ``"^i_jk ^j -> ^i_k"`` or, with named factors, ``"c^i_jk v^j ->
///     ^i_k"``.
/// *factors : Tensor
///     Factors without names, in the order of the expression.
/// **named : Tensor
///     Factors with names.
///
/// Returns
/// -------
/// Tensor
///
/// Raises
/// ------
/// ShapeError
///     The slots or dimensions of the factors do not fit the expression.
///
/// Examples
/// --------
/// >>> c, v = LieAlgebra("so3").structure, Tensor([1, 0, 0], "^")
/// >>> contract("^i_jk ^j -> ^i_k", c, v)[2, 1]
/// Fraction(1, 1)
/// >>> contract("c^i_jk v^j -> ^i_k", c=c, v=v)[2, 1]
/// Fraction(1, 1)
#[pyfunction(name = "contract")]
#[pyo3(signature = (expression, *factors, **named))]
pub fn contract_all<'py>(
    expression: Object<'py>,
    factors: Bound<'py, PyTuple>,
    named: Option<Bound<'py, PyDict>>,
) -> PyResult<PyTensor> {
    let py = factors.py();
    let operands = python(py, "tensor", "operands")?.call1((expression, factors, named))?;
    let (expression, operands): (String, Vec<(String, Py<PyTensor>)>) = operands.extract()?;
    let symbols = values::merged(py, operands.iter().map(|(_, tensor)| &tensor.get().symbols))?;
    let all: Vec<&Values> = operands.iter().map(|(_, tensor)| &tensor.get().values).collect();
    let values = run(py, || {
        over_kind!(widest(all.iter().copied()), S => {
            let tensors = all.iter().map(|values| of::<S>(values));
            let tensors = tensors.collect::<Result<Vec<_>, _>>()?;
            let names = operands.iter().map(|(name, _)| name.as_str());
            let named: Vec<_> = names.zip(tensors.iter().map(|tensor| &**tensor)).collect();
            Ok(S::wrap(contract(&expression, &named)?))
        })
    })?;
    PyTensor::new(py, values, &symbols, Names::of("T"))
}
