//! Scene files and headless runs of Lariat cables.
//!
//! | module | what it holds |
//! |---|---|
//! | [`schema`] | the scene format as data: each key with its unit, range, default and meaning |
//! | [`document`] | a scene file as a tree of values that know where they were written |
//! | [`scene`] | the tables of a scene, checked into a [`Scene`] |
//! | [`run`] | headless runs: probes to CSV, a summary as JSON |
//! | [`view`] | the run as an animated page |
//! | [`mjcf`] | cables of MuJoCo models, as a scene |
//! | [`sweep`] | runs of a scene over a grid of values, on all threads |
//! | [`folder`], [`signed`] | files, written so that nobody's file is lost |
//! | [`command`] | the `lariat` command |
//!
//! Modules use those above them; `physics`, the Rapier side of a run, is between [`scene`] and [`run`]. The library prints
//! nothing; [`command`] does.

pub mod command;
pub mod document;
mod error;
pub mod folder;
pub mod mjcf;
mod physics;
mod read;
pub mod run;
pub mod scene;
#[macro_use]
pub mod schema;
pub mod signed;
mod suggest;
pub mod sweep;
mod text;
pub mod view;
mod warning;

pub use error::{Error, Place, Problem, SceneError};
pub use scene::{Purpose, Scene};
pub use text::read_text;
pub use warning::Warning;
