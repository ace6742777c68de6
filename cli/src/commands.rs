//! The commands of the program, one file for each, and their shared options and outputs.

mod arguments;
mod check;
mod claims;
mod code;
mod color;
mod columns;
mod compare;
mod completions;
mod conventions;
mod convert;
mod coupling;
mod equations;
mod examples;
mod failure;
mod forms;
mod geodesic;
mod hypersurface;
mod info;
mod isometries;
mod linearize;
mod list;
mod mobility;
mod note;
mod on_group;
mod options;
mod output;
mod paper;
mod plot;
mod properties;
mod rep;
mod restore;
mod rows;
mod simulate;
mod solve;
mod spacetime;
mod stages;
mod table;
mod transport;
mod verify;
mod watch;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use failure::Failure;
use on_group::Operation;
use std::ffi::OsString;
use watch::{LimitOptions, Watch};

/// Differential geometry of Lie groups, from a table of brackets.
///
/// A SPACE is a name of the catalogue (so3, "so(3,1)", E8, "so3+R^3") or brackets "[x,y]=z,
/// [y,z]=x". It may be a file (x.toml, x.json, a table such as x.csv, or - for standard input). M3
/// and SO3 are the geometries of Paraskevopoulos and Natsiavas. Leave it out if --basis and --bracket define the space.
/// Its connection and metric may follow the name: "so3@levi-civita;metric=diag(1,2,3)".
///
/// Exit status: 0 success; 1 valid input without a mathematical answer, such as brackets that
/// violate the Jacobi identity, or an exceeded limit; 2 wrong usage or unreadable input; 130 or 143
/// a signal ended the command.
#[derive(Parser)]
#[command(name = "affinor", version, max_term_width = 80)]
struct Cli {
    #[command(flatten)]
    limits: LimitOptions,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Compare two spaces; by default M(3) and SO(3) of Paraskevopoulos and Natsiavas (2013)
    Compare(compare::Arguments),
    /// Print the tensors of a space
    Table(table::Arguments),
    /// Check antisymmetry, Jacobi, metric and Bianchi identities
    Check(check::Arguments),
    /// Compare the tensors of a space with stored tables (JSON or CSV)
    Verify(verify::Arguments),
    /// Test claims about a space, such as "torsion = 0" or "Ric_11 = (a - b)/2"
    Claims(claims::Arguments),
    /// Print the structure of a Lie algebra: series, radicals, types, ideals
    Info(info::Arguments),
    /// Print which properties a connection and a metric have, each with its constant or a
    /// counterexample
    Properties(properties::Arguments),
    /// Print the Lie algebra of the Killing fields of a metric: dimension, isotropy, name, brackets
    Isometries(isometries::Arguments),
    /// Print the Weyl tensor of a spacetime: Petrov type, null tetrad, Newman-Penrose scalars
    Spacetime(spacetime::Arguments),
    /// Print the derivative, Hodge star, codifferential and Laplacian of a differential form
    Forms(forms::Arguments),
    /// Print the extrinsic curvature of the hypersurfaces on which a function is constant
    Hypersurface(hypersurface::Arguments),
    /// Find all values of the letters of a space for which it has a property, such as Einstein
    Solve(solve::Arguments),
    /// Representations of a reductive algebra: products, powers, branching, matrices
    Rep(rep::Arguments),
    /// Couple spins: Clebsch-Gordan coefficients, 3j and 6j symbols, as exact square roots
    Coupling(coupling::Arguments),
    /// Print the equations of motion of a space
    Equations(equations::Arguments),
    /// Map coordinates x to the group element exp(x)
    Exp(on_group::Arguments),
    /// Map a group element, given as a matrix row by row, to its coordinates
    Log(on_group::LogArguments),
    /// Compute the coordinates of exp(x) exp(y); each input row is x followed by y
    Compose(on_group::Arguments),
    /// Print the matrix of Ad at the element exp(x)
    Adjoint(on_group::Arguments),
    /// Parallel-transport vectors along arcs of a group
    Transport(transport::Arguments),
    /// Compute geodesics between two points of a chart, a group or a homogeneous space
    Geodesic(geodesic::Arguments),
    /// Print the degrees of freedom of a mechanism of bodies and joints, with proofs
    Mobility(mobility::Arguments),
    /// Print the eigenvalues of small deviations from an equilibrium or a steady motion
    Linearize(linearize::Arguments),
    /// Convert rotations: vectors, quaternions, matrices, Euler angles
    Convert(convert::Arguments),
    /// Integrate a problem of mechanics, or an ensemble of problems
    Simulate(simulate::Arguments),
    /// Draw trajectories, and the figures of Paraskevopoulos and Natsiavas (2013)
    Plot(plot::Arguments),
    /// Recompute the paper of Paraskevopoulos and Natsiavas (2013), equation by equation
    Paper(paper::Arguments),
    /// List the catalogue of spaces
    List(list::Arguments),
    /// Print the conventions of signs and indices
    Conventions(conventions::Arguments),
    /// Print the completions for a shell
    Completions(completions::Arguments),
}

