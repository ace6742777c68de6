//! Trees of bodies: another program, closed forms, identities and invariances of the recursions.
#![allow(clippy::excessive_precision, reason = "digits of another program")]

use affinor::Error;
use affinor::mechanics::MassProperties;
use affinor::mechanism::joint::JointData;
use affinor::mechanism::{Joint, JointKind, Mechanism, MovingTree, Tree};
use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Vector3};

/// Pseudo-random numbers in the interval [-1, 1].
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next().abs() * count as f64) as usize % count
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }

    fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }
}

/// A joint without its name, and its ends.
#[derive(Clone)]
struct Part {
    kind: JointKind,
    data: JointData<f64>,
    ends: [usize; 2],
}

/// A tree of bodies with joints of all kinds, skew axes and inertias that are not diagonal.
#[derive(Clone)]
struct Sample {
    parts: Vec<Part>,
    bodies: Vec<Option<MassProperties>>,
    gravity: Vector3<f64>,
}

impl Sample {
    fn new(count: usize, kinds: &[JointKind], random: &mut Random) -> Result<Self, Error> {
        let (mut parts, mut bodies) = (vec![], vec![None]);
        for body in 1..=count {
            let before = random.below(body);
            let ends = if random.next() > 0.0 { [before, body] } else { [body, before] };
            let point = random.vector() * 2.0;
            let data = JointData {
                point: point.into(),
                axis: (random.vector() + Vector3::x() * 0.1).into(),
                second_axis: (random.vector() + Vector3::y() * 0.2).into(),
                pitch: 0.3 * random.next(),
                twists: vec![],
            };
            parts.push(Part { kind: kinds[random.below(kinds.len())], data, ends });
            let mut masses = vec![];
            for _ in 0..5 {
                masses.push((1.2 + random.next(), point + random.vector()));
            }
            bodies.push(Some(MassProperties::points(&masses)?));
        }
        Ok(Sample { parts, bodies, gravity: random.vector() * 9.0 })
    }

    fn mechanism(&self) -> Result<Mechanism<f64>, Error> {
        let mut joints = vec![];
        for (at, part) in self.parts.iter().enumerate() {
            let joint = Joint::of_kind(part.kind, part.data.clone())?;
            joints.push(joint.between(format!("J{at}"), part.ends));
        }
        let names = (0..self.bodies.len()).map(|at| format!("B{at}")).collect();
        Mechanism::new(names, &[0], joints)
    }

    fn tree(&self) -> Result<Tree, Error> {
        Tree::new(&self.mechanism()?, &self.bodies, &self.gravity)
    }
}

/// A tree at random numbers and rates.
struct Case {
    moving: MovingTree,
    numbers: Vec<f64>,
    rates: Vec<f64>,
}

impl Case {
    fn new(sample: &Sample, random: &mut Random) -> Result<Self, Error> {
        let tree = sample.tree()?;
        let mut numbers = random.list(tree.home().len());
        tree.normalize(&mut numbers);
        let rates = random.list(tree.freedom());
        let mut moving = MovingTree::new(tree.into());
        moving.place(&numbers, &rates);
        Ok(Case { moving, numbers, rates })
    }

    fn freedom(&self) -> usize {
        self.rates.len()
    }

    fn forward(&mut self, forces: &[f64]) -> Result<DVector<f64>, Error> {
        let mut accelerations = vec![0.0; self.freedom()];
        self.moving.forward(forces, &mut accelerations)?;
        Ok(accelerations.into())
    }

    fn inverse(&mut self, accelerations: &[f64]) -> DVector<f64> {
        let mut forces = vec![0.0; self.freedom()];
        self.moving.inverse(accelerations, &mut forces);
        forces.into()
    }
}

fn expect_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs();
        assert!(off <= tolerance * (1.0 + expected.abs()), "{at}: {found} instead of {expected}");
    }
}

const MOVABLE: [JointKind; 8] = [
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Helical,
    JointKind::Cylindrical,
    JointKind::Spherical,
    JointKind::Planar,
    JointKind::Universal,
    JointKind::Free,
];

