//! Groups as configuration spaces of motions, and the dispatch to the type of a group.

use crate::Error;
use crate::group::{
    AnyGroup, Coordinates, MatrixGroup, MatrixNotation, Nilpotent, Opposite, Se2, Se3, Sl2, So2,
    So3, TranslationSplit,
};
use crate::mechanics::Inertia;
use nalgebra::{DMatrix, DVector};
use std::fmt::Debug;

/// A group whose elements are the configurations of a motion.
pub trait SimulationGroup:
    MatrixNotation<Element: Send + Sync, Vector: Send + Sync>
    + TranslationSplit
    + Clone
    + Debug
    + Send
    + Sync
    + 'static
{
    /// Whether the group is the [`Opposite`] of another group. In this case, its left-invariant
    /// frame is the right-invariant frame of the other group.
    fn is_right(&self) -> bool {
        false
    }

    /// The inertia of a body with a metric. Returns `None` unless the group is the group of
    /// rotations.
    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        let _ = inertia;
        None
    }
}

impl SimulationGroup for So2 {}
impl SimulationGroup for Se2 {}
impl SimulationGroup for Se3 {}
impl SimulationGroup for Sl2 {}
impl SimulationGroup for MatrixGroup {}
impl SimulationGroup for Nilpotent<f64> {}

impl SimulationGroup for AnyGroup {
    fn is_right(&self) -> bool {
        self.downcast_ref::<Opposite<AnyGroup>>().is_some()
    }
}

impl<G: SimulationGroup> SimulationGroup for Opposite<G> {
    fn is_right(&self) -> bool {
        true
    }
}

impl SimulationGroup for So3 {
    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        Some(Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned()))
    }
}

/// A problem that is generic over the type of the group.
pub(super) trait GroupVisitor {
    /// The type of the solution.
    type Output;

    /// Solves the problem.
    fn visit<G: SimulationGroup>(self, group: &G) -> Self::Output;
}

/// Solves a problem on a group that is chosen at run time. For common groups in closed form, the
/// visitor is called with the static type of the group, so that steps allocate no memory.
pub(super) fn visit<V: GroupVisitor>(group: &AnyGroup, visitor: V) -> V::Output {
    if let Some(group) = group.downcast_ref::<So3>() {
        return visitor.visit(group);
    }
    // leaves out these types in a browser, where the size of the program is more important than its
    // speed
    #[cfg(not(target_family = "wasm"))]
    {
        if let Some(group) = group.downcast_ref::<So2>() {
            return visitor.visit(group);
        }
        if let Some(group) = group.downcast_ref::<Se2>() {
            return visitor.visit(group);
        }
        if let Some(group) = group.downcast_ref::<Se3>() {
            return visitor.visit(group);
        }
        if let Some(group) = group.downcast_ref::<Sl2>() {
            return visitor.visit(group);
        }
        // solves right-invariant systems on the opposite group
        if let Some(group) = group.downcast_ref::<Opposite<AnyGroup>>() {
            return visitor.visit(group);
        }
    }
    visitor.visit(group)
}

/// The element with these embedding coordinates.
pub(super) fn element<G: SimulationGroup>(group: &G, coordinates: &DVector<f64>) -> G::Element {
    group.from_coordinates(&G::Ambient::from_components(coordinates.as_slice()))
}

/// The vector with these components.
pub(super) fn vector<V: Coordinates>(components: &DVector<f64>) -> V {
    V::from_components(components.as_slice())
}
