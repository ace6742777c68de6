//! A motion as a curve in the group, and as a rotating body: figure 5 of the paper.

use super::images::{SAMPLES, with_motion};
use super::{Figure, Panel, Path, Role};
use affinor::Error;
use affinor::group::rotation;
use nalgebra::{Matrix3, Vector3};

/// The left panel shows the motion in canonical coordinates with its tangent `X` at `q`. The right
/// panel shows their images under `Phi` (77): the columns of the matrix `Q = exp(Psi)` on the unit
/// sphere, and the columns of `Y = Q spin(Omega)` (66).
///
/// # Errors
/// No errors occur for rotations.
pub fn motion(path: &Path, t: f64) -> Result<Figure, Error> {
    let mut points = Panel::ball("γ in canonical coordinates");
    with_motion(&mut points, path, t)?;
    let title = "A motion γ(t) and the rotating body".into();
    Ok(Figure { title, panels: vec![points, body(path, t)?] })
}

fn body(path: &Path, t: f64) -> Result<Panel, Error> {
    let matrix = |t: f64| -> Matrix3<f64> { rotation::matrix(&path.element(t)) };
    let (q, omega) = (matrix(t), path.velocity(t));
    let velocity = q * omega.cross_matrix();
    let longest = velocity.column_iter().map(|column| column.norm()).fold(0.0, f64::max);
    let scale = if longest > 0.0 { 0.5 / longest } else { 1.0 };
    let mut panel = Panel::new("body axes: columns of R = Φ(γ)", 1.0, ["E₁", "E₂", "E₃"]);
    panel.mark("O", "", Vector3::zeros());
    for i in 0..3 {
        let points = (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES));
        let points = points.map(|t| matrix(t).column(i).into_owned()).collect();
        let tip = q.column(i).into_owned();
        let symbol = ["R E₁", "R E₂", "R E₃"][i];
        panel.curve(Role::Frame(i), ["", &format!("{symbol} and its path")], vec![points]);
        panel.arrow(Role::Frame(i), [symbol, ""], [Vector3::zeros(), tip]);
        let caption = "columns of dR/dt = R spin(Ω)";
        panel.arrow(Role::Velocity, ["", caption], [tip, tip + velocity.column(i) * scale]);
    }
    Ok(panel)
}
