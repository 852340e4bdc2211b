//! Cables as components of bevy_ecs.

mod attachments;
mod bench;
mod cables;
mod changes;
mod clock;
mod effects;
mod events;
mod order;
mod pendulum;
mod plugin;
mod snapshots;
