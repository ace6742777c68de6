//! The charts of the catalogue by their properties.

use super::Report;
use super::grid::Grid;
use super::head::printable;
use crate::input::InputError;
use crate::space::NamedChart;
use affinor::geometry::Geometry;
use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
use affinor_tensors::{Symbolic, Tolerance};
use serde_json::json;

/// The properties of charts that a condition may name, and how they are decided.
pub(super) const PROPERTIES: [(&str, Decide); 6] = [
    ("Lorentzian", |geometry, [plus, minus]| Ok(plus == 1 || minus == 1).map(|one| one && geometry.frame().dimension() > 1 && plus * minus > 0)),
    ("Riemannian", |_, [_, minus]| Ok(minus == 0)),
    ("flat", |geometry, _| Ok(geometry.connection().flat().holds().is_some())),
    ("Ricci-flat", |geometry, _| Ok(geometry.connection().ricci().is_empty())),
    ("Einstein", |geometry, _| match geometry.metric() {
        Some(metric) => Ok(geometry.connection().einstein_constant(metric)?.holds().is_some()),
        None => Ok(false),
    }),
    ("homogeneous", |_, _| Ok(false)),
];
