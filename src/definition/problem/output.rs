//! When rows are written, and what stands in them.

use super::Value;
use super::reader::Reader;
use crate::definition::input::{InputError, Source};
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

/// When rows are written, by formulas in the parameters.
#[derive(Clone, Debug)]
pub(super) struct Times {
    start: Option<Value>,
    rows: Rows,
}

#[derive(Clone, Debug)]
enum Rows {
    /// At these times.
    Listed(Vec<Value>),
    /// Until the end, and on the way there so far apart.
    Spaced(Box<(Value, Option<Value>)>),
}

impl OutputKeys<'_> {
    /// The times of the rows, from a start; 0 if there is none.
    pub fn times(&self, start: Option<Value>, reader: &Reader) -> Result<Times, InputError> {
        let rows = match (&self.times, &self.end, &self.every) {
            (Some(times), None, None) => Rows::Listed(reader.values(times)?),
            (None, Some(end), every) => {
                Rows::Spaced(Box::new((reader.value(end)?, reader.optional(every)?)))
            }
            _ => {
                let message = "the output has an end, perhaps with every, or else times";
                return Err(InputError::usage(message).at(&reader.source.key("output")));
            }
        };
        Ok(Times { start, rows })
    }
}

impl Times {
    /// The times at these values of the parameters, the start first.
    pub fn at(&self, source: &Source, parameters: &[f64]) -> Result<Vec<f64>, InputError> {
        let number = |key: &str, value: &Value| {
            value.at(parameters).map_err(|error| error.or_near(&source.key(key)))
        };
        let start = self.start.as_ref().map_or(Ok(0.0), |start| number("time", start))?;
        match &self.rows {
            Rows::Listed(times) => {
                let mut all = vec![start];
                for time in times {
                    let time = number("times", time)?;
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
            Rows::Spaced(spaced) => {
                let (end, every) = &**spaced;
                let end = number("end", end)?;
                let every = every.as_ref().map(|every| number("every", every)).transpose()?;
                equally(start, end, every.unwrap_or((end - start).abs()))
                    .map_err(|error| error.at(&source.key("every")))
            }
        }
    }

    /// The start and the end alone.
    pub fn to_the_end(&self) -> Self {
        let rows = match &self.rows {
            Rows::Listed(times) => Rows::Listed(times.last().into_iter().cloned().collect()),
            Rows::Spaced(spaced) => Rows::Spaced(Box::new((spaced.0.clone(), None))),
        };
        Times { start: self.start.clone(), rows }
    }
}

/// Times from a start to an end, so far apart.
fn equally(start: f64, end: f64, every: f64) -> Result<Vec<f64>, InputError> {
    if every.is_nan() || every <= 0.0 && end != start {
        return Err(InputError::usage(format!("rows every {every} never come to the end")));
    }
    if end == start {
        return Ok(vec![start]);
    }
    let count = (end - start).abs() / every;
    if count > MAX_ROWS {
        let message = format!("{count:.0} rows are too many, the limit is {MAX_ROWS}");
        return Err(InputError::usage(message));
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
