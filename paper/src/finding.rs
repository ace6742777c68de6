//! Findings: the computed checks and values for an equation.

use affinor_documents::Coefficient;
use affinor_tensors::Tensor;

/// A statement and the outcome of its check.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The statement. Formulas are written between backticks.
    pub claim: String,
    /// The outcome of the check.
    pub outcome: Outcome,
    /// Whether the paper states or suggests this statement although it is false. The check of such
    /// a statement should fail.
    pub refuted: bool,
}

/// The outcome of the check of a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The statement holds exactly.
    Exactly,
    /// The statement holds in floats. The difference of its sides, relative to the size of the
    /// values, is below this bound.
    Within(f64),
    /// The statement fails. The text describes a component that differs; formulas are written
    /// between backticks.
    Fails(String),
    /// The statement is a computed value.
    Value,
}

impl Finding {
    /// Checks a statement: `difference` is its left side minus its right side, and should be zero.
    /// A failure names the first nonzero component.
    pub(crate) fn exact<S: Coefficient>(claim: &str, difference: &Tensor<S>) -> Self {
        let witness = difference.components().next().map(|(at, value)| {
            let indices: Vec<String> = at.iter().map(|index| (index + 1).to_string()).collect();
            match indices.as_slice() {
                [] => format!("the difference is `{value}`"),
                at => format!("component {} of the difference is `{value}`", at.join(",")),
            }
        });
        Self::of(claim, witness.map_or(Outcome::Exactly, Outcome::Fails))
    }

    /// Checks that a list of computed values equals a list of stated values. A failure names the
    /// first component that differs.
    pub(crate) fn equal<S: Coefficient>(claim: &str, left: &[S], right: &[S]) -> Self {
        let differ = left.iter().zip(right).position(|(a, b)| a != b);
        let outcome = match differ {
            None if left.len() == right.len() => Outcome::Exactly,
            None => Outcome::Fails(format!("{} values for {}", left.len(), right.len())),
            Some(at) => Outcome::Fails(format!(
                "component {} differs by `{}`",
                at + 1,
                left[at].clone() - &right[at]
            )),
        };
        Self::of(claim, outcome)
    }

    /// Checks that the difference of two sides in floats is below a bound.
    pub(crate) fn within(claim: &str, difference: f64, bound: f64) -> Self {
        let small = difference < bound;
        let outcome = if small {
            Outcome::Within(bound)
        } else {
            Outcome::Fails(format!("the difference is `{difference:.2}`"))
        };
        Self::of(claim, outcome)
    }

    /// Checks a statement on several algebras. Returns the first finding whose outcome is not
    /// expected; without one, the last finding.
    pub(crate) fn everywhere<'a>(
        claim: &str,
        findings: impl IntoIterator<Item = (&'a str, Finding)>,
    ) -> Option<Self> {
        let (mut names, mut last) = (vec![], None);
        for (name, finding) in findings {
            names.push(name);
            let stop = !finding.is_expected();
            last = Some(Finding { claim: format!("{claim}on {}", names.join(", ")), ..finding });
            if stop {
                break;
            }
        }
        last
    }

    /// A formula that shows computed values.
    pub(crate) fn value(formula: &str) -> Self {
        Self::statement(&format!("`{formula}`"))
    }

    /// A sentence that shows computed values.
    pub(crate) fn statement(text: &str) -> Self {
        Self::of(text, Outcome::Value)
    }

    /// Marks a statement as false, although the paper states or suggests it.
    pub(crate) fn refuted(mut self) -> Self {
        self.refuted = true;
        self
    }

    fn of(claim: &str, outcome: Outcome) -> Self {
        Finding { claim: claim.into(), outcome, refuted: false }
    }

    /// Whether the check has the expected outcome: a refuted statement should fail, and any other
    /// statement should hold.
    pub fn is_expected(&self) -> bool {
        matches!(self.outcome, Outcome::Fails(_)) == self.refuted
    }

    /// The outcome in words. Formulas are written between backticks.
    pub fn words(&self) -> String {
        match &self.outcome {
            Outcome::Exactly => "holds exactly".into(),
            Outcome::Within(bound) => format!("holds to `{}`", power(*bound)),
            Outcome::Fails(witness) => format!("fails: {witness}"),
            Outcome::Value => String::new(),
        }
    }
}

/// Writes a power of ten as `10^-12`.
fn power(bound: f64) -> String {
    format!("10^{}", bound.log10().round())
}

/// Allows a single finding wherever several findings are expected.
impl IntoIterator for Finding {
    type Item = Finding;
    type IntoIter = std::iter::Once<Finding>;

    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self)
    }
}
