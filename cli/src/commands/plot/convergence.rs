//! Convergence of methods: the error at the end time against the step size and the computing time.

use super::super::failure::Failure;
use super::super::stages::Stages;
use affinor::mechanics::simulation::Method;
use affinor_documents::figures::diagram::{Diagram, Drawn, Graph, Line, Scale};
use affinor_documents::input::InputError;
use affinor_documents::problem::{Problem, Ready};
use affinor_tensors::Effort;
use clap::Args;
use std::time::Instant;

/// The largest error in the figure. Larger errors do not show the order of a method.
const USEFUL: f64 = 1.0;

/// One run of a method.
pub struct Trial {
    /// The step size; with step-size control, the mean step size.
    pub step: f64,
    /// The largest difference from the reference among all columns at the end time.
    pub error: f64,
    /// The computing time in seconds, as the minimum of three runs.
    pub seconds: f64,
}

/// Runs of a method with decreasing step sizes.
pub struct Trials {
    pub method: Method,
    trials: Vec<Trial>,
}

impl Trials {
    /// The observed order between consecutive runs.
    pub fn orders(&self) -> impl Iterator<Item = f64> {
        let pair = |pair: &[Trial]| {
            (pair[0].error / pair[1].error).ln() / (pair[0].step / pair[1].step).ln()
        };
        // runs with the same mean step have no order
        self.trials.windows(2).map(pair).filter(|order| order.is_finite())
    }

    /// The slope of the error over the step size: the median of the observed orders.
    fn slope(&self) -> Option<f64> {
        let mut orders: Vec<f64> = self.orders().collect();
        orders.sort_by(f64::total_cmp);
        let above = orders.get(orders.len() / 2)?;
        let below = orders.get((orders.len() - 1) / 2)?;
        Some(0.5 * (below + above))
    }
}

/// A problem of mechanics, and the methods to compare on it.
#[derive(Args)]
pub struct Comparison {
    /// The problem, a TOML file
    #[arg(value_name = "FILE")]
    problem: String,
    /// A method to compare; may be repeated, or may be a list separated by commas [default:
    /// rkmk4,cf4, or all methods for constraints, matrix flows, prescribed velocities and charts]
    #[arg(long = "method", value_name = "NAME", value_delimiter = ',')]
    methods: Vec<String>,
    /// The largest step size [default: 1/16 of the time span]
    #[arg(long, value_name = "H")]
    step: Option<f64>,
    /// The number of times that the step size is halved
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=30))]
    halvings: u32,
}

impl Comparison {
    /// Returns the name of the problem, and the runs of each method.
    pub fn trials(&self) -> Result<(String, Vec<Trials>), Failure> {
        let problem = Problem::read(&self.problem)?;
        let methods = self.methods.iter().map(|name| method_of(name));
        let mut methods = methods.collect::<Result<Vec<_>, _>>()?;
        if methods.is_empty() {
            methods = problem.own_methods();
        }
        if methods.is_empty() {
            methods = vec![Method::MuntheKaas4, Method::CommutatorFree4];
        }
        let times = problem.times(0)?;
        let whole = times[times.len() - 1] - times[0];
        let step = self.step.unwrap_or(whole.abs() / 16.0);
        if !(step > 0.0 && step.is_finite()) {
            return Err(InputError::usage(format!("--step {step} is not positive")).into());
        }
        let stages = Stages::new(false, Effort::DEFAULT);
        let mut count = 0;
        let found = trials(&problem, &methods, step, self.halvings, || {
            count += 1;
            stages.begin(&format!("run {count}"));
        })?;
        Ok((problem.name, found))
    }
}

/// The method with the name that an option gives.
pub fn method_of(name: &str) -> Result<Method, Failure> {
    Method::from_name(name.trim()).ok_or_else(|| {
        let all = Method::ALL.iter().map(|method| method.name()).collect::<Vec<_>>().join(", ");
        let message = format!("--method: unknown method `{}`", name.escape_debug());
        InputError::usage(message).help(format!("the methods are {all}")).into()
    })
}

