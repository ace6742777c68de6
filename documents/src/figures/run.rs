//! Figures of trajectories: attitude and body momentum.

use super::{Figure, Panel, Role};
use crate::rows::RunRows;
use affinor::Error;
use affinor::mechanics::Inertia;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The number of intervals on an ellipse.
const SAMPLES: u32 = 96;

/// Draws the body axes on the unit sphere in space: the columns `R E_i` of the attitude. Each
/// factor of a product with one of these numbers has its own panel.
///
/// # Errors
/// [`Error::Name`] for a trajectory without an attitude; [`Error::Invalid`] for elements that are
/// not rotations.
pub fn attitude(run: &RunRows, factors: &[Option<usize>]) -> Result<Figure, Error> {
    let panel = |factor: &Option<usize>| {
        let attitudes = run.attitudes(*factor)?;
        let title = factor.map_or(String::new(), |number| format!("body {number}"));
        let mut panel = Panel::new(title, 1.0, ["X", "Y", "Z"]);
        for i in 0..3 {
            let points: Vec<_> = attitudes.iter().map(|r| r.column(i).into_owned()).collect();
            let tip = points.last().copied().unwrap_or_default();
            let axis = ["E₁", "E₂", "E₃"][i];
            let caption = format!("body axis {axis} (arrow at the final time)");
            panel.path(Role::Frame(i), &caption, points);
            panel.arrow(Role::Frame(i), [&format!("R {axis}"), ""], [Vector3::zeros(), tip]);
        }
        Ok(panel)
    };
    let panels = factors.iter().map(panel).collect::<Result<_, Error>>()?;
    Ok(Figure { title: format!("{}: body axes in space", run.name), panels })
}

/// Draws a curve on a chart in space, by the functions of its embedding. The axes have the length
/// of the largest distance from the origin.
///
/// # Errors
/// [`Error::Name`] for a trajectory without `X1`, `X2`, `X3`.
pub fn orbit(run: &RunRows) -> Result<Figure, Error> {
    let points = run.vectors(["X1", "X2", "X3"])?;
    let longest = points.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let radius = if longest > 0.0 { longest } else { 1.0 };
    let mut panel = Panel { sphere: false, ..Panel::new("", radius, ["X₁", "X₂", "X₃"]) };
    panel.path(Role::Motion, "curve", points);
    Ok(Figure { title: format!("{}: curve in space", run.name), panels: vec![panel] })
}

/// Draws the body momentum `H` on the sphere of its norm, and the energy ellipsoid. A free motion
/// follows the intersection of both surfaces, the polhode.
///
/// # Errors
/// [`Error::Name`] for a trajectory without `H1`, `H2`, `H3`.
pub fn momentum(run: &RunRows, inertia: &Inertia) -> Result<Figure, Error> {
    let points = run.vectors(["H1", "H2", "H3"])?;
    let start = points.first().copied().unwrap_or_default();
    let longest = points.iter().map(|h| h.norm()).fold(0.0, f64::max);
    let radius = if longest > 0.0 { longest } else { 1.0 };
    let (axes, moments) = (inertia.axes(), inertia.principal_moments());
    let mut panel = Panel::new("", radius, ["H₁", "H₂", "H₃"]);
    // the semi-axes of the ellipsoid H . J^-1 H = 2 E
    let energy = inertia.energy(&start);
    let half = moments.map(|moment| (2.0 * energy * moment).sqrt());
    let around = |k: u32| (TAU * f64::from(k) / f64::from(SAMPLES)).sin_cos();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let (a, b) = (axes.column(i) * half[i], axes.column(j) * half[j]);
        let ellipse = (0..=SAMPLES).map(around).map(|(sin, cos)| a * cos + b * sin).collect();
        let caption = "energy ellipsoid";
        panel.curve(Role::Guide, ["", caption], vec![ellipse]);
    }
    panel.path(Role::Motion, "body momentum H", points);
    Ok(Figure { title: format!("{}: body momentum", run.name), panels: vec![panel] })
}
