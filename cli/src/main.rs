//! The program affinor.

/// With this allocator, tables of millions of symbolic values take a fifth less time than with the
/// allocator of the C library.
#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    affinor_cli::run(std::env::args_os()).into()
}
