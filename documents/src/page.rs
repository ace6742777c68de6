//! HTML pages: self-contained single files without scripts.

use crate::formula::mathml::escaped;
use std::io::{self, Write};

/// The style sheet, for light and dark mode, narrow screens and print.
const STYLE: &str = include_str!("page.css");

/// Writes a page, with its title as plain text and the elements that `body` writes.
///
/// # Errors
/// Errors of `out` and of `body`.
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
