//! Structure theory of Lie algebras.

use crate::algebra::PyAlgebra;
use crate::class::{New, Object};
use crate::geometries::{Geometries, each};
use crate::report::{Written, all_formats};
use crate::run::run;
use crate::values::python;
use affinor_documents::input::InputError;
use affinor_documents::report::{Coefficients, Info, Program};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;

/// Defines properties that are entries of the report of the structure: each row has the name, the form of the value,
/// and the keys.
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
    /// Whether the Killing form is nondegenerate.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so(4)").is_semisimple, LieAlgebra("so(4)").is_simple
    /// (True, False)
    is_semisimple: value["semisimple"];
    /// Whether the algebra is not abelian, and its only ideals over the reals are zero and the algebra itself; None if
    /// undecided.
    is_simple: value["simple"];
    /// Whether the centre is zero and all derivations are inner; None if undecided.
    is_complete: value["complete"];
    /// Length of the lower central series; None if the algebra is not nilpotent.
    nilpotency_class: value["nilpotency_class"];
    /// Length of the derived series; None if the algebra is not solvable.
    derived_length: value["derived_length"];
    /// Dimensions of the derived series ``L, [L, L], ...`` until they are stable.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("se(2)").derived_series
    /// [3, 2, 0]
    derived_series: list["derived_series"];
    /// Dimensions of the lower central series ``L, [L, L], [L, [L, L]], ...`` until they are stable.
    lower_central_series: list["lower_central_series"];
    /// Dimensions of the upper central series ``0, centre, ...`` until they are stable.
    upper_central_series: list["upper_central_series"];
    /// Basis of the centre, one row per vector: an object array of the shape (dimension of the centre, n).
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("heisenberg(3)").centre
    /// array([[Fraction(0, 1), Fraction(0, 1), Fraction(1, 1)]], dtype=object)
    centre: subspace["centre", "basis"];
    /// Basis of the solvable radical, one row per vector: an object array of the shape (dimension of the radical, n).
    radical: subspace["radical", "basis"];
    /// Basis of the nilradical, one row per vector: an object array of the shape (dimension of the nilradical, n).
    nilradical: subspace["nilradical", "basis"];
    /// Basis of a Levi subalgebra, one row per vector: an object array of the shape (dimension, n).
    levi_subalgebra: subspace["levi", "basis"];
    /// Basis of a Cartan subalgebra, one row per vector: an object array of the shape (rank, n).
    cartan_subalgebra: subspace["cartan_subalgebra", "basis"];
    /// Dimension of a Cartan subalgebra.
    rank: value["rank"];
    /// Numbers of positive, negative and zero squares of the Killing form; None if these numbers depend on parameters.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("sl(2)").killing_signature
    /// (2, 1, 0)
    killing_signature: tuple["killing", "signature"];
    /// Type of the Levi subalgebra over the complex numbers, such as ``"A1 + A1"``; None without a Levi subalgebra.
    dynkin_type: value["dynkin_type"];
    /// Betti numbers of the Lie algebra cohomology in degrees 0, 1, ..., n; None if they were not computed.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so3").betti
    /// [1, 0, 0, 1]
    betti: list["betti"];
    /// Index: the dimension minus the generic rank of the matrix ``f([e_i, e_j])`` for ``f`` in the dual space.
    index: value["index"];
    /// Catalogue name of an isomorphic algebra; None if none was found.
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
            let written = run(py, || algebra.written(&Coefficients::Trivial))?;
            let report = python(py, "structure", "Report")?.call1((written.clone(),))?;
            Ok((written, report.unbind()))
        })
    }

    fn written(&self, coefficients: &Coefficients) -> Result<Written, InputError> {
        if matches!(self.values, Geometries::Float(_)) {
            let error =
                "structure theory needs exact numbers, but the structure constants are floats";
            let help =
                "give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'";
            return Err(InputError::usage(error).help(help));
        }
        all_formats(&Info::with_coefficients(&self.space.definition, coefficients, &|_| ())?)
    }

    /// An entry of the report; None if one of the keys leads to None.
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
    /// Structure report: series, radical, Levi subalgebra, type, cohomology and more.
    ///
    /// The report is the JSON document ``affinor.info/1`` as a dict; ``print`` shows the table of ``affinor info``. The
    /// answers are exact. If there are parameters, the answers hold for generic values. The report is computed once for
    /// each algebra.
    ///
    /// Parameters
    /// ----------
    /// coefficients : str, optional
    ///     Adds the dimensions of the cohomology with coefficients in a module, under the key ``cohomology``:
    ///     ``"adjoint"``, ``"coadjoint"``, or a matrix for each basis vector as text.
    ///
    /// Returns
    /// -------
    /// Report
    ///
    /// Raises
    /// ------
    /// InputError
    ///     The structure constants are floats.
    ///
    /// Examples
    /// --------
    /// >>> LieAlgebra("so(4)").info()["dynkin_type"]
    /// 'A1 + A1'
    /// >>> LieAlgebra("se(3)").info(coefficients="adjoint")["cohomology"]["numbers"]
    /// [0, 1, 1, 0, 1, 1, 0]
    #[pyo3(signature = (*, coefficients = None))]
    fn info<'py>(slf: &Bound<'py, Self>, coefficients: Option<&str>) -> New<'py> {
        let algebra = slf.get();
        let written = match coefficients {
            Some(text) => run(slf.py(), || algebra.written(&text.parse()?))?,
            None => Self::answers(slf)?.0.clone(),
        };
        python(slf.py(), "structure", "Report")?.call1((written,))
    }

    /// Structure constants as input for another program.
    ///
    /// Parameters
    /// ----------
    /// program : str
    ///     ``"gap"``, ``"sage"``, ``"maple"`` or ``"sympy"``.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Examples
    /// --------
    /// >>> print(LieAlgebra("heisenberg(3)").export("sage"), end="")
    /// # heisenberg(3)
    /// L = LieAlgebra(QQ, {
    ///     ('x1', 'y1'): {'z': 1},
    /// }, names='x1,y1,z')
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
