//! Reads robots in URDF, the Unified Robot Description Format: links and joints in an XML file.
//!
//! In reading order: [`element`] reads the attributes of XML elements; this file reads links and
//! joints; [`pose`] computes their frames at the zero configuration. Positions are in metres, angles
//! in radians, masses in kilograms.

mod element;
pub(crate) mod pose;

use super::{InputError, Place, Source, file, shown};
use affinor::mechanics::MassProperties;
use affinor::mechanism::JointKind;
use element::Element;
use nalgebra::{Matrix3, Vector3};
use pose::{Origin, Pose};
use roxmltree::Document;

/// The types of joints, and the kinds of their relative motions.
const TYPES: [(&str, JointKind); 6] = [
    ("revolute", JointKind::Revolute),
    ("continuous", JointKind::Revolute),
    ("prismatic", JointKind::Prismatic),
    ("fixed", JointKind::Fixed),
    ("floating", JointKind::Free),
    ("planar", JointKind::Planar),
];

/// The number of joints that a note names.
const NAMED: usize = 4;

/// A robot: a tree of links, which are connected by joints.
#[derive(Clone, Debug)]
pub(crate) struct Urdf {
    /// The file.
    pub source: Source,
    /// The links, in the order of the file.
    pub links: Vec<UrdfLink>,
    /// The joints, in the order of the file.
    pub joints: Vec<UrdfJoint>,
    /// The index of the root link.
    pub root: usize,
    /// The indices of the joints, each after the joint that moves its parent link.
    order: Vec<usize>,
    /// Properties of the file that motions do not use.
    pub notes: Vec<String>,
}

/// A link.
#[derive(Clone, Debug)]
pub(crate) struct UrdfLink {
    pub name: String,
    /// The location of the name.
    pub place: Place,
    /// The mass properties in the frame of the link; `None` for a link without mass.
    pub mass: Option<MassProperties>,
}

/// A joint.
#[derive(Clone, Debug)]
pub(crate) struct UrdfJoint {
    pub name: String,
    /// The location of the name.
    pub place: Place,
    pub kind: JointKind,
    /// The indices of the parent link and of the child link.
    pub links: [usize; 2],
    /// The frame of the joint, relative to the frame of the parent link.
    origin: Origin,
    /// The axis or the normal vector of a plane, in the frame of the joint.
    axis: [f64; 3],
    /// The location of the axis.
    pub axis_place: Place,
    /// The factor of the damping force.
    pub damping: f64,
}

/// A point and an axis of a joint in the ground frame, at the zero configuration.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointFrame<S> {
    pub point: [S; 3],
    pub axis: [S; 3],
}

impl Urdf {
    /// Reads a robot from a file.
    pub fn read(path: &str) -> Result<Self, InputError> {
        let source = file::read(path).map_err(|error| {
            error.help("give the path of the URDF file, relative to the folder of this file")
        })?;
        Self::parse(source)
    }

    /// Reads a robot from the text of a file.
    pub fn parse(source: Source) -> Result<Self, InputError> {
        let text = source.text.clone();
        let document = Document::parse(&text).map_err(|error| not_xml(&error, &source))?;
        let robot = Element::new(document.root_element(), &source);
        if robot.name() != "robot" {
            let message = format!("<{}> is not the element of a robot", shown(robot.name()));
            let help = "the outer element of a URDF file is <robot name=\"...\">";
            return Err(InputError::usage(message).at(&robot.place()).help(help));
        }
        robot.expect_children(&["link", "joint", "transmission", "gazebo", "material"])?;
        let mut notes = Notes::default();
        let mut links: Vec<UrdfLink> = vec![];
        for element in robot.children("link") {
            let link = UrdfLink::read(&element)?;
            if links.iter().any(|other| other.name == link.name) {
                return Err(twice("links", &link.name, &link.place));
            }
            links.push(link);
        }
        if links.is_empty() {
            let error = InputError::usage("the robot has no links").at(&robot.place());
            return Err(error.help("give links, as in <link name=\"base\"/>"));
        }
        let mut joints: Vec<UrdfJoint> = vec![];
        for element in robot.children("joint") {
            let joint = UrdfJoint::read(&element, &links, &mut notes)?;
            if joints.iter().any(|other| other.name == joint.name) {
                return Err(twice("joints", &joint.name, &joint.place));
            }
            joints.push(joint);
        }
        let (root, order) = tree(&links, &joints)?;
        let has_transmissions = robot.children("transmission").next().is_some();
        let notes = notes.written(&source.name, has_transmissions);
        Ok(Urdf { source, links, joints, root, order, notes })
    }

