//! Autoparallels through the identity, in canonical coordinates: figure 4 of the paper.

use super::{Connected, Figure, Panel, Role, ball};
use affinor::Error;
use affinor::group::{LieGroup, So3};
use nalgebra::Vector3;

/// The number of intervals on an autoparallel.
const SAMPLES: u32 = 120;
const TOLERANCE: f64 = 1e-10;

/// For each connection, draws autoparallels (B7) from the identity, with unit tangents, up to `s =
/// pi`. The autoparallel along `axis` ends at `q`, where `s = |axis|`. An autoparallel is straight
/// in the ball, by (74), if its tangent is constant in the left-invariant frame, (43).
///
/// # Errors
/// Those of [`autoparallel`](affinor::group::transport::ParallelTranslation::autoparallel).
pub fn autoparallels(connections: &[Connected], axis: &Vector3<f64>) -> Result<Figure, Error> {
    let panels = connections.iter().map(|connected| panel(connected, axis));
    let title = "Autoparallels through the identity, canonical coordinates".into();
    Ok(Figure { title, panels: panels.collect::<Result<_, _>>()? })
}

fn panel(connected: &Connected, axis: &Vector3<f64>) -> Result<Panel, Error> {
    let mut panel = Panel::ball(&connected.name);
    let from_identity = |n: Vector3<f64>, end: f64| {
        let times: Vec<f64> =
            (0..=SAMPLES).map(|i| end * f64::from(i) / f64::from(SAMPLES)).collect();
        let on_curve =
            connected.translation.autoparallel(&So3.identity(), &n, &times, TOLERANCE)?;
        ball::curve(&on_curve.into_iter().map(|tangent| tangent.base).collect::<Vec<_>>())
    };
    for n in fan() {
        let caption = "autoparallels from e to s = π";
        panel.curve(Role::Ray, ["", caption], from_identity(n, ball::RADIUS)?);
    }
    let (Some(n), s) = (axis.try_normalize(0.0), axis.norm()) else { return Ok(panel) };
    let curve = from_identity(n, s)?;
    let q = curve.last().and_then(|piece| piece.last()).copied().unwrap_or_default();
    panel.curve(Role::Autoparallel, ["η(s)", "autoparallel along n"], curve);
    let tangent = ball::arrow(&Vector3::zeros(), &n, 1.0)?;
    panel.arrow(Role::Direction, ["n", "unit tangent at e"], tangent);
    let corners = [Vector3::zeros(), Vector3::new(q.x, 0.0, 0.0), Vector3::new(q.x, q.y, 0.0), q];
    for (edge, label) in corners.windows(2).zip(["q¹", "q²", "q³"]) {
        panel.curve(Role::Guide, [label, "coordinates of q"], vec![edge.to_vec()]);
    }
    panel.mark("q", &format!("q = η({s:.2})"), q);
    Ok(panel)
}

/// Unit vectors to the vertices of an icosahedron. None of them is along a coordinate axis.
fn fan() -> Vec<Vector3<f64>> {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let corners = signs.iter().flat_map(|[a, b]| {
        let (a, b) = (*a, b * golden);
        [Vector3::new(0.0, a, b), Vector3::new(a, b, 0.0), Vector3::new(b, 0.0, a)]
    });
    corners.map(|corner| corner.normalize()).collect()
}
