//! Certificates: checks of a definition, each with a witness if it fails.

use crate::Coefficient;
use crate::input::{InputError, Refusal};
use crate::space::Definition;
use affinor::algebra::frame::expect_numbers;
use affinor::geometry::conditions::conditions;
use affinor::{ConnectionKind, Error, FrameOrigin, Law, LieAlgebra};
use affinor_tensors::text::written;
use affinor_tensors::{Indices, Tensor, Tolerance};

/// One check of a certificate.
#[derive(Clone, Debug)]
pub struct Check {
    /// The subject of the check.
    pub name: &'static str,
    /// Whether the check succeeds.
    pub ok: bool,
    /// The statement that holds, or the failure and its residual.
    pub detail: String,
    /// The indices and the residual at which the check fails.
    pub witness: Option<CheckWitness>,
}

/// The largest dimension at which the Bianchi identities are computed for the default connection of
/// an algebra. In larger dimensions they follow from the Jacobi identity.
const IMPLIED: usize = 300;

/// The witness of an identity that fails: lower indices, and the residual at these indices.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckWitness {
    /// The lower indices, from 1.
    pub indices: Vec<usize>,
    /// The nonzero components of the residual at these indices.
    pub residual: Vec<(usize, String)>,
}

/// Checks a definition: antisymmetry, Jacobi, the metric, and the identities of the connection.
///
/// A failed check ends the certificate if later checks depend on it. `stage` is called with the
/// name of each computation before it starts. Floats need the scalar
/// [`TrackedFloat`](affinor_tensors::TrackedFloat), which bounds the rounding error; with `f64`,
/// the identities may fail because of rounding errors.
///
/// # Errors
/// An error if a value of the input does not exist in this scalar type, or if floats exceed their
/// range. Mathematical failures are reported as checks, not as errors.
pub fn certify<S: Coefficient>(
    definition: &Definition,
    tolerance: Tolerance,
    stage: &dyn Fn(&str),
) -> Result<Vec<Check>, InputError> {
    let mut checks = Vec::new();
    let Some(ground) = ground::<S>(definition, tolerance, stage, &mut checks)? else {
        return Ok(checks);
    };
    let metric = definition.metric(&ground, tolerance);
    let witness = metric.as_ref().err().and_then(|error| of_metric(error, &definition.labels));
    match passed("metric", metric, &mut checks)? {
        None => {
            checks.iter_mut().last().into_iter().for_each(|check| check.witness = witness.clone());
            return Ok(checks);
        }
        Some(None) => {}
        Some(Some(_)) => checks.push(held("metric", "symmetric and non-degenerate")),
    }
    let geometry = definition.geometry_over(ground, tolerance);
    let Some(geometry) = passed("connection", geometry, &mut checks)? else { return Ok(checks) };
    let connection = geometry.connection();
    if definition.connection_is_default()
        && !definition.has_metric()
        && definition.dimension() > IMPLIED
    {
        // both identities hold for any affinities over brackets that satisfy the Jacobi identity
        let detail = format!(
            "follows from the identity of Jacobi; computed up to dimension {IMPLIED}, or with --connection"
        );
        checks.extend(["bianchi_first", "bianchi_second"].map(|name| held(name, &detail)));
        return Ok(checks);
    }
    if let (ConnectionKind::LeviCivita, Some(metric)) = (geometry.kind(), geometry.metric()) {
        stage("levi-civita");
        checks.push(vanishing("torsion_free", "tau = 0", &connection.torsion())?);
        let nonmetricity = connection.nonmetricity(metric)?;
        checks.push(vanishing("metric_compatible", "nabla g = 0", &nonmetricity)?);
    }
    stage("bianchi_first");
    let (first, detail) = (connection.bianchi_first(), "R, torsion and nabla torsion fit together");
    checks.push(vanishing("bianchi_first", detail, &first)?);
    stage("bianchi_second");
    let (second, detail) = (connection.bianchi_second(), "nabla R, torsion and R fit together");
    checks.push(vanishing("bianchi_second", detail, &second)?);
    Ok(checks)
}

