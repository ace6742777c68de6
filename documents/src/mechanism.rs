//! Files of mechanisms: bodies, and joints between them in the frame of the ground.
//!
//! Every number may be an expression with roots and letters. Letters without a value in the table
//! `[parameters]` remain letters.

mod robot;

use crate::input::urdf::{JointFrame, Urdf, UrdfJoint};
use crate::input::{
    InputError, Place, Source, file,
    forms::{Entries, Number, Text},
    parse_keys, shown,
};
use crate::problem::{BodyKeys, JointKeys, read_robot};
use crate::space::notation::Names;
use crate::space::setting::named_values;
use affinor::Error;
use affinor::mechanism::denavit_hartenberg::{Link, closed_chain};
use affinor::mechanism::joint::JointData;
use affinor::mechanism::{Joint, JointKind, Mechanism, Twist};
use affinor_tensors::expression::Scalars;
use affinor_tensors::{Kind, Rational, Symbolic};
use num_traits::One;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;
use std::path::Path;

/// The keys of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    name: Option<String>,
    parameters: Option<Entries<Text, Number>>,
    urdf: Option<Text>,
    #[serde(default)]
    bodies: Vec<BodyKeys>,
    #[serde(default)]
    joints: Vec<JointKeys>,
    #[serde(default)]
    links: Vec<LinkKeys>,
    // keys of problems of motion, which the mobility does not use
    #[serde(rename = "gravity")]
    _gravity: Option<IgnoredAny>,
    #[serde(rename = "coordinates")]
    _coordinates: Option<IgnoredAny>,
    #[serde(rename = "springs")]
    _springs: Option<IgnoredAny>,
    #[serde(rename = "initial")]
    _initial: Option<IgnoredAny>,
    #[serde(rename = "forces")]
    _forces: Option<IgnoredAny>,
    #[serde(rename = "integrator")]
    _integrator: Option<IgnoredAny>,
    #[serde(rename = "output")]
    _output: Option<IgnoredAny>,
    #[serde(rename = "quantities")]
    _quantities: Option<IgnoredAny>,
    #[serde(rename = "events")]
    _events: Option<IgnoredAny>,
}

/// A table `[[links]]`: a link of a closed chain of revolute joints.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LinkKeys {
    length: Option<Number>,
    offset: Option<Number>,
    twist: Option<Number>,
    half_twist: Option<Number>,
    angle: Option<Number>,
    half_angle: Option<Number>,
}

/// A mechanism that was read from a file.
#[derive(Clone, Debug)]
pub struct MechanismFile {
    /// The name.
    pub name: String,
    /// The mechanism at its position.
    pub mechanism: Mechanism<Symbolic>,
    /// The letters without a value.
    pub parameters: Vec<String>,
}

impl MechanismFile {
    /// Reads a mechanism from a file, or from standard input for `-`. The text `set` overrides
    /// parameters, as in `a=1/2,b=3`.
    ///
    /// # Errors
    /// An error with its location if the file cannot be read, or if its content is invalid.
    pub fn read(path: &str, set: &[String]) -> Result<Self, InputError> {
        Self::of_source(&file::read(path)?, set, Path::new(path).parent().unwrap_or(Path::new("")))
    }

