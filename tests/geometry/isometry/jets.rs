//! Isometry algebras of invariant metrics: published ones, 100 random metrics by a second route, and
//! the same metrics on charts.

use affinor::algebra::catalogue;
use affinor::algebra::structure::reduction::PseudoRandom;
use affinor::geometry::isometry::{Certainty, IsometryAlgebra, Symmetry};
use affinor::{BasisChange, Down, LieAlgebra, Metric, Rational, ReductivePair, Tensor, Up};
use affinor_tensors::linear::Matrix;
use affinor_tensors::linear::modular::PRIMES;
use num_traits::Zero;

fn algebra(name: &str) -> LieAlgebra<Rational> {
    catalogue::algebra(name).unwrap()
}

fn isometries(algebra: &LieAlgebra<Rational>, metric: &Metric<Rational>) -> IsometryAlgebra {
    IsometryAlgebra::invariant(algebra.left_frame(), metric, Symmetry::Killing).unwrap()
}

/// The dimensions of the isometry groups of Thurston's geometries, and of further groups.
///
/// J. Milnor, *Adv. Math.* 21 (1976); K. Y. Ha, J. B. Lee, *Math. Nachr.* 282 (2009), for groups of
/// dimension 3.
#[test]
fn invariant_metrics_have_their_published_isometries() {
    let cases: [(&str, &[i64], usize, &str); 14] = [
        ("R^3", &[1, 2, 3], 6, "se(3)"),
        ("so(3)", &[1, 1, 1], 6, "so(3) + so(3)"),
        ("so(3)", &[1, 1, 2], 4, "so(3) + R^1"),
        ("so(3)", &[1, 2, 3], 3, "so(3)"),
        ("sl(2)", &[1, 2, 3], 3, "sl(2,R)"),
        ("heisenberg(3)", &[1, 2, 3], 4, ""),
        ("heisenberg(5)", &[1, 1, 1, 1, 1], 9, ""),
        ("heisenberg(5)", &[1, 2, 1, 2, 1], 7, ""),
        ("bianchi(VII,h=0)", &[1, 1, 1], 6, "se(3)"),
        ("bianchi(VII,h=0)", &[1, 2, 1], 3, "se(2)"),
        ("bianchi(VI,h=-1)", &[1, 1, 1], 3, "iso(1,1)"),
        ("bianchi(V)", &[1, 2, 3], 6, "so(3,1)"),
        ("bianchi(III)", &[1, 1, 1], 4, "sl(2,R) + R^1"),
        ("aff(1)", &[1, 5], 3, "sl(2,R)"),
    ];
    for (name, diagonal, dimension, known) in cases {
        let metric = Metric::diagonal(diagonal.iter().map(|d| Rational::from(*d))).unwrap();
        let Ok(algebra) = catalogue::algebra::<Rational>(name) else { panic!("{name}") };
        let found = isometries(&algebra, &metric);
        assert_eq!(found.dimension(), dimension, "{name} {diagonal:?}: {found:?}");
        assert_eq!(found.certainty(), Certainty::Proved);
        assert!(found.is_transitive());
        if !known.is_empty() {
            assert_eq!(found.name().as_deref(), Some(known), "{name} {diagonal:?}");
        }
    }
}

/// Symmetric spaces by their pairs: spheres, projective planes, hyperbolic spaces.
#[test]
fn homogeneous_spaces_have_their_isometries() {
    let unit = |n: usize, at: usize| {
        (0..n).map(|i| Rational::from(i64::from(i == at))).collect::<Vec<_>>()
    };
    // the vectors of so(n + 1) that fix the last coordinate vector
    for n in 2..=4 {
        let so = algebra(&format!("so({})", n + 1));
        let planes: Vec<_> = (0..=n).flat_map(|i| (i + 1..=n).map(move |j| (i, j))).collect();
        let ad = |x: usize, y: usize| so.bracket(&unit(planes.len(), x), &unit(planes.len(), y));
        // a subalgebra of dimension n (n - 1) / 2 that the basis spans
        let size = n * (n - 1) / 2;
        let closed = |h: &[usize]| {
            h.iter().all(|x| {
                h.iter().all(|y| {
                    let bracket = ad(*x, *y).unwrap();
                    bracket.iter().enumerate().all(|(i, v)| v.is_zero() || h.contains(&i))
                })
            })
        };
        let subsets = (0u32..1 << planes.len()).filter(|set| set.count_ones() as usize == size);
        let mut subsets =
            subsets.map(|set| (0..planes.len()).filter(|i| set >> i & 1 == 1).collect::<Vec<_>>());
        let h = subsets.find(|h| closed(h)).unwrap();
        let h: Vec<_> = h.into_iter().map(|at| unit(planes.len(), at)).collect();
        let pair = ReductivePair::orthogonal(&so, &h).unwrap();
        let metric = pair.invariant_tensors(&[Down, Down]).unwrap().remove(0);
        let metric = Metric::new(pair.frame().labels(), metric).unwrap();
        let found = IsometryAlgebra::invariant(pair.frame(), &metric, Symmetry::Killing).unwrap();
        assert_eq!((found.dimension(), found.space()), (n * (n + 1) / 2, n));
    }
}

