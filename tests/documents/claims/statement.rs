//! Claims about line elements, as text: `ricci[1,2] = 0`.
//!
//! The left side of a claim is a tensor, a component `[i,j]`, its value at a vector `(v1, ..., vn)`, or `sectional`, the
//! constant sectional curvature. The right side is zero, a function, or a function times the metric.
//! `tests/references/line_elements.py` reads the tables of claims and confirms them in 50 digits at random points.

use crate::common::root;
use affinor::Geometry;
use affinor_documents::input::InputError;
use affinor_documents::report::{Quantity, Table};
use affinor_documents::space::Definition;
use affinor_tensors::{Symbolic, Tensor, Tolerance};
use num_traits::Zero;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A line element, and its geometry.
pub struct LineElement {
    /// The definition file.
    keys: Value,
    geometry: Geometry<Symbolic>,
}

fn geometry(keys: &Value) -> Result<Geometry<Symbolic>, InputError> {
    Definition::parse("line_element.json", &keys.to_string())?.geometry(Tolerance::default())
}

impl LineElement {
    /// Reads a definition file in TOML.
    pub fn read(text: &str) -> Result<Self, String> {
        let keys: toml::Table = text.parse().unwrap();
        let keys = serde_json::to_value(keys).unwrap();
        let geometry = geometry(&keys).map_err(|error| error.to_string())?;
        Ok(LineElement { keys, geometry })
    }

    fn dimension(&self) -> usize {
        self.keys["chart"]["coordinates"].as_array().unwrap().len()
    }

    /// A function on the chart. It is the first component of a metric that is never degenerate.
    ///
    /// # Errors
    /// An error if the function cannot be parsed.
    pub fn function(&self, text: &str) -> Result<Symbolic, String> {
        let entry = |i: usize, j: usize| match (i, j) {
            (0, 0) => text,
            (0, 1) | (1, 0) => "1",
            _ if i == j && i > 1 => "1",
            _ => "0",
        };
        let n = self.dimension();
        let rows: Vec<Vec<&str>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let mut keys = self.keys.clone();
        keys["metric"] = json!({ "components": rows });
        let geometry = geometry(&keys).map_err(|error| error.to_string())?;
        Ok(geometry.metric().unwrap().components().get(&[0, 0]))
    }

    fn tensor(&self, key: &str) -> Result<Tensor<Symbolic>, String> {
        let quantity = Quantity::from_key(key).unwrap_or_else(|| panic!("{key}"));
        let table = Table::new(&self.geometry, &[quantity]).map_err(|error| error.to_string())?;
        Ok(table.tensors.into_iter().next().unwrap().tensor)
    }

    /// Whether a claim holds.
    ///
    /// # Errors
    /// An error if the function or tensor cannot be parsed.
    pub fn holds(&self, claim: &str) -> Result<bool, String> {
        let (left, right) = claim.split_once(" = ").unwrap();
        let metric = self.geometry.metric().unwrap().components();
        if left == "sectional" {
            // R^i_jkl = K (delta^i_k g_jl - delta^i_l g_jk)
            let (curvature, k) = (self.tensor("curvature")?, self.function(right)?);
            let delta = |i: usize, j: usize, k: usize, l: usize| match i == k {
                true => metric.get(&[j, l]),
                false => Symbolic::zero(),
            };
            return Ok(self.all(4, |at| {
                let [i, j, p, q] = at[..] else { unreachable!() };
                let expected = (delta(i, j, p, q) - &delta(i, j, q, p)) * &k;
                curvature.get(at) == expected
            }));
        }
        if let Some((key, indices)) = left.strip_suffix(']').and_then(|left| left.split_once('[')) {
            let at: Vec<usize> =
                indices.split(',').map(|index| index.parse::<usize>().unwrap() - 1).collect();
            return Ok(self.tensor(key)?.get(&at) == self.function(right)?);
        }
        if let Some((key, vector)) = left.strip_suffix(')').and_then(|left| left.split_once('(')) {
            let vector: Vec<Symbolic> =
                entries(vector).into_iter().map(|v| self.function(v)).collect::<Result<_, _>>()?;
            let terms = self.tensor(key)?;
            let terms = terms
                .components()
                .map(|(at, v)| at.iter().fold(v.clone(), |product, i| product * &vector[*i]));
            let found = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
            return Ok(found == self.function(right)?);
        }
        let tensor = self.tensor(left)?;
        match right.strip_suffix("*metric") {
            Some(factor) => {
                let factor = self.function(factor)?;
                Ok(self.all(2, |at| tensor.get(at) == factor.clone() * &metric.get(at)))
            }
            None if right == "0" => Ok(tensor.is_empty()),
            None => Ok(tensor.get(&[]) == self.function(right)?),
        }
    }

    /// Whether a property holds for all indices.
    fn all(&self, rank: usize, holds: impl Fn(&[usize]) -> bool) -> bool {
        let n = self.dimension();
        (0..n.pow(rank as u32)).all(|number| {
            let at: Vec<usize> = (0..rank).map(|place| number / n.pow(place as u32) % n).collect();
            holds(&at)
        })
    }
}

/// The parts between commas, except commas in parentheses.
fn entries(list: &str) -> Vec<&str> {
    let (mut depth, mut from, mut found) = (0, 0, vec![]);
    for (at, c) in list.char_indices() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if c == ',' && depth == 0 {
            found.push(list[from..at].trim());
            from = at + 1;
        }
    }
    found.push(list[from..].trim());
    found
}

/// A definition file of a folder of the workspace.
pub fn file(folder: &str, name: &str) -> String {
    std::fs::read_to_string(root().join(format!("{folder}/{name}.toml"))).unwrap()
}

/// Tests claims about the definition files of a folder, and fails with all that do not hold.
pub fn assert_all(folder: &str, claims: &[(&str, &str)]) {
    let mut grouped: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, claim) in claims {
        grouped.entry(name).or_default().push(claim);
    }
    let failures: Vec<String> = grouped
        .into_par_iter()
        .flat_map(|(name, claims)| {
            let element = LineElement::read(&file(folder, name));
            let failure = |claim: &str| match &element {
                Err(error) => Some(format!("{name}: {error}")),
                Ok(element) => match element.holds(claim) {
                    Ok(true) => None,
                    Ok(false) => Some(format!("{name}: not {claim}")),
                    Err(error) => Some(format!("{name}: {claim}: {error}")),
                },
            };
            claims.into_iter().filter_map(failure).collect::<Vec<_>>()
        })
        .collect();
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}
