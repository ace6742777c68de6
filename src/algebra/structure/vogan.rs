//! Vogan diagrams of the real forms of simple complex algebras.
//!
//! A maximally compact Cartan subalgebra that the Cartan involution `theta` preserves has no real
//! roots, so that a system of simple roots exists that `theta` permutes. The diagram shows this
//! permutation, and which fixed simple roots are noncompact (A. W. Knapp, *Lie Groups Beyond an
//! Introduction*, 2nd ed., VI.8).

use crate::algebra::roots::{CartanType, Series};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

/// A Vogan diagram with at most one painted node. Nodes are numbered from 1 as in Bourbaki.
///
/// Of the diagrams of a real form, the painted node is chosen as in Knapp, theorem 6.96. Let
/// `w_1, w_2, ...` be the basis dual to the simple roots. If `theta` fixes all nodes and the node
/// `i` is painted, no `j` has `<w_i - w_j, w_j> > 0`. If several nodes remain, the first one is painted, but for `so*(2n)`
/// the last one.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
/// use affinor::algebra::structure::RealForm;
/// let form = RealForm::named(CartanType::new(Series::E, 6)?, "e6(6)").expect("a real form");
/// assert_eq!(form.vogan.painted(), Some(2));
/// assert_eq!(form.vogan.arrows(), [(1, 6), (3, 5)]);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VoganDiagram {
    /// The permutation of the nodes, counted from 0.
    pub(super) images: Vec<usize>,
    /// The painted node, counted from 0.
    pub(super) node: Option<usize>,
}

impl VoganDiagram {
    /// The painted node: the only noncompact imaginary simple root. `None` if all imaginary simple
    /// roots are compact.
    pub fn painted(&self) -> Option<usize> {
        self.node.map(|node| node + 1)
    }

    /// The pairs of complex simple roots that `theta` exchanges.
    pub fn arrows(&self) -> Vec<(usize, usize)> {
        let pairs = self.images.iter().enumerate().filter(|(i, image)| i < image);
        pairs.map(|(i, image)| (i + 1, image + 1)).collect()
    }

    /// The diagrams of a type: for each real form at least one, the compact form first, then those
    /// without and with arrows. The matrix `gram` has the inner products of the simple roots.
    pub(super) fn all(cartan_type: CartanType, gram: &[Vec<i64>]) -> Vec<Self> {
        let rank = cartan_type.rank();
        let identity: Vec<usize> = (0..rank).collect();
        let mut other = identity.clone();
        match (cartan_type.series(), rank) {
            (Series::A, 2..) => other.reverse(),
            (Series::D, _) => other.swap(rank - 2, rank - 1),
            (Series::E, 6) => other = vec![5, 1, 4, 3, 2, 0],
            _ => {}
        }
        let mut nodes = inner_nodes(gram);
        if cartan_type.series() == Series::D && rank > 4 {
            // the last two nodes are exchanged by an automorphism of the diagram
            nodes.retain(|node| *node != rank - 2);
        }
        let diagram = |images: &[usize], node| VoganDiagram { images: images.to_vec(), node };
        let mut diagrams = vec![diagram(&identity, None)];
        diagrams.extend(nodes.into_iter().map(|node| diagram(&identity, Some(node))));
        if other != identity {
            diagrams.push(diagram(&other, None));
            let fixed = (0..rank).filter(|&i| other[i] == i);
            diagrams.extend(fixed.map(|node| diagram(&other, Some(node))));
        }
        diagrams
    }
}

/// The nodes `i` for which no `j` has `<w_i - w_j, w_j> > 0`. The inner products of the dual basis
/// `w` are the inverse of the matrix of the inner products of the simple roots.
fn inner_nodes(gram: &[Vec<i64>]) -> Vec<usize> {
    let row = |row: &Vec<i64>| row.iter().map(|x| Rational::from(*x)).collect::<Vec<_>>();
    let rows: Vec<Vec<Rational>> = gram.iter().map(row).collect();
    let all = 0..gram.len();
    let Some(products) = Matrix::from_dense(&rows).ok().and_then(|matrix| matrix.inverse()) else {
        // not reached, because the form is positive definite
        return all.collect();
    };
    let excludes = |i: usize, j: usize| products.get(i, j) > products.get(j, j);
    all.clone().filter(|&i| all.clone().all(|j| !excludes(i, j))).collect()
}