/// Random trees of up to 30 bodies, with all kinds of joints.
fn samples(random: &mut Random) -> Result<Vec<Sample>, Error> {
    let kinds = [&MOVABLE[..], &[JointKind::Fixed]].concat();
    let sizes = [1, 2, 3, 5, 8, 12, 20, 30];
    let mut samples: Vec<Sample> =
        sizes.iter().map(|count| Sample::new(*count, &kinds, random)).collect::<Result<_, _>>()?;
    samples.retain(|sample| sample.tree().is_ok_and(|tree| tree.freedom() > 0));
    assert!(samples.len() > 6);
    Ok(samples)
}

/// Numbers of Pinocchio 4.1.0: `rnea`, `aba`, `crba`, energies and the momentum of a tree with a
/// free base. Its free base is the composition of JointModelTranslation and JointModelSpherical, and
/// its joints are added in depth-first order, which `crba` needs.
#[test]
fn the_recursions_agree_with_pinocchio() -> Result<(), Error> {
    let points =
        [[0.1, 0.2, 0.3], [0.4, -0.2, 0.6], [0.1, 0.2, 0.3], [0.9, 0.1, 0.7], [0.2, 0.3, -0.5]];
    let inertia = Matrix3::new(0.3, 0.02, -0.03, 0.02, 0.4, 0.04, -0.03, 0.04, 0.5);
    let mut bodies = vec![None];
    for (k, point) in points.iter().enumerate() {
        let number = k as f64;
        let centre = Vector3::from(*point) + Vector3::new(0.1, 0.05 * number, -0.2);
        let own = inertia * ((number + 1.0) / 2.0);
        bodies.push(Some(MassProperties::new(1.0 + 0.3 * number, centre, &own)?));
    }
    let joints = vec![
        Joint::free(&points[0])?.between("base", [0, 1]),
        Joint::revolute(&points[1], &[1.0, 2.0, 2.0])?.between("hinge", [1, 2]),
        Joint::prismatic(&[2.0, -1.0, 2.0])?.between("slide", [1, 3]),
        Joint::spherical(&points[3])?.between("ball", [2, 4]),
        Joint::helical(&points[4], &[2.0, 3.0, 6.0], &0.15)?.between("screw", [3, 5]),
    ];
    let names = (0..6).map(|at| format!("B{at}")).collect();
    let mechanism = Mechanism::new(names, &[0], joints)?;
    let tree = Tree::new(&mechanism, &bodies, &Vector3::new(0.3, -0.4, -9.7))?;
    let mut numbers = vec![0.2, -0.1, 0.4];
    numbers.extend([10.0, 1.0, -2.0, 4.0].map(|value| value / 11.0));
    numbers.extend([0.7, -0.3]);
    numbers.extend([6.0, 4.0, 2.0, -5.0].map(|value| value / 9.0));
    numbers.push(1.9);
    let rates = [0.5, -0.6, 0.7, 0.8, -0.9, 1.0, -1.1, 1.2, 0.3, -1.4, 0.5, 1.6];
    let mut moving = MovingTree::new(tree.into());
    moving.place(&numbers, &rates);
    let mut forces = [0.0; 12];
    let accelerations = [1.0, -2.0, 3.0, -1.0, 2.0, 0.5, 3.0, -2.0, 1.0, 0.5, -1.5, 2.0];
    moving.inverse(&accelerations, &mut forces);
    let expected = [
        -7.649348234053694,
        -22.038864242675604,
        96.56053748879175,
        8.758597473525654,
        -3.801666164398844,
        3.940877278274332,
        0.3755511456722713,
        35.211975348653,
        1.8454183757558553,
        5.543111178611952,
        -0.9162675296541694,
        11.473616447075072,
    ];
    expect_close(&forces, &expected, 1e-13);
    let forces: [f64; 12] = std::array::from_fn(|k| 0.1 * (k as f64 + 1.0));
    let mut accelerations = [0.0; 12];
    moving.forward(&forces, &mut accelerations)?;
    let expected = [
        1.181966806750593,
        0.29310674642073903,
        -10.562990597352128,
        0.19730899852384753,
        0.7071643756474374,
        -0.574954661166142,
        2.880239966284246,
        0.3500065677212541,
        1.8227564023284795,
        -2.1254758686900512,
        2.9818924591348512,
        0.8646211527693228,
    ];
    expect_close(&accelerations, &expected, 1e-12);
    let mass = moving.mass_matrix();
    let row: Vec<f64> = mass.row(3).iter().copied().collect();
    let expected = [
        -1.7865675774425747,
        1.0989328847874416,
        1.2748557193542291,
        5.057520388076401,
        -0.12446612674904917,
        -0.612037940223725,
        0.2413781925254511,
        -0.01600487110098464,
        0.0699017035644028,
        0.8254830147719425,
        0.533955524564901,
        0.311522686981242,
    ];
    expect_close(&row, &expected, 1e-13);
    assert!((mass.trace() - 49.74552775437495).abs() < 1e-12);
    assert!((moving.kinetic() - 24.751168297682526).abs() < 1e-12);
    assert!((moving.potential() - 40.15043440478574).abs() < 1e-12);
    let momentum = [
        9.315087598029976,
        -3.56282608843819,
        1.440527179525942,
        6.695637200580483,
        -3.4776351924563174,
        12.810933009288945,
    ];
    expect_close(moving.momentum().as_slice(), &momentum, 1e-13);
    Ok(())
}

