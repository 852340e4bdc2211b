//! Errors of a measurement.

use std::path::PathBuf;

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A folder or file cannot be made or written.
    #[error("cannot write to {}: {source}", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A README has no place for the table of a report.
    #[error("{}: expected {expected}", path.display())]
    NoMark {
        /// The README.
        path: PathBuf,
        /// The marks.
        expected: String,
    },
    /// A pool of threads cannot be started.
    #[error("cannot start threads: {0}")]
    Threads(String),
    /// Sections of a report failed; the others are written.
    #[error("these sections failed, the others are written: {}", titles.join("; "))]
    Sections {
        /// Their titles, each with its error.
        titles: Vec<String>,
    },
    /// A figure cannot be drawn.
    #[error(transparent)]
    Figure(#[from] lariat_figures::Error),
    /// A scene cannot be read or run.
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
            Error::Output { .. } | Error::Read { .. } | Error::NoMark { .. } => 2,
            Error::Scene(error) => error.exit_code(),
            Error::Threads(_)
            | Error::Sections { .. }
            | Error::Figure(_)
            | Error::Mechanics(_)
            | Error::Coupling(_) => 3,
        }
    }
}
