//! Steps as long as a tolerance allows.

use super::munthe_kaas::Canonical;
use super::projected::Projection;
use super::runge_kutta::{LocalCoordinates, RungeKutta};
use super::tableaux::{DormandPrince, DormandPrince8, Tabulated};
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, State};

/// The least step, relative to the time: in a shorter one stages are hardly told from each other, and there is no end of them.
const LEAST: f64 = 16.0 * f64::EPSILON;

/// Which pair of Dormand and Prince.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pair {
    /// That of order 5.
    #[default]
    Five,
    /// That of order 8: the cheaper one for small tolerances.
    Eight,
}

impl Pair {
    /// The order of the error of a motion.
    pub fn order(self) -> u32 {
        match self {
            Pair::Five => DormandPrince::TABLEAU.order,
            Pair::Eight => DormandPrince8::TABLEAU.order,
        }
    }
}

/// A pair of Dormand and Prince with its step size under control.
///
/// A step is kept if its estimated error is below the tolerance: of the coordinates of the group, in tenths of the step
/// where this is longer than 10 in them, and relative of the momentum, at the end of the step where it is more there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive<C = Canonical> {
    /// The pair.
    pub pair: Pair,
    /// What the error of a step may be.
    pub tolerance: f64,
    /// The most steps between two times.
    pub max_steps: usize,
    /// The coordinates in which steps are made.
    pub coordinates: C,
}

impl Adaptive {
    /// The pair of order 5 with a tolerance, and at most a million steps.
    pub fn new(tolerance: f64) -> Self {
        let (pair, max_steps, coordinates) = (Pair::Five, 1_000_000, Canonical);
        Adaptive { pair, tolerance, max_steps, coordinates }
    }

    /// The same with the pair of order 8.
    pub fn of_order_8(tolerance: f64) -> Self {
        Adaptive { pair: Pair::Eight, ..Self::new(tolerance) }
    }

    /// The same with steps of [`Projected`](super::Projected).
    pub fn projected(self) -> Adaptive<Projection> {
        let Adaptive { pair, tolerance, max_steps, .. } = self;
        Adaptive { pair, tolerance, max_steps, coordinates: Projection }
    }
}

impl<C: Copy> Adaptive<C> {
    /// A first guess of a step, which the control corrects at once.
    pub fn first_step(&self) -> f64 {
        self.tolerance.powf(self.exponent()).min(0.1)
    }

    /// That of a step, as the error is of the power `order` of it.
    fn exponent(&self) -> f64 {
        1.0 / f64::from(self.pair.order())
    }

    /// One step that is kept, from a state towards `end` and not beyond it. `next` is the length to try, and becomes
    /// that of the step after it; it and the state are all that a step depends on.
    ///
    /// # Errors
    /// [`Error::Integration`] where steps become too small: a pole, a value that is not finite, or a stiff problem.
    pub fn step<S: CotangentSystem>(
        &self,
        system: &S,
        state: &mut State<S::Group>,
        next: &mut f64,
        end: f64,
    ) -> Result<(), Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        loop {
            let left = end - state.time;
            let last = *next >= left.abs();
            let h = if last { left } else { next.copysign(left) };
            let is_lost = state.time + h == state.time;
            let is_rounding = !last && h.abs() < LEAST * state.time.abs();
            if !h.is_finite() || is_lost || is_rounding {
                let reason = "the steps become too small".into();
                return Err(Error::Integration { t: state.time, reason });
            }
            let advanced = match self.pair {
                Pair::Five => RungeKutta::<_, _, C>::DORMAND_PRINCE.advanced(system, state, h),
                Pair::Eight => RungeKutta::<_, _, C>::DORMAND_PRINCE_8.advanced(system, state, h),
            };
            let (reached, error) = match advanced {
                Ok((reached, error)) if error.is_finite() => (reached, error / self.tolerance),
                // a shorter step may still be possible
                _ => {
                    *next = 0.2 * h.abs();
                    continue;
                }
            };
            if !last || error > 1.0 {
                *next = h.abs() * (0.9 * error.powf(-self.exponent())).clamp(0.2, 5.0);
            }
            if error <= 1.0 {
                *state = State { time: if last { end } else { reached.time }, ..reached };
                return Ok(());
            }
        }
    }

    /// The states at the given times, in their order; each ends a step.
    ///
    /// # Errors
    /// [`Error::Integration`] with the time that was reached.
    pub fn states<S: CotangentSystem>(
        &self,
        system: &S,
        start: &State<S::Group>,
        times: &[f64],
    ) -> Result<Vec<State<S::Group>>, Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        let mut state = start.clone();
        let mut next = self.first_step();
        let mut states = Vec::with_capacity(times.len());
        for &end in times {
            let mut steps = 0;
            while state.time != end {
                if steps == self.max_steps {
                    let reason = "too many steps".into();
                    return Err(Error::Integration { t: state.time, reason });
                }
                steps += 1;
                self.step(system, &mut state, &mut next, end)?;
            }
            states.push(state.clone());
        }
        Ok(states)
    }
}
