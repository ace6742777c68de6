//! One geometry in many frames: left-invariant, coordinate and moving ones give the same tensors.
//!
//! Constants of the left-invariant frame are transformed to a frame `e'_a = A^i_a e_i` with
//! functions `A` by the inhomogeneous law, which is written out here. The tensors that the library
//! computes in that frame, including derivatives, must be the transformed constants.
//!
//! Guards `Frame::{invariant, coordinates, moving}`, with `Connection` and `Metric` over them.

use crate::common::algebras::by_table;
use crate::common::charts::{
    Chart, Moved, affine, constant, euclidean, euler_angles, heisenberg, special_linear, sum,
};
use affinor::{Connection, Error, Frame, Metric};
use affinor_tensors::{Down, Field, Rational, Symbolic, Tensor, Up, Variance};

/// Constant components without symmetry.
fn constants<const RANK: usize>(n: usize, slots: [Variance; RANK]) -> Tensor<Symbolic> {
    let mut state = 5;
    Tensor::from_fn(n, slots, |_| {
        state = (state * 7 + 3) % 31;
        constant([0, 2, -1, 0, 1][state as usize % 5])
    })
    .unwrap()
}

/// A metric that is neither diagonal nor definite.
fn metric(n: usize) -> Tensor<Symbolic> {
    let rows = [[1, 1, 0], [1, -2, 1], [0, 1, 1]];
    Tensor::from_fn(n, [Down, Down], |[i, j]| constant(rows[i][j])).unwrap()
}

fn levi_civita(frame: &Frame<Symbolic>, g: &Tensor<Symbolic>) -> Connection<Symbolic> {
    let metric = Metric::new(frame.labels(), g.clone()).unwrap();
    Connection::levi_civita(frame, &metric).unwrap()
}

/// All quantities in `frame` equal the transformed constants of the left-invariant frame.
fn same_geometry(moved: &Moved, frame: &Frame<Symbolic>) {
    let n = moved.chart.dimension();
    let algebra = &moved.chart.algebra;
    let left_frame = algebra.left_frame();
    let g = metric(n);
    let of_metric = levi_civita(left_frame, &g);
    let plus = Connection::cartan_schouten(algebra, &constant(1));
    let parameter = Connection::cartan_schouten(algebra, &Symbolic::parameter("lambda"));
    let any = Connection::new(left_frame.clone(), constants(n, [Up, Down, Down])).unwrap();
    for left in [any, plus, parameter, of_metric] {
        let here = Connection::new(frame.clone(), moved.inhomogeneous(left.affinities())).unwrap();
        assert_eq!(here.torsion(), moved.tensor(&left.torsion()));
        assert_eq!(*here.curvature(), moved.tensor(left.curvature()));
        assert_eq!(here.ricci(), moved.tensor(&left.ricci()));
        let t = constants(n, [Up, Down]);
        let nabla = here.nabla(&moved.tensor(&t)).unwrap();
        assert_eq!(nabla, moved.tensor(&left.nabla(&t).unwrap()));
        let labels = frame.labels();
        let q = left.nonmetricity(&Metric::new(labels, g.clone()).unwrap()).unwrap();
        let metric_here = Metric::new(labels, moved.tensor(&g)).unwrap();
        assert_eq!(here.nonmetricity(&metric_here).unwrap(), moved.tensor(&q));
        assert!(here.bianchi_first().is_empty());
        assert!(here.bianchi_second().is_empty());
    }
}

/// The Koszul formula with derivatives in this frame equals the transformed constants of the
/// formula without them.
fn same_levi_civita(moved: &Moved, frame: &Frame<Symbolic>) {
    let g = metric(moved.chart.dimension());
    let left = levi_civita(moved.chart.algebra.left_frame(), &g);
    let here = levi_civita(frame, &moved.tensor(&g));
    assert_eq!(here.affinities(), &moved.inhomogeneous(left.affinities()));
}

#[test]
fn the_fields_are_a_left_frame() {
    for chart in [heisenberg(), affine(), special_linear(), euclidean(), euler_angles()] {
        let (n, c) = (chart.dimension(), chart.algebra.structure_constants());
        for [a, j, k] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
            let bracket = chart.derive(j, &chart.fields.get(&[a, k]))
                - &chart.derive(k, &chart.fields.get(&[a, j]));
            let expected = sum((0..n).map(|i| c.get(&[i, j, k]) * &chart.fields.get(&[a, i])));
            assert_eq!(bracket, expected);
        }
    }
}

#[test]
fn coordinate_frames() {
    for chart in [heisenberg(), affine(), special_linear(), euclidean(), euler_angles()] {
        let moved = chart.coordinates();
        assert!(moved.structure_functions().is_empty());
        let frame = Frame::coordinates(chart.names).unwrap();
        same_geometry(&moved, &frame);
        same_levi_civita(&moved, &frame);
    }
}

