//! Rows of one method for many step sizes or tolerances.

use crate::problem::Problem;
use std::hint::black_box;
use std::time::Instant;

/// The parts of a state that are compared: in most problems the entries of the element, and the body momentum.
pub type Seen = Vec<Vec<f64>>;

/// The sweep of a method ends after a run that takes longer than this, in seconds.
const LONG: f64 = 0.1;
/// The seconds of a batch, and the number of batches.
const BATCH: f64 = 0.008;
const BATCHES: usize = 5;

/// Rows of a problem.
pub struct Sweep<'p> {
    /// The name of the problem in the rows.
    pub problem: &'static str,
    /// The problem itself, with its end time.
    pub reference: &'p Problem,
}

impl Sweep<'_> {
    /// A method without a parameter.
    pub fn once<T>(&self, method: &str, run: impl Fn() -> Option<T>, seen: impl Fn(&T) -> Seen) {
        self.row(method, 0.0, &run, seen, |_| 0);
    }

    /// Twice as many steps each time.
    pub fn fixed<T>(
        &self,
        method: &str,
        few: u64,
        run: impl Fn(u64) -> Option<T>,
        seen: impl Fn(&T) -> Seen,
    ) {
        let counts = (0..20).map(|power| few << power);
        self.all(method, counts.map(|n| n as f64), |n| run(n as u64), seen, |n, _| n as u64);
    }

    /// Tolerances from 1e-2 down.
    pub fn tolerances<T>(
        &self,
        method: &str,
        run: impl Fn(f64) -> Option<T>,
        seen: impl Fn(&T) -> Seen,
        steps: impl Fn(&T) -> u64,
    ) {
        let tolerances = (4..=29).map(|half| 10_f64.powf(-0.5 * f64::from(half)));
        self.all(method, tolerances, run, seen, |_, state| steps(state));
    }

    /// Refines the step until the error no longer decreases, or a run takes too long.
    fn all<T>(
        &self,
        method: &str,
        parameters: impl Iterator<Item = f64>,
        run: impl Fn(f64) -> Option<T>,
        seen: impl Fn(&T) -> Seen,
        steps: impl Fn(f64, &T) -> u64,
    ) {
        let (mut best, mut worse) = (f64::INFINITY, 0);
        for parameter in parameters {
            let one = || run(black_box(parameter));
            let row = self.row(method, parameter, &one, &seen, |state| steps(parameter, state));
            let Some((error, seconds)) = row else { continue };
            // errors of long steps mean nothing
            worse = if error < best || best > 1e-7 { 0 } else { worse + 1 };
            best = best.min(error);
            if seconds > LONG || worse == 3 || error < 2e-15 {
                break;
            }
        }
    }

    fn row<T>(
        &self,
        method: &str,
        parameter: f64,
        run: &impl Fn() -> Option<T>,
        seen: impl Fn(&T) -> Seen,
        steps: impl Fn(&T) -> u64,
    ) -> Option<(f64, f64)> {
        let state = run()?;
        let error = self.reference.error(&seen(&state));
        let seconds = least(&|| drop(black_box(run())));
        let (problem, steps) = (self.problem, steps(&state));
        println!("\"{problem}\",\"{method}\",{parameter:e},{error:e},{seconds:e},{steps}");
        Some((error, seconds))
    }
}

/// The cost of a step, from a function that makes many.
pub fn per_step(method: &str, place: &str, many: impl Fn(usize)) {
    const COUNT: usize = 1000;
    let seconds = least(&|| many(COUNT)) / COUNT as f64;
    println!("step,\"{method}\",\"{place}\",,{seconds:e},{COUNT}");
}

/// The least CPU time of a run, over batches.
fn least(run: &impl Fn()) -> f64 {
    let batch = |count: u64| {
        let (cpu, wall) = (cpu(), Instant::now());
        (0..count).for_each(|_| run());
        let wall = wall.elapsed().as_secs_f64();
        // a clock of the CPU is coarser, but does not see others
        (wall, cpu.zip(self::cpu()).map_or(wall, |(from, to)| to - from))
    };
    let mut count = 1;
    while batch(count).0 < 0.5 * BATCH {
        count *= 2;
    }
    let seconds = (0..BATCHES).map(|_| {
        let (wall, cpu) = batch(count);
        if cpu > 0.5 * BATCH { wall.min(cpu) } else { wall }
    });
    seconds.fold(f64::INFINITY, f64::min) / count as f64
}

/// CPU seconds of this thread, where the system says it.
fn cpu() -> Option<f64> {
    // what it says is as new as the last switch
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}
