//! The order conditions of the Runge-Kutta tableaux, for every rooted tree.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::dynamics::MuntheKaas;

/// A rooted tree: those above its root, in descending order.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
struct Tree(Vec<Tree>);

impl Tree {
    fn order(&self) -> u32 {
        1 + self.0.iter().map(Tree::order).sum::<u32>()
    }

    /// The density: the order times the densities above.
    fn density(&self) -> f64 {
        f64::from(self.order()) * self.0.iter().map(Tree::density).product::<f64>()
    }

    /// The elementary weight of each stage.
    fn stages<const S: usize>(&self, a: &[[f64; S]; S]) -> [f64; S] {
        let mut product = [1.0; S];
        for tree in &self.0 {
            let above = tree.stages(a);
            for (i, product) in product.iter_mut().enumerate() {
                *product *= (0..S).map(|j| a[i][j] * above[j]).sum::<f64>();
            }
        }
        product
    }
}

/// All of an order: forests whose trees descend from a bound.
fn trees(order: u32) -> Vec<Tree> {
    fn forests(nodes: u32, below: Option<&Tree>) -> Vec<Vec<Tree>> {
        if nodes == 0 {
            return vec![vec![]];
        }
        let mut all = vec![];
        for first in (1..=nodes).flat_map(trees) {
            if below.is_none_or(|bound| first <= *bound) {
                for mut rest in forests(nodes - first.order(), Some(&first)) {
                    rest.insert(0, first.clone());
                    all.push(rest);
                }
            }
        }
        all
    }
    forests(order - 1, None).into_iter().map(Tree).collect()
}

/// The numbers of rooted trees, OEIS A000081.
#[test]
fn trees_are_all() {
    let counts: Vec<usize> = (1..=9).map(|order| trees(order).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115, 286]);
}

/// `sum_i b_i phi_i(t) = 1/gamma(t)` up to the order and not beyond it, `c` the sums of rows, and differences of weights
/// that vanish up to the orders of the embedded methods and not beyond.
fn check<const S: usize>(method: &MuntheKaas<S>, embedded: [u32; 2]) {
    let (a, order) = (method.rows(), method.order());
    for (row, c) in a.iter().zip(method.nodes()) {
        let size = row.iter().map(|a| a.abs()).sum::<f64>();
        assert!((row.iter().sum::<f64>() - c).abs() <= 1e-15 * (1.0 + size), "{c}");
    }
    let off = |weights: &[f64; S], tree: &Tree, value: f64| {
        let stages = tree.stages(a);
        (stages.iter().zip(weights).map(|(x, b)| x * b).sum::<f64>() - value).abs()
    };
    let largest = |n: u32, off: &dyn Fn(&Tree) -> f64| trees(n).iter().map(off).fold(0.0, f64::max);
    for n in 1..=order + 1 {
        let off = largest(n, &|tree| off(method.weights(), tree, 1.0 / tree.density()));
        assert!(if n > order { off > 1e-8 } else { off < 1e-14 }, "order {n}: {off}");
    }
    for (weights, order) in method.errors().iter().zip(embedded) {
        for n in 1..=order + u32::from(order > 0) {
            let off = largest(n, &|tree| off(weights, tree, 0.0));
            assert!(if n > order { off > 1e-8 } else { off < 1e-14 }, "embedded, {n}: {off}");
        }
    }
}

#[test]
fn conditions_hold() {
    check(&MuntheKaas::RK4, [0, 0]);
    check(&MuntheKaas::DORMAND_PRINCE, [4, 0]);
    check(&MuntheKaas::DORMAND_PRINCE_8, [5, 3]);
}
