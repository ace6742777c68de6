//! The mobility of loops of six hinges, and of loops in another frame and order; the equations of
//! joints between moving bodies.

mod tree;

use affinor::group::{LieGroup, Se3};
use affinor::mechanism::constraint::gravity;
use affinor::mechanism::joint::JointData;
use affinor::mechanism::symmetry::Involution;
use affinor::mechanism::{Joint, JointConstraint, JointKind, Mechanism, Mobility, Reason, Twist};
use affinor::{Error, Rational};
use nalgebra::{DMatrix, DVector, Isometry3, Vector3, Vector6};

/// A point of an axis, and its direction.
type Line = ([i64; 3], [i64; 3]);

fn vector(components: [i64; 3]) -> [Rational; 3] {
    components.map(Rational::from)
}

/// One loop of hinges; body 0 is the ground.
fn ring(lines: &[([Rational; 3], [Rational; 3])]) -> Result<Mechanism<Rational>, Error> {
    let count = lines.len();
    let mut joints = vec![];
    for (k, (point, axis)) in lines.iter().enumerate() {
        let bodies = [k, (k + 1) % count];
        joints.push(Joint::revolute(point, axis)?.between(format!("J{k}"), bodies));
    }
    let bodies = (0..count).map(|k| format!("B{k}")).collect();
    Mechanism::new(bodies, &[0], joints)
}

fn mobility(lines: &[Line]) -> Result<Mobility<Rational>, Error> {
    let lines: Vec<_> = lines.iter().map(|(p, w)| (vector(*p), vector(*w))).collect();
    ring(&lines)?.mobility()
}

/// Three lines in general position.
const LINES: [Line; 3] =
    [([1, 0, 2], [1, 2, -1]), ([0, 3, 1], [2, -1, 3]), ([-1, 1, 4], [0, 1, 5])];

/// R. Bricard, *J. math. pures appl.* 3 (1897) 113-148: a loop of three lines and their images under
/// a half-turn moves.
#[test]
fn line_symmetric_loops_move() -> Result<(), Error> {
    let turned = |[x, y, z]: [i64; 3]| [-x, -y, z];
    let images = LINES.map(|(point, axis)| (turned(point), turned(axis)));
    let found = mobility(&[LINES, images].concat())?;
    assert_eq!(found.verdict.exact(), Some(1));
    let half_turn = |reason: &Reason| matches!(reason, Reason::Symmetry(s) if s.involution == Involution::HalfTurn && !s.reverses);
    assert!(found.verdict.reasons.iter().any(half_turn), "{:?}", found.verdict);
    Ok(())
}

/// The same source: a loop moves that has two axes in a plane, and the others as mirror images. The
/// reflection of an axis reverses its sense of rotation.
#[test]
fn plane_symmetric_loops_move() -> Result<(), Error> {
    let mirrored = |(point, axis): Line| {
        let [x, y, z] = point;
        let [a, b, c] = axis;
        ([x, -y, z], [-a, b, -c])
    };
    let (first, fourth): (Line, Line) = (([2, 0, 1], [1, 0, 3]), ([-1, 0, 2], [2, 0, -1]));
    let (second, third) = (LINES[1], LINES[2]);
    let lines = [first, second, third, fourth, mirrored(third), mirrored(second)];
    let found = mobility(&lines)?;
    assert_eq!(found.verdict.exact(), Some(1));
    let reflection = |reason: &Reason| matches!(reason, Reason::Symmetry(s) if s.involution == Involution::Reflection && s.reverses);
    assert!(found.verdict.reasons.iter().any(reflection), "{:?}", found.verdict);
    Ok(())
}

/// Six lines in general position are rigid; the count of Gruebler and Kutzbach agrees.
#[test]
fn loops_in_general_position_are_rigid() -> Result<(), Error> {
    let others = [([3, -1, 0], [1, 1, 2]), ([2, 2, -3], [-1, 4, 1]), ([0, -2, 1], [3, 0, 1])];
    let found = mobility(&[LINES, others].concat())?;
    assert_eq!((found.rank, found.verdict.exact()), (6, Some(0)));
    assert_eq!(found.verdict.reasons, [Reason::NoRates]);
    Ok(())
}

