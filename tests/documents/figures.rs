//! The scenes of the figures agree with matrices and closed forms of rotations.

use crate::common::property::properties;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{LieGroup, So3};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_documents::figures;
use affinor_documents::figures::{Arrow, Connected, Figure, Panel, Path, Role, ball};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

fn connected(connection: Connection<f64>) -> Connected {
    let translation = ParallelTranslation::new(So3, connection).unwrap();
    Connected { name: "a connection".into(), translation }
}

fn canonical(which: CanonicalConnection) -> Connected {
    connected(Connection::canonical(&So3.algebra().unwrap(), which))
}

fn all(panel: &Panel, role: Role) -> Vec<&Arrow> {
    panel.arrows.iter().filter(|arrow| arrow.role == role).collect()
}

/// The only arrow with this role, from its start.
fn the(panel: &Panel, role: Role) -> Vector3<f64> {
    let found = all(panel, role);
    assert_eq!(found.len(), 1, "{role:?}");
    found[0].ends[1] - found[0].ends[0]
}

/// The exponential of a matrix by its series, independent of the group.
fn exp(x: &Vector3<f64>) -> Matrix3<f64> {
    x.cross_matrix().exp()
}

fn rotation(path: &Path, t: f64) -> Matrix3<f64> {
    path.factors.iter().fold(Matrix3::identity(), |g, x| g * exp(&(x * t)))
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-2.0..2.0f64).prop_map(Vector3::from)
}

fn path() -> impl Strategy<Value = Path> {
    prop::collection::vec(vector(), 1..4).prop_map(|factors| Path { factors })
}

fn close(a: &Vector3<f64>, b: &Vector3<f64>, tolerance: f64) -> bool {
    (a - b).norm() <= tolerance * (1.0 + b.norm())
}

/// Checks that all coordinates of a figure are finite.
fn finite(figure: &Figure) -> bool {
    figure.panels.iter().all(|panel| {
        let curves = panel.curves.iter().flat_map(|curve| &curve.points);
        let arrows = panel.arrows.iter().flat_map(|arrow| &arrow.ends);
        curves.chain(arrows).all(|x| x.iter().all(|x| x.is_finite()))
    })
}

