//! A bar on a terminal: how much of the motion is done, and about how long the rest takes.

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::time::Duration;

/// The whole, in parts that a bar counts.
const WHOLE: f64 = 1e6;

/// A share of the whole that grows from where the run begins to 1.
pub struct Progress(ProgressBar);

impl Progress {
    /// Shown once the run takes a while.
    pub fn from(begun: f64) -> Self {
        let target = ProgressDrawTarget::stderr_with_hz(8);
        let bar = ProgressBar::with_draw_target(Some(WHOLE as u64), target);
        let left = move |state: &ProgressState, out: &mut dyn Write| {
            let left = left(state.elapsed(), begun, state.pos() as f64 / WHOLE);
            let _ = match left {
                Some(left) => write!(out, "about {:#} left", HumanDuration(left)),
                None => out.write_str("just begun"),
            };
        };
        let template = "{bar:40} {percent}% {elapsed} ({left})";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.with_key("left", left));
        }
        bar.enable_steady_tick(Duration::from_millis(250));
        Progress(bar)
    }

    pub fn reach(&self, share: f64) {
        self.0.set_position((share * WHOLE) as u64);
    }

    /// Writes something else to the terminal.
    pub fn beside(&self, write: impl FnOnce()) {
        self.0.suspend(write);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The time for the rest, at the mean pace of this run so far.
fn left(elapsed: Duration, begun: f64, reached: f64) -> Option<Duration> {
    let seconds = elapsed.as_secs_f64() * (1.0 - reached) / (reached - begun);
    Duration::try_from_secs_f64(seconds).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_as_long_as_its_share() {
        let seconds = Duration::from_secs;
        assert_eq!(left(seconds(10), 0.0, 0.25), Some(seconds(30)));
        // what a run before this one did took none of its time
        assert_eq!(left(seconds(10), 0.5, 0.75), Some(seconds(10)));
        for reached in [0.0, f64::NAN] {
            assert_eq!(left(seconds(10), 0.0, reached), None);
        }
    }
}
