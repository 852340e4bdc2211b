//! Scene files and headless runs of Lariat cables.
//!
//! | module | what it holds |
//! |---|---|
//! | [`scene`] | scene files: TOML in, a checked scene out |
//! | [`run`] | headless runs: probes to CSV, a summary as JSON |
//! | [`view`] | the run as a page that moves |
//!
//! The library prints nothing; the `lariat` command does.

mod error;
mod physics;
pub mod run;
pub mod scene;
pub mod view;

pub use error::{Error, Place};
pub use scene::{Purpose, Scene};