/// Bennett's loop moves, and seven hinges in general position move too. A rotation with rational
/// entries, a translation, and another beginning of the loop change neither rank nor verdict.
#[test]
fn frames_and_order_do_not_matter() -> Result<(), Error> {
    // the rotation of the quaternion (1, -1, -2, -3)/sqrt(15), times 15
    let rotation = [[-11, 10, 2], [-2, -5, 14], [10, 10, 5]];
    let moved = |(point, axis): Line, shift: i64| {
        let turned = |v: [i64; 3]| {
            std::array::from_fn::<_, 3, _>(|i| {
                let sum: i64 = (0..3).map(|k| rotation[i][k] * v[k]).sum();
                Rational::from(sum) / Rational::from(15)
            })
        };
        let point = turned(point);
        let point =
            std::array::from_fn(|i| point[i].clone() + &Rational::from(shift * (i as i64 + 1)));
        (point, turned(axis))
    };
    let turned = |[x, y, z]: [i64; 3]| [-x, -y, z];
    let images = LINES.map(|(point, axis)| (turned(point), turned(axis)));
    let symmetric = [LINES, images].concat();
    let mut seven = symmetric.clone();
    seven.push(([5, 1, 1], [1, 0, 0]));
    for lines in [symmetric, seven] {
        let own = mobility(&lines)?;
        for (start, shift) in [(0, 7), (2, 0), (3, -2)] {
            let mut lines: Vec<_> = lines.iter().map(|line| moved(*line, shift)).collect();
            lines.rotate_left(start);
            let other = ring(&lines)?.mobility()?;
            assert_eq!(own.rank, other.rank);
            assert_eq!(own.verdict.exact(), other.verdict.exact());
            assert_eq!(own.verdict.exact(), Some(1));
        }
    }
    Ok(())
}

/// The body, row and column of an entry of a pose.
type Entry = (usize, usize, usize);

/// The value of a polynomial at the poses of two bodies.
fn value(polynomial: &[(f64, Vec<Entry>)], poses: [&Isometry3<f64>; 2]) -> f64 {
    let entry = |(body, i, j): &Entry| poses[*body].to_homogeneous()[(*i, *j)];
    polynomial.iter().map(|(c, factors)| c * factors.iter().map(entry).product::<f64>()).sum()
}

