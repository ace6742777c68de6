//! Problems of matrices that move by similarity.

use super::reader::Reader;
use super::{Column, Problem, Ready, Value};
use crate::definition::InputError;
use crate::definition::input::{Place, shown};
use crate::definition::written::{Number, Text};
use crate::simulation::{MatrixFlow, Method, on_matrices};
use nalgebra::DMatrix;

/// The keys of a flow.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlowKeys<'t> {
    #[serde(borrow)]
    kind: Text<'t>,
    #[serde(borrow)]
    positions: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    momenta: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    masses: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    momentum: Option<Vec<Vec<Number<'t>>>>,
    size: Option<usize>,
    #[serde(borrow)]
    modes: Option<Vec<Vec<Number<'t>>>>,
    seed: Option<u64>,
    degree: Option<usize>,
}

/// A flow, its numbers as formulas.
#[derive(Clone, Debug)]
pub(super) struct Matrices {
    pub flow: Flow,
    pub place: Place,
}

/// Which flow it is.
#[derive(Clone, Debug)]
pub(super) enum Flow {
    Toda { positions: Vec<Value>, momenta: Vec<Value> },
    Manakov { masses: Vec<Value>, momentum: Vec<Vec<Value>> },
    Zeitlin { size: usize, modes: Vec<Vec<Value>> },
    RandomZeitlin { size: usize, seed: u64, degree: usize },
}

impl Matrices {
    pub fn motion(
        &self,
        problem: &Problem,
        times: &[f64],
        values: &[f64],
    ) -> Result<Ready, InputError> {
        let method = problem.method.unwrap_or(Method::Isospectral);
        if !matches!(method, Method::Isospectral | Method::ComposedIsospectral) {
            let message = format!("the method {method} is not for flows of matrices");
            let help = "they have isospectral2 and isospectral4";
            return Err(InputError::mathematics(message).at(&self.place).help(help));
        }
        let Some(step) = problem.step_at(values)? else {
            let error = InputError::mathematics("a flow of matrices needs a step");
            return Err(error.at(&self.place));
        };
        let fourth = method == Method::ComposedIsospectral;
        let started = on_matrices(&self.flow(values)?, times[0], step, fourth);
        let (motion, names) = started.map_err(|error| InputError::from(error).at(&self.place))?;
        let column = |(name, watched)| Column { name, formula: None, watched };
        Ok(Ready {
            motion,
            method,
            times: times.to_vec(),
            columns: names.into_iter().map(column).collect(),
            events: vec![],
            inertia: None,
            notes: vec![],
        })
    }

    fn flow(&self, values: &[f64]) -> Result<MatrixFlow, InputError> {
        Ok(match &self.flow {
            Flow::Toda { positions, momenta } => {
                MatrixFlow::Toda(Value::all(positions, values)?, Value::all(momenta, values)?)
            }
            Flow::Manakov { masses, momentum } => {
                let rows: Result<Vec<Vec<f64>>, _> =
                    momentum.iter().map(|row| Value::all(row, values)).collect();
                let rows = rows?;
                let width = rows.first().map_or(0, Vec::len);
                if rows.iter().any(|row| row.len() != width) {
                    let error =
                        InputError::usage("the rows of the momentum have different lengths");
                    return Err(error.at(&self.place));
                }
                let matrix = DMatrix::from_row_slice(rows.len(), width, &rows.concat());
                MatrixFlow::Manakov(Value::all(masses, values)?, matrix)
            }
            Flow::Zeitlin { size, modes } => {
                let mut found = Vec::new();
                for mode in modes {
                    let numbers = Value::all(mode, values)?;
                    let whole = |x: f64| x.fract() == 0.0 && x.abs() < 1e6;
                    let &[l, m, w] = numbers.as_slice() else {
                        let error = InputError::usage("a mode is [l, m, coefficient]");
                        return Err(error.at(&self.place));
                    };
                    if !(whole(l) && whole(m) && l >= 0.0) {
                        let message = format!("there is no spherical harmonic ({l}, {m})");
                        return Err(InputError::usage(message).at(&self.place));
                    }
                    found.push((l as usize, m as i64, w));
                }
                MatrixFlow::Zeitlin(*size, found)
            }
            Flow::RandomZeitlin { size, seed, degree } => {
                MatrixFlow::RandomZeitlin(*size, *seed, *degree)
            }
        })
    }
}

impl FlowKeys<'_> {
    pub fn flow(&self, reader: &Reader) -> Result<Flow, InputError> {
        let source = reader.source;
        let missing = |keys: &str| {
            let message = format!("the flow {} needs {keys}", shown(&self.kind.0));
            InputError::usage(message).at(&source.key("flow"))
        };
        let rows = |rows: &Vec<Vec<Number>>| -> Result<Vec<Vec<Value>>, InputError> {
            rows.iter().map(|row| reader.values(row)).collect()
        };
        let keys = [
            ("positions", self.positions.is_some(), "toda"),
            ("momenta", self.momenta.is_some(), "toda"),
            ("masses", self.masses.is_some(), "manakov"),
            ("momentum", self.momentum.is_some(), "manakov"),
            ("size", self.size.is_some(), "zeitlin"),
            ("modes", self.modes.is_some(), "zeitlin"),
            ("seed", self.seed.is_some(), "zeitlin"),
            // modes say all
            ("degree", self.degree.is_some(), if self.modes.is_none() { "zeitlin" } else { "" }),
        ];
        let kind = &*self.kind.0;
        let known = keys.iter().any(|(.., owner)| *owner == kind);
        let idle = keys.iter().find(|(_, given, owner)| *given && known && *owner != kind);
        if let Some((key, ..)) = idle {
            let message = format!("the flow {kind} has no `{key}` here");
            return Err(InputError::usage(message).at(&source.key(key)).help("leave the key out"));
        }
        match kind {
            "toda" => {
                let both = self.positions.as_ref().zip(self.momenta.as_ref());
                let (positions, momenta) = both.ok_or_else(|| missing("positions and momenta"))?;
                let (positions, momenta) = (reader.values(positions)?, reader.values(momenta)?);
                Ok(Flow::Toda { positions, momenta })
            }
            "manakov" => {
                let both = self.masses.as_ref().zip(self.momentum.as_ref());
                let (masses, momentum) = both.ok_or_else(|| missing("masses and momentum"))?;
                Ok(Flow::Manakov { masses: reader.values(masses)?, momentum: rows(momentum)? })
            }
            "zeitlin" => {
                let size = self.size.ok_or_else(|| missing("a size"))?;
                match (&self.modes, self.seed) {
                    (Some(modes), None) => Ok(Flow::Zeitlin { size, modes: rows(modes)? }),
                    (None, Some(seed)) => {
                        let degree = self.degree.ok_or_else(|| missing("a degree"))?;
                        Ok(Flow::RandomZeitlin { size, seed, degree })
                    }
                    _ => Err(missing("modes, or else a seed and a degree")),
                }
            }
            other => {
                let message = format!("`{}` is no flow", shown(other));
                let error = InputError::usage(message).at(&source.whole(&self.kind.0));
                Err(error.help("the flows are toda, manakov, zeitlin"))
            }
        }
    }
}
