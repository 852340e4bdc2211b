//! Handles of the cables, attachments, junctions and sheaves of a [`CableSet`](crate::CableSet).
//!
//! A handle is an index that is never given out twice; a removed item leaves its index unused.

use serde::{Deserialize, Serialize};

/// Handle of a cable of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct CableHandle(pub(crate) u32);

/// Handle of an attachment of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct AttachmentHandle(pub(crate) u32);

/// Handle of a junction of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct JunctionHandle(pub(crate) u32);

/// Handle of a sheave of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct SheaveHandle(pub(crate) u32);
