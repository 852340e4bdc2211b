//! Cables and rapier3d's bodies: against statics, a monolithic code, conservation laws, and what a user may do to a world.

mod bench;
mod changes;
mod contact;
mod hanging;
mod hoist;
mod motion;
mod payload;
mod replay;
mod spinning;
