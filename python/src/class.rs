//! Parts that classes have in common: properties, copies, and methods that Python implements.

use pyo3::prelude::*;

/// An object of Python.
pub type Object<'py> = Bound<'py, PyAny>;

/// An argument that may be left out.
pub type Optional<'py> = Option<Object<'py>>;

/// A new object of Python.
pub type New<'py> = PyResult<Object<'py>>;

/// Properties: a row has the name, the type and the value.
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

/// Objects that never change are their own copies.
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

/// Other constructors, whose arguments a function of Python makes a source: the signature, and the function.
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

/// Methods that a function of Python with the same name computes: a row has the signature and the arguments.
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
