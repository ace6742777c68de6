//! Common parts of the classes: properties, copies, and methods that are implemented in Python.

use pyo3::prelude::*;

/// A Python object.
pub type Object<'py> = Bound<'py, PyAny>;

/// An optional argument.
pub type Optional<'py> = Option<Object<'py>>;

/// A new Python object, or an exception.
pub type New<'py> = PyResult<Object<'py>>;

/// Defines properties: each row has the name, the type and the value.
macro_rules! properties {
    ($class:ty, $own:ident: $(
        $(#[doc = $doc:literal])* $name:ident: $type:ty = $value:expr;
    )*) => {
        #[pymethods]
        impl $class {
            $(
                $(#[doc = $doc])*
                #[getter]
                pub fn $name(&self) -> $type {
                    let $own = self;
                    $value
                }
            )*
        }
    };
}

/// Defines copies: an immutable object is its own copy.
macro_rules! immutable {
    ($class:ty) => {
        #[pymethods]
        impl $class {
            fn __copy__(slf: Py<Self>) -> Py<Self> {
                slf
            }

            fn __deepcopy__(slf: Py<Self>, _memo: Bound<'_, PyAny>) -> Py<Self> {
                slf
            }
        }
    };
}

/// Defines alternative constructors: each row has the signature, and the Python function that converts the arguments to
/// a source.
macro_rules! constructors {
    ($class:ty: $(
        $(#[doc = $doc:literal])* $name:ident($signature:literal) = $module:literal.$function:literal;
    )*) => {
        #[pymethods]
        impl $class {
            $(
                $(#[doc = $doc])*
                #[classmethod]
                #[pyo3(signature = (*arguments, **keys), text_signature = $signature)]
                fn $name<'py>(
                    cls: &Bound<'py, pyo3::types::PyType>,
                    arguments: Bound<'py, pyo3::types::PyTuple>,
                    keys: Option<Bound<'py, pyo3::types::PyDict>>,
                ) -> PyResult<Bound<'py, PyAny>> {
                    let function = $crate::values::python(cls.py(), $module, $function)?;
                    cls.call1((function.call(arguments, keys.as_ref())?,))
                }
            )*
        }
    };
}

/// Defines methods that a Python function with the same name implements: each row has the signature and the arguments.
macro_rules! in_python {
    ($class:ty, $module:literal: $(
        $(#[doc = $doc:literal])* $name:ident $signature:tt [$($argument:ident),*];
    )*) => {
        #[pymethods]
        impl $class {
            $(
                $(#[doc = $doc])*
                #[pyo3(signature = $signature)]
                fn $name<'py>(
                    slf: &Bound<'py, Self>,
                    $($argument: Option<Bound<'py, PyAny>>,)*
                ) -> PyResult<Bound<'py, PyAny>> {
                    static FUNCTION: pyo3::sync::PyOnceLock<Py<PyAny>> =
                        pyo3::sync::PyOnceLock::new();
                    let module = concat!("affinor.", $module);
                    let function = FUNCTION.import(slf.py(), module, stringify!($name))?;
                    function.call1((slf, $($argument,)*))
                }
            )*
        }
    };
}

pub(crate) use {constructors, immutable, in_python, properties};
