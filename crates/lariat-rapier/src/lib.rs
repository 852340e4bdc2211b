//! Cables attached to the bodies of [`rapier3d`](rapier).
//!
//! ```
//! use lariat_ancf::{At, Cable, Section, Vector3};
//! use lariat_rapier::{AttachmentKind, CableSet};
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
//!     cables.step(&mut world)?; // one host step: predict, Rapier's step, reconcile
//! }
//! assert!((world.bodies[crate_].translation().y + 1.218).abs() < 6e-3);
//! # Ok::<(), lariat_rapier::Error>(())
//! ```
//!
//! | to | look at |
//! |---|---|
//! | attach cables and step | [`CableSet`], [`Settings`] |
//! | make the usual rope in one line | [`CableSet::add_rope`], [`Rope`] |
//! | let a cable touch colliders | [`CableSet::set_contact`], [`ContactRules`], [`CableSet::contacts`] |
//! | bound the work of a host step | [`Settings::budget`] |
//! | let a cable break | [`CableSet::set_strength`] |
//! | read forces, gaps and work | [`Attachment`], [`AttachmentReading`], [`WorldEnergy`] |
//! | hear where meshes, steps, laws and sizes are not good enough | [`Event::Warning`], [`Event::GapOpened`], [`CableSet::warnings`] |
//! | tie cables to each other | [`CableSet::join`], [`Junction`] |
//! | let bodies float, sink, and ride on waves | [`water`] |
//! | step Rapier yourself | [`CableSet::begin`], [`HostStep`] |
//! | convert numbers | [`convert`] |
//!
//! # Scheme
//! Rapier's solver accepts no constraints from outside, so the coupling acts between its steps. Per
//! Rapier step h:
//!
//! 1. **Predict.** Cables and the dynamic bodies attached to them are integrated together as one
//!    system ([`lariat_ancf::island`]), with the cables' own integrator and tolerance. Bodies are
//!    free, under gravity, applied forces and an estimate r of the contact and joint forces. A body
//!    that joints hold is predicted with the inertia and the loads of all that it moves with.
//! 2. **Apply.** Rapier is given the predicted motion as a uniform one, `linvel = dx/h`, `angvel =
//!    log(R1 R0^-1)/h`, and a force `-r` in place of gravity and applied forces. A body in contact
//!    with nothing lands where it was predicted, for any settings of Rapier. A body near others
//!    also gets an impedance: motors between each attachment and a heavy *ledger* body. If the
//!    prediction was right they do nothing; if a contact or a joint makes the body deviate, it
//!    feels the cable within the same step.
//! 3. **Reconcile.** A body that landed keeps its predicted state in `f64`, so that Rapier's single
//!    precision does not excite a stiff cable. For one that deviated, the impulse of the motors
//!    acts on the cable, the body keeps its whole predicted change of velocity, and r is updated
//!    from the velocity and position residuals. The gap that is left closes during the next
//!    prediction.
//!
//! Fixed, kinematic and disabled bodies prescribe the motion of their cable's end, and rotate a
//! clamp. Cables and bodies that come to rest fall asleep and wake up together; the forces of the
//! cables on a sleeping body stand in the motors of its ledger, for it may wake within Rapier's
//! step.
//!
//! *Order.* Integrators keep their accelerations from step to step, so generalised-alpha and Verlet
//! keep order 2; an implicit method keeps the order that it has on a cable alone.
//!
//! *Energy balance.* At every attachment, force and moment are the cable's residual after each step
//! of its integrator; impulse and work are their integrals by the trapezoidal rule
//! ([`Attachment`]).
//!
//! # Validity
//! - See the limits of [`CableSet`]: one number of Rapier steps for the whole world, and what is
//!   predicted of mechanisms.
//! - An undamped cable oscillates for ever, and so does the force at its end: a rope that was slack
//!   and bowed has a tension ripple of 1 % when it is taut, with any integrator. Give it damping
//!   ([`lariat_ancf::Damping`]), or an integrator that damps.
//! - Jams need a cable that damps: generalised-alpha-0 at 1/480 s holds 5 kN on a box of 1 kg to
//!   0.02 %. With the default, ESDIRK4, which hardly damps, a steel wire of 3 mm oscillates by 70 N
//!   on it.
//! - A joint counts as at its limit within 1e-3 m or rad of it, and may come to rest that far
//!   before it.
//! - A cable is smooth at a node: bent sharply over a hook, its tension oscillates along the cable
//!   near it. Tie two cables with [`CableSet::join`] instead.
//! - If the velocity of a kinematic body is set anew at every host step, the work of a clamp on it
//!   is some per cent short of the energy that the cable gains: the work in the jumps is known
//!   approximately.
//! - Where a line on a body that joints hold snaps taut, a host step is divided into up to
//!   [`Settings::max_rapier_steps`] Rapier steps. Random booms with loads on ropes, at 30 to 240
//!   Hz, are then within 5 % of their ways with fidelity engineering (tests, seeds). What fidelity
//!   game takes of the energy there is told ([`lariat_ancf::Warning::EnergyLost`], by
//!   [`CableSet::warnings`] alone, for only a whole run can judge it, and of cables with fidelity
//!   game with [`Settings::warn_level`] coarse).
//! - A kick that a taut cable answers within a step loses energy in fidelity game: up to half of
//!   it, of two balls on a cable whose vibration has several periods in a step of 1/60 s. Momentum
//!   and angular momentum stay.
//! - Damping of Rapier's bodies acts at the end of a step; with it, a body's accelerations are not
//!   kept.
//! - Kinematic bodies that turn or accelerate by poses, and bodies on joints, move with Rapier's
//!   precision: in single precision in jumps of 2e-7 m at 2 m, 2 N of a steel bar of 1 m and 1
//!   cm^2, and 1 + T/h times that if its retardation time is T. A warning tells where that matters.
//!   The package `lariat-rapier-f64`, of the same source, has none of this.
//!
//! # References
//! - Each file of the source names the equations it solves, their sources and their limits.
//! - Khatib, A unified approach for motion and force control of robot manipulators: the operational
//!   space formulation, 1987. Featherstone, Rigid Body Dynamics Algorithms, 2008. Udwadia and
//!   Kalaba, A new perspective on constrained motion, 1992.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

