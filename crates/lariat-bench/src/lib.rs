//! Measurements of Lariat: accuracy against cost, hard cases, the cost of the coupling, the paper's
//! Table 1.
//!
//! | module | what it holds |
//! |---|---|
//! | [`report`] | accuracy against cost: `lariat report` |
//! | [`stability`] | hard cases: `lariat stability` |
//! | [`matrix`] | every pair of features: `lariat matrix` |
//! | [`coupling`] | the cost of a cable on a body: `lariat coupling` |
//! | [`table1`] | the paper's Table 1, measured: `lariat table1` |
//! | `single`, `double` | the worlds of the hard cases and Rapier's own ropes, over rapier3d and rapier3d-f64 |
//! | [`misses`] | runs that miss a bound, compared with those that are known to |
//! | [`table`], [`page`] | tables and pages as Markdown and CSV |
//! | [`clock`], [`machine`], [`numbers`] | CPU time of repeated runs, the machine, extremes and formats |
//!
//! This crate is part of the workspace and is not published.

pub mod clock;
pub mod coupling;
mod double;
mod error;
pub mod machine;
pub mod matrix;
pub mod misses;
pub mod numbers;
pub mod page;
pub mod report;
mod single;
pub mod stability;
pub mod table;
pub mod table1;

pub use error::Error;
