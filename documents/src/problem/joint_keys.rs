//! The tables `[[bodies]]` and `[[joints]]`.

use super::body::InertiaKeys;
use crate::input::urdf::Urdf;
use crate::input::{
    InputError, Place, Source,
    forms::{Number, OneOrMore, Text},
    shown,
};
use affinor::mechanism::JointKind;
use serde::Deserialize;

/// A table `[[bodies]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyKeys {
    pub name: Text,
    #[serde(default)]
    pub fixed: bool,
    pub inertia: Option<InertiaKeys>,
}

/// A table `[[joints]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointKeys {
    pub name: Option<Text>,
    #[serde(rename = "type")]
    pub kind: Option<Text>,
    pub bodies: Option<Vec<Text>>,
    pub at: Option<Vec<Number>>,
    pub axis: Option<Vec<Number>>,
    pub second_axis: Option<Vec<Number>>,
    pub pitch: Option<Number>,
    pub twists: Option<Vec<Vec<Number>>>,
    /// The initial coordinates, which are angles about and lengths along axes of length 1.
    pub coordinate: Option<OneOrMore>,
    /// The initial rates.
    pub rate: Option<OneOrMore>,
    /// The joint forces: torques of rotations, and forces of translations.
    pub force: Option<OneOrMore>,
    pub stiffness: Option<Number>,
    pub damping: Option<Number>,
    pub rest: Option<Number>,
    /// The coordinate as a formula in the time.
    pub motor: Option<Number>,
}

/// A table `[[springs]]`: a spring with a damper between two points.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringKeys {
    pub bodies: Vec<Text>,
    pub from: Vec<Number>,
    pub to: Vec<Number>,
    pub stiffness: Option<Number>,
    pub damping: Option<Number>,
    /// The length at which the spring is free of force; by default the length at the position of
    /// the file.
    pub length: Option<Number>,
}

/// A table `[[contacts]]`: a body that rolls or slides on a plane.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactKeys {
    #[serde(rename = "type")]
    pub kind: Text,
    pub body: Text,
    pub at: Vec<Number>,
    pub axis: Option<Vec<Number>>,
    pub radius: Option<Number>,
    pub normal: Option<Vec<Number>>,
}

impl JointKeys {
    /// The indices of the two bodies.
    pub fn ends(
        &self,
        name: &str,
        names: &[String],
        source: &Source,
        at: usize,
    ) -> Result<[usize; 2], InputError> {
        let Some(bodies) = &self.bodies else {
            let message = format!("joint `{}` has no `bodies`", shown(name));
            let error = source.refused(&format!("joints.{at}"), message);
            return Err(error.help("name the two bodies: bodies = [\"a\", \"b\"]"));
        };
        let place = source.key(&format!("joints.{at}.bodies"));
        let name = format!("`{}`", shown(name));
        ends(bodies, ["joint", &name], names, source, &place)
    }

    /// The index of the joint of the robot to which the table gives values. `None` for a table that
    /// defines a joint.
    pub fn joint_of(
        &self,
        robot: Option<&Urdf>,
        source: &Source,
        at: usize,
    ) -> Result<Option<usize>, InputError> {
        let (Some(robot), Some(name)) = (robot, &self.name) else { return Ok(None) };
        let found = robot.joint(name);
        let own = |key: &str| format!("joints.{at}.{key}");
        if found.is_none() && self.kind.is_none() && self.bodies.is_none() {
            let file = &robot.source.name;
            let message = format!("{file} has no joint `{}`", shown(name));
            let names: Vec<String> =
                robot.joints.iter().take(12).map(|joint| shown(&joint.name)).collect();
            let help = format!(
                "give type and bodies of a further joint, or name a joint of the robot: {}",
                names.join(", ")
            );
            return Err(InputError::usage(message).at(&source.at(name)).help(help));
        }
        let of_robot = ["type", "bodies", "at", "axis", "second_axis", "pitch", "twists"];
        if let (Some(_), Some(key)) =
            (found, of_robot.into_iter().find(|key| source.has_key(&own(key))))
        {
            let file = &robot.source.name;
            let message = format!("`{key}` of the joint `{}` is given by {file}", shown(name));
            let help = "leave the key out, or choose another name for a further joint";
            return Err(source.refused(&own(key), message).help(help));
        }
        Ok(found)
    }

