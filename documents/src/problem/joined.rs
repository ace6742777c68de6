//! Problems with bodies and joints: their space, inertia, constraints and initial velocity.
//!
//! The frame of each body is that of the ground at the initial position. So every initial element
//! is the identity, and a point or an axis has the same components in all bodies.

use super::body::InertiaKeys;
use super::joint_keys::{BodyKeys, JointKeys};
use super::keys::Keys;
use super::reader::{Reader, Value};
use crate::input::{
    InputError, Place,
    forms::{Number, OneOrEach, Text, VectorText},
    shown,
};
use affinor::mechanism::{JointKind, Mechanism};
use affinor::nalgebra::{DMatrix, DVector, Vector3};

/// A row of constraints fails to be independent below this size, relative to its own size.
const DEPENDENT: f64 = 1e-9;
/// Given rates of joints are consistent up to this relative error.
const RATES: f64 = 1e-9;

/// A vector whose components are formulas, with its value.
#[derive(Clone)]
struct Axis {
    formulas: [String; 3],
    value: Vector3<f64>,
}

/// A constraint between two bodies, in the components of the ground.
enum Constraint {
    /// The difference of a component of the positions of a point in both bodies.
    Position(usize, Axis),
    /// The product of a direction of the first body and one of the second, less its initial value.
    Product(Axis, Axis),
    /// The displacement of a point between both bodies, along a direction of the first.
    Displacement(Axis, Axis),
}

/// A body in a constraint: the number of its factor, or `None` for the ground.
type Factor = Option<usize>;

/// The keys of a problem with bodies and joints, without these: the equations of motion on the
/// product of one SE(3) for each moving body. Also returns notes.
pub(super) fn on_product(
    mut keys: Keys,
    reader: &Reader,
    parameters: &[Option<Value>],
) -> Result<(Keys, Vec<String>), InputError> {
    let (Some(bodies), Some(joints)) = (keys.bodies.take(), keys.joints.take()) else {
        let error = reader.source.refused("bodies", "bodies need joints, and joints need bodies");
        return Err(error.help("give both [[bodies]] and [[joints]]"));
    };
    let of_mechanisms = "a problem with bodies and joints";
    let others = ["space", "definition", "metric", "inertia", "constraints", "connection"];
    reader.refuse(of_mechanisms, &others)?;
    reader.refuse(of_mechanisms, &["initial.element", "initial.coordinates", "initial.parts"])?;
    // a parameter that only the ensemble defines counts as 1 for the choice of constraints
    let mut values = vec![];
    for name in 0..reader.names.len() {
        let value = parameters.get(name).and_then(Option::as_ref);
        values.push(value.map_or(Ok(1.0), |value| value.at(&values))?);
    }
    let system = System::read(&bodies, &joints, reader, &values)?;
    let moving = system.factors.iter().flatten().count();
    let whole = |content: String| Text { content, span: 0..0 };
    keys.space = Some(whole(vec!["se3"; moving].join("+")));
    let (constraints, notes) = system.constraints(reader)?;
    keys.constraints = Some(constraints.into_iter().map(whole).collect());
    if let Some(gravity) = keys.gravity.take() {
        let place = reader.source.key("gravity");
        if keys.forces.potential.is_some() {
            let error = InputError::usage("the potential is given twice").at(&place);
            return Err(error.help("give one of gravity, forces.potential"));
        }
        let [x, y, z] = formulas(&gravity, &place)?;
        let weight = |body: usize| {
            let (mass, number) = match moving {
                1 => ("mass".to_string(), String::new()),
                _ => (format!("mass_{}", body + 1), format!("_{}", body + 1)),
            };
            let centre = [1, 2, 3].map(|k| format!("centre{k}{number}"));
            let at = [0, 1, 2].map(|i| image(Some(body), moving, i, &centre, true));
            format!("{mass}*(({x})*({}) + ({y})*({}) + ({z})*({}))", at[0], at[1], at[2])
        };
        let all: Vec<String> = (0..moving).map(weight).collect();
        keys.forces.potential = Some(whole(format!("-({})", all.join(" + "))));
    }
    if let Some(velocity) = system.velocity(&joints, reader, &values)? {
        if keys.initial.velocity.is_some() {
            let error = reader.source.refused("initial.velocity", "the velocity is given twice");
            return Err(error.help("give the rates of joints, or initial.velocity"));
        }
        let numbers = velocity.iter().map(|v| Number(whole(format!("{v:e}"))));
        keys.initial.velocity = Some(VectorText::List(numbers.collect()));
    } else if keys.initial.velocity.is_none() {
        let rest = std::iter::repeat_with(|| Number(whole("0".into()))).take(6 * moving);
        keys.initial.velocity = Some(VectorText::List(rest.collect()));
    }
    let inertia = bodies.into_iter().filter(|body| !body.fixed).map(|body| body.inertia);
    let inertia: Vec<InertiaKeys> = inertia.flatten().collect();
    keys.inertia = Some(match <[InertiaKeys; 1]>::try_from(inertia) {
        Ok([one]) => OneOrEach::One(one),
        Err(each) => OneOrEach::Each(each),
    });
    Ok((keys, notes))
}

