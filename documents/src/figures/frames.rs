//! Frames along a motion: figure 6 of the paper.

use super::images::with_motion;
use super::{Connected, Figure, Panel, Path, Role, ball};
use affinor::Error;
use affinor::group::{LieGroup, So3};
use nalgebra::{DMatrix, Vector3};

/// The number of frames; the first frame is at the identity.
const FRAMES: u32 = 3;
/// The length of the vectors.
const LENGTH: f64 = 0.75;
const TOLERANCE: f64 = 1e-10;

/// Draws the motion, and the frame `e_i` along it up to the time `t`. One panel shows left
/// translation (22), (76); one panel for each connection shows parallel transport (42).
///
/// # Errors
/// [`Error::Integration`].
pub fn frames(connections: &[Connected], path: &Path, t: f64) -> Result<Figure, Error> {
    let times: Vec<f64> = (0..FRAMES).map(|i| t * f64::from(i) / f64::from(FRAMES - 1)).collect();
    let title = if connections.is_empty() { "" } else { "left translation" };
    let mut panels =
        vec![panel(title, path, t, &times, &vec![DMatrix::identity(3, 3); times.len()])?];
    for connected in connections {
        let carried = connected.translation.along_curve(|t| path.velocity(t), &times, TOLERANCE)?;
        panels.push(panel(&connected.name, path, t, &times, &carried)?);
    }
    Ok(Figure { title: "Frames along a motion".into(), panels })
}

fn panel(
    title: &str,
    path: &Path,
    t: f64,
    times: &[f64],
    carried: &[DMatrix<f64>],
) -> Result<Panel, Error> {
    let mut panel = Panel::ball(title);
    with_motion(&mut panel, path, t)?;
    let last = times.len() - 1;
    for (at, (&time, matrix)) in times.iter().zip(carried).enumerate() {
        let x = So3.log(&path.element(time))?;
        for i in 0..3 {
            let u = Vector3::from_column_slice(matrix.column(i).as_slice());
            let symbol = ["e₁", "e₂", "e₃"][i];
            let label = match at {
                0 => symbol.into(),
                at if at == last => format!("{symbol}(p)"),
                _ => String::new(),
            };
            let caption = format!("{symbol} along γ");
            panel.arrow(Role::Frame(i), [&label, &caption], ball::arrow(&x, &u, LENGTH)?);
        }
    }
    Ok(panel)
}
