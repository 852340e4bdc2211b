//! Test worlds, cases and Rapier's own ropes over rapier3d-f64: the same source as
//! [`single`](crate::single).
#![allow(clippy::duplicate_mod, reason = "the same source over rapier3d and rapier3d-f64")]
#![allow(
    clippy::unnecessary_cast,
    clippy::useless_conversion,
    reason = "conversions between Real and f64, here the same"
)]

use lariat_rapier_f64 as engine;

#[path = "stability/cases/mod.rs"]
pub mod cases;
#[path = "convert.rs"]
pub mod convert;
#[path = "peers.rs"]
pub mod peers;
#[path = "stability/world/mod.rs"]
pub mod world;
