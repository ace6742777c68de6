//! Structure theory of Lie algebras.

use crate::algebra::PyAlgebra;
use crate::class::{New, Object};
use crate::geometries::{Geometries, each};
use crate::report::{Written, all_formats};
use crate::run::run;
use crate::values::python;
use affinor_documents::input::InputError;
use affinor_documents::report::{Info, Program};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;

/// The properties that are entries of the report of the structure: a row has the name, the form of the value, and the keys.
macro_rules! answers {
    ($($(#[doc = $doc:literal])* $name:ident: $form:ident $keys:tt;)*) => {
        #[pymethods]
        impl PyAlgebra {
            $(
                $(#[doc = $doc])*
                #[getter]
                fn $name<'py>(slf: &Bound<'py, Self>) -> New<'py> {
                    let answer = Self::answer(slf, &$keys)?;
                    if answer.is_none() { Ok(answer) } else { $form(slf, answer) }
                }
            )*
        }
    };
}

answers! {
    /// Whether all brackets vanish.
    is_abelian: value["abelian"];
    /// Whether the lower central series ends in zero.
    is_nilpotent: value["nilpotent"];
    /// Whether the derived series ends in zero.
    is_solvable: value["solvable"];
    /// Whether ``tr ad_x = 0`` for all ``x``.
    is_unimodular: value["unimodular"];
    /// Whether ``[L, L] = L``.
    is_perfect: value["perfect"];
    /// Whether the radical is the centre.
    is_reductive: value["reductive"];
    /// Whether the Killing form is not degenerate.
    is_semisimple: value["semisimple"];
    /// Whether the only ideals over the reals are zero and the algebra; None if it was not decided.
    is_simple: value["simple"];
    /// Whether the centre is zero and all derivations are inner; None if it was not decided.
    is_complete: value["complete"];
    /// The length of the lower central series; None if the algebra is not nilpotent.
    nilpotency_class: value["nilpotency_class"];
    /// The length of the derived series; None if the algebra is not solvable.
    derived_length: value["derived_length"];
    /// The dimensions of the derived series, until they are stable.
    derived_series: list["derived_series"];
    /// The dimensions of the lower central series, until they are stable.
    lower_central_series: list["lower_central_series"];
    /// The dimensions of the upper central series, until they are stable.
    upper_central_series: list["upper_central_series"];
    /// A basis of the centre, one row per vector: an object array of the shape (dimension of the centre, n).
    centre: subspace["centre", "basis"];
    /// A basis of the solvable radical, one row per vector.
    radical: subspace["radical", "basis"];
    /// A basis of the nilradical, one row per vector.
    nilradical: subspace["nilradical", "basis"];
    /// A basis of a Levi subalgebra, one row per vector.
    levi_subalgebra: subspace["levi", "basis"];
    /// A basis of a Cartan subalgebra, one row per vector.
    cartan_subalgebra: subspace["cartan_subalgebra", "basis"];
    /// The dimension of a Cartan subalgebra.
    rank: value["rank"];
    /// The numbers of positive, negative and zero squares of the Killing form; None if they depend on parameters.
    killing_signature: tuple["killing", "signature"];
    /// The type of the Levi subalgebra over the complex numbers, such as ``"A1 + A1"``; None without one.
    dynkin_type: value["dynkin_type"];
    /// The Betti numbers; None where they were not computed.
    betti: list["betti"];
    /// The dimension minus the generic rank of ``f([x, y])``.
    index: value["index"];
    /// The name of an isomorphic algebra, where one is found.
    identification: value["identification", "name"];
}

fn value<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer)
}

fn list<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer.cast_into::<PyList>()?.get_slice(0, usize::MAX).into_any())
}

fn tuple<'py>(_: &Bound<'py, PyAlgebra>, answer: Object<'py>) -> New<'py> {
    Ok(answer.cast_into::<PyList>()?.to_tuple().into_any())
}

fn subspace<'py>(algebra: &Bound<'py, PyAlgebra>, rows: Object<'py>) -> New<'py> {
    python(rows.py(), "structure", "subspace")?.call1((algebra, rows))
}

impl PyAlgebra {
    fn answers<'a>(slf: &'a Bound<'_, Self>) -> PyResult<&'a (Written, Py<PyAny>)> {
        let (py, algebra) = (slf.py(), slf.get());
        algebra.found.get_or_try_init(py, || -> PyResult<_> {
            let written = run(py, || {
                if matches!(algebra.values, Geometries::Float(_)) {
                    let error = "structure theory is exact, and the structure constants are floats";
                    let help = "give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'";
                    return Err(InputError::usage(error).help(help));
                }
                all_formats(&Info::of(&algebra.space.definition, &|_| ())?)
            })?;
            let report = python(py, "structure", "Report")?.call1((written.clone(),))?;
            Ok((written, report.unbind()))
        })
    }

    /// An entry of the report; None where a key before it is None.
    fn answer<'py>(slf: &Bound<'py, Self>, keys: &[&str]) -> New<'py> {
        let mut found = Self::answers(slf)?.1.bind(slf.py()).clone();
        for key in keys {
            if !found.is_none() {
                found = found.get_item(key)?;
            }
        }
        Ok(found)
    }
}

#[pymethods]
impl PyAlgebra {
    /// The structure as ``affinor info`` finds it: series, radical, Levi subalgebra, type, cohomology, ...
    ///
    /// The dict is the JSON document ``affinor.info/1``; ``print`` shows the table. The answers are exact; with parameters
    /// they hold for generic values. The computation is done once for an algebra.
    fn info<'py>(slf: &Bound<'py, Self>) -> New<'py> {
        let written = Self::answers(slf)?.0.clone();
        python(slf.py(), "structure", "Report")?.call1((written,))
    }

    /// The structure constants as input of another program: ``gap``, ``sage``, ``maple`` or ``sympy``.
    fn export(&self, py: Python<'_>, program: &str) -> PyResult<String> {
        let program = Program::from_name(program).ok_or_else(|| {
            let names = Program::ALL.map(Program::name).join(", ");
            PyValueError::new_err(format!("the programs are {names}, not {program:?}"))
        })?;
        run(py, || {
            each!(&self.values, geometry => {
                let algebra = geometry.frame_origin().algebra_for("input of other programs")?;
                Ok(program.structure(geometry.name(), algebra.labels(), algebra.structure_constants()))
            })
        })
    }
}
