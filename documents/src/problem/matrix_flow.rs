//! Problems of isospectral flows: matrices that move by similarity.

use super::keys::{FlowKeys, OF_DYNAMICS, OF_GROUPS};
use super::member::Member;
use super::reader::{Reader, Value};
use super::ready::{Column, Ready};
use crate::definition::input::{InputError, shown};
use crate::definition::source::Place;
use affinor::mechanics::motions::{MatrixFlow as Isospectral, Method, on_matrices};
use nalgebra::DMatrix;

/// An isospectral flow of matrices.
#[derive(Clone, Debug)]
pub(super) struct MatrixFlow {
    flow: Flow,
    place: Place,
}

/// The kind of a flow, its numbers as formulas.
#[derive(Clone, Debug)]
enum Flow {
    Toda { positions: Vec<Value>, momenta: Vec<Value> },
    Manakov { masses: Vec<Value>, momentum: Vec<Vec<Value>> },
    Zeitlin { size: usize, modes: Vec<Vec<Value>> },
    RandomZeitlin { size: usize, seed: u64, degree: usize },
}

impl MatrixFlow {
    pub fn read(flow: &FlowKeys, reader: &Reader) -> Result<Self, InputError> {
        reader.refuse("a flow of matrices", &[&OF_GROUPS[..], &OF_DYNAMICS].concat())?;
        Ok(MatrixFlow { flow: Flow::read(flow, reader)?, place: reader.source.key("flow") })
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        let method = member.method().unwrap_or(Method::Isospectral);
        if !matches!(method, Method::Isospectral | Method::ComposedIsospectral) {
            let message = format!("the method {method} is not for flows of matrices");
            let help = "the methods for flows are isospectral2 and isospectral4";
            return Err(InputError::mathematics(message).at(&self.place).help(help));
        }
        let step = member.needed_step("a flow of matrices");
        let step = step.map_err(|error| error.or_at(&self.place))?;
        let fourth = method == Method::ComposedIsospectral;
        let flow = self.isospectral(&member.values())?;
        let started = on_matrices(&flow, member.times[0], step, fourth);
        let (motion, names) = started.map_err(|error| InputError::from(error).at(&self.place))?;
        let columns = names.into_iter().map(|(name, watched)| Column::new(name, watched)).collect();
        Ok(Ready::new((motion, method), &member.times, columns, vec![]))
    }

    /// The flow at these values of the parameters.
    fn isospectral(&self, values: &[f64]) -> Result<Isospectral, InputError> {
        Ok(match &self.flow {
            Flow::Toda { positions, momenta } => {
                Isospectral::Toda(Value::all(positions, values)?, Value::all(momenta, values)?)
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
                Isospectral::Manakov(Value::all(masses, values)?, matrix)
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
                Isospectral::Zeitlin(*size, found)
            }
            Flow::RandomZeitlin { size, seed, degree } => {
                Isospectral::RandomZeitlin(*size, *seed, *degree)
            }
        })
    }
}

impl Flow {
    fn read(keys: &FlowKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let missing = |needed: &str| {
            let message = format!("the flow {} needs {needed}", shown(&keys.kind));
            InputError::usage(message).at(&source.key("flow"))
        };
        let given = [
            ("positions", keys.positions.is_some(), "toda"),
            ("momenta", keys.momenta.is_some(), "toda"),
            ("masses", keys.masses.is_some(), "manakov"),
            ("momentum", keys.momentum.is_some(), "manakov"),
            ("size", keys.size.is_some(), "zeitlin"),
            ("modes", keys.modes.is_some(), "zeitlin"),
            ("seed", keys.seed.is_some(), "zeitlin"),
            // modes leave nothing random
            ("degree", keys.degree.is_some(), if keys.modes.is_none() { "zeitlin" } else { "" }),
        ];
        let kind = &*keys.kind;
        let known = given.iter().any(|(.., owner)| *owner == kind);
        let ignored = given.iter().find(|(_, given, owner)| *given && known && *owner != kind);
        if let Some((key, ..)) = ignored {
            let message = format!("the flow {kind} has no `{key}` here");
            return Err(InputError::usage(message)
                .at(&source.key(&format!("flow.{key}")))
                .help("leave the key out"));
        }
        match kind {
            "toda" => {
                let both = keys.positions.as_ref().zip(keys.momenta.as_ref());
                let (positions, momenta) = both.ok_or_else(|| missing("positions and momenta"))?;
                let (positions, momenta) = (reader.values(positions)?, reader.values(momenta)?);
                Ok(Flow::Toda { positions, momenta })
            }
            "manakov" => {
                let both = keys.masses.as_ref().zip(keys.momentum.as_ref());
                let (masses, momentum) = both.ok_or_else(|| missing("masses and momentum"))?;
                Ok(Flow::Manakov {
                    masses: reader.values(masses)?,
                    momentum: reader.rows(momentum)?,
                })
            }
            "zeitlin" => {
                let size = keys.size.ok_or_else(|| missing("a size"))?;
                match (&keys.modes, keys.seed) {
                    (Some(modes), None) => Ok(Flow::Zeitlin { size, modes: reader.rows(modes)? }),
                    (None, Some(seed)) => {
                        let degree = keys.degree.ok_or_else(|| missing("a degree"))?;
                        Ok(Flow::RandomZeitlin { size, seed, degree })
                    }
                    _ => Err(missing("modes, or else a seed and a degree")),
                }
            }
            other => {
                let message = format!("`{}` is no flow", shown(other));
                let error = InputError::usage(message).at(&source.at(&keys.kind));
                Err(error.help("the flows are toda, manakov, zeitlin"))
            }
        }
    }
}