/// Chains of `n` point masses on rods, in absolute angles `theta`. With the mass `mu_ij` below both
/// joints, `sum_j mu_ij l_i l_j (cos(theta_i - theta_j) theta_j'' + sin(theta_i - theta_j)
/// theta_j'^2) + mu_ii g l_i sin(theta_i) = 0`.
#[test]
fn chains_of_pendulums_satisfy_the_textbook() -> Result<(), Error> {
    let mut random = Random(17);
    for n in [1, 2, 3, 10, 60] {
        let lengths: Vec<f64> = (0..n).map(|_| 1.5 + random.next()).collect();
        let masses: Vec<f64> = (0..n).map(|_| 1.5 + random.next()).collect();
        let (mut joints, mut bodies, mut depth) = (vec![], vec![None], 0.0);
        for k in 0..n {
            let joint = Joint::revolute(&[0.0, 0.0, -depth], &[0.0, 3.0, 0.0])?;
            joints.push(joint.between(format!("J{k}"), [k, k + 1]));
            depth += lengths[k];
            bodies.push(Some(MassProperties::points(&[(masses[k], -Vector3::z() * depth)])?));
        }
        let names = (0..=n).map(|at| format!("B{at}")).collect();
        let mechanism = Mechanism::new(names, &[0], joints)?;
        let tree = Tree::new(&mechanism, &bodies, &Vector3::new(0.0, 0.0, -9.81))?;
        let (angles, rates) = (random.list(n), random.list(n));
        let mut moving = MovingTree::new(tree.into());
        moving.place(&angles, &rates);
        let mut accelerations = vec![0.0; n];
        moving.forward(&vec![0.0; n], &mut accelerations)?;
        let sums = |list: &[f64]| -> Vec<f64> {
            list.iter()
                .scan(0.0, |sum, value| {
                    *sum += value;
                    Some(*sum)
                })
                .collect()
        };
        let (theta, speed, found) = (sums(&angles), sums(&rates), sums(&accelerations));
        for i in 0..n {
            let (mut sum, mut size) = (0.0, 0.0);
            for j in 0..n {
                let below: f64 = masses[i.max(j)..].iter().sum();
                let factor = below * lengths[i] * lengths[j];
                let (sin, cos) = (theta[i] - theta[j]).sin_cos();
                let term = factor * (cos * found[j] + sin * speed[j] * speed[j]);
                (sum, size) = (sum + term, size + term.abs());
            }
            let below: f64 = masses[i..].iter().sum();
            sum += below * 9.81 * lengths[i] * theta[i].sin();
            assert!(sum.abs() < 1e-11 * (size + 1.0), "{n} pendulums, {i}: {sum:e} of {size:e}");
        }
    }
    Ok(())
}

