//! Steps as long as a tolerance allows.

use super::munthe_kaas::Canonical;
use super::projected::Projection;
use super::runge_kutta::{LocalCoordinates, RungeKutta};
use super::tableaux::{DormandPrince, DormandPrince8, Tabulated};
use super::tolerance::Allowed;
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

/// A pair of Dormand and Prince with step-size control.
///
/// A step is kept if its estimated error is allowed. Turns and [translations](crate::group::LieGroup::translation) are judged
/// apart, each by its own scale. With the tolerance `r`, an error may be
///
/// | of | absolute part | relative part |
/// |---|---|---|
/// | turns (radians for rotations) | `a_1`, by default `r` | `r/10` of the turn in the step |
/// | translations | `a_2`, by default `r` times the radius of gyration | `r/10` of the path in the step |
/// | momentum of turns | the momentum that turns the body by `a_1` in the time `span` | `r` of the larger one at both ends |
/// | momentum of translations | the momentum that moves it by `a_2` in the time `span` | `r` of the larger one at both ends |
///
/// The radius of gyration is the square root of the largest moment of inertia over the largest mass, 1 where one of them is
/// missing. A system without an inertia has its momentum judged as a whole, relative to its largest component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive<C = Canonical> {
    /// The pair.
    pub pair: Pair,
    /// The relative tolerance `r` of a step.
    pub tolerance: f64,
    /// The absolute tolerances `a_1` of turns and `a_2` of translations, or `None` for those of the table.
    pub absolute: Option<[f64; 2]>,
    /// The time over which an error of a velocity counts, such as that of the run; infinite for no absolute part of the
    /// tolerance of momenta.
    pub span: f64,
    /// The most steps between two times.
    pub max_steps: usize,
    /// The longest step. A force that is shorter than a step may be missed.
    pub max_step: f64,
    /// The coordinates in which steps are made.
    pub coordinates: C,
}

impl Adaptive {
    /// The pair of order 5 with a tolerance, at most a million steps of any length, and no absolute tolerance of momenta.
    pub fn new(tolerance: f64) -> Self {
        Adaptive {
            pair: Pair::Five,
            tolerance,
            absolute: None,
            span: f64::INFINITY,
            max_steps: 1_000_000,
            max_step: f64::INFINITY,
            coordinates: Canonical,
        }
    }

    /// The same with the pair of order 8.
    pub fn of_order_8(tolerance: f64) -> Self {
        Adaptive { pair: Pair::Eight, ..Self::new(tolerance) }
    }

    /// The same with steps of [`Projected`](super::Projected).
    pub fn projected(self) -> Adaptive<Projection> {
        let Adaptive { pair, tolerance, absolute, span, max_steps, max_step, .. } = self;
        let coordinates = Projection;
        Adaptive { pair, tolerance, absolute, span, max_steps, max_step, coordinates }
    }
}

impl<C: Copy> Adaptive<C> {
    /// A first guess of a step, which the control corrects at once.
    pub fn first_step(&self) -> f64 {
        self.tolerance.powf(self.exponent()).min(0.1).min(self.max_step)
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
        let allowed = Allowed::new(self.tolerance, self.absolute, self.span, system.sizes());
        loop {
            let left = end - state.time;
            *next = next.min(self.max_step);
            let last = *next >= left.abs();
            let h = if last { left } else { next.copysign(left) };
            let is_lost = state.time + h == state.time;
            let is_rounding = !last && h.abs() < LEAST * state.time.abs();
            if !h.is_finite() || is_lost || is_rounding {
                let reason = "the steps become too small".into();
                return Err(Error::Integration { t: state.time, reason });
            }
            let (five, eight) =
                (RungeKutta::<_, _, C>::DORMAND_PRINCE, RungeKutta::<_, _, C>::DORMAND_PRINCE_8);
            let advanced = match self.pair {
                Pair::Five => five.advanced(system, state, h, &allowed),
                Pair::Eight => eight.advanced(system, state, h, &allowed),
            };
            let (reached, error) = match advanced {
                Ok((reached, error)) if error.is_finite() => (reached, error),
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