    /// Reads a mechanism from the text of a file. Relative paths in the text start at the current
    /// folder.
    ///
    /// ```
    /// use affinor_documents::mechanism::MechanismFile;
    /// let text = r#"
    /// bodies = [{ name = "ground" }, { name = "slider" }]
    /// joints = [{ type = "prismatic", bodies = ["ground", "slider"], axis = [1, 0, 0] }]
    /// "#;
    /// let file = MechanismFile::parse("slider.toml", text, &[])?;
    /// assert_eq!(file.mechanism.mobility()?.verdict.exact(), Some(1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(name: &str, text: &str, set: &[String]) -> Result<Self, InputError> {
        let source = Source::new(name.escape_debug().to_string(), text);
        Self::of_source(&source, set, Path::new(""))
    }

    fn of_source(source: &Source, set: &[String], folder: &Path) -> Result<Self, InputError> {
        let content = "give bodies and joints, as in [[bodies]] and [[joints]]";
        let (keys, source): (Keys, Source) = parse_keys(source, content)?;
        let mut reader = Reader { source: &source, values: BTreeMap::new() };
        reader.set(set, keys.parameters.as_ref())?;
        let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
        let urdf = read_robot(keys.urdf.as_ref(), path, |name| source.at(name))?;
        let is_open = urdf.is_none() && keys.joints.is_empty();
        let mechanism = match (is_open, keys.links.is_empty()) {
            (_, true) => reader.joined(urdf.as_ref(), &keys.bodies, &keys.joints)?,
            (true, false) => reader.chain(&keys)?,
            (false, false) => {
                let error = source.refused("links", "the file has both joints and links");
                return Err(error.help("give the joints, or the links of a closed chain"));
            }
        };
        let mut parameters: Vec<String> = mechanism
            .joints()
            .iter()
            .flat_map(|joint| joint.twists().iter().flatten())
            .flat_map(Symbolic::parameters)
            .collect();
        parameters.sort();
        parameters.dedup();
        let stem = Path::new(&source.name).file_stem();
        let stem = stem.map_or(source.name.clone(), |stem| stem.to_string_lossy().into_owned());
        Ok(MechanismFile { name: keys.name.unwrap_or(stem), mechanism, parameters })
    }

    /// The kind of scalars that the mechanism needs: rational numbers if all components are
    /// rational, and otherwise expressions.
    pub fn kind(&self) -> Kind {
        let mut components =
            self.mechanism.joints().iter().flat_map(|joint| joint.twists().iter().flatten());
        match components.all(|value| value.as_constant().is_some()) {
            true => Kind::Exact,
            false => Kind::Symbolic,
        }
    }
}

struct Reader<'s> {
    source: &'s Source,
    values: BTreeMap<String, Symbolic>,
}

