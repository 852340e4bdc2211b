//! The guarded discrete gradient.

mod angular;
mod chain;
#[path = "../common/mod.rs"]
mod common;
mod law;
mod motion;
mod preset;
mod recipe;
mod thrown;
mod verdicts;
