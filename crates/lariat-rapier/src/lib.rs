//! Cables pinned to the bodies of rapier3d.
//!
//! ```
//! use lariat_ancf::{At, Cable, Section, Vector3};
//! use lariat_rapier::{CableSet, AttachmentKind};
//! use rapier::prelude::*;
//!
//! let mut world = PhysicsWorld::new();
//! let (crate_, _) = world.insert(
//!     RigidBodyBuilder::dynamic().translation(Vector::new(2.0, -0.1, 0.0)),
//!     ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0),
//! );
//! let mut cables = CableSet::new();
//! let sling = cables.insert(
//!     Cable::builder()
//!         .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
//!         .section(Section::square(0.01, 1.0e9, 4000.0)?)
//!         .fix(At::Start)
//!         .build()?,
//! );
//! cables.attach(&world, sling, At::End, crate_, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball)?;
//! for _ in 0..30 {
//!     cables.step(&mut world)?; // one host step: predict, Rapier's step, reconcile, four times
//! }
//! assert!((world.bodies[crate_].translation().y + 1.218).abs() < 6e-3);
//! # Ok::<(), lariat_rapier::Error>(())
//! ```
//!
//! # The scheme
//!
//! Rapier has no room for a foreign constraint inside its solver, so the coupling acts between its steps. Per Rapier step h:
//!
//! 1. **Predict.** Cables and the dynamic bodies they hold are integrated together as one system
//!    ([`lariat_ancf::island`]), with the cables' own integrator and tolerance, bodies free but for gravity, the user's forces and
//!    a learnt reaction r of whatever contacts and joints did to them before.
//! 2. **Hand over.** Rapier is given the predicted motion as a uniform one, `linvel = dx/h`, `angvel = log(R1 R0^-1)/h` (so corrected
//!    that Rapier's linearised rotation ends there), and a force `-r` in place of gravity and user forces (restored afterwards). A body
//!    that meets nothing lands where it was predicted, whatever Rapier's settings. A body near others, or that flies into one (`near`),
//!    also gets an impedance: a motor per pin to a heavy *ledger* body, of
//!    damping D/h in the axes of D, the pin's block of (C + B')^-1, with C the cable's compliance over the step and B' the mobility
//!    of the bodies (the body's own scaled by 0.1). If the prediction was right the motors do nothing; if a contact or a joint
//!    makes the body deviate, it feels the cable within the same step. A body that joints hold is predicted with the inertia and the loads of all that it
//!    moves with, and struck together with it instead of being given a velocity (`linkage`, `mechanism`, `bear`).
//! 3. **Reconcile.** A body that landed where predicted keeps its predicted state in `f64`: Rapier's single precision never shakes a
//!    stiff cable. For one that deviated, p, the motors' impulse, is read from the ledger; the cable gets it back,
//!    `dv = -A^-1 J^T p`, `dx = h dv`, less where that would make energy; the body has the whole of the predicted velocity and of what it
//!    deviated by, `v1 + v_after - v0`, so that momentum stays; the reaction learns from what velocity and place deviate by,
//!    `r += 0.3 (m (v_after - v0) + m (x_after - x1)/h - p)/h` (without p for links of a chain); the gap that is left closes
//!    during the next prediction.
//!
//! Bodies that feel nothing (fixed, kinematic, disabled) prescribe the end of their cable; a clamp on one is turned by it. Cables
//! and bodies that come to rest sleep and wake together (`rest`). Integrators carry their accelerations from step to step, so
//! generalised-alpha and Verlet keep order 2; an implicit method keeps the order it has on a cable alone.
//!
//! *Accounts.* At every pin, force and moment are the cable's residual after each step of its integrator, impulse and work their
//! integrals by the trapezoidal rule; see [`Attachment`]. The residual of the work is force times growth of the gap.
//!
//! *Tried and failed* (measured before): explicit staggering (blows up for light bodies and steel), impulses of cable and free
//! body (contacts break it), prescribing the body's motion with full debt (blows up), motors alone (gaps in jams), rolling Rapier
//! back (four times the cost, still fails in jams). Here: links and bodies on joints as free ones that learn the inertia of their
//! mechanism as a force (an arm rings and gains energy); learning without taking p away, for bodies
//! in contact (1 to 5 kg on a steel wire leave a jam when the host step is not split); motors on a body that a joint holds to the
//! world (a gap of 1e-2 m at 5 kN; 4e-6 m without); of a body that deviates only a share of what the prediction changed its velocity by,
//! `v_after + s (v1 - v0)`, s = 1 where it landed, 0 where it was stopped (8e-3 m/s per mass gained by a random scene in free flight).
//!
//! *Limits*
//!
//! - An undamped cable swings and rings for ever, and so does the load on it: a rope that was slack and bowed carries 1 % of ripple in its
//!   tension when it is taut, with any integrator. Give it damping ([`lariat_ancf::Damping`]), or an integrator that damps.
//! - Jams want a cable that damps: generalised-alpha-0 at 1/480 s holds 5 kN on a 1 kg box to 0.02 %. The default, ESDIRK4, hardly
//!   damps, and lets a steel wire of 3 mm ring by 70 N on it.
//! - A mechanism near another body from outside, or held by two cables, learns what its other bodies do to the one that is held; limits of multibody
//!   joints chatter there: Rapier does not say what such a limit pushes with.
//! - A joint counts as at its limit within 1e-3 m or rad of it (`limits`): it may come to rest so far before it.
//! - A cable is smooth at a node: bent sharply over a hook, its tension wavers near it; tie two cables with [`CableSet::join`].
//! - Where a user sets the velocity of a kinematic body anew at every host step, the work of a clamp on it is some per cent short of the
//!   energy that the cable gains: what passes in the jumps is only approximately known.
//! - Damping of Rapier's bodies acts at the end of a step; with it a body's accelerations are not carried on.
//! - Kinematic bodies move by Rapier's precision: in single precision a slow winch moves in jumps of 2e-7 m at 2 m, 2 N of a
//!   steel bar. The package `lariat-rapier-f64`, of the same source, has none of this.

mod attachment;
mod bear;
mod body;
mod convert;
#[cfg(feature = "debug-render")]
mod draw;
mod ends;
mod error;
mod event;
mod hand_over;
mod hold;
mod impedance;
mod islands;
mod junction;
mod limits;
mod linkage;
mod mechanism;
mod near;
mod predict;
mod reconcile;
mod rest;
mod set;
mod split;
mod step;
mod totals;

pub use attachment::{Attachment, AttachmentHandle, AttachmentKind};
#[cfg(feature = "debug-render")]
pub use draw::DrawStyle;
pub use error::Error;
pub use event::Event;
pub use junction::{Junction, JunctionHandle};
pub use lariat_ancf;
pub use rapier;
pub use set::{CableHandle, CableSet, Settings};
pub use step::HostStep;
pub use totals::WorldEnergy;
