//! Ensembles: parameters on a grid, and random parameters.

use super::reader::{Reader, Written};
use crate::input::{
    InputError,
    forms::{Formulas, Text},
    numbers::numbers_in,
    shown,
};
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use serde::Deserialize;

/// The table `[ensemble]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnsembleKeys {
    pub grid: Option<Formulas>,
    pub random: Option<Formulas>,
    pub samples: Option<u64>,
    pub seed: Option<u64>,
}

/// The largest number of members.
const MAX_MEMBERS: u64 = 1_000_000_000;
/// The largest number of values of one parameter of a grid.
const MAX_POINTS: u32 = 1_000_000;

/// The parameters that an ensemble varies: all points of a grid, with random samples at each point.
#[derive(Clone, Debug)]
pub(super) struct Ensemble {
    /// The values of each parameter of the grid; the last parameter varies fastest.
    grid: Vec<(String, Vec<f64>)>,
    /// The distribution of each random parameter.
    random: Vec<(String, Distribution)>,
    /// The number of samples at each point of the grid.
    samples: u64,
    seed: u64,
}

/// A distribution of random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Distribution {
    /// A uniform distribution between two bounds.
    Uniform(f64, f64),
    /// A normal distribution with a mean and a standard deviation.
    Normal(f64, f64),
}

impl Ensemble {
    /// Reads an ensemble, and declares the parameters that occur only in it.
    pub fn read(keys: &EnsembleKeys, reader: &mut Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let all: Vec<_> = keys.grid.iter().chain(&keys.random).flat_map(|table| &table.0).collect();
        reader.refuse_empty("ensemble", all.is_empty() && keys.samples.is_none())?;
        let (mut grid, mut random) = (vec![], vec![]);
        for (name, text) in keys.grid.iter().flat_map(|table| &table.0) {
            grid.push((name.to_string(), points(text, reader)?));
        }
        for (name, text) in keys.random.iter().flat_map(|table| &table.0) {
            random.push((name.to_string(), distribution(text, reader)?));
        }
        for (at, (name, _)) in all.iter().enumerate() {
            if all[..at].iter().any(|(other, _)| other.content == name.content) {
                let message = format!("the parameter `{}` is varied twice", shown(name));
                return Err(InputError::usage(message).at(&source.at(name)));
            }
            if !reader.names.contains(&name.content) {
                reader.declare(name)?;
            }
        }
        let (samples, seed) = (keys.samples.unwrap_or(1), keys.seed.unwrap_or(0));
        let ensemble = Ensemble { grid, random, samples, seed };
        if ensemble.checked_size().is_none() {
            let message = format!("the number of members must be from 1 to {MAX_MEMBERS}");
            return Err(source.refused("ensemble", message));
        }
        Ok(ensemble)
    }

    /// The number of members; `None` if it exceeds the limit.
    pub fn checked_size(&self) -> Option<u64> {
        let points = self.grid.iter().map(|(_, values)| values.len() as u64);
        let size = points.chain([self.samples]).try_fold(1u64, |n, m| n.checked_mul(m))?;
        (1..=MAX_MEMBERS).contains(&size).then_some(size)
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        let grid = self.grid.iter().map(|(name, _)| name.as_str());
        grid.chain(self.random.iter().map(|(name, _)| name.as_str()))
    }

    /// Removes a parameter from the parameters that the ensemble varies.
    pub fn leave_out(&mut self, name: &str) {
        self.grid.retain(|(other, _)| other != name);
        self.random.retain(|(other, _)| other != name);
    }

    /// The values of the parameters for a member, in the order of the names. The values depend only
    /// on the seed and on the number of the member.
    pub fn values(&self, member: u64) -> Vec<f64> {
        let mut point = member / self.samples;
        let mut values = Vec::new();
        for (_, grid) in self.grid.iter().rev() {
            let n = grid.len() as u64;
            values.push(grid[(point % n) as usize]);
            point /= n;
        }
        values.reverse();
        let mut numbers = ChaCha8Rng::seed_from_u64(self.seed);
        numbers.set_stream(member);
        for (_, distribution) in &self.random {
            values.push(match *distribution {
                Distribution::Uniform(low, high) => low + (high - low) * numbers.random::<f64>(),
                Distribution::Normal(mean, deviation) => {
                    mean + deviation * numbers.sample::<f64, _>(StandardNormal)
                }
            });
        }
        values
    }
}

/// Parses `from .. to in n`, or a list of values.
fn points(text: &Text, reader: &Reader) -> Result<Vec<f64>, InputError> {
    let written = reader.written(text);
    let refused = |message: String| Err(InputError::usage(message).at(&written.place()));
    let range = written.text().split_once("..").and_then(|(from, rest)| {
        let (to, count) = rest.split_once(" in ")?;
        Some((from, to, count.trim().parse::<u32>().ok()?))
    });
    match range {
        Some((_, _, count)) if count > MAX_POINTS => {
            refused(format!("{count} points exceed the limit of {MAX_POINTS}"))
        }
        Some((from, to, count)) if count > 0 => {
            let [from, to] = [numbers(from, &written)?, numbers(to, &written)?].map(|[x]| x);
            let last = f64::from(count.max(2) - 1);
            Ok((0..count).map(|k| from + (to - from) * (f64::from(k) / last)).collect())
        }
        Some(_) => refused("the grid has no points: give at least one".into()),
        None => {
            let all = numbers_in(written.text(), written.source())?;
            if all.is_empty() {
                return refused("write a grid as \"0 .. 1 in 11\", or as a list of numbers".into());
            }
            Ok(all)
        }
    }
}

/// Parses `normal(mean, deviation)` or `uniform(from, to)`.
fn distribution(text: &Text, reader: &Reader) -> Result<Distribution, InputError> {
    let written = reader.written(text);
    let inside = |name: &str| {
        let rest = written.text().trim().strip_prefix(name)?.trim().strip_prefix('(')?;
        rest.strip_suffix(')')
    };
    let refused = |message: String| Err(InputError::usage(message).at(&written.place()));
    if let Some(inside) = inside("normal") {
        let [mean, deviation] = numbers(inside, &written)?;
        if deviation < 0.0 {
            return refused(format!("the deviation {deviation} is negative"));
        }
        return Ok(Distribution::Normal(mean, deviation));
    }
    if let Some(inside) = inside("uniform") {
        let [low, high] = numbers(inside, &written)?;
        return Ok(Distribution::Uniform(low, high));
    }
    refused("write the law as normal(mean, deviation) or uniform(from, to)".into())
}

/// Parses exactly `N` numbers in a piece of a text.
fn numbers<const N: usize>(text: &str, written: &Written) -> Result<[f64; N], InputError> {
    let found = numbers_in(text, written.source())?;
    <[f64; N]>::try_from(found).map_err(|found| {
        let message = format!("{} numbers are given instead of {N}", found.len());
        InputError::usage(message).at(&written.place())
    })
}
