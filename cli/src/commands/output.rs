//! Output of results: to standard output, or to a file that is replaced only once the output is
//! complete.

use super::failure::Failure;
use affinor_documents::input::InputError;
use affinor_tensors::stop::checkpoint;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Runs `write` on standard output, or on `file` if there is one.
///
/// A regular file is written under a temporary name in the same folder and then renamed, so that a
/// failed run leaves the old file unchanged. A device or a pipe is written directly. `inputs` are
/// files that must not be overwritten.
pub fn deliver(
    file: Option<&Path>,
    inputs: &[PathBuf],
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let write = |out: &mut dyn Write| write(&mut Polled(out));
    let Some(path) = file else {
        let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
        let done = write(&mut out).and_then(|()| out.flush());
        return done.map_err(|error| Failure::Output(error, "standard output".into()));
    };
    let (shown, target) = expect_other(path, inputs)?;
    let special = fs::metadata(&target).is_ok_and(|meta| !meta.is_file() && !meta.is_dir());
    let done = if special {
        fs::File::create(&target).and_then(|file| {
            let mut out = BufWriter::new(file);
            write(&mut out).and_then(|()| out.flush())
        })
    } else {
        replace(&target, write)
    };
    done.map_err(|error| Failure::Output(error, shown))
}

/// The ending of the name of an output file, in lower case; empty if there is none.
pub fn ending(file: Option<&Path>) -> String {
    let ending = file.and_then(|file| file.extension()?.to_str());
    ending.unwrap_or_default().to_ascii_lowercase()
}

/// A writer that checks before each write whether a stop is requested.
struct Polled<'w>(&'w mut dyn Write);

impl Write for Polled<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        checkpoint();
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Returns an error, before any computation, if the file cannot be written: if it is one of
/// `inputs`, a folder, or a file in a folder without write permission.
pub fn expect_place(path: &Path, inputs: &[PathBuf]) -> Result<(), Failure> {
    let (shown, target) = expect_other(path, inputs)?;
    if fs::metadata(&target).is_ok_and(|meta| !meta.is_file() && !meta.is_dir()) {
        return Ok(());
    }
    // creates a temporary file as a test, and deletes it at once
    temporary(&target).map(drop).map_err(|error| Failure::Output(error, shown))
}

/// Checks that the path is not one of `inputs`. Returns the path for messages, and the resolved
/// path.
fn expect_other(path: &Path, inputs: &[PathBuf]) -> Result<(String, PathBuf), Failure> {
    let shown = path.display().to_string().escape_debug().to_string();
    if inputs.iter().any(|input| is_same(input, path)) {
        let message = format!("{shown} is the input; the output would overwrite it");
        return Err(InputError::usage(message).help("give -o another name").into());
    }
    Ok((shown, resolved(path)))
}

/// Whether two paths name the same file.
pub fn is_same(a: &Path, b: &Path) -> bool {
    resolved(a) == resolved(b)
}

/// The absolute path, with symbolic links followed.
fn resolved(path: &Path) -> PathBuf {
    let target = fs::canonicalize(path).or_else(|_| std::path::absolute(path));
    target.unwrap_or_else(|_| path.to_path_buf())
}

fn replace(target: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, temporary(target)?);
    write(&mut out)?;
    let temporary = out.into_inner().map_err(|error| error.into_error())?;
    temporary.persist(target).map_err(|error| error.error)?;
    Ok(())
}

/// A temporary file in the folder of the target.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let folder = match target.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    if target.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".affinor-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // the new file gets the permissions of the replaced file, or the default permissions of the
        // umask
        let mode = fs::metadata(target).map_or(0o666, |meta| meta.permissions().mode());
        builder.permissions(fs::Permissions::from_mode(mode));
    }
    // checks the folder here, because the error of the temporary file would show a temporary name
    if !fs::metadata(folder)?.is_dir() {
        return Err(io::ErrorKind::NotADirectory.into());
    }
    builder.tempfile_in(folder)
}
