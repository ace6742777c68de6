//! Geometries over the three scalar types. Algebras and geometries in Python contain them.

use crate::components::{Held, Values, text};
use crate::run::run;
use crate::tensor::{Names, PyTensor};
use crate::values::error;
use affinor::{Geometry, LieAlgebra};
use affinor_documents::input::InputError;
use affinor_documents::report::Quantity;
use affinor_tensors::{Kind, Rational, Symbolic, TrackedFloat};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A geometry over one of the scalar types.
#[derive(Clone, Debug)]
pub enum Geometries {
    Exact(Geometry<Rational>),
    Symbolic(Geometry<Symbolic>),
    Float(Geometry<TrackedFloat>),
}

/// Evaluates the same expression for each scalar type.
macro_rules! each {
    ($values:expr, $geometry:ident => $body:expr) => {
        match $values {
            $crate::geometries::Geometries::Exact($geometry) => $body,
            $crate::geometries::Geometries::Symbolic($geometry) => $body,
            $crate::geometries::Geometries::Float($geometry) => $body,
        }
    };
}

pub(crate) use each;

/// A scalar type of geometries in Python.
pub trait Grounded: Held {
    fn geometry(geometry: Geometry<Self>) -> Geometries;
}

impl Grounded for Rational {
    fn geometry(geometry: Geometry<Self>) -> Geometries {
        Geometries::Exact(geometry)
    }
}

impl Grounded for Symbolic {
    fn geometry(geometry: Geometry<Self>) -> Geometries {
        Geometries::Symbolic(geometry)
    }
}

impl Grounded for TrackedFloat {
    fn geometry(geometry: Geometry<Self>) -> Geometries {
        Geometries::Float(geometry)
    }
}

impl Geometries {
    /// The names of the frame vectors.
    pub fn labels(&self) -> Vec<String> {
        each!(self, geometry => geometry.frame().labels().to_vec())
    }

    /// The name of the kind of scalars.
    pub fn scalar(&self) -> &'static str {
        text(match self {
            Geometries::Exact(_) => Kind::Exact,
            Geometries::Symbolic(_) => Kind::Symbolic,
            Geometries::Float(_) => Kind::Float,
        })
    }

    /// The brackets of the algebra as text, one per line; `None` if the frame does not belong to an algebra.
    pub fn brackets(&self) -> Option<String> {
        each!(self, geometry => geometry.algebra().map(|algebra| algebra.to_string()))
    }

    /// A quantity; `None` if it does not apply to the geometry.
    pub fn quantity(
        &self,
        py: Python<'_>,
        quantity: Quantity,
        symbols: &Py<PyDict>,
    ) -> PyResult<Option<PyTensor>> {
        let found =
            run(py, || Ok(each!(self, geometry => quantity.of(geometry)?.map(Held::wrap))))?;
        let names = || Names {
            symbol: quantity.symbol().into(),
            latex: quantity.latex().into(),
            title: Some(quantity.title().into()),
            letters: Some(quantity.letters()),
        };
        found.map(|values| PyTensor::new(py, values, symbols.bind(py), names())).transpose()
    }

    /// A quantity; an error if it does not apply to the geometry.
    pub fn tensor(
        &self,
        py: Python<'_>,
        quantity: Quantity,
        symbols: &Py<PyDict>,
    ) -> PyResult<PyTensor> {
        self.quantity(py, quantity, symbols)?.ok_or_else(|| {
            let reason = format!("{} is not defined for this geometry", quantity.key());
            let help = "ricci contractions and norms need a metric; schouten, weyl and cotton need levi-civita in dimension 3 or more";
            error(py, "MathematicsError", (reason, help))
        })
    }
}

/// The labels and the structure constants of a new algebra.
pub type Made = (Vec<String>, Values);

pub fn made<S: Held>(algebra: &LieAlgebra<S>) -> Made {
    (algebra.labels().to_vec(), S::wrap(algebra.structure_constants().clone()))
}

/// The algebra of a geometry on a group.
pub fn algebra<'a, S: Held>(
    geometry: &'a Geometry<S>,
    what: &'static str,
) -> Result<&'a LieAlgebra<S>, InputError> {
    Ok(geometry.frame_origin().algebra_for(what)?)
}

/// The algebra over symbolic expressions.
pub fn symbolic(
    values: &Geometries,
    what: &'static str,
) -> Result<LieAlgebra<Symbolic>, InputError> {
    match values {
        Geometries::Exact(geometry) => {
            Ok(algebra(geometry, what)?.map(|value| Symbolic::constant(value.clone()))?)
        }
        Geometries::Symbolic(geometry) => Ok(algebra(geometry, what)?.clone()),
        Geometries::Float(_) => Err(InputError::usage("both algebras need the same scalar")),
    }
}

/// The error for an exact computation with floats.
pub fn in_floats(what: &str) -> InputError {
    let error = InputError::usage(format!("{what} needs exact numbers, but the values are floats"));
    error.help("give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'")
}
