//! A basis in which structure constants that contain square roots become rational, and the rows of
//! the report about it.

use super::{Cell, Info, SHOWN, printable};
use crate::input::InputError;
use crate::space::Definition;
use affinor::LieAlgebra;
use affinor::algebra::RationalBasis;
use affinor_tensors::{Symbolic, Tolerance};
use num_traits::Zero;
use serde_json::json;

/// The algebra of a definition in its given basis, and in a basis whose structure constants contain
/// no roots.
pub(super) struct InBases {
    given: LieAlgebra<Symbolic>,
    pub rational: RationalBasis,
}

impl InBases {
    /// # Errors
    /// An error if the brackets do not define a Lie algebra, or if the definition is on a chart. Also
    /// if dividing basis vectors by square roots cannot make the structure constants rational.
    pub fn of(definition: &Definition) -> Result<Self, InputError> {
        let given = definition.algebra::<Symbolic>(Tolerance::default())?;
        let rational = RationalBasis::of(&given).map_err(|error| definition.refused(error))?;
        Ok(InBases { given, rational })
    }

    /// The number `c`, if the Killing form is `c` times the identity in the given basis.
    fn killing_multiple(&self) -> Option<Symbolic> {
        let form = self.given.killing_form();
        let multiple = form.get(&[0, 0]);
        let same = form.components().all(|(at, value)| at[0] == at[1] && *value == multiple);
        (!multiple.is_zero() && same && form.len() == self.given.dimension()).then_some(multiple)
    }
}

impl Info {
    /// Adds the rows about the rational basis, if it differs from the given basis.
    pub(super) fn describe(&mut self, bases: &InBases) {
        if !bases.rational.is_new() {
            return;
        }
        let (given, labels) = (bases.given.labels(), bases.rational.algebra().labels());
        let changed = given.iter().zip(labels).filter(|(old, new)| old != new);
        let (old, new): (Vec<&str>, Vec<&str>) =
            changed.map(|(old, new)| (old.as_str(), new.as_str())).unzip();
        let answer = match new.len() {
            1..=SHOWN => {
                format!("computed with {} instead of {}", new.join(", "), old.join(", "))
            }
            all => format!("computed with {all} other basis vectors; in --format json"),
        };
        let why = "there the structure constants are rational; all rows refer to this basis";
        let rows = &mut self.grid.rows;
        rows.insert(0, [&printable(&answer), why].map(Cell::from).into());
        rows[0].insert(0, "basis".into());
        let multiple = bases.killing_multiple().map(|multiple| multiple.to_string());
        if let Some(multiple) = &multiple {
            let answer = format!("{multiple} * identity");
            let row = ["Killing form", &answer, "in the given basis"].map(Cell::from).to_vec();
            let first = rows.iter().position(|row| row[0] == "Killing form".into());
            rows.insert(first.map_or(rows.len(), |at| at + 1), row);
        }
        let divisors: Vec<String> =
            bases.rational.divisors().iter().map(Symbolic::to_string).collect();
        let json = json!({ "given": given, "divisors": divisors, "killing_multiple": multiple });
        self.json.insert("rational_basis".into(), json);
    }
}
