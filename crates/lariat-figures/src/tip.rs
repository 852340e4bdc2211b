//! The tip of a cable against time: x and y above, distances from references on a logarithmic axis
//! below.

use crate::Curve;
use crate::error::Error;
use crate::log_axis::{LogAxis, superscript};
use crate::style::{Area, Fault, GRID, PALETTE, SCALE, fault, font, large, range, render, style_mesh};
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// A figure of two panels against time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TipFigure {
    /// Title.
    pub title: String,
    /// Upper panel: positions in m against time in s.
    pub positions: Vec<Curve>,
    /// Lower panel: distances in m against time in s, on a logarithmic axis; zeros are left out.
    pub distances: Vec<Curve>,
}

/// Displayed size in px.
const SIZE: (u32, u32) = (900, 780);
/// Distances below this, in m, are drawn at the lower edge.
const FLOOR: f64 = 1e-10;

impl TipFigure {
    /// Returns the figure as SVG.
    ///
    /// # Errors
    /// [`Error::Draw`] if the plotting library fails.
    pub fn svg(&self) -> Result<String, Error> {
        render(&self.title, SIZE, |root| self.draw(root))
    }

    fn draw(&self, root: &Area<'_>) -> Result<(), Fault> {
        root.draw(&Text::new(self.title.clone(), (74 * SCALE, 14 * SCALE), font(21))).map_err(fault)?;
        let (upper, lower) = root.margin(large(46), large(4), large(4), large(24)).split_vertically(large(370));
        let times = self.positions.iter().chain(&self.distances).flat_map(|c| c.points.iter().map(|p| p.0));
        let (from, to) = range(times, 1e-3);
        let (low, high) = range(self.positions.iter().flat_map(|c| c.points.iter().map(|p| p.1)), 0.1);
        let margin = 0.06 * (high - low);
        let y = RangedCoordf64::from((low - margin)..(high + margin));
        let number = |y: &f64| format!("{y:.1}");
        panel(&upper, (from..to, y), ["", "tip [m]"], &number, &self.positions, SeriesLabelPosition::LowerLeft)?;
        let logarithms: Vec<Curve> = self.distances.iter().map(logarithm).collect();
        let (low, high) = range(logarithms.iter().flat_map(|c| c.points.iter().map(|p| p.1)), 1.0);
        let y = LogAxis::decades(low.floor(), high.ceil());
        let power = |y: &f64| format!("10{}", superscript(y.round() as i32));
        let names = ["t [s]", "distance [m]"];
        panel(&lower, (from..to, y), names, &power, &logarithms, SeriesLabelPosition::LowerRight)
    }
}

fn logarithm(curve: &Curve) -> Curve {
    let points = curve.points.iter().filter(|p| p.1 > 0.0).map(|&(t, y)| (t, y.max(FLOOR).log10())).collect();
    Curve { name: curve.name.clone(), points }
}

/// Draws one panel; an empty name of the x axis leaves its description out.
fn panel<Y>(
    area: &Area<'_>,
    (x, y): (std::ops::Range<f64>, Y),
    [x_name, y_name]: [&str; 2],
    y_text: &dyn Fn(&f64) -> String,
    curves: &[Curve],
    legend: SeriesLabelPosition,
) -> Result<(), Fault>
where
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let mut chart = ChartBuilder::on(area)
        .margin_top(large(10))
        .x_label_area_size(large(if x_name.is_empty() { 34 } else { 58 }))
        .y_label_area_size(large(74))
        .build_cartesian_2d(x, y)
        .map_err(fault)?;
    let time = |t: &f64| format!("{t:.1}");
    let mut mesh = chart.configure_mesh();
    style_mesh(&mut mesh, 19, 16);
    mesh.y_desc(y_name).x_label_formatter(&time).y_label_formatter(y_text);
    if !x_name.is_empty() {
        mesh.x_desc(x_name);
    }
    mesh.draw().map_err(fault)?;
    for (i, curve) in curves.iter().enumerate() {
        let style = PALETTE[i % PALETTE.len()].stroke_width(large(2));
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), style))
            .map_err(fault)?
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
        .map_err(fault)
}
