//! Components grouped by value, and independent components.

use super::head::printable;
use crate::Coefficient;
use affinor_tensors::{CommonFactors, Kind, Scalar, Tensor, Variance};
use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;

/// The largest number of nonzero components that are grouped by value; more components are listed
/// one per line.
pub const GROUPED: usize = 60;

/// Components that are equal up to sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Group<S> {
    /// The common value. It begins with a minus sign only if the values of all members begin with
    /// one.
    pub value: S,
    /// For each member, its indices (from 0), and whether the component is minus the common value.
    pub members: Vec<(Vec<usize>, bool)>,
}

impl<S> Group<S> {
    /// The members, written as names with signs.
    pub(super) fn names(&self, name: impl Fn(&[usize]) -> String) -> Vec<String> {
        let sign = |negative: bool| if negative { "-" } else { "" };
        let members = self.members.iter();
        members.map(|(at, negative)| sign(*negative).to_string() + &name(at)).collect()
    }
}

/// Groups the nonzero components by their value up to sign, in the order of first appearance.
///
/// The members are in the order of their indices. If the tensor is antisymmetric in two slots, a
/// component and its mirror image are next to each other, the positive one first, as in `R^1_212 =
/// -R^1_221 = ... = R^2_121 = -R^2_112 = ... = 1/4`.
pub fn groups<S: Coefficient>(tensor: &Tensor<S>) -> Vec<Group<S>> {
    groups_with(tensor, &CommonFactors::default())
}

/// Like [`groups`], but signs are determined from texts in which `factors` are written by name.
pub(super) fn groups_with<S: Coefficient>(
    tensor: &Tensor<S>,
    factors: &CommonFactors,
) -> Vec<Group<S>> {
    let negative = |value: &S| value.is_negative_with(factors);
    let mut groups: Vec<Group<S>> = Vec::new();
    let mut places: HashMap<u64, Vec<usize>> = HashMap::new();
    for (at, value) in mirrored(tensor, &negative) {
        let negative = negative(&value);
        let size = if negative { -value } else { value };
        let candidates = places.entry(size.fingerprint()).or_default();
        let known = candidates.iter().copied().find(|place| groups[*place].value == size);
        let place = known.unwrap_or_else(|| {
            candidates.push(groups.len());
            groups.push(Group { value: size, members: Vec::new() });
            groups.len() - 1
        });
        groups[place].members.push((at, negative));
    }
    for group in &mut groups {
        if group.members.iter().all(|(_, negative)| *negative) {
            group.value = -group.value.clone();
            group.members.iter_mut().for_each(|(_, negative)| *negative = false);
        }
    }
    groups
}

/// Selects one of the components that are equal up to sign by the symmetries of the tensor.
///
/// The symmetries are those that [`Tensor::pair_symmetry`] finds. The selected component has
/// ascending indices: `k < l` for a curvature, `i <= j` for a metric.
pub fn independent<S: Coefficient>(tensor: &Tensor<S>) -> Tensor<S> {
    representatives(tensor, &BTreeSet::new())
}

/// Like [`independent`], but selects the component in `listed` where a set of equal components has
/// one.
pub(super) fn representatives<S: Coefficient>(
    tensor: &Tensor<S>,
    listed: &BTreeSet<Vec<usize>>,
) -> Tensor<S> {
    let classes = classes(tensor);
    let rising = |at: &[usize]| {
        let mut rising = at.to_vec();
        for class in &classes {
            let mut indices: Vec<usize> = class.iter().map(|&slot| at[slot]).collect();
            indices.sort_unstable();
            class.iter().zip(indices).for_each(|(&slot, index)| rising[slot] = index);
        }
        rising
    };
    let represented: BTreeSet<_> = listed.iter().map(|at| rising(at)).collect();
    let is_kept = |at: &[usize]| match represented.is_empty() {
        true => classes.iter().all(|class| class.iter().is_sorted_by_key(|&slot| at[slot])),
        false => listed.contains(at) || rising(at) == at && !represented.contains(at),
    };
    tensor.filter_map(|at, value| is_kept(at).then(|| value.clone()))
}

/// A statement about the components that are not printed; `None` if all components are printed.
pub(super) fn others<S: Scalar>(tensor: &Tensor<S>, shown: &Tensor<S>) -> Option<&'static str> {
    let all = (tensor.dimension() as u64).pow(tensor.rank() as u32);
    match (tensor.len() as u64 == all, shown.len() == tensor.len()) {
        (true, true) => None,
        (false, true) => Some("all others are zero"),
        (true, false) => Some("all others follow by symmetry"),
        (false, false) => Some("all others follow by symmetry or are zero"),
    }
}

/// The text `12 nonzero components, 6 shown`; `None` for a tensor of rank 0.
pub(super) fn count<S: Scalar>(tensor: &Tensor<S>, shown: &Tensor<S>) -> Option<String> {
    let components = if tensor.len() == 1 { "component" } else { "components" };
    let all = format!("{} nonzero {components}", tensor.len());
    let less = shown.len() < tensor.len();
    let text = if less { format!("{all}, {} shown", shown.len()) } else { all };
    (tensor.rank() > 0).then_some(text)
}

