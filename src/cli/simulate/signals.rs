//! Signals that end a run: the first asks it to stop, another one behind it kills it.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// One stop may come as several signals, to the program and to its group: these are within this time.
const ONE: Duration = Duration::from_millis(300);
const OFTEN: Duration = Duration::from_millis(50);

/// What was asked of the run from outside.
pub struct Signals {
    arrived: Arc<AtomicUsize>,
    /// Whether the next one kills.
    armed: Arc<AtomicBool>,
}

/// A signal that asked the run to stop.
#[derive(Clone, Copy)]
pub struct Signal(u8);

impl Signals {
    /// From now on signals are heard.
    pub fn hear() -> io::Result<Self> {
        let (arrived, armed) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        for signal in [SIGINT, SIGTERM] {
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&armed))?;
            flag::register_usize(signal, Arc::clone(&arrived), signal as usize)?;
        }
        let signals = Signals { arrived: Arc::clone(&arrived), armed: Arc::clone(&armed) };
        thread::Builder::new().spawn(move || {
            while arrived.load(Ordering::Relaxed) == 0 {
                thread::sleep(OFTEN);
            }
            thread::sleep(ONE);
            armed.store(true, Ordering::Relaxed);
        })?;
        Ok(signals)
    }

    /// There is nothing left to stop: from now on the first kills.
    pub fn let_through(&self) {
        self.armed.store(true, Ordering::Relaxed);
    }

    /// The signal, if one has come.
    pub fn arrived(&self) -> Option<Signal> {
        match self.arrived.load(Ordering::Relaxed) {
            0 => None,
            signal => Some(Signal(signal as u8)),
        }
    }
}

impl Signal {
    /// As a shell has it.
    pub fn status(self) -> ExitCode {
        ExitCode::from(128 + self.0)
    }
}
