//! The bodies and joints of a file: the links and joints of its robot, then those of its tables.

use super::body::Bodies;
use super::joint::JointFormulas;
use super::joint_keys::JointKeys;
use super::keys::Keys;
use super::reader::Reader;
use crate::input::forms::Text;
use crate::input::urdf::Urdf;
use crate::input::{InputError, Place, shown};

/// A body.
#[derive(Clone, Debug)]
pub(super) struct AssembledBody {
    pub name: String,
    pub fixed: bool,
    /// Whether the body has an inertia, which fixed bodies do not need.
    pub has_mass: bool,
    pub place: Place,
}

/// A joint, with its table and the index of the table. Joints of a robot need no table.
pub(super) struct AssembledJoint<'k> {
    pub own: JointFormulas,
    pub table: Option<(usize, &'k JointKeys)>,
}

/// The bodies and joints of a file.
pub(super) struct Assembly<'k> {
    pub bodies: Vec<AssembledBody>,
    /// The inertias of the moving bodies that have one.
    pub inertias: Bodies,
    pub joints: Vec<AssembledJoint<'k>>,
    /// Properties of the robot that motions do not use.
    pub notes: Vec<String>,
    /// The location of the keys that define the bodies.
    pub place: Place,
}

/// Reads the robot of a file, if it has one.
pub(crate) fn read_robot(
    key: Option<&Text>,
    path: impl Fn(&str) -> String,
    place: impl Fn(&Text) -> Place,
) -> Result<Option<Urdf>, InputError> {
    let read = |name: &Text| Urdf::read(&path(name)).map_err(|error| error.or_at(&place(name)));
    key.map(read).transpose()
}

impl<'k> Assembly<'k> {
    pub fn read(keys: &'k Keys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let robot =
            read_robot(keys.urdf.as_ref(), |name| reader.file(name), |name| source.at(name))?;
        let (mut bodies, mut inertias) = (vec![], vec![]);
        if let Some(robot) = &robot {
            let masses = robot.masses();
            for (at, (link, mass)) in robot.links.iter().zip(masses).enumerate() {
                let fixed = at == robot.root;
                let (name, place) = (link.name.clone(), link.place.clone());
                inertias.extend(mass.filter(|_| !fixed).map(|mass| (mass, place.clone())));
                bodies.push(AssembledBody { name, fixed, has_mass: mass.is_some(), place });
            }
        }
        let tables = keys.bodies.as_deref().unwrap_or_default();
        for table in tables {
            let (name, place) = (table.name.content.clone(), source.at(&table.name));
            if bodies.iter().any(|body| body.name == name) {
                let message = format!("two bodies have the name `{}`", shown(&name));
                let error = InputError::usage(message).at(&place);
                return Err(error.help("choose another name"));
            }
            let has_mass = table.inertia.is_some();
            if !table.fixed && !has_mass {
                let message = format!("the moving body `{}` has no inertia", shown(&name));
                let help = "give it parts, as in inertia.parts = [{ shape = \"rod\", length = 1, mass = 1 }], or fixed = true";
                return Err(InputError::usage(message).at(&place).help(help));
            }
            bodies.push(AssembledBody { name, fixed: table.fixed, has_mass, place });
        }
        let place = source.key(if keys.bodies.is_some() { "bodies" } else { "urdf" });
        let moving = bodies.iter().filter(|body| !body.fixed).count();
        if moving == 0 || moving == bodies.len() {
            let message = "one body must be fixed, and one must move";
            let error = InputError::usage(message).at(&place);
            return Err(error.help("write fixed = true in the table of the ground"));
        }
        let moving = tables.iter().enumerate().filter(|(_, table)| !table.fixed);
        let moving = moving.filter_map(|(at, body)| {
            Some((format!("bodies.{at}.inertia"), body.inertia.as_ref()?))
        });
        let inertias = Bodies::all(inertias, moving, place.clone(), reader)?;
        let names: Vec<String> = bodies.iter().map(|body| body.name.clone()).collect();
        let joints = joints(keys, robot.as_ref(), &names, reader)?;
        let notes = robot.map_or(vec![], |robot| robot.notes);
        Ok(Assembly { bodies, inertias, joints, notes, place })
    }
}

/// The joints of a file: those of the robot, each with the table of its name if there is one, then
/// those of the other tables.
fn joints<'k>(
    keys: &'k Keys,
    robot: Option<&Urdf>,
    names: &[String],
    reader: &Reader,
) -> Result<Vec<AssembledJoint<'k>>, InputError> {
    let mut joints: Vec<AssembledJoint> = vec![];
    if let Some(robot) = robot {
        let frames = robot.joint_frames::<f64>();
        joints.extend(robot.joints.iter().zip(frames).map(|(joint, frame)| AssembledJoint {
            own: JointFormulas::of_robot(joint, &frame, robot),
            table: None,
        }));
    }
    for (at, table) in keys.joints.iter().flatten().enumerate() {
        match table.joint_of(robot, reader.source, at)? {
            Some(joint) if joints[joint].table.is_some() => {
                let error = reader.source.refused(
                    &format!("joints.{at}"),
                    format!("two tables describe the joint `{}`", shown(&joints[joint].own.name)),
                );
                return Err(error.help("give all values in one table"));
            }
            Some(joint) => joints[joint].table = Some((at, table)),
            None => {
                let own = JointFormulas::read(table, at, joints.len() + 1, names, reader)?;
                joints.push(AssembledJoint { own, table: Some((at, table)) });
            }
        }
    }
    Ok(joints)
}
