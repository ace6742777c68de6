//! Equal steps from one output time to the next.

use crate::Error;
use crate::mechanics::stopped;

/// The largest number of steps between two output times.
const MAX_STEPS: f64 = 1e12;

/// Equal steps to each output time. Their number is as small as possible, but no step is longer
/// than a given step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedSteps {
    step: f64,
    leg: Option<Leg>,
}

/// The steps from one output time to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Leg {
    from: f64,
    until: f64,
    count: u64,
    taken: u64,
}

impl FixedSteps {
    /// Steps whose length is at most `step`.
    pub fn new(step: f64) -> Self {
        FixedSteps { step, leg: None }
    }

    /// Makes one step by calling `advance` with the length of the step. Returns the time after the
    /// step.
    ///
    /// # Errors
    /// [`Error::Integration`] if more than `1e12` steps are needed to reach one time; the errors of
    /// `advance`.
    pub fn step(
        &mut self,
        time: f64,
        until: f64,
        advance: impl FnOnce(f64) -> Result<(), Error>,
    ) -> Result<f64, Error> {
        let way = match self.leg.filter(|leg| leg.until == until) {
            Some(leg) => leg,
            None => Leg::new(time, until, self.step)?,
        };
        let h = (way.until - way.from) / way.count as f64;
        advance(h)?;
        let taken = way.taken + 1;
        self.leg = (taken < way.count).then_some(Leg { taken, ..way });
        Ok(if taken == way.count { until } else { way.from + h * taken as f64 })
    }
}

impl Leg {
    fn new(from: f64, until: f64, step: f64) -> Result<Self, Error> {
        // subtracts a tolerance, so that rounding errors do not add a step to a whole number of
        // steps
        let count = ((until - from).abs() / step - 1e-9).ceil().max(1.0);
        if count <= MAX_STEPS {
            return Ok(Leg { from, until, count: count as u64, taken: 0 });
        }
        Err(stopped(from, format!("{count:e} steps are too many to t = {until}")))
    }
}
