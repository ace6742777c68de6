//! Problems on a Lie group: the group, its initial element, and the start of a motion.

use super::initial::InitialElement;
use super::integrator::Member;
use super::keys::{Keys, OF_CHARTS, OF_HOMOGENEOUS};
use super::reader::Reader;
use super::ready::{Factor, Ready};
#[cfg(feature = "mechanisms")]
use crate::input::Source;
use crate::input::{InputError, Place, forms::MetricText, shown};
use crate::space::{Definition, Request, Space};
use affinor::group::{AnyGroup, Opposite};
use affinor::mechanics::simulation::quantities::SymbolTable;
use affinor::{LieAlgebra, LiePoisson as Dual};
use affinor_tensors::{Rational, Symbolic, Tolerance};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The largest dimension of an algebra for which Casimir functions are computed (up to the second
/// degree).
const CASIMIRS: usize = 6;

/// The group of a problem.
#[derive(Clone, Debug)]
pub(super) struct OnGroup {
    space: Space,
    metric_place: Place,
    /// Whether the equations are right-invariant.
    right: bool,
    element: InitialElement,
}

/// The start of a motion on a group.
pub(super) struct Start<'s> {
    pub on_group: &'s OnGroup,
    /// The group of the equations: the opposite group if the equations are right-invariant.
    pub group: &'s AnyGroup,
    pub member: &'s Member<'s>,
    /// The definition of the space, with the parameters replaced by their values.
    pub definition: &'s Definition,
}

impl OnGroup {
    pub fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let right = match keys.invariance.as_deref() {
            None | Some("left") => false,
            Some("right") => true,
            Some(other) => {
                let message = format!("`{}` is neither left nor right", shown(other));
                return Err(source.refused("invariance", message));
            }
        };
        let element = InitialElement::read(&keys.initial, reader)?;
        let space = match (&keys.space, &keys.definition) {
            (Some(name), None) => {
                let is_file = name.ends_with(".toml") || name.ends_with(".json");
                let space = if is_file { reader.file(name) } else { name.to_string() };
                let space = Space::open(&Request { space: Some(space), ..Request::default() });
                let place = source.at(name);
                space.map_err(|error| error.moved("SPACE", &place).or_at(&place))?
            }
            (None, Some(definition)) => {
                let definition = definition.define(&source.table("definition"))?;
                Space::of(definition)
            }
            (None, None) => {
                let error = InputError::usage("the space is missing");
                return Err(error.help("give a name, as in space = \"so3\", or a file, as in space = \"my.toml\", or a table [definition]"));
            }
            (Some(_), Some(_)) => {
                let error = source
                    .refused("space", "the space is given twice, by name and by a definition");
                return Err(error.help("give one of space, definition"));
            }
        };
        let space = space.completed_by(keys.metric.as_ref(), keys.connection.as_ref(), source)?;
        let metric_place = match &keys.metric {
            Some(MetricText::Word(text)) => source.at(text),
            _ => source.key("metric"),
        };
        if !space.definition.is_on_chart() && !space.definition.is_homogeneous() {
            reader.refuse("a motion on a group", &[&OF_CHARTS[..], &OF_HOMOGENEOUS].concat())?;
            keys.initial.expect_lists(reader)?;
        }
        Ok(OnGroup { space, metric_place, right, element })
    }

    /// The product of groups SE(3), one for each moving body.
    #[cfg(feature = "mechanisms")]
    pub fn of_poses(count: usize, source: &Source) -> Result<Self, InputError> {
        Ok(OnGroup {
            space: Space::of(Definition::copies("se(3)", count)?),
            metric_place: source.key("bodies"),
            right: false,
            element: InitialElement::Identity,
        })
    }

    /// The space.
    pub fn into_space(self) -> Space {
        self.space
    }

    /// The definition of the space.
    pub fn definition(&self) -> &Definition {
        &self.space.definition
    }

    /// The initial element.
    pub fn element(&self) -> &InitialElement {
        &self.element
    }

    /// The space, with the parameter values of a member.
    pub fn valued(&self, member: &Member) -> Result<Cow<'_, Space>, InputError> {
        let mut values = BTreeMap::new();
        for name in self.space.definition.parameters() {
            let Some((_, value)) = member.parameters.iter().find(|(own, _)| *own == name) else {
                let message = format!("the parameter `{}` has no value", shown(&name));
                let help = "give the parameter a value in a table [parameters]";
                return Err(InputError::usage(message).at(&self.metric_place).help(help));
            };
            let exact = Rational::from_f64(*value).ok_or_else(|| {
                InputError::usage(format!(
                    "the value of `{}` is {value}, which is not finite",
                    shown(&name)
                ))
                .at(&self.metric_place)
            })?;
            values.insert(name, Symbolic::constant(exact));
        }
        let mut space = Cow::Borrowed(&self.space);
        if !values.is_empty() {
            let set = space.to_mut().definition.set(&values);
            set.map_err(|error| error.or_at(&self.metric_place))?;
        }
        Ok(space)
    }

    /// Prepares the motion of a member on the group; for right-invariant equations, on the opposite
    /// group.
    pub fn start(
        &self,
        member: &Member,
        motion: impl FnOnce(&Start) -> Result<Ready, InputError>,
    ) -> Result<Ready, InputError> {
        let space = self.valued(member)?;
        let definition = space.in_floats()?;
        let group = definition.group(Tolerance::default())?;
        let group = if self.right { AnyGroup::new(Opposite(group)) } else { group };
        let mut ready = motion(&Start { on_group: self, group: &group, member, definition })?;
        ready.factors = Factor::all(&group);
        ready.notes.extend(self.element.note(&group, &member.values()));
        Ok(ready)
    }

    /// The Casimir functions of the algebra up to the second degree, as polynomials in the
    /// components `mu1`, `mu2`, ... of the momentum. The list is empty if the algebra is large or
    /// has parameters.
    pub fn casimirs(&self) -> Vec<Symbolic> {
        if self.definition().dimension() > CASIMIRS {
            return vec![];
        }
        let algebra: Result<LieAlgebra<Symbolic>, _> =
            self.definition().algebra(Tolerance::default());
        let dual = algebra.ok().and_then(|algebra| Dual::left(&algebra).ok());
        dual.and_then(|dual| dual.casimir_generators(2).ok()).unwrap_or_default()
    }
}

impl Start<'_> {
    /// Checks that no parameter has the name of a quantity of the motion, or of the body.
    pub fn expect_new_names(&self, of_body: &[(String, f64)]) -> Result<(), InputError> {
        let names = SymbolTable::new(self.group, of_body.to_vec());
        let taken = self.member.parameters.iter().find(|(name, _)| names.find(name).is_some());
        taken.map_or(Ok(()), |(name, _)| {
            let message = format!("the name `{name}` is already in use");
            let error = self.member.source.refused(&format!("parameters.{name}"), message);
            Err(error.help(format!("choose a name other than {}", names.all(&|_| true))))
        })
    }
}
