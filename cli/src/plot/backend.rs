//! A backend of plotters that collects the shapes of a picture.

use super::{Anchor, Font, Ink, Point, Shape, Stroke};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};
use std::convert::Infallible;

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

/// Shapes drawn so far, on a plane of this size.
pub(super) struct Shapes<'s> {
    pub(super) shapes: &'s mut Vec<Shape>,
    pub(super) size: (u32, u32),
}

impl Shapes<'_> {
    fn area(&mut self, points: Vec<Point>, color: BackendColor) -> Drawn {
        if color.alpha > 0.0 {
            self.shapes.push(Shape::Area { points, ink: ink(color) });
        }
        Ok(())
    }
}

impl DrawingBackend for Shapes<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        self.area(corners(at, (at.0 + 1, at.1 + 1)).to_vec(), color)
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, s: &S) -> Drawn {
        self.draw_path([a, b], s)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        low: BackendCoord,
        high: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        if fill {
            return self.area(corners(low, high).to_vec(), style.color());
        }
        self.draw_path([low, (high.0, low.1), high, (low.0, high.1), low], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let (color, width) = (style.color(), f64::from(style.stroke_width()));
        if color.alpha > 0.0 {
            let points = path.into_iter().map(point).collect();
            self.shapes
                .push(Shape::Line { points, stroke: Stroke { ink: ink(color), width, dash: &[] } });
        }
        Ok(())
    }

    /// Every circle of a diagram is filled.
    fn draw_circle<S: BackendStyle>(
        &mut self,
        at: BackendCoord,
        radius: u32,
        style: &S,
        _: bool,
    ) -> Drawn {
        let (at, radius, ink) = (point(at), f64::from(radius), ink(style.color()));
        self.shapes.push(Shape::Disc { at, radius, ink });
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        self.area(path.into_iter().map(point).collect(), style.color())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        // plotters counts the size of a font from the top of its highest letter to the lowest end
        let size = style.size() / 1.24;
        let anchor = match style.anchor().h_pos {
            HPos::Left => Anchor::Start,
            HPos::Center => Anchor::Middle,
            HPos::Right => Anchor::End,
        };
        // from the anchor of plotters down to the base line
        let down = size
            * match style.anchor().v_pos {
                VPos::Top => 0.76,
                VPos::Center => 0.27,
                VPos::Bottom => -0.27,
            };
        let turned = matches!(style.transform(), FontTransform::Rotate270);
        let [x, y] = point(at);
        let at = if turned { [x + down, y] } else { [x, y + down] };
        let font = Font { turned, ink: ink(style.color()), ..Font::words(size, anchor) };
        self.shapes.push(Shape::Text { at, text: text.into(), font });
        Ok(())
    }
}

fn point((x, y): BackendCoord) -> Point {
    [f64::from(x), f64::from(y)]
}

fn corners(low: BackendCoord, high: BackendCoord) -> [Point; 4] {
    [low, (high.0, low.1), high, (low.0, high.1)].map(point)
}

fn ink(color: BackendColor) -> Ink {
    let (red, green, blue) = color.rgb;
    Ink { rgb: [red, green, blue], opacity: color.alpha }
}
