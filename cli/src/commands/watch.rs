//! The watch over a command: signals, and limits on its time and memory.
//!
//! A thread looks for them. The first one sets the token of the command, which unwinds at its next checkpoint. A command that
//! does not end soon, because it reads a file or computes without checkpoints, is ended with the process. A simulation
//! asks for itself, and ends with its rows.

use super::color::Color;
use super::failure::Failure;
use super::stages;
use affinor_documents::budget::{Budget, size};
use affinor_documents::input::InputError;
use affinor_tensors::stop::{StopReason, StopToken};
use clap::Args;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

/// The limits on a command.
#[derive(Args)]
pub struct LimitOptions {
    /// End the command after this time, with exit status 1
    #[arg(long, value_name = "SECONDS", global = true, help_heading = "Limits")]
    pub timeout: Option<f64>,
    /// End the command when it uses more memory, as in 800M or 2G, with exit status 1
    #[arg(long, value_name = "SIZE", global = true, help_heading = "Limits", value_parser = size)]
    pub memory: Option<u64>,
}

/// A program and its process group may each get a signal for one stop; signals within this time count as one.
const ONE: Duration = Duration::from_millis(300);
/// The time between two looks.
const OFTEN: Duration = Duration::from_millis(20);
/// The time that a command has to unwind.
const GRACE: Duration = Duration::from_millis(100);

/// The reason why a command ends before its end.
#[derive(Clone, Copy, Debug)]
pub enum Ending {
    /// A signal, by its number.
    Signal(u8),
    /// A limit.
    Limit(StopReason),
}

/// The watch over the command of this process.
#[derive(Clone)]
pub struct Watch(Arc<State>);

struct State {
    token: StopToken,
    budget: Budget,
    color: Color,
    /// The last signal.
    arrived: Arc<AtomicUsize>,
    /// Whether the next signal kills.
    armed: Arc<AtomicBool>,
    /// The limit that was passed.
    passed: OnceLock<StopReason>,
    /// Whether the command asks for itself.
    asks: AtomicBool,
    /// Locked by the thread that reports the end.
    reports: Mutex<()>,
}

impl Watch {
    /// Begins the watch.
    ///
    /// # Errors
    /// Limits that are refused; a system that does not tell of signals or has no thread for the watch.
    pub fn begin(limits: &LimitOptions, color: Color) -> Result<Self, Failure> {
        let watch = Watch(Arc::new(State {
            token: StopToken::new(),
            budget: Budget::new(limits.timeout, limits.memory)?,
            color,
            arrived: Arc::default(),
            armed: Arc::default(),
            passed: OnceLock::new(),
            asks: AtomicBool::new(false),
            reports: Mutex::default(),
        }));
        let listen = || {
            for signal in [SIGINT, SIGTERM] {
                flag::register_conditional_shutdown(signal, 128 + signal, watch.0.armed.clone())?;
                flag::register_usize(signal, watch.0.arrived.clone(), signal as usize)?;
            }
            let watch = watch.clone();
            thread::Builder::new().spawn(move || watch.look())
        };
        match listen() {
            Ok(_) => Ok(watch),
            Err(error) => {
                Err(InputError::usage(format!("cannot listen to signals: {error}")).into())
            }
        }
    }

    /// The result of a command, or the failure by which the watch ended it.
    pub fn run(&self, command: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
        self.0.token.run(command).unwrap_or_else(|stopped| Err(self.failure(stopped.stage)))
    }

    /// The lock under which the process ends. Only its holder reports.
    pub fn last_word(&self) -> MutexGuard<'_, ()> {
        self.0.reports.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// From now on the command calls [`ending`](Self::ending), and nothing else ends it but a second signal.
    pub fn ask(&self) {
        self.0.asks.store(true, Ordering::Relaxed);
    }

    /// Lets the first signal kill from now on: the motion is complete.
    pub fn let_through(&self) {
        self.0.armed.store(true, Ordering::Relaxed);
    }

    /// The last signal received, or the limit that was passed.
    pub fn ending(&self) -> Option<Ending> {
        let signal = u8::try_from(self.0.arrived.load(Ordering::Relaxed)).ok();
        let signal = signal.filter(|signal| *signal > 0).map(Ending::Signal);
        signal.or_else(|| self.0.passed.get().copied().map(Ending::Limit))
    }

    /// The failure for an end in a stage. `stage` is used where the command names none.
    pub fn failure(&self, stage: &str) -> Failure {
        let current = stages::current();
        let stage = if current.is_empty() { stage } else { &current };
        let message = |reason| self.0.budget.message(reason, stage);
        match self.ending() {
            Some(Ending::Limit(reason)) => {
                let option = match reason {
                    StopReason::Memory => "--memory",
                    _ => "--timeout",
                };
                InputError::mathematics(message(reason))
                    .help(format!("raise {option} to allow more"))
                    .into()
            }
            Some(Ending::Signal(signal)) => {
                Failure::Signal(signal, Some(message(StopReason::Interrupted)))
            }
            None => Failure::Signal(SIGINT as u8, None),
        }
    }

    /// Looks for signals and limits until there is one.
    fn look(&self) {
        let ending = loop {
            if let Some(ending) = self.ending() {
                break ending;
            }
            match self.0.budget.exceeded() {
                None => thread::sleep(OFTEN),
                Some(reason) => drop(self.0.passed.set(reason)),
            }
        };
        if self.0.asks.load(Ordering::Relaxed) {
            thread::sleep(ONE);
            return self.let_through();
        }
        self.0.token.request(match ending {
            Ending::Signal(_) => StopReason::Interrupted,
            Ending::Limit(reason) => reason,
        });
        thread::sleep(GRACE);
        let _last = self.last_word();
        std::process::exit(self.failure("").report(self.0.color).into())
    }
}
