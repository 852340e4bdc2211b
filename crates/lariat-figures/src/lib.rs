//! Figures as SVG: the pendulum in motion, its tip against time, and curves over two logarithmic axes.
//!
//! Fonts are the reader's sans-serif; colours are told apart by the colour-blind too (Okabe & Ito 2008, and a ramp for time).

mod error;
mod log_axis;
mod log_log;
mod pendulum;
pub mod reference_pendulum;
mod snapshots;
mod tip;

pub use error::Error;
pub use log_log::{LogLog, Series};
pub use pendulum::pendulum_tip;
pub use snapshots::{Snapshot, snapshots, snapshots_svg};
pub use tip::{Curve, TipFigure, tip, tip_svg};

use plotters::style::RGBColor;
use std::fmt::Display;
use std::path::Path;

const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(45, 45, 48);
const GRID: RGBColor = RGBColor(225, 225, 228);
/// Blue, vermilion, green, purple, orange, sky, ink.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(170, 68, 153),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    INK,
];

/// The plotting library rounds to whole pixels: drawings are made so many times larger, and shown at their size by their `viewBox`.
const SCALE: i32 = 8;

/// A length shown in px, in those of the drawing.
fn large(px: u32) -> u32 {
    px * SCALE as u32
}

/// Shows a drawing at its size.
fn shrink(svg: &str, (width, height): (u32, u32)) -> String {
    let head = |w: u32, h: u32| format!("width=\"{w}\" height=\"{h}\"");
    svg.replacen(&head(large(width), large(height)), &head(width, height), 1)
}

/// Writes a finished drawing to a file.
fn save(path: &Path, svg: &str) -> Result<(), Error> {
    std::fs::write(path, svg).map_err(|source| Error::Write { path: path.to_path_buf(), source })
}

/// A drawing that failed.
fn failed(path: &Path) -> impl Fn(&dyn Display) -> Error + '_ {
    move |reason| Error::Draw { path: path.to_path_buf(), reason: reason.to_string() }
}

/// Smallest and largest finite value, at least `least` apart.
fn range(values: impl Iterator<Item = f64>, least: f64) -> (f64, f64) {
    let (low, high) = values
        .filter(|x| x.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return (0.0, least);
    }
    let widen = (0.5 * (least - (high - low))).max(0.0);
    (low - widen, high + widen)
}
