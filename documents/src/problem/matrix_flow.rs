//! Problems with isospectral flows of matrices.

use super::integrator::Member;
use super::keys::{FlowKeys, OF_CHARTS, OF_DYNAMICS, OF_GROUPS, OF_HOMOGENEOUS};
use super::reader::{Reader, Value};
use super::ready::{Column, Ready};
use crate::input::{InputError, Place, shown};
use affinor::mechanics::simulation::{Class, MatrixFlow as Isospectral, Method, Started};

/// An isospectral flow of matrices.
#[derive(Clone, Debug)]
pub(super) struct MatrixFlow {
    flow: Flow,
    place: Place,
}

/// The kind of a flow; its numbers are formulas.
#[derive(Clone, Debug)]
enum Flow {
    Toda { positions: Vec<Value>, momenta: Vec<Value> },
    Manakov { masses: Vec<Value>, momentum: Vec<Vec<Value>> },
    Zeitlin { size: usize, modes: Vec<Vec<Value>> },
    RandomZeitlin { size: usize, seed: u64, degree: usize },
}

/// The kinds of flows: the name, the allowed keys, and a description of the required keys.
const KINDS: [(&str, &[&str], &str); 3] = [
    ("toda", &["positions", "momenta"], "positions and momenta"),
    ("manakov", &["masses", "momentum"], "masses and momentum"),
    (
        "zeitlin",
        &["size", "modes", "seed", "degree"],
        "a size and modes, or a size, a seed and a degree",
    ),
];

impl MatrixFlow {
    pub fn read(flow: &FlowKeys, reader: &Reader) -> Result<Self, InputError> {
        reader.refuse(
            "a flow of matrices",
            &[&OF_GROUPS[..], &OF_DYNAMICS, &OF_CHARTS, &OF_HOMOGENEOUS].concat(),
        )?;
        Ok(MatrixFlow { flow: Flow::read(flow, reader)?, place: reader.source.key("flow") })
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        let method = member.method().unwrap_or(Method::Isospectral2);
        if method.class() != Class::MatrixFlow {
            let message = format!("the method {method} does not support flows of matrices");
            let names = Method::names_of(&[Class::MatrixFlow]);
            let help = format!("the methods for flows are {}", names.replace(", ", " and "));
            return Err(InputError::mathematics(message).at(&self.place).help(help));
        }
        let step = member.needed_step("a flow of matrices");
        let step = step.map_err(|error| error.or_at(&self.place))?;
        let flow = self.isospectral(&member.values())?;
        let started = flow.start(member.times[0], method, step);
        let started = started.map_err(|error| InputError::from(error).at(&self.place))?;
        let columns = started.columns.into_iter();
        let columns = columns.map(|(name, watched)| Column::new(name, watched)).collect();
        let started = Started { motion: started.motion, method };
        Ok(Ready::new(started, &member.times, columns, vec![]))
    }

    /// The flow, for these values of the parameters.
    fn isospectral(&self, values: &[f64]) -> Result<Isospectral, InputError> {
        Ok(match &self.flow {
            Flow::Toda { positions, momenta } => {
                Isospectral::Toda(Value::all(positions, values)?, Value::all(momenta, values)?)
            }
            Flow::Manakov { masses, momentum } => {
                let momentum = Value::matrix("momentum", momentum, values, &self.place)?;
                Isospectral::Manakov(Value::all(masses, values)?, momentum)
            }
            Flow::Zeitlin { size, modes } => {
                let mut found = Vec::new();
                for mode in modes {
                    let numbers = Value::all(mode, values)?;
                    let whole = |x: f64| x.fract() == 0.0 && x.abs() < 1e6;
                    let &[l, m, w] = numbers.as_slice() else {
                        let error = InputError::usage("write a mode as [l, m, coefficient]");
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
        let kind = &*keys.kind;
        let Some((_, own, needed)) = KINDS.iter().find(|(name, ..)| *name == kind) else {
            let error = InputError::usage(format!("`{}` is not a flow", shown(kind)));
            let help = "choose toda, manakov or zeitlin";
            return Err(error.at(&reader.source.at(&keys.kind)).help(help));
        };
        // forbids the seed and the degree if modes are given
        let own = if keys.modes.is_some() { &own[..own.len().min(3)] } else { own };
        for key in KINDS.iter().flat_map(|(_, keys, _)| *keys).filter(|key| !own.contains(key)) {
            reader.refuse(&format!("the flow {kind}"), &[&format!("flow.{key}")])?;
        }
        Ok(match keys {
            FlowKeys { positions: Some(positions), momenta: Some(momenta), .. } => Flow::Toda {
                positions: reader.values(positions)?,
                momenta: reader.values(momenta)?,
            },
            FlowKeys { masses: Some(masses), momentum: Some(momentum), .. } => {
                Flow::Manakov { masses: reader.values(masses)?, momentum: reader.rows(momentum)? }
            }
            &FlowKeys { size: Some(size), modes: Some(ref modes), seed: None, .. } => {
                Flow::Zeitlin { size, modes: reader.rows(modes)? }
            }
            &FlowKeys { size: Some(size), seed: Some(seed), degree: Some(degree), .. } => {
                Flow::RandomZeitlin { size, seed, degree }
            }
            _ => {
                let message = format!("the flow {kind} needs {needed}");
                return Err(reader.source.refused("flow", message));
            }
        })
    }
}