    /// The index of the joint with this name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// The frames of the links in the frame of the root link, at the zero configuration. `number`
    /// converts a number of the file; `turn` returns the cosine and the sine of an angle.
    fn frames<S: pose::Number>(&self) -> (Vec<Pose<S>>, Vec<JointFrame<S>>) {
        let mut links = vec![Pose::identity(); self.links.len()];
        let empty = || std::array::from_fn(|_| S::zero());
        let mut frames = vec![JointFrame { point: empty(), axis: empty() }; self.joints.len()];
        for &at in &self.order {
            let joint = &self.joints[at];
            let [parent, child] = joint.links;
            let frame = links[parent].then(&Pose::of(&joint.origin));
            let axis = frame.direction(&joint.axis.map(S::of));
            frames[at] = JointFrame { point: frame.position.clone(), axis };
            links[child] = frame;
        }
        (links, frames)
    }

    /// The points and axes of all joints in the ground frame, at the zero configuration.
    pub fn joint_frames<S: pose::Number>(&self) -> Vec<JointFrame<S>> {
        self.frames().1
    }

    /// The mass properties of all links in the ground frame, at the zero configuration.
    pub fn masses(&self) -> Vec<Option<MassProperties>> {
        let (frames, _) = self.frames::<f64>();
        let masses = self.links.iter().zip(&frames);
        masses.map(|(link, frame)| Some(link.mass?.moved(&frame.isometry()))).collect()
    }
}

impl UrdfLink {
    fn read(element: &Element) -> Result<Self, InputError> {
        let (name, place) = element.text("name")?;
        element.expect_children(&["inertial", "visual", "collision"])?;
        let mass = match element.child("inertial")? {
            Some(inertial) => mass(&name, &inertial)?,
            None => None,
        };
        Ok(UrdfLink { name, place, mass })
    }
}

