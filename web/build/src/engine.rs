//! Compiles the engine to WebAssembly and writes its bindings.

use anyhow::{Context, Result, bail};
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";

/// The modules, by name, with a feature of the package: the page loads the tables of tensors first, and
/// the others on demand.
const MODULES: [(&str, &str); 3] =
    [("tables", "tables"), ("engine", "reports"), ("representations", "representations")];

/// Builds the modules of the package in `folder` and writes them and their bindings into the folder `out`.
pub(crate) fn build(folder: &Path, out: &Path) -> Result<()> {
    add_target()?;
    MODULES.iter().try_for_each(|(name, feature)| module(folder, out, name, feature))
}

fn module(folder: &Path, out: &Path, name: &str, feature: &str) -> Result<()> {
    let cargo = env::var("CARGO").unwrap_or("cargo".into());
    let profile = env::var("PROFILE").unwrap_or("page".into());
    let arguments = [
        "rustc",
        "-p",
        "affinor-web",
        "--target",
        TARGET,
        "--profile",
        &profile,
        "--crate-type",
        "cdylib",
    ];
    // one tab may not take the memory of the machine
    let link = ["--", "-Clink-arg=--max-memory=1073741824"];
    let done = Command::new(cargo)
        .args(arguments)
        .args(["--no-default-features", "--features", feature])
        .args(link)
        .current_dir(folder)
        .status()?;
    if !done.success() {
        bail!("the engine does not compile; `rustup target add {TARGET}` may be missing");
    }
    let target = env::var_os("CARGO_TARGET_DIR").map_or(folder.join("../target"), PathBuf::from);
    let built = if profile == "dev" { "debug" } else { &profile };
    let module = target.join(TARGET).join(built).join("affinor_web.wasm");
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(&module)
        .web(true)?
        .typescript(false)
        .omit_default_module_path(false)
        .remove_name_section(true)
        .out_name(name);
    bindgen.generate(out).with_context(|| module.display().to_string())
}

/// Installs the target of WebAssembly if rustup is there and lacks it.
fn add_target() -> Result<()> {
    let listed = Command::new("rustup").args(["target", "list", "--installed"]).output();
    // without rustup the compiler says what it lacks
    let Ok(listed) = listed else { return Ok(()) };
    if String::from_utf8_lossy(&listed.stdout).lines().any(|line| line == TARGET) {
        return Ok(());
    }
    println!("adding the target {TARGET}");
    Command::new("rustup").args(["target", "add", TARGET]).status()?;
    Ok(())
}
