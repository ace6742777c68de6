//! Times at which a function of the state changes its sign.

use super::dense::Step;
use super::{Integrator, System};
use crate::Error;

/// Which changes of sign are meant, as time increases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Any.
    #[default]
    Both,
}

/// What a run does after an event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Then {
    /// It goes on.
    #[default]
    GoOn,
    /// It ends there.
    Stop,
}

/// A function of the state and the changes of its sign that matter.
pub struct Event<'a, T> {
    function: Box<dyn Fn(&T) -> f64 + 'a>,
    direction: Direction,
    then: Then,
}

impl<'a, T> Event<'a, T> {
    /// The event of a function.
    pub fn new(function: impl Fn(&T) -> f64 + 'a, direction: Direction, then: Then) -> Self {
        Event { function: Box::new(function), direction, then }
    }

    fn is_meant(&self, rising: bool) -> bool {
        match self.direction {
            Direction::Rising => rising,
            Direction::Falling => !rising,
            Direction::Both => true,
        }
    }
}

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing<T> {
    /// Its number among the events that are watched, from 0.
    pub event: usize,
    /// The state at that time: the first one, to the rounding of time, that is beyond the change of sign.
    pub state: T,
    /// Whether the run ends here.
    pub then: Then,
}

/// Events along a run: each is found once, in the step where the sign changes.
///
/// Where the values grow on both sides of the place instead of shrinking, as at a pole or where an angle begins again, their sign
/// changes without a zero, and that is no event; a jump between values that stay is one.
///
/// A zero at the very end of a step counts in that step, and so not in the next; a run that starts at a zero has not
/// crossed it. Of two changes of sign within one step neither is seen, so steps have to be short beside the time between
/// events.
///
/// ```
/// use affinor::dynamics::events::{Direction, Event, Then, Watch};
/// use affinor::dynamics::{Integrator, Linear, Magnus, Place, dense::Step};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// // a wheel that is turned faster and faster, by t^2/2: the first half turn
/// let wheel = Linear { group: So3, velocity: |t: f64| Vector3::x() * t };
/// let mut place = Place { time: 0.0, element: So3.identity() };
/// let up = |at: &Place<So3>| (at.element * Vector3::y()).z;
/// let half = Event::new(up, Direction::Falling, Then::Stop);
/// let mut watch = Watch::new(vec![half], &wheel, &place)?;
/// loop {
///     let step = Step { system: &wheel, method: &Magnus::Four, start: place.clone(), length: 0.1 };
///     if watch.advance(&step, &mut place)?.iter().any(|crossing| crossing.then == Then::Stop) {
///         break;
///     }
/// }
/// assert!((place.time - std::f64::consts::TAU.sqrt()).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
pub struct Watch<'a, T> {
    events: Vec<Event<'a, T>>,
    /// Those of the functions at the state that was reached.
    values: Vec<f64>,
}

impl<'a, T: Clone> Watch<'a, T> {
    /// Watches events from a state on.
    ///
    /// # Errors
    /// [`Error::Integration`] where a function is not a number.
    pub fn new<S: System<State = T>>(
        events: Vec<Event<'a, T>>,
        system: &S,
        start: &T,
    ) -> Result<Self, Error> {
        let mut watch = Watch { events, values: vec![] };
        watch.values = watch.values_at(system, start)?;
        Ok(watch)
    }

    /// Makes a step, which has to start where the last one ended: `state` becomes its end, or is where the first event
    /// happened that stops the run. The events are in the order of the run, the one that stops it last.
    ///
    /// # Errors
    /// Those of the method, and [`Error::Integration`] where a function is not a number; the state is then as it was.
    pub fn advance<S: System<State = T>, I: Integrator<S>>(
        &mut self,
        step: &Step<S, I>,
        state: &mut T,
    ) -> Result<Vec<Crossing<T>>, Error> {
        self.pass(step, step.after(step.length)?, state)
    }

