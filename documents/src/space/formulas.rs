//! Functions, fields and tensors on the chart of a definition, which other files give as formulas.

use super::Definition;
use super::notation::{Names, shape};
use crate::input::{
    InputError, Source,
    forms::{Cell, MetricText},
};
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::{Symbolic, Tensor, Up, Variance};
use std::collections::{BTreeMap, BTreeSet};

/// The names that formulas on the chart of a definition may contain: its coordinates, parameters
/// and basis vectors, and further parameters.
pub(crate) struct ChartFormulas<'d> {
    definition: &'d Definition,
    labels: BTreeMap<String, usize>,
    declared: BTreeSet<String>,
}

impl Definition {
    /// The names of formulas with these further parameters.
    pub(crate) fn formulas(&self, parameters: &[String]) -> ChartFormulas<'_> {
        let labels = self.labels.iter().cloned().zip(0..).collect();
        let declared = self.known_parameters().into_iter().chain(parameters.iter().cloned());
        ChartFormulas { definition: self, labels, declared: declared.collect() }
    }

    /// The functions that the chart declares to be positive, and the bases of powers.
    pub(crate) fn positive_factors(&self) -> PositiveFactors {
        self.functions().map(|functions| functions.positive.known()).unwrap_or_default()
    }

    /// The functions that the chart declares to be positive.
    pub(crate) fn positive(&self) -> Vec<Symbolic> {
        self.positive_factors().factors().to_vec()
    }
}

impl ChartFormulas<'_> {
    pub(super) fn names(&self) -> Names<'_> {
        let functions = self.definition.functions();
        Names { parameters: Some(&self.declared), ..Names::open(&self.labels, functions) }
    }

    /// Reads the content of a source as a function of the coordinates.
    pub fn scalar(&self, source: &Source) -> Result<Symbolic, InputError> {
        self.names().scalar(source.content(), source)
    }

    /// Reads the content of a source as a vector field, a sum of multiples of the basis vectors.
    pub fn field(&self, source: &Source) -> Result<Tensor<Symbolic>, InputError> {
        let components = self.names().vector(source.content(), source)?;
        let components = components.into_iter().map(|(i, value)| ([i], value));
        Ok(Tensor::from_components(self.labels.len(), &[Up], components)?)
    }

    /// Reads the rows of a tensor with two slots, or its diagonal. The key `path` of the source
    /// contains them.
    pub fn rows(
        &self,
        text: &MetricText,
        slots: [Variance; 2],
        path: &str,
        source: &Source,
    ) -> Result<Tensor<Symbolic>, InputError> {
        let n = self.labels.len();
        let mut components = Vec::new();
        let mut add = |i: usize, j: usize, Cell(text): &Cell| {
            components.push(([i, j], self.scalar(&source.excerpt(text))?));
            Ok::<_, InputError>(())
        };
        match text {
            MetricText::Rows(rows) if rows.len() == n && rows.iter().all(|row| row.len() == n) => {
                for (i, row) in rows.iter().enumerate() {
                    row.iter().enumerate().try_for_each(|(j, cell)| add(i, j, cell))?;
                }
            }
            MetricText::Diagonal(entries) if entries.len() == n => {
                entries.iter().enumerate().try_for_each(|(i, cell)| add(i, i, cell))?;
            }
            MetricText::Rows(rows) => {
                let message = format!("the tensor has {}, but the dimension is {n}", shape(rows));
                return Err(source.refused(path, message));
            }
            MetricText::Diagonal(_) | MetricText::Word(_) => {
                let error = source.refused(path, "this is not a tensor in this dimension");
                return Err(
                    error.help("give an array of rows, [[...], ...], or the list of a diagonal")
                );
            }
        }
        Ok(Tensor::from_components(n, &slots, components)?)
    }
}
