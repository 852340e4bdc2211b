//! The tip against time: x and y above, distance from references on a logarithmic axis below.

use super::log_axis::{LogAxis, superscript};
use super::{FONT, GRID, INK, PALETTE, SCALE, failed, large, range, save, shrink};
use crate::error::Error;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::path::Path;

/// A named curve against time.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Time in s and value.
    pub points: Vec<(f64, f64)>,
}

/// What the figure shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TipFigure {
    /// Title.
    pub title: String,
    /// Upper panel: positions in m.
    pub positions: Vec<Curve>,
    /// Lower panel: distances in m, drawn on a logarithmic axis; zeros are left out.
    pub distances: Vec<Curve>,
}

/// Size as shown in px.
const SIZE: (u32, u32) = (900, 780);

fn font(size: i32) -> TextStyle<'static> {
    (FONT, size * SCALE).into_font().color(&INK)
}

/// Distances below this are drawn at the lower edge, in m.
const FLOOR: f64 = 1e-10;

/// Draws the figure into an SVG file.
///
/// # Errors
/// [`Error::Output`] if the file cannot be written, [`Error::Figure`] if it cannot be drawn.
pub fn tip(path: &Path, figure: &TipFigure) -> Result<(), Error> {
    save(path, &tip_svg(figure).map_err(|reason| failed(path)(&reason))?)
}

/// The same as text.
///
/// # Errors
/// What the plotting library says.
pub fn tip_svg(figure: &TipFigure) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, figure)?;
    Ok(shrink(&svg, SIZE))
}

fn draw(svg: &mut String, figure: &TipFigure) -> Result<(), String> {
    let text = |e: &dyn std::fmt::Display| e.to_string();
    let root = SVGBackend::with_string(svg, (large(SIZE.0), large(SIZE.1))).into_drawing_area();
    root.fill(&WHITE).map_err(|e| text(&e))?;
    root.draw(&Text::new(figure.title.clone(), (74 * SCALE, 14 * SCALE), font(21))).map_err(|e| text(&e))?;
    let (upper, lower) = root.margin(large(46), large(4), large(4), large(24)).split_vertically(large(370));
    let times = figure.positions.iter().chain(&figure.distances).flat_map(|c| c.points.iter().map(|p| p.0));
    let (from, to) = range(times, 1e-3);
    let (low, high) = range(figure.positions.iter().flat_map(|c| c.points.iter().map(|p| p.1)), 0.1);
    let margin = 0.06 * (high - low);
    panel(
        &upper,
        from..to,
        RangedCoordf64::from((low - margin)..(high + margin)),
        "tip [m]",
        None,
        &|y| format!("{y:.1}"),
        &figure.positions,
        SeriesLabelPosition::LowerLeft,
    )?;
    let logarithms: Vec<Curve> = figure.distances.iter().map(logarithm).collect();
    let (low, high) = range(logarithms.iter().flat_map(|c| c.points.iter().map(|p| p.1)), 1.0);
    panel(
        &lower,
        from..to,
        LogAxis::decades(low.floor(), high.ceil()),
        "distance [m]",
        Some("t [s]"),
        &|y| format!("10{}", superscript(y.round() as i32)),
        &logarithms,
        SeriesLabelPosition::LowerRight,
    )?;
    root.present().map_err(|e| text(&e))
}

fn logarithm(curve: &Curve) -> Curve {
    let points = curve.points.iter().filter(|p| p.1 > 0.0).map(|&(t, y)| (t, y.max(FLOOR).log10())).collect();
    Curve { name: curve.name.clone(), points }
}

fn panel<'a, Y>(
    area: &DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
    x: std::ops::Range<f64>,
    y: Y,
    y_name: &str,
    x_name: Option<&str>,
    y_text: &dyn Fn(&f64) -> String,
    curves: &[Curve],
    legend: SeriesLabelPosition,
) -> Result<(), String>
where
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let text = |e: &dyn std::fmt::Display| e.to_string();
    let mut chart = ChartBuilder::on(area)
        .margin_top(large(10))
        .x_label_area_size(large(if x_name.is_some() { 58 } else { 34 }))
        .y_label_area_size(large(74))
        .build_cartesian_2d(x, y)
        .map_err(|e| text(&e))?;
    let mut mesh = chart.configure_mesh();
    mesh.y_desc(y_name)
        .axis_desc_style(font(19))
        .label_style(font(16))
        .axis_style(INK.stroke_width(large(1)))
        .bold_line_style(GRID.stroke_width(large(1)))
        .set_all_tick_mark_size(large(4))
        .light_line_style(TRANSPARENT)
        .x_label_formatter(&|t| format!("{t:.1}"))
        .y_label_formatter(y_text);
    if let Some(name) = x_name {
        mesh.x_desc(name);
    }
    mesh.draw().map_err(|e| text(&e))?;
    for (i, curve) in curves.iter().enumerate() {
        let style = PALETTE[i % PALETTE.len()].stroke_width(large(2));
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), style))
            .map_err(|e| text(&e))?
            .label(curve.name.clone())
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 24 * SCALE, y)], style));
    }
    chart
        .configure_series_labels()
        .position(legend)
        .margin(large(14))
        .legend_area_size(large(34))
        .label_font(font(16))
        .background_style(WHITE.mix(0.85))
        .border_style(GRID.stroke_width(large(1)))
        .draw()
        .map_err(|e| text(&e))
}
