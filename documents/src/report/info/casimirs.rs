//! Polynomial Casimir functions.

use super::{LONGEST, Notes, SHOWN};
use crate::Coefficient;
use crate::input::InputError;
use affinor::algebra::structure::{GroundField, StructureTheory};
use affinor_tensors::{Kind, Rational, Symbolic};
use serde_json::json;

/// Limits on the search for Casimir functions: the highest degree, and the largest number of
/// monomials of this degree. A third limit is on the product of this number and the number of
/// structure constants, which is large in a dense basis.
const CASIMIR_DEGREE: u32 = 4;
const MONOMIALS: usize = 350;
const TERMS: usize = 60_000;
/// The limit on this product if the structure constants have parameters.
const TERMS_OF_PARAMETERS: usize = 6_000;
impl Notes {
    /// Adds the polynomial Casimir functions up to a degree, in the basis of the algebra.
    pub(super) fn casimirs<S: GroundField + Coefficient>(
        &mut self,
        structure: &StructureTheory<S>,
        rational: Option<&StructureTheory<Rational>>,
    ) -> Result<(), InputError> {
        let constants = structure.algebra().structure_constants();
        let parameters = S::parameters_of(&mut constants.components().map(|(_, value)| value));
        if let Some(name) = parameters.iter().find(|name| is_coordinate(name)) {
            let text = format!("not computed: rename the parameter {name}");
            let why = "mu_i = mu(e_i) are the coordinates";
            self.absent("Casimir functions", "casimirs", &text, why);
            return Ok(());
        }
        let mut found = casimirs(structure);
        if found.as_ref().is_none_or(|(degree, _)| *degree < 2)
            && let Some(rational) = rational
            && let Some(generators) = rational.quadratic_casimirs()?
        {
            found = Some((2, generators));
        }
        let Some((degree, generators)) = found else {
            let why = "not computed: too many structure constants, and not reductive";
            self.absent("Casimir functions", "casimirs", "-", why);
            return Ok(());
        };
        let degrees: Vec<u32> = generators.iter().map(degree_in_mu).collect();
        let generators: Vec<String> = generators.iter().map(ToString::to_string).collect();
        let text = generators.join(", ");
        let text = match generators.len() {
            0 => "none".into(),
            1..=SHOWN if text.len() <= LONGEST => text,
            1 => "1 generator; in --format json".into(),
            all => format!("{all} generators; in --format json"),
        };
        let witness = format!("polynomials in mu_i = mu(e_i), generators up to degree {degree}");
        self.row("Casimir functions", text, &witness);
        let json = json!({ "degree": degree, "degrees": degrees, "generators": generators });
        self.json.insert("casimirs".into(), json);
        Ok(())
    }
}

/// Finds generators of the Casimir functions. Also returns the degree up to which they were
/// searched.
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
    let degree = low.last()?;
    Some((degree, structure.casimirs(degree).ok()?))
}

/// Whether `name` is the name of a coordinate `mu_i`.
fn is_coordinate(name: &str) -> bool {
    name.strip_prefix("mu").is_some_and(|number| number.parse::<usize>().is_ok())
}

/// The degree of a homogeneous polynomial in `mu1, mu2, ...`, whose coefficients may contain
/// parameters.
fn degree_in_mu(polynomial: &Symbolic) -> u32 {
    let terms = polynomial.terms();
    let powers = terms.first().into_iter().flat_map(|(powers, _)| powers);
    powers.filter(|(variable, _)| is_coordinate(variable.text())).map(|(_, power)| power).sum()
}

/// The number of monomials of a degree in `n` variables.
fn monomials(n: usize, degree: u32) -> usize {
    (1..=degree as usize).fold(1, |count, k| count * (n + k - 1) / k)
}
