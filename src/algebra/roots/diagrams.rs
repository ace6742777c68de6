//! Cartan matrices: their types, and the numberings of their nodes.

use super::{CartanType, Series};

/// The simple factors of a Cartan matrix, each with its nodes in the numbering of Bourbaki, in the
/// order of the first node. The entries are `a_ij = <α_i, α_j^∨>`. Returns `None` if the matrix is not
/// a Cartan matrix of finite type.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series, identify};
/// let b2 = CartanType::new(Series::B, 2)?;
/// assert_eq!(identify(&[vec![2, -1], vec![-2, 2]]), Some(vec![(b2, vec![1, 0])]));
/// assert_eq!(identify(&[vec![2, -2], vec![-2, 2]]), None);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn identify(cartan: &[Vec<i64>]) -> Option<Vec<(CartanType, Vec<usize>)>> {
    let mut open: Vec<usize> = (0..cartan.len()).collect();
    let mut factors = vec![];
    while let Some(&first) = open.first() {
        let mut component = vec![first];
        let mut at = 0;
        while let Some(&node) = component.get(at) {
            let joined = |j: &usize| *j != node && cartan[node][*j] != 0 && !component.contains(j);
            let next: Vec<usize> = (0..cartan.len()).filter(joined).collect();
            component.extend(next);
            at += 1;
        }
        open.retain(|node| !component.contains(node));
        component.sort_unstable();
        let series = [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G]
            .into_iter();
        let mut types = series.filter_map(|series| CartanType::new(series, component.len()).ok());
        factors.push(types.find_map(|factor| {
            Some((factor, numbering(cartan, &factor.cartan_matrix(), &component)?))
        })?);
    }
    Some(factors)
}

/// The nodes in an order in which their Cartan matrix is the wanted one. A search that rejects a
/// partial order at its first wrong entry.
pub(crate) fn numbering(
    cartan: &[Vec<i64>],
    wanted: &[Vec<i64>],
    nodes: &[usize],
) -> Option<Vec<usize>> {
    let mut found = None;
    search(cartan, wanted, nodes, &mut vec![], &mut |order| {
        found = Some(order.to_vec());
        true
    });
    found
}

/// The automorphisms of a Dynkin diagram, the identity first.
pub(crate) fn automorphisms(cartan_type: CartanType) -> Vec<Vec<usize>> {
    let cartan = cartan_type.cartan_matrix();
    let nodes: Vec<usize> = (0..cartan.len()).collect();
    let mut found = vec![];
    search(&cartan, &cartan, &nodes, &mut vec![], &mut |order| {
        found.push(order.to_vec());
        false
    });
    found
}

/// Completes a partial order in all ways, until `accept` returns true.
fn search(
    cartan: &[Vec<i64>],
    wanted: &[Vec<i64>],
    nodes: &[usize],
    order: &mut Vec<usize>,
    accept: &mut dyn FnMut(&[usize]) -> bool,
) -> bool {
    let at = order.len();
    if at == wanted.len() {
        return accept(order);
    }
    for &node in nodes {
        let fits = !order.contains(&node)
            && order.iter().enumerate().all(|(i, &other)| {
                cartan[node][other] == wanted[at][i] && cartan[other][node] == wanted[i][at]
            });
        if fits {
            order.push(node);
            if search(cartan, wanted, nodes, order, accept) {
                return true;
            }
            order.pop();
        }
    }
    false
}
