//! Contact and friction with obstacles.

#[path = "../common/mod.rs"]
mod common;
mod bench;
mod capstan;
mod energy;
mod features;
mod floor;
mod state;
mod wall;
