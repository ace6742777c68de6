//! `affinor simulate`: integration of a problem of mechanics, or of an ensemble.

mod checkpoint;
mod progress;
mod spool;
mod summary;

use super::color::ColorOption;
use super::failure::Failure;
use super::note::{counted, line, note};
use super::options::ProblemOptions;
use super::output::{deliver, ending, expect_place};
use super::watch::{Ending, Watch};
use affinor_documents::input::InputError;
use affinor_documents::problem::{Integration, Problem, Progress as Step, Ready};
use affinor_documents::rows::{Head, RunFormat};
use checkpoint::{Plan, Store};
use clap::Args;
use progress::Progress;
use rayon::prelude::*;
use std::convert::Infallible;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The largest number of members of an ensemble that are computed before their rows are stored, and
/// the target time for these members, which makes checkpoints punctual.
const CHUNK: u64 = 128;
const CHUNK_TIME: Duration = Duration::from_secs(1);

/// A problem of mechanics, and the output of its trajectory.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub problem: ProblemOptions,
    /// Override the integration method that the file sets
    #[arg(long, value_name = "M")]
    pub method: Option<String>,
    /// Integrate every member of the ensemble of the problem, in parallel
    #[arg(long)]
    pub ensemble: bool,
    #[cfg_attr(
        feature = "parquet",
        doc = "The format: csv, json or parquet [default: the extension of the output file, or csv]"
    )]
    #[cfg_attr(
        not(feature = "parquet"),
        doc = "The format: csv or json [default: the extension of the output file, or csv]"
    )]
    #[arg(long, value_name = "FORMAT", value_parser = format)]
    pub format: Option<RunFormat>,
    /// Write the rows to this file instead of standard output
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Save the completed members of an ensemble to this file at intervals
    #[arg(long, value_name = "FILE", requires = "ensemble")]
    pub checkpoint: Option<PathBuf>,
    /// Resume from the checkpoint; without a checkpoint, start from the beginning
    #[arg(long, requires = "checkpoint")]
    pub resume: bool,
    /// The time between checkpoints, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    pub checkpoint_every: f64,
    /// The number of threads of an ensemble; it does not change the results [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub color: ColorOption,
}

fn format(name: &str) -> Result<RunFormat, String> {
    RunFormat::from_name(name).ok_or_else(|| {
        if name == PARQUET {
            return format!("{WITHOUT_PARQUET}; {WITH_PARQUET}");
        }
        let all: Vec<&str> = RunFormat::ALL.iter().map(|format| format.name()).collect();
        format!("the formats are {}", all.join(", "))
    })
}

/// The name of the format that needs the build feature `parquet`.
const PARQUET: &str = "parquet";
const WITHOUT_PARQUET: &str = "this program was built without the feature `parquet`";
const WITH_PARQUET: &str =
    "choose csv or json, or build it with `cargo install --path cli --features parquet`";

