//! The tree of a file of bodies and joints, without a motion.

use super::keys::Keys;
use super::on_tree::OnTree;
use super::reader::Reader;
use crate::input::{InputError, Source, file, parse_keys};
use crate::space::setting::{named_numbers, no_parameter};
use affinor::mechanism::Tree;
use nalgebra::Vector3;
use std::path::Path;

/// Reads the tree of a file, at the position of the file. The texts `set` override parameters, as in
/// `a=1/2,b=3`, and `gravity` overrides the acceleration of gravity. Springs, dampers and joint forces
/// of the file are ignored.
///
/// # Errors
/// An error with its location if the file cannot be read, or if its content is invalid. Loops of
/// joints are errors, and so are moving bodies that do not resist their motion.
pub fn read(path: &str, set: &[String], gravity: Option<[f64; 3]>) -> Result<Tree, InputError> {
    let folder = Path::new(path).parent().unwrap_or(Path::new(""));
    of_source(&file::read(path)?, set, gravity, folder)
}

/// Reads the tree from the text of a file. Relative paths in the text start at the current folder.
///
/// ```
/// use affinor_documents::problem::tree;
/// let text = r#"
/// bodies = [{ name = "ground", fixed = true }, { name = "rod", inertia.parts = [
///     { shape = "rod", length = 1, mass = "m", position = [0, 0, -0.5] }] }]
/// joints = [{ type = "revolute", bodies = ["ground", "rod"], at = [0, 0, 0], axis = [0, 1, 0] }]
/// parameters = { m = 1 }
/// "#;
/// let tree = tree::parse("pendulum.toml", text, &["m=3".to_string()], None)?;
/// let mut moving = affinor::mechanism::MovingTree::new(tree.into());
/// assert!((moving.mass_matrix()[(0, 0)] - 1.0).abs() < 1e-15);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// # Errors
/// Those of [`read`].
pub fn parse(
    name: &str,
    text: &str,
    set: &[String],
    gravity: Option<[f64; 3]>,
) -> Result<Tree, InputError> {
    let source = Source::new(name.escape_debug().to_string(), text);
    of_source(&source, set, gravity, Path::new(""))
}

fn of_source(
    source: &Source,
    set: &[String],
    gravity: Option<[f64; 3]>,
    folder: &Path,
) -> Result<Tree, InputError> {
    let content = "give bodies and joints, as in [[bodies]] and [[joints]]";
    let (keys, source): (Keys, Source) = parse_keys(source, content)?;
    let mut given: Vec<(String, f64)> = vec![];
    for text in set {
        let source = Source::new("--set", text);
        let named = named_numbers(&source)?.into_iter();
        given.extend(named.map(|(name, value)| (name.to_string(), value)));
    }
    let mut reader = Reader::new(&source, folder);
    let mut values = vec![];
    for (name, number) in keys.parameters.iter().flat_map(|table| &table.0) {
        let value = reader.value(number)?;
        let given = given.iter().rev().find(|(own, _)| own == &**name);
        values.push(given.map_or_else(|| value.at(&values), |(_, value)| Ok(*value))?);
        reader.declare(name)?;
    }
    if let Some((unknown, _)) = given.iter().find(|(name, _)| !reader.names.contains(name)) {
        return Err(no_parameter(unknown, &reader.names));
    }
    let tree = OnTree::read(&keys, &reader)?;
    tree.tree(&values, gravity.map(Vector3::from))
}
