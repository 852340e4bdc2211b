//! Cables as components of bevy_ecs.

mod attachments;
mod breaking;
mod cables;
mod churn;
mod clock;
mod common;
mod contact;
mod effects;
mod events;
mod junctions;
mod lifecycle;
mod mesh;
mod mistakes;
mod order;
mod pendulum;
mod plugin;
mod saved;
mod scene;
mod snapshots;
mod water;
mod wheels;
