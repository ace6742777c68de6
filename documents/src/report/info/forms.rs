//! Closed forms of low degree, symplectic and contact forms, Casimir functions.

use super::{Notes, SHOWN};
use crate::Coefficient;
use affinor::algebra::structure::{Existence, GroundField, MAX_DECOMPOSED, StructureTheory};
use affinor_tensors::linear::Row;
use affinor_tensors::text::combination;
use affinor_tensors::{Kind, Rational, Symbolic};
use serde_json::{Value, json};

/// The highest degree of Casimir functions, the largest number of monomials of that degree, and the largest product of that
/// number and the number of structure constants, which are many in a dense basis.
const CASIMIR_DEGREE: u32 = 4;
const MONOMIALS: usize = 350;
const TERMS: usize = 60_000;
/// The same product where the brackets have parameters.
const TERMS_OF_PARAMETERS: usize = 6_000;
/// Longer answers are written in JSON only.
const LONGEST: usize = 240;

impl Notes {
    /// Bases of the first and the second cohomology, as closed forms.
    pub(super) fn cocycles<S: GroundField>(&mut self, structure: &StructureTheory<S>) {
        let n = structure.dimension();
        let one = structure.closed_one_forms();
        let two = structure.two_forms().map(|forms| forms.cohomology());
        let written: Vec<String> = one.basis().iter().map(|row| self.one_form(row)).collect();
        self.listed("first cohomology", &written, "closed 1-forms; x* is dual to x");
        if let Some(two) = &two {
            let written: Vec<String> = two.iter().map(|row| self.two_form(n, row)).collect();
            self.listed(
                "second cohomology",
                &written,
                "closed 2-forms, independent of the exact ones",
            );
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

    /// Symplectic forms in even dimension, contact forms in odd dimension, and a form of largest rank.
    pub(super) fn nondegenerate_forms<S: GroundField>(&mut self, structure: &StructureTheory<S>) {
        let (mut symplectic, mut contact, mut regular) = (Value::Null, Value::Null, Value::Null);
        let n = structure.dimension();
        if (1..=MAX_DECOMPOSED).contains(&n) {
            if let Some(forms) = structure.two_forms().filter(|_| n.is_multiple_of(2)) {
                let [any, exact] =
                    [structure.symplectic_form(&forms), structure.exact_symplectic_form(&forms)];
                // an exact form is the better witness
                let best = if matches!(exact, Existence::Witness(_)) { &exact } else { &any };
                let (text, witness) = match best {
                    Existence::Witness(form) if best == &exact => {
                        (self.two_form(n, form), "exact, not degenerate (a Frobenius algebra)")
                    }
                    Existence::Witness(form) => {
                        (self.two_form(n, form), "closed, not degenerate; no exact one")
                    }
                    Existence::Impossible => {
                        ("none".into(), "the Pfaffian of every closed 2-form vanishes")
                    }
                    Existence::Unimodular => {
                        ("none".into(), "unimodular, not solvable (theorem of Chu)")
                    }
                    // of an exact form alone, which is shown where it is a witness
                    Existence::Index(_) | Existence::Open => ("-".into(), "none found"),
                };
                self.row("symplectic form", text, witness);
                symplectic = existence(&any, |row| json_of_two(n, row));
                symplectic["exact"] = existence(&exact, |row| json_of_two(n, row));
            }
            if n % 2 == 1 {
                let found = structure.contact_form();
                let (text, witness) = match &found {
                    Existence::Witness(form) => {
                        (self.one_form(form), "a (d a)^k is not zero".into())
                    }
                    Existence::Impossible | Existence::Unimodular => {
                        ("none".into(), "a (d a)^k vanishes for every 1-form a".into())
                    }
                    Existence::Index(index) => {
                        ("none".into(), format!("the index is {index}, and has to be 1"))
                    }
                    Existence::Open => ("-".into(), "none found".to_string()),
                };
                self.row("contact form", text, &witness);
                contact = existence(&found, json_of_one);
            }
            regular = structure.regular_form().map_or(Value::Null, |form| json_of_one(&form));
        }
        self.json.insert("symplectic".into(), symplectic);
        self.json.insert("contact".into(), contact);
        self.json.insert("regular_form".into(), regular);
    }

    /// A complex structure, in dimension 2 and 4.
    pub(super) fn complex_structure(&mut self, structure: Option<&StructureTheory<Rational>>) {
        let Some(found) = structure.and_then(|structure| structure.complex_structure()) else {
            self.json.insert("complex_structure".into(), Value::Null);
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

    /// Polynomial Casimir functions up to a degree, in the basis of the algebra.
    pub(super) fn casimirs<S: GroundField + Coefficient>(
        &mut self,
        structure: &StructureTheory<S>,
    ) {
        let constants = structure.algebra().structure_constants();
        let parameters = S::parameters_of(&mut constants.components().map(|(_, value)| value));
        if let Some(name) = parameters.iter().find(|name| is_coordinate(name)) {
            let text = format!("not computed: rename the parameter {name}");
            self.row("Casimir functions", text, "mu_i = mu(e_i) are the coordinates");
            self.json.insert("casimirs".into(), Value::Null);
            return;
        }
        let found = casimirs(structure);
        let Some((degree, generators)) = found else {
            self.json.insert("casimirs".into(), Value::Null);
            return;
        };
        let degrees: Vec<u32> = generators.iter().map(degree_in_mu).collect();
        let generators: Vec<String> = generators.iter().map(ToString::to_string).collect();
        let text = generators.join(", ");
        let text = match generators.len() {
            0 => "none".into(),
            1..=SHOWN if text.len() <= LONGEST => text,
            all => format!("{all} generators; in --format json"),
        };
        let witness = format!("polynomials in mu_i = mu(e_i), generators up to degree {degree}");
        self.row("Casimir functions", text, &witness);
        let json = json!({ "degree": degree, "degrees": degrees, "generators": generators });
        self.json.insert("casimirs".into(), json);
    }
}

/// Generators of the Casimir functions, and the degree up to which they were sought.
fn casimirs<S: GroundField + Coefficient>(
    structure: &StructureTheory<S>,
) -> Option<(u32, Vec<Symbolic>)> {
    let n = structure.dimension();
    let constants = structure.algebra().structure_constants().len();
    let terms = match S::KIND {
        Kind::Symbolic => TERMS_OF_PARAMETERS,
        _ => TERMS,
    };
    let fits = |count: usize| count <= MONOMIALS && count * constants <= terms;
    let low = (1..=CASIMIR_DEGREE).take_while(|degree| fits(monomials(n, *degree)));
    let degree = low.last().filter(|_| n <= MAX_DECOMPOSED)?;
    Some((degree, structure.casimirs(degree).ok()?))
}

/// Whether the name is that of a coordinate `mu_i`.
fn is_coordinate(name: &str) -> bool {
    name.strip_prefix("mu").is_some_and(|number| number.parse::<usize>().is_ok())
}

/// The degree of a homogeneous polynomial in `mu1, mu2, ..`, whose coefficients may have parameters.
fn degree_in_mu(polynomial: &Symbolic) -> u32 {
    let terms = polynomial.terms();
    let powers = terms.first().into_iter().flat_map(|(powers, _)| powers);
    powers.filter(|(variable, _)| is_coordinate(variable.text())).map(|(_, power)| power).sum()
}

/// How many monomials of a degree there are in `n` variables.
fn monomials(n: usize, degree: u32) -> usize {
    (1..=degree as usize).fold(1, |count, k| count * (n + k - 1) / k)
}

fn existence<S>(found: &Existence<S>, form: impl Fn(&Row<S>) -> Value) -> Value {
    match found {
        Existence::Witness(row) => json!({ "exists": true, "form": form(row) }),
        Existence::Impossible | Existence::Unimodular | Existence::Index(_) => {
            json!({ "exists": false, "form": null })
        }
        Existence::Open => json!({ "exists": null, "form": null }),
    }
}

/// `[[i, "v"], ...]`
fn json_of_one<S: GroundField>(row: &Row<S>) -> Value {
    row.iter().map(|(at, value)| json!([at + 1, value.to_string()])).collect()
}

/// `[[i, j, "v"], ...]` with `i < j`
fn json_of_two<S: GroundField>(n: usize, row: &Row<S>) -> Value {
    row.iter().map(|(at, value)| json!([at / n + 1, at % n + 1, value.to_string()])).collect()
}
