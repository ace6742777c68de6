//! Trajectories with dense output and events.

use super::dense_output::DenseStep;
use super::runge_kutta::{LocalCoordinates, RungeKutta};
use super::{Adaptive, Integrator, Pair};
use crate::Error;
use crate::mechanics::events::{AfterEvent, Crossing, Event, EventDetector};
use crate::mechanics::stopped;
use crate::mechanics::systems::cotangent::{CotangentSystem, State};

/// A trajectory that is computed with step-size control. It contains the states at the ends of its
/// steps and the events, and computes states between them.
///
/// ```
/// use affinor::mechanics::events::{Direction, Event, AfterEvent};
/// use affinor::mechanics::{Adaptive, EulerPoincare, State};
/// use affinor::group::{LieGroup, So3};
/// use affinor::{CanonicalConnection, Connection, Metric};
/// use affinor::tensors::{Down, Tensor};
/// use nalgebra::Vector3;
/// let so3 = So3.algebra()?;
/// let moments = (0..3).map(|i| ([i, i], 1.0 + i as f64));
/// let inertia = Metric::new(so3.labels(), Tensor::from_components(3, &[Down, Down], moments)?)?;
/// let body = EulerPoincare::free(So3, &Connection::canonical(&so3, CanonicalConnection::Plus), &inertia)?;
/// let start = body.state(0.0, So3.identity(), &Vector3::new(0.3, 1.0, 0.1));
/// // the run ends when the third component of the velocity vanishes
/// let omega = |state: &State<So3>| body.velocity(state).z;
/// let event = Event::new(omega, Direction::Falling, AfterEvent::Stop);
/// let trajectory = Adaptive::new(1e-12).run(&body, &start, 100.0, vec![event])?;
/// let end = trajectory.end();
/// assert!(omega(end).abs() < 1e-14 && end.time < 100.0);
/// assert!(omega(&trajectory.at(0.5 * end.time)?) > 0.0);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Debug)]
pub struct Trajectory<'s, S: CotangentSystem, C> {
    system: &'s S,
    method: FixedStep<C>,
    states: Vec<State<S::Group>>,
    events: Vec<Crossing<State<S::Group>>>,
}

/// The pair of an adaptive method, used as a method with fixed step size.
#[derive(Clone, Copy, Debug)]
struct FixedStep<C>(Adaptive<C>);

impl<S: CotangentSystem, C: LocalCoordinates<S::Group>> Integrator<S> for FixedStep<C> {
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        match self.0.pair {
            Pair::Five => RungeKutta::<_, _, C>::DORMAND_PRINCE.step(system, state, h),
            Pair::Eight => RungeKutta::<_, _, C>::DORMAND_PRINCE_8.step(system, state, h),
        }
    }
}

impl<C: Copy> Adaptive<C> {
    /// Computes the trajectory from a state to a time, which may be earlier, or to the first
    /// terminal event.
    ///
    /// Two sign changes of an event function within one step are missed, so
    /// [`max_step`](Adaptive::max_step) should be shorter than the time between events.
    ///
    /// # Errors
    /// [`Error::Integration`], with the time that has been reached, if there are too many steps, if
    /// a step is too small, or if an event function is NaN.
    pub fn run<'s, S: CotangentSystem>(
        &self,
        system: &'s S,
        start: &State<S::Group>,
        end: f64,
        events: Vec<Event<State<S::Group>>>,
    ) -> Result<Trajectory<'s, S, C>, Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        let (method, states) = (FixedStep(*self), vec![start.clone()]);
        let mut trajectory = Trajectory { system, method, states, events: vec![] };
        let mut watch = EventDetector::new(events, system, start)?;
        let (mut state, mut next) = (start.clone(), self.first_step());
        let mut ended = false;
        while state.time != end && !ended {
            if trajectory.states.len() > self.max_steps {
                return Err(stopped(state.time, "too many steps"));
            }
            let start = state.clone();
            self.step(system, &mut state, &mut next, end)?;
            let length = state.time - start.time;
            let step = DenseStep { system, method: &trajectory.method, start, length };
            let found = watch.pass(&step, state.clone(), &mut state)?;
            ended = found.last().is_some_and(|event| event.then == AfterEvent::Stop);
            trajectory.events.extend(found);
            trajectory.states.push(state.clone());
        }
        Ok(trajectory)
    }
}

impl<S: CotangentSystem, C: LocalCoordinates<S::Group>> Trajectory<'_, S, C> {
    /// The state at a time. It is computed by a shorter step, from the start of the step that
    /// contains the time, and has the order of the method.
    ///
    /// # Errors
    /// [`Error::Integration`] if the time is outside the trajectory; the errors of the step.
    pub fn at(&self, time: f64) -> Result<State<S::Group>, Error> {
        let [first, last] = [&self.states[0], self.end()].map(|state| state.time);
        let (earliest, latest) = (first.min(last), first.max(last));
        if !(earliest..=latest).contains(&time) {
            return Err(stopped(
                time,
                format!("the trajectory covers the times from {earliest} to {latest}"),
            ));
        }
        let reached =
            |state: &State<S::Group>| (state.time - time) * (last - first).signum() <= 0.0;
        let before = self.states.partition_point(reached).max(1) - 1;
        let start = self.states[before].clone();
        DenseStep { system: self.system, method: &self.method, start, length: 0.0 }.at(time)
    }
}

impl<S: CotangentSystem, C> Trajectory<'_, S, C> {
    /// The states at the start and at the end of each step.
    pub fn states(&self) -> &[State<S::Group>] {
        &self.states
    }

    /// The last state.
    pub fn end(&self) -> &State<S::Group> {
        &self.states[self.states.len() - 1]
    }

    /// The events, in the order of the run.
    pub fn events(&self) -> &[Crossing<State<S::Group>>] {
        &self.events
    }
}
