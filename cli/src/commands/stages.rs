//! The stages of a computation: a spinner on a terminal, and `--timings`.

use super::note::line;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// Stages, one after the other, with the time that each takes.
pub struct Stages {
    timings: bool,
    spinner: ProgressBar,
    current: RefCell<Option<(String, Instant)>>,
}

/// The time between two frames of the spinner.
const TICK: Duration = Duration::from_millis(120);
/// The time before the spinner appears.
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
                // it stays hidden unless standard error is a terminal
                late.set_draw_target(ProgressDrawTarget::stderr());
                late.enable_steady_tick(TICK);
            }
        });
        Stages { timings, spinner, current: RefCell::new(None) }
    }

    /// Ends the current stage and begins the next.
    pub fn begin(&self, name: &str) {
        self.end();
        self.spinner.set_message(name.to_string());
        *self.current.borrow_mut() = Some((name.to_string(), Instant::now()));
    }

    /// Begins the last stage, the output of the results, without a spinner.
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
