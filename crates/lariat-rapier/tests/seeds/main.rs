//! Random scenes of a few families, against their equations or against themselves in fine steps: each is right, or a warning or an error
//! names what is wrong with it.
//!
//! The seeds of a test are fixed. `LARIAT_SEEDS=1000..1400` runs others, and prints each.

mod blows;
mod booms;
mod bridges;
mod common;
mod contacts;
mod pendulums;
mod rotors;
mod winches;
mod worlds;
