//! Test worlds, cases and Rapier's own ropes over rapier3d, in single precision.
#![allow(clippy::duplicate_mod, reason = "the same source over rapier3d and rapier3d-f64")]

use lariat_rapier as engine;

#[path = "stability/cases/mod.rs"]
pub mod cases;
#[path = "convert.rs"]
pub mod convert;
#[path = "peers.rs"]
pub mod peers;
#[path = "stability/world/mod.rs"]
pub mod world;
