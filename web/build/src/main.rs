//! Builds the page into `web/dist`, and serves it on this machine: `cargo run -p affinor-web-build -- serve`.

use anyhow::{Context, Result, bail};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tiny_http::{Header, Response, Server};
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
/// The types of the files of the page.
const TYPES: [(&str, &str); 4] = [
    ("html", "text/html; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("wasm", "application/wasm"),
];

fn main() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = build(&folder)?;
    println!("the page is in {}", page.display());
    match env::args().nth(1).as_deref() {
        None => Ok(()),
        Some("serve") => serve(&page, &env::args().nth(2).unwrap_or("127.0.0.1:8000".into())),
        Some(other) => bail!("`{other}` is not understood; write `serve`, or nothing"),
    }
}

/// Compiles the engine, writes its bindings, and puts the files of the page beside them.
fn build(folder: &Path) -> Result<PathBuf> {
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
        "--",
        // one tab may not take the memory of the machine
        "-Clink-arg=--max-memory=1073741824",
    ];
    let done = Command::new(cargo).args(arguments).current_dir(folder).status()?;
    if !done.success() {
        bail!("the engine does not compile; `rustup target add {TARGET}` may be missing");
    }
    let target = env::var_os("CARGO_TARGET_DIR").map_or(folder.join("../target"), PathBuf::from);
    let built = if profile == "dev" { "debug" } else { &profile };
    let module = target.join(TARGET).join(built).join("affinor_web.wasm");
    let dist = folder.join("dist");
    if dist.exists() {
        fs::remove_dir_all(&dist)?;
    }
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(&module)
        .web(true)?
        .typescript(false)
        .omit_default_module_path(false)
        .remove_name_section(true)
        .out_name("engine");
    bindgen.generate(&dist).with_context(|| module.display().to_string())?;
    // the style of reports
    fs::copy(folder.join("../documents/src/page.css"), dist.join("page.css"))?;
    for entry in fs::read_dir(folder.join("page"))? {
        let path = entry?.path();
        fs::copy(&path, dist.join(path.file_name().unwrap_or_default()))?;
    }
    Ok(dist)
}

/// Serves the files of a folder until it is stopped.
fn serve(folder: &Path, address: &str) -> Result<()> {
    let server = match Server::http(address) {
        Ok(server) => server,
        Err(error) => bail!("{address}: {error}"),
    };
    println!("open http://{address}/");
    for request in server.incoming_requests() {
        let name =
            request.url().trim_start_matches('/').split(['?', '#']).next().unwrap_or_default();
        let name = if name.is_empty() { "index.html" } else { name };
        let kind = Path::new(name).extension().and_then(|ending| ending.to_str());
        let kind = TYPES.iter().find(|(ending, _)| Some(*ending) == kind);
        // the files of the page stand side by side
        let file = kind
            .filter(|_| !name.contains('/'))
            .and_then(|kind| Some((fs::read(folder.join(name)).ok()?, kind.1)));
        // a reader who left is no failure
        let _ = match file {
            Some((bytes, kind)) => {
                let header = Header::from_bytes("Content-Type", kind);
                request.respond(
                    header.into_iter().fold(Response::from_data(bytes), Response::with_header),
                )
            }
            None => request.respond(Response::from_string("not here").with_status_code(404)),
        };
    }
    Ok(())
}
