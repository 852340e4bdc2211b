//! Figures as SVG, and the reference solution of the falling pendulum.
//!
//! | type | figure |
//! |---|---|
//! | [`LogLog`] | curves over two logarithmic axes |
//! | [`ShapeFigure`] | the shape of a cable at several times |
//! | [`TipFigure`] | the position of the tip against time, and its distance from references |
//!
//! This crate is part of the workspace and is not published.
//!
//! # References
//! Okabe, M. & Ito, K. (2008), Color Universal Design: the palette, which colour-blind readers can
//! tell apart.

mod error;
mod log_axis;
mod log_log;
mod pendulum;
pub mod reference_pendulum;
mod shapes;
mod style;
mod tip;

pub use error::Error;
pub use log_log::LogLog;
pub use pendulum::pendulum_tip;
pub use shapes::{Shape, ShapeFigure};
pub use tip::TipFigure;

use std::path::Path;

/// A named curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Points (x, y); an axis against time is in s.
    pub points: Vec<(f64, f64)>,
}

/// Writes a finished figure to a file.
///
/// # Errors
/// [`Error::Write`].
pub fn save(path: &Path, svg: &str) -> Result<(), Error> {
    std::fs::write(path, svg).map_err(|source| Error::Write { path: path.to_path_buf(), source })
}
