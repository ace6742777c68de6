//! Tensors from the curvature: trace-free Ricci, Einstein, Schouten, Weyl, Cotton, Kretschmann, the
//! parts of Ricci, and the derivatives of torsion and curvature.

use crate::common::algebras::{by_table, catalogued};
use crate::common::charts::{Moved, affine, constant, heisenberg, special_linear};
use crate::common::{fraction, integer, property::properties, spaces, stored};
use affinor::{Connection, Error, Frame, Metric};
use affinor_tensors::{Down, Field, Rational, Scalar, Symbolic, Tensor, Up, contract};
use proptest::prelude::*;

/// The full square `T_ijkl T^ijkl` of a tensor with the slots `^i_jkl`.
fn square(tensor: &Tensor<Rational>, metric: &Metric<Rational>) -> Rational {
    let raise = |tensor: Tensor<Rational>, slot| tensor.raise(slot, metric.inverse()).unwrap();
    let raised = (1..4).fold(tensor.clone(), raise);
    let lowered = tensor.lower(0, metric.components()).unwrap();
    stored(&lowered).into_iter().fold(integer(0), |sum, (at, v)| sum + &(v * &raised.get(&at)))
}

properties! {
    #![cases(32)]

    /// The Weyl tensor is trace-free, has the symmetries of a curvature tensor, and vanishes in
    /// dimension 3.
    #[test]
    fn weyl(space in spaces(5)) {
        let weyl = space.levi_civita().weyl(&space.metric)?;
        prop_assert_eq!(weyl.slots(), [Up, Down, Down, Down]);
        for slot in 1..4 {
            prop_assert!(weyl.trace(0, slot)?.is_empty());
        }
        let lowered = weyl.lower(0, space.metric.components())?;
        for (at, value) in stored(&lowered) {
            let [i, j, k, l] = [at[0], at[1], at[2], at[3]];
            prop_assert_eq!(lowered.get(&[k, l, i, j]), value.clone());
            prop_assert_eq!(lowered.get(&[j, i, k, l]), -value);
        }
        let cyclic = contract("W^i_jkl + W^i_klj + W^i_ljk -> ^i_jkl", &[("W", &weyl)])?;
        prop_assert!(cyclic.is_empty());
        prop_assert!(space.dimension() > 3 || weyl.is_empty());
    }

    /// The contracted second Bianchi identity, in its three forms.
    #[test]
    fn divergences(space in spaces(5)) {
        let (connection, n) = (space.levi_civita(), space.dimension() as i64);
        let einstein = connection.einstein(&space.metric)?.raise(0, space.metric.inverse())?;
        prop_assert!(connection.nabla(&einstein)?.trace(0, 1)?.is_empty());
        let cotton = connection.cotton(&space.metric)?;
        let divergence = connection.nabla(&connection.weyl(&space.metric)?)?.trace(0, 1)?;
        prop_assert_eq!(divergence, cotton.scale(&integer(n - 3)));
        let nabla_ricci = connection.nabla(&connection.ricci())?;
        let curl = contract("D_kjl - D_ljk -> _jkl", &[("D", &nabla_ricci)])?;
        prop_assert_eq!(connection.nabla_curvature().trace(0, 1)?, curl);
    }

    #[test]
    fn cotton(space in spaces(5)) {
        let cotton = space.levi_civita().cotton(&space.metric)?;
        let cyclic = contract("C_jkl + C_klj + C_ljk -> _jkl", &[("C", &cotton)])?;
        prop_assert!(cyclic.is_empty());
        let trace = contract("h^jk C_jkl -> _l", &[("h", space.metric.inverse()), ("C", &cotton)])?;
        prop_assert!(trace.is_empty());
    }

    /// A. Besse, Einstein manifolds (1987), chapter 1.G: `|R|^2 = |W|^2 + 4/(n-2) |Ric|^2 - 2 S^2 /
    /// ((n-1)(n-2))`; and `tr P = S/(2(n-1))`, `tr G = (1 - n/2) S`.
    #[test]
    fn squares_and_traces(space in spaces(5)) {
        let (connection, metric) = (space.levi_civita(), &space.metric);
        let n = space.dimension() as i64;
        let ricci = connection.ricci();
        let mixed = ricci.raise(0, metric.inverse())?;
        let ricci_squared = contract("r^i_j r^j_i ->", &[("r", &mixed)])?.to_scalar().unwrap();
        let scalar = connection.scalar_curvature(metric)?;
        let weyl_squared = square(&connection.weyl(metric)?, metric);
        let expected = weyl_squared + &(ricci_squared.clone() * &fraction(4, n - 2))
            - &(scalar.clone() * &scalar * &fraction(2, (n - 1) * (n - 2)));
        prop_assert_eq!(connection.kretschmann(metric)?, expected);
        for any in space.connections() {
            let curvature = square(any.curvature(), metric);
            prop_assert_eq!(any.kretschmann(metric)?, curvature);
        }
        let schouten = metric.trace(&connection.schouten(metric)?)?;
        prop_assert_eq!(schouten, scalar.clone() * &fraction(1, 2 * (n - 1)));
        let einstein = metric.trace(&connection.einstein(metric)?)?;
        prop_assert_eq!(einstein, scalar.clone() * &fraction(2 - n, 2));
        // |Ric|^2 is the sum of the squares of its trace-free part and of its trace
        let free = connection.ricci_trace_free(metric)?;
        prop_assert_eq!(metric.trace(&free)?, integer(0));
        let mixed = free.raise(0, metric.inverse())?;
        let square = contract("r^i_j r^j_i ->", &[("r", &mixed)])?.to_scalar().unwrap();
        prop_assert_eq!(ricci_squared, square + &(scalar.clone() * &scalar * &fraction(1, n)));
    }

    /// The sum of the parts is the Ricci tensor. Without torsion the antisymmetric part is half a
    /// trace of the curvature.
    #[test]
    fn parts_of_ricci(space in spaces(5)) {
        for connection in space.connections() {
            let (even, odd) = (connection.ricci_symmetric()?, connection.ricci_antisymmetric()?);
            let sum = contract("a_jl + b_jl -> _jl", &[("a", &even), ("b", &odd)])?;
            prop_assert_eq!(sum, connection.ricci());
            prop_assert_eq!(even.permute(&[1, 0])?, even.clone());
            prop_assert_eq!(odd.permute(&[1, 0])?, odd.scale(&integer(-1)));
            prop_assert_eq!(
                space.metric.trace(&even)?,
                connection.scalar_curvature(&space.metric)?
            );
        }
        prop_assert!(space.levi_civita().ricci_antisymmetric()?.is_empty());
        let symmetric = space.affinities.symmetrise(&[1, 2])?;
        let half = space.algebra.structure_constants().scale(&fraction(1, 2));
        let gamma = contract("s^i_jk + c^i_jk -> ^i_jk", &[("s", &symmetric), ("c", &half)])?;
        let free = Connection::new(space.algebra.left_frame().clone(), gamma)?;
        prop_assert!(free.torsion().is_empty());
        let trace = contract("R^i_ijl -> _jl", &[("R", free.curvature())])?;
        prop_assert_eq!(free.ricci_antisymmetric()?, trace.scale(&fraction(1, 2)));
    }

    /// The formulas hold literally, also if Ricci is not symmetric.
    #[test]
    fn of_any_connection(space in spaces(4)) {
        let (metric, n) = (&space.metric, space.dimension());
        let (g, h) = (metric.components(), metric.inverse());
        for connection in space.connections() {
            let (ricci, r) = (connection.ricci(), connection.curvature());
            let scalar = connection.scalar_curvature(metric)?;
            let less = |share: Rational, j: usize, l: usize| {
                ricci.get(&[j, l]) - &(scalar.clone() * &share * &g.get(&[j, l]))
            };
            let p = |j: usize, l: usize| {
                less(fraction(1, 2 * (n as i64 - 1)), j, l) * &fraction(1, n as i64 - 2)
            };
            let raised = |i: usize, k: usize| {
                (0..n).fold(integer(0), |sum, m| sum + &(h.get(&[i, m]) * &p(m, k)))
            };
            let einstein = connection.einstein(metric)?;
            let free = connection.ricci_trace_free(metric)?;
            let (schouten, weyl) = (connection.schouten(metric)?, connection.weyl(metric)?);
            let (cotton, nabla) = (connection.cotton(metric)?, connection.nabla(&schouten)?);
            let delta = |i: usize, k: usize| integer(i64::from(i == k));
            for [j, l] in (0..n * n).map(|key| [key / n, key % n]) {
                prop_assert_eq!(einstein.get(&[j, l]), less(fraction(1, 2), j, l));
                prop_assert_eq!(free.get(&[j, l]), less(fraction(1, n as i64), j, l));
                prop_assert_eq!(schouten.get(&[j, l]), p(j, l));
                for k in 0..n {
                    let curl = nabla.get(&[k, j, l]) - &nabla.get(&[l, j, k]);
                    prop_assert_eq!(cotton.get(&[j, k, l]), curl);
                    for i in 0..n {
                        let rest = delta(i, k) * &p(j, l) - &(delta(i, l) * &p(j, k))
                            + &(g.get(&[j, l]) * &raised(i, k))
                            - &(g.get(&[j, k]) * &raised(i, l));
                        prop_assert_eq!(weyl.get(&[i, j, k, l]), r.get(&[i, j, k, l]) - &rest);
                    }
                }
            }
        }
    }

    /// Of the lower indices of a derivative the first is the direction. The canonical connections
    /// have parallel torsion and curvature (E. Cartan, J. A. Schouten 1926).
    #[test]
    fn derivatives(space in spaces(4)) {
        let (connection, n) = (space.connection(), space.dimension());
        let l = connection.affinities();
        let torsion = connection.torsion();
        let nabla = connection.nabla_torsion();
        prop_assert_eq!(nabla.slots(), [Up, Down, Down, Down]);
        let of_curvature = connection.nabla_curvature();
        prop_assert_eq!(of_curvature.slots(), [Up, Down, Down, Down, Down]);
        for key in 0..n.pow(4) {
            let [i, m, j, k] = [key / n.pow(3), key / n.pow(2) % n, key / n % n, key % n];
            let sum = (0..n).fold(integer(0), |sum, p| {
                sum + &(l.get(&[i, m, p]) * &torsion.get(&[p, j, k]))
                    - &(l.get(&[p, m, j]) * &torsion.get(&[i, p, k]))
                    - &(l.get(&[p, m, k]) * &torsion.get(&[i, j, p]))
            });
            prop_assert_eq!(nabla.get(&[i, m, j, k]), sum);
        }
        prop_assert!(space.family().nabla_torsion().is_empty());
        prop_assert!(space.family().nabla_curvature().is_empty());
    }
}