    /// The same for a step whose end is known: of an adaptive method, by its own formula.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn pass<S: System<State = T>, I: Integrator<S>>(
        &mut self,
        step: &Step<S, I>,
        end: T,
        state: &mut T,
    ) -> Result<Vec<Crossing<T>>, Error> {
        let values = self.values_at(step.system, &end)?;
        let mut found = vec![];
        for (at, (before, behind)) in self.values.iter().zip(&values).enumerate() {
            let rising = (*before < 0.0) == (step.length > 0.0);
            if is_crossed(*before, *behind) && self.events[at].is_meant(rising) {
                found.extend(
                    self.located(at, step, [*before, *behind])?.map(|elapsed| (elapsed, at)),
                );
            }
        }
        found.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let mut crossings = vec![];
        for (elapsed, event) in found {
            let then = self.events[event].then;
            let last = elapsed == step.length;
            let there = if last { end.clone() } else { step.after(elapsed)? };
            crossings.push(Crossing { event, state: there.clone(), then });
            if then == Then::Stop {
                self.values = self.values_at(step.system, &there)?;
                *state = there;
                return Ok(crossings);
            }
        }
        (self.values, *state) = (values, end);
        Ok(crossings)
    }

    fn values_at<S: System<State = T>>(&self, system: &S, state: &T) -> Result<Vec<f64>, Error> {
        (0..self.events.len()).map(|event| self.value(event, system, state)).collect()
    }

    fn value<S: System<State = T>>(&self, event: usize, system: &S, at: &T) -> Result<f64, Error> {
        expect_number(system.time(at), (self.events[event].function)(at))
    }

    /// The time from the start of a step, with values at its ends, to the far side of a zero within it.
    fn located<S: System<State = T>, I: Integrator<S>>(
        &self,
        event: usize,
        step: &Step<S, I>,
        values: [f64; 2],
    ) -> Result<Option<f64>, Error> {
        let value = |elapsed: f64| self.value(event, step.system, &step.after(elapsed)?);
        let start = step.system.time(&step.start);
        change_of_sign(value, start, step.length, values)
    }
}

/// Whether zero lies between two values, or at the second: one that starts at zero has not crossed it.
pub(crate) fn is_crossed(before: f64, behind: f64) -> bool {
    before != 0.0 && (behind == 0.0 || (before < 0.0) != (behind < 0.0))
}

/// The value of the function of an event.
///
/// # Errors
/// [`Error::Integration`] where it is not a number.
pub(crate) fn expect_number(time: f64, value: f64) -> Result<f64, Error> {
    if value.is_nan() {
        let reason = "the function of an event is not a number".into();
        return Err(Error::Integration { t: time, reason });
    }
    Ok(value)
}

/// Where a function of given values at 0 and `end` changes its sign between them, to the rounding of times after `start`: the
/// point beyond. None where it has no zero there but a pole, or jumps to the other sign as an angle does: its values do not
/// shrink towards the place, but grow.
///
/// The ITP method of I. F. D. Oliveira and R. H. C. Takahashi, *ACM Trans. Math. Softw.* 47 (2021) 5: as fast as secants
/// where these serve, and never more than one evaluation behind bisection.
pub(crate) fn change_of_sign(
    mut value: impl FnMut(f64) -> Result<f64, Error>,
    start: f64,
    end: f64,
    ends: [f64; 2],
) -> Result<Option<f64>, Error> {
    let [mut before, mut behind] = ends;
    let resolution = f64::EPSILON * start.abs().max((start + end).abs());
    let (mut a, mut b) = (0.0, end);
    if behind == 0.0 {
        return Ok(Some(end));
    }
    // the bracket that bisection would have come to, one step late
    let mut allowed = resolution * 2.0 * (end.abs() / resolution).max(1.0).log2().ceil().exp2();
    while (b - a).abs() > resolution {
        let middle = a + 0.5 * (b - a);
        if middle == a || middle == b {
            break;
        }
        let secant = (behind * a - before * b) / (behind - before);
        // towards the middle, so that both ends of the bracket move
        let nudge = 0.2 * (b - a).powi(2) / end.abs();
        let towards = (middle - secant).signum();
        let nudged =
            if nudge <= (middle - secant).abs() { secant + towards * nudge } else { middle };
        let radius = 0.5 * (allowed - (b - a).abs()).max(0.0);
        let inside = (nudged - middle).abs() <= radius;
        let mut at = if inside { nudged } else { middle - towards * radius };
        if !(at.is_finite() && at != a && at != b) {
            at = middle;
        }
        match value(at)? {
            0.0 => return Ok(Some(at)),
            y if (y < 0.0) == (behind < 0.0) => (b, behind) = (at, y),
            y => (a, before) = (at, y),
        }
        allowed *= 0.5;
    }
    let grown = |at: f64, end: f64| at.abs() >= end.abs();
    let grows = grown(before, ends[0]) && grown(behind, ends[1]) && [before, behind] != ends;
    Ok((!grows).then_some(b))
}
