//! Checkpoints of ensembles: a checkpoint records the completed members, so that a killed run can
//! be resumed with the same results.
//!
//! The rows are stored in `FILE.rows`, next to the checkpoint. First the rows are flushed to the
//! disk. Then the new checkpoint, which contains their number, replaces the old checkpoint by a
//! rename. Therefore the file always contains a complete checkpoint.

use super::super::failure::Failure;
use super::super::note::{counted, note};
use super::super::output::{deliver, is_same};
use super::spool::{Spool, failed};
use affinor_documents::input::{InputError, fingerprint};
use affinor_documents::problem::Problem;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const SCHEMA: &str = "affinor.checkpoint/4";

/// The progress of a run.
#[derive(Serialize, Deserialize)]
pub struct Checkpoint {
    schema: String,
    /// The version of the program: another version may round differently.
    version: String,
    /// The text of the problem; a run can be resumed only with the same text.
    problem: String,
    /// The files that the problem reads, with their fingerprints.
    files: Vec<(String, u64)>,
    /// The options that override keys of the problem, by their names.
    options: Vec<(String, Option<String>)>,
    rows: u64,
    /// The number of completed members.
    pub done: u64,
    /// The error of the first failed member of an ensemble.
    pub stopped: Option<String>,
}

/// The plan of the checkpoints of a run, made before any file is written.
pub struct Plan {
    path: Option<PathBuf>,
    every: Duration,
    checkpoint: Checkpoint,
    resumed: bool,
}

/// The rows and the checkpoint of a running simulation.
pub struct Store {
    pub spool: Spool,
    plan: Plan,
    last: Instant,
}

impl Plan {
    pub fn of(arguments: &super::Arguments, problem: &Problem) -> Result<Self, Failure> {
        let every = Duration::try_from_secs_f64(arguments.checkpoint_every);
        let every = every.map_err(|_| {
            let seconds = arguments.checkpoint_every;
            InputError::usage(format!("--checkpoint-every {seconds} is not a number of seconds"))
        })?;
        let method = ("--method".into(), arguments.method.clone());
        let mut fresh = Checkpoint {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            problem: problem.text().into(),
            files: vec![],
            options: [arguments.problem.given(), vec![method]].concat(),
            rows: 0,
            done: 0,
            stopped: None,
        };
        let Some(path) = arguments.checkpoint.clone() else {
            return Ok(Plan { path: None, every, checkpoint: fresh, resumed: false });
        };
        for file in problem.files() {
            fresh.files.push((file.clone(), fingerprint(file)?));
        }
        let rows = rows_of(&path);
        if let Some(file) = &arguments.file
            && (is_same(&path, file) || is_same(&rows, file))
        {
            let message = "the rows and the checkpoint need different files";
            return Err(InputError::usage(message)
                .help("change the name in -o or in --checkpoint")
                .into());
        }
        let found = if arguments.resume { read(&path, &fresh)? } else { None };
        let resumed = found.is_some();
        if path.exists() && !resumed {
            let error = InputError::usage(format!("{} exists already", shown(&path)));
            return Err(error.help("resume it with --resume, or delete it").into());
        }
        if rows.exists() && !resumed {
            let message = format!("{} exists already, without its checkpoint", shown(&rows));
            let help = "delete the file, or give the checkpoint another name: the run stores its rows in this file";
            return Err(InputError::usage(message).help(help).into());
        }
        if arguments.resume && !resumed {
            note("no checkpoint found: the run starts from the beginning");
        }
        Ok(Plan { path: Some(path), every, checkpoint: found.unwrap_or(fresh), resumed })
    }

