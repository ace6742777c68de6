//! The module `affinor._engine`: spaces, tensors, groups and motions for the Python package `affinor`.

mod arrays;
mod errors;
mod geometry;
mod group;
mod motion;
mod report;
mod run;
mod space;
mod structure;
mod tensor;
mod values;

/// The extension module.
#[pyo3::pymodule]
mod _engine {
    #[pymodule_export]
    use crate::geometry::{PyGeometry, catalogue, conventions, quantities};
    #[pymodule_export]
    use crate::group::{PyGroup, PyTransport, groups};
    #[pymodule_export]
    use crate::motion::PyProblem;
    #[pymodule_export]
    use crate::run::{_panic, set_threads, threads};
    #[pymodule_export]
    use crate::space::PySpace;
    #[pymodule_export]
    use crate::structure::{
        central_extension, complexification, contraction, info, program, properties, quotient,
        semidirect, subalgebra, tensor_product, truncated, with_dual,
    };
    #[pymodule_export]
    use crate::tensor::PyTensor;
    #[pymodule_export]
    use crate::values::evaluate;
}
