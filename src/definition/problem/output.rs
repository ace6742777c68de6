//! When rows are written, and what stands in them.

use super::reader::Reader;
use crate::definition::InputError;
use crate::definition::written::{Number, Text};

/// The most rows of one motion.
const MAX_ROWS: f64 = 1e7;

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputKeys<'t> {
    #[serde(borrow)]
    end: Option<Number<'t>>,
    #[serde(borrow)]
    every: Option<Number<'t>>,
    #[serde(borrow)]
    times: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    pub columns: Option<Vec<Text<'t>>>,
    #[serde(borrow)]
    pub stop: Option<Text<'t>>,
    #[serde(borrow)]
    pub section: Option<Text<'t>>,
}

impl OutputKeys<'_> {
    /// The times of the rows.
    pub fn times(&self, start: f64, reader: &Reader) -> Result<Vec<f64>, InputError> {
        let source = reader.source;
        match (&self.times, &self.end, &self.every) {
            (Some(times), None, None) => {
                let mut all = vec![start];
                for time in times {
                    let time = reader.number(time);
                    let time = time.map_err(|error| error.or_near(&source.key("times")))?;
                    if time != all[all.len() - 1] {
                        all.push(time);
                    }
                }
                let forwards = all.windows(2).all(|pair| pair[0] < pair[1]);
                if forwards || all.windows(2).all(|pair| pair[0] > pair[1]) {
                    return Ok(all);
                }
                let message = "the times neither increase nor decrease from the start";
                Err(InputError::usage(message).at(&source.key("times")))
            }
            (None, Some(end), every) => {
                let end = reader.number(end).map_err(|error| error.or_near(&source.key("end")))?;
                let every = match every {
                    Some(every) => {
                        let every = reader.number(every);
                        every.map_err(|error| error.or_near(&source.key("every")))?
                    }
                    None => (end - start).abs(),
                };
                if every.is_nan() || every <= 0.0 && end != start {
                    let message = format!("rows every {every} never come to the end");
                    return Err(InputError::usage(message).at(&source.key("every")));
                }
                if end == start {
                    return Ok(vec![start]);
                }
                let count = (end - start).abs() / every;
                if count > MAX_ROWS {
                    let message = format!("{count:.0} rows are too many, the limit is {MAX_ROWS}");
                    return Err(InputError::usage(message).at(&source.key("every")));
                }
                // a whole number of rows is not spoilt by rounding
                let whole = (count + 1e-9).floor() as u64;
                let every = every.copysign(end - start);
                let mut times: Vec<f64> = (0..=whole).map(|k| start + every * k as f64).collect();
                if (count - whole as f64).abs() < 1e-9 {
                    times.pop();
                }
                times.push(end);
                Ok(times)
            }
            _ => {
                let message = "the output has an end, perhaps with every, or else times";
                Err(InputError::usage(message).at(&source.key("output")))
            }
        }
    }
}