/// Forward and inverse dynamics are inverse to each other. The mass matrix is symmetric and positive
/// definite, its columns are the forces of unit accelerations, and it gives the kinetic energy.
#[test]
fn the_recursions_agree_with_each_other() -> Result<(), Error> {
    let mut random = Random(5);
    for sample in samples(&mut random)? {
        let mut case = Case::new(&sample, &mut random)?;
        let n = case.freedom();
        let forces = random.list(n);
        let accelerations = case.forward(&forces)?;
        let size = 1.0 + accelerations.amax();
        let back = case.inverse(accelerations.as_slice());
        let mass = case.moving.mass_matrix();
        let scale = mass.amax() * size;
        for (found, force) in back.iter().zip(&forces) {
            assert!((found - force).abs() < 1e-13 * scale, "{found} instead of {force}");
        }
        assert_eq!(mass, mass.transpose());
        assert!(mass.clone().cholesky().is_some());
        let still = case.inverse(&vec![0.0; n]);
        let columns: Vec<DVector<f64>> = (0..n)
            .map(|k| {
                let unit: Vec<f64> = (0..n).map(|i| f64::from(i == k)).collect();
                case.inverse(&unit) - &still
            })
            .collect();
        let columns = DMatrix::from_columns(&columns);
        assert!((&columns - &mass).amax() < 1e-12 * (mass.amax() + still.amax()));
        let rates = DVector::from_column_slice(&case.rates);
        let kinetic = 0.5 * rates.dot(&(&mass * &rates));
        assert!((case.moving.kinetic() / kinetic - 1.0).abs() < 1e-12);
    }
    Ok(())
}

/// The power of the joint forces is the time derivative of the energy, as a difference quotient. So
/// is the force of gravity that of the momentum, without a ground.
#[test]
fn power_and_gravity_change_energy_and_momentum() -> Result<(), Error> {
    let mut random = Random(23);
    let h = 1e-5;
    for mut sample in samples(&mut random)? {
        // one root, which is free, so that the ground does not act on the bodies
        sample.parts[0] = Part { kind: JointKind::Free, ends: [0, 1], ..sample.parts[0].clone() };
        for part in &mut sample.parts[1..] {
            part.ends = part.ends.map(|end| end.max(1));
            if part.ends[0] == part.ends[1] {
                part.ends[0] = 1;
                part.ends[1] = part.ends[1].max(2);
            }
        }
        let Ok(tree) = sample.tree() else { continue };
        let mut case = Case::new(&sample, &mut random)?;
        let n = case.freedom();
        let mut forces = random.list(n);
        forces[..6].fill(0.0);
        let accelerations = case.forward(&forces)?;
        let mut slopes = vec![0.0; case.numbers.len()];
        tree.slopes(&case.numbers, &case.rates, &mut slopes);
        let mut at = |t: f64| {
            let step = |x: &[f64], y: &[f64]| -> Vec<f64> {
                x.iter().zip(y).map(|(x, y)| x + t * y).collect()
            };
            let numbers = step(&case.numbers, &slopes);
            let rates = step(&case.rates, accelerations.as_slice());
            case.moving.place(&numbers, &rates);
            (case.moving.kinetic() + case.moving.potential(), case.moving.momentum())
        };
        let (before, after) = (at(-h), at(h));
        let power: f64 = forces.iter().zip(&case.rates).map(|(force, rate)| force * rate).sum();
        let slope = (after.0 - before.0) / (2.0 * h);
        let size = 1.0 + after.0.abs() + accelerations.amax();
        assert!((slope - power).abs() < 1e-7 * size, "{slope} instead of {power}");
        let mass: f64 = sample.bodies.iter().flatten().map(MassProperties::mass).sum();
        let force = (after.1 - before.1) / (2.0 * h);
        let off = (force.fixed_rows::<3>(3) - sample.gravity * mass).amax();
        assert!(off < 1e-7 * (1.0 + after.1.amax()) * size, "{off:e}");
    }
    Ok(())
}

