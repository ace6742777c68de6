//! Elements of an XML file, whose attributes are names, numbers and vectors.

use super::near;
use super::pose::Origin;
use crate::input::{InputError, Place, Source, shown};
use roxmltree::Node;
use std::ops::Range;

/// Advice for a file with macros.
pub(super) const EXPAND: &str = "expand its macros first: xacro robot.xacro > robot.urdf";

/// An element of a file.
pub(super) struct Element<'x> {
    node: Node<'x, 'x>,
    source: &'x Source,
}

impl<'x> Element<'x> {
    pub fn new(node: Node<'x, 'x>, source: &'x Source) -> Self {
        Element { node, source }
    }

    /// The name of the element.
    pub fn name(&self) -> &'x str {
        self.node.tag_name().name()
    }

    /// The location of the begin of the element, `<link`.
    pub fn place(&self) -> Place {
        let range = self.node.range();
        let text = self.source.text.get(range.clone()).unwrap_or_default();
        let ends = |c: char| c.is_whitespace() || c == '>' || c == '/';
        let length = text.find(ends).unwrap_or(text.len());
        self.within(range.start..range.start + length)
    }

    fn within(&self, span: Range<usize>) -> Place {
        Place { source: self.source.clone(), span: Some(span) }
    }

    /// The children with this name.
    pub fn children(&self, name: &str) -> impl Iterator<Item = Element<'x>> {
        let source = self.source;
        let found = self.node.children().filter(move |node| node.has_tag_name(name));
        found.map(move |node| Element { node, source })
    }

    /// The child with this name, if there is one.
    pub fn child(&self, name: &str) -> Result<Option<Element<'x>>, InputError> {
        let mut found = self.children(name);
        let (first, second) = (found.next(), found.next());
        match second {
            None => Ok(first),
            Some(second) => {
                let message = format!("<{}> has two elements <{name}>", self.name());
                Err(InputError::usage(message).at(&second.place()).help("leave one of them out"))
            }
        }
    }

    /// The child with this name, which must exist.
    pub fn needed(&self, name: &str) -> Result<Element<'x>, InputError> {
        self.child(name)?.ok_or_else(|| {
            let own = match self.node.attribute("name") {
                Some(own) => format!("{} `{}`", self.name(), shown(own)),
                None => format!("<{}>", self.name()),
            };
            let example = match name {
                "mass" => "<mass value=\"1\"/>",
                "inertia" => {
                    "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>"
                }
                "parent" => "<parent link=\"base\"/>",
                _ => "<child link=\"arm\"/>",
            };
            let error = InputError::usage(format!("{own} has no element <{name}>"));
            error.at(&self.place()).help(format!("give it, as in {example}"))
        })
    }

    /// Checks the names of children for typing errors. Elements of other programs are allowed.
    pub fn expect_children(&self, known: &[&str]) -> Result<(), InputError> {
        for node in self.node.children().filter(Node::is_element) {
            let name = node.tag_name().name();
            let distance = |other: &&str| strsim::damerau_levenshtein(other, name);
            let is_near = known.iter().any(|other| distance(other) == 1);
            if is_near && !known.contains(&name) && node.tag_name().namespace().is_none() {
                let message = format!("<{}> has no element <{}>", self.name(), shown(name));
                let place = Element { node, source: self.source }.place();
                let help = near(name, known.iter().copied(), "elements");
                return Err(InputError::usage(message).at(&place).help(help));
            }
        }
        Ok(())
    }

    /// An attribute and its location, if it is given.
    fn attribute(&self, name: &str) -> Option<(&'x str, Place)> {
        let found = self.node.attribute_node(name)?;
        Some((found.value(), self.within(found.range_value())))
    }

    /// An attribute that must exist, and its location.
    fn needed_attribute(&self, name: &str) -> Result<(&'x str, Place), InputError> {
        self.attribute(name).ok_or_else(|| {
            let own = self.name();
            let error = InputError::usage(format!("<{own}> has no attribute `{name}`"));
            error.at(&self.place()).help(format!("give it, as in <{own} {name}=\"...\">"))
        })
    }

    /// A name and its location.
    pub fn text(&self, name: &str) -> Result<(String, Place), InputError> {
        let (text, place) = self.needed_attribute(name)?;
        let error = match text {
            "" => InputError::usage(format!("the attribute `{name}` is empty")).help("give a name"),
            text if text.contains("${") => {
                InputError::usage(format!("`{}` is a macro", shown(text))).help(EXPAND)
            }
            text => return Ok((text.to_string(), place)),
        };
        Err(error.at(&place))
    }

    /// A number that must be given, and its location.
    pub fn number(&self, name: &str) -> Result<(f64, Place), InputError> {
        let (text, place) = self.needed_attribute(name)?;
        Ok((number(text, &place)?, place))
    }

    /// A number, or a value if it is not given.
    pub fn number_or(&self, name: &str, value: f64) -> Result<f64, InputError> {
        match self.attribute(name) {
            Some((text, place)) => number(text, &place),
            None => Ok(value),
        }
    }

    /// A vector of three numbers, if it is given.
    pub fn vector(&self, name: &str) -> Result<Option<[f64; 3]>, InputError> {
        let Some((text, place)) = self.attribute(name) else { return Ok(None) };
        let numbers = text.split_whitespace().map(|word| number(word, &place));
        let numbers = numbers.collect::<Result<Vec<f64>, _>>()?;
        let found = numbers.len();
        let vector = numbers.try_into().map(Some);
        vector.map_err(|_| {
            let message = format!("`{name}` has {found} numbers instead of 3");
            InputError::usage(message).at(&place).help(format!("write {name}=\"0 0 1\""))
        })
    }

    /// The element `origin`; without it, the origin of the frame outside.
    pub fn origin(&self) -> Result<Origin, InputError> {
        let Some(origin) = self.child("origin")? else { return Ok(Origin::default()) };
        let position = origin.vector("xyz")?.unwrap_or_default();
        Ok(Origin { position, angles: origin.vector("rpy")?.unwrap_or_default() })
    }
}

/// A finite number.
fn number(text: &str, place: &Place) -> Result<f64, InputError> {
    let text = text.trim();
    let error = match text.parse::<f64>() {
        Ok(value) if value.is_finite() => return Ok(value),
        Ok(_) => InputError::usage(format!("`{}` is not finite", shown(text))),
        Err(_) => InputError::usage(format!("`{}` is not a number", shown(text))),
    };
    let is_macro = text.contains("${") || text.contains("$(");
    let help = if is_macro { EXPAND } else { "write a decimal number, as in 0.5 or 1e-3" };
    Err(error.at(place).help(help))
}