/// Bodies and joints with their numbers.
struct System {
    /// For each body, the number of its factor.
    factors: Vec<Factor>,
    joints: Vec<(String, [usize; 2], JointKind, Vec<Constraint>)>,
    mechanism: Mechanism<f64>,
}

impl System {
    fn read(
        bodies: &[BodyKeys],
        joints: &[JointKeys],
        reader: &Reader,
        values: &[f64],
    ) -> Result<Self, InputError> {
        let names: Vec<String> = bodies.iter().map(|body| body.name.content.clone()).collect();
        let mut next = 0;
        let mut factors = vec![];
        for body in bodies {
            if !body.fixed && body.inertia.is_none() {
                let message = format!("the moving body `{}` has no inertia", shown(&body.name));
                let help = "give it parts, as in inertia.parts = [{ shape = \"rod\", length = 1, mass = 1 }], or fixed = true";
                return Err(InputError::usage(message)
                    .at(&reader.source.at(&body.name))
                    .help(help));
            }
            factors.push((!body.fixed).then_some(next));
            next += usize::from(!body.fixed);
        }
        if factors.iter().all(|factor| factor.is_some()) || next == 0 {
            let error =
                reader.source.refused("bodies", "one body must be fixed, and one must move");
            return Err(error.help("write fixed = true in the table of the ground"));
        }
        let (mut all, mut twists) = (vec![], vec![]);
        for (at, keys) in joints.iter().enumerate() {
            let name =
                keys.name.as_ref().map_or(format!("J{}", at + 1), |name| name.content.clone());
            let ends = keys.ends(&name, &names, reader.source, at)?;
            let kind = keys.kind(reader.source, at)?;
            let place = |key: &str| reader.source.key(&format!("joints.{at}.{key}"));
            let axis = |key: &str, list: &Option<Vec<Number>>| match list {
                Some(list) => Axis::read(list, &place(key), reader, values),
                None => Ok(Axis::unit(3)),
            };
            let point = axis("at", &keys.at)?;
            let (first, second) =
                (axis("axis", &keys.axis)?, axis("second_axis", &keys.second_axis)?);
            if matches!(kind, JointKind::Helical | JointKind::Subgroup) {
                let message = format!("the motion of a {} joint is not supported", kind.name());
                let error = InputError::usage(message).at(&reader.source.at(&keys.kind));
                return Err(error.help("use other joints, or `affinor mobility`"));
            }
            let vector = |key: &str, list: &[Number]| {
                Ok(Axis::read(list, &place(key), reader, values)?.value.into())
            };
            let joint = keys.joint(kind, &vector, None, vec![], &place)?;
            twists.push(joint.between(&name, ends));
            all.push((name, ends, kind, constraints(kind, &point, &first, &second)));
        }
        let fixed: Vec<usize> = (0..bodies.len()).filter(|at| bodies[*at].fixed).collect();
        let mechanism = Mechanism::new(names, &fixed, twists).map_err(|error| {
            let help = "connect every body by a joint, directly or through other bodies";
            InputError::from(error).or_at(&reader.source.key("bodies")).help(help)
        })?;
        Ok(System { factors, joints: all, mechanism })
    }