/// Poses and velocities are consistent: the difference quotient of the pose is the velocity.
#[test]
fn velocities_are_derivatives_of_poses() -> Result<(), Error> {
    use affinor::group::{LieGroup, Se3};
    let mut random = Random(29);
    for sample in samples(&mut random)? {
        let mut case = Case::new(&sample, &mut random)?;
        let velocities = case.moving.velocities();
        let mut slopes = vec![0.0; case.numbers.len()];
        case.moving.tree().slopes(&case.numbers, &case.rates, &mut slopes);
        let h = 1e-5;
        let mut at = |t: f64| {
            let numbers: Vec<f64> =
                case.numbers.iter().zip(&slopes).map(|(x, slope)| x + t * slope).collect();
            case.moving.place(&numbers, &case.rates);
            case.moving.poses()
        };
        let (before, after) = (at(-h), at(h));
        for ((before, after), velocity) in before.iter().zip(&after).zip(&velocities) {
            let found = Se3.log(&Se3.between(before, after))? / (2.0 * h);
            assert!((found - velocity).amax() < 1e-6 * (1.0 + velocity.amax()));
        }
    }
    Ok(())
}

const SINGLE: [JointKind; 3] = [JointKind::Revolute, JointKind::Prismatic, JointKind::Helical];

/// Another ground frame changes no acceleration, even a distant one.
#[test]
fn another_ground_frame_changes_nothing() -> Result<(), Error> {
    let mut random = Random(41);
    for (count, distance) in [(4, 1.0), (15, 10.0), (30, 1000.0)] {
        let sample = Sample::new(count, &SINGLE, &mut random)?;
        let motion = Isometry3::new(random.vector() * distance, random.vector() * 2.0);
        let turned = |v: [f64; 3]| (motion.rotation * Vector3::from(v)).into();
        let mut moved = sample.clone();
        for part in &mut moved.parts {
            let data = &mut part.data;
            data.point = (motion * nalgebra::Point3::from(data.point)).coords.into();
            data.axis = turned(data.axis);
        }
        moved.bodies = moved.bodies.iter().map(|own| own.map(|own| own.moved(&motion))).collect();
        moved.gravity = motion.rotation * moved.gravity;
        let (mut case, mut other) =
            (Case::new(&sample, &mut Random(3))?, Case::new(&moved, &mut Random(3))?);
        let forces = random.list(count);
        let (found, expected) = (other.forward(&forces)?, case.forward(&forces)?);
        expect_close(found.as_slice(), expected.as_slice(), 1e-12 * distance.max(10.0));
        let lengths = [&case, &other].map(|case| case.moving.tree().length());
        assert!((lengths[0] / lengths[1] - 1.0).abs() < 1e-9 * distance);
    }
    Ok(())
}

/// Millimetres and tonnes describe the same motion as metres and kilograms.
#[test]
fn units_change_nothing() -> Result<(), Error> {
    let mut random = Random(43);
    for count in [3, 11, 30] {
        let sample = Sample::new(count, &SINGLE, &mut random)?;
        let mut small = sample.clone();
        let scaled = |v: [f64; 3]| v.map(|x| x * 1000.0);
        for part in &mut small.parts {
            part.data.point = scaled(part.data.point);
            part.data.pitch *= 1000.0;
        }
        for body in small.bodies.iter_mut().flatten() {
            let inertia = body.inertia_matrix() * 1000.0;
            *body = MassProperties::new(body.mass() / 1000.0, body.centre() * 1000.0, &inertia)?;
        }
        small.gravity *= 1000.0;
        let slides: Vec<bool> =
            sample.parts.iter().map(|part| part.kind == JointKind::Prismatic).collect();
        let (numbers, rates, forces) = (random.list(count), random.list(count), random.list(count));
        let units = |list: &[f64], slide: f64, turn: f64| -> Vec<f64> {
            let unit = |slides: &bool| if *slides { slide } else { turn };
            list.iter().zip(&slides).map(|(x, slides)| x * unit(slides)).collect()
        };
        let mut moving = MovingTree::new(sample.tree()?.into());
        moving.place(&numbers, &rates);
        let mut expected = vec![0.0; count];
        moving.forward(&forces, &mut expected)?;
        let mut moving = MovingTree::new(small.tree()?.into());
        moving.place(&units(&numbers, 1000.0, 1.0), &units(&rates, 1000.0, 1.0));
        let mut found = vec![0.0; count];
        moving.forward(&units(&forces, 1.0, 1000.0), &mut found)?;
        expect_close(&found, &units(&expected, 1000.0, 1.0), 1e-11);
    }
    Ok(())
}

