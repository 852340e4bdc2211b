//! Reels at the ends of a cable.

mod asked;
mod both_ends;
mod common;
mod drums;
mod effects;
mod energy;
mod fluid;
mod laws;
mod motion;
mod on_bodies;
#[path = "../common/mod.rs"]
mod random;
mod remesh;
mod sheaves;
mod slack;
mod state;
mod touch;
mod weakened;
