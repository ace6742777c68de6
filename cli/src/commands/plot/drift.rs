//! Drift of the conserved quantities, by one or several methods.

use super::super::failure::Failure;
use super::super::options::ProblemOptions;
use super::super::stages::Stages;
use super::convergence::method_of;
use super::run::rows_of_one;
use super::run::times;
use affinor::mechanics::simulation::Method;
use affinor_documents::figures::diagram::Diagram;
use affinor_documents::figures::drift::{Change, Drift, diagram};
use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use affinor_tensors::Effort;
use clap::Args;

/// The number of intervals at which a motion in closed form is evaluated, because it has no steps.
const SAMPLES: u32 = 400;

/// A problem of mechanics, and the methods whose drift is drawn.
#[derive(Args)]
pub struct Comparison {
    #[command(flatten)]
    problem: ProblemOptions,
    /// Draw the rows of this CSV file, written by `affinor simulate`, instead of integrating the
    /// problem
    #[arg(long, value_name = "FILE", conflicts_with_all = ["methods", "step", "tolerance", "end", "every"])]
    rows: Option<String>,
    /// A method to compare; may be repeated, or may be a list separated by commas [default: the
    /// method that the problem sets]
    #[arg(long = "method", value_name = "NAME", value_delimiter = ',')]
    methods: Vec<String>,
    /// Divide each change by the absolute initial value, unless this value is zero
    #[arg(long)]
    relative: bool,
}

impl Comparison {
    pub fn drift(&self) -> Result<Diagram, Failure> {
        let problem = self.problem.open(None)?;
        let change = if self.relative { Change::Relative } else { Change::Absolute };
        let mut drifts = vec![];
        if let Some(file) = &self.rows {
            let run = rows_of_one(&problem, file)?;
            let parameter = problem.motion(0)?.parameter;
            drifts.push(Drift::of_rows(&run, &watched(&problem)?.0, &parameter)?);
        } else {
            let stages = Stages::new(false, Effort::DEFAULT);
            let methods = self.methods.iter().map(|name| method_of(name));
            let methods = methods.collect::<Result<Vec<_>, _>>()?;
            if methods.is_empty() {
                stages.begin("the motion");
                drifts.push(along(&problem, String::new())?);
            }
            for (at, method) in methods.iter().enumerate() {
                if methods[..at].contains(method) {
                    let message = format!("--method {method} is given twice");
                    return Err(InputError::usage(message).into());
                }
                stages.begin(method.name());
                let mut problem = self.problem.with_own_integration()?;
                let ProblemOptions { step, tolerance, .. } = &self.problem;
                problem.replace_integration(
                    Some(method.name()),
                    step.as_deref().filter(|_| method.has_steps()),
                    tolerance.as_deref().filter(|_| method.is_controlled()),
                )?;
                let drift = along(&problem, method.name().into());
                drifts.push(drift.map_err(|failure| match failure {
                    Failure::Input(error) if method.has_steps() && self.problem.step.is_none() => {
                        Failure::from(
                            error.help("--step H gives the step of methods with fixed steps"),
                        )
                    }
                    other => other,
                })?);
            }
        }
        Ok(diagram(&problem.name, &drifts, change))
    }
}

/// The names and the positions of the columns that are expected to be conserved.
fn watched(problem: &Problem) -> Result<(Vec<String>, Vec<usize>), Failure> {
    let columns = problem.motion(0)?.columns;
    let found = columns.iter().enumerate().filter(|(_, column)| column.watched);
    Ok(found.map(|(at, column)| (column.name.clone(), at)).unzip())
}

/// The drift of the conserved quantities at each step of a motion.
fn along(problem: &Problem, method: String) -> Result<Drift, Failure> {
    let (names, columns) = watched(problem)?;
    let mut times = times(problem)?;
    let mut ready = problem.motion(0)?;
    if ready.method == Method::Exact {
        let (first, last) = (times[0], times[times.len() - 1]);
        let at = |k: u32| first + (last - first) * f64::from(k) / f64::from(SAMPLES);
        times = (1..SAMPLES).map(at).chain([last]).collect();
    }
    let mut drift = Drift::new(names, method, times[times.len() - 1] - ready.motion.time());
    let values = |row: Vec<f64>| columns.iter().map(|at| row[*at]).collect::<Vec<f64>>();
    drift.add(ready.motion.time(), &values(ready.motion.row()));
    for time in times {
        loop {
            let reached = ready.motion.step(time)?;
            drift.add(ready.motion.time(), &values(ready.motion.row()));
            if reached {
                break;
            }
        }
    }
    drift.end();
    Ok(drift)
}
