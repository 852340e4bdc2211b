//! Bodies in water: buoyancy, drag, added mass and the forces of a wave.
//!
//! ```
//! use lariat_ancf::{Surface, Vector3, Water};
//! use lariat_rapier::CableSet;
//! use lariat_rapier::water::{BodiesInWater, Immersed};
//! use rapier::prelude::*;
//!
//! let mut world = PhysicsWorld::new();
//! // a ball of 20 cm and 16.8 kg, half the density of water
//! let ball = ColliderBuilder::ball(0.2).density(500.0);
//! let (float, _) = world.insert(RigidBodyBuilder::dynamic(), ball);
//! let mut water = BodiesInWater::new(Water::new(1000.0).with_surface(Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0))))?;
//! water.insert(&mut world, float, Immersed::with_drag_area([0.06; 3]))?;
//! let mut cables = CableSet::new();
//! cables.set_water(water);
//! for _ in 0..600 {
//!     cables.step(&mut world)?; // with the forces of the water, beside yours
//! }
//! assert!(world.bodies[float].translation().y.abs() < 0.01); // half of it is below
//! # Ok::<(), lariat_rapier::Error>(())
//! ```
//!
//! # Equation
//!
//! ```text
//! (m + a) v' = m g + F + rho V_s (u' - g) + s a u' + F_drag        a = C_a rho V_r,   V_r = min(V, m/rho)
//! F_drag = -1/2 rho s |w| (D_x w_x, D_y w_y, D_z w_z)              w = v - u, in axes of the body
//! M_drag = -1/2 rho s |W| (E_x W_x, E_y W_y, E_z W_z)              s = min(1, V_s/V_r)
//! ```
//!
//! V is the volume of the body, V_s that part of it which is below the [surface](Surface), V_r what
//! it displaces when it floats; u and u' velocity and acceleration of the water, current and wave,
//! in the middle of V_s; W the angular velocity. Buoyancy and the pressure of the wave (Froude and
//! Krylov) act at the centroid of V_s, drag at that of V. a has no weight, and is part of the mass
//! of the body in Rapier. Where it differs along the axes of the body, the least of it is, and what
//! is beyond acts as a force (`added_mass`, with Munk's moment).
//!
//! *Over a Rapier step* all of it is one constant force and moment: the mean buoyancy over the rise
//! r of the step at the attitude in its middle, and the mean drag of [`drag`],
//!
//! ```text
//! r = h v + h^2/2m (f + rho g V^)        V^ = (V_s d(0) - V_s d(r))/r        d: depth of the centroid of V_s
//! ```
//!
//! V_s d is the energy of the displaced water over rho g, so an undamped float that heaves keeps
//! its energy, whatever the step. The righting moment is that of the attitude in the middle of the
//! step, to first order, which is stable for any float. Drag does not reverse a velocity; its share
//! is s = min(1, V^/V_r), so that what leaves the water within a step is held back as long as
//! buoyancy pushes it. Where drag and buoyancy do not come to agree by iteration, the rise that
//! both give is found by bisection.
//!
//! # Validity
//!
//! - Bodies small beside the wave length: the water is that at one point, and the surface over the
//!   body is a plane with the slope of the wave. No diffraction, no damping by waves that the body
//!   makes; added mass does not depend on frequency, and there is none of rotation.
//! - Added mass is in the mass of a body while any of it is wet. The body takes it up when it
//!   comes in, all at once, with the momentum of both (von Karman 1929, of slamming, which is
//!   spread over the time of entry; along each axis where it differs), and leaves it behind when it
//!   comes out. So it falls freely in air, and no entry makes energy.
//! - Rapier steps of less than half a period of heave and roll, into which host steps are split
//!   ([`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps)). Beyond that the motion of
//!   a light float is bounded by its energy, but what does not damp within a step goes on.
//! - No lift, and no moment of drag but that about the centroid. Drag of a body that rises fast
//!   through the surface pushes its centroid down while buoyancy pushes the wet part up, which
//!   turns it over: give it drag of rotation.
//! - Rapier moves a body without cables by substeps, which are ahead by half a substep of the
//!   change of its velocity: its place is of first order in the step, its velocity of second.
//!   [`BodiesInWater::lost_in_substeps`] is the energy of that.
//! - The volume is that of the [colliders](hull), exact for balls, boxes and meshes at every
//!   attitude; cylinders, cones and capsules are prisms of the same volume.
//! - What cables, contacts and joints do to a body is not known before the step: drag expects of it
//!   what it did in the last two. The error of a step is of second order where that is smooth.
//!
//! - In still water a body sleeps as Rapier lets it, but not while a point of it is faster than
//!   [`Settings::sleep_speed`](crate::Settings::sleep_speed).
//!
//! # References
//!
//! Archimedes; von Karman 1929, NACA TN 321 (momentum of entry); Morison et al. 1950; Faltinsen
//! 1990, ch. 3 (long waves: Froude and Krylov with added mass); Lamb 1932, §124 (mass by axes).
//!
//! # Alternatives considered
//!
//! Forces at the beginning of the step: a float with a period of 2 s gains 4 % of its amplitude in
//! a second, at 1/60 s.

pub mod added_mass;
pub mod bodies;
pub mod drag;
pub mod hull;
mod immersed;
mod member;
mod rise;
mod still;

pub use bodies::BodiesInWater;
pub use hull::Hull;
pub use immersed::Immersed;
pub use lariat_ancf::{Surface, Water, Wave};
pub use member::WaterForce;
pub(crate) use still::StillWater;
