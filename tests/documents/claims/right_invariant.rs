//! Right-invariant systems agree with left-invariant systems on the opposite group.
//!
//! Guards `group::Opposite`, `mechanics::systems::euler_poincare` and `Problem`.

use affinor::geometry::equations::Equations;
use affinor::group::{
    Coordinates, LieGroup, MatrixGroup, MatrixNotation, Opposite, Se2, Se3, Sl2, So3,
    TranslationSplit,
};
use affinor::mechanics::systems::euler_poincare::Free;
use affinor::mechanics::{Adaptive, EulerPoincare, Integrator, MuntheKaas};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_documents::problem::Problem;
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, DVector, Vector3, Vector6};

/// A positive definite matrix that is not diagonal.
fn full<G: TranslationSplit>(group: &G) -> Metric<f64> {
    let labels = group.algebra().unwrap().labels().to_vec();
    let entry = |[i, j]: [usize; 2]| match i.abs_diff(j) {
        0 => 1.0 + 0.5 * i as f64,
        1 => 0.25,
        _ => 0.125,
    };
    let metric = Tensor::from_fn(group.dimension(), [Down, Down], entry).unwrap();
    Metric::new(&labels, metric).unwrap()
}

fn free<G: TranslationSplit>(group: G) -> EulerPoincare<G, Free> {
    let metric = full(&group);
    let plus = Connection::canonical(&group.algebra().unwrap(), CanonicalConnection::Plus);
    EulerPoincare::free(group, &plus, &metric).unwrap()
}

fn affine() -> MatrixGroup {
    let stretch = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]);
    let shift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
    MatrixGroup::new(&[stretch, shift]).unwrap()
}

fn close<V: Coordinates>(x: &V, y: &V, tolerance: f64) {
    let off = (x.clone() - y.clone()).largest();
    assert!(off <= tolerance * (1.0 + x.largest()), "{x:?} and {y:?} differ by {off:e}");
}

/// `g -> g^-1` maps left-invariant motions to right-invariant ones with the negative velocity.
fn inverses<G: TranslationSplit + Clone>(group: G, turn: &G::Vector, velocity: &G::Vector) {
    let (left, right) = (free(group.clone()), free(Opposite(group.clone())));
    let g = group.exp(turn);
    let mut on_left = left.state(0.0, g.clone(), velocity);
    let mut on_right = right.state(0.0, group.inverse(&g), &-velocity.clone());
    for _ in 0..100 {
        MuntheKaas::RK4.step(&left, &mut on_left, 0.02).unwrap();
        MuntheKaas::RK4.step(&right, &mut on_right, 0.02).unwrap();
    }
    // both motions use one method, so its error cancels
    let back = group.compose(&on_left.element, &on_right.element);
    assert!(group.log(&back).unwrap().largest() < 1e-12, "{back:?}");
    close(&-left.velocity(&on_left), &right.velocity(&on_right), 1e-12);
    assert!((left.velocity(&on_left) - velocity.clone()).largest() > 0.01, "it moves");
    close(&on_left.spatial, &-on_right.spatial, 1e-12);
}

/// The velocity is the spatial one, `g' = omega g`; the momentum in the body is constant, and the
/// equations contain the negative structure constants.
fn right_invariant<G: TranslationSplit + Clone>(group: G, turn: &G::Vector, velocity: &G::Vector) {
    let system = free(Opposite(group.clone()));
    let start = system.state(0.0, group.exp(turn), velocity);
    let end = |t: f64| Adaptive::new(1e-13).states(&system, &start, &[t]).unwrap().remove(0);
    let h = 1e-3;
    let (before, after) = (end(1.0 - h), end(1.0 + h));
    let path = group.compose(&after.element, &group.inverse(&before.element));
    close(&(group.log(&path).unwrap() * (0.5 / h)), &system.velocity(&end(1.0)), 1e-5);

    // Ad*_g of the spatial momentum is the momentum in the body
    let body = |t: f64| {
        let state = end(t);
        group.coadjoint(&state.element, &system.momentum(&state))
    };
    close(&body(1.0), &body(0.0), 1e-10);

    let algebra = Opposite(group.clone()).algebra().unwrap();
    let opposed = algebra.structure_constants().components().all(|(at, value)| {
        (value + group.algebra().unwrap().structure_constants().get(&at)).abs() < 1e-14
    });
    assert!(opposed, "[x, y] changes its sign");
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    let equations = Equations::euler_poincare(&plus, &full(&group)).unwrap();
    let zeros = vec![0.0; group.dimension()];
    let rate = equations.rate(velocity.components(), &zeros).unwrap();
    let slope = (system.velocity(&end(h)) - system.velocity(&end(-h))) * (0.5 / h);
    close(&slope, &G::Vector::from_components(&rate), 1e-5);
}

fn both<G: TranslationSplit + Clone>(group: G, turn: &G::Vector, velocity: &G::Vector) {
    inverses(group.clone(), turn, velocity);
    right_invariant(group, turn, velocity);
}

