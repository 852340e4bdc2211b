//! Cables and rigid bodies pinned together, integrated as one system.
//!
//! An island is a set of cables and the bodies to which their nodes are pinned. It is a
//! [`Dynamics`], so every integrator steps it, with the same order and the same error control as a
//! cable alone.
//!
//! # Equation
//!
//! A pinned position is not a coordinate of its own: it follows its body,
//!
//! ```text
//! r = x + rho + gap (1 - 3 s^2 + 2 s^3),   rho = R a
//! r'' = x'' + omega' x rho + omega x (omega x rho) + gap'' ...
//! ```
//!
//! where `gap` is the distance between pin and node when the step began (of a wide one the part
//! that closes at 10 m/s) and s the elapsed share of the step (`kinematics.rs`, clamps included).
//! By virtual work the cable's residual at a pin acts on the body as the force f_p and the torque
//! rho x f_p (`rows.rs`): there is no multiplier, no penalty and no drift. In Newton's iteration
//! each cable is condensed on its held coordinates (`condense.rs`), the bodies are solved together
//! by a sparse factorisation ([`linalg`](crate::linalg)), and the increments of the cables follow
//! (`bordered.rs`). The tangent includes the geometric stiffness of the lever, `-[f_p]x [rho]x`,
//! without which the iteration converges slowly for light bodies on taut cables.
//!
//! # Validity
//!
//! Bodies that rotate by less than a full revolution in a step; hundreds of bodies (a net of 100
//! knots costs 50 us per factorisation, one of 400 knots 0.7 ms).
//!
//! # Alternatives considered
//!
//! - Bodies as points with directors: the mass matrix is constant, but singular for flat bodies.
//! - A staggered solution of cables and bodies: it diverges for light bodies.
//!
//! [`Dynamics`]: crate::integrate::Dynamics

mod alone;
mod attach;
mod body;
mod bordered;
mod clamp;
mod condense;
mod coupled_groups;
mod coupling;
mod cuts;
mod discrete_gradient;
mod dynamics;
mod energy_balance;
mod equations;
mod forces_now;
mod hold;
mod impedance;
mod kinematics;
mod layout;
mod mass_key;
mod memory;
mod pin;
mod pin_accounts;
mod pin_momentum;
mod reel;
mod rotation;
mod rows;
mod statics;
mod step;
mod velocities;

pub(crate) use alone::advance as advance_alone;
pub use body::{BodyMemory, PointForces, RigidBody};
pub use coupling::CoupledInertia;
pub use discrete_gradient::terms;
pub use impedance::Impedance;
pub use layout::closing_share;
pub use pin::PinConstraint;
pub use pin_accounts::PinAccount;
pub use reel::{Drum, Sheave, Wheels};
pub use statics::{FREE, JointFrame, Links, LoadThere, PlacedLoad, StaticJoint, equilibrium};
pub use step::Island;