properties! {
    #![cases(64)]

    /// `R^T dR/dt = spin(Omega)`, by differences of products of matrix exponentials.
    #[test]
    fn the_velocity_of_a_path_is_its_derivative(path in path(), t in 0.1..0.9f64) {
        let h = 1e-5;
        let derivative = (rotation(&path, t + h) - rotation(&path, t - h)) / (2.0 * h);
        let spin = rotation(&path, t).transpose() * derivative;
        prop_assert!((spin - path.velocity(t).cross_matrix()).norm() < 1e-6);
    }

    /// (57): `omega = R Omega`, and `w` is the derivative of its curve.
    #[test]
    fn images_are_translates_of_the_tangent(path in path(), t in 0.1..0.9f64) {
        let x = So3.log(&path.element(t)).unwrap();
        prop_assume!(x.norm() > 0.1 && x.norm() < 3.0);
        let figure = figures::images(&path, t).unwrap();
        let panel = &figure.panels[0];
        let (left, right) = (the(panel, Role::Left), the(panel, Role::Right));
        prop_assume!(left.norm() > 1e-3);
        prop_assert!(close(&(rotation(&path, t) * left), &right, 1e-12));
        // all arrows are scaled by the same factor
        let scale = left.norm() / path.velocity(t).norm();
        let h = 1e-5;
        let at = |t: f64| So3.log_near(&path.element(t), &x).unwrap();
        let derivative = (at(t + h) - at(t - h)) / (2.0 * h);
        prop_assert!(close(&the(panel, Role::Velocity), &(derivative * scale), 1e-6));
        let directions = all(panel, Role::Direction);
        prop_assert_eq!(directions.len(), 2);
        for arrow in directions {
            let n = arrow.ends[1] - arrow.ends[0];
            prop_assert!(n.cross(&x).norm() < 1e-12 && n.dot(&x) > 0.0);
        }
    }

    /// Carried to the identity: `exp(lambda n~) Omega`, so `omega` for `plus` (57), half the angle for
    /// `zero` (71), `Omega` for `minus`.
    #[test]
    fn connections_carry_the_tangent_by_their_share_of_the_angle(path in path(), t in 0.1..0.9f64) {
        let x = So3.log(&path.element(t)).unwrap();
        prop_assume!(x.norm() > 0.1 && x.norm() < 3.0);
        let kinds = [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus];
        let figure = figures::transport(&kinds.map(canonical), &path, t).unwrap();
        for (panel, lambda) in figure.panels.iter().zip([1.0, 0.5, 0.0]) {
            let carried = the(panel, Role::Carried);
            let left = the(panel, Role::Left);
            prop_assert!(close(&carried, &(exp(&(x * lambda)) * left), 1e-12));
            prop_assert_eq!(all(panel, Role::Trace).len(), 4);
        }
        prop_assert!(close(&the(&figure.panels[0], Role::Carried), &the(&figure.panels[0], Role::Right), 1e-12));
    }

    /// Points of the curve are rotations of the motion in the ball, and consecutive pieces meet at
    /// opposite points.
    #[test]
    fn curves_lie_on_the_motion(path in path(), t in 0.1..0.9f64) {
        let figure = figures::motion(&path, t).unwrap();
        prop_assert!(finite(&figure));
        let curves = &figure.panels[0].curves;
        let pieces: Vec<_> = curves.iter().filter(|curve| curve.role == Role::Motion).collect();
        for pair in pieces.windows(2) {
            let (end, start) = (pair[0].points.last().unwrap(), pair[1].points[0]);
            prop_assert!((end + start).norm() < 1e-12 && (end.norm() - ball::RADIUS).abs() < 1e-12);
        }
        let end = exp(pieces.last().unwrap().points.last().unwrap());
        prop_assert!((end - rotation(&path, 1.0)).norm() < 1e-9);
        let samples: Vec<_> = (0..=600).map(|i| rotation(&path, f64::from(i) / 600.0)).collect();
        for x in pieces.iter().flat_map(|piece| &piece.points).step_by(7) {
            let here = exp(x);
            prop_assert!(x.norm() <= ball::RADIUS * (1.0 + 1e-11));
            let nearest = samples.iter().map(|g| (g - here).norm()).fold(f64::MAX, f64::min);
            prop_assert!(nearest < 0.02, "{nearest}");
        }
    }

    /// `Phi`: the triad is the rotation matrix; the velocities are `omega` times each vector, as a
    /// cross product (66).
    #[test]
    fn the_body_turns_as_the_motion_says(path in path(), t in 0.1..0.9f64) {
        let figure = figures::motion(&path, t).unwrap();
        let body = &figure.panels[1];
        let q = rotation(&path, t);
        let omega = q * path.velocity(t);
        let arrows = all(body, Role::Velocity);
        prop_assert_eq!(arrows.len(), 3);
        for (i, arrow) in arrows.iter().enumerate() {
            let tip = q.column(i).into_owned();
            prop_assert!(close(&the(body, Role::Frame(i)), &tip, 1e-12));
            let velocity = arrow.ends[1] - arrow.ends[0];
            prop_assert!(close(&arrow.ends[0], &tip, 1e-12));
            prop_assert!(velocity.cross(&omega.cross(&tip)).norm() < 1e-12 * (1.0 + omega.norm()));
            prop_assert!(velocity.dot(&omega.cross(&tip)) >= 0.0);
        }
    }

    /// The frames are left translates: pulled back by the matrix they are the basis. Transport by
    /// `minus` gives the same frames.
    #[test]
    fn frames_are_left_translates(path in path(), t in 0.1..0.9f64) {
        prop_assume!(So3.log(&path.element(t)).unwrap().norm() < 3.0);
        let figure = figures::frames(&[canonical(CanonicalConnection::Minus)], &path, t).unwrap();
        let [left, carried] = &figure.panels[..] else { panic!("two panels") };
        for i in 0..3 {
            let frames = all(left, Role::Frame(i));
            for (arrow, other) in frames.iter().zip(all(carried, Role::Frame(i))) {
                prop_assert!((arrow.ends[1] - other.ends[1]).norm() < 1e-8);
                let ([x, tip], h) = (arrow.ends, 1e-6);
                // the arrow as a derivative of matrices
                let ahead = exp(&(x + (tip - x) * h));
                let behind = exp(&(x - (tip - x) * h));
                let spin = exp(&x).transpose() * (ahead - behind) / (2.0 * h);
                let length = (spin.norm_squared() * 0.5).sqrt();
                let basis = Vector3::<f64>::ith(i, length).cross_matrix();
                prop_assert!((spin - basis).norm() < 1e-7, "{spin}");
            }
        }
    }
}