    /// The type, whose keys are checked.
    pub fn kind(&self, source: &Source, at: usize) -> Result<JointKind, InputError> {
        let Some(written) = &self.kind else {
            let error = source.refused(&format!("joints.{at}"), "the joint has no `type`");
            return Err(error.help("give its type, as in type = \"revolute\""));
        };
        let place = source.at(written);
        let Some(kind) = JointKind::from_name(written) else {
            let message = format!("there is no joint of the type `{}`", shown(written));
            let names = JointKind::ALL.map(JointKind::name);
            let distance = |name: &&str| strsim::damerau_levenshtein(name, written);
            let near = names.into_iter().filter(|name| distance(name) < 4);
            let help = match near.min_by_key(distance) {
                Some(name) => format!("did you mean `{name}`?"),
                None => format!("the types are {}", names.join(", ")),
            };
            return Err(InputError::usage(message).at(&place).help(help));
        };
        let [needed, optional]: [&[&str]; 2] = match kind {
            JointKind::Revolute | JointKind::Cylindrical => [&["at", "axis"], &[]],
            JointKind::Helical => [&["at", "axis", "pitch"], &[]],
            JointKind::Prismatic | JointKind::Planar => [&["axis"], &["at"]],
            JointKind::Spherical => [&["at"], &[]],
            JointKind::Universal => [&["at", "axis", "second_axis"], &[]],
            JointKind::Fixed | JointKind::Free => [&[], &["at"]],
            JointKind::Subgroup => [&["twists"], &[]],
        };
        let own = |key: &str| format!("joints.{at}.{key}");
        for key in ["at", "axis", "second_axis", "pitch", "twists"] {
            let given = source.has_key(&own(key));
            let name = kind.name();
            if needed.contains(&key) && !given {
                let message = format!("a {name} joint needs the key `{key}`");
                return Err(InputError::usage(message).at(&place).help(example(key)));
            }
            if given && !needed.contains(&key) && !optional.contains(&key) {
                let message = format!("a {name} joint does not use the key `{key}`");
                let error = InputError::usage(message).at(&source.key(&own(key)));
                return Err(error.help("leave the key out"));
            }
        }
        Ok(kind)
    }
}

/// An example of a key.
fn example(key: &str) -> String {
    match key {
        "at" => "give a point in ground coordinates, as in at = [0, 0, 1]".into(),
        "pitch" => "give the translation per radian, as in pitch = \"1/10\"".into(),
        "twists" => "give a basis of the subalgebra, as in twists = [[0, 0, 1, 0, 0, 0]]".into(),
        key => format!("give a vector in ground coordinates, as in {key} = [0, 0, 1]"),
    }
}

/// The indices of the two bodies that a thing of a kind with a name connects.
pub(super) fn ends(
    bodies: &[Text],
    [kind, name]: [&str; 2],
    names: &[String],
    source: &Source,
    place: &Place,
) -> Result<[usize; 2], InputError> {
    let mut ends = vec![];
    for body in bodies {
        ends.push(body_index(body, names, source)?);
    }
    let Ok(ends) = <[usize; 2]>::try_from(ends) else {
        let found = bodies.len();
        let message = format!("{kind} {name} connects {found} bodies");
        let error = InputError::usage(message).at(place);
        return Err(error.help(format!("a {kind} connects two bodies: bodies = [\"a\", \"b\"]")));
    };
    if ends[0] == ends[1] {
        let body = shown(&names[ends[0]]);
        let message = format!("{kind} {name} connects `{body}` with itself");
        let error = InputError::usage(message).at(&source.at(&bodies[1]));
        return Err(error.help("name two different bodies"));
    }
    Ok(ends)
}

/// The index of a body.
pub(super) fn body_index(
    body: &Text,
    names: &[String],
    source: &Source,
) -> Result<usize, InputError> {
    let found = names.iter().position(|own| *own == body.content);
    found.ok_or_else(|| no_body(body, names, source))
}

fn no_body(body: &Text, names: &[String], source: &Source) -> InputError {
    let message = format!("there is no body `{}`", shown(body));
    let error = InputError::usage(message).at(&source.at(body));
    let distance = |name: &&String| strsim::damerau_levenshtein(name, body);
    let near = names.iter().filter(|name| body.len() < 32 && distance(name) < 3);
    error.help(match near.min_by_key(distance) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("the bodies are {}", names.join(", ")),
    })
}
