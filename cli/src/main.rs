//! The command line of affinor.

mod commands;

fn main() -> std::process::ExitCode {
    commands::main()
}
