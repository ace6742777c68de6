//! Limits on the time and the memory of a computation.

use crate::input::InputError;
use affinor_tensors::stop::StopReason;
use std::fs;
use std::time::{Duration, Instant};

/// Limits on the time and on the memory of a computation. The time is measured from the creation of
/// the value.
///
/// The memory is the resident memory of the whole process, which only Linux reports.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    begin: Instant,
    timeout: Option<Duration>,
    memory: Option<u64>,
}

impl Budget {
    /// Sets limits on the time (in seconds) and on the memory (in bytes). The time starts now.
    ///
    /// # Errors
    /// An error for a number of seconds that is negative or not finite. An error for a limit on the
    /// memory if the system does not report the memory of a process.
    pub fn new(timeout: Option<f64>, memory: Option<u64>) -> Result<Self, InputError> {
        let timeout = timeout.map(|seconds| {
            Duration::try_from_secs_f64(seconds).map_err(|_| {
                InputError::usage(format!("the time limit {seconds} is not a number of seconds"))
                    .help("write a number such as 30 or 0.5")
            })
        });
        if memory.is_some() && resident_memory().is_none() {
            let message = "the memory limit cannot be used: this system does not report the memory of a process";
            return Err(InputError::usage(message).help("leave the memory limit out"));
        }
        Ok(Budget { begin: Instant::now(), timeout: timeout.transpose()?, memory })
    }

    /// The limit that is exceeded now; `None` if no limit is exceeded.
    pub fn exceeded(&self) -> Option<StopReason> {
        let late = self.timeout.is_some_and(|timeout| self.begin.elapsed() >= timeout);
        let large = |most| resident_memory().is_some_and(|size| size >= most);
        match late {
            true => Some(StopReason::Timeout),
            false => self.memory.is_some_and(large).then_some(StopReason::Memory),
        }
    }

    /// The remaining time; `None` without a limit on the time.
    pub fn rest(&self) -> Option<Duration> {
        Some(self.timeout?.saturating_sub(self.begin.elapsed()))
    }

    /// The message for a limit that was exceeded during a stage. An empty name of the stage is left
    /// out.
    pub fn message(&self, reason: StopReason, stage: &str) -> String {
        let limit = match reason {
            StopReason::Interrupted => "interrupted".to_string(),
            StopReason::Timeout => {
                let seconds = self.timeout.unwrap_or_default().as_secs_f64();
                format!("the computation exceeds its time limit of {seconds} s")
            }
            StopReason::Memory => {
                let size = written_size(self.memory.unwrap_or_default());
                format!("the process exceeds its memory limit of {size}")
            }
        };
        match stage {
            "" => limit,
            stage => format!("{limit}, in the stage `{stage}`"),
        }
    }
}

/// The resident memory of this process in bytes; `None` if the system does not report it.
fn resident_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

const UNITS: [(&str, u64); 3] = [("G", 1 << 30), ("M", 1 << 20), ("K", 1 << 10)];

/// Parses a size of memory in bytes, or in units of powers of 1024 bytes: `500M`, `1.5 GB`, `2GiB`.
///
/// ```
/// use affinor_documents::budget::size;
/// assert_eq!(size("1.5 GB"), Ok(3 << 29));
/// assert_eq!(size("4096"), Ok(4096));
/// assert!(size("-1M").is_err() && size("many").is_err());
/// ```
///
/// # Errors
/// A message that explains the form of a size.
pub fn size(text: &str) -> Result<u64, String> {
    let upper = text.trim().to_ascii_uppercase();
    let number = upper.strip_suffix("IB").or(upper.strip_suffix('B')).unwrap_or(&upper);
    let unit = UNITS.iter().find_map(|(unit, bytes)| Some((number.strip_suffix(unit)?, *bytes)));
    let (number, unit) = unit.unwrap_or((number, 1));
    let bytes = number.trim().parse::<f64>().ok().map(|number| number * unit as f64);
    let bytes = bytes.filter(|bytes| *bytes >= 1.0 && *bytes < u64::MAX as f64);
    bytes.map(|bytes| bytes as u64).ok_or_else(|| "write a size such as 800M or 2G".into())
}

/// Parses a time such as `30`, `0.5s`, `5m` or `2h`. Returns the seconds.
///
/// # Errors
/// A message that explains the form of a time.
pub fn seconds(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let unit = [("min", 60.0), ("m", 60.0), ("h", 3600.0), ("s", 1.0)];
    let unit = unit.iter().find_map(|(unit, seconds)| Some((text.strip_suffix(unit)?, *seconds)));
    let (number, unit) = unit.unwrap_or((text, 1.0));
    let number = number.trim().parse::<f64>().map(|number| number * unit);
    number.map_err(|_| "write a time such as 30, 0.5s, 5m or 2h".into())
}

/// Writes a size in the largest unit that does not exceed it, with at most one decimal.
fn written_size(bytes: u64) -> String {
    let unit = UNITS.iter().find(|(_, unit)| bytes >= *unit);
    let Some((name, unit)) = unit else { return format!("{bytes} bytes") };
    let tenths = (bytes as f64 / *unit as f64 * 10.0).round() / 10.0;
    format!("{tenths} {name}iB")
}
