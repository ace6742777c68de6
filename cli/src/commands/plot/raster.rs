//! PNG pictures and GIF animations, converted from SVG with the fonts of the system.

use affinor_documents::picture::{Picture, svg};
use gif::{Encoder, Frame, Repeat};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Family, Query};
use resvg::usvg::{Options, Tree};
use std::error::Error;

/// Fonts that contain the symbols of the figures, the preferred one first.
const SANS: [&str; 5] = ["DejaVu Sans", "Noto Sans", "Liberation Sans", "Arial", "Helvetica"];
const SERIF: [&str; 5] =
    ["DejaVu Serif", "Noto Serif", "Liberation Serif", "Times New Roman", "Times"];

/// The duration of one frame of a GIF, in hundredths of a second.
const FRAME: u16 = 5;
/// The largest number of frames of a GIF.
const FRAMES: u32 = 600;
/// How coarsely colours are sampled for a frame, from 1 (fine) to 30.
const COARSE: i32 = 10;

/// Draws pictures with the fonts of the system.
struct Renderer<'o>(Options<'o>);

impl Renderer<'_> {
    fn new() -> Result<Self, Box<dyn Error>> {
        let mut options = Options::default();
        let fonts = options.fontdb_mut();
        fonts.load_system_fonts();
        if fonts.is_empty() {
            return Err("PNG and GIF pictures need fonts, but this system has none".into());
        }
        if let Some(name) = installed(fonts, &SANS) {
            fonts.set_sans_serif_family(name);
        }
        if let Some(name) = installed(fonts, &SERIF) {
            fonts.set_serif_family(name);
        }
        Ok(Renderer(options))
    }

    /// Renders a picture as pixels, `width` pixels wide.
    fn pixels(&self, picture: &Picture, width: u32) -> Result<Pixmap, Box<dyn Error>> {
        let tree = Tree::from_str(&svg(picture, width), &self.0)?;
        let size = tree.size().to_int_size();
        let mut pixels =
            Pixmap::new(size.width(), size.height()).ok_or("the picture has too many pixels")?;
        resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
        Ok(pixels)
    }
}

/// Writes the picture as PNG, `width` pixels wide. An animation is drawn as its first frame.
///
/// # Errors
/// An error if the system has no fonts, or if the picture has too many pixels.
pub fn png(picture: &Picture, width: u32) -> Result<Vec<u8>, Box<dyn Error>> {
    Ok(Renderer::new()?.pixels(picture, width)?.encode_png()?)
}

/// Writes the animation as GIF, `width` pixels wide, with 20 frames per second, repeated forever. A
/// picture without animation becomes one frame.
///
/// # Errors
/// Those of [`png`]; an error if the picture has more than 65535 pixels in one direction.
pub fn gif(picture: &Picture, width: u32) -> Result<Vec<u8>, Box<dyn Error>> {
    let renderer = Renderer::new()?;
    let seconds = picture.seconds().unwrap_or(0.0);
    let frames = ((100.0 * seconds / f64::from(FRAME)).round() as u32).clamp(1, FRAMES);
    let delay = if frames < FRAMES { FRAME } else { (100.0 * seconds / f64::from(frames)) as u16 };
    let mut file = vec![];
    let mut encoder: Option<Encoder<&mut Vec<u8>>> = None;
    let mut out = Some(&mut file);
    for frame in 0..frames {
        let still = picture.still(f64::from(frame) / f64::from(frames));
        let pixels = renderer.pixels(&still, width)?;
        let (across, down) = (u16::try_from(pixels.width())?, u16::try_from(pixels.height())?);
        if let Some(out) = out.take() {
            let mut started = Encoder::new(out, across, down, &[])?;
            started.set_repeat(Repeat::Infinite)?;
            encoder = Some(started);
        }
        let mut rgba = pixels.take();
        let mut frame = Frame::from_rgba_speed(across, down, &mut rgba, COARSE);
        frame.delay = delay;
        if let Some(encoder) = &mut encoder {
            encoder.write_frame(&frame)?;
        }
    }
    drop(encoder);
    Ok(file)
}

/// The first of the font names that is installed.
fn installed(fonts: &Database, names: &[&'static str]) -> Option<&'static str> {
    let has = |name: &&str| {
        fonts.query(&Query { families: &[Family::Name(name)], ..Query::default() }).is_some()
    };
    names.iter().copied().find(has)
}
