//! Builds the page into `web/dist`, and serves it on this machine: `cargo run -p affinor-web-build -- serve`.

mod engine;
mod page;
mod serve;

use anyhow::{Context, Result, bail};
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

const USAGE: &str = "usage: affinor-web-build [--page-only] [serve [ADDRESS]]";

fn main() -> Result<()> {
    let mut words = env::args().skip(1).peekable();
    // the engine of the last build serves while only the files of the page change
    let page_only = words.next_if(|word| word == "--page-only").is_some();
    let address = match words.next().as_deref() {
        None => None,
        Some("serve") => Some(words.next().unwrap_or("127.0.0.1:8000".into())),
        Some(other) => bail!("`{other}` is not understood; {USAGE}"),
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let dist = folder.join("dist");
    fs::create_dir_all(&dist)?;
    let engine = if page_only { page::last_engine(&dist)? } else { fresh_engine(&folder, &dist)? };
    paper(&folder, &dist, page_only)?;
    page::assemble(&folder, &dist, &engine)?;
    println!("the page is in {}", dist.display());
    match address {
        Some(address) => serve::serve(&dist, &address),
        None => Ok(()),
    }
}

/// Compiles the engine and stores it in a folder named by its contents. Returns the name of the folder.
fn fresh_engine(folder: &Path, dist: &Path) -> Result<String> {
    println!(
        "compiling the engine for the browser: a few minutes at the first time, seconds later"
    );
    let work = dist.join("engine-new");
    if work.exists() {
        fs::remove_dir_all(&work)?;
    }
    engine::build(folder, &work)?;
    page::store_engine(dist, &work)
}

/// Writes the paper, equation by equation, as one HTML file beside the page; the program of `AFFINOR_COMMAND` prints it, or
/// one that is built.
fn paper(folder: &Path, dist: &Path, page_only: bool) -> Result<()> {
    let file = dist.join("paper.html");
    let mut command = match env::var_os("AFFINOR_COMMAND") {
        Some(program) => Command::new(program),
        None if page_only && file.exists() => return Ok(()),
        None => {
            let mut cargo = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
            cargo.args(["run", "--quiet", "-p", "affinor-cli", "--"]);
            cargo
        }
    };
    let command = command.args(["paper", "--format", "html"]).current_dir(folder.join(".."));
    let output = command.output().context("the program that prints the paper")?;
    if !output.status.success() {
        bail!("the paper was not printed: {}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(fs::write(file, output.stdout)?)
}