impl Arguments {
    pub fn run(&self, watch: &Watch) -> Result<(), Failure> {
        let problem = self.problem.open(self.method.as_deref())?;
        let format = self.format()?;
        let begun = Instant::now();
        let files = std::iter::once(&self.problem.problem).chain(problem.files());
        let inputs: Vec<PathBuf> = files.map(PathBuf::from).collect();
        if let Some(file) = &self.file {
            expect_place(file, &inputs)?;
        }
        let members = match (self.ensemble, problem.members()) {
            (false, _) => None,
            (true, Some(size)) => Some(size),
            (true, None) => {
                let error = InputError::usage("the problem defines no ensemble");
                return Err(error.help("add a table [ensemble] with `grid` or `random`").into());
            }
        };
        let plan = Plan::of(self, &problem)?;
        let ready = problem.motion(0)?;
        note_method(&problem, &ready, if self.ensemble { "member 1: " } else { "" });
        let front = members.map_or(vec![], |_| [vec!["member"], problem.varied()].concat());
        let columns = ready.columns.clone();
        let names = front.into_iter().chain(columns.iter().map(|column| column.name.as_str()));
        let head = Head {
            name: problem.name.clone(),
            method: ready.method.name().into(),
            columns: names.map(String::from).collect(),
        };
        let mut store = plan.begin(head.columns.len())?;
        watch.ask();
        let end = match members {
            Some(size) => self.members(&problem, size, &mut store, watch)?,
            None => one(&problem, ready, &mut store, watch)?,
        };
        if !matches!(end, End::Early(_)) {
            watch.let_through();
        }
        let mut target = self.file.clone();
        if !matches!(end, End::Reached)
            && let Some(file) = &mut target
        {
            *file = partial(file);
        }
        let spool = &mut store.spool;
        deliver(target.as_deref(), &inputs, |out| format.write(&head, &mut spool.rows()?, out))?;
        let rows = counted(spool.count(), "row");
        let kept = match &target {
            Some(file) => format!("wrote {rows} up to this time to {}", file.display()),
            None => format!("wrote {rows} up to this time"),
        };
        match end {
            End::Reached => {}
            End::Error(error) => {
                return Err(match error.help {
                    Some(help) => InputError { help: Some(format!("{help}; {kept}")), ..error },
                    None => error.help(kept),
                }
                .into());
            }
            End::Early(ending) => {
                let resume =
                    if self.checkpoint.is_some() { "; --resume continues the run" } else { "" };
                return Err(match (ending, watch.failure("")) {
                    (Ending::Signal(signal), _) => {
                        let message = format!("interrupted; {kept}{resume}");
                        Failure::Signal(signal, Some(message))
                    }
                    (Ending::Limit(_), Failure::Input(error)) => {
                        let advice = error.help.iter().map(|help| format!("; {help}"));
                        let help = format!("{kept}{resume}{}", advice.collect::<String>());
                        error.help(help).into()
                    }
                    (Ending::Limit(_), failure) => failure,
                });
            }
        }
        if !self.ensemble {
            summary::show(&head, &columns, spool).map_err(spool::failed)?;
        }
        line(&format!("{rows} in {:.3} s", begun.elapsed().as_secs_f64()));
        if let Some(file) = self.file.as_deref().filter(|_| store.resumed().is_some()) {
            let incomplete = partial(file);
            if incomplete != file {
                // deletes the rows of an interrupted earlier run; if this fails, the old file does
                // no harm
                let _ = fs::remove_file(incomplete);
            }
        }
        store.finished();
        Ok(())
    }

    /// The format of the rows: the format given by `--format`, otherwise the format of the file
    /// name extension, otherwise CSV.
    fn format(&self) -> Result<RunFormat, Failure> {
        let ending = ending(self.file.as_deref());
        match self.format.or(RunFormat::from_name(&ending)) {
            None if ending == PARQUET => {
                Err(InputError::usage(WITHOUT_PARQUET).help(WITH_PARQUET).into())
            }
            format => Ok(format.unwrap_or(RunFormat::Csv)),
        }
    }

    /// Integrates all members of an ensemble, and stores their rows in the order of the members.
    fn members(
        &self,
        problem: &Problem,
        size: u64,
        store: &mut Store,
        watch: &Watch,
    ) -> Result<End, Failure> {
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool =
            pool.map_err(|error| InputError::usage(format!("cannot start the threads: {error}")))?;
        let mut done = store.resumed().map_or(0, |checkpoint| checkpoint.done);
        let progress = Progress::from(done as f64 / size as f64);
        let least = pool.current_num_threads() as u64;
        let mut count = least;
        while done < size {
            let chunk: Vec<u64> = (done..size.min(done + count)).collect();
            let begin = Instant::now();
            let found: Vec<_> = pool.install(|| {
                chunk.par_iter().map(|member| all_rows(problem, *member, watch)).collect()
            });
            let mut interrupted = None;
            for (member, (rows, end)) in chunk.iter().zip(found) {
                match end {
                    End::Early(ending) if interrupted.is_none() => {
                        // a resumed run computes this and all later members again, although some of
                        // their rows are already written
                        store.save(*member)?;
                        interrupted = Some(ending);
                    }
                    End::Error(error) => {
                        store.stop(format!("member {}: {}", member + 1, error.message));
                    }
                    _ => {}
                }
                for row in rows {
                    store.spool.push(&row).map_err(spool::failed)?;
                }
            }
            if let Some(ending) = interrupted {
                return Ok(End::Early(ending));
            }
            done += chunk.len() as u64;
            progress.reach(done as f64 / size as f64);
            if store.is_due() {
                store.save(done)?;
            }
            count = if begin.elapsed() < CHUNK_TIME { 2 * count } else { count / 2 };
            count = count.min(CHUNK).max(least);
        }
        let stopped = store.stopped().map(InputError::mathematics);
        Ok(stopped.map_or(End::Reached, End::Error))
    }
}

