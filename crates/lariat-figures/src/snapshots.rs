//! The shape of a cable at several times, x against y with equal axes, drawn smoothly through samples inside the elements.

use super::{FONT, GRID, INK, SCALE, failed, large, range, save, shrink};
use crate::error::Error;
use lariat_ancf::Cable;
use plotters::prelude::*;
use std::path::Path;

/// Points drawn in each element.
const POINTS: usize = 12;
/// Width of the plotted area in px.
const WIDTH: f64 = 760.0;

/// Space left of the axis description in px.
const EDGE: u32 = 8;

/// A cable at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Time in s.
    pub time: f64,
    /// Points along the cable: x and y in m.
    pub curve: Vec<(f64, f64)>,
    /// Nodes: x and y in m.
    pub nodes: Vec<(f64, f64)>,
}

impl Snapshot {
    /// The present shape of a cable.
    pub fn of(cable: &Cable) -> Self {
        let s = cable.node_arc_lengths();
        let at = |s: f64| cable.sample(s.min(cable.length())).map(|p| (p.position.x, p.position.y)).ok();
        let inside = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            (0..POINTS).map(move |i| from + (to - from) * i as f64 / POINTS as f64).collect::<Vec<_>>()
        };
        let curve = s.windows(2).flat_map(inside).chain([cable.length()]).filter_map(at).collect();
        Snapshot { time: cable.time(), curve, nodes: s.iter().filter_map(|&s| at(s)).collect() }
    }
}

/// Draws snapshots into an SVG file.
///
/// # Errors
/// [`Error::Output`] if the file cannot be written, [`Error::Figure`] if it cannot be drawn.
pub fn snapshots(path: &Path, title: &str, shots: &[Snapshot]) -> Result<(), Error> {
    save(path, &snapshots_svg(title, shots).map_err(|reason| failed(path)(&reason))?)
}

/// The same as text.
///
/// # Errors
/// What the plotting library says.
pub fn snapshots_svg(title: &str, shots: &[Snapshot]) -> Result<String, String> {
    let points = || shots.iter().flat_map(|shot| &shot.curve);
    let (left, right) = range(points().map(|p| p.0), 0.1);
    let (low, high) = range(points().map(|p| p.1), 0.1);
    let margin = 0.05 * (right - left).max(high - low);
    let (x, y) = ((left - margin)..(right + margin), (low - margin)..(high + margin));
    let height = WIDTH * (y.end - y.start) / (x.end - x.start);
    let (axis, head, legend) = (62, 46, 110);
    let size = (WIDTH as u32 + axis + legend + EDGE, height as u32 + axis + head);
    let mut svg = String::new();
    draw(&mut svg, size, title, shots, (x, y), (axis, head, legend))?;
    Ok(shrink(&svg, size))
}

type Span = std::ops::Range<f64>;

fn draw(
    svg: &mut String,
    size: (u32, u32),
    title: &str,
    shots: &[Snapshot],
    (x, y): (Span, Span),
    (axis, head, legend): (u32, u32, u32),
) -> Result<(), String> {
    let text = |e: &dyn std::fmt::Display| e.to_string();
    let root = SVGBackend::with_string(svg, (large(size.0), large(size.1))).into_drawing_area();
    let font = |size: i32| (FONT, size * SCALE).into_font().color(&INK);
    root.fill(&WHITE).map_err(|e| text(&e))?;
    root.draw(&Text::new(title.to_string(), (axis as i32 * SCALE, 14 * SCALE), font(21))).map_err(|e| text(&e))?;
    let plot = root.margin(large(head), 0, large(EDGE), large(legend));
    let mut chart = ChartBuilder::on(&plot)
        .x_label_area_size(large(axis))
        .y_label_area_size(large(axis))
        .build_cartesian_2d(x, y.clone())
        .map_err(|e| text(&e))?;
    chart
        .configure_mesh()
        .x_desc("x [m]")
        .y_desc("y [m]")
        .axis_desc_style(font(19))
        .label_style(font(16))
        .axis_style(INK.stroke_width(large(1)))
        .bold_line_style(GRID.stroke_width(large(1)))
        .set_all_tick_mark_size(large(4))
        .light_line_style(TRANSPARENT)
        .x_label_formatter(&|x| format!("{:.1}", x + 0.0))
        .y_label_formatter(&|y| format!("{:.1}", y + 0.0))
        .draw()
        .map_err(|e| text(&e))?;
    let last = shots.iter().map(|s| s.time).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    for (i, shot) in shots.iter().enumerate() {
        let colour = ramp(shot.time / last);
        chart
            .draw_series(LineSeries::new(shot.curve.iter().copied(), colour.stroke_width(large(3))))
            .map_err(|e| text(&e))?;
        let dots = shot.nodes.iter().map(|&p| Circle::new(p, 3 * SCALE, colour.filled()));
        chart.draw_series(dots).map_err(|e| text(&e))?;
        let (left, top) = ((size.0 as i32 - legend as i32 + 14) * SCALE, (head as i32 + 12 + 24 * i as i32) * SCALE);
        let line = PathElement::new(vec![(left, top), (left + 24 * SCALE, top)], colour.stroke_width(large(3)));
        root.draw(&line).map_err(|e| text(&e))?;
        let label = format!("{:.2} s", shot.time);
        root.draw(&Text::new(label, (left + 32 * SCALE, top - 8 * SCALE), font(16))).map_err(|e| text(&e))?;
    }
    root.present().map_err(|e| text(&e))
}

/// From dark blue over green to amber, as time goes from 0 to 1.
fn ramp(share: f64) -> RGBColor {
    const STOPS: [(f64, f64, f64); 5] =
        [(45.0, 40.0, 120.0), (35.0, 105.0, 155.0), (20.0, 150.0, 120.0), (150.0, 175.0, 30.0), (232.0, 145.0, 0.0)];
    let at = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let k = (at as usize).min(STOPS.len() - 2);
    let mix = |a: f64, b: f64| (a + (b - a) * (at - k as f64)).round() as u8;
    let (a, b) = (STOPS[k], STOPS[k + 1]);
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}
