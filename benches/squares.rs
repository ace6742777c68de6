//! Tensor squares of all irreducible representations up to a dimension, of all simple types of rank 2 to 8.
//!
//! `cargo bench -p affinor-benches --bench squares -- [DIMENSION]`, by default 100000. A line for each type: the number of
//! representations, the number of components of all squares, and seconds on one thread. The sums of dimensions are
//! compared. Rank 1 is left out: its squares up to 100000 have 5e9 components.

use affinor::algebra::roots::{CartanType, Series};
use affinor::representation::{HighestWeight, ReductiveAlgebra};
use std::time::Instant;

fn main() {
    let dimension = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(100_000);
    let (mut squares, begin) = (0, Instant::now());
    for rank in 2..=8 {
        for series in [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G]
        {
            let Ok(factor) = CartanType::new(series, rank) else { continue };
            let algebra = ReductiveAlgebra::new([factor], 0);
            let start = Instant::now();
            let weights = HighestWeight::up_to(&algebra, dimension).unwrap();
            let mut components = 0;
            for weight in &weights {
                let square = weight.tensor(weight).unwrap();
                let dimension = weight.dimension();
                assert_eq!(square.dimension().to_string(), (&dimension * &dimension).to_string());
                components += square.components().len();
            }
            squares += weights.len();
            let seconds = start.elapsed().as_secs_f64();
            println!(
                "{factor}: {} squares, {components} components, {seconds:.3} s",
                weights.len()
            );
        }
    }
    println!("{squares} squares in {:.3} s", begin.elapsed().as_secs_f64());
}
