//! ANCF cables on rapier3d's bodies, as components of bevy_ecs.
//!
//! A cable is an entity, an effect is a component, and an attachment is an entity with
//! relationships to its cable and its body. The resource [`Cables`] holds the state of all cables.
//!
//! ```
//! use bevy_ecs::prelude::*;
//! use lariat_bevy::rapier::prelude::ColliderBuilder;
//! use lariat_bevy::{At, Attachment, AttachmentReading, Bending, Body, BodyPose, Cable};
//! use lariat_bevy::{Cables, Damping};
//!
//! let mut world = World::new();
//! lariat_bevy::install(&mut world);
//! let cube = ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0);
//! let crate_ = world.spawn(Body::dynamic().at([0.0, -2.1, 0.0]).with(cube)).id();
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
//! let weight = 50.0 * 9.81; // N
//! let pull = world.get::<AttachmentReading>(hook).unwrap().force.y;
//! assert!((pull - weight).abs() < 5.0, "{pull} N");
//! let tension = world.resource::<Cables>().get(rope)?.sample(1.0)?.tension;
//! assert!((tension - weight).abs() < 5.0, "{tension} N");
//! assert!((world.get::<BodyPose>(crate_).unwrap().position.y + 2.1).abs() < 1e-3);
//! # Ok::<(), lariat_bevy::Error>(())
//! ```
//!
//! | to | see |
//! |---|---|
//! | describe a cable | [`Cable`], [`Rule`], and the effects [`Bending`], [`Damping`], [`Drag`], [`Buoyancy`], [`RestShape`], [`LineLoads`], [`PointLoads`], [`GravityScale`] |
//! | read or change its state | [`Cables`] |
//! | attach it | [`Attachment`], [`OnCable`], [`ToBody`], [`AttachmentReading`] |
//! | spawn the usual rope in one line | [`SpawnRope::spawn_rope`], [`Rope`] |
//! | tie cables to each other, let one kink | [`Junction`], [`KinkAlong`] |
//! | pay it out, take it in | [`Reel`], [`ReelAtStart`] |
//! | wind it on a body that turns, run it over a wheel into another | [`Drum`], [`Sheave`], [`SheaveAlong`] |
//! | bound the work of a host step | [`Budget`] in [`Settings`], [`CableDegraded`](event::CableDegraded) |
//! | let it break, cut it | [`BreakForce`], [`BreakTension`], [`BreakStrain`], [`Cables::cut`] |
//! | let bodies float, sink, ride on waves | [`Sea`], [`InWater`] |
//! | make bodies | [`Body`], [`KinematicTarget`], [`BodyPose`], [`Bodies`] |
//! | step | [`advance`], or [`CableStep`] in a schedule of your own; with feature `bevy_app` the plugin |
//! | order systems against the stages of a step | [`CableSystems`] |
//! | react to events | [`event`] |
//! | hear where meshes, steps, laws and sizes are not good enough | [`CableWarning`](event::CableWarning) |
//! | draw | [`RopeMesh`], whose triangles are [`RopeVertices`]; [`curve()`], [`Interpolate`] |
//! | measure the cost | [`Diagnostics`] |
//! | roll back | [`Snapshot`] |
//! | save to a file and load | [`Snapshot::to_bytes`], [`Snapshot::from_bytes`], or serde |
//!
//! Features: `bevy_app` (a plugin), `reflect` (components of effects register with bevy_reflect).
//!
//! # Determinism
//!
//! The systems of a step run one after the other, and the order of cables in it does not depend on
//! the order of spawning. Neither the number of threads nor the order of spawning within a frame
//! changes a bit of the result.
//!
//! # Limits
//!
//! - Cables touch bodies if they have [`Contact`], and each other with [`Contact::with_cables`]. The unstretched length of a cable changes by
//!   breaking and cutting, and by a [`Reel`], a [`Drum`] or a [`Sheave`].
//! - A cable that cannot step stands still with all that is attached to it until the cause is
//!   removed: see [`StepFailed`](event::StepFailed).
//! - On the bodies of another plugin ([`BeforeEngine`], [`AfterEngine`]; crate
//!   `lariat-bevy-rapier`) a host step is one Rapier step, so that taut cables on light bodies in
//!   contact need a short one.
//! - The cable of a disabled entity is stepped like any other.
//! - Restoring a [`Snapshot`] spawns despawned entities again under new numbers, and all of them in another world.

mod attachment;
mod body;
mod breaking;
mod cable;
mod cables;
mod clock;
mod components;
mod description;
mod diagnostics;
mod drum;
mod effects;
mod error;
pub mod event;
mod install;
mod interpolate;
mod junction;
mod kink;
mod links;
mod mesh;
mod passing;
mod pending;
mod physics;
#[cfg(feature = "bevy_app")]
mod plugin;
mod prepare;
mod publish;
mod reel;
mod rigid;
mod rope;
mod saved;
mod schedule;
mod sheave;
mod snapshot;
mod step;
mod strength;
mod water;

pub use attachment::{
    Attachment, AttachmentDraft, AttachmentReading, BodyAttachments, BreakForce, CableAttachments, OnCable, ToBody,
    ToBodyBundle, ToWorldBundle,
};
pub use body::{Bodies, Body, BodyHandle, BodyPose, KinematicTarget};
pub use cable::Cable;
pub use cables::Cables;
pub use clock::{FixedClock, advance};
pub use diagnostics::{Diagnostics, Times};
pub use drum::Drum;
pub use effects::*;
pub use error::Error;
pub use install::install;
pub use interpolate::{Interpolate, curve};
pub use junction::Junction;
pub use kink::KinkAlong;
pub use lariat_ancf::{self, At, Fidelity, Point, RopeMaterial, Section, Vector3};
pub use lariat_rapier::{self, AttachmentKind, Budget, Gap, Rope, RopeEnd, Settings, SheaveOptions, rapier};
pub use mesh::{RopeMesh, RopeVertices};
pub use passing::SheaveAlong;
pub use physics::Physics;
#[cfg(feature = "bevy_app")]
pub use plugin::{LariatPlugin, install_in};
pub use reel::{Reel, ReelAtStart};
pub use rope::SpawnRope;
pub use schedule::{AfterEngine, BeforeEngine, CableStep, CableSystems, RapierStep};
pub use sheave::Sheave;
pub use snapshot::Snapshot;
pub use strength::{BreakStrain, BreakTension};
pub use water::{InWater, Sea};