fn levi_civita<S: Field + Scalar>(frame: &Frame<S>, g: Tensor<S>) -> (Connection<S>, Metric<S>) {
    let metric = Metric::new(frame.labels(), g).unwrap();
    (Connection::levi_civita(frame, &metric).unwrap(), metric)
}

#[test]
fn dimensions() {
    let plane = by_table(2, &[(1, 2, 2, 1)]);
    let unit = |n| Tensor::from_fn(n, [Down, Down], |[i, j]| integer(i64::from(i == j))).unwrap();
    let (connection, metric) = levi_civita(plane.left_frame(), unit(2));
    for refused in
        [connection.schouten(&metric), connection.weyl(&metric), connection.cotton(&metric)]
    {
        let message = refused.unwrap_err().to_string();
        assert!(message.contains("dimension 3 or more, not dimension 2"), "{message}");
    }
    assert!(connection.einstein(&metric).unwrap().is_empty());
    let other = Metric::new(crate::common::labels(3), unit(3)).unwrap();
    assert!(matches!(connection.einstein(&other), Err(Error::Shape { .. })));
    assert!(matches!(connection.kretschmann(&other), Err(Error::Shape { .. })));
    let line = by_table(1, &[]);
    let (connection, metric) = levi_civita(line.left_frame(), unit(1));
    assert!(connection.schouten(&metric).is_err());
    assert_eq!(connection.kretschmann(&metric).unwrap(), integer(0));
}