/// Runs each method with the step size `step`, which is then halved `halvings` times. The reference
/// is the exact motion if there is one; otherwise it is a run with step-size control and the
/// tolerance 1e-13. `each` is called before every run.
fn trials(
    problem: &Problem,
    methods: &[Method],
    step: f64,
    halvings: u32,
    mut each: impl FnMut(),
) -> Result<Vec<Trials>, InputError> {
    let problem = problem.to_the_end();
    let exact = end(&problem.with_method(Method::Exact, None, Some(1e-13)));
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
                problem.with_method(method, Some(step), Some(1e-13))
            } else {
                let digits = 2.0 + 10.0 * f64::from(halving) / f64::from(halvings.max(1));
                problem.with_method(method, None, Some(10.0_f64.powf(-digits)))
            };
            each();
            let (found, step, seconds) = match end(&run) {
                Ok(found) => found,
                // ignores a failed run with a larger step, because this step may be too large for
                // the method
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

/// The problem with a method and a step that are more accurate than all compared runs.
fn reference(problem: &Problem, step: f64, halvings: u32) -> Problem {
    let fine = step * 0.5_f64.powi(halvings as i32 + 2);
    match problem.own_methods().last() {
        // methods of higher order integrate constraints too
        Some(&method) if method != Method::GeneralisedAlpha => {
            problem.with_method(method, method.has_steps().then_some(fine), Some(1e-13))
        }
        _ => problem.with_method(Method::to(1e-13), None, Some(1e-13)),
    }
}

/// Runs a problem to its end. Returns the last row without the time, the mean step size, and the
/// computing time in seconds.
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
    let Ready { motion, columns, parameter, .. } = ready;
    let row = motion.row().into_iter().zip(&columns);
    let row = row.filter(|(_, column)| column.name != parameter).map(|(value, _)| value);
    let whole = (last - first).abs();
    Ok((row.collect(), whole / motion.steps().max(1) as f64, seconds))
}

/// The graphs of the errors: against the step size, with lines of integer slopes, and against the
/// computing time.
pub fn diagram(name: &str, trials: &[Trials]) -> Diagram {
    let lines = |x: fn(&Trial) -> f64| -> Vec<Line> {
        let line = |trials: &Trials| {
            let method = trials.method;
            let caption = match trials.slope() {
                Some(slope) => format!("{method}, slope {slope:.1}"),
                None => method.name().into(),
            };
            let points = trials.trials.iter().map(|trial| [x(trial), trial.error]).collect();
            Line { caption, points, drawn: Drawn::Marked }
        };
        trials.iter().map(line).collect()
    };
    let y = Scale::logarithmic("error at the end time");
    let over = |label: &str, lines| {
        let (x, y) = (Scale::logarithmic(label), y.clone());
        Graph { x, y, equal: false, lines }
    };
    let over_step = [lines(|trial| trial.step), guides(trials)].concat();
    let graphs = vec![
        over("step size", over_step),
        over("computing time / s", lines(|trial| trial.seconds)),
    ];
    Diagram { title: format!("{name}: error over step size and computing time"), graphs }
}

/// A straight line below the errors for each integer slope, once for all methods with this slope.
fn guides(all: &[Trials]) -> Vec<Line> {
    let mut slopes: Vec<i32> = vec![];
    let mut guides = vec![];
    for trials in all {
        let (Some(slope), Some(first)) = (trials.slope(), trials.trials.first()) else { continue };
        let slope = slope.round() as i32;
        if slope < 1 || slopes.contains(&slope) {
            continue;
        }
        slopes.push(slope);
        let least = trials.trials.iter().map(|trial| trial.error).fold(f64::INFINITY, f64::min);
        let (from, error) = (first.step, 0.3 * first.error);
        let finest = trials.trials.iter().map(|trial| trial.step).fold(from, f64::min);
        // ends the line at the smallest error, because smaller steps only show rounding errors
        let lowest = from * (least.max(f64::MIN_POSITIVE) / error).powf(1.0 / f64::from(slope));
        let to = finest.max(lowest).min(from);
        let points = vec![[from, error], [to, error * (to / from).powi(slope)]];
        guides.push(Line { caption: format!("slope {slope}"), points, drawn: Drawn::Guide });
    }
    guides
}
