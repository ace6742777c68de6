//! Ensembles: parameters over a grid and at random.

use super::reader::Reader;
use crate::definition::input::{InputError, Place, Source, shown};
use crate::definition::numbers;
use crate::definition::written::{Text, TextsText};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The most members.
const MAX_MEMBERS: u64 = 1_000_000_000;
/// The most values of one parameter of a grid.
const MAX_POINTS: u32 = 1_000_000;

/// The keys of an ensemble.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnsembleKeys<'t> {
    #[serde(borrow)]
    grid: Option<TextsText<'t>>,
    #[serde(borrow)]
    random: Option<TextsText<'t>>,
    samples: Option<u64>,
    seed: Option<u64>,
}

/// Which values the members of an ensemble have: every point of a grid, each with as many random samples.
#[derive(Clone, Debug)]
pub(super) struct Ensemble {
    /// Values by name; the last name runs fastest.
    pub grid: Vec<(String, Vec<f64>)>,
    /// Distributions by name.
    pub random: Vec<(String, Distribution)>,
    /// Samples at each point of the grid.
    pub samples: u64,
    /// The seed.
    pub seed: u64,
}

/// A distribution of random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Distribution {
    /// Between two bounds.
    Uniform(f64, f64),
    /// By mean and standard deviation.
    Normal(f64, f64),
}

impl Ensemble {
    /// How many members there are; none if there are none or too many.
    pub fn checked_size(&self) -> Option<u64> {
        let points = self.grid.iter().map(|(_, values)| values.len() as u64);
        let size = points.chain([self.samples]).try_fold(1u64, |n, m| n.checked_mul(m))?;
        (1..=MAX_MEMBERS).contains(&size).then_some(size)
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        let grid = self.grid.iter().map(|(name, _)| name.as_str());
        grid.chain(self.random.iter().map(|(name, _)| name.as_str()))
    }

    /// Varies a parameter no longer.
    pub fn leave_out(&mut self, name: &str) {
        self.grid.retain(|(other, _)| other != name);
        self.random.retain(|(other, _)| other != name);
    }

    /// The values of a member, in the order of the names. They depend on the seed and its number alone, and not on
    /// what was asked before.
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

impl EnsembleKeys<'_> {
    /// Whether it varies nothing, and has no samples of that either.
    pub fn is_empty(&self) -> bool {
        let varied = self.grid.iter().chain(&self.random);
        self.samples.is_none() && varied.map(|table| table.0.len()).sum::<usize>() == 0
    }

    pub fn ensemble(&self, reader: &mut Reader) -> Result<Ensemble, InputError> {
        let source = reader.source;
        let (mut grid, mut random) = (vec![], vec![]);
        for (name, text) in self.grid.iter().flat_map(|table| &table.0) {
            grid.push((name.0.to_string(), points(text, reader)?));
        }
        for (name, text) in self.random.iter().flat_map(|table| &table.0) {
            random.push((name.0.to_string(), distribution(text, reader)?));
        }
        let all = self.grid.iter().chain(&self.random).flat_map(|table| &table.0);
        let mut seen: Vec<&str> = vec![];
        for (name, _) in all {
            if seen.contains(&&*name.0) {
                let message = format!("`{}` is varied twice", shown(&name.0));
                return Err(InputError::usage(message).at(&source.whole(&name.0)));
            }
            seen.push(&name.0);
            if !reader.names.contains(&name.0.to_string()) {
                reader.declare(name)?;
            }
        }
        let (samples, seed) = (self.samples.unwrap_or(1), self.seed.unwrap_or(0));
        let ensemble = Ensemble { grid, random, samples, seed };
        if ensemble.checked_size().is_none() {
            let message = format!("an ensemble has between 1 and {MAX_MEMBERS} members");
            return Err(InputError::usage(message).at(&source.key("ensemble")));
        }
        Ok(ensemble)
    }
}

/// `from .. to in n`, or a list of values.
fn points(text: &Text, reader: &Reader) -> Result<Vec<f64>, InputError> {
    let written = reader.written(text);
    let range = written.text.split_once("..").and_then(|(from, rest)| {
        let (to, count) = rest.split_once(" in ")?;
        Some((from.trim(), to.trim(), count.trim().parse::<u32>().ok()?))
    });
    let number = |text: &str| numbers_of(text, 1, &written.place).map(|found| found[0]);
    match range {
        Some((_, _, count)) if count > MAX_POINTS => {
            let message = format!("{count} points are too many, the limit is {MAX_POINTS}");
            Err(InputError::usage(message).at(&written.place))
        }
        Some((from, to, count)) if count > 0 => {
            let (from, to) = (number(from)?, number(to)?);
            let last = f64::from(count.max(2) - 1);
            Ok((0..count).map(|k| from + (to - from) * (f64::from(k) / last)).collect())
        }
        Some(_) => Err(InputError::usage("a grid has at least one point").at(&written.place)),
        None => {
            let all = numbers(&Source::new("a grid", &written.text));
            let all = all.map_err(|error| InputError::usage(error.message).at(&written.place))?;
            if all.is_empty() {
                let error = InputError::usage("a grid is \"0 .. 1 in 11\", or a list of numbers");
                return Err(error.at(&written.place));
            }
            Ok(all)
        }
    }
}

/// `normal(mean, deviation)` or `uniform(from, to)`.
fn distribution(text: &Text, reader: &Reader) -> Result<Distribution, InputError> {
    let written = reader.written(text);
    let inside = |name: &str| {
        let rest = written.text.trim().strip_prefix(name)?.trim().strip_prefix('(')?;
        rest.strip_suffix(')')
    };
    if let Some(inside) = inside("normal") {
        let found = numbers_of(inside, 2, &written.place)?;
        if found[1] < 0.0 {
            let message = format!("a deviation is not negative, as {} is", found[1]);
            return Err(InputError::usage(message).at(&written.place));
        }
        return Ok(Distribution::Normal(found[0], found[1]));
    }
    if let Some(inside) = inside("uniform") {
        let found = numbers_of(inside, 2, &written.place)?;
        return Ok(Distribution::Uniform(found[0], found[1]));
    }
    let message = "this is neither normal(mean, deviation) nor uniform(from, to)";
    Err(InputError::usage(message).at(&written.place))
}

fn numbers_of(text: &str, count: usize, place: &Place) -> Result<Vec<f64>, InputError> {
    let found = numbers(&Source::new("a value", text));
    let found = found.map_err(|error| InputError::usage(error.message).at(place))?;
    if found.len() == count {
        return Ok(found);
    }
    let message = format!("{} numbers stand here instead of {count}", found.len());
    Err(InputError::usage(message).at(place))
}
