//! Mechanisms of bodies and joints: their mobility, and the dynamics of trees for rows of arrays.

use crate::arrays::{Input, batch, common, fresh};
use crate::class::{immutable, properties};
use crate::errors::{raise, wrong};
use crate::group::Array;
use crate::report::{Written, all_formats};
use crate::run::run;
use affinor::mechanism::{Joint, MovingTree, Tree};
use affinor_documents::input::InputError;
use affinor_documents::mechanism::MechanismFile;
use affinor_documents::problem::tree;
use affinor_documents::report::MobilityReport;
use affinor_tensors::stop::checkpoint;
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use std::sync::Arc;

/// The number of rows between two polls for a signal.
const ROWS: usize = 256;

/// The name and the type of a joint, its bodies, and the ranges of its numbers and rates.
type JointRow = (String, &'static str, [usize; 2], [usize; 2], [usize; 2]);

/// A mechanism of bodies and joints.
#[pyclass(name = "Mechanism", frozen, subclass, module = "affinor._engine")]
pub struct PyMechanism {
    file: MechanismFile,
    /// The tree, or why the file does not define one.
    tree: Result<Arc<Tree>, InputError>,
}

/// The numbers of a row that a function of a tree reads and computes.
#[derive(Clone, Copy)]
enum Row {
    Numbers,
    Rates,
}

immutable! { PyMechanism }

properties! { PyMechanism, own:
    /// Name of the mechanism.
    name: &str = &own.file.name;
    /// Names of the bodies.
    bodies: Vec<String> = own.file.mechanism.bodies().to_vec();
}

#[pymethods]
impl PyMechanism {
    /// Reads a mechanism from a file, or from a text with a name for messages. The settings override parameters.
    #[new]
    #[pyo3(signature = (path=None, text=None, set=vec![], gravity=None))]
    fn new(
        py: Python<'_>,
        path: Option<String>,
        text: Option<(String, String)>,
        set: Vec<String>,
        gravity: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        run(py, || {
            let (file, tree) = match (&path, &text) {
                (Some(path), None) => {
                    (MechanismFile::read(path, &set)?, tree::read(path, &set, gravity))
                }
                (None, Some((name, text))) => (
                    MechanismFile::parse(name, text, &set)?,
                    tree::parse(name, text, &set, gravity),
                ),
                _ => return Err(InputError::usage("give a file or a text")),
            };
            Ok(PyMechanism { file, tree: tree.map(Arc::new) })
        })
    }

    /// For each joint its name, its type, the indices of its bodies, and the ranges of its numbers and of its rates.
    /// Without a tree, the ranges are empty.
    #[getter]
    fn _joints(&self) -> Vec<JointRow> {
        let range = |joint: usize, numbers: bool| match &self.tree {
            Ok(tree) => {
                let range = if numbers { tree.numbers(joint) } else { tree.rates(joint) };
                [range.start, range.end]
            }
            Err(_) => [0, 0],
        };
        let joints = self.file.mechanism.joints().iter().enumerate();
        let row = |(at, joint): (usize, &Joint<_>)| {
            let kind = joint.kind().name();
            (joint.name.clone(), kind, joint.bodies, range(at, true), range(at, false))
        };
        joints.map(row).collect()
    }

    /// The number of numbers of a configuration, and the number of rates.
    #[getter]
    fn _sizes(&self, py: Python<'_>) -> PyResult<(usize, usize)> {
        let tree = self.tree(py)?;
        Ok((tree.home().len(), tree.freedom()))
    }

    /// The numbers of the position of the file.
    #[getter]
    fn _home(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        Ok(self.tree(py)?.home())
    }

    fn _mobility(&self, py: Python<'_>) -> PyResult<Written> {
        run(py, || all_formats(&MobilityReport::of(&self.file)?))
    }

    /// Accelerations of joints for joint forces.
    fn _forward<'py>(
        &self,
        py: Python<'py>,
        q: Input<'py>,
        v: Input<'py>,
        tau: Input<'py>,
    ) -> PyResult<Array<'py>> {
        let freedom = self.tree(py)?.freedom();
        self.map(
            py,
            [("q", Row::Numbers, q), ("v", Row::Rates, v), ("tau", Row::Rates, tau)],
            &[freedom],
            |moving, [q, v, tau], out| {
                moving.place(q, v);
                Ok(moving.forward(tau, out)?)
            },
        )
    }

    /// Joint forces for accelerations of joints.
    fn _inverse<'py>(
        &self,
        py: Python<'py>,
        q: Input<'py>,
        v: Input<'py>,
        a: Input<'py>,
    ) -> PyResult<Array<'py>> {
        let freedom = self.tree(py)?.freedom();
        self.map(
            py,
            [("q", Row::Numbers, q), ("v", Row::Rates, v), ("a", Row::Rates, a)],
            &[freedom],
            |moving, [q, v, a], out| {
                moving.place(q, v);
                moving.inverse(a, out);
                Ok(())
            },
        )
    }

    fn _mass_matrix<'py>(&self, py: Python<'py>, q: Input<'py>) -> PyResult<Array<'py>> {
        let freedom = self.tree(py)?.freedom();
        let rest = vec![0.0; freedom];
        self.map(py, [("q", Row::Numbers, q)], &[freedom, freedom], |moving, [q], out| {
            moving.place(q, &rest);
            // the matrix is symmetric, so its columns are its rows
            out.copy_from_slice(moving.mass_matrix().as_slice());
            Ok(())
        })
    }

    /// The kinetic and the potential energy.
    fn _energies<'py>(
        &self,
        py: Python<'py>,
        q: Input<'py>,
        v: Input<'py>,
    ) -> PyResult<Array<'py>> {
        self.map(py, [("q", Row::Numbers, q), ("v", Row::Rates, v)], &[2], |moving, [q, v], out| {
            moving.place(q, v);
            out.copy_from_slice(&[moving.kinetic(), moving.potential()]);
            Ok(())
        })
    }

    fn _momentum<'py>(
        &self,
        py: Python<'py>,
        q: Input<'py>,
        v: Input<'py>,
    ) -> PyResult<Array<'py>> {
        self.map(py, [("q", Row::Numbers, q), ("v", Row::Rates, v)], &[6], |moving, [q, v], out| {
            moving.place(q, v);
            out.copy_from_slice(moving.momentum().as_slice());
            Ok(())
        })
    }

    /// The poses of all bodies: quaternions `w, x, y, z`, and positions.
    fn _poses<'py>(&self, py: Python<'py>, q: Input<'py>) -> PyResult<Array<'py>> {
        let rest = vec![0.0; self.tree(py)?.freedom()];
        let bodies = self.file.mechanism.bodies().len();
        self.map(py, [("q", Row::Numbers, q)], &[bodies, 7], |moving, [q], out| {
            moving.place(q, &rest);
            for (row, pose) in out.chunks_mut(7).zip(moving.poses()) {
                let (r, p) = (pose.rotation, pose.translation);
                row.copy_from_slice(&[r.w, r.i, r.j, r.k, p.x, p.y, p.z]);
            }
            Ok(())
        })
    }
}

