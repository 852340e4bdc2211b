//! Curves with markers over two logarithmic axes: work-precision diagrams and orders of convergence.

use super::log_axis::LogAxis;
use super::{FONT, GRID, INK, PALETTE, SCALE, large, shrink};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Size as shown in px: the legend is on the right.
const SIZE: (i32, i32) = (960, 540);
const LEGEND: u32 = 250;

/// A named curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Positive x and y; others are left out.
    pub points: Vec<(f64, f64)>,
}

/// What the figure shows.
#[derive(Clone, Debug, PartialEq)]
pub struct LogLog {
    /// Title.
    pub title: String,
    /// Name and unit of the axes.
    pub axes: [String; 2],
    /// The curves.
    pub series: Vec<Series>,
    /// A level of y below which nothing can be told, and why.
    pub floor: Option<(f64, String)>,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

impl LogLog {
    /// The figure as SVG.
    ///
    /// # Errors
    /// What the plotting library says, or that there is nothing to draw.
    pub fn svg(&self) -> Result<String, String> {
        let mut svg = String::new();
        let size = (SIZE.0 as u32, SIZE.1 as u32);
        let points = || self.series.iter().flat_map(|s| s.points.iter()).filter(|p| p.0 > 0.0 && p.1 > 0.0);
        if points().next().is_none() {
            return Err(format!("{}: no point to draw", self.title));
        }
        let floor = self.floor.iter().map(|f| f.0);
        let axes = (LogAxis::around(points().map(|p| p.0)), LogAxis::around(points().map(|p| p.1).chain(floor)));
        self.draw(SVGBackend::with_string(&mut svg, (large(size.0), large(size.1))).into_drawing_area(), axes)
            .map_err(|e| e.to_string())?;
        Ok(shrink(&svg, size))
    }

    fn draw(&self, root: Area<'_>, (x, y): (LogAxis, LogAxis)) -> Result<(), Box<dyn std::error::Error>> {
        let font = |size: i32| (FONT, size * SCALE).into_font().color(&INK);
        root.fill(&WHITE).map_err(text)?;
        root.draw(&Text::new(self.title.clone(), (70 * SCALE, 12 * SCALE), font(19))).map_err(text)?;
        let plot = root.margin(large(42), large(6), large(6), large(LEGEND));
        let mut chart = ChartBuilder::on(&plot)
            .x_label_area_size(large(52))
            .y_label_area_size(large(74))
            .build_cartesian_2d(x, y)
            .map_err(text)?;
        chart
            .configure_mesh()
            .x_desc(self.axes[0].as_str())
            .y_desc(self.axes[1].as_str())
            .axis_desc_style(font(16))
            .label_style(font(14))
            .axis_style(INK.stroke_width(large(1)))
            .bold_line_style(GRID.stroke_width(large(1)))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(large(4))
            .x_labels(12)
            .y_labels(12)
            .x_label_formatter(&|v| LogAxis::label(*v))
            .y_label_formatter(&|v| LogAxis::label(*v))
            .draw()
            .map_err(text)?;
        if let Some((level, why)) = &self.floor {
            let (from, to) = (plotters::coord::ranged1d::Ranged::range(&x), level.log10());
            let line = [(from.start, to), (from.end, to)];
            let style = INK.mix(0.5).stroke_width(large(1));
            chart.draw_series(DashedLineSeries::new(line, large(6), large(4), style)).map_err(text)?;
            let label = EmptyElement::at(line[0]) + Text::new(why.clone(), (6 * SCALE, -16 * SCALE), font(13));
            chart.draw_series([label]).map_err(text)?;
        }
        for (i, series) in self.series.iter().enumerate() {
            let points = series.points.iter().filter(|p| p.0 > 0.0 && p.1 > 0.0).map(|p| (p.0.log10(), p.1.log10()));
            let points: Vec<(f64, f64)> = points.collect();
            let style = colour(i).stroke_width(large(2));
            chart.draw_series(LineSeries::new(points.iter().copied(), style)).map_err(text)?;
            let ring: Vec<(i32, i32)> = outline(i).chain(outline(i).take(1)).collect();
            let inside = if i < PALETTE.len() { colour(i).filled() } else { WHITE.filled() };
            chart
                .draw_series(points.iter().map(|&p| EmptyElement::at(p) + Polygon::new(ring.clone(), inside)))
                .map_err(text)?;
            chart
                .draw_series(points.iter().map(|&p| EmptyElement::at(p) + PathElement::new(ring.clone(), style)))
                .map_err(text)?;
            let at = ((SIZE.0 - LEGEND as i32 + 16) * SCALE, (60 + 25 * i as i32) * SCALE);
            let line = PathElement::new(vec![at, (at.0 + 30 * SCALE, at.1)], style);
            root.draw(&line).map_err(text)?;
            let middle = (at.0 + 15 * SCALE, at.1);
            root.draw(&(EmptyElement::at(middle) + Polygon::new(ring.clone(), inside))).map_err(text)?;
            root.draw(&(EmptyElement::at(middle) + PathElement::new(ring, style))).map_err(text)?;
            let name = Text::new(series.name.clone(), (at.0 + 38 * SCALE, at.1 - 8 * SCALE), font(14));
            root.draw(&name).map_err(text)?;
        }
        root.present().map_err(text)?;
        Ok(())
    }
}

fn text(error: impl std::fmt::Display) -> Box<dyn std::error::Error> {
    error.to_string().into()
}

fn colour(i: usize) -> RGBColor {
    PALETTE[i % PALETTE.len()]
}

/// The marker of a curve: circle, square, triangle or diamond.
fn outline(i: usize) -> impl Iterator<Item = (i32, i32)> {
    let corners = [24, 4, 3, 4][i % 4];
    let turn = [0.0, 0.125, 0.25, 0.0][i % 4];
    let radius = f64::from(SCALE) * [4.2, 5.0, 5.6, 5.6][i % 4];
    (0..corners).map(move |k| {
        let angle = std::f64::consts::TAU * (f64::from(k) / f64::from(corners) + turn);
        ((radius * angle.cos()).round() as i32, (-radius * angle.sin()).round() as i32)
    })
}