/// Checks the algebra or the vector fields of a definition, and returns them; `None` if a check
/// fails.
fn ground<S: Coefficient>(
    definition: &Definition,
    tolerance: Tolerance,
    stage: &dyn Fn(&str),
    checks: &mut Vec<Check>,
) -> Result<Option<FrameOrigin<S>>, InputError> {
    if definition.is_on_chart() {
        stage("frame");
        let ground = passed("frame", definition.ground(tolerance), checks)?;
        let Some(ground) = ground else { return Ok(None) };
        checks.push(held("frame", "the fields are independent: their determinant is not zero"));
        let residual = ground.frame().jacobi();
        checks.push(vanishing("jacobi", "[[x,y],z] + cyclic = 0 for all fields", &residual)?);
        return Ok(Some(ground));
    }
    if definition.is_homogeneous() {
        stage("jacobi");
        let Some(ground) = passed("jacobi", definition.ground(tolerance), checks)? else {
            return Ok(None);
        };
        checks.extend([
            held("jacobi", "[[x,y],z] + cyclic = 0 for all triples of the algebra of G"),
            held("subalgebra", "h contains [h,h]"),
            held("reductive", "the complement m contains [h,m]"),
        ]);
        return Ok(Some(ground));
    }
    stage("antisymmetry");
    let name = if definition.is_by_matrices() { "closure" } else { "antisymmetry" };
    let Some(bracket) = passed(name, definition.bracket(tolerance), checks)? else {
        if let Some(check) = checks.last_mut() {
            check.witness = definition.antisymmetry_witness().map(|((j, k), sum)| CheckWitness {
                indices: vec![j + 1, k + 1],
                residual: sum.iter().map(|(i, value)| (i + 1, value.to_string())).collect(),
            });
        }
        return Ok(None);
    };
    if definition.is_by_matrices() {
        checks.push(held("closure", "the commutators stay in the real span of the matrices"));
    }
    checks.push(held("antisymmetry", "[x,y] = -[y,x] for all basis vectors"));
    stage("jacobi");
    let statement = "[[x,y],z] + cyclic = 0 for all triples";
    if let Some(violation) = bracket.jacobi_violation() {
        let residual = bracket.jacobi();
        let mut jacobi = vanishing("jacobi", statement, &residual)?;
        (jacobi.ok, jacobi.detail) = (false, violation.to_string());
        if S::KIND == affinor_tensors::Kind::Symbolic {
            let conditions =
                conditions(&residual).iter().map(|e| format!("{e} = 0")).collect::<Vec<_>>();
            jacobi.detail += &format!("; Jacobi holds if {}", conditions.join(", "));
        }
        checks.push(jacobi);
        return Ok(None);
    }
    checks.push(held("jacobi", statement));
    // the Jacobi identity was checked above
    Ok(Some(LieAlgebra::try_from(bracket)?.into()))
}

fn held(name: &'static str, detail: &str) -> Check {
    Check { name, ok: true, detail: detail.into(), witness: None }
}

/// Returns the value of a step. A mathematical error is added to `checks` as a failed check, and
/// the result is `None`.
fn passed<T>(
    name: &'static str,
    step: Result<T, InputError>,
    checks: &mut Vec<Check>,
) -> Result<Option<T>, InputError> {
    match step {
        Ok(value) => Ok(Some(value)),
        Err(error) if error.refusal == Refusal::Mathematics && !is_out_of_range(&error) => {
            checks.push(Check { name, ok: false, detail: error.message, witness: None });
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Whether floats exceeded their range, so that a check is undecided.
fn is_out_of_range(error: &InputError) -> bool {
    matches!(error.cause.as_deref(), Some(Error::NotFinite { .. }))
}

/// The failed check of a metric: the witness is a pair of indices if the metric is not symmetric,
/// and a null vector if it is degenerate.
fn of_metric(error: &InputError, labels: &[String]) -> Option<CheckWitness> {
    let number = |name: &String| labels.iter().position(|label| label == name).map(|at| at + 1);
    match error.cause.as_deref()? {
        Error::Broken { law: Law::SymmetricMetric, at, residual } => Some(CheckWitness {
            indices: at.iter().map(number).collect::<Option<_>>()?,
            residual: vec![(0, residual.clone())],
        }),
        Error::Degenerate { components, .. } => {
            Some(CheckWitness { indices: vec![], residual: components.clone() })
        }
        _ => None,
    }
}

/// Checks that a residual, whose first index is upper, is zero.
fn vanishing<S: Coefficient>(
    name: &'static str,
    detail: &str,
    residual: &Tensor<S>,
) -> Result<Check, InputError> {
    expect_numbers(name, residual)?;
    let upper = usize::from(residual.slots().first() == Some(&affinor_tensors::Up));
    let lower = |at: &Indices| at[upper..].to_vec();
    let Some(place) = residual.components().map(|(at, _)| lower(&at)).min() else {
        return Ok(held(name, detail));
    };
    let here = residual.components().filter(|(at, _)| lower(at) == place);
    let residual: Vec<(usize, String)> =
        here.map(|(at, value)| (if upper == 1 { at[0] + 1 } else { 0 }, written(value))).collect();
    let indices: Vec<usize> = place.iter().map(|i| i + 1).collect();
    let detail = format!("not zero at {indices:?}: {residual:?}");
    Ok(Check { name, ok: false, detail, witness: Some(CheckWitness { indices, residual }) })
}
