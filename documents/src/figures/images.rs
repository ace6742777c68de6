//! The velocity of a motion, and its two images at the identity: figure 2 of the paper.

use super::{Figure, Panel, Path, Role, ball};
use affinor::Error;
use affinor::group::{LieGroup, So3, Velocity};
use nalgebra::Vector3;

/// The number of intervals on the curve of a motion.
pub(super) const SAMPLES: u32 = 600;
/// The length of the longest velocity in a figure.
const LONGEST: f64 = 1.5;

/// Draws the motion, its angular velocity `w` at the point `p` of time `t`, and the images of `w`
/// at the identity. The images are `Omega` by left translation (55), and `omega = A Omega` by right
/// translation (57), (59). The autoparallel from `e` to `p` has the tangents `n` and `n_p`.
///
/// # Errors
/// No errors occur for rotations.
pub fn images(path: &Path, t: f64) -> Result<Figure, Error> {
    let mut panel = Panel::ball("");
    let Moment { x, velocity, scale } = with_motion(&mut panel, path, t)?;
    let identity = Vector3::zeros();
    if let Some(n) = x.try_normalize(0.0) {
        for (label, at) in [("n", &identity), ("nₚ", &x)] {
            let words = [label, "tangents of η at e and p"];
            panel.arrow(Role::Direction, words, ball::arrow(at, &n, 0.8)?);
        }
    }
    let left = ["Ω", "Ω, left translate: w = Lₚ∗ Ω"];
    panel.arrow(Role::Left, left, ball::arrow(&identity, &velocity.body, scale)?);
    let right = ["ω", "ω, right translate: w = Rₚ∗ ω"];
    panel.arrow(Role::Right, right, ball::arrow(&identity, &velocity.spatial, scale)?);
    let title = "The angular velocity w and its images Ω and ω".into();
    Ok(Figure { title, panels: vec![panel] })
}

/// The state of a motion at one time.
pub(super) struct Moment {
    /// The position as a rotation vector.
    pub x: Vector3<f64>,
    /// The angular velocity as its images `Omega` and `omega`.
    pub velocity: Velocity<Vector3<f64>>,
    /// The factor by which drawn velocities are longer than velocities.
    pub scale: f64,
}

/// Adds a motion to a panel: its curve, its position and velocity at the time `t`, and the
/// autoparallel to this position.
pub(super) fn with_motion(panel: &mut Panel, path: &Path, t: f64) -> Result<Moment, Error> {
    let p = path.element(t);
    let (x, velocity) = (So3.log(&p)?, Velocity::from_body(&So3, &p, path.velocity(t)));
    let elements = (0..=SAMPLES).map(|k| path.element(f64::from(k) / f64::from(SAMPLES)));
    let curve = ball::curve(&elements.collect::<Vec<_>>())?;
    let onto_plane = |x: &Vector3<f64>| Vector3::new(x.x, x.y, 0.0);
    let shadow = curve.iter().map(|piece| piece.iter().map(onto_plane).collect()).collect();
    panel.curve(Role::Motion, ["γ", "γ(t), motion"], curve);
    panel.curve(Role::Shadow, ["", "projection to the plane Ψ³ = 0"], shadow);
    let ray = vec![vec![Vector3::zeros(), x]];
    panel.curve(Role::Autoparallel, ["η", "η, autoparallel from e to p"], ray);
    panel.curve(Role::Guide, ["", ""], vec![vec![x, onto_plane(&x)]]);
    panel.mark("p", &format!("p = γ({t})"), x);
    let drawn = So3.tangent_left_inverse(&x, &velocity.body)?.norm();
    let scale = if drawn > 0.0 { LONGEST / drawn } else { 1.0 };
    let w = ball::arrow(&x, &velocity.body, scale)?;
    panel.arrow(Role::Velocity, ["w", "w, tangent of γ at p"], w);
    Ok(Moment { x, velocity, scale })
}
