//! The structure of a Lie algebra: one row for each notion, with the answer and a witness.

mod basis;
mod casimirs;
mod coefficients;
#[cfg(feature = "modules")]
mod cohomology;
#[cfg(feature = "mechanisms")]
mod distribution;
mod exceptional;
mod forms;
mod homogeneous;
mod ideals;
mod notes;
#[cfg(feature = "real-forms")]
mod real_forms;
mod roots;
mod rows;

pub use coefficients::Coefficients;
pub use roots::dynkin_type;

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::Coefficient;
use crate::input::InputError;
use crate::space::Definition;
use affinor::algebra::structure::{
    GroundField, MAX_DECOMPOSED, MAX_DERIVATIONS, SimpleIdeals, StructureTheory, Subspace,
};
use affinor_tensors::linear::Row;
use affinor_tensors::scalar::divisors_of;
use affinor_tensors::{Rational, Tolerance};
use basis::InBases;
use notes::Notes;
use rows::Rows;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.info/1";
/// The largest number of vectors and of characters of bases in the report. Larger bases are written
/// only in JSON.
const SHOWN: usize = 12;
const LONGEST: usize = 240;

/// The reason why answers over the rational numbers are missing.
const NOT_RATIONAL: &str = "not computed unless the structure constants are rational numbers";
/// The reason why rows of a solvable algebra have no answer.
const SOLVABLE: &str = "the Levi subalgebra is 0";

/// The structure of an algebra, ready for output.
#[derive(Clone, Debug)]
pub struct Info {
    grid: Grid,
    json: Map<String, Value>,
    /// For each key, the matrix that is written at the end of its JSON object.
    matrices: BTreeMap<&'static str, Rows>,
}

impl Info {
    /// Computes the structure of the algebra of a definition, or of its homogeneous space; `stage` is called before each part.
    ///
    /// # Errors
    /// An error if the brackets do not define a Lie algebra, or if the definition is on a chart. Also
    /// if dividing basis vectors by square roots cannot make the structure constants rational.
    pub fn of(definition: &Definition, stage: &dyn Fn(&str)) -> Result<Self, InputError> {
        Self::with_coefficients(definition, &Coefficients::Trivial, stage)
    }

    /// As [`Info::of`], with the cohomology for these coefficients. Trivial coefficients add no row,
    /// because the Betti numbers are in every report.
    ///
    /// # Errors
    /// As [`Info::of`]; also if matrices are not a module of the algebra.
    pub fn with_coefficients(
        definition: &Definition,
        coefficients: &Coefficients,
        stage: &dyn Fn(&str),
    ) -> Result<Self, InputError> {
        let definition = definition.algebra_alone();
        let tolerance = Tolerance::default();
        stage("jacobi");
        if let Some(algebra) = definition.algebra_of_group() {
            if !definition.is_rational() {
                let message = "the structure of a homogeneous space is computed over the rational numbers only";
                return Err(InputError::usage(message).help("set all parameters with --set"));
            }
            let space = definition.homogeneous::<Rational>(tolerance)?;
            return space.map_or_else(
                || Err(InputError::usage("the definition is not a homogeneous space")),
                |space| Self::of_homogeneous(&space, algebra, coefficients, stage),
            );
        }
        if definition.is_rational() {
            let algebra = definition.algebra::<Rational>(tolerance)?;
            let structure = StructureTheory::new(algebra);
            return Self::new(&definition.name, &structure, &[], coefficients, stage);
        }
        let (bases, parameters) = (InBases::of(&definition)?, definition.parameters());
        let numbers = bases.rational.over_the_rationals().filter(|_| parameters.is_empty());
        let mut divisors = vec![];
        let mut info = match numbers {
            Some(algebra) => {
                let structure = StructureTheory::new(algebra);
                Self::new(&definition.name, &structure, &[], coefficients, stage)?
            }
            None => {
                let structure = StructureTheory::new(bases.rational.algebra().clone());
                let (info, pivots) = divisors_of(|| {
                    Self::new(&definition.name, &structure, &parameters, coefficients, stage)
                });
                divisors = pivots;
                if parameters.len() == 1 {
                    divisors.extend(structure.deciding_expressions());
                }
                info?
            }
        };
        info.describe(&bases);
        if !parameters.is_empty() {
            stage("exceptional values");
            info.exceptional_values(&parameters, &divisors, &definition);
        }
        Ok(info)
    }

