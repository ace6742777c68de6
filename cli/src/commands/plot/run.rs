//! Figures of the trajectory of a problem.

use super::super::failure::Failure;
use super::super::stages::Stages;
use affinor::Error;
use affinor::mechanics::Inertia;
use affinor_cli::figures;
use affinor_cli::figures::Figure;
use affinor_cli::figures::diagram::Diagram;
use affinor_cli::figures::run::RunRows;
use affinor_documents::definition::{InputError, read_rows};
use affinor_documents::problem::{Problem, Ready};
use clap::Args;

/// The entries of a rotation.
const ENTRIES: [&str; 9] = ["g11", "g12", "g13", "g21", "g22", "g23", "g31", "g32", "g33"];

/// A problem of mechanics, and its trajectory if it is computed already.
#[derive(Args)]
pub struct Trajectory {
    /// The problem, a TOML file
    #[arg(value_name = "FILE")]
    problem: String,
    /// Draw the rows of this CSV file of `affinor simulate`, instead of integrating the problem
    #[arg(long, value_name = "FILE")]
    rows: Option<String>,
}

impl Trajectory {
    /// The rows of a problem, read from the file or integrated.
    fn rows(&self, problem: &Problem, mut ready: Ready) -> Result<(RunRows, Ready), Failure> {
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

    /// The problem with the columns that a figure needs; `reason` says which problems have them.
    fn with_columns(&self, columns: &[&str], reason: &str) -> Result<(Problem, Ready), Failure> {
        let problem = Problem::read(&self.problem)?;
        // errors of the problem itself come first
        problem.motion(0)?;
        let extended = problem.with_columns(columns);
        // an isospectral flow has only its own columns
        let has = |ready: &Ready| {
            columns.iter().all(|name| ready.columns.iter().any(|column| column.name == *name))
        };
        match extended.motion(0) {
            Ok(ready) if has(&ready) => Ok((extended, ready)),
            _ => Err(InputError::mathematics(reason).into()),
        }
    }

    pub fn attitude(&self) -> Result<Figure, Failure> {
        let reason = "an attitude needs a rotating body, as on so(3) and se(3)";
        let (problem, ready) = self.with_columns(&ENTRIES, reason)?;
        let (rows, _) = self.rows(&problem, ready)?;
        figures::run::attitude(&rows).map_err(|error| {
            let turns = matches!(error, Error::Invalid { what: "rotation", .. });
            let help = if turns {
                reason
            } else {
                "the rows need the columns `g11` to `g33`, or `qw` to `qz`"
            };
            InputError::from(error).help(help).into()
        })
    }

    pub fn momentum(&self) -> Result<Figure, Failure> {
        let reason = "a momentum sphere needs a rotating body: space = \"so3\"";
        // only rotations have a quaternion
        let (problem, ready) = self.with_columns(&["H1", "H2", "H3", "qw"], reason)?;
        let (rows, ready) = self.rows(&problem, ready)?;
        let inertia = ready.inertia.filter(|inertia| inertia.shape() == (3, 3));
        let Some(inertia) = inertia else {
            let message = "an energy ellipsoid needs a body with an inertia";
            return Err(InputError::mathematics(message).into());
        };
        let inertia = Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned())?;
        figures::run::momentum(&rows, &inertia).map_err(|error| {
            InputError::from(error).help("the rows need the columns `H1` to `H3`").into()
        })
    }

    pub fn drift(&self) -> Result<Diagram, Failure> {
        let problem = Problem::read(&self.problem)?;
        let ready = problem.motion(0)?;
        let (rows, ready) = self.rows(&problem, ready)?;
        let conserved = ready.columns.into_iter().filter(|column| column.watched);
        let conserved: Vec<String> = conserved.map(|column| column.name).collect();
        Ok(figures::run::drift(&rows, &conserved)?)
    }
}
