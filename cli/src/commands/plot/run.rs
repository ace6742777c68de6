//! Figures of the trajectory of a problem.

use super::super::failure::Failure;
use super::super::options::ProblemOptions;
use super::super::stages::Stages;
use affinor::Error;
use affinor::mechanics::Inertia;
use affinor_documents::figures;
use affinor_documents::figures::diagram::Diagram;
use affinor_documents::figures::series;
use affinor_documents::figures::{Figure, Moving};
use affinor_documents::input::{InputError, read_rows};
use affinor_documents::problem::{Factor, Problem, Ready};
use affinor_documents::rows::{DenseRows, RunRows, column_of};
use affinor_tensors::Effort;
use clap::Args;
use nalgebra::Matrix3;

/// The names that mean several columns whose names begin differently.
const STEMS: [&str; 6] = ["element", "position", "velocity", "momentum", "embedding", "conserved"];
/// The columns of the entries of a rotation.
const ENTRIES: [&str; 9] = ["g11", "g12", "g13", "g21", "g22", "g23", "g31", "g32", "g33"];
/// The columns of the entries of a position.
const POSITION: [&str; 3] = ["g14", "g24", "g34"];
/// The error message for a problem without an attitude.
const NO_ATTITUDE: &str = "a plot of the attitude needs a rotating body, on so(3) or se(3)";

/// A problem of mechanics, and optionally a file that contains its computed rows.
#[derive(Args)]
pub struct Trajectory {
    #[command(flatten)]
    problem: ProblemOptions,
    /// Override the integration method that the file sets
    #[arg(long, value_name = "M")]
    method: Option<String>,
    /// Draw the rows of this CSV file, written by `affinor simulate`, instead of integrating the
    /// problem
    #[arg(long, value_name = "FILE", conflicts_with_all = ["method", "step", "tolerance", "end", "every"])]
    rows: Option<String>,
}

/// Columns of a trajectory.
#[derive(Args)]
pub struct Columns {
    #[command(flatten)]
    trajectory: Trajectory,
    /// The columns, separated by commas: names of output columns, such as H or g11, or names that
    /// `[quantities]` defines
    #[arg(long, value_name = "NAMES", value_delimiter = ',', required = true)]
    columns: Vec<String>,
}

impl Columns {
    /// The diagram of the columns over time.
    pub fn series(&self) -> Result<Diagram, Failure> {
        let (rows, names) = self.curve()?;
        let parameter = self.trajectory.problem()?.motion(0)?.parameter;
        Ok(series::over_time(&rows, &names, &parameter)?)
    }

    /// The diagram of one column against the other, as a curve.
    pub fn phase(&self) -> Result<Diagram, Failure> {
        let (rows, names) = self.curve()?;
        Ok(series::phase(&rows, &two(names)?)?)
    }

    /// The diagram of one column against the other, as points of the Poincare section of the
    /// problem.
    pub fn section(&self) -> Result<Diagram, Failure> {
        let Columns { trajectory, .. } = self;
        let problem = trajectory.problem()?;
        let Some(event) = problem.section() else {
            let help = "name an event: `section = \"NAME\"` in [output]";
            return Err(InputError::mathematics("the problem has no section").help(help).into());
        };
        if let Some(file) = &trajectory.rows {
            let (columns, rows) = read_rows(file)?;
            let run = RunRows { name: problem.name.clone(), columns, rows };
            return Ok(series::section(&run, &two(self.columns.clone())?, event)?);
        }
        let (problem, names) = self.extended(&problem)?;
        let names = two(names)?;
        let ready = problem.motion(0)?;
        let columns = ready.columns.iter().map(|column| column.name.clone()).collect();
        let mut integration = problem.integrate(ready);
        let mut rows = vec![];
        loop {
            let progress = integration.step()?;
            rows.extend(progress.rows);
            if progress.done {
                break;
            }
        }
        let run = RunRows { name: problem.name.clone(), columns, rows };
        Ok(series::section(&run, &names, event)?)
    }

    fn curve(&self) -> Result<(RunRows, Vec<String>), Failure> {
        let problem = self.trajectory.problem()?;
        if let Some(file) = &self.trajectory.rows {
            return Ok((rows_of_one(&problem, file)?, self.columns.clone()));
        }
        let (problem, names) = self.extended(&problem)?;
        let (rows, _) = curve(&problem, &names)?;
        Ok((rows, names))
    }

