//! Runge-Kutta methods in embedding coordinates.

use super::runge_kutta::{LocalCoordinates, RungeKutta};
use crate::Error;
use crate::group::{Coordinates, Embedded, TranslationSplit};

/// Runge-Kutta methods in embedding coordinates, such as the four components of a quaternion. Each
/// step ends with a projection onto the group.
///
/// This is the standard projection method of E. Hairer, C. Lubich and G. Wanner, *Geometric
/// Numerical Integration* (2006), IV.4. A stage needs neither exponentials nor tangent operators,
/// so a step is faster than a step of [`MuntheKaas`](super::MuntheKaas) of the same order. Elements
/// of stages may be slightly off the group; forces are evaluated at their projections. A group
/// without [a projection](Embedded::has_projection), such as a group of matrices, causes an error.
/// A free system conserves the spatial momentum: exactly on groups of rotations, and up to rounding
/// errors on other groups.
///
/// ```
/// use affinor::mechanics::{EulerPoincare, Integrator, Projected};
/// use affinor::group::{LieGroup, Se3};
/// use affinor::{CanonicalConnection, Connection, Metric};
/// use affinor::tensors::{Down, Tensor};
/// use nalgebra::Vector6;
/// let se3 = Se3.algebra()?;
/// let masses = (0..6).map(|i| ([i, i], 1.0 + i as f64));
/// let masses = Metric::new(se3.labels(), Tensor::from_components(6, &[Down, Down], masses)?)?;
/// let body = EulerPoincare::free(Se3, &Connection::canonical(&se3, CanonicalConnection::Plus), &masses)?;
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

/// Embedding coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Projection;

/// Data of a stage, computed once from the embedding coordinates of the stage.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedPoint<E> {
    /// The point with these coordinates. It may be slightly off the group.
    near: E,
    /// The projection of the point onto the group.
    projected: E,
    /// The rotation from the base point to the projection.
    turn: E,
}

impl<G: Embedded + TranslationSplit> LocalCoordinates<G> for Projection {
    type Numbers = G::Ambient;
    type Point = EmbeddedPoint<G::Element>;

    const HAS_ELEMENT: bool = true;

    #[inline(always)]
    fn exist(group: &G) -> bool {
        group.has_projection()
    }

    #[inline(always)]
    fn origin(group: &G, at: &G::Element) -> G::Ambient {
        group.coordinates(at)
    }

    #[inline(always)]
    fn point(group: &G, at: &G::Element, y: &G::Ambient) -> Self::Point {
        let near = group.from_coordinates(y);
        let projected = group.project(near.clone());
        let turn = group.relative_linear_part(at, &projected);
        EmbeddedPoint { near, projected, turn }
    }

    #[inline(always)]
    fn element(_: &G, _: &G::Element, point: &Self::Point) -> G::Element {
        point.projected.clone()
    }

    #[inline(always)]
    fn end(group: &G, _: &G::Element, y: &G::Ambient) -> G::Element {
        group.project(group.from_coordinates(y))
    }

    #[inline(always)]
    fn carried(group: &G, point: &Self::Point, momentum: &G::Vector) -> G::Vector {
        group.coadjoint(&point.turn, momentum)
    }

    #[inline(always)]
    fn carried_back(group: &G, point: &Self::Point, force: &G::Vector) -> G::Vector {
        group.coadjoint_inverse(&point.turn, force)
    }

    fn sizes(group: &G, y: &G::Ambient) -> [f64; 2] {
        let mut sizes = [0.0_f64; 2];
        for (at, x) in y.components().iter().enumerate() {
            let size = &mut sizes[usize::from(group.is_translation_coordinate(at))];
            *size = if x.abs() > *size { x.abs() } else { *size };
        }
        sizes
    }

    #[inline(always)]
    fn first_rate(group: &G, at: &G::Element, velocity: &G::Vector) -> G::Ambient {
        group.rate(at, velocity)
    }

    #[inline(always)]
    fn rate(
        group: &G,
        point: &Self::Point,
        velocity: &G::Vector,
        _: u32,
    ) -> Result<G::Ambient, Error> {
        Ok(group.rate_at_projected(&point.near, &point.projected, velocity))
    }
}
