//! The command line of affinor.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
