//! The option `--color`.

use clap::{ArgMatches, Args, ValueEnum};

/// When messages are coloured.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Args)]
pub struct ColorOption {
    /// Colour messages
    #[arg(long = "color", id = "color", value_name = "WHEN", value_enum, default_value_t = Color::Auto)]
    _color: Color,
}

/// The colours chosen for a command; a command without the option leaves them to the terminal.
pub fn chosen(matches: &ArgMatches) -> Color {
    match matches.subcommand() {
        Some((_, inner)) => chosen(inner),
        None => {
            let color = matches.try_get_one("color").ok().flatten();
            color.copied().unwrap_or(Color::Auto)
        }
    }
}
