//! Monitoring of a command: signals, and limits on its time and memory.
//!
//! A thread polls for signals and exceeded limits. At the first one it sets the stop token of the
//! command, and the command unwinds at its next checkpoint. If the command does not end soon,
//! because it reads a file or computes without checkpoints, the thread ends the process. A
//! simulation polls by itself, so that it can write its rows before it ends.

use super::color::Color;
use super::failure::Failure;
use super::stages;
use affinor_documents::budget::{Budget, seconds, size};
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
    /// End the command with exit status 1 after this time, as in 30, 5m or 2h
    #[arg(long, value_name = "SECONDS", global = true, help_heading = "Limits", value_parser = seconds)]
    pub timeout: Option<f64>,
    /// End the command with exit status 1 if it uses more memory than this, as in 800M or 2G
    #[arg(long, value_name = "SIZE", global = true, help_heading = "Limits", value_parser = size)]
    pub memory: Option<u64>,
}

/// The time within which several signals count as one: a program and its process group may each
/// receive the same signal.
const ONE: Duration = Duration::from_millis(300);
/// The polling interval.
const OFTEN: Duration = Duration::from_millis(20);
/// The time that a command has to unwind before the process is ended.
const GRACE: Duration = Duration::from_millis(100);

/// The reason why a command ended early.
#[derive(Clone, Copy, Debug)]
pub enum Ending {
    /// A signal, by its number.
    Signal(u8),
    /// A limit was exceeded.
    Limit(StopReason),
}

/// The monitor of the command of this process.
#[derive(Clone)]
pub struct Watch(Arc<State>);

struct State {
    token: StopToken,
    budget: Budget,
    color: Color,
    /// The number of the last signal; 0 if there was none.
    arrived: Arc<AtomicUsize>,
    /// Whether the next signal kills the process at once.
    armed: Arc<AtomicBool>,
    /// The exceeded limit.
    passed: OnceLock<StopReason>,
    /// Whether the command polls for signals and limits by itself.
    asks: AtomicBool,
    /// The lock of the thread that ends the process and reports the reason.
    reports: Mutex<()>,
}

impl Watch {
    /// Starts the monitor.
    ///
    /// # Errors
    /// An error if a limit is invalid, or if the system does not deliver signals or cannot
    /// start a thread.
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

    /// Runs a command. Returns its result, or the failure with which the monitor ended it.
    pub fn run(&self, command: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
        self.0.token.run(command).unwrap_or_else(|stopped| Err(self.failure(stopped.stage)))
    }

    /// The lock under which the process ends. Only the thread that holds the lock may report.
    pub fn last_word(&self) -> MutexGuard<'_, ()> {
        self.0.reports.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Declares that the command now calls [`ending`](Self::ending) itself. The monitor then ends
    /// the command only at a second signal.
    pub fn ask(&self) {
        self.0.asks.store(true, Ordering::Relaxed);
    }

    /// Declares that the motion is complete: from now on, the first signal kills the process.
    pub fn let_through(&self) {
        self.0.armed.store(true, Ordering::Relaxed);
    }

    /// The last signal received, or the exceeded limit.
    pub fn ending(&self) -> Option<Ending> {
        let signal = u8::try_from(self.0.arrived.load(Ordering::Relaxed)).ok();
        let signal = signal.filter(|signal| *signal > 0).map(Ending::Signal);
        signal.or_else(|| self.0.passed.get().copied().map(Ending::Limit))
    }

    /// The failure for a command that was ended early. `stage` is used in the message if the
    /// command has no stages of its own.
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

    /// Polls until there is a signal or an exceeded limit, and then ends the command.
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
