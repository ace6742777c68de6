//! Pages of HTML: one file each, without scripts, with nothing fetched from elsewhere.

use crate::formula::mathml::escaped;
use std::io::{self, Write};

/// Light and dark, from narrow screens to paper.
const STYLE: &str = include_str!("page.css");

/// Writes a page: its title, as text, and the elements that `body` writes.
///
/// # Errors
/// An error of `out` or `body`.
///
/// ```
/// use affinor_documents::page::page;
/// let mut html = Vec::new();
/// page("a & b", &mut html, |out| writeln!(out, "<p>c</p>"))?;
/// assert!(String::from_utf8_lossy(&html).contains("<title>a &amp; b</title>"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn page(
    title: &str,
    out: &mut dyn Write,
    body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    writeln!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>",
        escaped(title)
    )?;
    body(out)?;
    writeln!(out, "</body>\n</html>")
}
