//! Figures of motions: a problem, its rows, and what is drawn of them.

use super::super::failure::Failure;
use super::super::note::line;
use super::super::stages::Stages;
use super::Paper;
use affinor::Error;
use affinor::convergence;
use affinor::definition::{InputError, Problem, Ready, read_rows};
use affinor::dynamics::Inertia;
use affinor::figures::diagram::Diagram;
use affinor::figures::run::RunRows;
use affinor::figures::{self, Figure};
use affinor::simulation::Method;
use clap::Args;

/// The entries of a rotation.
const ENTRIES: [&str; 9] = ["g11", "g12", "g13", "g21", "g22", "g23", "g31", "g32", "g33"];

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
    /// The rows of the problem's own columns, and what is known of their motion.
    pub fn rows(&self) -> Result<(RunRows, Ready), Failure> {
        let problem = Problem::read(&self.problem)?;
        let ready = problem.motion(0)?;
        self.run(&problem, ready)
    }

    /// The rows of a problem: from a file, or of a run.
    fn run(&self, problem: &Problem, mut ready: Ready) -> Result<(RunRows, Ready), Failure> {
        let name = problem.name.clone();
        if let Some(file) = &self.rows {
            let (columns, rows) = read_rows(file)?;
            return Ok((RunRows { name, columns, rows }, ready));
        }
        let stages = Stages::new(false);
        stages.begin("the motion");
        let mut columns: Vec<String> =
            ready.columns.iter().map(|column| column.name.clone()).collect();
        let is_timed = columns.iter().any(|name| name == "t");
        if !is_timed {
            columns.insert(0, "t".into());
        }
        let mut rows = Vec::new();
        for &time in &ready.times.clone() {
            while !ready.motion.step(time)? {}
            let before = if is_timed { &[][..] } else { &[time] };
            rows.push([before, &ready.motion.row()].concat());
        }
        Ok((RunRows { name, columns, rows }, ready))
    }

    /// The problem with columns that a picture needs, which there are for `reason` only.
    fn asked(&self, columns: &[&str], reason: &str) -> Result<(Problem, Ready), Failure> {
        let problem = Problem::read(&self.problem)?;
        // its own faults come first
        problem.motion(0)?;
        let asked = problem.with_columns(columns);
        // a flow of matrices has columns of its own only
        let has = |ready: &Ready| {
            columns.iter().all(|name| ready.columns.iter().any(|column| column.name == *name))
        };
        match asked.motion(0) {
            Ok(ready) if has(&ready) => Ok((asked, ready)),
            _ => Err(InputError::mathematics(reason).into()),
        }
    }

    pub fn attitude(&self) -> Result<Figure, Failure> {
        let reason = "the attitude is that of a body that turns, as on so(3) and se(3)";
        let (problem, ready) = self.asked(&ENTRIES, reason)?;
        let (rows, _) = self.run(&problem, ready)?;
        figures::run::attitude(&rows).map_err(|error| {
            let turns = matches!(error, Error::NoRotation { .. });
            let help =
                if turns { reason } else { "the rows need the columns `g`, or the quaternion" };
            InputError::from(error).help(help).into()
        })
    }

    pub fn momentum(&self) -> Result<Figure, Failure> {
        let reason = "the sphere of the momentum is that of a body that turns: space = \"so3\"";
        // a quaternion is of rotations
        let (problem, ready) = self.asked(&["H1", "H2", "H3", "qw"], reason)?;
        let (rows, ready) = self.run(&problem, ready)?;
        let inertia = ready.inertia.filter(|inertia| inertia.shape() == (3, 3));
        let Some(inertia) = inertia else {
            let message = "the ellipsoid of the energy is drawn of a body with an inertia";
            return Err(InputError::mathematics(message).into());
        };
        let inertia = Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned())?;
        figures::run::momentum(&rows, &inertia)
            .map_err(|error| InputError::from(error).help("the rows need the columns `H`").into())
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
