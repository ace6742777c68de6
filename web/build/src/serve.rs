//! Serves the built page on this machine, as a host should: compressed, and cached for ever where the name changes with the
//! contents.

use anyhow::{Context, Result};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path};
use std::thread;

/// The types of the files of the page.
const TYPES: [(&str, &str); 5] = [
    ("html", "text/html; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("wasm", "application/wasm"),
    ("woff2", "font/woff2"),
];
/// The longest head of a request, in bytes.
const HEAD: u64 = 1 << 16;

/// Serves the files of a folder until it is stopped: one request a connection, one thread a connection.
pub(crate) fn serve(folder: &Path, address: &str) -> Result<()> {
    let listener = TcpListener::bind(address).with_context(|| address.to_string())?;
    println!("open http://{address}/");
    for stream in listener.incoming().filter_map(std::io::Result::ok) {
        let folder = folder.to_path_buf();
        // a reader who left is no failure
        thread::spawn(move || respond(&folder, stream));
    }
    Ok(())
}

/// Answers the request of a connection, and closes it.
fn respond(folder: &Path, mut stream: TcpStream) -> std::io::Result<()> {
    let mut lines = BufReader::new(stream.try_clone()?.take(HEAD)).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    let mut accepted = String::new();
    for line in lines {
        let line = line?;
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("accept-encoding")
        {
            accepted = value.to_string();
        }
    }
    let mut words = first.split_ascii_whitespace();
    let (method, url) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let found = matches!(method, "GET" | "HEAD").then(|| answer(folder, url, &accepted)).flatten();
    let (status, (bytes, headers)) = match found {
        Some(answer) => ("200 OK", answer),
        None => ("404 Not Found", (b"not here".to_vec(), vec![("Content-Type", "text/plain")])),
    };
    write!(
        stream,
        "HTTP/1.1 {status}\r\nConnection: close\r\nContent-Length: {}\r\n",
        bytes.len()
    )?;
    for (name, value) in headers {
        write!(stream, "{name}: {value}\r\n")?;
    }
    stream.write_all(b"\r\n")?;
    if method == "GET" { stream.write_all(&bytes) } else { Ok(()) }
}

type Answer = (Vec<u8>, Vec<(&'static str, &'static str)>);

/// The contents of the file at an address, compressed as is accepted, and the headers.
fn answer(folder: &Path, url: &str, accepted: &str) -> Option<Answer> {
    let name = url.trim_start_matches('/').split(['?', '#']).next().unwrap_or_default();
    let name = if name.is_empty() { "index.html" } else { name };
    let path = Path::new(name);
    if !path.components().all(|part| matches!(part, Component::Normal(_))) {
        return None;
    }
    let ending = path.extension()?.to_str()?;
    let kind = TYPES.iter().find(|(known, _)| *known == ending)?.1;
    // a folder that is named by its contents never changes
    let cache = if name.contains('/') { "public, max-age=31536000, immutable" } else { "no-cache" };
    let mut headers =
        vec![("Content-Type", kind), ("Cache-Control", cache), ("Vary", "Accept-Encoding")];
    for (coding, ending) in [("br", "br"), ("gzip", "gz")] {
        let named =
            accepted.split(',').any(|word| word.split(';').next().map(str::trim) == Some(coding));
        if named && let Ok(bytes) = fs::read(folder.join(format!("{name}.{ending}"))) {
            headers.push(("Content-Encoding", coding));
            return Some((bytes, headers));
        }
    }
    Some((fs::read(folder.join(name)).ok()?, headers))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::answer;
    use std::fs;

    #[test]
    fn files_are_sent_compressed_and_cached_by_name() {
        let folder = std::env::temp_dir().join(format!("affinor-serve-{}", std::process::id()));
        fs::create_dir_all(folder.join("page-1")).unwrap();
        for (name, text) in [
            ("index.html", "plain"),
            ("index.html.gz", "zipped"),
            ("page-1/a.js", "plain"),
            ("page-1/a.js.br", "brotli"),
        ] {
            fs::write(folder.join(name), text).unwrap();
        }
        let text = |url: &str, accepted: &str| {
            answer(&folder, url, accepted)
                .map(|(bytes, headers)| (String::from_utf8(bytes).unwrap(), headers))
        };
        let (bytes, headers) = text("/", "gzip, deflate, br").unwrap();
        assert_eq!(bytes, "zipped");
        assert!(
            headers.contains(&("Content-Encoding", "gzip"))
                && headers.contains(&("Cache-Control", "no-cache"))
        );
        let (bytes, headers) = text("/page-1/a.js?x", "gzip;q=0.5, br;q=1").unwrap();
        assert_eq!(bytes, "brotli");
        assert!(headers.contains(&("Cache-Control", "public, max-age=31536000, immutable")));
        assert_eq!(text("/page-1/a.js", "").unwrap().0, "plain");
        for outside in
            ["/../index.html", "/page-1/../../x.js", "/missing.js", "/page-1", "/index.html.gz"]
        {
            assert!(text(outside, "").is_none(), "{outside}");
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
