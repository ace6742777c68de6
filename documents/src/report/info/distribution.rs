//! A left-invariant distribution: whether it is involutive, and what it generates.

use super::{Cell, Info, printable};
use crate::input::{InputError, Source};
use crate::space::Definition;
use affinor::algebra::{BracketWitness, Distribution};
use affinor_tensors::linear::Row;
use affinor_tensors::text::combination;
use affinor_tensors::{Symbolic, Tolerance};
use serde_json::json;

/// The largest number of brackets in a row.
const SHOWN: usize = 6;

impl Info {
    /// Adds the distribution that is spanned by vectors of the basis of the definition, such as
    /// `e1, e2 + e3`.
    ///
    /// # Errors
    /// An error with its location if the vectors cannot be parsed or are linearly dependent; also if
    /// the definition is on a chart or is a homogeneous space.
    pub fn add_distribution(
        &mut self,
        definition: &Definition,
        text: &str,
    ) -> Result<(), InputError> {
        let source = Source::new("--distribution", text);
        let whole = source.whole(text);
        if definition.is_homogeneous() || definition.is_on_chart() {
            let message = "a distribution needs a Lie algebra, not a chart or a homogeneous space";
            return Err(InputError::usage(message).at(&whole).help("name the algebra alone"));
        }
        let vectors = definition.vectors(&source)?;
        let algebra = definition.algebra_alone().algebra::<Symbolic>(Tolerance::default())?;
        let rows = vectors.into_iter().map(|vector| vector.into_iter().collect());
        let distribution = Distribution::new(&algebra, rows)
            .map_err(|error| InputError::from(error).or_at(Some(&whole)))?;
        let labels: Vec<String> = definition.labels.iter().map(|label| printable(label)).collect();
        let written = |row: &Row<Symbolic>| {
            combination(row.iter().map(|(at, value)| (value, labels[*at].clone())))
        };
        let bracket = |witness: &BracketWitness<Symbolic>| {
            let [x, y] = witness.pair.each_ref().map(&written);
            format!("[{x}, {y}] = {}", written(&witness.bracket))
        };
        let basis: Vec<String> = distribution.subspace().basis().iter().map(written).collect();
        let leaving = distribution.noninvolutive_pair();
        let growth = distribution.growth_vector();
        let brackets: Vec<String> =
            distribution.generating_brackets().iter().map(bracket).collect();
        let generates = growth.last() == Some(&algebra.dimension());
        let answer = |is: bool| if is { "yes" } else { "no" };
        let numbers: Vec<String> = growth.iter().map(usize::to_string).collect();
        let shown = match brackets.len() {
            0 => "it is a subalgebra".into(),
            1..=SHOWN => brackets.join("; "),
            all => format!("{}; ... ({all} brackets)", brackets[..SHOWN].join("; ")),
        };
        let why = match &leaving {
            Some(witness) => bracket(witness),
            None => "all brackets of its vectors are in it".into(),
        };
        for [notion, answer, witness] in [
            ["distribution", &format!("dimension {}", basis.len()), &basis.join(", ")],
            ["involutive", answer(leaving.is_none()), &why],
            ["growth vector", &numbers.join(", "), "dimensions of D, D + [D, D], ..."],
            ["bracket-generating", answer(generates), &shown],
        ] {
            self.grid.rows.push([notion, answer, witness].map(Cell::from).to_vec());
        }
        let value = json!({
            "basis": basis,
            "involutive": leaving.is_none(),
            "leaving_bracket": leaving.as_ref().map(bracket),
            "growth_vector": growth,
            "bracket_generating": generates,
            "generating_brackets": brackets,
        });
        self.json.insert("distribution".into(), value);
        Ok(())
    }
}