    /// The formulas of the constraints that are independent at the initial position, and notes
    /// about those that are left out.
    fn constraints(&self, reader: &Reader) -> Result<(Vec<String>, Vec<String>), InputError> {
        let moving = self.factors.iter().flatten().count();
        let (mut basis, mut texts, mut left): (Vec<DVector<f64>>, _, _) = (vec![], vec![], vec![]);
        for (name, ends, _, constraints) in &self.joints {
            let ends = ends.map(|body| self.factors[body]);
            for constraint in constraints {
                let row = constraint.row(ends, moving);
                let mut rest = row.clone();
                // twice, against loss of orthogonality
                for _ in 0..2 {
                    basis.iter().for_each(|own| rest -= own * own.dot(&rest));
                }
                if rest.norm() > DEPENDENT * row.norm() {
                    basis.push(rest.normalize());
                    texts.push(constraint.formula(ends, moving));
                } else {
                    left.push(name.clone());
                }
            }
        }
        if texts.is_empty() {
            let error = reader.source.refused("joints", "the joints do not constrain the bodies");
            return Err(error.help("give a joint with fewer degrees of freedom"));
        }
        if texts.len() == 6 * moving {
            let error =
                reader.source.refused("joints", "the joints lock all bodies at this position");
            return Err(InputError { refusal: crate::input::Refusal::Mathematics, ..error }
                .help("remove a joint; `affinor mobility` finds redundant joints"));
        }
        let mut notes = vec![];
        if !left.is_empty() {
            let count = left.len();
            left.dedup();
            notes.push(format!(
                "{count} constraints of the joints {} follow from the others at the initial \
                 position and are left out: their reactions are 0",
                left.join(", ")
            ));
        }
        Ok((texts, notes))
    }

    /// The initial velocities of the moving bodies for given rates of joints; `None` if no rates
    /// are given. The other rates have the least sum of squares.
    fn velocity(
        &self,
        joints: &[JointKeys],
        reader: &Reader,
        values: &[f64],
    ) -> Result<Option<Vec<f64>>, InputError> {
        let mut given = vec![];
        let offsets = self.mechanism.offsets();
        for (at, keys) in joints.iter().enumerate() {
            let Some(number) = &keys.rate else { continue };
            let place = reader.source.at(&number.0);
            if self.mechanism.joints()[at].freedom() != 1 {
                let error = InputError::usage("this joint has several rates").at(&place);
                return Err(error.help("give the rates of revolute and prismatic joints"));
            }
            let twist = &self.mechanism.joints()[at].twists()[0];
            // the rate refers to an axis of length 1
            let rotation = twist[..3].iter().map(|w| w * w).sum::<f64>().sqrt();
            let size = match rotation > 0.0 {
                true => rotation,
                false => twist[3..].iter().map(|u| u * u).sum::<f64>().sqrt(),
            };
            given.push((offsets[at], reader.value(number)?.at(values)? / size, place));
        }
        let Some((.., place)) = given.first() else { return Ok(None) };
        let jacobian = self.mechanism.jacobian()?.to_dense();
        let columns = self.mechanism.freedom();
        let mut matrix = DMatrix::zeros(jacobian.len() + given.len(), columns);
        let mut right = DVector::zeros(matrix.nrows());
        for (i, row) in jacobian.iter().enumerate() {
            row.iter().enumerate().for_each(|(k, value)| matrix[(i, k)] = *value);
        }
        for (i, (column, rate, _)) in given.iter().enumerate() {
            matrix[(jacobian.len() + i, *column)] = 1.0;
            right[jacobian.len() + i] = *rate;
        }
        let svd = matrix.clone().svd(true, true);
        let cut = 1e-10 * svd.singular_values.max();
        let rates = svd.solve(&right, cut).map_err(InputError::mathematics)?;
        let rest = (&matrix * &rates - &right).norm();
        if rest > RATES * right.norm() {
            let message =
                format!("the joints do not allow these rates: they are off by {rest:.2e}");
            let error = InputError::mathematics(message).at(place);
            return Err(
                error.help("give rates that close all loops; `affinor mobility` prints them")
            );
        }
        Ok(Some(self.velocities(&rates, &offsets)))
    }

