//! The stages of a computation, shown by a spinner on a terminal and by `--timings`.

use super::note::line;
use affinor_documents::input::InputError;
use affinor_tensors::Effort;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::RefCell;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Consecutive stages of a command, and the time of each stage.
pub struct Stages {
    timings: bool,
    spinner: ProgressBar,
    current: RefCell<Option<(String, Instant)>>,
    effort: Arc<Effort>,
}

/// The time between two frames of the spinner.
const TICK: Duration = Duration::from_millis(120);
/// The time before the spinner appears; faster commands show no spinner.
const PATIENCE: Duration = Duration::from_millis(600);

/// The name of the current stage.
static CURRENT: Mutex<String> = Mutex::new(String::new());

/// The name of the current stage; empty for a command without stages.
pub fn current() -> String {
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

impl Stages {
    /// Creates the stages of a command whose formulas may have at most `limit` terms.
    pub fn new(timings: bool, limit: u64) -> Self {
        let spinner = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}{prefix}") {
            spinner.set_style(style);
        }
        let late = spinner.clone();
        let effort = Effort::new(limit);
        let formed = effort.clone();
        std::thread::spawn(move || {
            std::thread::sleep(PATIENCE);
            if !late.is_finished() {
                // indicatif draws the spinner only if standard error is a terminal
                late.set_draw_target(ProgressDrawTarget::stderr());
                late.enable_steady_tick(TICK);
            }
            while !late.is_finished() {
                let terms = formed.terms();
                if terms > 0 {
                    late.set_prefix(format!(", {terms} terms"));
                }
                std::thread::sleep(PATIENCE);
            }
        });
        Stages { timings, spinner, current: RefCell::new(None), effort }
    }

    /// Runs `work` within the limit on the terms of formulas.
    ///
    /// # Errors
    /// If the limit is exceeded, an error that names the stage and gives advice.
    pub fn bound<T>(&self, work: impl FnOnce() -> T) -> Result<T, InputError> {
        self.effort.bound(work).map_err(|exceeded| {
            let stage = self.current.borrow().as_ref().map(|(stage, _)| stage.clone());
            let message = format!("{exceeded}, in the stage `{}`", stage.unwrap_or_default());
            let help = format!(
                "allow more with --max-terms {} (150 bytes per term), give symbols values with --set, or write a program \
                 with affinor table SPACE --code c (or rust, python)",
                exceeded.limit.saturating_mul(4)
            );
            InputError::mathematics(message).help(help)
        })
    }

    /// Returns a writer that writes nothing once the limit is exceeded, because values formed
    /// afterwards are meaningless.
    pub fn within<'s>(&'s self, out: &'s mut dyn Write) -> impl Write + 's {
        Within { out, effort: &self.effort }
    }

    /// Ends the current stage and begins the next.
    pub fn begin(&self, name: &str) {
        self.end();
        self.spinner.set_message(name.to_string());
        self.set(name);
    }

    /// Begins the last stage, the output of the results, which has no spinner.
    pub fn begin_output(&self) {
        self.end();
        self.spinner.finish_and_clear();
        self.set("output");
    }

    fn set(&self, name: &str) {
        *self.current.borrow_mut() = Some((name.to_string(), Instant::now()));
        *CURRENT.lock().unwrap_or_else(PoisonError::into_inner) = name.to_string();
    }

    fn end(&self) {
        if let Some((name, start)) = self.current.borrow_mut().take()
            && self.timings
        {
            let seconds = start.elapsed().as_secs_f64();
            self.spinner.suspend(|| line(&format!("timing: {name} {seconds:.3} s")));
        }
    }
}

struct Within<'s> {
    out: &'s mut dyn Write,
    effort: &'s Effort,
}

impl Write for Within<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.effort.exceeded() {
            None => self.out.write(bytes),
            Some(exceeded) => Err(io::Error::other(exceeded)),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Drop for Stages {
    fn drop(&mut self) {
        self.end();
        self.spinner.finish_and_clear();
    }
}