mod body;
mod contact;
mod contents;
pub mod convert;
mod edit;
mod error;
mod events;
mod handle;
mod islands;
mod mechanism;
mod read;
mod scales;
mod set;
mod statics;
mod step;
pub mod water;

pub use body::rigid_body;
pub use body::unsettled::Unsettled;
pub use contact::collider as collider_of;
pub use contents::attachment::{Attachment, AttachmentKind, AttachmentOptions, AttachmentReading, Gap};
pub use contents::gaps::OpenGap;
pub use contents::junction::Junction;
pub use contents::reel::drum::Drum;
pub use contents::reel::sheave::{Sheave, SheaveOptions};
pub use contents::rules::{ContactFilter, ContactRules};
pub use error::{BodyQuantity, Error, Failure};
pub use events::Event;
pub use handle::{AttachmentHandle, CableHandle, JunctionHandle, SheaveHandle};
pub use lariat_ancf;
pub use rapier;
#[cfg(feature = "debug-render")]
pub use read::draw::DrawStyle;
pub use read::inside::deepest_inside;
pub use read::totals::WorldEnergy;
pub use read::warnings::Warning;
pub use scales::set::ROPE_DAMPING;
pub use set::CableSet;
pub use set::rope::{Rope, RopeEnd, RopeHandles};
pub use statics::{BodyForce, Equilibrium, Relaxed};
pub use step::HostStep;
pub use step::budget::Budget;
pub use step::settings::Settings;