    /// Computes the structure of an algebra with this name, whose structure constants depend on
    /// `parameters`, with the cohomology for these coefficients.
    ///
    /// # Errors
    /// An error of usage if matrices of coefficients are not a module of the algebra.
    pub fn new<S: GroundField + Coefficient>(
        name: &str,
        structure: &StructureTheory<S>,
        parameters: &[String],
        coefficients: &Coefficients,
        stage: &dyn Fn(&str),
    ) -> Result<Self, InputError> {
        let mut notes = Notes::new(structure.algebra().labels());
        let n = structure.dimension();
        stage("series");
        let killing = structure.killing();
        let derived = structure.derived_series();
        let lower = structure.lower_central_series();
        let upper = structure.upper_central_series();
        let centre = structure.centre();
        stage("radical");
        let (radical, nilradical) = (structure.radical(), structure.nilradical());
        stage("levi");
        let levi = structure.levi()?;
        stage("cartan");
        let cartan = structure.cartan_subalgebra();
        stage("type");
        let types = structure.dynkin_type();
        let inside = rational_subalgebra(structure, levi)?;
        let ideals = match &inside {
            _ if levi.is_zero() => Some(SimpleIdeals { rational: vec![], real: vec![] }),
            Some(inside) => inside.simple_ideals()?,
            None => None,
        };
        stage("derivations");
        let (counted, inner) = (structure.derivation_dimension(), n - centre.dimension());
        let derivations = counted.map(|all| all.dimension);
        let forms = structure.invariant_form_dimension();
        stage("cohomology");
        let betti = structure.betti_numbers();
        let (index, unimodular) = (structure.index(), structure.is_unimodular());

        let last = |series: &[Subspace<S>]| series.last().is_some_and(Subspace::is_zero);
        let (solvable, nilpotent) = (last(derived), last(derived) && last(lower));
        let simple = match (&ideals, types.as_deref()) {
            _ if !radical.is_zero() => Some(false),
            (Some(ideals), _) => Some(ideals.real.len() == 1),
            // a single simple factor over the complex numbers means that the algebra is simple for
            // generic parameter values
            (None, Some([_])) => Some(true),
            (None, _) => None,
        };
        let complete = match derivations {
            _ if !centre.is_zero() => Some(false),
            all => all.map(|all| all == inner),
        };
        let unproved = centre.is_zero() && counted.is_some_and(|all| !all.proved);
        let doubt = match complete {
            None => Some(format!("derivations are not counted beyond dimension {MAX_DERIVATIONS}")),
            Some(_) => unproved.then(|| certainty(false).into()),
        };
        let steps = |series: &[Subspace<S>], is: bool| is.then(|| series.len() - 1);
        let (class, length) = (steps(lower, nilpotent), steps(derived, solvable));
        let words = |value: Option<usize>, unit: &str| value.map(|v| format!("{unit} {v}"));
        notes.flags(&[
            ("abelian", Some(structure.is_abelian()), None),
            ("nilpotent", Some(nilpotent), words(class, "step")),
            ("solvable", Some(solvable), words(length, "length")),
            ("unimodular", Some(unimodular), None),
            ("perfect", Some(structure.is_perfect()), None),
            ("reductive", Some(structure.is_reductive()), None),
            ("semisimple", Some(structure.is_semisimple()), None),
            ("simple", simple, simple.is_none().then(|| "the simple ideals are not found".into())),
            ("complete", complete, doubt),
        ]);
        notes.number("nilpotency_class", class, "not nilpotent");
        notes.number("derived_length", length, "not solvable");
        notes.series("derived series", "derived_series", derived);
        notes.series("lower central series", "lower_central_series", lower);
        notes.series("upper central series", "upper_central_series", &upper);
        notes.subspace("centre", "centre", &centre, "commutes with the basis");
        notes.killing(killing);
        let why = "orthogonal to [L, L] for the Killing form";
        notes.subspace("solvable radical", "radical", radical, why);
        notes.subspace("nilradical", "nilradical", &nilradical, "largest nilpotent ideal");
        let why = "closed, Killing form not degenerate";
        notes.subspace("Levi subalgebra", "levi", levi, why);
        notes.json.insert("rank".into(), json!(cartan.dimension()));
        let why = "nilpotent, its own normalizer";
        notes.subspace("Cartan subalgebra", "cartan_subalgebra", &cartan, why);
        notes.types(types.as_deref(), levi.is_zero());
        stage("roots");
        let over_q = rational_subspace(levi);
        notes.roots(types.as_deref(), inside.as_ref().zip(over_q.as_ref()));
        notes.ideals(ideals.as_ref(), over_q.as_ref(), levi.is_zero());
        notes.derivations(counted, inner);
        let betti = betti.as_ref().map(|(numbers, proved)| (&numbers[..], *proved));
        notes.betti(betti, structure.is_reductive());
        #[cfg(feature = "modules")]
        notes.cohomology(structure, coefficients)?;
        #[cfg(not(feature = "modules"))]
        debug_assert!(*coefficients == Coefficients::Trivial, "the feature `modules` is missing");
        let why = "dimension minus the generic rank of f([x,y])";
        notes.count("index", "index", Some(index), why);
        let why = "dimension of B([x,y],z) = B(x,[y,z])";
        notes.count("invariant forms", "invariant_forms", forms, why);
        let rational = structure.over_the_rationals();
        let low = rational.as_ref().filter(|_| n <= MAX_DECOMPOSED);
        stage("forms");
        notes.cocycles(structure);
        notes.complex_structure(rational.as_ref(), n);
        notes.nondegenerate_forms(structure);
        stage("casimirs");
        notes.casimirs(structure, rational.as_ref())?;
        stage("decomposition");
        notes.decomposition(low, n)?;
        stage("identification");
        notes.identification(
            rational.as_ref().and_then(StructureTheory::identify),
            rational.is_some(),
        );
        Ok(notes.finish(name, n, S::KIND, parameters))
    }
}

