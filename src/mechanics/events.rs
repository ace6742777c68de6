//! Events: times at which a function of the state changes its sign.

use super::integrators::dense_output::DenseStep;
use super::{Integrator, System};
use crate::Error;
use crate::mechanics::stopped;

/// The sign changes that count as events, as time increases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// The function changes from negative to positive.
    Rising,
    /// The function changes from positive to negative.
    Falling,
    /// Sign changes in both directions count.
    #[default]
    Both,
}

/// The behaviour after an event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AfterEvent {
    /// The run goes on.
    #[default]
    GoOn,
    /// The run ends at the event, which is a terminal event.
    Stop,
}

/// An event function of the state, and the sign changes that count as events.
pub struct Event<'a, T> {
    function: Box<dyn Fn(&T) -> f64 + 'a>,
    direction: Direction,
    then: AfterEvent,
}

impl<'a, T> Event<'a, T> {
    /// An event that occurs where a function of the state changes its sign.
    pub fn new(function: impl Fn(&T) -> f64 + 'a, direction: Direction, then: AfterEvent) -> Self {
        Event { function: Box::new(function), direction, then }
    }

    fn is_meant(&self, rising: bool) -> bool {
        match self.direction {
            Direction::Rising => rising,
            Direction::Falling => !rising,
            Direction::Both => true,
        }
    }

    fn value(&self, time: f64, state: &T) -> Result<f64, Error> {
        expect_number(time, (self.function)(state))
    }
}

/// An occurrence of an event, with the state at the event.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing<T> {
    /// The index of the event in the list of watched events, from 0.
    pub event: usize,
    /// The state at the first time after the sign change, up to the resolution of floats.
    pub state: T,
    /// Whether the run ends at this event.
    pub then: AfterEvent,
}

/// Finds the events of a run. Each event is found once, in the step in which the sign changes.
///
/// Sign changes at poles and at angle wraps are ignored: near these, the absolute value increases
/// towards the change on both sides. A jump between two constant values is an event.
///
/// If the function is zero at the end of a step, the event belongs to this step, and not to the
/// next one. If it is zero at the start of the run, there is no event. If a function becomes zero
/// and remains zero, the event is at the time when it becomes zero, and not when it leaves zero.
/// Two sign changes within one step are missed, so steps must be shorter than the time between
/// events.
///
/// ```
/// use affinor::mechanics::events::{Direction, Event, AfterEvent, EventDetector};
/// use affinor::mechanics::{Integrator, PrescribedVelocity, Magnus, KinematicState};
/// use affinor::mechanics::integrators::dense_output::DenseStep;
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// // a wheel that is turned faster and faster, by t^2/2: the first half turn
/// let wheel = PrescribedVelocity { group: So3, velocity: |t: f64| Vector3::x() * t };
/// let mut place = KinematicState { time: 0.0, element: So3.identity() };
/// let up = |at: &KinematicState<So3>| (at.element * Vector3::y()).z;
/// let half = Event::new(up, Direction::Falling, AfterEvent::Stop);
/// let mut watch = EventDetector::new(vec![half], &wheel, &place)?;
/// loop {
///     let step = DenseStep { system: &wheel, method: &Magnus::Four, start: place.clone(), length: 0.1 };
///     if watch.advance(&step, &mut place)?.iter().any(|crossing| crossing.then == AfterEvent::Stop) {
///         break;
///     }
/// }
/// assert!((place.time - std::f64::consts::TAU.sqrt()).abs() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
pub struct EventDetector<'a, T> {
    events: Vec<Event<'a, T>>,
    /// The values of the functions at the current state.
    values: Vec<f64>,
    /// The values of the functions at the end of a step.
    next: Vec<f64>,
}

impl<'a, T: Clone> EventDetector<'a, T> {
    /// Watches events from this state on.
    ///
    /// # Errors
    /// [`Error::Integration`] if the value of a function is NaN.
    pub fn new<S: System<State = T>>(
        events: Vec<Event<'a, T>>,
        system: &S,
        start: &T,
    ) -> Result<Self, Error> {
        let [values, next] = [0, 1].map(|_| Vec::with_capacity(events.len()));
        let mut watch = EventDetector { events, values, next };
        watch.evaluate(system, start)?;
        std::mem::swap(&mut watch.values, &mut watch.next);
        Ok(watch)
    }

    /// Makes a step. It must start at the end of the previous step. The parameter `state` becomes
    /// the end of the step, or the state at the first terminal event. Returns the events in the
    /// order of the run; a terminal event is the last event.
    ///
    /// # Errors
    /// The errors of the method, and [`Error::Integration`] if the value of a function is NaN. In
    /// this case, `state` is unchanged.
    pub fn advance<S: System<State = T>, I: Integrator<S>>(
        &mut self,
        step: &DenseStep<S, I>,
        state: &mut T,
    ) -> Result<Vec<Crossing<T>>, Error> {
        self.pass(step, step.after(step.length)?, state)
    }