/// The texts of [`count`] and [`others`], joined to a sentence.
pub(super) fn summary<S: Scalar>(tensor: &Tensor<S>, shown: &Tensor<S>) -> Option<String> {
    let count = count(tensor, shown)?;
    Some(match others(tensor, shown) {
        Some(others) => format!("{count}; {others}."),
        None => format!("{count}."),
    })
}

/// The indices of a component, as numbers from 1 or as names.
pub(super) fn index_names(at: &[usize], names: Option<&[String]>) -> Vec<String> {
    let written = |index: &usize| match names.and_then(|names| names.get(*index)) {
        Some(name) => printable(name),
        None => (index + 1).to_string(),
    };
    at.iter().map(written).collect()
}

/// Groups the indices into runs of equal variance: `^1`, `_212`.
pub(super) fn runs(
    slots: &[Variance],
    indices: impl IntoIterator<Item = String>,
) -> Vec<(Variance, Vec<String>)> {
    let mut runs: Vec<(Variance, Vec<String>)> = Vec::new();
    for (&slot, index) in slots.iter().zip(indices) {
        match runs.last_mut() {
            Some((variance, run)) if *variance == slot => run.push(index),
            _ => runs.push((slot, vec![index])),
        }
    }
    runs
}

/// Whether the indices of a run are separated by commas: above dimension 9, and if a name has
/// several characters.
pub(super) fn needs_commas(dimension: usize, run: &[String]) -> bool {
    dimension > 9 || run.iter().any(|index| index.chars().nth(1).is_some())
}

/// The [`runs`] as text: `212`, `10,2,10`, `theta,r`. A run is in braces if a name contains `_`.
pub(super) fn scripts(
    dimension: usize,
    slots: &[Variance],
    indices: impl IntoIterator<Item = String>,
) -> Vec<(Variance, String)> {
    let joined = |(variance, run): (Variance, Vec<String>)| {
        let text = run.join(if needs_commas(dimension, &run) { "," } else { "" });
        (variance, if text.contains('_') { format!("{{{text}}}") } else { text })
    };
    runs(slots, indices).into_iter().map(joined).collect()
}

/// Appends the value as plain text. Very small and very large floats get an exponent.
pub(super) fn append<S: Coefficient>(text: &mut String, value: &S) {
    let extreme = |x: &f64| S::KIND == Kind::Float && !(1e-5..1e16).contains(&x.abs());
    let written = match value.to_f64().filter(extreme) {
        Some(x) if x != 0.0 && x.is_finite() => write!(text, "{x:e}"),
        _ => write!(text, "{value}"),
    };
    written.expect("a string takes every text");
}

/// The value in plain text.
pub(super) fn plain<S: Coefficient>(value: &S) -> String {
    let mut text = String::new();
    append(&mut text, value);
    text
}

/// The value as plain text, with the factors written by name.
pub(super) fn with_names<S: Coefficient>(value: &S, factors: &CommonFactors) -> String {
    if factors.is_empty() && S::KIND == Kind::Float {
        return plain(value);
    }
    value.text_with(factors)
}

/// The components in the order of their indices, except that mirror images in an antisymmetric pair
/// of slots are next to each other.
fn mirrored<S: Coefficient>(
    tensor: &Tensor<S>,
    negative: &impl Fn(&S) -> bool,
) -> Vec<(Vec<usize>, S)> {
    let rank = tensor.rank();
    let mut pairs = (0..rank).rev().flat_map(|b| (0..b).rev().map(move |a| (a, b)));
    let pair = pairs.find(|&(a, b)| tensor.pair_symmetry(a, b) == Some(-1));
    let mut listed = Vec::with_capacity(tensor.len());
    for (at, value) in tensor.components() {
        let here = (at.to_vec(), value.clone());
        match pair {
            None => listed.push(here),
            Some((a, b)) if at[a] < at[b] => {
                let mut mirror = at.to_vec();
                mirror.swap(a, b);
                let there = (mirror.clone(), tensor.get(&mirror));
                listed.extend(if negative(value) { [there, here] } else { [here, there] });
            }
            Some(_) => {}
        }
    }
    listed
}

/// Groups the slots into classes. The slots of a class are pairwise symmetric, or pairwise
/// antisymmetric.
fn classes<S: Scalar>(tensor: &Tensor<S>) -> Vec<Vec<usize>> {
    let mut classes: Vec<Vec<usize>> = Vec::new();
    for slot in 0..tensor.rank() {
        let joins = |class: &Vec<usize>| {
            let mut signs = class.iter().map(|&other| tensor.pair_symmetry(other, slot));
            let first = signs.next().flatten();
            first.is_some() && signs.all(|sign| sign == first)
        };
        match classes.iter().position(joins) {
            Some(class) => classes[class].push(slot),
            None => classes.push(vec![slot]),
        }
    }
    classes
}
