//! Ensembles: parameters over a grid and at random.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The most members.
pub(super) const MAX_MEMBERS: u64 = 1_000_000_000;

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
