//! How many cases of a property are drawn, and from which seed.
//!
//! A plain `cargo test` draws the same cases on every machine and writes no file.
//! `AFFINOR_FRESH=20 cargo test --release` draws twenty times as many, from a fresh seed for each test.
//! A failure then prints its smallest input, which becomes a test of its own, and the seed, which
//! `PROPTEST_RNG_SEED` takes beside the same `AFFINOR_FRESH`.

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;
use std::hash::{BuildHasher, RandomState};

/// The seed of a plain run.
const SEED: u64 = 2013;

/// The configuration of every property: `n` cases from the fixed seed, or `AFFINOR_FRESH` times `n`
/// from a fresh one.
pub fn cases(n: u32) -> ProptestConfig {
    let given = ProptestConfig::default();
    let fresh = std::env::var("AFFINOR_FRESH").ok().map(|times| {
        let parsed = times.parse().ok().filter(|times| *times > 0);
        parsed.unwrap_or_else(|| panic!("AFFINOR_FRESH={times} is no positive integer"))
    });
    let times: u32 = fresh.unwrap_or(1);
    let rng_seed = match (given.rng_seed, fresh) {
        (RngSeed::Fixed(seed), _) => RngSeed::Fixed(seed),
        (RngSeed::Random, None) => RngSeed::Fixed(SEED),
        (RngSeed::Random, Some(_)) => {
            let seed = RandomState::new().hash_one(n);
            // shown when the test fails
            eprintln!("repeat these cases: AFFINOR_FRESH={times} PROPTEST_RNG_SEED={seed}");
            RngSeed::Fixed(seed)
        }
    };
    ProptestConfig {
        cases: n.saturating_mul(times),
        max_global_rejects: given.max_global_rejects.saturating_mul(times),
        rng_seed,
        failure_persistence: None,
        ..given
    }
}
