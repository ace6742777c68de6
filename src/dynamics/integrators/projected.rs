//! Runge-Kutta methods in the numbers of which elements consist.

use super::runge_kutta::{LocalCoordinates, RungeKutta};
use crate::Error;
use crate::group::{Coordinates, Stored};

/// Runge-Kutta in the numbers that are stored of an element, such as the four of a quaternion; each step ends with the
/// element of the group that is meant.
///
/// The standard projection method: E. Hairer, C. Lubich and G. Wanner, *Geometric Numerical Integration* (2006), IV.4.
/// A stage needs neither exponentials nor tangent operators, so a step is cheaper than that of
/// [`MuntheKaas`](super::MuntheKaas), of the same order and on the group as well. The numbers of a stage lie
/// off the group; forces are given the element that is meant.
/// The spatial momentum of a free system stays what it is, to the last bit on rotations and to rounding on other groups.
///
/// ```
/// use affinor::dynamics::{EulerPoincare, Integrator, Projected};
/// use affinor::group::{LieGroup, Se3};
/// use affinor::{Canonical, Connection, Metric};
/// use affinor_tensors::{Down, Tensor};
/// use nalgebra::Vector6;
/// let se3 = Se3.algebra()?;
/// let masses = (0..6).map(|i| ([i, i], 1.0 + i as f64));
/// let masses = Metric::new(se3.labels(), Tensor::from_components(6, &[Down, Down], masses)?)?;
/// let body = EulerPoincare::free(Se3, &Connection::canonical(&se3, Canonical::Plus), &masses)?;
/// let mut state = body.state(0.0, Se3.identity(), &Vector6::new(0.3, 1.0, 0.1, 0.2, 0.0, 0.5));
/// let energy = body.energy(&state);
/// for _ in 0..100 {
///     Projected::DORMAND_PRINCE_8.step(&body, &mut state, 0.1)?;
/// }
/// assert!((body.energy(&state) - energy).abs() < 1e-9);
/// assert!((state.element.rotation.norm() - 1.0).abs() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
pub type Projected<const STAGES: usize, T> = RungeKutta<STAGES, T, Projection>;

/// The stored numbers as coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Projection;

/// How far the element that is meant by numbers has turned from another.
#[inline(always)]
fn turned<G: Stored>(group: &G, from: &G::Element, y: &G::Numbers) -> G::Element {
    let to = group.turn(&group.restored(group.from_numbers(y)));
    group.compose(&group.inverse(&group.turn(from)), &to)
}

impl<G: Stored> LocalCoordinates<G> for Projection {
    type Numbers = G::Numbers;

    #[inline(always)]
    fn origin(group: &G, at: &G::Element) -> G::Numbers {
        group.numbers(at)
    }

    #[inline(always)]
    fn element(group: &G, _: &G::Element, y: &G::Numbers) -> G::Element {
        group.restored(group.from_numbers(y))
    }

    #[inline(always)]
    fn end(group: &G, _: &G::Element, y: &G::Numbers) -> G::Element {
        group.restored(group.from_numbers(y))
    }

    #[inline(always)]
    fn carried(group: &G, at: &G::Element, y: &G::Numbers, momentum: &G::Vector) -> G::Vector {
        group.coadjoint(&turned(group, at, y), momentum)
    }

    #[inline(always)]
    fn carried_back(group: &G, at: &G::Element, y: &G::Numbers, force: &G::Vector) -> G::Vector {
        group.coadjoint(&group.inverse(&turned(group, at, y)), force)
    }

    fn sizes(group: &G, y: &G::Numbers) -> [f64; 2] {
        let numbers = y.components();
        let (turns, places) = numbers.split_at(numbers.len() - group.places());
        [turns, places].map(|part| part.iter().fold(0.0, |most: f64, x| x.abs().max(most)))
    }

    #[inline(always)]
    fn first_rate(group: &G, at: &G::Element, velocity: &G::Vector) -> G::Numbers {
        group.rate(at, velocity)
    }

    #[inline(always)]
    fn rate(
        group: &G,
        _: &G::Element,
        y: &G::Numbers,
        velocity: &G::Vector,
        _: u32,
    ) -> Result<G::Numbers, Error> {
        Ok(group.rate(&group.from_numbers(y), velocity))
    }
}