    /// The velocities of the moving bodies for rates of all joints.
    fn velocities(&self, rates: &DVector<f64>, offsets: &[usize]) -> Vec<f64> {
        let mut known: Vec<Option<DVector<f64>>> =
            self.factors.iter().map(|f| f.is_none().then(|| DVector::zeros(6))).collect();
        for _ in 0..known.len() {
            for (joint, first) in self.mechanism.joints().iter().zip(offsets) {
                let mut relative = DVector::zeros(6);
                for (k, twist) in joint.twists().iter().enumerate() {
                    relative += DVector::from_column_slice(twist) * rates[first + k];
                }
                let [a, b] = joint.bodies;
                match (&known[a], &known[b]) {
                    (Some(own), None) => known[b] = Some(own + relative),
                    (None, Some(own)) => known[a] = Some(own - relative),
                    _ => {}
                }
            }
        }
        let moving = self.factors.iter().zip(known).filter(|(factor, _)| factor.is_some());
        moving.flat_map(|(_, v)| v.map_or(vec![0.0; 6], |v| v.as_slice().to_vec())).collect()
    }
}

/// The formulas of the components of a vector.
fn formulas(list: &[Number], place: &Place) -> Result<[String; 3], InputError> {
    let texts: Vec<String> = list.iter().map(|number| number.0.content.clone()).collect();
    <[String; 3]>::try_from(texts).map_err(|list| {
        let message = format!("the vector has {} components instead of 3", list.len());
        InputError::usage(message).at(place)
    })
}

impl Axis {
    fn read(
        list: &[Number],
        place: &Place,
        reader: &Reader,
        values: &[f64],
    ) -> Result<Self, InputError> {
        let formulas = formulas(list, place)?;
        let numbers = Value::all(&reader.values(list)?, values)?;
        Ok(Axis { formulas, value: Vector3::from_column_slice(&numbers) })
    }

    /// A basis vector; zero for the index 3.
    fn unit(k: usize) -> Self {
        let entry = |i: usize| if i == k { "1".to_string() } else { "0".into() };
        let value = Vector3::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        Axis { formulas: std::array::from_fn(entry), value }
    }

    /// The cross product with a basis vector.
    fn cross_unit(&self, k: usize) -> Self {
        let entry = |i: usize| match (i + 3 - k) % 3 {
            // (w x e_k)_(k+1) = w_(k+2), (w x e_k)_(k+2) = -w_(k+1)
            1 => format!("({})", self.formulas[(k + 2) % 3]),
            2 => format!("(-({}))", self.formulas[(k + 1) % 3]),
            _ => "0".into(),
        };
        let value = self.value.cross(&Axis::unit(k).value);
        Axis { formulas: std::array::from_fn(entry), value }
    }

    /// Two vectors orthogonal to this one.
    fn normals(&self) -> [Axis; 2] {
        let largest = self.value.iamax();
        [1, 2].map(|k| self.cross_unit((largest + k) % 3))
    }
}

