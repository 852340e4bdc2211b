//! The errors between a scene file and its results.

use lariat_ancf::warning::Interface;
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

/// Why a value of a scene is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// A key that the format does not have.
    #[error("unknown key `{0}`")]
    UnknownKey(String),
    /// A key that must be given.
    #[error("missing key `{0}`")]
    MissingKey(String),
    /// None of these keys is given.
    #[error("none of {} is given", coded(.0))]
    NoneGiven(&'static [&'static str]),
    /// These keys exclude each other.
    #[error("{} are given together", coded(.0))]
    TooManyGiven(Vec<&'static str>),
    /// A value of another type.
    #[error("found {0}")]
    WrongType(String),
    /// A number outside its range.
    #[error("{} is out of range", number(*.0))]
    OutOfRange(f64),
    /// A number that is too large or too small for the single precision of Rapier.
    #[error("{} is beyond the single precision of Rapier", number(*.0))]
    BeyondSingle(f64),
    /// Numbers that are infinite or not a number.
    #[error("{} not finite", not_finite(.0))]
    NotFinite(Vec<f64>),
    /// Too few rows.
    #[error("too few rows: {0}")]
    TooFewRows(usize),
    /// Rows whose first number does not ascend.
    #[error("{name} = {after} follows {name} = {before}")]
    NotAscending {
        /// Name of the first number.
        name: &'static str,
        /// The number in one row.
        before: f64,
        /// The number in the next row.
        after: f64,
    },
    /// A text that is not one of those accepted.
    #[error("unknown value {0:?}")]
    UnknownValue(String),
    /// A text that a parser does not understand; why not.
    #[error("{0}")]
    NotUnderstood(String),
    /// A name that cannot be given to anything.
    #[error("{0:?} cannot be a name")]
    ReservedName(String),
    /// A name that another has.
    #[error("{0:?} is taken")]
    NameTaken(String),
    /// A name that nothing in the scene has.
    #[error("no {what} is named {name:?}")]
    UnknownName {
        /// What was looked for.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A value that does not agree with the rest of the scene.
    #[error("{0}")]
    Conflict(String),
}

/// A value of a scene that is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {key}: {problem}; accepted: {accepted}{}", did_you_mean(.suggestion.as_deref()))]
#[non_exhaustive]
pub struct SceneError {
    /// Where it was written.
    pub place: Place,
    /// Dotted path of the key, with tables of an array by their name.
    pub key: String,
    /// Why it is not accepted.
    pub problem: Problem,
    /// What is accepted there.
    pub accepted: String,
    /// The known name that is nearest to an unknown one.
    pub suggestion: Option<String>,
}

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value of a scene that is not accepted.
    #[error(transparent)]
    Scene(Box<SceneError>),
    /// A file that is not TOML.
    #[error("{place}: not TOML: {problem}")]
    Syntax {
        /// Where.
        place: Place,
        /// What the parser says.
        problem: String,
    },
    /// An override that is not a path into the scene.
    #[error("--set {argument}: {problem}")]
    Override {
        /// The argument as given.
        argument: String,
        /// What is wrong, and what is accepted.
        problem: String,
    },
    /// A key that the format does not have, asked for by name.
    #[error("no key is named {key:?}; accepted: {accepted}{}", did_you_mean(.suggestion.as_deref()))]
    NoSuchKey {
        /// The key.
        key: String,
        /// The keys of the table.
        accepted: String,
        /// The nearest of them.
        suggestion: Option<String>,
    },
    /// A model of another program that cannot be imported right.
    #[error("{file}{}: {problem}", if *line > 0 { format!(":{line}") } else { String::new() })]
    Import {
        /// The name of the file.
        file: String,
        /// The line, from 1; 0 if it is not known.
        line: u32,
        /// What is wrong, and what is read.
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
    /// A state that a run cannot start from.
    #[error("a run cannot start from this state: {problem}")]
    State {
        /// Why.
        problem: String,
    },
    /// A cable that the scene cuts at a time, in a world that another program steps.
    #[error(
        "cable {cable:?} is cut at a time, which is for the program that steps the world: leave the cut out of the scene"
    )]
    TimedCut {
        /// Name of the cable.
        cable: String,
    },
    /// A mesh that statics are to choose, of a scene without equilibrium.
    #[error(
        "cable {cable:?}: finest = \"auto\" begins with the equilibrium of the scene, and there is none: {source}; give finest a length"
    )]
    NoChosenMesh {
        /// Name of the cable.
        cable: String,
        /// Why there is none.
        #[source]
        source: Box<Error>,
    },
    /// A folder or file that cannot be created before the run begins.
    #[error("cannot write to {}: {source}", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A scene that would need more memory or disk than anybody means.
    #[error("the scene is too large: {problem}; accepted: {accepted}")]
    TooLarge {
        /// What is too large, and how large.
        problem: String,
        /// What is accepted.
        accepted: String,
    },
    /// A folder that another run writes to.
    #[error("{} belongs to a run that has not ended ({holder}): wait for it, or give another folder", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
        /// Process and start of that run.
        holder: String,
    },
    /// A file that Lariat did not write, or that was changed since, and that would be overwritten.
    #[error(
        "{} is not the result of an earlier run, or was changed since, and would be overwritten: move it, or give another name",
        path.display()
    )]
    InTheWay {
        /// The file.
        path: PathBuf,
    },
    /// A file that could not be written to its end (a full disk); what was written before stays.
    #[error("at t = {time} s: cannot write {}: {source}; earlier samples are kept", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Simulated time in s.
        time: f64,
        /// Why.
        source: io::Error,
    },
    /// An error that was asked for and cannot be proven.
    #[error(
        "--error {error}: accepted: a finite number of at least {least:.1e} {unit}, which {reason} allows in this scene"
    )]
    ErrorTooSmall {
        /// What was asked for.
        error: String,
        /// Least error.
        least: f64,
        /// Its unit.
        unit: &'static str,
        /// What allows no less.
        reason: &'static str,
    },
    /// A moment of cables that have none.
    #[error(
        "--error {error}: no cable has bending stiffness, so that none carries a moment: ask for positions, or for tension"
    )]
    NoMoment {
        /// What was asked for.
        error: String,
    },
    /// Runs that cannot be compared.
    #[error("--error {error}: {problem}")]
    Study {
        /// What was asked for.
        error: String,
        /// Why.
        problem: String,
    },
    /// A failed step, or a cable without equilibrium. Names the cable and the time.
    #[error("{}{}", moment(source, *time), Interface::Scene.text(source))]
    Mechanics {
        /// Simulated time of the last good state in s.
        time: f64,
        /// Why.
        #[source]
        source: lariat_ancf::Error,
    },
    /// A rigid body whose motion cannot be computed.
    #[error("at t = {time} s: body {body:?}: {problem}")]
    Body {
        /// Simulated time in s.
        time: f64,
        /// Name of the body.
        body: String,
        /// Why.
        problem: String,
    },
    /// An error of the coupling between cables and bodies.
    #[error("at t = {time} s: {}", Interface::Scene.text(source))]
    Coupling {
        /// Simulated time in s.
        time: f64,
        /// Why.
        #[source]
        source: lariat_rapier::Error,
    },
    /// The run was interrupted; every sample so far is on disk.
    #[error("interrupted at t = {time} s; the samples so far are kept")]
    Interrupted {
        /// Simulated time in s.
        time: f64,
    },
}

