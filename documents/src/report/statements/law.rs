//! The properties of a geometry that a statement may name, as in `affinor properties`.

use crate::Coefficient;
use affinor::geometry::properties::Property;
use affinor::{Error, Geometry};

/// The names of the properties.
pub(super) const NAMES: [&str; 10] = [
    "torsion-free",
    "flat",
    "parallel torsion",
    "parallel curvature",
    "locally symmetric",
    "metric-compatible",
    "Einstein",
    "constant curvature",
    "bi-invariant metric",
    "naturally reductive",
];

/// The property with this name, ignoring case.
pub(super) fn named(text: &str) -> Option<&'static str> {
    NAMES.into_iter().find(|name| name.eq_ignore_ascii_case(text))
}

/// Whether a property holds. If it does not hold, the witness as text. `None` if the property is
/// not defined for the geometry.
pub(super) fn holds<S: Coefficient>(
    name: &str,
    geometry: &Geometry<S>,
) -> Result<Option<Result<(), String>>, Error> {
    fn verdict<S: Coefficient, T>(property: Property<S, T>) -> Option<Result<(), String>> {
        Some(match property {
            Property::Holds(_) => Ok(()),
            Property::Fails(witness) => Err(witness.to_string()),
        })
    }
    let connection = geometry.connection();
    // on a chart, the structure functions may be constant although no metric is invariant
    let algebra = geometry.algebra().filter(|_| geometry.frame_origin().fields().is_none());
    Ok(match (name, geometry.metric(), algebra) {
        ("torsion-free", ..) => verdict(connection.torsion_free()),
        ("flat", ..) => verdict(connection.flat()),
        ("parallel torsion", ..) => verdict(connection.parallel_torsion()),
        ("parallel curvature", ..) => verdict(connection.parallel_curvature()),
        ("locally symmetric", ..) => verdict(connection.locally_symmetric()),
        ("metric-compatible", Some(metric), _) => verdict(connection.metric_compatible(metric)?),
        ("Einstein", Some(metric), _) => verdict(connection.einstein_constant(metric)?),
        ("constant curvature", Some(metric), _) => verdict(connection.constant_curvature(metric)?),
        ("bi-invariant metric", Some(metric), Some(algebra)) => {
            verdict(metric.bi_invariant(algebra)?)
        }
        ("naturally reductive", Some(metric), Some(algebra)) => {
            verdict(metric.naturally_reductive(algebra)?)
        }
        ("naturally reductive", Some(metric), None) => {
            match geometry.frame_origin().homogeneous() {
                Some(space) => verdict(space.pair().naturally_reductive(metric)?),
                None => None,
            }
        }
        _ => None,
    })
}
