//! The tolerance for the error of a step.

use crate::mechanics::systems::cotangent::Sizes;

/// If the length of a path exceeds this value, the tolerance of coordinates is relative to the
/// path, and not absolute.
const LONG: f64 = 10.0;

/// The tolerance for the error of a step. Rotations and translations have separate scales.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Allowed {
    /// The relative tolerance.
    relative: f64,
    /// The absolute tolerances of rotations and translations.
    coordinates: [f64; 2],
    /// The absolute tolerances of the momenta of rotations and translations. `None` means that the
    /// error is relative to the largest component.
    momenta: Option<[f64; 2]>,
}

impl Allowed {
    /// Computes the tolerance. The parameters are the relative tolerance, optional absolute
    /// tolerances of coordinates, the time over which an error of a velocity accumulates, and the
    /// scales of the system.
    pub(super) fn new(
        relative: f64,
        absolute: Option<[f64; 2]>,
        span: f64,
        sizes: Option<Sizes>,
    ) -> Self {
        let length = sizes.map_or(1.0, |sizes| sizes.length);
        let coordinates = absolute.unwrap_or([relative, relative * length]);
        // the momentum that would move the body by the tolerance within this time span
        let momenta = sizes.map(|sizes| [0, 1].map(|i| sizes.inertia[i] * (coordinates[i] / span)));
        Allowed { relative, coordinates, momenta }
    }

    /// The error of coordinates, in units of the tolerance. The parameter `lengths` contains the
    /// lengths of the paths in the step.
    pub(super) fn of_coordinates(&self, errors: [f64; 2], lengths: [f64; 2]) -> f64 {
        let of = |part: usize| {
            ratio(errors[part], self.coordinates[part].max(self.relative * lengths[part] / LONG))
        };
        of(0).max(of(1))
    }

    /// The error of a momentum, in units of the tolerance. The parameter `sizes` contains the sizes
    /// of the momenta.
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

/// The ratio of an error to its tolerance. If the error is 0, the ratio is 0, even if the tolerance
/// is 0. A NaN yields NaN.
fn ratio(error: f64, allowed: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / allowed.max(f64::MIN_POSITIVE) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_allowed(error: f64) {
        assert!((error - 1.0).abs() < 1e-12, "{error}");
    }

    /// Each part of the table of [`Adaptive`](crate::mechanics::Adaptive) has its tolerance: an
    /// error that is as large as the table states has the ratio 1.
    #[test]
    fn each_part_has_its_tolerance() {
        let r = 1e-6;
        let sizes = Sizes { inertia: [8.0, 2.0], length: 3.0 };
        let by_default = Allowed::new(r, None, 4.0, Some(sizes));
        assert_allowed(by_default.of_coordinates([r, 0.0], [9.9, 0.0]));
        assert_allowed(by_default.of_coordinates([5.0 * r, 0.0], [50.0, 0.0]));
        assert_allowed(by_default.of_coordinates([0.0, 3.0 * r], [0.0, 29.0]));
        assert_allowed(by_default.of_coordinates([0.0, 7.0 * r], [0.0, 70.0]));
        assert_allowed(by_default.of_coordinates([0.5 * r, 3.0 * r], [0.0, 0.0]));
        // the tolerances are J r/span and m (length r)/span
        assert_allowed(by_default.of_momentum([2.0 * r, 0.0], [1.0, 0.0]));
        assert_allowed(by_default.of_momentum([0.0, 1.5 * r], [0.0, 1.0]));
        assert_allowed(by_default.of_momentum([6.0 * r, 0.0], [6.0, 0.0]));
        let given = Allowed::new(r, Some([1e-3, 1e-2]), f64::INFINITY, Some(sizes));
        assert_allowed(given.of_coordinates([1e-3, 0.0], [1.0, 0.0]));
        assert_allowed(given.of_coordinates([0.0, 1e-2], [0.0, 1.0]));
        assert_allowed(given.of_momentum([0.0, 3.0 * r], [0.0, 3.0]));
        let unscaled = Allowed::new(r, None, 4.0, None);
        assert_allowed(unscaled.of_momentum([2.0 * r, r], [0.5, 2.0]));
    }
}
