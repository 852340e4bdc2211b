//! Islands: sets of cables, bodies and junctions that are connected by attachments, by contacts
//! that are near, or by the joints of a mechanism.
//!
//! Order within and among islands follows the names of the cables and the positions at which they
//! were inserted, not their handles: a run does not depend on the order of insertion, to the bit.
//! Islands are found anew when the contents of the set, a cable, or the type of an attached body
//! changed.

mod find;
mod island;
mod member;
mod wheels;

pub(crate) use find::Islands;
pub(crate) use island::Island;
pub(crate) use member::Member;