#[test]
fn right_invariant_motions_are_inverses_of_left_invariant_ones() {
    both(So3, &Vector3::new(0.3, 0.5, -0.2), &Vector3::new(0.9, -0.5, 1.1));
    both(Se2, &Vector3::new(0.3, 0.5, -0.2), &Vector3::new(0.9, 0.5, -0.4));
    let turn = Vector6::new(0.2, -0.1, 0.3, 0.5, 0.1, -0.4);
    both(Se3, &turn, &Vector6::new(0.5, -0.3, 0.6, 0.4, 0.2, -0.5));
    both(Sl2, &Vector3::new(0.1, 0.2, -0.1), &Vector3::new(0.3, -0.5, 0.2));
    both(affine(), &DVector::from_vec(vec![0.3, -0.5]), &DVector::from_vec(vec![0.4, 0.3]));
}

/// On an abelian group, and for a bi-invariant metric, left- and right-invariant systems are equal.
#[test]
fn a_ball_does_not_know_the_side() {
    let algebra = So3.algebra().unwrap();
    let equal = (0..3).map(|i| ([i, i], 2.0));
    let metric = Tensor::from_components(3, &[Down, Down], equal).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let plus = Connection::canonical(&Opposite(So3).algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(Opposite(So3), &plus, &metric).unwrap();
    let velocity = Vector3::new(0.9, -0.5, 1.1);
    let start = system.state(0.0, So3.identity(), &velocity);
    let end = Adaptive::new(1e-13).states(&system, &start, &[2.0]).unwrap().remove(0);
    assert!(end.element.angle_to(&So3.exp(&(velocity * 2.0))) < 1e-12);
    // the frame of the group is not the frame of its opposite
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    assert!(EulerPoincare::free(Opposite(So3), &plus, &metric).is_err());
}

#[test]
fn elements_are_written_as_those_of_the_group() {
    let g = So3.exp(&Vector3::new(0.3, 0.5, -0.2));
    let written = Opposite(So3).write(&g);
    assert_eq!(written, So3.write(&g));
    assert!(Opposite(So3).read(&written).unwrap().angle_to(&g) < 1e-15);
    assert!((0..3).all(|at| Opposite(So3).is_angle(at)));
    assert!(Opposite(So3).read(&DMatrix::zeros(3, 3)).is_err());
}

/// The entries of the element, and the other columns, at the end of a problem.
fn ended(text: &str) -> (DMatrix<f64>, Vec<f64>, Vec<f64>) {
    let problem = Problem::parse("motion.toml", text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let mut ready = problem.motion(0).unwrap_or_else(|e| panic!("{text}: {e}"));
    let names: Vec<&str> = ready.columns.iter().map(|column| column.name.as_str()).collect();
    let names: Vec<&str> = names.into_iter().filter(|name| name.starts_with('g')).collect();
    let entries = names.len();
    // columns of a second factor end in _2
    let second = names.iter().filter(|name| name.ends_with("_2")).count();
    let [first, second] =
        [entries - second, second].map(|entries| (0..=entries).find(|n| n * n == entries).unwrap());
    let start = ready.motion.row();
    let end = ready.times[1];
    while !ready.motion.step(end).unwrap() {}
    let mut row = ready.motion.row();
    let others = row.split_off(entries);
    let mut matrix = DMatrix::zeros(first + second, first + second);
    for (at, size, entries) in
        [(0, first, &row[..first * first]), (first, second, &row[first * first..])]
    {
        let block = DMatrix::from_row_slice(size, size, entries);
        matrix.view_mut((at, at), (size, size)).copy_from(&block);
    }
    (matrix, start[entries..].to_vec(), others)
}

/// Groups by name and groups of matrices whose brackets are not integers in floats. The motion is
/// the inverse of the left-invariant motion with the negative velocity, and the momentum in the
/// body is conserved.
#[test]
fn every_group_of_matrices_has_right_invariant_motions() {
    let spaces = [
        ("so(4)", 6),
        ("so(5)", 10),
        ("so(2,1)", 3),
        ("so(3,1)", 6),
        ("sl(3)", 8),
        ("su(3)", 8),
        ("sp(4)", 10),
        ("gl(2)", 4),
        ("se(4)", 10),
        ("so3+so3", 6),
    ];
    for (space, n) in spaces {
        let metric: Vec<String> = (0..n).map(|i| format!("1 + {i}/5")).collect();
        let velocity = |sign: f64| -> Vec<f64> {
            (0..n).map(|i| sign * (0.4 - 0.3 * f64::from(i % 3))).collect()
        };
        let of = |invariance: &str, sign: f64, momentum: &str| {
            ended(&format!(
                "space = \"{space}\"\nmetric = \"diag({})\"\ninvariance = \"{invariance}\"\n\
                 [initial]\nvelocity = {:?}\n[integrator]\ntolerance = 1e-13\n\
                 [output]\nend = 1\ncolumns = [\"g\", \"{momentum}\", \"omega\"]\n",
                metric.join(", "),
                velocity(sign),
            ))
        };
        let (right, before, after) = of("right", 1.0, "H");
        let (left, ..) = of("left", -1.0, "h");
        let product = &left * &right;
        let off = (&product - DMatrix::identity(product.nrows(), product.nrows())).amax();
        assert!(off < 1e-10 * (1.0 + left.amax() * right.amax()), "{space}: {off:e}");
        let (body, space_velocity) = before.split_at(n as usize);
        let stays = body.iter().zip(&after).all(|(a, b)| (a - b).abs() < 1e-10);
        assert!(stays, "{space}: {before:?} and {after:?}");
        let moved =
            space_velocity.iter().zip(&after[n as usize..]).any(|(a, b)| (a - b).abs() > 1e-3);
        assert!(moved, "{space} is steady");
    }
}