/// How a run ended.
enum End {
    /// The run reached its end time, or a terminal event.
    Reached,
    /// The run failed with an error.
    Error(InputError),
    /// A signal, or a limit of the command, ended the run early.
    Early(Ending),
}

/// Integrates one motion and stores its rows.
fn one(problem: &Problem, ready: Ready, store: &mut Store, watch: &Watch) -> Result<End, Failure> {
    let parameter = ready.parameter.clone();
    let mut integration = problem.integrate(ready);
    let progress = Progress::from(integration.progress());
    follow(&mut integration, watch, |integration, step| {
        for row in &step.rows {
            store.spool.push(row).map_err(spool::failed)?;
        }
        for (event, time) in &step.events {
            progress.beside(|| line(&format!("{event} at {parameter} = {time}")));
        }
        progress.reach(integration.progress());
        Ok::<_, Failure>(())
    })
}

/// Integrates a member of an ensemble. Returns its rows and how it ended.
fn all_rows(problem: &Problem, member: u64, watch: &Watch) -> (Vec<Vec<f64>>, End) {
    if let Some(ending) = watch.ending() {
        return (vec![], End::Early(ending));
    }
    let mut integration = match problem.motion(member) {
        Ok(ready) => problem.integrate(ready),
        Err(error) => return (vec![], End::Error(error)),
    };
    let front = [vec![(member + 1) as f64], problem.variation(member)].concat();
    let mut rows = Vec::new();
    let end = follow(&mut integration, watch, |_, step| {
        rows.extend(step.rows.iter().map(|row| [&front[..], row].concat()));
        Ok::<_, Infallible>(())
    });
    let Ok(end) = end;
    (rows, end)
}

/// Integrates a motion to its end, or until a signal or an exceeded limit. `each` is called after
/// every step.
fn follow<E>(
    integration: &mut Integration,
    watch: &Watch,
    mut each: impl FnMut(&Integration, Step) -> Result<(), E>,
) -> Result<End, E> {
    loop {
        if let Some(ending) = watch.ending() {
            return Ok(End::Early(ending));
        }
        let step = match integration.step() {
            Ok(step) => step,
            Err(error) => return Ok(End::Error(error.into())),
        };
        let done = step.done;
        each(integration, step)?;
        if done {
            return Ok(End::Reached);
        }
    }
}

/// Prints the notes on the problem, and a note on the method if it was chosen automatically.
fn note_method(problem: &Problem, ready: &Ready, member: &str) {
    ready.notes.iter().for_each(|text| note(&format!("{member}{text}")));
    if problem.method().is_none() {
        let method = ready.method;
        note(&format!("method {method}: {}", method.why()));
    }
}

/// The path to which an incomplete run is written: `run.partial.csv` for `run.csv`. A device or a
/// pipe is written directly.
fn partial(file: &Path) -> PathBuf {
    if fs::metadata(file).is_ok_and(|meta| !meta.is_file()) {
        return file.to_path_buf();
    }
    let ending = file.extension().map(|ending| ending.to_string_lossy().into_owned());
    file.with_extension(ending.map_or("partial".into(), |ending| format!("partial.{ending}")))
}
