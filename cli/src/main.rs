//! The program affinor.

/// The allocator mimalloc: it makes tables of millions of symbolic values a fifth faster than the
/// allocator of the C library.
#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    affinor_cli::run(std::env::args_os()).into()
}
