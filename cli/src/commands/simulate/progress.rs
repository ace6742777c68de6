//! A progress bar on a terminal: the completed fraction of the motion, and the remaining time.

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::time::Duration;

/// The length of the bar in counts.
const WHOLE: f64 = 1e6;

/// A progress bar for the completed fraction of the motion, from 0 to 1.
pub struct Progress(ProgressBar);

impl Progress {
    /// Creates a bar that begins at the fraction `begun`, which is above 0 if the run resumes a
    /// checkpoint.
    pub fn from(begun: f64) -> Self {
        let target = ProgressDrawTarget::stderr_with_hz(8);
        let bar = ProgressBar::with_draw_target(Some(WHOLE as u64), target);
        let rest = move |state: &ProgressState, out: &mut dyn Write| {
            let _ = match remaining(state.elapsed(), begun, state.pos() as f64 / WHOLE) {
                Some(time) => write!(out, "about {:#} remaining", HumanDuration(time)),
                None => out.write_str("starting"),
            };
        };
        let template = "{bar:40} {percent}% {elapsed} ({rest})";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.with_key("rest", rest));
        }
        bar.enable_steady_tick(Duration::from_millis(250));
        Progress(bar)
    }

    /// Moves the bar to the fraction `share` of the motion.
    pub fn reach(&self, share: f64) {
        self.0.set_position((share * WHOLE) as u64);
    }

    /// Hides the bar while `write` writes to the terminal.
    pub fn beside(&self, write: impl FnOnce()) {
        self.0.suspend(write);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The remaining time, estimated from the mean speed of this run; `None` before the run makes
/// progress.
fn remaining(elapsed: Duration, begun: f64, reached: f64) -> Option<Duration> {
    let seconds = elapsed.as_secs_f64() * (1.0 - reached) / (reached - begun);
    Duration::try_from_secs_f64(seconds).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_remaining_time_is_proportional_to_the_remaining_share() {
        let seconds = Duration::from_secs;
        assert_eq!(remaining(seconds(10), 0.0, 0.25), Some(seconds(30)));
        // the fraction completed before the checkpoint does not count, because it took no time in
        // this run
        assert_eq!(remaining(seconds(10), 0.5, 0.75), Some(seconds(10)));
        for reached in [0.0, f64::NAN] {
            assert_eq!(remaining(seconds(10), 0.0, reached), None);
        }
    }
}
