//! Puts the files of the page together: folders that are named by their contents and never change, an index and a service
//! worker that name them, and compressed copies of all.

use anyhow::{Context, Result};
use flate2::{Compression, write::GzEncoder};
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Files that are not in a hashed folder, because their address must not change.
const FIXED: [&str; 2] = ["index.html", "sw.js"];

/// Name and contents of a file; names of folders are separated by `/`.
type File = (String, Vec<u8>);

/// Renames the folder of a new engine by its contents and compresses its files. Returns its name.
pub(crate) fn store_engine(dist: &Path, new: &Path) -> Result<String> {
    let name = format!("engine-{}", hash(&files(new, "")?));
    let folder = dist.join(&name);
    remove_others(dist, "engine-", &[&name, "engine-new"])?;
    if folder.exists() {
        fs::remove_dir_all(new)?;
    } else {
        fs::rename(new, &folder)?;
        for (file, bytes) in files(&folder, "")? {
            compress(&folder.join(file), &bytes)?;
        }
    }
    Ok(name)
}

/// The folder of the engine of the last build.
pub(crate) fn last_engine(dist: &Path) -> Result<String> {
    let mut names =
        fs::read_dir(dist)?.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names
        .find(|name| name.starts_with("engine-"))
        .context("there is no engine yet; build without --page-only")
}

/// Writes the page with the engine in the folder of this name.
pub(crate) fn assemble(folder: &Path, dist: &Path, engine: &str) -> Result<()> {
    let mut own = files(&folder.join("page"), "")?;
    // the style of reports
    own.push(("page.css".into(), fs::read(folder.join("../documents/src/page.css"))?));
    let (fixed, mut own): (Vec<File>, Vec<File>) =
        own.into_iter().partition(|(name, _)| FIXED.contains(&name.as_str()));
    for (name, bytes) in &mut own {
        if name.ends_with(".js") {
            *bytes = replaced(bytes, "/engine/", &format!("/{engine}/"))?;
            *bytes = without_comments(std::str::from_utf8(bytes)?).into_bytes();
        }
    }
    own.sort();
    let page = format!("page-{}", hash(&own));
    remove_others(dist, "page-", &[])?;
    for (name, bytes) in &own {
        let path = dist.join(&page).join(name);
        fs::create_dir_all(path.parent().unwrap_or(dist))?;
        fs::write(&path, bytes)?;
        compress(&path, bytes)?;
    }
    let engines = files(&dist.join(engine), "")?;
    let stored = own.iter().map(|(name, _)| format!("{page}/{name}"));
    let stored = stored.chain(engines.iter().map(|(name, _)| format!("{engine}/{name}")));
    let stored: Vec<_> =
        stored.filter(|name| !compressed(name)).map(|name| format!("\"{name}\"")).collect();
    for (name, bytes) in fixed {
        let bytes = replaced(&bytes, "\"page/", &format!("\"{page}/"))?;
        let bytes = replaced(&bytes, "/engine/", &format!("/{engine}/"))?;
        let bytes = replaced(&bytes, "/* files */", &stored.join(", "))?;
        fs::write(dist.join(&name), &bytes)?;
        compress(&dist.join(&name), &bytes)?;
    }
    let paper = dist.join("paper.html");
    let joined = joined(&fs::read_to_string(&paper)?, &page)?;
    fs::write(&paper, &joined)?;
    compress(&paper, joined.as_bytes())
}

/// The document of the paper with the icon, the fonts and the sizes of the page, and a link back to it. A document of an
/// earlier build has them already, for another folder; they are replaced.
fn joined(paper: &str, page: &str) -> Result<String> {
    const BEGIN: &str = "<!-- page -->";
    const END: &str = "<!-- /page -->";
    let (head, rest) = paper.split_once("</head>").context("the paper has no head")?;
    let (_, body) = rest.split_once("<body>").context("the paper has no body")?;
    let head = head.split_once(BEGIN).map_or(head, |(head, _)| head);
    let body = body.split_once(END).map_or(body, |(_, body)| body);
    let style = |name| format!("<link rel=\"stylesheet\" href=\"{page}/{name}.css\"/>");
    let (tokens, document) = (style("tokens"), style("paper/document"));
    Ok(format!(
        "{head}{BEGIN}<link rel=\"icon\" href=\"data:,\"/>{tokens}{document}\n</head>\n<body>\n\
         <p class=\"back\"><a href=\"./#paper\">affinor, the paper as cards</a></p>{END}{body}"
    ))
}

