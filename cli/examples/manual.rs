//! Writes the manual pages of the program and its completions into a folder, for archives and packages.
//!
//! ```text
//! cargo run -p affinor-cli --example manual -- FOLDER
//! ```

use clap_complete::{Shell, generate_to};
use std::error::Error;
use std::fs;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("name a folder")?);
    let [pages, completions] = ["man1", "completions"].map(|name| folder.join(name));
    fs::create_dir_all(&pages)?;
    fs::create_dir_all(&completions)?;
    clap_mangen::generate_to(affinor_cli::command(), &pages)?;
    for page in fs::read_dir(&pages)? {
        let page = page?.path();
        // the text after the options of each command is its examples
        fs::write(&page, fs::read_to_string(&page)?.replace(".SH EXTRA", ".SH EXAMPLES"))?;
    }
    for shell in [Shell::Bash, Shell::Elvish, Shell::Fish, Shell::PowerShell, Shell::Zsh] {
        generate_to(shell, &mut affinor_cli::suggesting(), "affinor", &completions)?;
    }
    Ok(())
}
