//! Named factors: common factors of several components of a table.

use super::components::{GROUPED, groups};
use super::{OnChart, Table};
use crate::Coefficient;
use crate::formula::{Row, formula, name};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{CommonFactors, Kind, Symbolic, Tensor};

/// The common factors of a table, each with a line that defines it.
#[derive(Default)]
pub(super) struct NamedFactors {
    pub factors: CommonFactors,
    pub lines: Vec<NamedFactor>,
}

/// A named factor, such as `D = det g = a*b - c^2`.
pub(super) struct NamedFactor {
    pub name: String,
    /// The rows and columns of the metric, from 1, of which the factor is the determinant, and
    /// whether they are all rows and columns.
    determinant: Option<(Vec<usize>, bool)>,
    /// The factor in plain text.
    pub text: String,
}

impl NamedFactor {
    /// The name, and its meanings: `D`, then `det g` or `det g[1,2,3]`.
    pub fn is(&self) -> Vec<String> {
        let minor = |(rows, all): &(Vec<usize>, bool)| match all {
            true => "det g".to_string(),
            false => format!("det g[{}]", list(rows)),
        };
        [self.name.clone()].into_iter().chain(self.determinant.as_ref().map(minor)).collect()
    }

    /// Like [`is`](Self::is), as formulas.
    pub fn is_in_formulas(&self) -> Vec<Row> {
        let minor = |(rows, all): &(Vec<usize>, bool)| match all {
            true => formula("det g"),
            false => formula(&format!("det g_{{[{}]}}", list(rows))),
        };
        let name = vec![name(&self.name)];
        [name].into_iter().chain(self.determinant.as_ref().map(minor)).collect()
    }
}

fn list(rows: &[usize]) -> String {
    rows.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
}

/// The largest size of determinants that are tried as factors.
const LARGEST: usize = 8;

impl<S: Coefficient> Table<S> {
    /// The factors for which names make the table shorter.
    pub(super) fn factors(&self) -> NamedFactors {
        if S::KIND != Kind::Symbolic || self.parameters.is_empty() {
            return NamedFactors::default();
        }
        let shown: Vec<_> = self.tensors.iter().map(|entry| self.shown(entry)).collect();
        let (short, long): (Vec<_>, Vec<_>) = shown.iter().partition(|t| t.len() <= GROUPED);
        // counts the value of equal components once, because the table writes it once
        let groups: Vec<_> = short.into_iter().flat_map(|tensor| groups(tensor)).collect();
        let listed = long.iter().flat_map(|tensor| tensor.components().map(|(_, value)| value));
        let mut taken = [&self.parameters[..], &self.labels].concat();
        taken.extend(self.chart.iter().flat_map(|OnChart { coordinates, .. }| coordinates.clone()));
        let mut values = groups.iter().map(|group| &group.value).chain(listed);
        let factors = S::common_factors(&mut values, &taken);
        if factors.is_empty() {
            return NamedFactors::default();
        }
        let determinants = self.metric.as_ref().map(determinants).unwrap_or_default();
        let line = |(name, value): (&str, Symbolic)| {
            let text = value.to_string();
            let found = determinants.iter().find(|(_, determinant)| *determinant == text);
            NamedFactor {
                name: name.into(),
                determinant: found.map(|(rows, _)| (rows.clone(), rows.len() == self.labels.len())),
                text,
            }
        };
        let lines = factors.iter().map(line).collect();
        NamedFactors { factors, lines }
    }
}

/// The determinants of the blocks of a metric, each with the rows of its block, from 1.
fn determinants<S: Coefficient>(metric: &Tensor<S>) -> Vec<(Vec<usize>, String)> {
    let mut blocks: Vec<Vec<usize>> = (0..metric.dimension()).map(|i| vec![i]).collect();
    for (at, _) in metric.components() {
        let [i, j] = [at[0], at[1]].map(|row| blocks.iter().position(|block| block.contains(&row)));
        if let (Some(i), Some(j)) = (i, j)
            && i != j
        {
            let other = std::mem::take(&mut blocks[i.max(j)]);
            blocks[i.min(j)].extend(other);
        }
    }
    let mut determinants = Vec::new();
    for mut rows in blocks.into_iter().filter(|rows| (2..=LARGEST).contains(&rows.len())) {
        rows.sort_unstable();
        let row = |i: &usize| rows.iter().map(|j| metric.get(&[*i, *j])).collect();
        let entries: Vec<Vec<S>> = rows.iter().map(row).collect();
        let determinant = Matrix::from_dense(&entries).and_then(|matrix| matrix.determinant());
        if let Ok(determinant) = determinant {
            let numbers = rows.iter().map(|row| row + 1).collect();
            determinants.push((numbers, determinant.to_string()));
        }
    }
    determinants
}
