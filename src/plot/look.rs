//! How each role looks: colours that differ in grey too, and dashes besides.

use super::Stroke;
use crate::figures::Role;

pub(super) const BLACK: &str = "#111111";
pub(super) const GREY: &str = "#666666";
pub(super) const WHITE: &str = "#ffffff";

const SOLID: &[f64] = &[];
const DASHED: &[f64] = &[7.0, 4.0];
const DOTTED: &[f64] = &[2.0, 3.0];
const LONG: &[f64] = &[9.0, 2.0];
const SHORT: &[f64] = &[4.0, 2.0];

/// The silhouette of the ball.
pub(super) const RIM: Stroke = Stroke { ink: "#8a8a8a", width: 1.2, dash: SOLID };
/// Its wires before and behind, and the great circles among them.
pub(super) const WIRES: [Stroke; 2] = [
    Stroke { ink: "#e3e3e3", width: 0.7, dash: SOLID },
    Stroke { ink: "#efefef", width: 0.7, dash: SOLID },
];
pub(super) const GREAT_CIRCLES: [Stroke; 2] = [
    Stroke { ink: "#b4b4b4", width: 1.0, dash: SOLID },
    Stroke { ink: "#cccccc", width: 0.9, dash: &[4.0, 4.0] },
];
pub(super) const AXIS: Stroke = Stroke { ink: "#a0a0a0", width: 0.9, dash: SOLID };

/// The stroke of a role, and which lies on top.
pub(super) fn look(role: Role) -> (Stroke, u8) {
    let (ink, width, dash, layer) = match role {
        Role::Shadow => ("#d0d0d0", 2.2, SOLID, 0),
        Role::Guide => (GREY, 1.0, DOTTED, 0),
        Role::Ray => ("#6f8fa8", 1.4, SOLID, 1),
        Role::Autoparallel => ("#3c3c3c", 1.7, DASHED, 2),
        Role::Motion => (BLACK, 2.4, SOLID, 3),
        Role::Trace => ("#d9a5c2", 1.5, SOLID, 4),
        Role::Frame(0) => ("#a3173f", 2.0, SOLID, 5),
        Role::Frame(1) => ("#0b7a5c", 2.0, LONG, 5),
        Role::Frame(_) => ("#1f4e9c", 2.0, SHORT, 5),
        Role::Direction => (GREY, 2.2, SOLID, 6),
        Role::Left => ("#0a5fa8", 2.8, SOLID, 7),
        Role::Right => ("#1aa67a", 2.8, SOLID, 8),
        Role::Carried => ("#7d1d5e", 2.0, DASHED, 9),
        Role::Velocity => ("#d05a00", 2.8, SOLID, 10),
    };
    (Stroke { ink, width, dash }, layer)
}
