//! Components of tensors over the three scalar types.

use crate::errors::{refused, wrong};
use crate::values;
use affinor_documents::Coefficient;
use affinor_documents::input::InputError;
use affinor_tensors::{
    Down, Kind, Notation, Rational, Symbolic, Tensor, TensorError, TrackedFloat, Up, Variance,
};
use numpy::ndarray::ArrayViewD;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Components over one of the scalar types.
#[derive(Clone, Debug)]
pub enum Values {
    Exact(Arc<Tensor<Rational>>),
    Symbolic(Arc<Tensor<Symbolic>>),
    Float(Arc<Tensor<TrackedFloat>>),
}

/// Evaluates the same expression for each scalar type.
macro_rules! each {
    ($values:expr, $tensor:ident => $body:expr) => {
        match $values {
            $crate::components::Values::Exact($tensor) => $body,
            $crate::components::Values::Symbolic($tensor) => $body,
            $crate::components::Values::Float($tensor) => $body,
        }
    };
}

pub(crate) use each;

/// Converts a component to a float.
pub fn float<S: Coefficient>(value: &S) -> Result<f64, InputError> {
    let refused = |what: &str, help: &str| {
        let text = value.to_string();
        let shown: String = text.chars().take(40).collect();
        let rest = if shown.len() < text.len() { "..." } else { "" };
        Err(InputError::usage(format!("the component {shown}{rest} {what}")).help(help))
    };
    match Notation::to_f64(value) {
        Some(float) if float.is_finite() => Ok(float),
        Some(_) => {
            refused("is beyond the range of floats", "use exact numbers, as in to_numpy(object)")
        }
        None if value.parameters().is_empty() => {
            refused("is not a rational number", "use to_sympy(), and evalf for its expressions")
        }
        None => refused(
            "has parameters, so it is not a float",
            "substitute numbers for the parameters, or use to_sympy()",
        ),
    }
}

/// Writes the nonzero components as floats.
pub fn write_floats<S: Coefficient>(
    tensor: &Tensor<S>,
    list: &mut [f64],
) -> Result<(), InputError> {
    for (value, out) in tensor.nonzero().zip(list) {
        *out = float(value)?;
    }
    Ok(())
}

/// A scalar type of tensors in Python.
pub trait Held: Coefficient {
    fn wrap(tensor: Tensor<Self>) -> Values;
    /// The tensor over this scalar type; `None` if the values are of another type.
    fn of(values: &Values) -> Option<Arc<Tensor<Self>>>;
}

/// Converts a tensor to another scalar type; `None` if this type cannot represent a value.
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
    /// The kind of the scalar.
    pub fn kind(&self) -> Kind {
        match self {
            Values::Exact(_) => Kind::Exact,
            Values::Symbolic(_) => Kind::Symbolic,
            Values::Float(_) => Kind::Float,
        }
    }
}

/// The name of a kind of scalars.
pub fn text(kind: Kind) -> &'static str {
    match kind {
        Kind::Exact => "exact",
        Kind::Symbolic => "symbolic",
        Kind::Float => "float",
    }
}

/// The widest of these kinds: floats are wider than expressions, which are wider than rational numbers.
pub fn widest<'v>(all: impl IntoIterator<Item = &'v Values>) -> Kind {
    let rank = |kind: &Kind| match kind {
        Kind::Exact => 0,
        Kind::Symbolic => 1,
        Kind::Float => 2,
    };
    all.into_iter().map(Values::kind).max_by_key(rank).unwrap_or(Kind::Exact)
}

/// The tensor over a scalar type; an error if this type cannot represent a component.
pub fn of<S: Held>(values: &Values) -> Result<Arc<Tensor<S>>, InputError> {
    S::of(values).ok_or_else(|| {
        if values.kind() == Kind::Float {
            let error =
                InputError::usage("the components are floats, but exact numbers are needed");
            return error.help("give exact numbers (int, Fraction, SymPy or texts)");
        }
        let reason = each!(values, tensor => tensor.nonzero().find_map(|value| float(value).err()));
        reason.unwrap_or_else(|| {
            InputError::usage("a component cannot be represented in this scalar")
        })
    })
}

/// Converts the marks `^` and `_` to upper and lower slots.
fn slots(marks: &str) -> PyResult<Vec<Variance>> {
    let slot = |mark: char| match mark {
        '^' => Ok(Up),
        '_' => Ok(Down),
        other => {
            Err(PyValueError::new_err(format!("slots are written with ^ and _, not `{other}`")))
        }
    };
    marks.chars().map(slot).collect()
}

/// Converts slots to marks.
pub fn marks(slots: &[Variance]) -> String {
    slots.iter().map(|slot| if *slot == Up { '^' } else { '_' }).collect()
}

/// Builds components over the narrowest scalar type. `values` are texts, or floats for the scalar `float`. `indices`
/// have the shape (rank, count) and count from 0.
pub fn build(
    py: Python<'_>,
    dimension: usize,
    marks: &str,
    places: ArrayViewD<'_, i64>,
    values: &Bound<'_, PyAny>,
    scalar: &str,
) -> PyResult<Values> {
    let slots = slots(marks)?;
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
            PyIndexError::new_err(format!("the index {index} is not in 0..{dimension}"))
        })?);
    }
    fn make<S: Held>(
        dimension: usize,
        slots: &[Variance],
        keys: Vec<Vec<usize>>,
        values: Vec<S>,
    ) -> Result<Values, TensorError> {
        Tensor::from_components(dimension, slots, keys.into_iter().zip(values)).map(S::wrap)
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
        match exact {
            Some(exact) => make(dimension, &slots, keys, exact),
            None => make(dimension, &slots, keys, symbolic),
        }
    };
    made.map_err(|error| refused(py, error))
}

/// The names of the parameters, sorted.
pub fn parameters(values: &Values) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    each!(values, tensor => tensor.nonzero().for_each(|value| names.extend(value.parameters())));
    names
}
