//! The order conditions of the Runge-Kutta tableaux, for every rooted tree, and order 8 on groups.

use affinor::group::{Coordinates, Embedded, Se3, Sl2, So3, TranslationSplit};
use affinor::mechanics::integrators::RungeKutta;
use affinor::mechanics::integrators::runge_kutta::LocalCoordinates;
use affinor::mechanics::{Adaptive, EulerPoincare, Integrator, MuntheKaas, Projected, State};
use affinor::numerics::tableaux::{Classical, DormandPrince, DormandPrince8, Tableau, Tabulated};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_tensors::{Down, Tensor};

/// A rooted tree: the subtrees at its root, in descending order.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
struct Tree(Vec<Tree>);

impl Tree {
    fn order(&self) -> u32 {
        1 + self.0.iter().map(Tree::order).sum::<u32>()
    }

    /// The density: the order times the densities of the subtrees.
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

/// All forests of an order whose trees are at most a bound, in descending order.
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

/// Checks `sum_i b_i phi_i(t) = 1/gamma(t)` up to the order and not beyond it, and that `c`
/// contains the row sums. Differences of the weights vanish up to the orders of the embedded
/// methods and not beyond.
fn check<const S: usize, T: Tabulated<S>>(_: T, embedded: [u32; 2]) {
    let Tableau { a, b, c, errors, order, .. } = &T::TABLEAU;
    let order = *order;
    for (row, c) in a.iter().zip(c) {
        let size = row.iter().map(|a| a.abs()).sum::<f64>();
        assert!((row.iter().sum::<f64>() - c).abs() <= 1e-15 * (1.0 + size), "{c}");
    }
    let off = |weights: &[f64; S], tree: &Tree, value: f64| {
        let stages = tree.stages(a);
        (stages.iter().zip(weights).map(|(x, b)| x * b).sum::<f64>() - value).abs()
    };
    let largest = |n: u32, off: &dyn Fn(&Tree) -> f64| trees(n).iter().map(off).fold(0.0, f64::max);
    for n in 1..=order + 1 {
        let off = largest(n, &|tree| off(b, tree, 1.0 / tree.density()));
        assert!(if n > order { off > 1e-8 } else { off < 1e-14 }, "order {n}: {off}");
    }
    for (weights, order) in errors.iter().zip(embedded) {
        for n in 1..=order + u32::from(order > 0) {
            let off = largest(n, &|tree| off(weights, tree, 0.0));
            assert!(if n > order { off > 1e-8 } else { off < 1e-14 }, "embedded, {n}: {off}");
        }
    }
}

#[test]
fn conditions_hold() {
    check(Classical, [0, 0]);
    check(DormandPrince, [4, 0]);
    check(DormandPrince8, [5, 3]);
}

/// The metric is not diagonal, the connection does not preserve the spatial momentum, and the
/// torque depends on time and velocity. A step of half the length has 2^-8 of the error; with step
/// control the embedded method of order 5 is used.
fn order_on<G: Embedded + TranslationSplit + Clone, C: LocalCoordinates<G>>(
    group: G,
    method: RungeKutta<12, DormandPrince8, C>,
    steps: usize,
) {
    let n = group.dimension();
    let algebra = group.algebra().unwrap();
    let entry = |[i, j]: [usize; 2]| if i == j { 1.0 + 0.5 * i as f64 } else { 0.1 };
    let metric = Tensor::from_fn(n, [Down, Down], entry).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let torque = move |time: f64, _: &G::Element, omega: &G::Vector| {
        G::Vector::from_fn(n, |i| 0.3 * (2.0 * time + i as f64).sin() - 0.2 * omega.components()[i])
    };
    let zero = Connection::canonical(&algebra, CanonicalConnection::Zero);
    let system = EulerPoincare::new(group.clone(), &zero, &metric, torque).unwrap();
    let velocity = G::Vector::from_fn(n, |i| [0.9, -0.5, 1.1][i % 3]);
    let start = system.state(0.3, group.exp(&(velocity.clone() * 0.2)), &velocity);
    let run = |count: usize| {
        let mut state = start.clone();
        for _ in 0..count {
            let h = 2.0 / count as f64;
            method.step(&system, &mut state, h).unwrap();
        }
        state
    };
    let distance = |a: &State<G>, b: &State<G>| {
        let between = group.compose(&group.inverse(&a.element), &b.element);
        let spatial = a.spatial.clone() - b.spatial.clone();
        group.log(&between).unwrap().largest().max(spatial.largest())
    };
    let exact = run(200);
    let (long, short) = (distance(&run(steps), &exact), distance(&run(2 * steps), &exact));
    let observed = (long / short).log2();
    assert!((7.4..9.0).contains(&observed), "{observed}: {long:e}, {short:e}");
    for control in [Adaptive::new(1e-12), Adaptive::of_order_8(1e-12)] {
        let ends = [
            control.states(&system, &start, &[2.3]).unwrap().remove(0),
            control.projected().states(&system, &start, &[2.3]).unwrap().remove(0),
        ];
        for end in ends {
            assert!(distance(&end, &exact) < 1e-10, "{control:?}: {:e}", distance(&end, &exact));
        }
    }
}

#[test]
fn order_8_on_groups() {
    order_on(So3, MuntheKaas::DORMAND_PRINCE_8, 4);
    order_on(Se3, MuntheKaas::DORMAND_PRINCE_8, 4);
    order_on(Sl2, MuntheKaas::DORMAND_PRINCE_8, 4);
    order_on(So3, Projected::DORMAND_PRINCE_8, 4);
    order_on(Se3, Projected::DORMAND_PRINCE_8, 4);
    order_on(Sl2, Projected::DORMAND_PRINCE_8, 4);
}