/// A body that is split into two parts, which are fixed to each other, moves as before. So do
/// bodies and joints in another order.
#[test]
fn parts_and_order_change_nothing() -> Result<(), Error> {
    let mut random = Random(47);
    for count in [2, 6, 18] {
        let sample = Sample::new(count, &SINGLE, &mut random)?;
        let mut split = sample.clone();
        let Some(whole) = sample.bodies[1] else { continue };
        let part = MassProperties::points(&[
            (0.1, whole.centre() + Vector3::new(0.1, 0.0, 0.0)),
            (0.1, whole.centre() - Vector3::new(0.0, 0.1, 0.0)),
            (0.1, whole.centre() - Vector3::new(0.0, 0.0, 0.1)),
        ])?;
        split.bodies[1] = Some(whole.subtract(&part)?);
        split.bodies.push(Some(part));
        let first = split.parts[0].clone();
        split.parts.push(Part { kind: JointKind::Fixed, ends: [count + 1, 1], ..first });
        let (mut case, mut other) =
            (Case::new(&sample, &mut Random(3))?, Case::new(&split, &mut Random(3))?);
        let forces = random.list(count);
        let expected = case.forward(&forces)?;
        expect_close(other.forward(&forces)?.as_slice(), expected.as_slice(), 1e-11);
        // reversed lists; body 0 is the ground
        let mut reversed = sample.clone();
        reversed.parts.reverse();
        reversed.bodies[1..].reverse();
        for part in &mut reversed.parts {
            part.ends = part.ends.map(|end| if end == 0 { 0 } else { count + 1 - end });
        }
        let backwards = |list: &[f64]| -> Vec<f64> { list.iter().rev().copied().collect() };
        let mut moving = MovingTree::new(reversed.tree()?.into());
        moving.place(&backwards(&case.numbers), &backwards(&case.rates));
        let mut found = vec![0.0; count];
        moving.forward(&backwards(&forces), &mut found)?;
        expect_close(&found, &backwards(expected.as_slice()), 1e-11);
    }
    Ok(())
}

/// Errors name the joints of a loop, and a joint that moves no mass.
#[test]
fn loops_and_bodies_without_mass_are_errors() -> Result<(), Error> {
    let hinge = |x: f64| Joint::revolute(&[x, 0.0, 0.0], &[0.0, 0.0, 1.0]);
    let names = |count: usize| (0..count).map(|at| format!("B{at}")).collect::<Vec<_>>();
    let ball = MassProperties::ball(1.0)?;
    let joints = vec![
        hinge(0.0)?.between("a", [0, 1]),
        hinge(1.0)?.between("b", [1, 2]),
        hinge(2.0)?.between("c", [2, 0]),
    ];
    let mechanism = Mechanism::new(names(3), &[0], joints)?;
    let error = Tree::new(&mechanism, &[None, Some(ball), Some(ball)], &Vector3::zeros());
    let text = error.unwrap_err().to_string();
    assert!(text.contains("the joints `a`, `b`, `c` form a loop"), "{text}");
    let joints = vec![hinge(0.0)?.between("a", [0, 1]), hinge(1.0)?.between("b", [1, 2])];
    let mechanism = Mechanism::new(names(3), &[0], joints)?;
    let error = Tree::new(&mechanism, &[None, Some(ball), None], &Vector3::zeros());
    let text = error.unwrap_err().to_string();
    assert!(text.contains("beyond the joint `b`"), "{text}");
    // a point mass on the axis of a hinge
    let point = MassProperties::points(&[(1.0, Vector3::new(1.0, 0.0, 5.0))])?;
    let error = Tree::new(&mechanism, &[None, Some(ball), Some(point)], &Vector3::zeros());
    assert!(error.unwrap_err().to_string().contains("beyond the joint `b`"));
    assert!(Tree::new(&mechanism, &[None], &Vector3::zeros()).is_err());
    Ok(())
}
