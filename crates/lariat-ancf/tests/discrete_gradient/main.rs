//! The guarded discrete gradient.

#[path = "../common/mod.rs"]
mod common;
mod chain;
mod law;
mod motion;
mod recipe;
mod thrown;
