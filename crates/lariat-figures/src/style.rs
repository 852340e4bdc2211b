//! Fonts, colours and line widths that all figures share.

use crate::error::Error;
use plotters::chart::MeshStyle;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;

pub const INK: RGBColor = RGBColor(45, 45, 48);
pub const GRID: RGBColor = RGBColor(225, 225, 228);
/// Blue, vermilion, green, purple, orange, sky, ink.
pub const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(170, 68, 153),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    INK,
];

/// The plotting library rounds to whole pixels, so figures are drawn larger by this factor and
/// scaled down by their `viewBox`.
pub const SCALE: i32 = 8;

/// The area that a figure is drawn on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
/// The error of a drawing call, whatever its type in the plotting library.
pub type Fault = Box<dyn std::error::Error>;

/// Converts a displayed length in px into the pixels of the drawing.
pub fn large(px: u32) -> u32 {
    px * SCALE as u32
}

/// The reader's sans-serif font, in a size in px as displayed.
pub fn font(size: i32) -> TextStyle<'static> {
    ("sans-serif", size * SCALE).into_font().color(&INK)
}

/// Draws a figure of a displayed size in px, and returns it as SVG.
pub fn render(
    title: &str,
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Result<(), Fault>,
) -> Result<String, Error> {
    let mut svg = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut svg, (large(size.0), large(size.1))).into_drawing_area();
        area.fill(&WHITE).map_err(fault).and_then(|()| draw(&area)).and_then(|()| area.present().map_err(fault))
    };
    drawn.map_err(|reason| Error::Draw { figure: title.to_string(), reason: reason.to_string() })?;
    let head = |w: u32, h: u32| format!("width=\"{w}\" height=\"{h}\"");
    Ok(svg.replacen(&head(large(size.0), large(size.1)), &head(size.0, size.1), 1))
}

/// Converts an error of the plotting library, which may borrow the drawing.
pub fn fault(error: impl std::fmt::Display) -> Fault {
    error.to_string().into()
}

/// Sets the appearance of axes and grid; `name` and `label` are font sizes in px.
pub fn style_mesh<X, Y>(mesh: &mut MeshStyle<'_, '_, X, Y, SVGBackend<'_>>, name: i32, label: i32)
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    mesh.axis_desc_style(font(name))
        .label_style(font(label))
        .axis_style(INK.stroke_width(large(1)))
        .bold_line_style(GRID.stroke_width(large(1)))
        .set_all_tick_mark_size(large(4))
        .light_line_style(TRANSPARENT);
}

/// Returns the smallest and the largest finite value, widened to a span of at least `least`.
pub fn range(values: impl Iterator<Item = f64>, least: f64) -> (f64, f64) {
    let (low, high) = values
        .filter(|x| x.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return (0.0, least);
    }
    let widen = (0.5 * (least - (high - low))).max(0.0);
    (low - widen, high + widen)
}