/// Tensors in a frame of functions equal the transformed constants of the left-invariant frame.
#[test]
fn moving_frames() {
    let [x, y, v] = ["x", "y", "v"].map(Symbolic::parameter);
    let rows = [[1, 1, 0], [1, -2, 1], [0, 1, 1]];
    let g = Tensor::from_fn(3, [Down, Down], |[i, j]| constant(rows[i][j])).unwrap();
    let (first, second) = (heisenberg(), special_linear());
    let scales = [x.clone() + &constant(1), y.clone() * &x, constant(1)];
    let cases = [
        Moved::scaled(&first, &scales, y),
        Moved::scaled(&second, &[constant(1), v.clone(), constant(2)], v),
    ];
    for moved in cases {
        let (left, left_metric) = levi_civita(moved.chart.algebra.left_frame(), g.clone());
        let (here, metric) = levi_civita(&moved.frame(), moved.tensor(&g));
        assert_eq!(here.schouten(&metric), left.schouten(&left_metric).map(|t| moved.tensor(&t)));
        assert_eq!(here.cotton(&metric), left.cotton(&left_metric).map(|t| moved.tensor(&t)));
        assert_eq!(here.einstein(&metric), left.einstein(&left_metric).map(|t| moved.tensor(&t)));
        assert_eq!(here.kretschmann(&metric), left.kretschmann(&left_metric));
        assert_eq!(here.nabla_curvature(), moved.tensor(&left.nabla_curvature()));
        assert!(here.weyl(&metric).unwrap().is_empty());
        let plus =
            Connection::cartan_schouten(&moved.chart.algebra, &Symbolic::parameter("lambda"));
        let here = Connection::new(moved.frame(), moved.inhomogeneous(plus.affinities())).unwrap();
        assert!(here.nabla_torsion().is_empty());
        assert!(here.nabla_curvature().is_empty());
    }
    // affinities with constant components that are not parallel
    let chart = affine();
    let moved = Moved::scaled(&chart, &[Symbolic::parameter("b"), constant(1)], constant(0));
    let any = Tensor::from_fn(2, [Up, Down, Down], |[i, j, k]| {
        constant((i + 2 * j + 3 * k * k) as i64 - 2)
    });
    let left = Connection::new(chart.algebra.left_frame().clone(), any.unwrap()).unwrap();
    let here = Connection::new(moved.frame(), moved.inhomogeneous(left.affinities())).unwrap();
    assert!(!left.nabla_torsion().is_empty());
    assert_eq!(here.nabla_torsion(), moved.tensor(&left.nabla_torsion()));
    assert_eq!(here.nabla_curvature(), moved.tensor(&left.nabla_curvature()));
    assert_eq!(
        here.ricci_antisymmetric().unwrap(),
        moved.tensor(&left.ricci_antisymmetric().unwrap())
    );
}