    /// Returns the problem extended by the chosen columns, and the names of these columns in its
    /// rows. A stem means all columns that begin with it: `H` means `H1`, `H2`, ....
    fn extended(&self, problem: &Problem) -> Result<(Problem, Vec<String>), Failure> {
        let own = problem.motion(0)?.columns;
        let (mut names, mut others) = (vec![], vec![]);
        for wanted in self.columns.iter().map(|name| name.trim()) {
            if own.iter().any(|column| column.name == wanted && column.formula.is_some()) {
                names.push(wanted.into());
                continue;
            }
            others.push(wanted);
            let Ready { columns: all, parameter, .. } =
                problem.with_columns(&[wanted]).motion(0)?;
            // named quantities and Casimir functions are excluded: they have no numbered
            // components, so their names are never stems
            let all = all.into_iter().filter(|column| column.formula.is_none());
            let all: Vec<String> = all.map(|column| column.name).collect();
            let exactly = |name: &&String| *name == wanted;
            let is_stem = STEMS.contains(&wanted);
            let stem =
                |name: &&String| **name != parameter && (name.starts_with(wanted) || is_stem);
            let mut found: Vec<String> = all.iter().filter(exactly).cloned().collect();
            if found.is_empty() {
                found = all.iter().filter(stem).cloned().collect();
            }
            if found.is_empty() || wanted.is_empty() {
                let message = format!("`{}` is not a column of this motion", wanted.escape_debug());
                let help = format!("the columns are {}", all.join(", "));
                return Err(InputError::usage(message).help(help).into());
            }
            names.append(&mut found);
        }
        Ok((problem.with_columns(&others), names))
    }
}

/// The names of the two columns that a plane diagram needs.
fn two(names: Vec<String>) -> Result<[String; 2], Failure> {
    <[String; 2]>::try_from(names).map_err(|names| {
        let message = format!(
            "a plot in the plane needs two columns, not {}: {}",
            names.len(),
            names.join(", ")
        );
        InputError::usage(message).help("write for instance `--columns H1,H2`").into()
    })
}

/// The output times of a problem, up to its terminal event.
pub fn times(problem: &Problem) -> Result<Vec<f64>, Failure> {
    let ready = problem.motion(0)?;
    let mut times = ready.times.clone();
    let Some(stop) = problem.terminal_event() else { return Ok(times) };
    let mut integration = problem.integrate(ready);
    loop {
        let progress = integration.step()?;
        if let Some((_, end)) = progress.events.iter().find(|(event, _)| event == stop) {
            let forwards = *end >= times[0];
            times.retain(|time| if forwards { time < end } else { time > end });
            times.push(*end);
            return Ok(times);
        }
        if progress.done {
            return Ok(times);
        }
    }
}

/// Integrates a motion with these columns, and returns rows that are dense enough for a curve.
fn curve(problem: &Problem, names: &[String]) -> Result<(RunRows, Ready), Failure> {
    let stages = Stages::new(false, Effort::DEFAULT);
    stages.begin("the motion");
    let mut ready = problem.motion(0)?;
    let at = |name: &String| ready.columns.iter().position(|column| column.name == *name);
    let mut columns: Vec<usize> = names.iter().filter_map(at).collect();
    columns.retain(|column| ready.columns[*column].name != ready.parameter);
    let names = columns.iter().map(|column| ready.columns[*column].name.clone());
    let columns_of_rows = [ready.parameter.clone()].into_iter().chain(names).collect();
    let rows = DenseRows::along(ready.motion.as_mut(), &times(problem)?, &columns)?;
    Ok((RunRows { name: problem.name.clone(), columns: columns_of_rows, rows }, ready))
}

impl Trajectory {
    /// Opens the problem with the values of the options.
    fn problem(&self) -> Result<Problem, Failure> {
        self.problem.open(self.method.as_deref())
    }

    /// The rows of these columns of a problem, read from the file or integrated.
    fn rows(&self, problem: &Problem, columns: &[&str]) -> Result<(RunRows, Ready), Failure> {
        let Some(file) = &self.rows else {
            let names: Vec<String> = columns.iter().map(|name| name.to_string()).collect();
            return curve(problem, &names);
        };
        Ok((rows_of_one(problem, file)?, problem.motion(0)?))
    }

    /// The problem with the columns that a figure needs. `reason` is the error message if the
    /// problem cannot have these columns.
    fn with_columns(&self, columns: &[&str], reason: &str) -> Result<Problem, Failure> {
        let problem = self.problem()?;
        // reports errors of the problem itself first
        problem.motion(0)?;
        let extended = problem.with_columns(columns);
        // an isospectral flow ignores the requested columns, because its columns are fixed
        let has = |ready: &Ready| {
            columns.iter().all(|name| ready.columns.iter().any(|column| column.name == *name))
        };
        match extended.motion(0) {
            Ok(ready) if has(&ready) => Ok(extended),
            _ => Err(InputError::mathematics(reason).into()),
        }
    }

    /// The figure of the body axes in space, for each factor of the group that rotates.
    pub fn attitude(&self) -> Result<Figure, Failure> {
        let factors: Vec<_> =
            rotating(&self.problem()?)?.iter().map(|(_, one)| one.number).collect();
        let columns = names(&factors, &ENTRIES);
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let problem = self.with_columns(&columns, NO_ATTITUDE)?;
        let (rows, _) = self.rows(&problem, &columns)?;
        figures::run::attitude(&rows, &factors).map_err(|error| no_attitude(error).into())
    }

