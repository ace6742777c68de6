//! The stages of a long computation: a sign of life on a terminal, and `--timings`.

use super::note::line;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// Watches stages, one after the other.
pub struct Stages {
    timings: bool,
    spinner: ProgressBar,
    current: RefCell<Option<(String, Instant)>>,
}

/// How often the sign of life moves; a shorter stage passes unseen.
const TICK: Duration = Duration::from_millis(120);

impl Stages {
    pub fn new(timings: bool) -> Self {
        // hidden by itself where standard error is no terminal
        let spinner = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
            spinner.set_style(style);
        }
        spinner.enable_steady_tick(TICK);
        Stages { timings, spinner, current: RefCell::new(None) }
    }

    /// Begins a stage, which ends the one before.
    pub fn begin(&self, name: &str) {
        self.end();
        self.spinner.set_message(name.to_string());
        *self.current.borrow_mut() = Some((name.to_string(), Instant::now()));
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

impl Drop for Stages {
    fn drop(&mut self) {
        self.end();
        self.spinner.finish_and_clear();
    }
}
