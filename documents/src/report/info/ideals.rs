//! The ideals of an algebra, and the name of the algebra.

use super::{LONGEST, NOT_RATIONAL, Notes, SHOWN, SOLVABLE, certainty};
use crate::input::InputError;
use affinor::algebra::structure::{
    Identification, Indecomposable, MAX_DECOMPOSED, RealIdeal, SimpleIdeals, StructureTheory,
    Subspace,
};
use affinor_tensors::Rational;
use affinor_tensors::text::combination;
use serde_json::{Value, json};

/// The reason why an algebra has no name.
const UNNAMED: &str = "not named: names are known up to dimension 4, of nilpotent algebras up to dimension 6, and of sums of \
                       simple, Heisenberg and named ideals";

impl Notes {
    pub(super) fn ideals(
        &mut self,
        ideals: Option<&SimpleIdeals>,
        levi: Option<&Subspace<Rational>>,
        solvable: bool,
    ) {
        let Some(SimpleIdeals { rational, real }) = ideals else {
            self.absent("simple ideals", "simple_ideals", "-", "not found");
            #[cfg(feature = "real-forms")]
            self.no_real_forms("-", "not found", Value::Null);
            return;
        };
        let entry = |ideal: &RealIdeal| {
            json!({
                "type": ideal.type_name(),
                "dimension": ideal.dimension(),
                "real_form": ideal.names.join(" or "),
                "signature": ideal.signature,
                "ideal_over_q": ideal.within + 1,
            })
        };
        let all: Vec<Value> = real.iter().map(entry).collect();
        self.json.insert("simple_ideals".into(), json!(all));
        if solvable {
            self.row("simple ideals", "none", SOLVABLE);
            #[cfg(feature = "real-forms")]
            self.no_real_forms("none", SOLVABLE, json!([]));
            return;
        }
        let over_q = rational.len();
        let line = |ideal: &RealIdeal| {
            let [plus, minus] = ideal.signature;
            let name = ideal.names.join(" or ");
            let dimension = ideal.dimension();
            // omits the basis if the ideal is the whole algebra, or if some ideal is not defined
            // over the rational numbers
            let basis = levi.filter(|_| over_q == real.len()).and_then(|levi| {
                let within = levi.within(rational.get(ideal.within)?);
                (within.dimension() < levi.ambient()).then(|| self.basis(&within))
            });
            let basis = basis.map_or(String::new(), |basis| format!("; {basis}"));
            format!(
                "{name}: type {}, dimension {dimension}, signature ({plus}, {minus}){basis}",
                ideal.type_name()
            )
        };
        let lines: Vec<String> = real.iter().map(line).collect();
        let witness = match over_q == real.len() {
            true => "of the Levi subalgebra, over the reals".to_string(),
            false => format!("of the Levi subalgebra, over the reals; {over_q} over the rationals"),
        };
        self.row("simple ideals", lines.join("\n"), &witness);
        #[cfg(feature = "real-forms")]
        self.real_forms(real);
    }

    pub(super) fn decomposition(
        &mut self,
        structure: Option<&StructureTheory<Rational>>,
        dimension: usize,
    ) -> Result<(), InputError> {
        let ideals = structure.map(|all| all.indecomposable_ideals()).transpose()?.flatten();
        let entry = |part: &Indecomposable| {
            let rows = part.ideal.dense();
            let rows: Vec<Vec<String>> =
                rows.iter().map(|row| row.iter().map(Rational::to_string).collect()).collect();
            json!({ "dimension": part.ideal.dimension(), "basis": rows, "real_parts": part.real_parts })
        };
        let Some(ideals) = ideals else {
            let why = match dimension > MAX_DECOMPOSED {
                true => format!("not computed beyond dimension {MAX_DECOMPOSED}"),
                false => NOT_RATIONAL.into(),
            };
            self.absent("indecomposable ideals", "indecomposable_ideals", "-", &why);
            return Ok(());
        };
        let json: Vec<Value> = ideals.iter().map(entry).collect();
        self.json.insert("indecomposable_ideals".into(), json!(json));
        let text: Vec<String> = ideals.iter().map(|p| p.ideal.dimension().to_string()).collect();
        let mut text = text.join(" + ");
        if ideals.len() > 1 {
            ideals.iter().for_each(|part| text += &format!("\n{}", self.basis(&part.ideal)));
        }
        let real: usize = ideals.iter().map(|part| part.real_parts).sum();
        let witness = match real == ideals.len() {
            true => "dimensions; idempotents of the centroid".to_string(),
            false => format!("dimensions over the rationals; {real} ideals over the reals"),
        };
        self.row("indecomposable ideals", text, &witness);
        Ok(())
    }

    /// The basis of an ideal, if it is short.
    fn basis(&self, ideal: &Subspace<Rational>) -> String {
        let vectors: Vec<String> =
            ideal.basis().iter().take(SHOWN).map(|row| self.vector(row)).collect();
        let text = vectors.join(", ");
        match ideal.dimension() <= SHOWN && text.len() <= LONGEST {
            true => format!("basis {text}"),
            false => "basis in --format json".into(),
        }
    }

    pub(super) fn identification(&mut self, found: Option<Identification>, rational: bool) {
        let Some(Identification { names, parameter, isomorphism, under_root, root, proved }) =
            found
        else {
            let why = if rational { UNNAMED } else { NOT_RATIONAL };
            self.absent("identification", "identification", "-", why);
            return;
        };
        let name = names.join(" or ");
        let images = isomorphism.map(|rows| {
            rows.iter()
                .map(|row| row.iter().map(Rational::to_string).collect())
                .collect::<Vec<Vec<_>>>()
        });
        let written = images.as_ref().map(|rows| {
            let vector = |row: &Vec<String>| {
                let terms = row.iter().cloned().zip(self.labels.iter().cloned());
                combination(terms.filter(|(value, _)| value != "0"))
            };
            rows.iter().map(vector).collect::<Vec<_>>().join(", ")
        });
        let witness = match written {
            Some(images) => match &under_root {
                Some(numbers) => {
                    let roots = numbers.iter().map(|v| format!("sqrt({v})")).collect::<Vec<_>>();
                    format!("its basis is {images}, times {}", roots.join(", "))
                }
                None => format!("its basis is {images}"),
            },
            None => match &root {
                _ if !proved => format!("by invariants; {}", certainty(proved)),
                Some(number) => format!("isomorphic over the reals; sqrt({number}) is needed"),
                None => "by invariants".into(),
            },
        };
        let text = match &parameter {
            Some(equation) => format!("{name}, {equation}"),
            None => name.clone(),
        };
        self.row("identification", text, &witness);
        let roots = under_root.map(|all| all.iter().map(Rational::to_string).collect::<Vec<_>>());
        let mut json = json!({
            "name": name, "parameter": parameter, "isomorphism": images, "under_root": roots,
        });
        if let Some(number) = root {
            json["root"] = json!(number.to_string());
        }
        self.json.insert("identification".into(), json);
    }
}