impl Reader<'_> {
    /// Reads the values of parameters, first of the options `--set`, then of the file.
    fn set(
        &mut self,
        set: &[String],
        table: Option<&Entries<Text, Number>>,
    ) -> Result<(), InputError> {
        let mut given = vec![];
        for text in set {
            let source = Source::new("--set", text);
            for (name, value) in named_values(&source)? {
                let names = BTreeMap::new();
                let value = Names::open(&names, None).scalar(value, &source)?;
                given.push((name.to_string(), value));
            }
        }
        for (name, number) in table.iter().flat_map(|table| &table.0) {
            // later values may depend on this one, so an option replaces it at once
            let own = given.iter().position(|(given, _)| *given == name.content);
            let value = match own {
                Some(at) => given.remove(at).1,
                None => self.scalar(number)?,
            };
            self.values.insert(name.content.clone(), value);
        }
        self.values.extend(given);
        Ok(())
    }

    fn scalar(&self, Number(text): &Number) -> Result<Symbolic, InputError> {
        let source = self.source.excerpt(text);
        let labels = BTreeMap::new();
        let names = Names::open(&labels, None);
        let name = |name: &str| match self.values.get(name) {
            Some(value) => Ok(value.clone()),
            None => names.parameter(name),
        };
        let function = |name: &str, arguments: &[Symbolic]| names.call(name, arguments);
        names.read(source.content(), &source, &Scalars(name, function))
    }

    fn vector<const N: usize>(
        &self,
        list: &[Number],
        place: &Place,
    ) -> Result<[Symbolic; N], InputError> {
        let found = list.len();
        let values: Vec<Symbolic> =
            list.iter().map(|number| self.scalar(number)).collect::<Result<_, _>>()?;
        values.try_into().map_err(|_| {
            let message = format!("the list has {found} components instead of {N}");
            InputError::usage(message).at(place)
        })
    }

    /// The mechanism of a robot, a list of bodies and a list of joints.
    fn joined(
        &self,
        robot: Option<&Urdf>,
        bodies: &[BodyKeys],
        joints: &[JointKeys],
    ) -> Result<Mechanism<Symbolic>, InputError> {
        if robot.is_none() && bodies.is_empty() {
            let error = InputError::usage("the file has no bodies").at(&self.source.key("joints"));
            return Err(error.help("name the bodies, as in bodies = [{ name = \"ground\" }, ...]"));
        }
        let links = robot.map_or(&[][..], |robot| &robot.links);
        let mut names: Vec<String> = links.iter().map(|link| link.name.clone()).collect();
        for body in bodies {
            if names.contains(&body.name.content) {
                let message = format!("two bodies have the name `{}`", shown(&body.name));
                let error = InputError::usage(message).at(&self.source.at(&body.name));
                return Err(error.help("choose another name"));
            }
            names.push(body.name.content.clone());
        }
        let mut all: Vec<Joint<Symbolic>> = vec![];
        if let Some(robot) = robot {
            let joints = robot.joints.iter().zip(robot.joint_frames());
            all = joints.map(|(joint, frame)| of_robot(joint, frame)).collect::<Result<_, _>>()?;
        }
        for (at, keys) in joints.iter().enumerate() {
            if keys.joint_of(robot, self.source, at)?.is_some() {
                continue;
            }
            let name = match &keys.name {
                Some(name) => name.content.clone(),
                None => format!("J{}", all.len() + 1),
            };
            let place = self.source.key(&format!("joints.{at}"));
            if all.iter().any(|joint| joint.name == name) {
                let message = format!("two joints have the name `{}`", shown(&name));
                let own = keys.name.as_ref().map_or(place, |name| self.source.at(name));
                return Err(InputError::usage(message).at(&own).help("choose another name"));
            }
            let ends = keys.ends(&name, &names, self.source, at)?;
            all.push(self.joint(at, keys)?.between(name, ends));
        }
        let moved = (0..bodies.len()).filter(|at| bodies[*at].fixed).map(|at| links.len() + at);
        let fixed: Vec<usize> = robot.map(|robot| robot.root).into_iter().chain(moved).collect();
        let place = self.source.key(if bodies.is_empty() { "urdf" } else { "bodies" });
        Mechanism::new(names, &fixed, all).map_err(|error| {
            let help = "connect every body by a joint, directly or through other bodies";
            InputError::from(error).or_at(&place).help(help)
        })
    }

    fn joint(&self, at: usize, keys: &JointKeys) -> Result<Joint<Symbolic>, InputError> {
        let kind = keys.kind(self.source, at)?;
        let own = |key: &str| self.source.key(&format!("joints.{at}.{key}"));
        let vector = |key: &str, list: &Option<Vec<Number>>| match list {
            Some(list) => self.vector::<3>(list, &own(key)),
            None => Ok(Default::default()),
        };
        let twists = keys.twists.iter().flatten();
        let twists: Result<Vec<Twist<Symbolic>>, _> =
            twists.map(|list| self.vector::<6>(list, &own("twists"))).collect();
        let pitch = keys.pitch.as_ref().map(|pitch| self.scalar(pitch)).transpose()?;
        let data = JointData {
            point: vector("at", &keys.at)?,
            axis: vector("axis", &keys.axis)?,
            second_axis: vector("second_axis", &keys.second_axis)?,
            pitch: pitch.unwrap_or_default(),
            twists: twists?,
        };
        Joint::of_kind(kind, data).map_err(|error| {
            let (key, help) = match kind {
                JointKind::Subgroup => {
                    ("twists", "add the bracket, or use a product of several joints")
                }
                _ => ("axis", "give a vector that is not zero, and axes that are not parallel"),
            };
            InputError::from(error).help(help).or_at(&own(key))
        })
    }

    /// The closed chain of the tables `[[links]]`.
    fn chain(&self, keys: &Keys) -> Result<Mechanism<Symbolic>, InputError> {
        if !keys.bodies.is_empty() {
            let error = self.source.refused("bodies", "links name no bodies");
            return Err(error.help("leave the key out: the bodies are ground, link1, link2, ..."));
        }
        let mut links = vec![];
        for (at, link) in keys.links.iter().enumerate() {
            let number = |number: &Option<Number>| match number {
                Some(number) => self.scalar(number),
                None => Ok(Symbolic::default()),
            };
            let angle = |name: &str, angle: &Option<Number>, half: &Option<Number>| {
                let place = self.source.key(&format!("links.{at}.{name}"));
                match (angle, half) {
                    (Some(_), Some(_)) => {
                        let message = format!("the {name} is given twice");
                        let error = InputError::usage(message).at(&place);
                        Err(error.help(format!("give one of {name}, half_{name}")))
                    }
                    (_, Some(half)) => self.half(half),
                    (Some(angle), None) => self.right_angle(name, angle),
                    (None, None) => Ok([Symbolic::one(), Symbolic::default()]),
                }
            };
            links.push(Link {
                length: number(&link.length)?,
                offset: number(&link.offset)?,
                twist: angle("twist", &link.twist, &link.half_twist)?,
                angle: angle("angle", &link.angle, &link.half_angle)?,
            });
        }
        let place = self.source.key("links");
        let closed = |error: Error| {
            let help = "change a length, a twist or an angle until the last frame is the first";
            InputError::from(error).or_at(&place).help(help)
        };
        let joints = closed_chain(&links).map_err(closed)?;
        let name = |at: usize| if at == 0 { "ground".into() } else { format!("link{at}") };
        Ok(Mechanism::new((0..links.len()).map(name).collect(), &[0], joints)?)
    }

    /// Cosine and sine of an angle, from the tangent of its half.
    fn half(&self, number: &Number) -> Result<[Symbolic; 2], InputError> {
        use affinor_tensors::Field;
        let t = self.scalar(number)?;
        let square = t.clone() * &t;
        let inverse = (Symbolic::one() + &square).recip().ok_or_else(|| {
            InputError::mathematics("1 + t^2 has no inverse").at(&self.source.at(&number.0))
        })?;
        let cos = (Symbolic::one() - &square) * &inverse;
        Ok([cos, (t.clone() + &t) * &inverse])
    }

    /// Cosine and sine of a multiple of 90 degrees.
    fn right_angle(&self, name: &str, number: &Number) -> Result<[Symbolic; 2], InputError> {
        let value = self.scalar(number)?;
        let turns = value.as_constant().map(|value| value.clone() * &ninetieth());
        let quarter = turns.as_ref().and_then(Rational::to_i64);
        let [one, zero] = [Symbolic::one(), Symbolic::default()];
        match quarter.map(|quarter| quarter.rem_euclid(4)) {
            Some(0) => Ok([one, zero]),
            Some(1) => Ok([zero, one]),
            Some(2) => Ok([-one, zero]),
            Some(_) => Ok([zero, -one]),
            None => {
                let message = format!("the {name} {value} is not a multiple of 90 degrees");
                let error = InputError::usage(message).at(&self.source.at(&number.0));
                let help = format!("give the tangent of half the angle: half_{name} = \"1/2\"");
                Err(error.help(help))
            }
        }
    }
}

/// The joint of a robot, with its point and its axis in the ground frame.
fn of_robot(joint: &UrdfJoint, frame: JointFrame<Symbolic>) -> Result<Joint<Symbolic>, InputError> {
    let JointFrame { point, axis } = frame;
    let (second_axis, pitch, twists) = (Default::default(), Symbolic::default(), vec![]);
    let data = JointData { point, axis, second_axis, pitch, twists };
    let own = Joint::of_kind(joint.kind, data).map_err(|error| {
        InputError::from(error).help("give a vector that is not zero").or_at(&joint.axis_place)
    })?;
    Ok(own.between(&joint.name, joint.links))
}

fn ninetieth() -> Rational {
    Rational::new(1, 90).unwrap_or_else(Rational::one)
}
