//! Cables and rapier3d's bodies: against statics, a monolithic code, conservation laws, and what a user may do to a world.

mod bench;
mod changes;
mod clamps;
mod contact;
mod draw;
mod hanging;
mod hoist;
mod joints;
mod many;
mod motion;
mod nodes;
mod payload;
mod replay;
mod sleep;
mod spinning;
mod split;
