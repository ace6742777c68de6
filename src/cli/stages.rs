//! The stages of a long computation: a sign of life on a terminal, and `--timings`.

use super::note::line;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// Watches stages, one after the other.
pub struct Stages {
    timings: bool,
    spinner: ProgressBar,
    current: RefCell<Option<(String, Instant)>>,
}

/// How often the sign of life moves.
const TICK: Duration = Duration::from_millis(120);
/// How long it waits before it shows at all.
const PATIENCE: Duration = Duration::from_millis(600);

impl Stages {
    pub fn new(timings: bool) -> Self {
        let spinner = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
            spinner.set_style(style);
        }
        let late = spinner.clone();
        std::thread::spawn(move || {
            std::thread::sleep(PATIENCE);
            if !late.is_finished() {
                // stays hidden by itself where standard error is no terminal
                late.set_draw_target(ProgressDrawTarget::stderr());
                late.enable_steady_tick(TICK);
            }
        });
        Stages { timings, spinner, current: RefCell::new(None) }
    }

    /// Begins a stage, which ends the one before.
    pub fn begin(&self, name: &str) {
        self.end();
        self.spinner.set_message(name.to_string());
        *self.current.borrow_mut() = Some((name.to_string(), Instant::now()));
    }

    /// Begins the last stage, in which the results are written: nothing else is shown.
    pub fn begin_output(&self) {
        self.end();
        self.spinner.finish_and_clear();
        *self.current.borrow_mut() = Some(("output".into(), Instant::now()));
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
