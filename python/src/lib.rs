//! The module `affinor._engine`: algebras, tensors, geometries, groups and motions for the Python package `affinor`.

mod algebra;
mod arithmetic;
mod arrays;
mod class;
mod command;
mod components;
mod constructions;
mod contraction;
mod display;
mod errors;
mod family;
mod geometries;
mod geometry;
mod group;
mod kak;
mod limits;
mod mechanism;
mod motion;
mod operations;
mod report;
mod representation;
mod rows;
mod run;
mod source;
mod structure;
mod tables;
mod tensor;
mod transport;
mod values;

/// The extension module.
#[pyo3::pymodule]
mod _engine {
    #[pymodule_export]
    use crate::algebra::{PyAlgebra, catalogue};
    #[pymodule_export]
    use crate::command::run_command;
    #[pymodule_export]
    use crate::contraction::contract_all;
    #[pymodule_export]
    use crate::family::PyFamily;
    #[pymodule_export]
    use crate::geometry::PyGeometry;
    #[pymodule_export]
    use crate::group::{PyGroup, groups};
    #[pymodule_export]
    use crate::kak::{_kak, _two_qubit_kak};
    #[pymodule_export]
    use crate::limits::PyBudget;
    #[pymodule_export]
    use crate::mechanism::PyMechanism;
    #[pymodule_export]
    use crate::motion::{PyProblem, methods};
    #[pymodule_export]
    use crate::representation::{_coupling, _representation, _representation_matrices};
    #[pymodule_export]
    use crate::run::{_panic, clear_caches, set_threads, threads};
    #[pymodule_export]
    use crate::source::PySource;
    #[pymodule_export]
    use crate::tables::{compare, conventions};
    #[pymodule_export]
    use crate::tensor::{_restore_tensor, PyTensor};
    #[pymodule_export]
    use crate::values::{evaluate, knows};
}
