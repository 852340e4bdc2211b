//! Changing what is in a set.
//!
//! | file | what it does |
//! |---|---|
//! | [`attach`] | attaches cables to bodies and detaches them |
//! | [`join`] | ties cables to each other and unties them |
//! | [`kink`] | frees the slope at a point of a cable |
//! | [`remove`], [`part`], [`breaking`] | removes, cuts and breaks cables |
//! | [`reel`] | what cables run over, and what they are wound on |
//! | [`movement`] | moves bodies with the cables on them |
//! | [`world_mark`] | the world that the attachments belong to |

pub(crate) mod attach;
pub(crate) mod breaking;
pub(crate) mod join;
pub(crate) mod kink;
pub(crate) mod movement;
pub(crate) mod part;
pub(crate) mod reel;
pub(crate) mod remove;
pub(crate) mod world_mark;