/// A script without the lines that contain only comments: they are a sixth of what is sent.
fn without_comments(script: &str) -> String {
    let mut inside = false;
    let is_code = |line: &&str| {
        let text = line.trim();
        let begins = text.starts_with("/**");
        if inside || begins && !text.contains("*/") {
            inside = !text.ends_with("*/");
            return false;
        }
        let whole = begins && text.find("*/") == text.len().checked_sub(2);
        !whole && !text.starts_with("//")
    };
    script.split_inclusive('\n').filter(is_code).collect()
}

fn replaced(bytes: &[u8], from: &str, to: &str) -> Result<Vec<u8>> {
    Ok(std::str::from_utf8(bytes)?.replace(from, to).into_bytes())
}

/// The files in a folder and its folders.
fn files(folder: &Path, prefix: &str) -> Result<Vec<File>> {
    let mut found = vec![];
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            found.extend(files(&entry.path(), &format!("{name}/"))?);
        } else {
            found.push((name, fs::read(entry.path())?));
        }
    }
    found.sort();
    Ok(found)
}

/// Removes folders of earlier builds.
fn remove_others(dist: &Path, prefix: &str, kept: &[&str]) -> Result<()> {
    for entry in fs::read_dir(dist)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_folder = entry.file_type()?.is_dir();
        if is_folder && name.starts_with(prefix) && !kept.contains(&name.as_str()) {
            fs::remove_dir_all(entry.path())?;
        }
    }
    Ok(())
}

/// Sixteen digits that change with the names and contents of files.
fn hash(files: &[File]) -> String {
    let mut hasher = DefaultHasher::new();
    for (name, bytes) in files {
        hasher.write(name.as_bytes());
        hasher.write(&bytes.len().to_le_bytes());
        hasher.write(bytes);
    }
    format!("{:016x}", hasher.finish())
}

fn compressed(name: &str) -> bool {
    name.ends_with(".br") || name.ends_with(".gz")
}

/// Writes compressed copies beside a file, unless it is small or compressed already.
fn compress(path: &Path, bytes: &[u8]) -> Result<()> {
    let name = path.to_string_lossy();
    if bytes.len() < 500 || name.ends_with(".woff2") || compressed(&name) {
        return Ok(());
    }
    let beside = |ending: &str| PathBuf::from(format!("{name}.{ending}"));
    let mut brotli = brotli::CompressorWriter::new(vec![], 1 << 16, 11, 24);
    brotli.write_all(bytes)?;
    fs::write(beside("br"), brotli.into_inner())?;
    let mut gzip = GzEncoder::new(vec![], Compression::best());
    gzip.write_all(bytes)?;
    Ok(fs::write(beside("gz"), gzip.finish()?)?)
}

#[cfg(test)]
mod tests {
    use super::{hash, joined};

    #[test]
    fn the_paper_is_joined_to_the_page_of_the_last_build_alone() -> anyhow::Result<()> {
        let printed = "<html>\n<head>\n<title>t</title>\n</head>\n<body>\n<main>m</main>\n</body>";
        let once = joined(printed, "page-1")?;
        assert!(once.contains("page-1/tokens.css") && once.contains("href=\"./#paper\""));
        assert_eq!(joined(&once, "page-2")?, joined(printed, "page-2")?);
        assert_eq!(joined(&once, "page-1")?, once);
        assert!(once.ends_with("\n<main>m</main>\n</body>"));
        Ok(())
    }

    #[test]
    fn the_name_of_a_folder_changes_with_every_name_and_byte() {
        let file = |name: &str, bytes: &str| (name.to_string(), bytes.as_bytes().to_vec());
        let sets = [
            vec![file("a.js", "1"), file("b.js", "2")],
            vec![file("a.js", "1"), file("c.js", "2")],
            vec![file("a.js", "1"), file("b.js", "3")],
            vec![file("a.js", "12"), file("b.js", "")],
            vec![file("a.js", "1")],
        ];
        let names: std::collections::BTreeSet<_> = sets.iter().map(|set| hash(set)).collect();
        assert_eq!(names.len(), sets.len());
        assert!(names.iter().all(|name| name.len() == 16));
    }
}
