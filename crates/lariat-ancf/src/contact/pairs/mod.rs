//! Contact of cables with each other and with themselves.
//!
//! # Equation
//!
//! A contact joins a material point of one centre line to one of another, with `y = xa - xb` and
//! the tangents ta, tb. Between them is a plane: when they touch first, across the direction y/|y|
//! of the closest points, then along both tangents (passage.rs). The laws are those of an obstacle
//! ([`contact`](super)), with the reach `ra + rb` and both stiffnesses in series. The frame of the
//! plane turns with the pair, by the mean rotation of ta, tb and y:
//!
//! ```text
//! K w = ta x D ta + tb x D tb + e y x D y        K = sum (|v|^2 - v v^T), v = ta, tb, sqrt(e) y, means over the step
//! s = D y - w x y                                slip: zero in any rigid motion of the pair
//! ```
//!
//! The force f on the slip acts on the coordinates by virtual work, `f . s`: on both places, and on
//! both slopes as the couple by which friction, which acts on the surfaces, turns the cables. So
//! momentum and the torque of both cables balance exactly, as does the energy.
//!
//! # Validity
//!
//! What touched begins a step with its true depth, half way between its closest points before and
//! after (passage.rs), so that strands that slide and bend do not sink by more than the law says:
//! loops that hang in each other are within 1e-4 r of it, while the chords in contact do not
//! change. An overhand knot in a rope of radius 5 mm is up to 0.25 r deep while it is drawn tight,
//! and 0.05 to 0.23 r when it holds. A contact that is born deep has an offset of that depth.
//! It takes up the energy of one beside it that ends, as a load that slides over the end of a chord
//! does; what is left of it closes as fast as friction and damping pay for it. Ropes without both
//! keep it. The depth that is read, [`PairTouch::depth`], has the offset in it.
//!
//! The lateral stiffness of strands that wrap around each other, `N/(R - g)` with the radius R of
//! the bend and the distance g of the lines, is not in the equations of an iteration: where it is
//! more than the step resolves, contacts swing along the cables from step to step, and give way.
//! Hooked loops of a rope of 5 mm and 10 MPa hold 0.6 % of EA at 1/240 s, 2.5 % at 1/960 s. The law
//! of contact that is taken by default, EA/(40 r^2), is soft for a rope that crosses another one at
//! a point: beyond EA/31 it lets it through, and a rope of 0.1 MPa under half a newton sinks by 1.8
//! r. [`Contact::stiffness`](super::Contact::stiffness) sets another.
//!
//! Nothing holds the section of a cable against turning about its own axis, and contact does not
//! act on the twist of one with torsion. So a cable turns beneath one that bends around it as a
//! wheel would that turns freely ([warning](crate::Warning::RunsOver) if it does): friction holds
//! what crosses, not what is hooked over it, and loops that hang in each other by 180 degrees slide
//! through each other, where Euler's capstan would hold a ratio of exp(pi mu). Cables that are
//! parallel, to `sqrt(e)` = 0.03 rad, roll on each other without friction. A fixed rod in place of
//! the cable beneath holds as it should. Points of one cable nearer than eight radii along it do
//! not touch, nor do points so near to a body that holds both. Cables that bend to less than some
//! radii are not resolved. Whether centre lines went through each other is asked after every step
//! (crossing.rs): such a step is divided, and if that does not help it is counted in
//! [`Diagnostics::crossed_steps`](crate::Diagnostics::crossed_steps), which is a
//! [warning](crate::Warning::PassedThrough).
//!
//! # References
//!
//! As [`contact`](super); Wriggers & Zavarise, Comm. Numer. Meth. Eng. 13 (1997) 429 (beams that
//! touch).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/contact.md.

mod boxes;
mod chords;
mod columns;
mod crossing;
mod halves;
mod impact;
mod passage;
mod point;
mod search;
mod step;
mod strands;
mod touch;
mod way;

/// Cables of an island that may touch each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CablePair {
    /// Their places in the island, in ascending order.
    pub cables: [usize; 2],
    /// Coefficient of friction between them.
    pub friction: f64,
    /// Newton's coefficient of restitution between them, from 0 to [`LARGEST_RESTITUTION`].
    ///
    /// [`LARGEST_RESTITUTION`]: super::LARGEST_RESTITUTION
    pub restitution: f64,
}

pub(crate) use chords::Strand;
pub(crate) use columns::PairColumns;
#[cfg(test)]
pub(crate) use columns::PairEnd;
pub(in crate::contact) use crossing::crossing;
pub(crate) use search::Crossed;
pub(crate) use step::PairStep;
pub(crate) use strands::Strands;
pub use touch::PairTouch;
pub use way::{Way, crossed_on};
