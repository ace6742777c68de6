//! The columns of motions in joint coordinates.

use super::OnTree;
use crate::input::{InputError, shown};
use crate::problem::output::RowNames;
use affinor::mechanics::formula::{Formula, Symbol};
use affinor::mechanics::simulation::TreeColumns;
use affinor::mechanics::systems::tree::TreeSystem;
use affinor::mechanism::Tree;
use affinor_tensors::expression::ExpressionError;
use std::collections::{HashMap, HashSet};
use std::slice::SliceIndex;

/// Names in their order, which are found fast.
#[derive(Default)]
struct Names {
    list: Vec<String>,
    places: HashMap<String, usize>,
    /// A name that occurs twice.
    twice: Option<String>,
}

impl Names {
    fn len(&self) -> usize {
        self.list.len()
    }

    /// The index of a name.
    fn place(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    fn push(&mut self, name: String) {
        if self.places.insert(name.clone(), self.list.len()).is_some() {
            self.twice = Some(name.clone());
        }
        self.list.push(name);
    }

    fn extend(&mut self, names: impl IntoIterator<Item = String>) {
        names.into_iter().for_each(|name| self.push(name));
    }
}

/// The names of the quantities of [`TreeColumns`], and the formulas so far.
pub(super) struct TreeNames<'n> {
    names: Names,
    /// The names of the joints in formulas.
    labels: Vec<String>,
    /// The number of names that joint forces may use: the time, the numbers and the rates.
    pub states: usize,
    /// The number of numbers of a configuration, and the number of rates.
    pub sizes: [usize; 2],
    /// The number of multipliers, and of components of reactions.
    reactions: [usize; 2],
    /// The moving bodies.
    pub bodies: Vec<usize>,
    /// The parameters of the problem and their values.
    parameters: &'n [(String, f64)],
    is_conservative: bool,
    pub formulas: Vec<Formula>,
    of_parameters: Vec<String>,
}

impl<'n> TreeNames<'n> {
    /// The names of the time, the numbers and the rates, which forces and constraints may use.
    pub fn new(
        problem: &OnTree,
        tree: &Tree,
        parameters: &'n [(String, f64)],
    ) -> Result<Self, InputError> {
        let mut labels: Vec<String> = vec![];
        let mut known = HashSet::new();
        for (at, joint) in problem.joints.iter().enumerate() {
            // blanks and hyphens are not allowed in names of formulas
            let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
            let label: String = joint.own.name.chars().map(letter).collect();
            let is_name = label.starts_with(|c: char| c.is_ascii_alphabetic());
            let label = if is_name { label } else { format!("J{}", at + 1) };
            if !known.insert(label.clone()) {
                let message = format!("two joints have the name `{}`", shown(&label));
                let error = InputError::usage(message).at(&problem.place);
                return Err(error.help("choose another name"));
            }
            labels.push(label);
        }
        let mut names = Names::default();
        names.push("t".into());
        for (at, label) in labels.iter().enumerate() {
            let (numbers, rates) = (tree.numbers(at).len(), tree.rates(at).len());
            // a quaternion has one number more than rates
            let single = if numbers > rates { numbers - 4 } else { numbers };
            names.extend(of_joint("q", single, label));
            let quaternion = if numbers > rates { &["qw", "qx", "qy", "qz"][..] } else { &[] };
            names.extend(quaternion.iter().map(|stem| format!("{stem}_{label}")));
        }
        let numbers = names.len() - 1;
        for (at, label) in labels.iter().enumerate() {
            names.extend(of_joint("v", tree.rates(at).len(), label));
        }
        Ok(TreeNames {
            states: names.len(),
            names,
            labels,
            sizes: [numbers, tree.freedom()],
            reactions: [0; 2],
            bodies: vec![],
            parameters,
            is_conservative: false,
            formulas: vec![],
            of_parameters: parameters.iter().map(|(name, _)| name.clone()).collect(),
        })
    }

