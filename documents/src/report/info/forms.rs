//! Closed forms of low degree, symplectic forms, contact forms, and complex structures.

use super::{LONGEST, NOT_RATIONAL, Notes, SHOWN, certainty};
use affinor::algebra::structure::{
    Certified, Existence, GroundField, MAX_FORMS, MAX_FORMS_WITH_PARAMETERS, StructureTheory,
    TwoForms,
};
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use affinor_tensors::text::combination;
use serde_json::{Value, json};

impl Notes {
    /// Adds bases of the first and the second cohomology, represented by closed forms.
    pub(super) fn cocycles<S: GroundField>(&mut self, structure: &StructureTheory<S>) {
        let n = structure.dimension();
        let one = structure.closed_one_forms();
        let two = structure.two_forms().map(|forms| forms.cohomology());
        let written: Vec<String> = one.basis().iter().map(|row| self.one_form(row)).collect();
        self.listed("first cohomology", &written, "closed 1-forms; x* is dual to x");
        let title = "second cohomology";
        match &two {
            Some(two) => {
                let written: Vec<String> = two.iter().map(|row| self.two_form(n, row)).collect();
                self.listed(title, &written, "closed 2-forms, independent of the exact ones");
            }
            None => {
                self.row(title, "-", &no_forms());
                self.reason("cocycles", &format!("two_forms: {}", no_forms()));
            }
        }
        let one: Vec<Value> = one.basis().iter().map(json_of_one).collect();
        let two = two.map(|two| two.iter().map(|row| json_of_two(n, row)).collect::<Vec<_>>());
        self.json.insert("cocycles".into(), json!({ "one_forms": one, "two_forms": two }));
    }

    fn listed(&mut self, title: &str, forms: &[String], witness: &str) {
        let text = forms.join(", ");
        let text = match forms.len() {
            0 => "0".into(),
            1..=SHOWN if text.len() <= LONGEST => text,
            all => format!("dimension {all}; basis in --format json"),
        };
        self.row(title, text, if forms.is_empty() { "" } else { witness });
    }

    fn one_form<S: GroundField>(&self, row: &Row<S>) -> String {
        combination(row.iter().map(|(at, v)| (v.to_string(), self.dual(*at))))
    }

    /// The name of a vector of the dual basis.
    fn dual(&self, at: usize) -> String {
        let label = &self.labels[at];
        if label.contains('/') { format!("({label})*") } else { format!("{label}*") }
    }

    fn two_form<S: GroundField>(&self, n: usize, row: &Row<S>) -> String {
        let pair = |at: usize| format!("{}^{}", self.dual(at / n), self.dual(at % n));
        combination(row.iter().map(|(at, v)| (v.to_string(), pair(*at))))
    }

    /// Adds symplectic forms in even dimension, contact forms in odd dimension, and a form of
    /// largest rank.
    pub(super) fn nondegenerate_forms<S: GroundField>(&mut self, structure: &StructureTheory<S>) {
        let n = structure.dimension();
        let forms = structure.two_forms();
        let even = n.is_multiple_of(2);
        match &forms {
            _ if !even => {
                self.absent("symplectic form", "symplectic", "none", "the dimension is odd")
            }
            Some(forms) => self.symplectic(structure, forms),
            None => self.absent("symplectic form", "symplectic", "-", &no_forms()),
        }
        match &forms {
            _ if even => self.absent("contact form", "contact", "none", "the dimension is even"),
            Some(_) => self.contact(structure),
            None => self.absent("contact form", "contact", "-", &no_forms()),
        }
        let regular = forms.map(|_| structure.regular_form());
        match regular {
            Some(Some(form)) => {
                self.json.insert("regular_form".into(), json_of_one(&form));
            }
            Some(None) => self.null("regular_form", "none found"),
            None => self.null("regular_form", &no_forms()),
        }
    }

    fn symplectic<S: GroundField>(&mut self, structure: &StructureTheory<S>, forms: &TwoForms<S>) {
        let n = structure.dimension();
        let [any, exact] =
            [structure.symplectic_form(forms), structure.exact_symplectic_form(forms)];
        // prefers an exact form as the witness, if there is one
        let best = if matches!(exact, Existence::Witness(_)) { &exact } else { &any };
        let (text, witness) = match best {
            Existence::Witness(form) if best == &exact => {
                (self.two_form(n, form), "exact, not degenerate (a Frobenius algebra)".into())
            }
            Existence::Witness(form) => {
                (self.two_form(n, form), "closed, not degenerate; no exact one".into())
            }
            Existence::Impossible => {
                ("none".into(), "the Pfaffian of every closed 2-form vanishes".into())
            }
            Existence::Unimodular => {
                ("none".into(), "unimodular, not solvable (theorem of Chu)".into())
            }
            Existence::Rank(Certified { dimension, proved }) => {
                let closed = forms.closed.dimension();
                let how = certainty(*proved);
                let why = format!(
                    "closed 2-forms have dimension {closed} and generic rank {dimension}; {how}"
                );
                ("none".into(), why)
            }
            // only exact forms have these two results, and an exact form is shown only if it is a witness
            Existence::Index(_) | Existence::Open => ("-".into(), "none found".to_string()),
        };
        let (text, long) = self.shortened(text);
        self.row("symplectic form", text, &format!("{witness}{long}"));
        let mut symplectic = existence(&any, |row| json_of_two(n, row));
        symplectic["exact"] = existence(&exact, |row| json_of_two(n, row));
        if let Existence::Rank(rank) = &any {
            symplectic["closed"] = json!(forms.closed.dimension());
            symplectic["rank"] = json!(rank.dimension);
            symplectic["proved"] = json!(rank.proved);
        }
        self.json.insert("symplectic".into(), symplectic);
    }