/// The constraints of a joint.
fn constraints(kind: JointKind, point: &Axis, axis: &Axis, second: &Axis) -> Vec<Constraint> {
    use Constraint::{Displacement, Position, Product};
    let positions = || (0..3).map(|i| Position(i, point.clone()));
    let parallel = || axis.normals().map(|normal| Product(normal, axis.clone()));
    let equal = || [0, 1, 2].map(|k| Product(Axis::unit(k), Axis::unit((k + 1) % 3)));
    let across = || axis.normals().map(|normal| Displacement(point.clone(), normal));
    match kind {
        JointKind::Revolute => positions().chain(parallel()).collect(),
        JointKind::Prismatic => equal().into_iter().chain(across()).collect(),
        JointKind::Cylindrical => parallel().into_iter().chain(across()).collect(),
        JointKind::Planar => {
            let along = Displacement(point.clone(), axis.clone());
            parallel().into_iter().chain([along]).collect()
        }
        JointKind::Spherical => positions().collect(),
        JointKind::Universal => {
            positions().chain([Product(axis.clone(), second.clone())]).collect()
        }
        JointKind::Fixed => positions().chain(equal()).collect(),
        JointKind::Helical | JointKind::Subgroup => vec![],
    }
}

/// The image of a vector in a body, component `i`, with the translation for a point.
fn image(body: Factor, moving: usize, i: usize, vector: &[String; 3], is_point: bool) -> String {
    let Some(body) = body else { return format!("({})", vector[i]) };
    let number = if moving > 1 { format!("_{}", body + 1) } else { String::new() };
    let entry = |k: usize| format!("g{}{k}{number}", i + 1);
    let factors = (0..3).filter(|k| vector[*k] != "0");
    let terms = factors.map(|k| match &*vector[k] {
        "1" => entry(k + 1),
        factor => format!("{}*({factor})", entry(k + 1)),
    });
    let mut terms: Vec<String> = terms.collect();
    if is_point {
        terms.push(entry(4));
    }
    if terms.is_empty() { "0".into() } else { format!("({})", terms.join(" + ")) }
}

impl Constraint {
    fn formula(&self, [a, b]: [Factor; 2], moving: usize) -> String {
        let point = |body: Factor, i: usize, p: &Axis| image(body, moving, i, &p.formulas, true);
        let along = |body: Factor, i: usize, u: &Axis| image(body, moving, i, &u.formulas, false);
        let sum = |terms: [String; 3]| terms.join(" + ");
        match self {
            Constraint::Position(i, p) => format!("{} - {}", point(b, *i, p), point(a, *i, p)),
            Constraint::Product(u, v) => {
                let at = sum([0, 1, 2].map(|i| format!("{}*{}", along(a, i, u), along(b, i, v))));
                let start = [0, 1, 2].map(|i| format!("({})*({})", u.formulas[i], v.formulas[i]));
                match u.value.dot(&v.value) == 0.0 {
                    true => at,
                    false => format!("{at} - ({})", sum(start)),
                }
            }
            Constraint::Displacement(p, u) => sum([0, 1, 2]
                .map(|i| format!("({} - {})*{}", point(b, i, p), point(a, i, p), along(a, i, u)))),
        }
    }

    /// The gradient at the initial position.
    fn row(&self, ends: [Factor; 2], moving: usize) -> DVector<f64> {
        // the derivatives by the angular and the linear velocity of the second body; those of the
        // first body are the negative ones
        let (turn, shift) = match self {
            Constraint::Position(i, p) => {
                let unit = Axis::unit(*i).value;
                (p.value.cross(&unit), unit)
            }
            Constraint::Product(u, v) => (v.value.cross(&u.value), Vector3::zeros()),
            Constraint::Displacement(p, u) => (p.value.cross(&u.value), u.value),
        };
        let mut row = DVector::zeros(6 * moving);
        for (factor, sign) in ends.into_iter().zip([-1.0, 1.0]) {
            if let Some(factor) = factor {
                row.fixed_rows_mut::<3>(6 * factor).copy_from(&(turn * sign));
                row.fixed_rows_mut::<3>(6 * factor + 3).copy_from(&(shift * sign));
            }
        }
        row
    }
}
