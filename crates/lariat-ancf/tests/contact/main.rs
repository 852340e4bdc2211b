//! Contact and friction with obstacles.

mod bench;
mod blows;
mod bodies;
mod capstan;
#[path = "../common/mod.rs"]
mod common;
mod cost;
mod energy;
mod features;
mod first_touch;
mod floor;
mod hooks;
mod pairs;
mod passed;
mod plastic;
mod reactions;
mod restitution;
mod search;
mod slides;
mod state;
mod statics;
mod told;
mod wall;
