//! The guarded discrete gradient.

mod chain;
#[path = "../common/mod.rs"]
mod common;
mod law;
mod motion;
mod preset;
mod recipe;
mod thrown;
