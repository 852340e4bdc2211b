//! Stage and cases on rapier3d.
#![allow(clippy::duplicate_mod, reason = "the same source over rapier3d and rapier3d-f64")]

use lariat_rapier as engine;

#[path = "cases/mod.rs"]
pub mod cases;
#[path = "stage/mod.rs"]
pub mod stage;

/// Does a run.
pub fn play(job: super::Job) -> super::outcome::Row {
    let cases = cases::of(job.family);
    debug_assert!(cases[job.case].applies(&job.host, job.make));
    stage::play(&cases[job.case], job.host, job.make)
}