impl PyMechanism {
    fn tree(&self, py: Python<'_>) -> PyResult<&Arc<Tree>> {
        self.tree.as_ref().map_err(|error| raise(py, error))
    }

    /// Applies a function of the moving tree to the rows of arrays.
    fn map<'py, const N: usize>(
        &self,
        py: Python<'py>,
        arguments: [(&str, Row, Input<'py>); N],
        row: &[usize],
        function: impl Fn(&mut MovingTree, [&[f64]; N], &mut [f64]) -> Result<(), InputError>
        + Send
        + Sync,
    ) -> PyResult<Array<'py>> {
        let tree = self.tree(py)?;
        let (numbers, freedom) = (tree.home().len(), tree.freedom());
        let width = |row: Row| match row {
            Row::Numbers => [numbers],
            Row::Rates => [freedom],
        };
        let mut whole = vec![];
        for (name, kind, array) in &arguments {
            whole = common(&whole, batch(name, array.shape(), &width(*kind))?)?;
        }
        let out = fresh(py, &whole, row)?;
        {
            let mut inputs = vec![];
            for (name, kind, array) in &arguments {
                let own = batch(name, array.shape(), &width(*kind))?;
                let rows = array.rows(own, &whole);
                if let Some(value) = rows.list().iter().find(|value| !value.is_finite()) {
                    return Err(wrong(name, "finite numbers", &value.to_string()));
                }
                inputs.push(rows);
            }
            let mut target = out.readwrite();
            let target = target.as_slice_mut()?;
            let size: usize = row.iter().product();
            run(py, || {
                let mut moving = MovingTree::new(tree.clone());
                // without numbers in a row there is nothing to compute
                for (at, out) in target.chunks_mut(size.max(1)).enumerate() {
                    if at % ROWS == 0 {
                        checkpoint();
                    }
                    function(&mut moving, std::array::from_fn(|k| inputs[k].row(at)), out)?;
                }
                Ok(())
            })?;
        }
        Ok(out)
    }
}
