//! The guarded discrete gradient.

#[path = "../common/mod.rs"]
mod common;
mod recipe;
mod thrown;
