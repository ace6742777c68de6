//! `affinor paper`: the paper of Paraskevopoulos and Natsiavas (2013), recomputed equation by
//! equation.

use super::color::ColorOption;
use super::failure::Failure;
use super::output::{deliver, ending};
use super::plot::{FIGURE_AT, connected, precession};
use affinor_documents::figures::{self, Figure};
use affinor_documents::picture::{View, draw, svg};
use affinor_paper::{Paper, PaperFigure, PaperFormat};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// The format of the document [default: by the ending of the output file, otherwise html]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to this file instead of standard output
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    color: ColorOption,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// One file without scripts: formulas in MathML, figures in SVG
    Html,
    /// Markdown with tables, as rendered by GitHub
    Markdown,
    /// A document for pdfLaTeX
    Latex,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let paper = Paper::read()?;
        let format = self.format.unwrap_or(match ending(self.file.as_deref()).as_str() {
            "md" => Format::Markdown,
            "tex" => Format::Latex,
            _ => Format::Html,
        });
        let (format, figures) = match format {
            Format::Html => (PaperFormat::Html, figures()?),
            Format::Markdown => (PaperFormat::Markdown, vec![]),
            Format::Latex => (PaperFormat::Latex, vec![]),
        };
        deliver(self.file.as_deref(), &[], |out| paper.write(format, &figures, out))
    }
}

/// Figures 2 to 6 of the paper.
fn figures() -> Result<Vec<PaperFigure>, Failure> {
    let (path, both) = (precession(), connected(&["plus", "zero"], None)?);
    let axis = nalgebra::Vector3::new(0.9, 1.9, 1.3);
    let all: [(&str, &str, Figure); 5] = [
        (
            "Figure 2: the two images of the velocity",
            "A motion in the ball of rotation vectors, with its tangent `w` and the images `Omega` and `omega` at the identity.",
            figures::images(&path, FIGURE_AT)?,
        ),
        (
            "Figure 3: parallel transport of the velocity to the identity",
            "With `plus`, on M(3), the tangent arrives at `omega` (57); with `zero`, on SO(3), halfway between `omega` and `Omega` (71).",
            figures::transport(&both, &path, FIGURE_AT)?,
        ),
        (
            "Figure 4: autoparallels through the identity",
            "One-parameter groups are the autoparallels of all canonical connections; in rotation vectors they are straight (74).",
            figures::autoparallels(&both, &axis)?,
        ),
        (
            "Figure 5: a motion in the group, and the body",
            "The curve of rotation vectors, and the axes of the body along it.",
            figures::motion(&path, FIGURE_AT)?,
        ),
        (
            "Figure 6: the left-invariant frame along a motion",
            "The frame `e_i(p) = L_{p*} e_i(e)` (22), and the frames that `plus` and `zero` parallel-transport.",
            figures::frames(&both, &path, FIGURE_AT)?,
        ),
    ];
    let view = View::default();
    let drawn = all.map(|(title, about, figure)| PaperFigure {
        title: title.into(),
        about: about.into(),
        svg: element(&svg(&draw(&figure, &view), 800)),
    });
    Ok(drawn.into())
}

/// The SVG element of a picture, without the XML declaration of a file.
fn element(svg: &str) -> String {
    svg.find("<svg").map_or(svg, |start| &svg[start..]).trim_end().into()
}