#[test]
fn moving_frames() {
    let [x, y, a] = ["x", "y", "a"].map(Symbolic::parameter);
    let one = constant(1);
    let chart = heisenberg();
    let scales = [x.clone() + &one, y.clone() * &x, one.clone()];
    let moved = Moved::scaled(&chart, &scales, y);
    assert!(
        moved.structure_functions().components().any(|(_, value)| value.as_constant().is_none())
    );
    same_geometry(&moved, &moved.frame());
    same_levi_civita(&moved, &moved.frame());
    let chart = affine();
    let b = Symbolic::parameter("b");
    let moved = Moved::scaled(&chart, &[b.clone() / &a, b.clone() * &b + &one], a * &b);
    same_geometry(&moved, &moved.frame());
    same_levi_civita(&moved, &moved.frame());
}

/// In the left-invariant frame with derivations that act on functions: `nabla (f t) = df t + f
/// nabla t`.
#[test]
fn functions_in_the_left_frame() {
    let chart = special_linear();
    let n = chart.dimension();
    let moved = Moved::new(&chart, Tensor::identity(n));
    let frame = moved.frame();
    assert_eq!(frame.structure_functions(), chart.algebra.structure_constants());
    assert!(!frame.is_invariant());
    let connection = Connection::new(frame, constants(n, [Up, Down, Down])).unwrap();
    let f = Symbolic::parameter("u") * &Symbolic::parameter("v") / &Symbolic::parameter("a");
    let t = constants(n, [Up, Down]);
    let (product, nabla) = (connection.nabla(&t.scale(&f)).unwrap(), connection.nabla(&t).unwrap());
    for [i, m, j] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
        let rule = chart.derive(m, &f) * &t.get(&[i, j]) + &(nabla.get(&[i, m, j]) * &f);
        assert_eq!(product.get(&[i, m, j]), rule);
    }
    let refused = connection.in_right_frame(&chart.algebra);
    assert!(matches!(refused, Err(Error::Unsupported(_))));
}

/// Surfaces of constant curvature, each in coordinates and by an orthonormal moving frame.
#[test]
fn surfaces() {
    let [x, y, one] = [Symbolic::parameter("x"), Symbolic::parameter("y"), constant(1)];
    let radius = x.clone() * &x + &(y.clone() * &y);
    // the length of a coordinate vector is 1/f
    let sphere = (one.clone() + &radius) / &constant(2);
    let bump = one.clone() / &(radius + &one);
    for (f, curvature) in
        [(sphere, Some(1)), (y.clone(), Some(-1)), (one.clone(), Some(0)), (bump, None)]
    {
        let squared = (f.clone() * &f).recip().unwrap();
        let unit = |value: &Symbolic| {
            let entry = |[i, j]: [usize; 2]| if i == j { value.clone() } else { constant(0) };
            Tensor::from_fn(2, [Down, Down], entry).unwrap()
        };
        let coordinates = Frame::coordinates(&["x", "y"]).unwrap();
        let flat = by_table(2, &[]).map(|v| Symbolic::constant(v.clone())).unwrap();
        let fields = Tensor::identity(2);
        let chart = Chart { names: &["x", "y"], algebra: flat, fields };
        let moving = Moved::scaled(&chart, &[f.clone(), f.clone()], constant(0)).frame();
        let gauss = |frame: &Frame<Symbolic>, g: Tensor<Symbolic>| {
            let connection = levi_civita(frame, &g);
            let metric = Metric::new(frame.labels(), g).unwrap();
            assert!(connection.torsion().is_empty());
            assert!(connection.nonmetricity(&metric).unwrap().is_empty());
            let (x, y) = ([constant(1), constant(2)], [constant(0), constant(3)]);
            let sectional = connection.sectional_curvature(&metric, &x, &y).unwrap().unwrap();
            let scalar = connection.scalar_curvature(&metric).unwrap();
            assert_eq!(scalar, sectional.clone() * &constant(2));
            sectional
        };
        let by_coordinates = gauss(&coordinates, unit(&squared));
        assert_eq!(by_coordinates, gauss(&moving, unit(&constant(1))));
        // K = f (f_xx + f_yy) - f_x^2 - f_y^2 for the metric (dx^2 + dy^2)/f^2
        let [fx, fy] = ["x", "y"].map(|name| f.derivative(name));
        let laplace = fx.derivative("x") + &fy.derivative("y");
        let closed = f.clone() * &laplace - &(fx.clone() * &fx) - &(fy.clone() * &fy);
        assert_eq!(by_coordinates, closed);
        if let Some(curvature) = curvature {
            assert_eq!(by_coordinates, Symbolic::constant(Rational::from(curvature)));
        }
    }
}