    /// Appends the names of the quantities of a system.
    pub fn complete(&mut self, problem: &OnTree, system: &TreeSystem) -> Result<(), InputError> {
        let TreeNames { names, labels, parameters, .. } = self;
        let (tree, multipliers) = (system.tree(), system.multipliers());
        for (at, label) in labels.iter().enumerate() {
            names.extend(of_joint("f", tree.rates(at).len(), label));
        }
        names.extend(["kinetic", "potential", "energy", "power"].map(String::from));
        names.extend((1..=6).map(|i| format!("h{i}")));
        names.push("violation".into());
        names.extend((1..=multipliers).map(|a| format!("lambda{a}")));
        let before = names.len();
        for (at, label) in labels.iter().enumerate() {
            if !tree.rates(at).is_empty() {
                names.extend((1..=6).map(|i| format!("r{i}_{label}")));
            }
        }
        self.reactions = [multipliers, names.len() - before];
        let bodies: Vec<usize> =
            (0..problem.bodies.len()).filter(|at| !problem.bodies[*at].1).collect();
        for number in 1..=bodies.len() {
            let suffix = if bodies.len() > 1 { format!("_{number}") } else { String::new() };
            let named = ["qw", "qx", "qy", "qz", "x", "y", "z"].map(String::from);
            let entries = (0..12).map(|at| format!("g{}{}", at / 4 + 1, at % 4 + 1));
            names.extend(named.into_iter().chain(entries).map(|name| name + &suffix));
        }
        names.extend((1..=6 * bodies.len()).map(|i| format!("Omega{i}")));
        let mut taken =
            parameters.iter().map(|(name, _)| name).filter(|name| names.place(name).is_some());
        if let Some(name) = taken.next().or(names.twice.as_ref()) {
            let message = format!("the name `{}` is already in use", shown(name));
            let error = InputError::usage(message).at(&problem.place);
            return Err(error.help("rename the parameter or the joint"));
        }
        self.bodies = bodies;
        self.is_conservative = system.is_conservative();
        Ok(())
    }

    pub fn parameters(&self) -> impl Iterator<Item = &String> {
        self.of_parameters.iter()
    }

    /// A formula in the first `count` quantities and the parameters.
    pub fn formula(&self, text: &str, count: usize) -> Result<Formula, ExpressionError> {
        Formula::read(text, &mut |name| match self.names.place(name).filter(|at| *at < count) {
            Some(at) => Some(Symbol::Variable(at)),
            None => self.parameter(name).map(Symbol::Number),
        })
    }

    /// Some names in their order.
    pub fn list(&self, range: impl SliceIndex<[String], Output = [String]>) -> &[String] {
        &self.names.list[range]
    }

    /// The value of a parameter.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.parameters.iter().find(|(own, _)| own == name).map(|(_, value)| *value)
    }

    /// The index of the first multiplier.
    fn multipliers(&self) -> usize {
        self.states + TreeColumns::loads(self.sizes[1])
    }

    /// The index of the first pose.
    fn poses(&self) -> usize {
        self.multipliers() + self.reactions[0] + self.reactions[1]
    }
}

/// The names of `count` quantities of a joint.
fn of_joint(stem: &str, count: usize, label: &str) -> Vec<String> {
    match count {
        1 => vec![format!("{stem}_{label}")],
        _ => (1..=count).map(|k| format!("{stem}{k}_{label}")).collect(),
    }
}

impl RowNames for TreeNames<'_> {
    fn defaults(&self) -> Vec<&'static str> {
        vec!["t", "coordinates", "rates", "poses", "energy"]
    }

    fn expand(&self, stem: &str) -> Vec<String> {
        let [numbers, freedom] = self.sizes;
        let list = |first: usize, count: usize| self.list(first..first + count).to_vec();
        match stem {
            _ if self.names.place(stem).is_some() => vec![stem.into()],
            "coordinates" => list(1, numbers),
            "rates" => list(1 + numbers, freedom),
            "forces" => list(self.states, freedom),
            "h" | "momentum" => list(self.states + freedom + 4, 6),
            "lambda" => list(self.multipliers(), self.reactions[0]),
            "reactions" => list(self.multipliers() + self.reactions[0], self.reactions[1]),
            "velocity" | "Omega" => {
                list(self.names.len() - 6 * self.bodies.len(), 6 * self.bodies.len())
            }
            "poses" | "element" => {
                let poses = list(self.poses(), TreeColumns::POSE * self.bodies.len());
                let poses = poses.chunks(TreeColumns::POSE);
                poses.flat_map(|pose| pose[..7].to_vec()).collect()
            }
            _ => vec![],
        }
    }

    fn all(&self) -> String {
        let stems = ["coordinates", "rates", "forces", "poses", "momentum", "reactions", "lambda"]
            .map(String::from);
        let names = self.list(..self.multipliers()).iter().chain(self.parameters());
        names.chain(&stems).cloned().collect::<Vec<_>>().join(", ")
    }

    fn watched(&self, stem: &str, _: &str) -> (bool, bool) {
        (stem == "energy", stem == "energy" && self.is_conservative)
    }

    fn momentum(&self) -> &'static str {
        "h"
    }

    fn add(&mut self, text: &str) -> Result<(), ExpressionError> {
        let formula = self.formula(text, self.names.len())?;
        self.formulas.push(formula);
        Ok(())
    }
}
