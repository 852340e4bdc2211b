//! Cables on Rapier's bodies: statics, a monolithic code, conservation laws, and changes by the
//! user.

mod assemblies;
mod attachment_points;
mod blows;
mod cable_contact;
mod cable_contact_bodies;
mod clamps;
mod common;
mod contact;
mod determinism;
mod draw;
mod free_flight;
mod hoist;
mod joints;
mod moving_ends;
mod payload;
mod prescribed_motion;
mod reels;
mod refused;
mod ropes;
mod sleep;
mod statics;
mod substepping;
mod user_changes;
mod warnings;
mod worlds;
