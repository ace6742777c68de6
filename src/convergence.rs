//! How the error of a method falls with its steps, and what that costs.

use crate::definition::{InputError, Problem, Ready};
use crate::figures::diagram::{Diagram, Graph, Line, Scale};
use crate::simulation::Method;
use std::time::Instant;

/// Errors above this say nothing about an order.
const USEFUL: f64 = 1.0;

/// One run of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// The length of a step, of a controlled method the mean.
    pub step: f64,
    /// The largest difference of a column at the end from the reference.
    pub error: f64,
    /// How long it took, in seconds: the shortest of three runs.
    pub seconds: f64,
}

/// Runs of a method with shorter and shorter steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Trials {
    /// The method.
    pub method: Method,
    /// The runs, each with half the step of the one before.
    pub trials: Vec<Trial>,
}

impl Trials {
    /// The order that each halving shows.
    pub fn orders(&self) -> Vec<f64> {
        let pair = |pair: &[Trial]| {
            (pair[0].error / pair[1].error).ln() / (pair[0].step / pair[1].step).ln()
        };
        self.trials.windows(2).map(pair).collect()
    }
}

/// What a problem reaches at its end by a method, with `halvings` of the step, against the exact motion where there is one, else
/// against steps under control to a tolerance of 1e-13. `each` is told of every run.
///
/// # Errors
/// What a run refuses.
pub fn trials(
    problem: &Problem,
    methods: &[Method],
    step: f64,
    halvings: u32,
    mut each: impl FnMut(),
) -> Result<Vec<Trials>, InputError> {
    let problem = problem.to_the_end();
    let exact = end(&problem.with_method(Method::Exact, None, 1e-13));
    let (reference, ..) = match exact {
        Ok(found) => found,
        Err(_) => end(&reference(&problem, step, halvings))?,
    };
    let mut all = Vec::new();
    for &method in methods {
        let mut trials = Vec::new();
        for halving in 0..=halvings {
            let step = step * 0.5_f64.powi(halving as i32);
            let run = if method.has_steps() {
                problem.with_method(method, Some(step), 1e-13)
            } else {
                let digits = 2.0 + 10.0 * f64::from(halving) / f64::from(halvings.max(1));
                problem.with_method(method, None, 10.0_f64.powf(-digits))
            };
            each();
            let (found, step, seconds) = match end(&run) {
                Ok(found) => found,
                // a step may be too long
                Err(_) if halving < halvings => continue,
                Err(error) => return Err(error),
            };
            let off = found.iter().zip(&reference).map(|(a, b)| (a - b).abs());
            let error = off.fold(0.0, |most, off| if off <= most { most } else { off });
            if error <= USEFUL {
                trials.push(Trial { step, error, seconds });
            }
        }
        all.push(Trials { method, trials });
    }
    Ok(all)
}

/// A run that is better than all the others.
fn reference(problem: &Problem, step: f64, halvings: u32) -> Problem {
    let fine = step * 0.5_f64.powi(halvings as i32 + 2);
    match problem.own_class() {
        Some(method) => problem.with_method(method, Some(fine), 1e-13),
        None => problem.with_method(Method::to(1e-13), None, 1e-13),
    }
}

/// The last row without the time, the mean length of a step, and how long it took.
fn end(problem: &Problem) -> Result<(Vec<f64>, f64, f64), InputError> {
    let mut seconds = f64::INFINITY;
    let mut ready = problem.motion(0)?;
    let (first, last) = (ready.times[0], ready.times[ready.times.len() - 1]);
    for _ in 0..3 {
        ready = problem.motion(0)?;
        let begun = Instant::now();
        while !ready.motion.step(last)? {}
        seconds = seconds.min(begun.elapsed().as_secs_f64());
    }
    let Ready { motion, columns, .. } = ready;
    let row = motion.row().into_iter().zip(&columns);
    let row = row.filter(|(_, column)| column.name != "t").map(|(value, _)| value);
    let whole = (last - first).abs();
    Ok((row.collect(), whole / motion.steps().max(1) as f64, seconds))
}

/// The trials as a diagram: the error over the step, and over the cost.
pub fn diagram(name: &str, trials: &[Trials]) -> Diagram {
    let lines = |x: fn(&Trial) -> f64| -> Vec<Line> {
        let line = |trials: &Trials| Line {
            caption: trials.method.name().into(),
            points: trials.trials.iter().map(|trial| [x(trial), trial.error]).collect(),
            marked: true,
        };
        trials.iter().map(line).collect()
    };
    let y = Scale::logarithmic("error at the end");
    let over = |label: &str, lines| Graph { x: Scale::logarithmic(label), y: y.clone(), lines };
    let graphs = vec![
        over("step", lines(|trial| trial.step)),
        over("seconds", lines(|trial| trial.seconds)),
    ];
    Diagram { title: format!("{name}: error over step and cost"), graphs }
}
