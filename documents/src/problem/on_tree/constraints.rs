//! Constraints of motions in joint coordinates: loops, contacts, motors and formulas.

use super::OnTree;
use super::names::TreeNames;
use crate::input::{InputError, Place, forms::Text, shown};
use crate::problem::joint::{components, vector};
use crate::problem::joint_keys::{ContactKeys, body_index};
use crate::problem::keys::Keys;
use crate::problem::reader::{Reader, Value, Written};
use affinor::mechanics::formula::{Formula, Symbol, affine_terms};
use affinor::mechanics::systems::tree::{
    Closure, Contact, ContactShape, Hold, Motor, TreeConstraint, TreeState, TreeSystem,
    Unsatisfied, Violator,
};
use affinor::mechanism::{Cut, Tree};
use nalgebra::Vector3;

/// Coordinates and rates of a file may be rounded by this much, in units of the mechanism.
const ROUNDED: f64 = 0.01;
/// A change that is mentioned in a note.
const MOVED: f64 = 1e-6;

/// The constraints of a file, without those of its loops and motors.
#[derive(Clone, Debug)]
pub(super) struct Constraints {
    contacts: Vec<RollingContact>,
    positions: Vec<Written>,
    velocities: Vec<Written>,
}

#[derive(Clone, Debug)]
struct RollingContact {
    body: usize,
    kind: ContactKind,
    /// The point, the axis and the normal.
    vectors: [Option<Vec<Value>>; 3],
    radius: Option<Value>,
    place: Place,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ContactKind {
    Wheel,
    Ball,
    Edge,
}

/// The part of a file that requires a constraint.
#[derive(Clone, Debug)]
pub(super) enum Cause {
    /// A loop, in which this body was cut.
    Loop(usize),
    /// A key of the file.
    Key(Place),
}

impl ContactKind {
    const ALL: [(&'static str, Self); 3] =
        [("wheel", Self::Wheel), ("ball", Self::Ball), ("edge", Self::Edge)];
}

impl Constraints {
    pub fn read(keys: &Keys, names: &[String], reader: &Reader) -> Result<Self, InputError> {
        let contacts = keys.contacts.iter().flatten().enumerate();
        let contacts = contacts.map(|(at, own)| RollingContact::read(own, at, names, reader));
        let contacts: Result<_, InputError> = contacts.collect();
        let written = |list: &[Text]| list.iter().map(|text| reader.written(text)).collect();
        Ok(Constraints {
            contacts: contacts?,
            positions: written(keys.constraints.as_deref().unwrap_or_default()),
            velocities: written(keys.velocity_constraints()),
        })
    }
}

impl RollingContact {
    fn read(
        keys: &ContactKeys,
        at: usize,
        names: &[String],
        reader: &Reader,
    ) -> Result<Self, InputError> {
        let source = reader.source;
        let found = ContactKind::ALL.iter().find(|(name, _)| *name == &*keys.kind);
        let Some((name, kind)) = found else {
            let message = format!("there is no contact of the type `{}`", shown(&keys.kind));
            let error = InputError::usage(message).at(&source.at(&keys.kind));
            let names = ContactKind::ALL.map(|(name, _)| name);
            return Err(error.help(format!("the types are {}", names.join(", "))));
        };
        let path = |key: &str| format!("contacts.{at}.{key}");
        let needed = [("axis", *kind != ContactKind::Ball), ("radius", *kind != ContactKind::Edge)];
        for (key, is_needed) in needed {
            let is_given = source.has_key(&path(key));
            if is_needed && !is_given {
                let error = InputError::usage(format!("a contact of type {name} needs `{key}`"));
                let example = if key == "axis" { "axis = [0, 1, 0]" } else { "radius = 0.3" };
                let help = format!("give the key, as in {example}");
                return Err(error.at(&source.at(&keys.kind)).help(help));
            }
            if is_given && !is_needed {
                let message = format!("a contact of type {name} does not use the key `{key}`");
                return Err(source.refused(&path(key), message).help("leave the key out"));
            }
        }
        let vector = |key: &str, list: &Option<Vec<_>>| match list {
            Some(list) => components::<3>(list, &source.key(&path(key)), reader).map(Some),
            None => Ok(None),
        };
        Ok(RollingContact {
            body: body_index(&keys.body, names, source)?,
            kind: *kind,
            vectors: [
                Some(components::<3>(&keys.at, &source.key(&path("at")), reader)?),
                vector("axis", &keys.axis)?,
                vector("normal", &keys.normal)?,
            ],
            radius: reader.optional(&keys.radius)?,
            place: source.at(&keys.kind),
        })
    }

    fn at(&self, tree: &Tree, values: &[f64]) -> Result<TreeConstraint, InputError> {
        let [point, axis, normal] = self.vectors.each_ref().map(|list| vector(list, values));
        let (point, axis) = (point?, axis?);
        let normal = if self.vectors[2].is_some() { normal? } else { Vector3::z() };
        let refused =
            |message: &str, help: &str| Err(InputError::usage(message).at(&self.place).help(help));
        if normal.norm() == 0.0 {
            return refused("the normal of the plane is zero", "give a vector, as [0, 0, 1]");
        }
        let across = normal.normalize().cross(&axis).norm();
        if self.kind != ContactKind::Ball && across <= 1e-9 * axis.norm() {
            return match self.kind {
                ContactKind::Wheel => refused(
                    "the axis of the wheel is orthogonal to the plane: there is no point of contact",
                    "give an axis that is not parallel to the normal of the plane",
                ),
                _ => refused(
                    "the edge is orthogonal to the plane: there is no direction in it",
                    "give an axis along the edge",
                ),
            };
        }
        let radius = match &self.radius {
            Some(radius) => radius.positive(values)?,
            None => 0.0,
        };
        let shape = match self.kind {
            ContactKind::Ball => ContactShape::Ball(radius),
            ContactKind::Wheel => ContactShape::Wheel(radius, axis.normalize()),
            ContactKind::Edge => ContactShape::Edge(axis.normalize()),
        };
        let centre = tree.point(self.body, &point);
        Ok(TreeConstraint::Contact(Contact::at_home(tree, centre, shape, &normal)))
    }
}

impl OnTree {
    /// All constraints, each with its cause: those of loops, contacts, motors, and formulas.
    pub(super) fn constraints(
        &self,
        cut: &Cut,
        tree: &Tree,
        names: &TreeNames,
        values: &[f64],
    ) -> Result<Vec<(Cause, TreeConstraint)>, InputError> {
        let mut all: Vec<(Cause, TreeConstraint)> = vec![];
        for pair in &cut.copies {
            let closure = TreeConstraint::Closure(Closure::new(tree, *pair));
            all.push((Cause::Loop(pair[0]), closure));
        }
        for contact in &self.constraints.contacts {
            if self.bodies[contact.body].1 {
                let error = InputError::usage("a fixed body cannot roll").at(&contact.place);
                return Err(error.help("name a body that moves"));
            }
            all.push((Cause::Key(contact.place.clone()), contact.at(tree, values)?));
        }
        for (at, joint) in self.joints.iter().enumerate() {
            if let Some(motor) = &joint.motor {
                all.push((Cause::Key(motor.place()), joint.motor(motor, at, tree, names)?));
            }
        }
        let numbers = names.states - names.sizes[1];
        for written in &self.constraints.positions {
            let formula = names.formula(written.text(), numbers).map_err(|error| {
                let known = names.list(..numbers).iter().chain(names.parameters());
                let known = known.cloned().collect::<Vec<_>>().join(", ");
                written.refused(error, format!("a constraint may contain {known}"))
            })?;
            let constraint = TreeConstraint::Position(formula.differentiated());
            all.push((Cause::Key(written.place()), constraint));
        }
        for written in &self.constraints.velocities {
            let is_rate =
                |name: &str| names.list(numbers..names.states).iter().any(|own| own == name);
            let known = names.list(..names.states).iter().chain(names.parameters());
            let known = known.cloned().collect::<Vec<_>>().join(", ");
            let help = format!("a constraint on the rates may contain {known}");
            let refused = |error| written.refused(error, help.clone());
            let terms = affine_terms(written.text(), &is_rate).map_err(refused)?;
            if !terms.linear {
                let error = InputError::usage("the constraint contains no rate");
                return Err(error.at(&written.place()).help("write it among `constraints`"));
            }
            let formula = names.formula(written.text(), names.states).map_err(refused)?;
            let constraint = TreeConstraint::Velocity(formula.differentiated());
            all.push((Cause::Key(written.place()), constraint));
        }
        Ok(all)
    }

    /// Satisfies the constraints at the initial state. Returns notes on what was changed.
    pub(super) fn assemble(
        &self,
        system: &TreeSystem,
        causes: &[Cause],
        state: &mut TreeState,
    ) -> Result<Vec<String>, InputError> {
        let count = system.multipliers();
        if count == 0 {
            return Ok(vec![]);
        }
        let tree = system.tree();
        let hold = |value: Hold| {
            let mut held = vec![[Hold::Free; 2]; tree.freedom()];
            for (at, joint) in self.joints.iter().enumerate() {
                let given = [joint.coordinate.is_some(), joint.rate.is_some()];
                let own = given.map(|is_given| if is_given { value } else { Hold::Free });
                tree.rates(at).for_each(|rate| held[rate] = own);
            }
            held
        };
        let given = state.clone();
        let mut notes = vec![];
        if let Err(unsatisfied) = system.assemble(state, &hold(Hold::Fixed)) {
            *state = given.clone();
            let near = hold(Hold::Near);
            let Ok(changes) = system.assemble(state, &near) else {
                return Err(self.unsatisfied(causes, unsatisfied));
            };
            let largest = |which: usize| {
                let own = changes.iter().zip(&near).filter(|(_, held)| held[which] == Hold::Near);
                own.map(|(change, _)| change[which]).fold(0.0, f64::max)
            };
            let (moved, rate) = (largest(0), largest(1));
            let rates = given.numbers.rows_range(given.numbers.len() - near.len()..);
            let speed = tree.largest(rates.iter());
            if moved > ROUNDED || rate > ROUNDED * speed {
                return Err(self.unsatisfied(causes, unsatisfied));
            }
            if moved > MOVED || rate > MOVED * speed {
                notes.push(format!(
                    "the initial coordinates were changed by up to {moved:.1e} and the rates by up \
                     to {rate:.1e} to satisfy the constraints"
                ));
            }
        }
        let rank = system.rank(state).ok_or_else(|| {
            let error = InputError::mathematics("the equations of motion are not finite");
            error.at(&self.place).help("check the masses of the bodies")
        })?;
        if rank < count {
            let left = count - rank;
            notes.push(format!(
                "{left} of {count} equations of loops and constraints follow from the others at \
                 the initial position; reactions that are not unique have the smallest norm"
            ));
        }
        Ok(notes)
    }

    fn unsatisfied(&self, causes: &[Cause], unsatisfied: Unsatisfied) -> InputError {
        let Unsatisfied { constraint, violation, by } = unsatisfied;
        let cause = &causes[constraint];
        let (what, help) = match by {
            Violator::Coordinates => (
                if let Cause::Loop(_) = cause { "cannot close" } else { "cannot be satisfied" },
                "change the initial coordinates, or leave some of them out",
            ),
            Violator::Rates => (
                "does not allow these rates",
                "change the initial rates, or leave some of them out",
            ),
            Violator::Accelerations => (
                "allows no acceleration at these rates",
                "at a singular position, give all rates of one branch of the motion; constraints \
                 must not contradict each other",
            ),
        };
        let (subject, place) = match cause {
            Cause::Loop(body) => {
                let name = shown(&self.bodies[*body].0);
                (format!("the loop of the body `{name}`"), &self.place)
            }
            Cause::Key(place) => ("the constraint".to_string(), place),
        };
        let message = format!("{subject} {what}: it is off by {violation:.2e}");
        InputError::mathematics(message).at(place).help(help)
    }
}

impl super::TreeJoint {
    fn motor(
        &self,
        motor: &Written,
        at: usize,
        tree: &Tree,
        names: &TreeNames,
    ) -> Result<TreeConstraint, InputError> {
        let rates = tree.rates(at);
        let place = motor.place();
        let coordinate = tree.coordinates().find(|(rate, _)| *rate == rates.start);
        let (1, Some((rate, number))) = (rates.len(), coordinate) else {
            let (kind, name) = (self.own.kind.name(), shown(&self.own.name));
            let message = format!("the {kind} joint `{name}` does not have one coordinate");
            let help = "write formulas of its coordinates in `constraints`";
            return Err(InputError::usage(message).at(&place).help(help));
        };
        if let Some((_, place)) = self.coordinate.as_ref().or(self.rate.as_ref()) {
            let error = InputError::usage("a joint with a motor has no initial value").at(place);
            return Err(error.help("leave the key out: the motor gives the coordinate"));
        }
        let known: Vec<&str> =
            ["t"].into_iter().chain(names.parameters().map(String::as_str)).collect();
        let help = format!("a motor is a formula in {}", known.join(", "));
        let formula = Formula::read(motor.text(), &mut |name| match name {
            "t" => Some(Symbol::Variable(0)),
            name => names.parameter(name).map(Symbol::Number),
        });
        let formula = formula.map_err(|error| motor.refused(error, help))?.differentiated();
        Ok(TreeConstraint::Motor(Motor { rate, number, formula }))
    }
}
