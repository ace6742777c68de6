//! What the error of a step may be.

use crate::dynamics::cotangent::Sizes;

/// The error of a step that is longer than this in its coordinates is relative to it.
const LONG: f64 = 10.0;

/// What the error of a step may be: of turns and of translations, each by its own scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Allowed {
    /// Relative to a momentum, or to a tenth of a long step.
    relative: f64,
    /// Of coordinates, whatever they are: turns and translations.
    coordinates: [f64; 2],
    /// Of momenta, whatever they are; none where all are judged by the largest.
    momenta: Option<[f64; 2]>,
}

impl Allowed {
    /// With a relative tolerance, absolute ones of coordinates where they are given, the time over which an error of a
    /// velocity counts, and the sizes of the system.
    pub(super) fn new(
        relative: f64,
        absolute: Option<[f64; 2]>,
        span: f64,
        sizes: Option<Sizes>,
    ) -> Self {
        let length = sizes.map_or(1.0, |sizes| sizes.length);
        let coordinates = absolute.unwrap_or([relative, relative * length]);
        // the momentum that goes so far in that time
        let momenta = sizes.map(|sizes| [0, 1].map(|i| sizes.inertia[i] * (coordinates[i] / span)));
        Allowed { relative, coordinates, momenta }
    }

    /// The error of coordinates in units of what is allowed, after a step of these lengths.
    pub(super) fn of_coordinates(&self, errors: [f64; 2], lengths: [f64; 2]) -> f64 {
        let of = |part: usize| {
            ratio(errors[part], self.coordinates[part].max(self.relative * lengths[part] / LONG))
        };
        of(0).max(of(1))
    }

    /// The error of a momentum in units of what is allowed, where it is of these sizes.
    pub(super) fn of_momentum(&self, errors: [f64; 2], sizes: [f64; 2]) -> f64 {
        match self.momenta {
            None => ratio(errors[0].max(errors[1]), self.relative * sizes[0].max(sizes[1])),
            Some(floors) => {
                let of = |part: usize| {
                    ratio(errors[part], floors[part].max(self.relative * sizes[part]))
                };
                of(0).max(of(1))
            }
        }
    }
}

/// No error is allowed however little is; NaN stays what it is.
fn ratio(error: f64, allowed: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / allowed.max(f64::MIN_POSITIVE) }
}