/// The dimension of the derivations that are antisymmetric for the metric.
fn skew_derivations(algebra: &LieAlgebra<Rational>, metric: &Metric<Rational>) -> usize {
    let n = algebra.dimension();
    let (c, g) = (algebra.structure_constants(), metric.components());
    let unknown = |i: usize, j: usize| i * n + j;
    let mut rows = vec![];
    for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
        // g_mk D^m_j + g_jm D^m_k
        let lowered =
            (0..n).flat_map(|m| [(unknown(m, j), g.get(&[m, k])), (unknown(m, k), g.get(&[j, m]))]);
        rows.push(lowered.collect::<Vec<_>>());
        for i in 0..n {
            // D [e_j, e_k] - [D e_j, e_k] - [e_j, D e_k]
            let row = (0..n).flat_map(|m| {
                [
                    (unknown(i, m), c.get(&[m, j, k])),
                    (unknown(m, j), -c.get(&[i, m, k])),
                    (unknown(m, k), -c.get(&[i, j, m])),
                ]
            });
            rows.push(row.collect());
        }
    }
    Matrix::from_rows(n * n, rows).unwrap().nullspace().unwrap().rows()
}

/// The isometries of a left-invariant Riemannian metric on a nilpotent or unimodular completely
/// solvable group are translations and isometric automorphisms: E. N. Wilson, *Geom. Dedicata* 12
/// (1982); C. Gordon, E. N. Wilson, *Trans. Amer. Math. Soc.* 307 (1988). The same dimension holds on
/// so(3). On every other group it is a lower bound.
#[test]
fn random_metrics_have_the_dimension_of_isometric_automorphisms() {
    let exact = [
        "heisenberg(3)",
        "R^2",
        "filiform(4)",
        "heisenberg(5)",
        "filiform(5)",
        "bianchi(VI,h=-1)",
        "so(3)",
    ];
    let bounds = ["sl(2)", "bianchi(V)", "aff(1)", "bianchi(III)", "bianchi(IV)", "se(2)"];
    let (mut draw, mut count) = (PseudoRandom::new(7), 0);
    for round in 0..8 {
        for (name, is_exact) in
            exact.iter().map(|name| (name, true)).chain(bounds.iter().map(|name| (name, false)))
        {
            let Ok(algebra) = catalogue::algebra::<Rational>(name) else { panic!("{name}") };
            let n = algebra.dimension();
            // A^T A with a triangular A, diagonal in the first rounds, where symmetries are frequent
            let mut entry = |range: u64| Rational::from((draw.residue(PRIMES[0]) % range) as i64);
            let rows: Vec<Vec<Rational>> = (0..n)
                .map(|i| {
                    (0..n)
                        .map(|j| match i.cmp(&j) {
                            std::cmp::Ordering::Equal => entry(2) + Rational::from(1),
                            std::cmp::Ordering::Less if round > 3 => entry(3) - Rational::from(1),
                            _ => Rational::zero(),
                        })
                        .collect()
                })
                .collect();
            let gram = |at: [usize; 2]| {
                (0..n).map(|k| rows[k][at[0]].clone() * &rows[k][at[1]]).sum::<Rational>()
            };
            let metric = Tensor::from_fn(n, [Down, Down], gram).unwrap();
            let metric = Metric::new(algebra.labels(), metric).unwrap();
            let found = isometries(&algebra, &metric);
            let automorphisms = n + skew_derivations(&algebra, &metric);
            assert_eq!(found.certainty(), Certainty::Proved);
            match is_exact {
                true => assert_eq!(found.dimension(), automorphisms, "{name} {metric}"),
                false => assert!(found.dimension() >= automorphisms, "{name} {metric}"),
            }
            count += 1;
        }
    }
    assert!(count >= 100, "{count}");
}

/// Dimension and name do not depend on the basis of the algebra.
#[test]
fn isometries_do_not_depend_on_the_basis() {
    for (name, diagonal) in
        [("so(3)", [1, 1, 2]), ("heisenberg(3)", [1, 2, 3]), ("sl(2)", [1, 1, 1])]
    {
        let algebra = algebra(name);
        let metric = Metric::diagonal(diagonal.map(Rational::from)).unwrap();
        let known = isometries(&algebra, &metric);
        let rows = [[1, 2, 0], [0, 1, -1], [1, 0, 3]];
        let matrix = Tensor::from_fn(3, [Up, Down], |[i, j]| Rational::from(rows[i][j])).unwrap();
        let change = BasisChange::new(matrix).unwrap();
        let moved = algebra.change_basis(&change).unwrap();
        let components = change.apply(metric.components()).unwrap();
        let found = isometries(&moved, &Metric::new(moved.labels(), components).unwrap());
        assert_eq!(found.dimension(), known.dimension(), "{name}");
        assert_eq!(found.name(), known.name(), "{name}");
    }
}
