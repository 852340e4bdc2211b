//! What a cable runs over, and what it is wound on.

pub(crate) mod drum;
pub(crate) mod sheave;
