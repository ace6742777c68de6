//! The root system of the Levi subalgebra: Cartan matrix, Dynkin diagram, roots.

use super::super::grid::Cell;
use super::basis::InBases;
use super::{Notes, SOLVABLE};
use crate::input::InputError;
use crate::space::Definition;
use affinor::algebra::roots::CartanType;
use affinor::algebra::structure::dynkin::diagram;
use affinor::algebra::structure::{RootSpaces, StructureTheory, Subspace};
use affinor_tensors::{Rational, Tolerance};
use serde_json::{Value, json};

/// The reason that is shown if no Dynkin type is found.
const NOT_FOUND: &str = "the Dynkin type is not found";
/// The largest rank at which the report shows a Cartan matrix. Larger matrices are written only in
/// JSON.
const SHOWN_RANK: usize = 8;

/// The types of the simple factors of the Levi subalgebra over the complex numbers; empty for a
/// solvable algebra.
///
/// # Errors
/// An error if the brackets do not define a Lie algebra, or if the definition is on a chart. Also if
/// dividing basis vectors by square roots cannot make the structure constants rational, or if the
/// type is not found.
pub fn dynkin_type(definition: &Definition) -> Result<Vec<CartanType>, InputError> {
    let definition = definition.algebra_alone();
    let types = if definition.is_rational() {
        let algebra = definition.algebra::<Rational>(Tolerance::default())?;
        StructureTheory::new(algebra).dynkin_type()
    } else {
        let basis = InBases::of(&definition)?.rational;
        match basis.over_the_rationals() {
            Some(algebra) => StructureTheory::new(algebra).dynkin_type(),
            None => StructureTheory::new(basis.algebra().clone()).dynkin_type(),
        }
    };
    types.ok_or_else(|| InputError::mathematics("the Dynkin type was not found"))
}

impl Notes {
    /// Adds the types of the simple factors of the Levi subalgebra over the complex numbers.
    pub(super) fn types(&mut self, types: Option<&[CartanType]>, solvable: bool) {
        let written = types.map(|types| {
            let names: Vec<String> = types.iter().map(ToString::to_string).collect();
            names.join(" + ")
        });
        if solvable {
            self.absent("Dynkin type", "dynkin_type", "none", SOLVABLE);
            self.row("Dynkin diagram", "none", SOLVABLE);
            self.absent("Cartan matrix", "cartan_matrix", "none", SOLVABLE);
            return;
        }
        let Some(types) = types else {
            self.absent("Dynkin type", "dynkin_type", "not found", NOT_FOUND);
            self.row("Dynkin diagram", "-", NOT_FOUND);
            self.absent("Cartan matrix", "cartan_matrix", "-", NOT_FOUND);
            return;
        };
        self.json.insert("dynkin_type".into(), json!(written));
        let entry =
            |one: &CartanType| json!({ "type": one.to_string(), "matrix": one.cartan_matrix() });
        let matrices: Vec<Value> = types.iter().map(entry).collect();
        self.json.insert("cartan_matrix".into(), json!(matrices));
        let text = written.unwrap_or_default();
        self.row("Dynkin type", text, "of the Levi subalgebra, over the complex numbers");
        let diagrams: Vec<String> = types.iter().map(|one| diagram(*one)).collect();
        let diagrams = Cell::drawn(&diagrams.join("\n\n"));
        self.row("Dynkin diagram", diagrams, "simple roots as in Bourbaki");
        let matrix = |one: &CartanType| {
            let rows = one.cartan_matrix();
            let line =
                |row: &Vec<i64>| row.iter().map(|v| format!("{v:2}")).collect::<Vec<_>>().join(" ");
            rows.iter().map(line).collect::<Vec<_>>().join("\n")
        };
        let matrices = match types.iter().all(|one| one.rank() <= SHOWN_RANK) {
            true => {
                let matrices: Vec<String> = types.iter().map(matrix).collect();
                Cell::drawn(&matrices.join("\n\n"))
            }
            false => "in --format json".into(),
        };
        self.row("Cartan matrix", matrices, "<a_i, a_j^v>: row i, column j");
    }

    /// Adds the roots of the Levi subalgebra. If the Cartan subalgebra splits, the values of the
    /// roots on the Cartan subalgebra are added too.
    pub(super) fn roots(
        &mut self,
        types: Option<&[CartanType]>,
        levi: Option<(&StructureTheory<Rational>, &Subspace<Rational>)>,
    ) {
        let Some(known) = types.filter(|types| !types.is_empty()) else {
            let (answer, why) = match types {
                Some(_) => ("none", SOLVABLE),
                None => ("-", NOT_FOUND),
            };
            self.absent("root system", "roots", answer, why);
            return;
        };
        let rank: usize = known.iter().map(|one| one.rank()).sum();
        let all: usize = known.iter().map(|one| one.dimension() - one.rank()).sum();
        let found = levi.and_then(|(inside, levi)| Some((inside.root_spaces()?, levi)));
        let cartan = found.as_ref().map(|(found, levi)| levi.within(&found.cartan));
        let witness = match &cartan {
            Some(cartan) => {
                let basis: Vec<String> =
                    cartan.basis().iter().map(|row| self.vector(row)).collect();
                let basis = basis.join(", ");
                let short = basis.len() <= 80;
                let basis = if short { format!(": {basis}") } else { String::new() };
                format!("a Cartan subalgebra of the Levi subalgebra splits{basis}")
            }
            None => "of the Levi subalgebra, over the complex numbers".into(),
        };
        let text = format!("rank {rank}, {all} roots, {} of them positive", all / 2);
        self.row("root system", text, &witness);
        let vector =
            |values: &[Rational]| values.iter().map(Rational::to_string).collect::<Vec<_>>();
        let rows = |found: &RootSpaces| {
            found.roots.iter().map(|root| vector(&root.values)).collect::<Vec<_>>()
        };
        let simple = |found: &RootSpaces| {
            found.simple.iter().map(|&at| vector(&found.roots[at].values)).collect::<Vec<_>>()
        };
        let dense = |cartan: Subspace<Rational>| {
            let rows: Vec<Vec<String>> = cartan.dense().iter().map(|row| vector(row)).collect();
            json!({ "dimension": rows.len(), "basis": rows })
        };
        let found = found.as_ref().map(|(found, _)| found);
        let json = json!({
            "rank": rank,
            "positive": all / 2,
            "cartan_subalgebra": cartan.map(dense),
            "simple": found.map(simple),
            "vectors": found.map(rows),
        });
        self.json.insert("roots".into(), json);
    }
}