impl Error {
    /// Returns the exit code of the `lariat` command: 2 for bad input (nothing is written), 3 for a failed run, 130 for an
    /// interrupted one.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Scene(_)
            | Error::Syntax { .. }
            | Error::Override { .. }
            | Error::NoSuchKey { .. }
            | Error::Import { .. }
            | Error::Read { .. }
            | Error::ErrorTooSmall { .. }
            | Error::NoMoment { .. }
            | Error::TooLarge { .. }
            | Error::Busy { .. }
            | Error::InTheWay { .. }
            | Error::State { .. }
            | Error::TimedCut { .. }
            | Error::Output { .. } => 2,
            Error::Study { .. }
            | Error::Write { .. }
            | Error::Mechanics { .. }
            | Error::NoChosenMesh { .. }
            | Error::Body { .. }
            | Error::Coupling { .. } => 3,
            Error::Interrupted { .. } => 130,
        }
    }

    /// Returns an error of the mechanics at a time in s, unless it names its own.
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

/// Returns the time, where the mechanics does not name it itself.
fn moment(source: &lariat_ancf::Error, time: f64) -> String {
    match source {
        lariat_ancf::Error::StepFailed { .. } => String::new(),
        _ => format!("at t = {time} s: "),
    }
}

/// Returns the question that ends a message about an unknown name.
pub(crate) fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or(String::new(), |name| format!(". Did you mean {name:?}?"))
}

fn coded(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Returns a number as text, very large and very small ones with an exponent.
fn number(x: f64) -> String {
    let plain = x == 0.0 || (1e-6..1e9).contains(&x.abs());
    if plain { format!("{x}") } else { format!("{x:e}") }
}

fn not_finite(numbers: &[f64]) -> String {
    match numbers {
        [x] => format!("{x} is"),
        _ => format!("{numbers:?} is"),
    }
}
