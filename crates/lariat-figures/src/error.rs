//! Errors of drawing and saving a figure.

use std::path::PathBuf;

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be written.
    #[error("cannot write to {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A figure cannot be drawn.
    #[error("cannot draw the figure {figure:?}: {reason}")]
    Draw {
        /// Title of the figure.
        figure: String,
        /// What the plotting library reported, or what is missing.
        reason: String,
    },
    /// The cable of a figure cannot be built or stepped.
    #[error(transparent)]
    Mechanics(#[from] lariat_ancf::Error),
}