/// The mass properties of the element `inertial` of a link; `None` if all of them are zero.
fn mass(link: &str, inertial: &Element) -> Result<Option<MassProperties>, InputError> {
    inertial.expect_children(&["origin", "mass", "inertia"])?;
    let origin = Pose::<f64>::of(&inertial.origin()?);
    let (mass, inertia) = (inertial.needed("mass")?, inertial.needed("inertia")?);
    let (value, place) = mass.number("value")?;
    let mut moments = [0.0; 6];
    for (moment, name) in moments.iter_mut().zip(["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]) {
        *moment = inertia.number(name)?.0;
    }
    if value == 0.0 && moments.iter().all(|moment| *moment == 0.0) {
        return Ok(None);
    }
    let [xx, xy, xz, yy, yz, zz] = moments;
    let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let turn = origin.matrix();
    // the products round, so the result is symmetric up to rounding errors only
    let turned = turn * own * turn.transpose();
    let turned = (turned + turned.transpose()) * 0.5;
    let body = MassProperties::new(value, Vector3::from(origin.position), &turned);
    body.map(Some).map_err(|error| {
        let (place, help) = match value > 0.0 {
            true => {
                let help = "give moments about the centre of mass that satisfy the triangle inequality: each principal moment is at most the sum of the other two";
                (inertia.place(), help)
            }
            false => (place, "give a positive mass, or leave <inertial> out"),
        };
        let error = InputError::from(error);
        let message = format!("link `{}`: {}", shown(link), error.message);
        InputError { message, ..error }.at(&place).help(help)
    })
}

impl UrdfJoint {
    fn read(element: &Element, links: &[UrdfLink], notes: &mut Notes) -> Result<Self, InputError> {
        let (name, place) = element.text("name")?;
        element.expect_children(&[
            "origin",
            "parent",
            "child",
            "axis",
            "calibration",
            "dynamics",
            "limit",
            "mimic",
            "safety_controller",
        ])?;
        let kind = kind(element)?;
        if let Some(mimic) = element.child("mimic")? {
            let message = format!("joint `{}` mimics another joint", shown(&name));
            let error = InputError::usage(message).at(&mimic.place());
            let help = "this is not supported: leave <mimic> out, and couple the joints by a constraint of the file, as in constraints = [\"q_b - 2*q_a\"]";
            return Err(error.help(help));
        }
        let end = |role: &str| -> Result<usize, InputError> {
            let (link, place) = element.needed(role)?.text("link")?;
            let found = links.iter().position(|own| own.name == link);
            found.ok_or_else(|| {
                let message = format!("there is no link `{}`", shown(&link));
                let names = links.iter().map(|link| &*link.name);
                InputError::usage(message).at(&place).help(near(&link, names, "links"))
            })
        };
        let ends = [end("parent")?, end("child")?];
        let axis = element.child("axis")?;
        let axis_place = axis.as_ref().map_or(element.place(), Element::place);
        let axis = axis.map(|axis| axis.vector("xyz")).transpose()?.flatten();
        let axis = axis.unwrap_or([1.0, 0.0, 0.0]);
        let has_axis = !matches!(kind, JointKind::Fixed | JointKind::Free);
        if has_axis && axis.iter().all(|component| *component == 0.0) {
            let message = format!("the axis of joint `{}` has length zero", shown(&name));
            let error = InputError::usage(message).at(&axis_place);
            return Err(error.help("give a vector of length 1, as in <axis xyz=\"0 0 1\"/>"));
        }
        let mut damping = 0.0;
        if let Some(dynamics) = element.child("dynamics")? {
            damping = dynamics.number_or("damping", 0.0)?;
            if dynamics.number_or("friction", 0.0)? != 0.0 {
                notes.friction.push(name.clone());
            }
        }
        if let Some(limit) = element.child("limit")? {
            let numbers = ["lower", "upper", "effort", "velocity"];
            numbers.iter().try_for_each(|key| limit.number_or(key, 0.0).map(|_| ()))?;
            notes.limits.push(name.clone());
        }
        let origin = element.origin()?;
        Ok(UrdfJoint { name, place, kind, links: ends, origin, axis, axis_place, damping })
    }
}

/// The kind of a joint.
fn kind(element: &Element) -> Result<JointKind, InputError> {
    let (kind, place) = element.text("type")?;
    let found = TYPES.iter().find(|(name, _)| *name == kind);
    found.map(|(_, kind)| *kind).ok_or_else(|| {
        let message = format!("there is no joint of the type `{}`", shown(&kind));
        let names = TYPES.iter().map(|(name, _)| *name);
        InputError::usage(message).at(&place).help(near(&kind, names, "types"))
    })
}

/// The root link, and the joints in an order from the root to the ends of the tree.
fn tree(links: &[UrdfLink], joints: &[UrdfJoint]) -> Result<(usize, Vec<usize>), InputError> {
    // the joint that moves each link
    let mut above: Vec<Option<usize>> = vec![None; links.len()];
    for (at, joint) in joints.iter().enumerate() {
        let child = joint.links[1];
        if let Some(first) = above[child].replace(at) {
            let (link, first) = (shown(&links[child].name), shown(&joints[first].name));
            let message =
                format!("link `{link}` is the child of two joints, the first is `{first}`");
            let error = InputError::usage(message).at(&joint.place);
            let help =
                "a robot is a tree: close loops by [[joints]] of the file that names the robot";
            return Err(error.help(help));
        }
    }
    let mut roots = (0..links.len()).filter(|link| above[*link].is_none());
    let (root, second) = (roots.next(), roots.next());
    if let (Some(root), Some(second)) = (root, second) {
        let names = [root, second].map(|link| shown(&links[link].name));
        let message = format!("the robot has two root links, `{}` and `{}`", names[0], names[1]);
        let error = InputError::usage(message).at(&links[second].place);
        return Err(error.help("give a joint whose child is one of them"));
    }
    let mut order = vec![];
    let mut open: Vec<usize> = root.into_iter().collect();
    let mut below: Vec<Vec<usize>> = vec![vec![]; links.len()];
    joints.iter().enumerate().for_each(|(at, joint)| below[joint.links[0]].push(at));
    while let Some(link) = open.pop() {
        order.extend(&below[link]);
        open.extend(below[link].iter().map(|at| joints[*at].links[1]));
    }
    let (Some(root), true) = (root, order.len() == joints.len()) else {
        return Err(cycle(links, joints, &above, &order));
    };
    Ok((root, order))
}

/// The error for links that are not below the root link. The list `above` has the joint that moves
/// each link, and `order` the joints that are reached from the root.
fn cycle(
    links: &[UrdfLink],
    joints: &[UrdfJoint],
    above: &[Option<usize>],
    order: &[usize],
) -> InputError {
    let up = |link: usize| above[link].map_or(link, |at| joints[at].links[0]);
    // the way up from a link that is not reached ends in the cycle
    let lost = (0..joints.len()).find(|at| !order.contains(at));
    let mut link = lost.map_or(0, |at| joints[at].links[1]);
    (0..links.len()).for_each(|_| link = up(link));
    let (mut members, start) = (vec![link], link);
    while up(link) != start {
        link = up(link);
        members.push(link);
    }
    let names: Vec<String> =
        members.iter().take(NAMED).map(|link| format!("`{}`", shown(&links[*link].name))).collect();
    let more = if members.len() > NAMED { ", ..." } else { "" };
    let message = format!("the links {}{more} form a cycle", names.join(", "));
    let last = members.iter().filter_map(|link| above[*link]).max();
    let place = last.map_or(&links[start].place, |at| &joints[at].place);
    let help = "remove a joint of the cycle, and close the loop by [[joints]] of the file that names the robot";
    InputError::usage(message).at(place).help(help)
}

/// Joints with properties that motions do not use.
#[derive(Default)]
struct Notes {
    limits: Vec<String>,
    friction: Vec<String>,
}

impl Notes {
    fn written(&self, file: &str, has_transmissions: bool) -> Vec<String> {
        let mut notes = vec![];
        for (what, joints, fate) in [
            ("limits", &self.limits, "are not enforced"),
            ("friction", &self.friction, "is ignored"),
        ] {
            if !joints.is_empty() {
                let named: Vec<String> =
                    joints.iter().take(NAMED).map(|name| shown(name)).collect();
                let more = joints.len().saturating_sub(NAMED);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                let named = named.join(", ");
                notes.push(format!("{file}: the {what} of the joints {named}{more} {fate}"));
            }
        }
        if has_transmissions {
            notes.push(format!("{file}: transmissions are ignored"));
        }
        notes
    }
}

/// Advice with the name that may have been meant, or with all names.
fn near<'n>(name: &str, names: impl Iterator<Item = &'n str> + Clone, what: &str) -> String {
    let distance = |other: &&str| strsim::damerau_levenshtein(other, name);
    let found = names.clone().filter(|other| name.len() < 32 && distance(other) < 3);
    match found.min_by_key(distance) {
        Some(name) => format!("did you mean `{}`?", shown(name)),
        None => {
            let list: Vec<String> = names.clone().take(12).map(shown).collect();
            let more = if names.count() > list.len() { ", ..." } else { "" };
            format!("the {what} are {}{more}", list.join(", "))
        }
    }
}

fn twice(what: &str, name: &str, place: &Place) -> InputError {
    let message = format!("two {what} have the name `{}`", shown(name));
    InputError::usage(message).at(place).help("choose another name")
}

/// The error for a text that is not XML.
fn not_xml(error: &roxmltree::Error, source: &Source) -> InputError {
    let pos = error.pos();
    // the parser counts rows and characters from 1
    let row = source.text.split_inclusive('\n').nth(pos.row.saturating_sub(1) as usize);
    let place = row.map(|row| {
        let at = row.char_indices().nth(pos.col.saturating_sub(1) as usize);
        let at = at.map_or(row.trim_end().len(), |(at, _)| at);
        let end = row[at..].chars().next().map_or(at, |c| at + c.len_utf8());
        source.find(row, at..end)
    });
    let reason = error.to_string();
    let reason = reason.strip_suffix(&format!(" at {pos}")).unwrap_or(&reason);
    let message = format!("{} is not valid XML: {}", source.name, shown(reason));
    let help = match reason.contains("xacro") || source.text.contains("xmlns:xacro") {
        true => element::EXPAND,
        false => "a URDF file is <robot name=\"...\"> with <link> and <joint> elements",
    };
    InputError::usage(message).or_at(place.as_ref()).help(help)
}