    fn contact<S: GroundField>(&mut self, structure: &StructureTheory<S>) {
        let n = structure.dimension();
        let found = structure.contact_form();
        let (text, witness) = match &found {
            Existence::Witness(form) => (self.one_form(form), "a (d a)^k is not zero".into()),
            Existence::Impossible | Existence::Unimodular => {
                ("none".into(), "a (d a)^k vanishes for every 1-form a".into())
            }
            Existence::Index(index) => {
                ("none".into(), format!("the index is {index}, and has to be 1"))
            }
            Existence::Rank(Certified { dimension, proved }) => {
                let how = certainty(*proved);
                let why = format!("d a, bordered by a, has rank {dimension} of {}; {how}", n + 1);
                ("none".into(), why)
            }
            Existence::Open => ("-".into(), "none found".to_string()),
        };
        let (text, long) = self.shortened(text);
        self.row("contact form", text, &format!("{witness}{long}"));
        let mut contact = existence(&found, json_of_one);
        if let Existence::Rank(rank) = &found {
            contact["proved"] = json!(rank.proved);
        }
        self.json.insert("contact".into(), contact);
    }

    /// The text of a form, and a remark. The text of a long form is replaced by the remark where to
    /// read it.
    fn shortened(&self, text: String) -> (String, &'static str) {
        match text.len() <= LONGEST {
            true => (text, ""),
            false => ("exists".into(), "; in --format json"),
        }
    }

    /// Adds a complex structure, in dimension 2 and 4.
    pub(super) fn complex_structure(
        &mut self,
        structure: Option<&StructureTheory<Rational>>,
        dimension: usize,
    ) {
        let Some(found) = structure.and_then(|structure| structure.complex_structure()) else {
            let (answer, why) = match dimension {
                odd if odd % 2 == 1 => ("none", "the dimension is odd"),
                0 | 2 | 4 if structure.is_none() => ("-", NOT_RATIONAL),
                0 | 2 | 4 => ("-", "not decided"),
                _ => ("-", "not computed beyond dimension 4"),
            };
            self.absent("complex structure", "complex_structure", answer, why);
            return;
        };
        let rows = found.images.map(|rows| {
            let row = |row: &Vec<Rational>| row.iter().map(Rational::to_string).collect::<Vec<_>>();
            rows.iter().map(row).collect::<Vec<_>>()
        });
        let written = rows.as_ref().map(|rows| {
            let image = |(row, label): (&Vec<String>, &String)| {
                let terms = row.iter().cloned().zip(self.labels.iter().cloned());
                let image = combination(terms.filter(|(value, _)| value != "0"));
                format!("J {label} = {image}")
            };
            rows.iter().zip(&self.labels).map(image).collect::<Vec<_>>().join(", ")
        });
        let (text, witness) = match (found.exists, written) {
            (true, Some(images)) => (images, "J^2 = -1, the Nijenhuis tensor is zero"),
            (true, None) => ("yes".into(), "no rational one is found"),
            (false, _) => {
                ("none".into(), "no complex eigenvalues and no eigenspace of dimension 2 on R^3")
            }
        };
        self.row("complex structure", text, witness);
        let json = json!({ "exists": found.exists, "images": rows });
        self.json.insert("complex_structure".into(), json);
    }
}

/// The reason why closed 2-forms are not computed.
fn no_forms() -> String {
    format!(
        "not computed beyond dimension {MAX_FORMS}, nor beyond {MAX_FORMS_WITH_PARAMETERS} with parameters or in a dense basis"
    )
}

fn existence<S>(found: &Existence<S>, form: impl Fn(&Row<S>) -> Value) -> Value {
    match found {
        Existence::Witness(row) => json!({ "exists": true, "form": form(row) }),
        Existence::Impossible
        | Existence::Unimodular
        | Existence::Index(_)
        | Existence::Rank(_) => {
            json!({ "exists": false, "form": null })
        }
        Existence::Open => json!({ "exists": null, "form": null }),
    }
}

/// A 1-form in JSON: `[[i, "v"], ...]`.
fn json_of_one<S: GroundField>(row: &Row<S>) -> Value {
    row.iter().map(|(at, value)| json!([at + 1, value.to_string()])).collect()
}

/// A 2-form in JSON: `[[i, j, "v"], ...]` with `i < j`.
fn json_of_two<S: GroundField>(n: usize, row: &Row<S>) -> Value {
    row.iter().map(|(at, value)| json!([at / n + 1, at % n + 1, value.to_string()])).collect()
}
