//! Everything that can go wrong between a scene file and its results, as one enum.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// Where a value of a scene was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of the scene file.
    Line {
        /// The file as it was named.
        file: String,
        /// Line number, from 1.
        line: usize,
    },
    /// An override given on the command line, `KEY=VALUE`.
    Override(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line { file, line } => write!(f, "{file}:{line}"),
            Place::Override(argument) => write!(f, "--set {argument}"),
        }
    }
}

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene that does not say what it must, or says what it must not.
    #[error("{place}: {key}: {problem}; accepted: {accepted}")]
    Scene {
        /// Where.
        place: Place,
        /// Dotted path of the key, tables of an array by their name.
        key: String,
        /// What is wrong, with the value.
        problem: String,
        /// What is accepted there.
        accepted: String,
    },
    /// A part of the scene format that this version does not compute.
    #[error("{place}: {key}: {what} is not built yet; take it out of the scene (nothing is ignored silently)")]
    NotBuilt {
        /// Where.
        place: Place,
        /// Dotted path of the key.
        key: String,
        /// What was asked for.
        what: String,
    },
    /// A file that is not TOML.
    #[error("{place}: not TOML: {problem}")]
    Syntax {
        /// Where.
        place: Place,
        /// What the parser says.
        problem: String,
    },
    /// An override that names no place in the scene.
    #[error("--set {argument}: {problem}")]
    Override {
        /// The argument as given.
        argument: String,
        /// What is wrong, and what is accepted.
        problem: String,
    },
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A folder or file that cannot be made or written before the run begins.
    #[error("cannot write to {}: {source}", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file that could not be written to its end (a full disk); what was written stays.
    #[error("at t = {time} s: cannot write {}: {source}; samples before it are kept", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Simulated time in s.
        time: f64,
        /// Why.
        source: io::Error,
    },
    /// The mechanics refused: a step that cannot be done, no equilibrium. Names the cable and the time.
    #[error("{}{source}", moment(source, *time))]
    Mechanics {
        /// Simulated time of the last good state in s.
        time: f64,
        /// Why.
        #[source]
        source: lariat_ancf::Error,
    },
    /// A rigid body that cannot go on.
    #[error("at t = {time} s: body {body:?}: {problem}")]
    Body {
        /// Simulated time in s.
        time: f64,
        /// Name of the body.
        body: String,
        /// Why.
        problem: String,
    },
    /// The coupling of cables and bodies refused.
    #[error("at t = {time} s: {source}")]
    Coupling {
        /// Simulated time in s.
        time: f64,
        /// Why.
        #[source]
        source: lariat_rapier::Error,
    },
    /// The run was interrupted; every sample so far is on disk.
    #[error("interrupted at t = {time} s; samples so far are kept")]
    Interrupted {
        /// Simulated time in s.
        time: f64,
    },
    /// A figure that could not be drawn.
    #[error("cannot draw {}: {reason}", path.display())]
    Figure {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
}

impl Error {
    /// Exit code of the `lariat` command: 2 for bad input (nothing written), 3 for a failed run, 130 for an interrupted one.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Scene { .. }
            | Error::NotBuilt { .. }
            | Error::Syntax { .. }
            | Error::Override { .. }
            | Error::Read { .. }
            | Error::Output { .. } => 2,
            Error::Write { .. }
            | Error::Mechanics { .. }
            | Error::Body { .. }
            | Error::Coupling { .. }
            | Error::Figure { .. } => 3,
            Error::Interrupted { .. } => 130,
        }
    }
}

impl Error {
    /// A refusal of the mechanics at a time in s, unless it names its own.
    pub(crate) fn mechanics(time: f64, source: lariat_ancf::Error) -> Self {
        let time = match &source {
            lariat_ancf::Error::StepFailed { time, .. } => *time,
            _ => time,
        };
        Error::Mechanics { time, source }
    }
}

impl From<lariat_ancf::Error> for Error {
    fn from(source: lariat_ancf::Error) -> Self {
        Error::mechanics(0.0, source)
    }
}

/// The time, where the mechanics does not name it itself.
fn moment(source: &lariat_ancf::Error, time: f64) -> String {
    match source {
        lariat_ancf::Error::StepFailed { .. } => String::new(),
        _ => format!("at t = {time} s: "),
    }
}
