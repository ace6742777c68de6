//! Figures of motions: a problem, its rows, and what is drawn of them.

use super::super::failure::Failure;
use super::super::note::line;
use super::super::stages::Stages;
use super::Paper;
use affinor::convergence;
use affinor::definition::{InputError, Problem, Ready, read_rows};
use affinor::dynamics::Inertia;
use affinor::figures::diagram::Diagram;
use affinor::figures::run::RunRows;
use affinor::figures::{self, Figure};
use affinor::simulation::Method;
use clap::Args;

/// A problem of motion, and perhaps its rows.
#[derive(Args)]
pub struct Run {
    /// The problem: a TOML file
    #[arg(value_name = "FILE")]
    problem: String,
    /// Rows of `affinor simulate` in CSV, in the place of a run
    #[arg(long, value_name = "FILE")]
    rows: Option<String>,
    #[command(flatten)]
    pub paper: Paper,
}

impl Run {
    /// The rows, and what is known of their motion.
    pub fn rows(&self) -> Result<(RunRows, Ready), Failure> {
        let problem = Problem::read(&self.problem)?;
        let mut ready = problem.motion(0)?;
        let name = problem.name.clone();
        if let Some(file) = &self.rows {
            let (columns, rows) = read_rows(file)?;
            return Ok((RunRows { name, columns, rows }, ready));
        }
        let stages = Stages::new(false);
        stages.begin("the motion");
        let mut rows = Vec::new();
        for &time in &ready.times.clone() {
            while !ready.motion.step(time)? {}
            rows.push(ready.motion.row());
        }
        let columns = ready.columns.iter().map(|column| column.name.clone()).collect();
        Ok((RunRows { name, columns, rows }, ready))
    }

    pub fn momentum(&self) -> Result<Figure, Failure> {
        let (rows, ready) = self.rows()?;
        let inertia = ready.inertia.filter(|inertia| inertia.shape() == (3, 3));
        let Some(inertia) = inertia else {
            let message = "the ellipsoid of the energy is drawn of a body with an inertia";
            return Err(InputError::mathematics(message).into());
        };
        let inertia = Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned())?;
        Ok(figures::run::momentum(&rows, &inertia)?)
    }

    pub fn convergence(
        &self,
        methods: &str,
        step: Option<f64>,
        halvings: u32,
    ) -> Result<Diagram, Failure> {
        let problem = Problem::read(&self.problem)?;
        let method = |name: &str| {
            Method::from_name(name.trim()).ok_or_else(|| {
                let all = Method::ALL.map(Method::name).join(", ");
                let message = format!("--methods: `{}` is no method", name.escape_debug());
                Failure::from(InputError::usage(message).help(format!("the methods are {all}")))
            })
        };
        let methods = methods.split(',').map(method).collect::<Result<Vec<_>, _>>()?;
        let times = problem.times(0)?;
        let whole = times[times.len() - 1] - times[0];
        let step = step.unwrap_or(whole.abs() / 16.0);
        if !(step > 0.0 && step.is_finite()) {
            return Err(InputError::usage(format!("--step {step} is not above zero")).into());
        }
        let stages = Stages::new(false);
        let mut count = 0;
        let found = convergence::trials(&problem, &methods, step, halvings, || {
            count += 1;
            stages.begin(&format!("run {count}"));
        })?;
        for trials in &found {
            let orders: Vec<String> =
                trials.orders().iter().map(|order| format!("{order:.2}")).collect();
            line(&format!("{}: observed orders {}", trials.method, orders.join(" ")));
        }
        Ok(convergence::diagram(&problem.name, &found))
    }
}
