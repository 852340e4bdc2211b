//! How parts of a snapshot are written that serde or its formats have no form for.

pub(crate) mod maybe;
pub(crate) mod pairs;
pub(crate) mod reason;
