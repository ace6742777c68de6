//! Strokes and colours of figures. They also differ in greyscale and by their dashes.

pub(super) use super::{BLACK, SOLID, WHITE};
use super::{Ink, Stroke};
use crate::figures::Role;

pub(super) const GREY: Ink = Ink::opaque(0x666666);
pub(super) const DASHED: &[f64] = &[7.0, 4.0];
pub(super) const DOTTED: &[f64] = &[2.0, 3.0];
const LONG: &[f64] = &[9.0, 2.0];
pub(super) const SHORT: &[f64] = &[4.0, 2.0];

/// The outline of the ball.
pub(super) const RIM: Stroke = Stroke { ink: Ink::opaque(0x8a8a8a), width: 1.2, dash: SOLID };
/// The strokes of circles of latitude and longitude, and of great circles, for the near side and
/// for the far side.
pub(super) const CIRCLES: [Stroke; 2] = [
    Stroke { ink: Ink::opaque(0xe3e3e3), width: 0.7, dash: SOLID },
    Stroke { ink: Ink::opaque(0xefefef), width: 0.7, dash: SOLID },
];
pub(super) const GREAT_CIRCLES: [Stroke; 2] = [
    Stroke { ink: Ink::opaque(0xb4b4b4), width: 1.0, dash: SOLID },
    Stroke { ink: Ink::opaque(0xcccccc), width: 0.9, dash: &[4.0, 4.0] },
];
pub(super) const AXIS: Stroke = Stroke { ink: Ink::opaque(0xa0a0a0), width: 0.9, dash: SOLID };

/// The stroke of a role, and its layer. A higher layer covers lower ones.
pub(super) fn stroke(role: Role) -> (Stroke, u8) {
    let (ink, width, dash, layer) = match role {
        Role::Shadow => (Ink::opaque(0xd0d0d0), 2.2, SOLID, 0),
        Role::Guide => (GREY, 1.0, DOTTED, 0),
        Role::Ray => (Ink::opaque(0x6f8fa8), 1.4, SOLID, 1),
        Role::Autoparallel => (Ink::opaque(0x3c3c3c), 1.7, DASHED, 2),
        Role::Motion => (BLACK, 2.4, SOLID, 3),
        Role::Trace => (Ink::opaque(0xd9a5c2), 1.5, SOLID, 4),
        Role::Frame(0) => (Ink::opaque(0xa3173f), 2.0, SOLID, 5),
        Role::Frame(1) => (Ink::opaque(0x0b7a5c), 2.0, LONG, 5),
        Role::Frame(_) => (Ink::opaque(0x1f4e9c), 2.0, SHORT, 5),
        Role::Direction => (Ink::opaque(0x8a6d00), 2.2, SOLID, 6),
        Role::Left => (Ink::opaque(0x0a5fa8), 2.8, SOLID, 7),
        Role::Right => (Ink::opaque(0x1aa67a), 2.8, SOLID, 8),
        Role::Carried => (Ink::opaque(0x7d1d5e), 2.0, DASHED, 9),
        Role::Velocity => (Ink::opaque(0xd05a00), 2.8, SOLID, 10),
    };
    (Stroke { ink, width, dash }, layer)
}

/// The stroke of a path on the far side of the sphere.
pub(super) fn far(stroke: Stroke) -> Stroke {
    Stroke { ink: tint(stroke.ink, 0.6), width: 0.7 * stroke.width, ..stroke }
}

/// Mixes a colour with a fraction of white.
pub(super) fn tint(ink: Ink, white: f64) -> Ink {
    let mixed = |part: u8| (f64::from(part) * (1.0 - white) + 255.0 * white).round() as u8;
    Ink { rgb: ink.rgb.map(mixed), ..ink }
}
