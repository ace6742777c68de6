//! Pictures as PNG: the SVG, rendered with letters that the program carries.

use super::{Picture, svg};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// The widest picture, in pixels.
pub const MAX_WIDTH: u32 = 8000;

/// A picture that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no picture {width} pixels wide: {reason}")]
pub struct PictureError {
    /// What was asked for.
    pub width: u32,
    /// Why not.
    pub reason: String,
}

/// The picture as a PNG, `width` pixels wide.
///
/// # Errors
/// A width of 0, or beyond [`MAX_WIDTH`].
pub fn png(picture: &Picture, width: u32) -> Result<Vec<u8>, PictureError> {
    rendered(&svg(picture, width), width)
}

/// The text of an SVG that is `width` pixels wide as a PNG.
///
/// # Errors
/// As [`png`]; what is no SVG.
pub fn rendered(text: &str, width: u32) -> Result<Vec<u8>, PictureError> {
    let error = |reason: String| PictureError { width, reason };
    if !(1..=MAX_WIDTH).contains(&width) {
        return Err(error(format!("a width is between 1 and {MAX_WIDTH}")));
    }
    let mut options = Options { font_family: "DejaVu Sans".into(), ..Options::default() };
    let letters = options.fontdb_mut();
    letters.load_font_data(dejavu::sans::regular().to_vec());
    letters.load_font_data(dejavu::serif::italic().to_vec());
    let tree = Tree::from_str(text, &options).map_err(|e| error(e.to_string()))?;
    let size = tree.size().to_int_size();
    let pixels = Pixmap::new(size.width(), size.height());
    let mut pixels = pixels.ok_or_else(|| error("it does not fit into memory".into()))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| error(e.to_string()))
}
