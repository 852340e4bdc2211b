//! Cables as components of bevy_ecs.

mod attachments;
mod bench;
mod breaking;
mod cables;
mod changes;
mod clock;
mod comings;
mod effects;
mod events;
mod order;
mod pendulum;
mod plugin;
mod snapshots;
