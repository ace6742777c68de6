//! The mobility of loops of six hinges, and of loops in another frame and order.

use affinor::mechanism::symmetry::Involution;
use affinor::mechanism::{Joint, Mechanism, Mobility, Reason};
use affinor::{Error, Rational};

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
