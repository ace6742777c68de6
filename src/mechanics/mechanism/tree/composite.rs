//! The mass matrix, by the recursion of composite bodies.

use super::MovingTree;
use crate::group::{LieGroup, Se3};
use nalgebra::{DMatrix, Isometry3, Matrix3, Matrix6};

/// The symmetric map `Ad*_(X^-1) I Ad_(X^-1)`: an inertia `I` in the frame with the pose `X = (R,
/// p)`, seen from the frame before it. With the blocks `A`, `B`, `D` of `I`, turned by `R`,
///
/// ```text
/// D' = D,   B' = B + spin(p) D,   A' = A - B spin(p) + spin(p) B'^T
/// ```
pub(super) fn carried(inertia: &Matrix6<f64>, pose: &Isometry3<f64>) -> Matrix6<f64> {
    let turn = pose.rotation.to_rotation_matrix().into_inner();
    let (back, shift) = (turn.transpose(), pose.translation.vector.cross_matrix());
    let block = |i: usize, j: usize| turn * inertia.fixed_view::<3, 3>(i, j) * back;
    let (a, b, d): (Matrix3<f64>, Matrix3<f64>, Matrix3<f64>) =
        (block(0, 0), block(0, 3), block(3, 3));
    let mixed = b + shift * d;
    let turning = a - b * shift + shift * mixed.transpose();
    let mut sum = Matrix6::zeros();
    sum.fixed_view_mut::<3, 3>(0, 0).copy_from(&turning);
    sum.fixed_view_mut::<3, 3>(0, 3).copy_from(&mixed);
    sum.fixed_view_mut::<3, 3>(3, 0).copy_from(&mixed.transpose());
    sum.fixed_view_mut::<3, 3>(3, 3).copy_from(&d);
    sum
}

impl MovingTree {
    /// The mass matrix `M` of the kinetic energy `v . M v/2`, at the configuration of
    /// [`place`](Self::place). The row and the column are indices of rates. Its cost is the number
    /// of rates times the depth of the tree.
    pub fn mass_matrix(&mut self) -> DMatrix<f64> {
        let freedom = self.tree.freedom();
        let mut matrix = DMatrix::zeros(freedom, freedom);
        self.mass_entries(|k, l, entry| {
            matrix[(k, l)] = entry;
            matrix[(l, k)] = entry;
        });
        matrix
    }

    /// Calls `add(k, l, entry)` for the entries of the mass matrix that do not vanish. For each rate
    /// `k`, `l` is first `k` itself, then each rate on the way to the ground.
    pub(super) fn mass_entries(&mut self, mut add: impl FnMut(usize, usize, f64)) {
        let tree = self.tree.clone();
        for (node, own) in tree.nodes.iter().zip(&mut self.nodes) {
            own.inertia = node.inertia;
        }
        for (at, node) in tree.nodes.iter().enumerate().rev() {
            let composite = self.nodes[at].inertia;
            for k in node.rates.clone() {
                let mut momentum = composite * tree.twists[k];
                let (mut on_way, mut rates) = (at, node.rates.start..k + 1);
                loop {
                    rates.rev().for_each(|l| add(k, l, tree.twists[l].dot(&momentum)));
                    let Some(parent) = tree.nodes[on_way].parent else { break };
                    momentum = Se3.coadjoint(&self.nodes[on_way].back, &momentum);
                    (on_way, rates) = (parent, tree.nodes[parent].rates.clone());
                }
            }
            if let Some(parent) = node.parent {
                let inertia = carried(&composite, &self.nodes[at].pose);
                self.nodes[parent].inertia += inertia;
            }
        }
    }
}
