//! Metrics at sample points: values, power series, signatures and signs.

use super::jets::{self, AtPoint};
use super::point::{Expansion, Point, Unfit};
use super::power_series::PowerSeries;
use super::residue::Residue;
use super::{FIRST_ORDERS, Found, POINTS, SIGNS, conformal, unsupported};
use crate::Error;
use crate::algebra::frame::Frame;
use crate::algebra::structure::{GroundField, Killing};
use crate::algebra::{Bracket, LieAlgebra, to_matrix};
use crate::geometry::chart::Fields;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Rational, Symbolic, Tensor};
use std::cmp::Ordering;
use std::sync::Arc;

/// The components at a point.
pub(super) fn at_point(
    tensor: &Tensor<Symbolic>,
    point: &mut Point,
) -> Result<Tensor<Rational>, Unfit> {
    let entries = tensor.components().map(|(at, value)| Ok((at, point.value(value)?)));
    let entries = entries.collect::<Result<Vec<_>, Unfit>>()?;
    let values = Tensor::from_components(tensor.dimension(), tensor.slots(), entries);
    values.map_err(|error| Unfit::Never(error.to_string()))
}

/// The metric and `count` derivatives of the curvature at a point, in the coordinate frame.
pub(super) fn series_at(
    fields: &Fields<Symbolic>,
    components: &Tensor<Symbolic>,
    point: &mut Point,
    count: usize,
) -> Result<AtPoint<Residue>, Error> {
    let (connection, metric) = geometry_at(fields, components, point, count + 1)?;
    let mut known = vec![];
    jets::derivatives(&connection, &metric, &mut known, count)?;
    let derivatives = known.iter().map(|tensor| tensor.map(PowerSeries::value)).collect();
    let labels = fields.chart().labels();
    let metric = Metric::new(&labels, metric.components().map(PowerSeries::value))?;
    Ok(AtPoint { metric, derivatives })
}

/// The algebra of conformal Killing fields at a point.
pub(super) fn conformal_at(
    fields: &Fields<Symbolic>,
    components: &Tensor<Symbolic>,
    point: &mut Point,
    least: usize,
) -> Result<Found<Residue>, Error> {
    let at = |point: &mut Point, orders: usize| {
        // the equations contain three derivatives of the metric
        let (connection, metric) = geometry_at(fields, components, point, orders + 3)?;
        Found::conformal(&connection, &metric, PowerSeries::value, orders, least)
    };
    let found = at(point, FIRST_ORDERS)?;
    if found.jets.is_stable { Ok(found) } else { at(point, conformal::MAX_ORDER) }
}

/// The connection and the metric as power series around a point, in the coordinate frame.
pub(super) fn geometry_at(
    fields: &Fields<Symbolic>,
    components: &Tensor<Symbolic>,
    point: &mut Point,
    degree: usize,
) -> Result<(Connection<PowerSeries>, Metric<PowerSeries>), Error> {
    let labels = fields.chart().labels();
    let mut expansion = Expansion::new(point, fields.chart().coordinates(), degree);
    let series = components.components().map(|(at, value)| {
        let series = expansion.series(value, degree);
        Ok((at, series.map_err(|unfit| unsupported(&unfit.reason()))?))
    });
    let series = series.collect::<Result<Vec<_>, Error>>()?;
    let series = Tensor::from_components(labels.len(), components.slots(), series)?;
    let frame = Frame::holonomic(&labels, Arc::new(|k, f: &PowerSeries| f.derivative(k)))?;
    let metric = Metric::new(&labels, series)?;
    Ok((Connection::levi_civita(&frame, &metric)?, metric))
}

/// Rational structure constants with these residues; `None` if one is too long.
pub(super) fn lift(
    constants: &[(usize, usize, usize, Residue)],
) -> Option<Vec<(usize, usize, usize, Rational)>> {
    let lifted = constants.iter().map(|(j, k, i, value)| Some((*j, *k, *i, value.rational()?)));
    lifted.collect()
}

/// The algebra with these structure constants; the Jacobi identity is checked.
pub(super) fn algebra(
    dimension: usize,
    constants: Vec<(usize, usize, usize, Rational)>,
) -> Result<LieAlgebra<Rational>, Error> {
    let labels = (1..=dimension).map(|at| format!("k{at}"));
    Bracket::from_constants(labels, constants)?.try_into()
}

/// The numbers of positive and negative squares of a symmetric form.
pub(super) fn signature(form: &Tensor<Rational>) -> [usize; 2] {
    let [plus, minus, _] = Killing::new(to_matrix(form)).signature().unwrap_or_default();
    [plus, minus]
}

/// The values of functions at sample points where other functions are positive. The values end
/// where a root is irrational at every point.
fn samples<'a, T>(
    positive: &'a [Symbolic],
    value: impl Fn(&mut Point) -> Result<T, Unfit> + 'a,
) -> impl Iterator<Item = T> + 'a {
    let fits = |point: &mut Point| {
        let mut signs = positive.iter().map(|function| Ok(point.value(function)?.sign()));
        signs.try_fold(true, |all, sign| Ok(all && sign? == Some(Ordering::Greater)))
    };
    let at = move |seed: u64| {
        // a region may need negative coordinates
        let signed = !positive.is_empty() && seed.is_multiple_of(2);
        let mut point = if signed { Point::signed(seed) } else { Point::new(seed) };
        if fits(&mut point)? { value(&mut point).map(Some) } else { Ok(None) }
    };
    let values = (1..POINTS).map(at);
    values
        .map_while(|value| match value {
            Ok(value) => Some(value),
            Err(Unfit::Retry(_)) => Some(None),
            Err(Unfit::Never(_)) => None,
        })
        .flatten()
}

/// The signature of a metric at the first sample point where it is not degenerate, and where given
/// functions are positive. `None` if no such point is rational.
pub fn signature_at_sample(metric: &Tensor<Symbolic>, positive: &[Symbolic]) -> Option<[usize; 2]> {
    let mut signatures = samples(positive, |point| Ok(signature(&at_point(metric, point)?)));
    signatures.find(|signature| signature.iter().sum::<usize>() == metric.dimension())
}

/// Whether a function is positive at one of the sample points where given functions are positive.
pub(crate) fn is_positive_at_sample(function: &Symbolic, positive: &[Symbolic]) -> bool {
    let signs = samples(positive, |point| Ok(point.value(function)?.sign()));
    signs.take(SIGNS + 1).any(|sign| sign == Some(Ordering::Greater))
}
