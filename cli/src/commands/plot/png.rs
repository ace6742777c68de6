//! Pictures as PNG, from SVG, with the fonts of the system.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Family, Query};
use resvg::usvg::{Options, Tree};
use std::error::Error;

/// Fonts that have the symbols of figures, in the order of preference.
const SANS: [&str; 5] = ["DejaVu Sans", "Noto Sans", "Liberation Sans", "Arial", "Helvetica"];
const SERIF: [&str; 5] =
    ["DejaVu Serif", "Noto Serif", "Liberation Serif", "Times New Roman", "Times"];

/// The picture as PNG, of the width in pixels that the SVG states. An animation is its first frame.
///
/// # Errors
/// A system without fonts; a picture of too many pixels.
pub fn png(svg: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    if fonts.is_empty() {
        return Err("a PNG needs fonts, and this system has none".into());
    }
    if let Some(name) = installed(fonts, &SANS) {
        fonts.set_sans_serif_family(name);
    }
    if let Some(name) = installed(fonts, &SERIF) {
        fonts.set_serif_family(name);
    }
    let tree = Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let mut pixels =
        Pixmap::new(size.width(), size.height()).ok_or("the picture has too many pixels")?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}

/// The first of the names that the system has.
fn installed(fonts: &Database, names: &[&'static str]) -> Option<&'static str> {
    let has = |name: &&str| {
        fonts.query(&Query { families: &[Family::Name(name)], ..Query::default() }).is_some()
    };
    names.iter().copied().find(has)
}
