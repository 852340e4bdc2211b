//! Curves with markers over two logarithmic axes: work-precision diagrams and orders of
//! convergence.

use crate::Curve;
use crate::error::Error;
use crate::log_axis::LogAxis;
use crate::style::{Area, Fault, INK, PALETTE, SCALE, fault, font, large, render, style_mesh};
use plotters::prelude::*;

/// Displayed size in px; the legend is on the right.
const SIZE: (u32, u32) = (960, 540);
const LEGEND: u32 = 250;

/// A figure with two logarithmic axes.
#[derive(Clone, Debug, PartialEq)]
pub struct LogLog {
    /// Title.
    pub title: String,
    /// Name and unit of the axes.
    pub axes: [String; 2],
    /// The curves; points with an x or y that is not positive are left out.
    pub curves: Vec<Curve>,
    /// A value of y below which the reference is not accurate enough to tell errors, and a label
    /// for it.
    pub floor: Option<(f64, String)>,
}

impl LogLog {
    /// Returns the figure as SVG.
    ///
    /// # Errors
    /// [`Error::Draw`] if the plotting library fails or there is no point to draw.
    pub fn svg(&self) -> Result<String, Error> {
        let points = || self.curves.iter().flat_map(|c| c.points.iter()).filter(|p| p.0 > 0.0 && p.1 > 0.0);
        if points().next().is_none() {
            return Err(Error::Draw { figure: self.title.clone(), reason: "no point to draw".to_string() });
        }
        let floor = self.floor.iter().map(|f| f.0);
        let axes = (LogAxis::around(points().map(|p| p.0)), LogAxis::around(points().map(|p| p.1).chain(floor)));
        render(&self.title, SIZE, |root| self.draw(root, axes))
    }

    fn draw(&self, root: &Area<'_>, (x, y): (LogAxis, LogAxis)) -> Result<(), Fault> {
        root.draw(&Text::new(self.title.clone(), (70 * SCALE, 12 * SCALE), font(19))).map_err(fault)?;
        let plot = root.margin(large(42), large(6), large(6), large(LEGEND));
        let mut chart = ChartBuilder::on(&plot)
            .x_label_area_size(large(52))
            .y_label_area_size(large(74))
            .build_cartesian_2d(x, y)
            .map_err(fault)?;
        let label = |v: &f64| LogAxis::label(*v);
        let mut mesh = chart.configure_mesh();
        style_mesh(&mut mesh, 16, 14);
        mesh.x_desc(self.axes[0].as_str()).y_desc(self.axes[1].as_str());
        mesh.x_labels(12).y_labels(12).x_label_formatter(&label).y_label_formatter(&label).draw().map_err(fault)?;
        if let Some((level, why)) = &self.floor {
            let (from, to) = (plotters::coord::ranged1d::Ranged::range(&x), level.log10());
            let line = [(from.start, to), (from.end, to)];
            let style = INK.mix(0.5).stroke_width(large(1));
            chart.draw_series(DashedLineSeries::new(line, large(6), large(4), style)).map_err(fault)?;
            let label = EmptyElement::at(line[0]) + Text::new(why.clone(), (6 * SCALE, -16 * SCALE), font(13));
            chart.draw_series([label]).map_err(fault)?;
        }
        for (i, curve) in self.curves.iter().enumerate() {
            let points = curve.points.iter().filter(|p| p.0 > 0.0 && p.1 > 0.0).map(|p| (p.0.log10(), p.1.log10()));
            let points: Vec<(f64, f64)> = points.collect();
            let style = colour(i).stroke_width(large(2));
            chart.draw_series(LineSeries::new(points.iter().copied(), style)).map_err(fault)?;
            let ring: Vec<(i32, i32)> = outline(i).chain(outline(i).take(1)).collect();
            let inside = if i < PALETTE.len() { colour(i).filled() } else { WHITE.filled() };
            chart
                .draw_series(points.iter().map(|&p| EmptyElement::at(p) + Polygon::new(ring.clone(), inside)))
                .map_err(fault)?;
            chart
                .draw_series(points.iter().map(|&p| EmptyElement::at(p) + PathElement::new(ring.clone(), style)))
                .map_err(fault)?;
            let at = ((SIZE.0 as i32 - LEGEND as i32 + 16) * SCALE, (60 + 25 * i as i32) * SCALE);
            root.draw(&PathElement::new(vec![at, (at.0 + 30 * SCALE, at.1)], style)).map_err(fault)?;
            let middle = (at.0 + 15 * SCALE, at.1);
            root.draw(&(EmptyElement::at(middle) + Polygon::new(ring.clone(), inside))).map_err(fault)?;
            root.draw(&(EmptyElement::at(middle) + PathElement::new(ring, style))).map_err(fault)?;
            let name = Text::new(curve.name.clone(), (at.0 + 38 * SCALE, at.1 - 8 * SCALE), font(14));
            root.draw(&name).map_err(fault)?;
        }
        Ok(())
    }
}

fn colour(i: usize) -> RGBColor {
    PALETTE[i % PALETTE.len()]
}

/// Returns the outline of the marker of a curve: circle, square, triangle or diamond.
fn outline(i: usize) -> impl Iterator<Item = (i32, i32)> {
    let corners = [24, 4, 3, 4][i % 4];
    let rotation = [0.0, 0.125, 0.25, 0.0][i % 4];
    let radius = f64::from(SCALE) * [4.2, 5.0, 5.6, 5.6][i % 4];
    (0..corners).map(move |k| {
        let angle = std::f64::consts::TAU * (f64::from(k) / f64::from(corners) + rotation);
        ((radius * angle.cos()).round() as i32, (-radius * angle.sin()).round() as i32)
    })
}