fn diagonal(values: &[Symbolic]) -> Tensor<Symbolic> {
    let entry = |[i, j]: [usize; 2]| if i == j { values[i].clone() } else { constant(0) };
    Tensor::from_fn(values.len(), [Down, Down], entry).unwrap()
}

/// K. Schwarzschild 1916, with `u = cos theta`: the metric is a vacuum solution, and `R_ijkl R^ijkl
/// = 48 m^2/r^6`.
#[test]
fn schwarzschild() {
    let [r, u, m] = ["r", "u", "m"].map(Symbolic::parameter);
    let (f, sine) = (constant(1) - &(constant(2) * &m / &r), constant(1) - &(u.clone() * &u));
    let square = r.clone() * &r;
    let g =
        diagonal(&[-f.clone(), f.recip().unwrap(), square.clone() / &sine, square.clone() * &sine]);
    let frame = Frame::coordinates(&["t", "r", "u", "phi"]).unwrap();
    let (connection, metric) = levi_civita(&frame, g);
    assert!(connection.ricci().is_empty());
    assert!(connection.einstein(&metric).unwrap().is_empty());
    assert_eq!(connection.weyl(&metric).unwrap(), *connection.curvature());
    let sixth = square.clone() * &square * &square;
    let expected = constant(48) * &m * &m / &sixth;
    assert_eq!(connection.kretschmann(&metric).unwrap(), expected);
}

