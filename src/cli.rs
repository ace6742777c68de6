//! The commands: one file each, over the options they share.

mod check;
mod color;
mod compare;
mod completions;
mod conventions;
mod convert;
mod equations;
mod failure;
mod list;
mod note;
mod on_group;
mod options;
mod output;
#[cfg(feature = "plot")]
mod plot;
mod rows;
mod simulate;
mod stages;
mod table;
mod transport;
mod verify;

use clap::{Parser, Subcommand};
use on_group::Operation;
use std::ffi::OsString;
use std::process::ExitCode;

/// Differential geometry of Lie groups, from a bracket table.
///
/// A SPACE is a geometry of the paper (M3, SO3), a catalogue name (so3, "so(3,1)", E8,
/// "so3+R^3"), a definition file (x.toml, x.json, - for standard input), or nothing, with --basis
/// and --bracket given inline. It may carry its connection and metric:
/// "so3@levi-civita;metric=diag(1,2,3)".
///
/// Exit status: 0 done; 1 the mathematics refuses; 2 wrong usage or unreadable input; 130, 143 a
/// signal stopped it.
#[derive(Parser)]
#[command(name = "affinor", version, max_term_width = 80)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Two spaces side by side; without arguments the paper's M(3) and SO(3)
    Compare(compare::Arguments),
    /// The tensors of one space
    Table(table::Arguments),
    /// Antisymmetry, Jacobi, metric, Bianchi identities: a certificate or the witness
    Check(check::Arguments),
    /// Compare with a stored table (JSON or CSV): the first differing components
    Verify(verify::Arguments),
    /// Equations of motion: Euler-Poincare, autoparallels, parallel transport
    Equations(equations::Arguments),
    /// The group element exp(x) of coordinates x
    Exp(on_group::Arguments),
    /// Coordinates of a group element, given as a matrix row by row
    Log(on_group::Arguments),
    /// Coordinates of exp(x) exp(y): a row is x, then y
    Compose(on_group::Arguments),
    /// The matrix of Ad at exp(x)
    Adjoint(on_group::Arguments),
    /// Parallel translation along arcs of the group
    Transport(transport::Arguments),
    /// Rotation vectors, quaternions, matrices, Euler angles: one into another
    Convert(convert::Arguments),
    /// The motion of a problem of mechanics, or of an ensemble of them
    Simulate(simulate::Arguments),
    /// The figures of the paper, and motions, computed and drawn
    #[cfg(feature = "plot")]
    Plot(plot::Arguments),
    /// The catalogue
    List(list::Arguments),
    /// The conventions of signs and indices
    Conventions(conventions::Arguments),
    /// Completions for a shell, on standard output
    Completions(completions::Arguments),
}

/// Parses the arguments, runs the command, reports its failure.
pub fn main() -> ExitCode {
    let arguments = std::env::args_os().map(shielded);
    let cli = Cli::try_parse_from(arguments).unwrap_or_else(|error| refuse(&error));
    let (outcome, color) = match cli.command {
        Command::Compare(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Table(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Check(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Verify(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Equations(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Exp(arguments) => operate(&arguments, Operation::Exp),
        Command::Log(arguments) => operate(&arguments, Operation::Log),
        Command::Compose(arguments) => operate(&arguments, Operation::Compose),
        Command::Adjoint(arguments) => operate(&arguments, Operation::Adjoint),
        Command::Transport(arguments) => (arguments.run(), arguments.shared.output.color),
        Command::Convert(arguments) => (arguments.run(), arguments.output.color),
        Command::Simulate(arguments) => (arguments.run(), arguments.color),
        #[cfg(feature = "plot")]
        Command::Plot(arguments) => arguments.run(),
        Command::List(arguments) => (arguments.run(), arguments.output.color),
        Command::Conventions(arguments) => (arguments.run(), arguments.output.color),
        Command::Completions(arguments) => {
            (arguments.run(&mut <Cli as clap::CommandFactory>::command()), color::Color::Auto)
        }
    };
    match outcome {
        Ok(code) => code,
        Err(failure) => failure.report(color),
    }
}

fn operate(
    arguments: &on_group::Arguments,
    operation: Operation,
) -> (Result<ExitCode, failure::Failure>, color::Color) {
    (arguments.run(operation), arguments.shared.output.color)
}

/// A row of numbers that begins with a minus, behind a space, so that it is not taken for an option.
fn shielded(argument: OsString) -> OsString {
    let number = |text: &&str| {
        let constant = text.starts_with("pi") || text.starts_with("tau");
        let digit = text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        // a lone number is an argument already
        constant || (digit && text.contains([',', ' ', '/', '*']))
    };
    match argument.to_str().and_then(|text| text.strip_prefix('-')).filter(number) {
        Some(row) => format!(" -{row}").into(),
        None => argument,
    }
}

/// Ends the program as clap does, with control characters escaped where it repeats the arguments.
fn refuse(error: &clap::Error) -> ! {
    let mut escaped = false;
    let arguments = std::env::args_os().map(|argument| match argument.to_str() {
        Some(text) if text.contains(char::is_control) => {
            escaped = true;
            text.escape_debug().to_string().into()
        }
        _ => shielded(argument),
    });
    let arguments: Vec<OsString> = arguments.collect();
    match Cli::try_parse_from(arguments) {
        Err(error) if escaped => error.exit(),
        _ => error.exit(),
    }
}
