//! The shape of a cable at several times: x against y with equal axes, drawn smoothly through
//! samples inside the elements.

use crate::error::Error;
use crate::style::{Area, Fault, SCALE, fault, font, large, range, render, style_mesh};
use lariat_ancf::Cable;
use plotters::prelude::*;

/// Points drawn in each element.
const POINTS: usize = 12;
/// Width of the plotted area in px.
const WIDTH: f64 = 760.0;
/// Space to the left of the description of the axis in px.
const EDGE: u32 = 8;
/// Space in px for the descriptions of the axes, the title and the legend.
const AXIS: u32 = 62;
const HEAD: u32 = 46;
const LEGEND: u32 = 110;

/// The shape of a cable at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Time in s.
    pub time: f64,
    /// Points along the cable: x and y in m.
    pub curve: Vec<(f64, f64)>,
    /// Nodes: x and y in m.
    pub nodes: Vec<(f64, f64)>,
}

impl Shape {
    /// Returns the present shape of a cable.
    pub fn of(cable: &Cable) -> Self {
        let s = cable.node_arc_lengths();
        let at = |s: f64| cable.sample(s.min(cable.length())).map(|p| (p.position.x, p.position.y)).ok();
        let inside = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            (0..POINTS).map(move |i| from + (to - from) * i as f64 / POINTS as f64).collect::<Vec<_>>()
        };
        let curve = s.windows(2).flat_map(inside).chain([cable.length()]).filter_map(at).collect();
        Shape { time: cable.time(), curve, nodes: s.iter().filter_map(|&s| at(s)).collect() }
    }
}

/// A figure of shapes at several times.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeFigure {
    /// Title.
    pub title: String,
    /// The shapes, in the order of their times.
    pub shapes: Vec<Shape>,
}

type Span = std::ops::Range<f64>;

impl ShapeFigure {
    /// Returns the figure as SVG.
    ///
    /// # Errors
    /// [`Error::Draw`] if the plotting library fails.
    pub fn svg(&self) -> Result<String, Error> {
        let points = || self.shapes.iter().flat_map(|shape| &shape.curve);
        let (left, right) = range(points().map(|p| p.0), 0.1);
        let (low, high) = range(points().map(|p| p.1), 0.1);
        let margin = 0.05 * (right - left).max(high - low);
        let (x, y) = ((left - margin)..(right + margin), (low - margin)..(high + margin));
        let height = WIDTH * (y.end - y.start) / (x.end - x.start);
        let size = (WIDTH as u32 + AXIS + LEGEND + EDGE, height as u32 + AXIS + HEAD);
        render(&self.title, size, |root| self.draw(root, size.0, (x, y)))
    }

    fn draw(&self, root: &Area<'_>, width: u32, (x, y): (Span, Span)) -> Result<(), Fault> {
        root.draw(&Text::new(self.title.clone(), (AXIS as i32 * SCALE, 14 * SCALE), font(21))).map_err(fault)?;
        let plot = root.margin(large(HEAD), 0, large(EDGE), large(LEGEND));
        let mut chart = ChartBuilder::on(&plot)
            .x_label_area_size(large(AXIS))
            .y_label_area_size(large(AXIS))
            .build_cartesian_2d(x, y)
            .map_err(fault)?;
        // adding 0 prints -0.0 as 0.0
        let label = |v: &f64| format!("{:.1}", v + 0.0);
        let mut mesh = chart.configure_mesh();
        style_mesh(&mut mesh, 19, 16);
        mesh.x_desc("x [m]").y_desc("y [m]").x_label_formatter(&label).y_label_formatter(&label);
        mesh.draw().map_err(fault)?;
        let last = self.shapes.iter().map(|s| s.time).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        for (i, shape) in self.shapes.iter().enumerate() {
            let colour = ramp(shape.time / last);
            let curve = LineSeries::new(shape.curve.iter().copied(), colour.stroke_width(large(3)));
            chart.draw_series(curve).map_err(fault)?;
            let nodes = shape.nodes.iter().map(|&p| Circle::new(p, 3 * SCALE, colour.filled()));
            chart.draw_series(nodes).map_err(fault)?;
            let (left, top) = ((width as i32 - LEGEND as i32 + 14) * SCALE, (HEAD as i32 + 12 + 24 * i as i32) * SCALE);
            let line = PathElement::new(vec![(left, top), (left + 24 * SCALE, top)], colour.stroke_width(large(3)));
            root.draw(&line).map_err(fault)?;
            let label = format!("{:.2} s", shape.time);
            root.draw(&Text::new(label, (left + 32 * SCALE, top - 8 * SCALE), font(16))).map_err(fault)?;
        }
        Ok(())
    }
}

/// Returns a colour from dark blue over green to amber, as the share of time goes from 0 to 1.
fn ramp(share: f64) -> RGBColor {
    const STOPS: [(f64, f64, f64); 5] =
        [(45.0, 40.0, 120.0), (35.0, 105.0, 155.0), (20.0, 150.0, 120.0), (150.0, 175.0, 30.0), (232.0, 145.0, 0.0)];
    let at = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let k = (at as usize).min(STOPS.len() - 2);
    let mix = |a: f64, b: f64| (a + (b - a) * (at - k as f64)).round() as u8;
    let (a, b) = (STOPS[k], STOPS[k + 1]);
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}