/// The Weyl tensor `^i_jkl` does not change if the metric is multiplied by a function. Conformally
/// flat metrics have a zero Weyl tensor, and in dimension 3 a zero Cotton tensor.
#[test]
fn conformal_changes() {
    let names = ["x", "y", "z", "w"];
    let [x, y, z, w] = names.map(Symbolic::parameter);
    let factor = constant(1) + &(x.clone() * &y) + &(z.clone() * &z);
    let flat = vec![factor.clone(); 4];
    let frame = Frame::coordinates(&names).unwrap();
    let (connection, metric) = levi_civita(&frame, diagonal(&flat));
    assert!(!connection.ricci().is_empty());
    assert!(connection.weyl(&metric).unwrap().is_empty());
    assert!(connection.cotton(&metric).unwrap().is_empty());
    let frame3 = Frame::coordinates(&names[..3]).unwrap();
    let (connection, metric) = levi_civita(&frame3, diagonal(&flat[..3]));
    assert!(!connection.schouten(&metric).unwrap().is_empty());
    assert!(connection.cotton(&metric).unwrap().is_empty());
    // dx^2 + x dy^2 + (1 + w^2) dz^2 + dw^2 is not conformally flat
    let curved = [constant(1), x, constant(1) + &(w.clone() * &w), constant(1)];
    let scaled = curved.clone().map(|value| value * &w * &y);
    let weyl = |values: &[Symbolic]| {
        let (connection, metric) = levi_civita(&frame, diagonal(values));
        connection.weyl(&metric).unwrap()
    };
    let before = weyl(&curved);
    assert!(!before.is_empty());
    assert_eq!(weyl(&scaled), before);
}

/// The example of SageManifolds (`schouten`, `cotton_york` in metric.py): the Heisenberg group, whose
/// `CY_ij = epsilon^kl_i nabla_k P_lj` is `1/2 epsilon^kl_i C_jkl` here.
#[test]
fn heisenberg_group_in_coordinates() {
    let x = Symbolic::parameter("x");
    let square = x.clone() * &x;
    let symmetric = |values: [Symbolic; 4]| {
        let [xx, yy, yz, zz] = values;
        let entries =
            [([0, 0], xx), ([1, 1], yy), ([1, 2], yz.clone()), ([2, 1], yz), ([2, 2], zz)];
        Tensor::from_components(3, &[Down, Down], entries).unwrap()
    };
    let ratio = |n: i64, d: i64| Symbolic::constant(fraction(n, d));
    let frame = Frame::coordinates(&["x", "y", "z"]).unwrap();
    let g = symmetric([constant(1), constant(1) + &square, -x.clone(), constant(1)]);
    let (connection, metric) = levi_civita(&frame, g);
    let schouten = symmetric([
        ratio(-3, 8),
        ratio(5, 8) * &square - &ratio(3, 8),
        ratio(-5, 8) * &x,
        ratio(5, 8),
    ]);
    assert_eq!(connection.schouten(&metric).unwrap(), schouten);
    let epsilon = Tensor::from_fn(3, [Up, Up, Up], |[i, j, k]| {
        let (i, j, k) = (i as i64, j as i64, k as i64);
        constant((i - j) * (j - k) * (k - i) / 2)
    });
    let cotton = connection.cotton(&metric).unwrap();
    let operands = [("e", &epsilon.unwrap()), ("C", &cotton)];
    let york = contract("e^klm C_jkl -> ^m_j", &operands).unwrap().scale(&ratio(1, 2));
    let york = york.lower(0, metric.components()).unwrap();
    assert_eq!(york, symmetric([ratio(1, 2), ratio(1, 2) - &square, x, constant(-1)]));
}

/// The unit sphere in stereographic coordinates: `P = g/2`, Weyl and Cotton vanish, `Kr = 2 n
/// (n-1)`.
#[test]
fn round_spheres() {
    let names = ["x", "y", "z", "w"];
    for n in [3, 4] {
        let frame = Frame::coordinates(&names[..n]).unwrap();
        let radius = names[..n].iter().fold(constant(1), |sum, name| {
            let x = Symbolic::parameter(name);
            sum + &(x.clone() * &x)
        });
        let factor = constant(4) / &(radius.clone() * &radius);
        let (connection, metric) = levi_civita(&frame, diagonal(&vec![factor; n]));
        let half = metric.components().scale(&constant(2).recip().unwrap());
        assert_eq!(connection.schouten(&metric).unwrap(), half);
        assert!(connection.weyl(&metric).unwrap().is_empty());
        assert!(connection.cotton(&metric).unwrap().is_empty());
        let kretschmann = constant(2 * n as i64 * (n as i64 - 1));
        assert_eq!(connection.kretschmann(&metric).unwrap(), kretschmann);
        assert!(connection.nabla_curvature().is_empty());
    }
}

