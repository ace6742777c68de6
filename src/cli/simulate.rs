//! `affinor simulate`: the motion of a problem, or of an ensemble of them.

mod checkpoint;
mod progress;
mod signals;
mod spool;
mod summary;

use super::color::Color;
use super::failure::Failure;
use super::note::{line, note};
use super::output::{deliver, expect_place};
use affinor::definition::{Column, InputError, Problem, Ready, Walk};
use affinor::run::{Head, RunFormat};
use checkpoint::{Checkpoint, Plan, Store};
use clap::Args;
use progress::Progress;
use rayon::prelude::*;
use signals::{Signal, Signals};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Members of an ensemble that are computed before their rows are written.
const CHUNK: u64 = 128;

/// A problem of motion, and where its rows go.
#[derive(Args)]
pub struct Arguments {
    /// The problem: a TOML file; - for standard input
    #[arg(value_name = "FILE")]
    pub problem: String,
    /// Give parameters of the problem other values, as "m=15,g=9.81"
    #[arg(long, value_name = "NAME=VALUE,..", allow_hyphen_values = true)]
    pub set: Option<String>,
    /// Every member of the problem's ensemble, on all cores
    #[arg(long)]
    pub ensemble: bool,
    /// csv, json or parquet; otherwise by the ending of the output file, or csv
    #[arg(long, value_name = "FORMAT", value_parser = format)]
    pub format: Option<RunFormat>,
    /// Write the rows to this file; without it, to standard output
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Save what was reached to this file from time to time
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Go on from the checkpoint, if there is one
    #[arg(long, requires = "checkpoint")]
    pub resume: bool,
    /// Seconds between checkpoints
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    pub checkpoint_every: f64,
    /// Threads of an ensemble; its results do not depend on them
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Colours in messages
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    pub color: Color,
}

