//! Signals that end a run: the first asks it to stop and to save its rows, the second kills it.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// A program and its process group may each get a signal for one stop; signals within this time count as one.
const ONE: Duration = Duration::from_millis(300);
/// The time between two looks for a signal.
const OFTEN: Duration = Duration::from_millis(50);

/// The signals that the program has received.
pub struct Signals {
    arrived: Arc<AtomicUsize>,
    /// Whether the next signal kills.
    armed: Arc<AtomicBool>,
}

impl Signals {
    /// Installs the handlers.
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

    /// Lets the first signal kill from now on: the motion is complete.
    pub fn let_through(&self) {
        self.armed.store(true, Ordering::Relaxed);
    }

    /// The number of the last signal received, if any.
    pub fn arrived(&self) -> Option<u8> {
        u8::try_from(self.arrived.load(Ordering::Relaxed)).ok().filter(|signal| *signal > 0)
    }
}
