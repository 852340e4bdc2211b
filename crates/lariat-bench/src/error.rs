//! Why a measurement could not be made.

use std::path::PathBuf;

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A folder or file that cannot be made or written.
    #[error("cannot write to {}: {source}", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A figure could not be drawn.
    #[error(transparent)]
    Figure(#[from] lariat_figures::Error),
    /// A scene could not be read or run.
    #[error(transparent)]
    Scene(#[from] lariat_scene::Error),
    /// The mechanics returned an error.
    #[error(transparent)]
    Mechanics(#[from] lariat_ancf::Error),
    /// The coupling returned an error.
    #[error(transparent)]
    Coupling(#[from] lariat_rapier::Error),
}

impl Error {
    /// Returns the exit code of the command: 2 for bad input, 3 for a failed measurement.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Output { .. } | Error::Read { .. } => 2,
            Error::Scene(error) => error.exit_code(),
            Error::Figure(_) | Error::Mechanics(_) | Error::Coupling(_) => 3,
        }
    }
}
