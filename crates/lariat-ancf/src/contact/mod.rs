//! Contact and friction of a cable with obstacles, as a term of a step of the [discrete
//! gradient](crate::integrate::discrete_gradient).
//!
//! # Equation
//!
//! A contact is a material point x = S q of the centre line with a weight w (a length) against a
//! [`Patch`] of an obstacle. With the gap g between the centre line and the patch, the depth `d =
//! r - g`, a convex energy W and the spring u of friction
//!
//! ```text
//! normal     f_n = -W'(g1) gbar                        gbar . (y1 - y0) = g1 - g0 exactly          (patch.rs)
//!            less where it opens faster than restitution leaves                                    (rebound.rs)
//! friction   f_t = -t,  t = k_t P u0 + (k_t + r) P (y1 - y0),  |t| <= mu N, else -mu N t/|t|       (law.rs)
//! ```
//!
//! y is the place relative to the obstacle (path.rs says what that is for one that turns), N the
//! normal force, first that of the last accepted step, then that of the step itself (lag.rs). W is
//! convex, so `f_n . D y <= -D W`; return mapping loses energy for any bound; so with H of the
//! method plus W + k_t u^2/2 no contact can make energy, at any step. Sticking is a spring, so it
//! does not creep.
//!
//! # Where
//!
//! The points of Lobatto's rule, three within each element and the nodes, act on faces and on round
//! surfaces that are wide beside their spacing; the ends of a cable are among them, so an end that
//! points at a face touches it with its centre a radius away. On edges, corners and thin rods acts
//! the closest point of the element, one for each of these features; on edges and corners, of no
//! radius of their own, samples act as well, so that one that slides off a face hands its force on,
//! and beside them the force along the cable loses nothing (glide.rs). Where a cable lies straight
//! across a wide round surface its closest point acts, since it would sink in between samples
//! (straight.rs). Both are chosen when a step begins (find.rs). Samples stay the same material
//! points during it, and keep their patches; closest points follow the iteration (roll.rs), act
//! between those of the beginning and the end of a step while the cable slides (slide.rs), and what
//! was not near at the beginning is found when it ends (missed.rs). A patch is one-sided: as long
//! as the centre line is behind it, it is kept. It is swept: where the predicted way of a point
//! meets the surface, the patch is that of the meeting point.
//!
//! A contact that is deeper when a step begins than it was when the last one ended (a new one that
//! is born deep, an obstacle that was put elsewhere, another patch) gets an offset of the
//! difference, so that no energy comes from it. An offset closes again as far as what friction and
//! impact took in the step before pays for the energy that it stores: `N` times what closes is at
//! most 0.9 of that. A step in which contacts would give back more than they take is divided, and
//! its parts close nothing, but those of cables with cables down to the last division. If a body of
//! the island was moved by others since its last step, by the contacts that an engine computes, the
//! offset has either sign, so that the force goes on, and closes in a quarter of a second: that is
//! work of the others, `N` times what closes, and no more than they gave, `N` times the way by
//! which they moved the body into the cable. A cable that was pinched at once stores nothing of it.
//!
//! # Bodies
//!
//! An obstacle may ride on a body of the island ([`Obstacle::on`]). It moves with the iterate; the
//! body takes the opposite force on the line through the point of the centre line, so linear and
//! angular momentum are kept. All contacts with one body add six columns to the cable's matrix, and
//! a block to the body's (border.rs).
//!
//! # Validity
//!
//! `k = EA/(40 r^2)` per length: under the tension T around a radius R the depth is 40 (r/R) (T/EA)
//! of the radius. First touch is of order 1 in the step; the bound of friction is that of the step
//! itself, of a first touch too (lag.rs). What a step that does not resolve a contact leaves of the
//! velocity away from it, beyond what Newton's law of restitution leaves, is taken when the step
//! ends (impact.rs); restitution is 0 by default. The element has no torsion:
//! forces act on the centre line.
//!
//! # References
//!
//! Simo & Laursen, Comput. Struct. 42 (1992) 97 (return mapping); Gonzalez, J. Nonlinear Sci. 6
//! (1996) 449; Wriggers, Computational Contact Mechanics, 2006.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/contact.md.

mod border;
mod evaluation;
mod find;
mod glide;
mod impact;
mod impulse;
mod lag;
mod law;
mod linear;
mod missed;
mod motion;
mod nearby;
mod newton;
mod pair;
mod pairs;
mod patch;
mod path;
mod place;
mod point;
mod rebound;
mod roll;
mod slide;
mod statics;
mod step;
mod straight;
mod touch;
mod tube;

pub use crate::obstacle::{
    Ball, Capsule, Cuboid, Cylinder, Feature, FeatureShape, HalfSpace, LARGEST_RESTITUTION, Mount, Nearest, Obstacle,
    Patch, RigidMotion, Surface,
};
pub use crate::state::{ContactMemory, PairMemory};
pub(crate) use border::Border;
pub(crate) use impact::When;
pub(crate) use motion::Motion;
pub(crate) use pair::between_samples;
#[cfg(test)]
pub(crate) use pairs::PairEnd;
pub use pairs::{CablePair, PairTouch, Way, crossed_on};
pub(crate) use pairs::{Crossed, PairColumns, PairStep, Strand, Strands};
pub(crate) use path::BodyPath;
pub(crate) use place::Place;
pub(crate) use statics::{Growth, StaticContact};
pub(crate) use step::{ContactBalance, ContactStep};
pub use touch::{Overlap, Touch};
