//! Axes of diagrams: ranges, ticks at round values, and their labels.

use std::ops::Range;

/// The smallest margin of a range, relative to the values in it.
const NARROW: f64 = 64.0 * f64::EPSILON;
/// The largest number of intervals between ticks; the first number whose ticks fit is used.
const INTERVALS: [f64; 4] = [11.0, 8.0, 5.0, 3.0];

/// An axis of a graph: a range of values, or of their decimal logarithms.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) range: Range<f64>,
    pub(super) logarithmic: bool,
}

impl Axis {
    /// The axis whose range contains all finite values, with a margin.
    pub(super) fn of(logarithmic: bool, values: impl Iterator<Item = f64>) -> Self {
        let values = values.map(|value| if logarithmic { value.log10() } else { value });
        let finite = values.filter(|value| value.is_finite());
        let around = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), around);
        if low > high {
            return Axis { range: 0.0..1.0, logarithmic };
        }
        let margin = if high > low { 0.04 * (high - low) } else { 0.5 };
        // widens a narrow range, in which different ticks would be equal floats
        let margin = margin.max(NARROW * low.abs().max(high.abs()));
        Axis { range: low - margin..high + margin, logarithmic }
    }

    pub(super) fn length(&self) -> f64 {
        self.range.end - self.range.start
    }

    /// The axis with a range of this length around the same middle.
    pub(super) fn widened(self, length: f64) -> Self {
        let middle = 0.5 * (self.range.start + self.range.end);
        Axis { range: middle - 0.5 * length..middle + 0.5 * length, ..self }
    }

    /// The position of a value as a fraction of the range.
    pub(super) fn share(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        (value - self.range.start) / self.length()
    }

    /// The ticks that `fit` accepts: for each tick, its position as a fraction of the range, and
    /// its label.
    pub(super) fn ticks(&self, fit: impl Fn(&[(f64, String)]) -> bool) -> Vec<(f64, String)> {
        let share = |value: f64| (value - self.range.start) / self.length();
        let mut ticks = vec![];
        for intervals in INTERVALS {
            let values = if self.logarithmic { self.powers() } else { self.multiples(intervals) };
            ticks = values.into_iter().map(|value| (share(value), self.label(value))).collect();
            if fit(&ticks) {
                break;
            }
        }
        ticks
    }

    /// The multiples, in the range, of a power of ten times 1, 2 or 5.
    fn multiples(&self, intervals: f64) -> Vec<f64> {
        let least = self.length() / intervals;
        let power = 10_f64.powf(least.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|multiple| multiple * power);
        let step = steps.into_iter().find(|step| *step >= least).unwrap_or(least);
        let (first, last) = ((self.range.start / step).ceil(), (self.range.end / step).floor());
        let count = (last - first).clamp(-1.0, intervals) as i32;
        (0..=count).map(|k| (first + f64::from(k)) * step).collect()
    }

    /// The exponents of about eight powers of ten in the range. If the range contains few powers,
    /// twice and five times these powers are added.
    fn powers(&self) -> Vec<f64> {
        let (low, high) = (self.range.start.ceil() as i64, self.range.end.floor() as i64);
        if high - low < 2 {
            let multiples = [1.0, 2.0, 5.0].map(f64::log10);
            let all = (low - 1..=high).flat_map(|k| multiples.map(|m| m + k as f64));
            return all.filter(|value| self.range.contains(value)).collect();
        }
        let every = ((high - low) / 8).max(0) + 1;
        (low..=high).filter(|k| k.rem_euclid(every) == 0).map(|k| k as f64).collect()
    }

    /// The label of a value, rounded to a millionth of the range. Labels of very small and very
    /// large ranges have exponents.
    fn label(&self, value: f64) -> String {
        if self.logarithmic {
            let power = (value + 1e-9).floor();
            return format!("{:.0}e{power:.0}", 10_f64.powf(value - power));
        }
        let exponent = |x: f64| x.abs().log10().floor();
        let digits = exponent(value) - exponent(self.length()) + 6.0;
        if value == 0.0 || digits < 0.0 {
            return "0".into();
        }
        let written = format!("{value:.*e}", (digits as usize).min(16));
        let rounded: f64 = written.parse().unwrap_or(value);
        let largest = self.range.start.abs().max(self.range.end.abs());
        if (1e-4..1e6).contains(&largest) { rounded.to_string() } else { format!("{rounded:e}") }
    }
}
