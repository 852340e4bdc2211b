//! What a study returns.

use super::target::Quantity;
use serde::{Deserialize, Serialize};

/// How a study ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The error is proven.
    Proven,
    /// Refining does not bring the runs together: a chaotic motion, or several equilibria; or a
    /// finer run [failed](Claim::failed).
    NoConvergence,
    /// The limit of elements was reached before the error, or refining helps so slowly that it
    /// would be.
    ElementLimit,
}

/// What is claimed about the last run of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Claim {
    /// Error of positions that was asked for in m; `None` if it is one of [forces](Self::forces).
    pub asked_m: Option<f64>,
    /// Bound of the error of all recorded positions at all recorded times in m; `None` if none is
    /// proven.
    pub claimed_m: Option<f64>,
    /// Estimate of the error of the mesh in m; `None` if the last meshes could not be compared.
    pub mesh_m: Option<f64>,
    /// Estimate of the error in time in m; 0 for an equilibrium, `None` for one of
    /// [forces](Self::forces).
    pub time_m: Option<f64>,
    /// What is claimed about tensions or moments, if they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<ForceClaim>,
    /// How the study ended.
    pub outcome: Outcome,
    /// If no error is proven for the whole motion: first recorded time in s at which the asked one
    /// is not proven.
    pub horizon_s: Option<f64>,
    /// True if the last two runs are apart by more than a tenth of the longest cable: they follow
    /// different branches.
    pub other_branch: bool,
    /// True if the steps are limited by the host step rather than the tolerance, so that runs at
    /// two tolerances cannot judge the error in time: a run in shorter equal steps does.
    pub host_step_limits: bool,
    /// True if runs with shorter steps did not come closer.
    #[serde(default)]
    pub steps_apart: bool,
    /// Elements of the cable that has most, in the last run.
    pub elements: usize,
    /// If the limit of elements ended the study: how many that cable would need about, by the order
    /// that the last runs show; `None` if they show none, and for runs that part later than in the
    /// first tenth of the motion.
    #[serde(default)]
    pub elements_needed: Option<usize>,
    /// Error of position per host step of the last run in m; `None` for an equilibrium.
    pub tolerance_m: Option<f64>,
    /// Number of equal parts into which the last run divided each host step, more than 1 in a
    /// [coupled](super::Study::coupled) study alone; the tolerance is that of a part.
    #[serde(default = "one")]
    pub parts: u32,
    /// The run whose failure ended the study before its error was proven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<FailedRun>,
    /// Number of runs.
    pub runs: usize,
    /// Elements evaluated in all runs over those in the last.
    pub cost: f64,
}

/// What is claimed about tensions or moments, at the nodes that are held, loaded or ends, and about
/// the largest along each cable, at all recorded times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ForceClaim {
    /// Of what.
    pub quantity: Quantity,
    /// Whether errors are shares of the largest value of the same cable in the run; else they are
    /// in N or N m.
    pub relative: bool,
    /// Error that was asked for.
    pub asked: f64,
    /// Bound of the error; `None` if none is proven.
    pub claimed: Option<f64>,
    /// Estimate of the error of the mesh; `None` if the last meshes could not be compared.
    pub mesh: Option<f64>,
    /// Estimate of the error in time; 0 for an equilibrium.
    pub time: f64,
}

/// A run of a study that failed, where others did not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct FailedRun {
    /// Elements of the cable that has most.
    pub elements: usize,
    /// Error of position per host step in m; `None` for an equilibrium, and for equal steps.
    pub tolerance_m: Option<f64>,
    /// Number of equal parts of a host step.
    pub parts: u32,
}

fn one() -> u32 {
    1
}

/// The last run of a study, and what is claimed about it.
#[derive(Clone, Debug)]
pub struct Proof<W> {
    /// What the program returned for it.
    pub world: W,
    /// What is claimed about it.
    pub claim: Claim,
}

/// Why a study has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError<E> {
    /// An error that cannot be asked for.
    #[error("error {value}; accepted: a finite number > 0")]
    InvalidError {
        /// The value in m, N, N m or as a share.
        value: f64,
    },
    /// Duration and host step that give no number of host steps.
    #[error("{steps} host steps of {host_step} s; accepted: finite numbers > 0")]
    InvalidSpan {
        /// Duration over host step.
        steps: f64,
        /// Host step in s.
        host_step: f64,
    },
    /// A run failed, and no other worked.
    #[error("run with {elements} elements{}: {source}", at(*.tolerance))]
    Run {
        /// Elements of the cable that has most.
        elements: usize,
        /// Tolerance in m.
        tolerance: Option<f64>,
        /// Why.
        source: E,
    },
    /// A run that recorded no position.
    #[error("the run recorded no position: call Record::frame and Record::cable or Record::point at host times")]
    NothingRecorded,
    /// Two runs recorded different times.
    #[error(
        "a run recorded the time {time} s where another recorded {other} s: record the same host times in all runs"
    )]
    DifferentTimes {
        /// Time in s.
        time: f64,
        /// Time of the other run in s.
        other: f64,
    },
}

fn at(tolerance: Option<f64>) -> String {
    tolerance.map_or(String::new(), |tolerance| format!(" and tolerance {tolerance:.2e} m"))
}