    /// The figure of a curve on a chart in space, by its embedding.
    pub fn orbit(&self) -> Result<Figure, Failure> {
        let columns = ["X1", "X2", "X3"];
        let reason = "a plot of an orbit needs a curve on a chart with an `embedding` in space";
        let error = || {
            let help = "give the key embedding = [X1, X2, X3], three functions of the coordinates";
            InputError::mathematics(reason).help(help)
        };
        let problem = self.problem()?;
        problem.motion(0)?;
        let problem = self.with_columns(&columns, reason).map_err(|_| error())?;
        let (rows, _) = self.rows(&problem, &columns)?;
        figures::run::orbit(&rows).map_err(|_| error().into())
    }

    pub fn momentum(&self) -> Result<Figure, Failure> {
        let reason = "a plot of the momentum sphere needs a rotating body: space = \"so3\"";
        // requests a column of the quaternion, because only rotations have it
        let columns = ["H1", "H2", "H3", "qw"];
        let problem = self.with_columns(&columns, reason)?;
        let (rows, ready) = self.rows(&problem, &columns[..3])?;
        let inertia = ready.inertia.filter(|inertia| inertia.shape() == (3, 3));
        let Some(inertia) = inertia else {
            let message = "a plot of the energy ellipsoid needs a body with an inertia";
            return Err(InputError::mathematics(message).into());
        };
        let inertia = Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned())?;
        figures::run::momentum(&rows, &inertia).map_err(|error| {
            InputError::from(error).help("the rows need the columns `H1` to `H3`").into()
        })
    }

    /// The animation of the rotating bodies, which lasts `seconds`.
    pub fn animation(&self, seconds: f64) -> Result<Figure, Failure> {
        let factors = rotating(&self.problem()?)?;
        let numbers: Vec<_> = factors.iter().map(|(_, factor)| factor.number).collect();
        let turned = names(&numbers, &ENTRIES);
        let mut columns: Vec<&str> = turned.iter().map(String::as_str).collect();
        let mut problem = self.with_columns(&columns, NO_ATTITUDE)?;
        let places: Vec<_> = numbers.iter().map(|number| names(&[*number], &POSITION)).collect();
        for places in &places {
            let with: Vec<&str> =
                columns.iter().copied().chain(places.iter().map(String::as_str)).collect();
            // adds the position where the factor has one; other factors rotate about a fixed point
            if let Ok(extended) = self.with_columns(&with, "") {
                (problem, columns) = (extended, with);
            }
        }
        let (rows, ready) = self.rows(&problem, &columns)?;
        let moving = |(at, factor): &(usize, Factor)| {
            // draws the body with equal inertias if there is no metric, as for a prescribed
            // velocity
            let inertia = match &ready.inertia {
                Some(inertia) => {
                    inertia.fixed_view::<3, 3>(factor.first, factor.first).into_owned()
                }
                None => Matrix3::identity(),
            };
            let solids = ready.solids.get(*at).cloned().unwrap_or_default();
            Ok(Moving { factor: factor.number, inertia: Inertia::new(&inertia)?, solids })
        };
        let bodies = factors.iter().map(moving).collect::<Result<Vec<_>, Error>>()?;
        figures::animation(&rows, &bodies, seconds).map_err(|error| no_attitude(error).into())
    }
}

/// The factors of the group that rotate bodies, with their indices. If the group has a single
/// factor, this factor may be any group; elements that are not rotations cause an error later.
fn rotating(problem: &Problem) -> Result<Vec<(usize, Factor)>, Failure> {
    let factors = problem.motion(0)?.factors;
    let is_single = factors.len() == 1;
    let rotates = |(_, factor): &(usize, Factor)| factor.rotates || is_single;
    let found: Vec<_> = factors.into_iter().enumerate().filter(rotates).collect();
    if found.is_empty() {
        return Err(InputError::mathematics(NO_ATTITUDE).into());
    }
    Ok(found)
}

/// The names of the columns, for each factor with one of these numbers.
fn names(factors: &[Option<usize>], columns: &[&str]) -> Vec<String> {
    let of = |factor: &Option<usize>| {
        let factor = *factor;
        columns.iter().map(move |column| column_of(column, factor))
    };
    factors.iter().flat_map(of).collect()
}

/// The error for rows without attitudes.
fn no_attitude(error: Error) -> InputError {
    let turns = matches!(error, Error::Invalid { what: "rotation", .. });
    let rows = "the rows need the columns `g11` to `g33`, or `qw` to `qz`";
    InputError::from(error).help(if turns { NO_ATTITUDE } else { rows })
}

/// Reads the rows of a motion from a file, and checks that they belong to a single member of an
/// ensemble.
pub fn rows_of_one(problem: &Problem, file: &str) -> Result<RunRows, Failure> {
    let (columns, rows) = read_rows(file)?;
    let run = RunRows { name: problem.name.clone(), columns, rows };
    if let Ok(members) = run.column("member")
        && let Some(other) = members.iter().find(|member| **member != members[0])
    {
        let message =
            format!("{file} has the rows of several members, such as {} and {other}", members[0]);
        let help = "keep the rows of one member only";
        return Err(InputError::usage(message).help(help).into());
    }
    Ok(run)
}