    /// Processes events as in [`advance`](Self::advance), for a step whose end is already known,
    /// such as a step of an adaptive method.
    ///
    /// # Errors
    /// The errors of [`advance`](Self::advance).
    pub fn pass<S: System<State = T>, I: Integrator<S>>(
        &mut self,
        step: &DenseStep<S, I>,
        end: T,
        state: &mut T,
    ) -> Result<Vec<Crossing<T>>, Error> {
        self.evaluate(step.system, &end)?;
        let start = step.system.time(&step.start);
        let found = changes_of_sign(
            [&self.values, &self.next],
            (start, step.length),
            |event, rising| self.events[event].is_meant(rising),
            |event, elapsed| {
                let state = step.after(elapsed)?;
                self.events[event].value(step.system.time(&state), &state)
            },
        )?;
        let mut crossings = vec![];
        for (elapsed, event) in found {
            let then = self.events[event].then;
            let last = elapsed == step.length;
            let there = if last { end.clone() } else { step.after(elapsed)? };
            crossings.push(Crossing { event, state: there.clone(), then });
            if then == AfterEvent::Stop {
                self.evaluate(step.system, &there)?;
                std::mem::swap(&mut self.values, &mut self.next);
                *state = there;
                return Ok(crossings);
            }
        }
        std::mem::swap(&mut self.values, &mut self.next);
        *state = end;
        Ok(crossings)
    }

    /// Evaluates the functions at a state.
    fn evaluate<S: System<State = T>>(&mut self, system: &S, state: &T) -> Result<(), Error> {
        self.next.clear();
        for event in &self.events {
            self.next.push(event.value(system.time(state), state)?);
        }
        Ok(())
    }
}

/// The sign changes of functions in a step that begins at a time. The length of the step is
/// negative backwards in time. Returns, in the order of the run, the time since the start and the
/// index of the function.
///
/// The functions have the values `before` and `after` at the ends of the step, and `value` within
/// the step. If a function is zero at the start, this is not a sign change. Sign changes whose
/// direction is not `wanted` are omitted; the argument of `wanted` is true if the function
/// increases with time.
pub(crate) fn changes_of_sign(
    [before, after]: [&[f64]; 2],
    (start, length): (f64, f64),
    wanted: impl Fn(usize, bool) -> bool,
    mut value: impl FnMut(usize, f64) -> Result<f64, Error>,
) -> Result<Vec<(f64, usize)>, Error> {
    let mut found = vec![];
    for (event, (&before, &after)) in before.iter().zip(after).enumerate() {
        let crossed = before != 0.0 && (after == 0.0 || (before < 0.0) != (after < 0.0));
        if crossed && wanted(event, (before < 0.0) == (length > 0.0)) {
            let value = |elapsed| value(event, elapsed);
            let elapsed = change_of_sign(value, start, length, [before, after])?;
            found.extend(elapsed.map(|elapsed| (elapsed, event)));
        }
    }
    found.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    Ok(found)
}

/// Checks that the value of an event function is not NaN.
///
/// # Errors
/// [`Error::Integration`] if the value is NaN.
pub(crate) fn expect_number(time: f64, value: f64) -> Result<f64, Error> {
    if value.is_nan() {
        return Err(stopped(time, "the value of an event function is NaN"));
    }
    Ok(value)
}

/// The first point after a sign change of a function between 0 and `end`, up to the resolution of
/// the times `start + x`. The function has the values `ends` at 0 and at `end`. Returns `None` at a
/// pole or an angle wrap, where the absolute value of the function increases towards the sign
/// change.
///
/// The method is the ITP method of I. F. D. Oliveira and R. H. C. Takahashi, *ACM Trans. Math.
/// Softw.* 47 (2021) 5. It is as fast as the secant method, and needs at most one evaluation more
/// than bisection.
#[inline(never)] // if this function were inlined, its logarithm would be computed in every step
fn change_of_sign(
    mut value: impl FnMut(f64) -> Result<f64, Error>,
    start: f64,
    end: f64,
    ends: [f64; 2],
) -> Result<Option<f64>, Error> {
    let [mut before, mut behind] = ends;
    let resolution = f64::EPSILON * start.abs().max((start + end).abs());
    let (mut a, mut b) = (0.0, end);
    // the width that the bracket of bisection would have one step earlier
    let mut allowed = resolution * 2.0 * (end.abs() / resolution).max(1.0).log2().ceil().exp2();
    while (b - a).abs() > resolution {
        let middle = a + 0.5 * (b - a);
        if middle == a || middle == b {
            break;
        }
        let secant = (behind * a - before * b) / (behind - before);
        // shifts the point towards the middle, so that both ends of the bracket move
        let nudge = 0.2 * (b - a).powi(2) / end.abs();
        let towards = (middle - secant).signum();
        let nudged =
            if nudge <= (middle - secant).abs() { secant + towards * nudge } else { middle };
        let radius = 0.5 * (allowed - (b - a).abs()).max(0.0);
        let inside = (nudged - middle).abs() <= radius;
        let mut at = if inside { nudged } else { middle - towards * radius };
        // bisects if the function is zero at the end, because it may remain zero; the event is
        // where it becomes zero
        if behind == 0.0 || !(at.is_finite() && at != a && at != b) {
            at = middle;
        }
        match value(at)? {
            y if y == 0.0 || (y < 0.0) != (before < 0.0) => (b, behind) = (at, y),
            y => (a, before) = (at, y),
        }
        allowed *= 0.5;
    }
    let grown = |at: f64, end: f64| at.abs() >= end.abs();
    let grows = grown(before, ends[0]) && grown(behind, ends[1]) && [before, behind] != ends;
    Ok((behind == 0.0 || !grows).then_some(b))
}
