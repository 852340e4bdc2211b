//! Scene files, headless runs and reports for Lariat cables.
//!
//! | module | what it holds |
//! |---|---|
//! | [`scene`] | scene files: TOML in, a checked scene out |
//! | [`run`] | headless runs: probes to CSV, a summary as JSON |
//! | [`view`] | the run as a page that moves |
//! | [`pendulum`] | the falling pendulum and its reference |
//! | [`table1`] | the paper's Table 1, measured |
//! | [`figures`] | SVG plots |
//! | [`report`] | accuracy against cost: `lariat report` |
//! | [`stability`] | hard cases |
//!
//! The library prints nothing; the `lariat` command does.

mod error;
pub mod figures;
pub mod machine;
pub mod pendulum;
mod physics;
pub mod report;
pub mod run;
pub mod scene;
pub mod stability;
pub mod table1;
pub mod view;

pub use error::{Error, Place};
pub use scene::{Purpose, Scene};