/// Over symbols the Ricci tensor is computed without the curvature. It equals the trace of the
/// curvature, also if the algebra is not unimodular, and on a chart.
#[test]
fn ricci_of_symbols_is_the_trace_of_the_curvature() {
    let text = |text: &str| text.parse::<Symbolic>().unwrap();
    let rows = [["a", "d", "0"], ["d", "b", "a*d"], ["0", "a*d", "c"]];
    let full = Tensor::from_fn(3, [Down, Down], |[i, j]| text(rows[i][j])).unwrap();
    for (name, dimension) in [("so(3)", 3), ("bianchi(V)", 3), ("bianchi(VI,h=-1/2)", 3)] {
        let algebra = catalogued(name).map(|v| Symbolic::constant(v.clone())).unwrap();
        assert_eq!(algebra.dimension(), dimension);
        let metric = Metric::new(algebra.labels(), full.clone()).unwrap();
        let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
        let direct = connection.ricci();
        let trace = contract("R^i_jil -> _jl", &[("R", connection.curvature())]).unwrap();
        assert_eq!(direct, trace, "{name}");
        assert_eq!(connection.ricci(), trace, "{name}");
        assert!(!trace.is_empty());
    }
    let frame = Frame::coordinates(["r", "u"]).unwrap();
    let polar = Tensor::from_fn(2, [Down, Down], |at| {
        text(match at {
            [0, 0] => "1",
            [1, 1] => "sin(r)^2",
            _ => "0",
        })
    });
    let metric = Metric::new(["r", "u"], polar.unwrap()).unwrap();
    let sphere = Connection::levi_civita(&frame, &metric).unwrap();
    assert_eq!(&sphere.ricci(), metric.components());
}

/// Two blocks of symbols on se(3): the values at a point equal those of a computation with numbers.
#[test]
fn blocks_of_symbols_may_be_set_late() {
    let exact = catalogued("se(3)");
    let algebra = exact.map(|v| Symbolic::constant(v.clone())).unwrap();
    let value = |i: usize, j: usize| match (i / 3 == j / 3, i == j) {
        (false, _) => integer(0),
        (_, true) => fraction(7 + i as i64, 2),
        _ => fraction((i * j) as i64 - 3, 4),
    };
    let name = |i: usize, j: usize| format!("g{}{}", i.min(j) + 1, i.max(j) + 1);
    let symbol = |[i, j]: [usize; 2]| match i / 3 == j / 3 {
        true => Symbolic::parameter(&name(i, j)),
        false => Symbolic::constant(integer(0)),
    };
    let values: std::collections::BTreeMap<_, _> = (0..36)
        .map(|at| (name(at / 6, at % 6), Symbolic::constant(value(at / 6, at % 6))))
        .filter(|(_, v)| *v != Symbolic::constant(integer(0)))
        .collect();
    let g = Tensor::from_fn(6, [Down, Down], symbol).unwrap();
    let metric = Metric::new(algebra.labels(), g).unwrap();
    let symbolic = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    let g = Tensor::from_fn(6, [Down, Down], |[i, j]| value(i, j)).unwrap();
    let metric_at = Metric::new(exact.labels(), g).unwrap();
    let numbers = Connection::levi_civita(exact.left_frame(), &metric_at).unwrap();
    let constant = |tensor: &Tensor<Rational>| tensor.map(|v| Symbolic::constant(v.clone()));
    let set = |tensor: &Tensor<Symbolic>| tensor.map(|v| v.substitute(&values).unwrap());
    assert_eq!(set(symbolic.affinities()), constant(numbers.affinities()));
    assert_eq!(set(&symbolic.ricci()), constant(&numbers.ricci()));
    let scalar = symbolic.scalar_curvature(&metric).unwrap().substitute(&values);
    let expected = numbers.scalar_curvature(&metric_at).unwrap();
    assert_eq!(scalar, Some(Symbolic::constant(expected)));
}
