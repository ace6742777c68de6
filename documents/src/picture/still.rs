//! Still pictures of an animation.

use super::{Picture, Point, Shape};

impl Picture {
    /// The duration of the animation in seconds; `None` if nothing moves.
    pub fn seconds(&self) -> Option<f64> {
        let seconds = |shape: &Shape| match shape {
            Shape::Film { seconds, .. } => Some(*seconds),
            _ => None,
        };
        self.shapes.iter().find_map(seconds)
    }

    /// The picture at the fraction `share` of the duration, from 0 to 1.
    pub fn still(&self, share: f64) -> Self {
        let shapes = self.shapes.iter().map(|shape| match shape {
            Shape::Film { frames, shown, fill, stroke, seconds } => Shape::Film {
                frames: vec![moment(frames, share)],
                shown: vec![shown.get(last(shown.len(), share).0).is_none_or(|shown| *shown)],
                fill: *fill,
                stroke: *stroke,
                seconds: *seconds,
            },
            still => still.clone(),
        });
        Picture { shapes: shapes.collect(), ..self.clone() }
    }
}

/// The last frame at or before a fraction of the duration, and the fraction of the interval to the
/// next frame.
fn last(frames: usize, share: f64) -> (usize, f64) {
    let at = share.clamp(0.0, 1.0) * frames.saturating_sub(1) as f64;
    (at as usize, at.fract())
}

/// The vertices at a fraction of the duration, interpolated between two frames.
fn moment(frames: &[Vec<Point>], share: f64) -> Vec<Point> {
    let (at, share) = last(frames.len(), share);
    let (Some(before), Some(after)) = (frames.get(at), frames.get(at + 1)) else {
        return frames.last().cloned().unwrap_or_default();
    };
    let between = |([x, y], [u, v]): (&Point, &Point)| [x + share * (u - x), y + share * (v - y)];
    before.iter().zip(after).map(between).collect()
}