#[test]
fn autoparallels_of_the_family_are_straight_and_others_are_not() {
    let axis = Vector3::new(0.9, 1.9, 1.3);
    let algebra = So3.algebra().unwrap();
    let frame = algebra.left_frame();
    let inertia =
        Tensor::from_fn(3, [Down, Down], |[i, j]| if i == j { 1.0 + i as f64 } else { 0.0 });
    let levi_civita =
        Connection::levi_civita(frame, &Metric::new(algebra.labels(), inertia.unwrap()).unwrap())
            .unwrap();
    let connections = [
        canonical(CanonicalConnection::Plus),
        canonical(CanonicalConnection::Zero),
        connected(levi_civita),
    ];
    let figure = figures::autoparallels(&connections, &axis).unwrap();
    assert!(finite(&figure));
    let bend = |panel: &Panel| {
        let rays = panel.curves.iter().filter(|curve| curve.role == Role::Ray);
        let bend = |points: &[Vector3<f64>]| {
            let first = points[1].normalize();
            points.iter().map(|x| x.cross(&first).norm()).fold(0.0, f64::max)
        };
        rays.map(|curve| bend(&curve.points)).fold(0.0, f64::max)
    };
    for panel in &figure.panels[..2] {
        assert!(bend(panel) < 1e-8, "{}", bend(panel));
        let q = panel.marks.last().unwrap();
        assert_eq!(q.label, "q");
        assert!((q.at - axis).norm() < 1e-8);
        let ends = panel.curves.iter().filter(|curve| curve.role == Role::Ray);
        assert!(
            ends.map(|ray| ray.points.last().unwrap().norm())
                .all(|r| (r - ball::RADIUS).abs() < 1e-8)
        );
    }
    assert!(bend(&figure.panels[2]) > 0.5);
}

#[test]
fn a_full_turn_leaves_the_ball_and_comes_back() {
    let path = Path { factors: vec![Vector3::new(0.0, 0.0, std::f64::consts::TAU)] };
    let figure = figures::images(&path, 0.25).unwrap();
    let curves = figure.panels[0].curves.iter().filter(|curve| curve.role == Role::Motion);
    let pieces: Vec<_> = curves.map(|curve| curve.points.clone()).collect();
    assert_eq!(pieces.len(), 2);
    assert!((pieces[0].last().unwrap() - Vector3::z() * ball::RADIUS).norm() < 1e-12);
    assert!((pieces[1][0] + Vector3::z() * ball::RADIUS).norm() < 1e-12);
}

#[test]
fn a_body_at_rest_has_figures_too() {
    let still = Path { factors: vec![Vector3::zeros()] };
    let plus = [canonical(CanonicalConnection::Plus)];
    for figure in [
        figures::images(&still, 0.5).unwrap(),
        figures::motion(&still, 0.5).unwrap(),
        figures::transport(&plus, &still, 1.0).unwrap(),
        figures::frames(&plus, &still, 0.0).unwrap(),
        figures::autoparallels(&plus, &Vector3::zeros()).unwrap(),
    ] {
        assert!(finite(&figure), "{}", figure.title);
    }
}