fn format(name: &str) -> Result<RunFormat, String> {
    RunFormat::from_name(name).ok_or_else(|| {
        let all: Vec<&str> = RunFormat::ALL.iter().map(|format| format.name()).collect();
        format!("the formats are {}", all.join(", "))
    })
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let mut problem = Problem::read(&self.problem)?;
        if let Some(set) = &self.set {
            problem.set(set)?;
        }
        let format = self.format();
        let begun = Instant::now();
        let files = std::iter::once(&self.problem).chain(problem.files());
        let inputs: Vec<&Path> = files.map(Path::new).collect();
        if let Some(file) = &self.file {
            expect_place(file, &inputs)?;
        }
        let members = match (self.ensemble, problem.members()) {
            (false, _) => None,
            (true, Some(size)) => Some(size),
            (true, None) => {
                let error = InputError::usage("the problem has no ensemble");
                return Err(error.help("give it a table [ensemble] with grid or random").into());
            }
        };
        let plan = Plan::of(self, &problem)?;
        let ready = problem.motion(0)?;
        tell(&problem, &ready, if self.ensemble { "member 1: " } else { "" });
        let front = members.map_or(vec![], |_| [vec!["member"], problem.varied()].concat());
        let columns = ready.columns.clone();
        let head = head(&problem, ready.method.name(), &front, &columns);
        let mut store = plan.begin(head.columns.len())?;
        let signals = Signals::hear();
        let signals = signals
            .map_err(|error| InputError::usage(format!("cannot listen to signals: {error}")))?;
        let end = match members {
            Some(size) => self.members(&problem, size, &mut store, &signals)?,
            None => one(&problem, ready, &mut store, &signals)?,
        };
        if !matches!(end, End::Signal(_)) {
            signals.let_through();
        }
        let mut target = self.file.clone();
        if !matches!(end, End::Reached)
            && let Some(file) = &mut target
        {
            *file = partial(file);
        }
        let spool = &mut store.spool;
        deliver(target.as_deref(), &inputs, |out| format.write(&head, &mut spool.rows()?, out))?;
        let rows = spool.count();
        let kept = match &target {
            Some(file) => format!("{rows} rows up to there are in {}", file.display()),
            None => format!("{rows} rows up to there were written"),
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
            End::Signal(signal) => {
                let on =
                    if self.checkpoint.is_some() { "; --resume goes on from there" } else { "" };
                line(&format!("interrupted; {kept}{on}"));
                return Ok(signal.status());
            }
        }
        if !self.ensemble {
            summary::show(&head, &columns, spool).map_err(spool::failed)?;
        }
        line(&format!("{} rows in {:.3} s", spool.count(), begun.elapsed().as_secs_f64()));
        store.finished();
        Ok(ExitCode::SUCCESS)
    }

    fn format(&self) -> RunFormat {
        let ending = self.file.as_ref().and_then(|file| file.extension());
        let ending = ending.map(|ending| ending.to_string_lossy().to_lowercase());
        let by_ending = ending.and_then(|ending| RunFormat::from_name(&ending));
        self.format.or(by_ending).unwrap_or(RunFormat::Csv)
    }

    /// All members of an ensemble, in their order.
    fn members(
        &self,
        problem: &Problem,
        size: u64,
        store: &mut Store,
        signals: &Signals,
    ) -> Result<End, Failure> {
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool =
            pool.map_err(|error| InputError::usage(format!("cannot start threads: {error}")))?;
        let mut done = store.resumed().map_or(0, |checkpoint| checkpoint.done);
        let progress = Progress::from(done as f64 / size as f64);
        while done < size {
            let chunk: Vec<u64> = (done..size.min(done + CHUNK)).collect();
            let found: Vec<_> = pool.install(|| {
                chunk.par_iter().map(|member| all_rows(problem, *member, signals)).collect()
            });
            let mut interrupted = None;
            for (member, (rows, end)) in chunk.iter().zip(found) {
                match end {
                    End::Signal(signal) if interrupted.is_none() => {
                        // members from here on are computed again, though what there is of them is written
                        store.save(*member, None)?;
                        interrupted = Some(signal);
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
            if let Some(signal) = interrupted {
                return Ok(End::Signal(signal));
            }
            done += chunk.len() as u64;
            progress.reach(done as f64 / size as f64);
            if store.is_due() {
                store.save(done, None)?;
            }
        }
        let stopped = store.stopped().map(InputError::mathematics);
        Ok(stopped.map_or(End::Reached, End::Error))
    }
}

/// How a run ends.
enum End {
    /// At its last time, or where it was asked to.
    Reached,
    /// By what stopped it before.
    Error(InputError),
    /// From outside.
    Signal(Signal),
}

/// One motion: rows at its times.
fn one(
    problem: &Problem,
    ready: Ready,
    store: &mut Store,
    signals: &Signals,
) -> Result<End, Failure> {
    let mut walk = Walk::new(problem, ready);
    if let Some(Checkpoint { done, snapshot: Some(snapshot), .. }) = store.resumed() {
        walk.restore(*done as usize, snapshot)?;
    }
    let progress = Progress::from(walk.share());
    loop {
        if let Some(signal) = signals.arrived() {
            store.save(walk.position() as u64, Some(walk.save()?))?;
            return Ok(End::Signal(signal));
        }
        let left = match walk.step() {
            Ok(left) => left,
            Err(error) => return Ok(End::Error(error.into())),
        };
        for row in &left.rows {
            store.spool.push(row).map_err(spool::failed)?;
        }
        for (event, time) in &left.events {
            progress.beside(|| line(&format!("{event} at t = {time}")));
        }
        progress.reach(walk.share());
        if left.done {
            return Ok(End::Reached);
        }
        if store.is_due() {
            store.save(walk.position() as u64, Some(walk.save()?))?;
        }
    }
}

/// The rows of a member, and how it ends.
fn all_rows(problem: &Problem, member: u64, signals: &Signals) -> (Vec<Vec<f64>>, End) {
    if let Some(signal) = signals.arrived() {
        return (vec![], End::Signal(signal));
    }
    let mut walk = match problem.motion(member) {
        Ok(ready) => Walk::new(problem, ready),
        Err(error) => return (vec![], End::Error(error)),
    };
    let mut front = vec![(member + 1) as f64];
    front.extend(problem.variation(member));
    let mut rows = Vec::new();
    loop {
        if let Some(signal) = signals.arrived() {
            return (rows, End::Signal(signal));
        }
        match walk.step() {
            Ok(left) => {
                rows.extend(left.rows.iter().map(|row| [&front[..], row].concat()));
                if left.done {
                    return (rows, End::Reached);
                }
            }
            Err(error) => return (rows, End::Error(error.into())),
        }
    }
}

/// What is worth a word before the motion begins; of an ensemble, the first.
fn tell(problem: &Problem, ready: &Ready, whose: &str) {
    ready.notes.iter().for_each(|text| note(&format!("{whose}{text}")));
    if problem.method.is_none() {
        let method = ready.method;
        note(&format!("method {method}: {}", method.why()));
    }
}

fn head(problem: &Problem, method: &str, front: &[&str], columns: &[Column]) -> Head {
    let front = front.iter().copied();
    let names = front.chain(columns.iter().map(|column| column.name.as_str()));
    let columns = names.map(String::from).collect();
    Head { name: problem.name.clone(), method: method.into(), columns }
}

/// `run.csv` becomes `run.partial.csv`; a device or a pipe stays.
fn partial(file: &Path) -> PathBuf {
    if fs::metadata(file).is_ok_and(|meta| !meta.is_file()) {
        return file.to_path_buf();
    }
    let ending = file.extension().map(|ending| ending.to_string_lossy().into_owned());
    file.with_extension(ending.map_or("partial".into(), |ending| format!("partial.{ending}")))
}