/// Each kind of joint has as many independent equations as it has constraints. They hold for all
/// relative poses in the subgroup of the joint, also far from the initial position and for axes of
/// any length, and fail for others. Their gradients are difference quotients.
#[test]
fn equations_of_joints_define_their_subgroups() -> Result<(), Error> {
    let (point, axis, second) =
        (Vector3::new(1.5, -0.5, 2.0), Vector3::new(1.0, -2.0, 3.0), Vector3::new(0.5, 4.0, -1.0));
    let first = Se3.exp(&Vector6::new(0.9, -1.7, 0.4, 3.0, -2.0, 1.0));
    let identity = Isometry3::identity();
    for kind in JointKind::ALL {
        if matches!(kind, JointKind::Free | JointKind::Helical | JointKind::Subgroup) {
            assert!(JointConstraint::all(kind, &point, &axis, &second).is_empty());
            continue;
        }
        let data = JointData {
            point: point.into(),
            axis: axis.into(),
            second_axis: second.into(),
            pitch: 0.0,
            twists: vec![],
        };
        let joint = Joint::of_kind(kind, data)?;
        let equations = JointConstraint::all(kind, &point, &axis, &second);
        assert_eq!(equations.len() + joint.freedom(), 6, "{kind:?}");
        let exp = |twist: &Twist<f64>, q: f64| Se3.exp(&(Vector6::from(*twist) * q));
        let relative = joint.twists().iter().zip([0.7, -1.1, 0.9]);
        let relative = relative.fold(identity, |pose, (twist, q)| pose * exp(twist, q));
        let second_pose = first * relative;
        let other = second_pose * Se3.exp(&Vector6::new(0.3, 0.5, -0.4, 0.2, 0.6, -0.3));
        let mut rows = vec![];
        let mut violated = 0.0f64;
        for equation in &equations {
            let between = equation.polynomial([Some(0), Some(1)], &|body, i, j| (body, i, j));
            let on_ground = equation.polynomial([None, Some(1)], &|body, i, j| (body, i, j));
            assert!(value(&between, [&first, &second_pose]).abs() < 1e-12, "{kind:?} {equation:?}");
            assert!(value(&on_ground, [&identity, &relative]).abs() < 1e-12, "{kind:?}");
            violated = violated.max(value(&between, [&first, &other]).abs());
            let gradient = equation.gradient([Some(0), Some(1)], 2);
            for i in 0..12 {
                let step = |h: f64| {
                    let moved = Se3.exp(&(Vector6::ith(i % 6, 1.0) * h));
                    let poses = if i < 6 { [&moved, &identity] } else { [&identity, &moved] };
                    value(&between, poses)
                };
                let slope = (step(1e-5) - step(-1e-5)) / 2e-5;
                assert!((slope - gradient[i]).abs() < 1e-8, "{kind:?} {equation:?} {i}");
            }
            for twist in joint.twists() {
                let along = gradient.rows(6, 6).dot(&DVector::from_column_slice(twist));
                assert!(along.abs() < 1e-12, "{kind:?}");
            }
            rows.push(gradient.rows(6, 6).transpose());
        }
        assert!(violated > 1e-2, "{kind:?}");
        assert_eq!(DMatrix::from_rows(&rows).rank(1e-9), equations.len(), "{kind:?}");
    }
    Ok(())
}

/// The potential of gravity is `-m g . c` for the centre `c` in space.
#[test]
fn gravity_acts_at_the_centre() {
    let (mass, centre) = (2.5, Vector3::new(0.3, -0.7, 1.1));
    let acceleration = Vector3::new(1.0, -9.81, 0.5);
    let pose = Se3.exp(&Vector6::new(0.9, -1.7, 0.4, 3.0, -2.0, 1.0));
    let moments = [(0.0, Vector3::zeros()), (mass, centre * mass)];
    let potential = gravity(&acceleration, &moments, &|body, i, j| (body, i, j));
    let expected = -mass * acceleration.dot(&(pose * nalgebra::Point3::from(centre)).coords);
    assert!((value(&potential, [&Isometry3::identity(), &pose]) - expected).abs() < 1e-12);
}

/// The velocities of the bodies of a chain are the sums of the rates of its joints.
#[test]
fn velocities_add_up_along_chains() -> Result<(), Error> {
    let hinge = |x: i64, bodies: [usize; 2]| -> Result<Joint<Rational>, Error> {
        Ok(Joint::revolute(&vector([x, 0, 0]), &vector([0, 0, 1]))?
            .between(format!("J{x}"), bodies))
    };
    // the second joint is written from its outer body
    let joints = vec![hinge(0, [0, 1])?, hinge(2, [2, 1])?];
    let names = ["ground", "arm", "forearm"].map(String::from).to_vec();
    let chain = Mechanism::new(names, &[0], joints)?;
    let velocities = chain.velocities(&[3, 5].map(Rational::from));
    assert_eq!(velocities[1], [0, 0, 3, 0, 0, 0].map(Rational::from));
    // a rotation by -5 about z through (2, 0, 0) moves the origin by -5 e_z x (-2 e_x) = 10 e_y
    assert_eq!(velocities[2], [0, 0, -2, 0, 10, 0].map(Rational::from));
    Ok(())
}
