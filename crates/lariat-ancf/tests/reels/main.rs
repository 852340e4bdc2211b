//! Reels at the ends of a cable.

mod both_ends;
mod common;
mod drums;
mod energy;
mod laws;
mod motion;
mod on_bodies;
mod remesh;
mod sheaves;
mod state;
