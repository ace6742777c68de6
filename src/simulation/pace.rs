//! Equal steps from one wanted time to the next.

use crate::Error;
use serde::{Deserialize, Serialize};

/// The most steps on the way to one time.
const MAX_STEPS: f64 = 1e12;

/// Steps of one length, as many on the way to a time as make it at most the wanted one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    step: f64,
    leg: Option<Leg>,
}

/// The way that was begun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Leg {
    from: f64,
    until: f64,
    count: u64,
    taken: u64,
}

impl Pace {
    /// With the most that a step may be.
    pub fn new(step: f64) -> Self {
        Pace { step, leg: None }
    }

    /// Whether another could have come from this one.
    pub fn fits(&self, other: &Pace) -> bool {
        let begun = other.leg.is_none_or(|leg| {
            let whole = Leg::new(leg.from, leg.until, self.step);
            leg.taken < leg.count && whole.is_ok_and(|whole| whole.count == leg.count)
        });
        begun && self.step == other.step
    }

    /// Makes one step by `advance`, which is given its length, and returns the time behind it.
    ///
    /// # Errors
    /// [`Error::Integration`] for more steps than anyone can wait for; what `advance` refuses.
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
        // a whole number of steps is not spoilt by rounding
        let count = ((until - from).abs() / step - 1e-9).ceil().max(1.0);
        if count <= MAX_STEPS {
            return Ok(Leg { from, until, count: count as u64, taken: 0 });
        }
        let reason = format!("{count:e} steps are too many to t = {until}");
        Err(Error::Integration { t: from, reason })
    }
}
