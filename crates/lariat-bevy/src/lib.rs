//! ANCF cables on rapier3d's bodies as components of bevy_ecs.
//!
//! A cable is an entity, an effect is a component, an attachment is an entity with relationships to its cable and its body.
//!
//! ```
//! use bevy_ecs::prelude::*;
//! use lariat_bevy::rapier::prelude::ColliderBuilder;
//! use lariat_bevy::{At, Attachment, AttachmentReading, Bending, Body, BodyPose, Cable, Damping};
//!
//! let mut world = World::new();
//! lariat_bevy::install(&mut world);
//! let crate_ = world.spawn(Body::dynamic().at([0.0, -2.1, 0.0]).with(ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0))).id();
//! let rope = world.spawn((
//!     Cable::steel_rope(0.006).between([0.0, 0.0, 0.0], [0.0, -2.0, 0.0]),
//!     Bending,
//!     Damping::critical_fraction(0.2),
//! ));
//! let rope = rope.id();
//! world.spawn(Attachment::ball(rope, At::Start).to_world());
//! let hook = world.spawn(Attachment::ball(rope, At::End).to(crate_).at([0.0, 0.1, 0.0])).id();
//! for _ in 0..480 {
//!     lariat_bevy::advance(&mut world, 1.0 / 60.0); // s
//! }
//! let pull = world.get::<AttachmentReading>(hook).unwrap().force.y;
//! assert!((pull - 50.0 * 9.81).abs() < 5.0, "{pull} N"); // the crate hangs
//! assert!((world.get::<BodyPose>(crate_).unwrap().position.y + 2.1).abs() < 1e-3);
//! ```
//!
//! | to | look at |
//! |---|---|
//! | make a cable | [`Cable`], [`Rule`], and the effects [`Bending`], [`Damping`], [`Drag`], [`Buoyancy`], [`RestShape`], [`LineLoads`], [`PointLoads`], [`GravityScale`] |
//! | hold it | [`Attachment`], [`OnCable`], [`ToBody`], [`BreakForce`], [`BreakTension`]; read [`AttachmentReading`] |
//! | make bodies | [`Body`], [`KinematicTarget`]; read [`BodyPose`], [`Bodies`] |
//! | step | [`advance`], or [`CableStep`] in a schedule of your own; with feature `bevy_app` the plugin |
//! | put systems between | [`CableSystems`] |
//! | be told | [`event`] |
//! | draw | [`Cable::curve`], [`Interpolate`] |
//! | know the cost | [`Diagnostics`] |
//! | roll back | [`Snapshot`] |
//!
//! Features: `bevy_app` (a plugin), `reflect` (effects register with bevy_reflect).
//!
//! *Determinism.* Systems that step run one after the other, cables in an order that does not depend on that of spawning, so neither the
//! number of threads nor the order of spawning within a frame changes a bit.
//!
//! *Limits.* The cable of a disabled entity goes on. `Entity` numbers do not survive a [`Snapshot`] that brings despawned entities back. A refused step stops the whole world,
//! not only the cables that it concerns.

mod attachment;
mod body;
mod breaking;
mod cable;
mod clock;
mod diagnostics;
mod effects;
mod error;
pub mod event;
mod interpolate;
mod plan;
#[cfg(feature = "bevy_app")]
mod plugin;
mod point;
mod prepare;
mod publish;
mod schedule;
mod snapshot;
mod step;
mod world;

pub use attachment::{
    Attachment, AttachmentDraft, AttachmentReading, BodyAttachments, BreakForce, CableAttachments, OnCable, ToBody,
    ToBodyBundle, ToWorldBundle,
};
pub use body::{Bodies, Body, BodyHandle, BodyPose, KinematicTarget};
pub use breaking::BreakTension;
pub use cable::{Cable, CableSample};
pub use clock::{FixedClock, advance};
pub use diagnostics::{Diagnostics, Times};
pub use effects::{Bending, Buoyancy, Damping, Drag, GravityScale, LineLoads, PointLoads, RestShape, Rule};
pub use error::Error;
pub use interpolate::Interpolate;
pub use lariat_ancf::{self, At};
pub use lariat_rapier::{self, AttachmentKind, Settings, rapier};
#[cfg(feature = "bevy_app")]
pub use plugin::{LariatPlugin, install_in};
pub use point::Point;
pub use schedule::{AfterEngine, BeforeEngine, CableStep, CableSystems, RapierStep, install};
pub use snapshot::Snapshot;
pub use world::{Cables, Physics};