    /// Opens the file of rows. Writes a checkpoint first, so that there is never a file of rows
    /// without a checkpoint.
    pub fn begin(self, width: usize) -> Result<Store, Failure> {
        let spool = match &self.path {
            None => Spool::temporary(width).map_err(failed)?,
            Some(path) => {
                if !self.resumed {
                    self.write(path)?;
                }
                let (rows, count) = (rows_of(path), self.checkpoint.rows);
                let kept = Spool::named(&rows, width, count).map_err(failed)?;
                kept.ok_or_else(|| {
                    let is = if rows.exists() { "is too short" } else { "is missing" };
                    let (rows, path) = (shown(&rows), shown(path));
                    let message = format!(
                        "{rows} {is}: according to {path}, it contains {}",
                        counted(count, "row")
                    );
                    let help = "restore both files, or delete both and start again";
                    InputError::usage(message).help(help)
                })?
            }
        };
        Ok(Store { spool, plan: self, last: Instant::now() })
    }

    fn write(&self, path: &Path) -> Result<(), Failure> {
        deliver(Some(path), &[], |out| {
            serde_json::to_writer(&mut *out, &self.checkpoint).map_err(io::Error::from)
        })
    }
}

impl Store {
    /// The checkpoint from which the run was resumed; `None` for a new run.
    pub fn resumed(&self) -> Option<&Checkpoint> {
        self.plan.resumed.then_some(&self.plan.checkpoint)
    }

    /// Whether the time for the next checkpoint has come.
    pub fn is_due(&self) -> bool {
        self.plan.path.is_some() && self.last.elapsed() >= self.plan.every
    }

    /// Records the reason why a member of an ensemble failed, unless an earlier member failed.
    pub fn stop(&mut self, reason: String) {
        self.plan.checkpoint.stopped.get_or_insert(reason);
    }

    /// The reason why the first failed member failed.
    pub fn stopped(&self) -> Option<&str> {
        self.plan.checkpoint.stopped.as_deref()
    }

    /// Writes a checkpoint.
    pub fn save(&mut self, done: u64) -> Result<(), Failure> {
        let Some(path) = &self.plan.path else { return Ok(()) };
        self.spool.sync().map_err(failed)?;
        let rows = self.spool.count();
        let checkpoint = &mut self.plan.checkpoint;
        (checkpoint.rows, checkpoint.done) = (rows, done);
        self.plan.write(path)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Deletes the checkpoint and the file of rows.
    pub fn finished(&self) {
        if let Some(path) = &self.plan.path {
            for file in [rows_of(path), path.clone()] {
                // ignores errors: a remaining file does no harm
                let _ = fs::remove_file(file);
            }
        }
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string().escape_debug().to_string()
}

fn rows_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".rows");
    name.into()
}

/// Reads the checkpoint in a file, if the file exists, and checks that it belongs to the same run.
fn read(path: &Path, fresh: &Checkpoint) -> Result<Option<Checkpoint>, Failure> {
    let shown = shown(path);
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(InputError::usage(format!("cannot read {shown}: {error}")).into()),
    };
    let found: Checkpoint = serde_json::from_str(&text)
        .map_err(|error| InputError::usage(format!("{shown} is not a checkpoint: {error}")))?;
    let mut same = vec![
        ("schema".to_string(), found.schema == fresh.schema),
        ("version of affinor".into(), found.version == fresh.version),
        ("problem".into(), found.problem == fresh.problem),
    ];
    same.extend(fresh.options.iter().enumerate().map(|(at, option)| {
        let before = found.options.get(at);
        (option.0.clone(), before == Some(option))
    }));
    // compares the files in order: the same problem always refers to its files in the same order,
    // but their paths differ if it is run from another folder
    same.extend(fresh.files.iter().enumerate().map(|(at, (file, fingerprint))| {
        let before = found.files.get(at).map(|(_, before)| before);
        (format!("content of {}", file.escape_debug()), before == Some(fingerprint))
    }));
    if let Some((what, _)) = same.iter().find(|(_, same)| !same) {
        let message = format!("{shown} was saved with a different {what}");
        let help = "restore what has changed, or delete the checkpoint and start again";
        return Err(InputError::usage(message).help(help).into());
    }
    Ok(Some(found))
}
