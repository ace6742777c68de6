//! The option `--color`.

use clap::{ArgMatches, Args, ValueEnum};

/// The option that decides whether messages are coloured.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Args)]
pub struct ColorOption {
    /// When to colour messages
    #[arg(long = "color", id = "color", value_name = "WHEN", value_enum, default_value_t = Color::Auto)]
    _color: Color,
}

/// The colour option of a command. If the command has no such option, messages are coloured on a
/// terminal.
pub fn chosen(matches: &ArgMatches) -> Color {
    match matches.subcommand() {
        Some((_, inner)) => chosen(inner),
        None => {
            let color = matches.try_get_one("color").ok().flatten();
            color.copied().unwrap_or(Color::Auto)
        }
    }
}