/// The commands with their options.
pub fn command() -> clap::Command {
    examples::with_examples(Cli::command())
}

/// The commands, whose arguments suggest names.
pub fn suggesting() -> clap::Command {
    completions::suggesting(command())
}

/// Parses the arguments, runs the command and reports its failure. Returns the exit status.
pub fn main(arguments: &[OsString]) -> u8 {
    let parsed = arguments::parse(command, arguments)
        .and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, matches)));
    let (cli, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return arguments::report(&error),
    };
    let color = color::chosen(&matches);
    let watch = Watch::begin(&cli.limits, color);
    let outcome = watch.and_then(|watch| {
        let outcome = watch.run(|| run(cli.command, &watch));
        // holds the lock until the process ends, so that the monitor reports nothing more
        std::mem::forget(watch.last_word());
        outcome
    });
    match outcome {
        Ok(()) => 0,
        Err(failure) => failure.report(color),
    }
}

/// Runs a command.
fn run(command: Command, watch: &Watch) -> Result<(), Failure> {
    match command {
        Command::Compare(arguments) => arguments.run(),
        Command::Table(arguments) => arguments.run(),
        Command::Check(arguments) => arguments.run(),
        Command::Verify(arguments) => arguments.run(),
        Command::Claims(arguments) => arguments.run(),
        Command::Info(arguments) => arguments.run(),
        Command::Properties(arguments) => arguments.run(),
        Command::Isometries(arguments) => arguments.run(),
        Command::Spacetime(arguments) => arguments.run(),
        Command::Forms(arguments) => arguments.run(),
        Command::Hypersurface(arguments) => arguments.run(),
        Command::Solve(arguments) => arguments.run(),
        Command::Rep(arguments) => arguments.run(),
        Command::Coupling(arguments) => arguments.run(),
        Command::Equations(arguments) => arguments.run(),
        Command::Exp(arguments) => arguments.run(Operation::Exp),
        Command::Log(arguments) => arguments.run(),
        Command::Compose(arguments) => arguments.run(Operation::Compose),
        Command::Adjoint(arguments) => arguments.run(Operation::Adjoint),
        Command::Transport(arguments) => arguments.run(),
        Command::Geodesic(arguments) => arguments.run(),
        Command::Mobility(arguments) => arguments.run(),
        Command::Linearize(arguments) => arguments.run(),
        Command::Convert(arguments) => arguments.run(),
        Command::Simulate(arguments) => arguments.run(watch),
        Command::Plot(arguments) => arguments.run(),
        Command::Paper(arguments) => arguments.run(),
        Command::List(arguments) => arguments.run(),
        Command::Conventions(arguments) => arguments.run(),
        Command::Completions(arguments) => arguments.run(&self::command()),
    }
}