/// The Levi subalgebra in the basis of its echelon form, if its structure constants are rational.
fn rational_subalgebra<S: GroundField>(
    structure: &StructureTheory<S>,
    levi: &Subspace<S>,
) -> Result<Option<StructureTheory<Rational>>, InputError> {
    if levi.is_zero() {
        return Ok(None);
    }
    Ok(structure.subalgebra(levi)?.over_the_rationals())
}

/// The certainty of a dimension that was found from ranks modulo primes.
fn certainty(proved: bool) -> &'static str {
    if proved { "proved" } else { "modulo two primes" }
}

/// The subspace over the rationals, if its basis is rational.
fn rational_subspace<S: GroundField>(subspace: &Subspace<S>) -> Option<Subspace<Rational>> {
    let rows = subspace.basis().iter().map(|row| {
        row.iter().map(|(at, value)| Some((*at, value.rational()?))).collect::<Option<Row<_>>>()
    });
    Some(Subspace::span(subspace.ambient(), rows.collect::<Option<Vec<_>>>()?))
}

impl Report for Info {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        if format != Format::Json {
            return self.grid.write(format, out);
        }
        // writes one key per line, because bases are long
        for (at, (key, value)) in self.json.iter().enumerate() {
            out.write_all(if at == 0 { b"{\n" } else { b",\n" })?;
            write!(out, "  {}: ", Value::from(key.as_str()))?;
            match self.matrices.get(key.as_str()) {
                Some(rows) => rows.write_into(value, out)?,
                None => write!(out, "{value}")?,
            }
        }
        writeln!(out, "\n}}")
    }
}
